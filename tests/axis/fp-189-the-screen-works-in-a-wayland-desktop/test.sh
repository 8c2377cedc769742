#!/bin/bash
# FP-189: a Wayland desktop. Tk speaks X, so the screen comes by Xwayland; what it needs of X is there, and no jog depends on it.
. "$TEST_DIR/../lib/machine.sh"
printf 'G21 G90\nG0 Z1\nG1 X20 F600\nG1 X3\nM2\n' > part.ngc
ini_edit='s|^\[DISPLAY\]|&\nEMBED_TAB_NAME = Other\nEMBED_TAB_COMMAND = /usr/bin/python3 '$TEST_DIR/guest.py' {XID} '$PWD/seen'|'
export SEEN=$PWD/seen
screen_server=with-wayland
screen_test mill operator_script.py "$PWD/part.ngc"
cat machine/transcript
grep -i -A12 traceback screen.err
rm -rf machine home part.ngc seen screen.log screen.err
