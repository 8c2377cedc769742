#!/bin/bash
# FP-130: the screen tells a change of the program's file by its text, not by its time; the properties show the hash of what is loaded.
. "$TEST_DIR/../lib/machine.sh"
printf 'G21 G90 F3000\nG1 X10\nG1 Y20\nG4 P1\nM2\n' > part.ngc
screen_test mill operator_script.py "$PWD/part.ngc"
cat machine/transcript
grep -i -A8 traceback screen.err
rm -rf machine home part.ngc screen.log screen.err
