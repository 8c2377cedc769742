#!/bin/bash
# Ten working days of an operator (SEED: in another order; ONLY: some of them). After every step the whole screen is compared
# with the machine: each button and entry, what looks pressed, positions, codes, tool, program, marked line, pins. FP-184.
. "$TEST_DIR/../lib/machine.sh"
printf 'G21 G90\nG0 Z10\nM2\n' > part.ngc
ini_edit='s|^CYCLE_TIME = 0.100|CYCLE_TIME = 20|'
screen_test mill days.py "$PWD/part.ngc"
cat machine/transcript
grep -i -A12 traceback screen.err
rm -rf machine home *.ngc screen.log screen.err
