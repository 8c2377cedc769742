#!/bin/bash
# FP-137: hours of running, screen with OpenGL and all: the memory of every process stays flat.
# SOAK_HOURS=10 for the long one (`make bench-axis-soak`, about an hour of real time, which reports to SOAK_REPORT as it goes).
. "$TEST_DIR/../lib/machine.sh"
# The preview ends, so that each one takes the same memory.
cat > part.ngc <<'NGC'
G21 G90 F3000
o1 while [1]
#1 = [#1 + 1]
o2 if [#<_task> EQ 0 AND #1 GT 500]
M2
o2 endif
G0 X0 Y0 Z50
G1 X50
G2 X0 Y50 I-25 J25
G1 Y0
G1 Z60
(MSG, turn)
M3 S100
M5
o1 endwhile
M2
NGC
ini_edit='s|^CYCLE_TIME = 0.100|CYCLE_TIME = 500|'
screen_test mill soak.py "$PWD/part.ngc"
cat machine/transcript
grep -i -A8 traceback screen.err
rm -rf machine home part.ngc screen.log screen.err
