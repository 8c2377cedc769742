#!/bin/bash
# Keys from the X server instead of Tk's events: FP-060, FP-061, FP-189 (no jog depends on the window system's repeat or focus).
. "$TEST_DIR/../lib/machine.sh"
printf 'G21 G90\nG0 Z1\nG1 X20 F600\nG1 X0\nM2\n' > part.ngc
screen_test mill real_keys.py "$PWD/part.ngc"
cat machine/transcript
grep -i -A12 traceback screen.err
rm -rf machine home part.ngc screen.log screen.err
