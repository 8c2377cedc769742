#!/bin/bash
# The screen from power on to the end of a part, by keys and buttons, in virtual time.
. "$TEST_DIR/../lib/machine.sh"
cat > part.ngc <<'NGC'
(a small part)
G21 G90 G17 G54 G64 P0.01
M3 S1000
G0 X0 Y0 Z50
G1 X50 F1000
G1 Y20
G1 X0
G1 Y0
G1 X30 Z40
G2 X0 Y0 I-15 J0
M5
M2
NGC
screen_test mill operator_script.py "$PWD/part.ngc"
cat machine/transcript
grep -v -E '^(Note|task:)' screen.err | grep -i -A8 traceback
rm -rf machine home part.ngc screen.log screen.err
