#!/bin/bash
# FP-184: at any time, before and after homing, offsets, programs, aborts and an emergency stop, the display is the
# machine's position less the offsets, and what status and parameters say. SEED, STEPS: of the random operator.
. "$TEST_DIR/../lib/machine.sh"
printf 'G21 G90 G17\nG0 X10 Y5 Z-5\nG10 L20 P0 X3\nG92 Y2\nG1 X40 Y30 F3000\nG56 G1 X1 Y1\nG43.1 Z4\nG1 Z-8\nG92.1\nG54 G1 X20\nG49\nM2\n' > part.ngc
screen_test mill script.py "$PWD/part.ngc"
cat machine/transcript || cat screen.log screen.err >&2
rm -rf machine home part.ngc screen.log screen.err
