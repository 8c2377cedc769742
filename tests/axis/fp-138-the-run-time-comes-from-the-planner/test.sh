#!/bin/bash
# FP-138: the run time that is told comes from the planner's own limits, with dwells, tool changes, overrides:
# less than 5 % beside what the machine takes (kerf-time alone: 2 %).
. "$TEST_DIR/../lib/machine.sh"
kerf-time -ini no.ini 2>&1 | head -1
kerf-time -ini "$top/configs/sim/mill/mill.ini" "$top/nc_files/star.ngc" 2>&1
export PROGRAMS="$top/nc_files/star.ngc 1 1
$top/nc_files/star.ngc 0.4 0.5
$top/nc_files/circle_diamond_square.ngc 1 1
$TEST_DIR/drill.ngc 1 1
$TEST_DIR/surface.ngc 1 1
$TEST_DIR/surface.ngc 1.5 1
$TEST_DIR/corners.ngc 1 1
$TEST_DIR/corners.ngc 0.3 1"
"$top/tests/task/lib/machine-test" "$TEST_DIR/display.py"
PROGRAMS="$TEST_DIR/thread.ngc 1 1" "$top/tests/task/lib/machine-test" "$TEST_DIR/display.py" -machine lathe
printf 'G21 G90\nT1 M6\nG43\nG0 X0 Y0 Z0\nF600\no1 repeat [6]\nG1 X10\nG4 P0.5\nG1 X0\no1 endrepeat\nM2\n' > part.ngc
screen_test mill operator_script.py "$PWD/part.ngc"
cat machine/transcript
rm -rf machine home part.ngc screen.log screen.err
