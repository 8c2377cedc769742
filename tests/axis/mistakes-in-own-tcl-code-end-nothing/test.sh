#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Tcl code of the user ([DISPLAY]TKAPP) with mistakes: those it catches are its own, the others are told in a message. The
# screen goes on, and no question waits before it.
export KERF_CLOCK=virtual
top=$(cd "$TEST_DIR/../../.." && pwd)
rm -rf machine home; cp -r "$top/configs/sim/mill" machine; mkdir home
cp "$TEST_DIR"/*.tcl machine/
sed -i "s|^\[DISPLAY\]|&\nTKAPP = broken.tcl\nTKAPP = gone.tcl\nTKAPP = own.tcl\nOPEN_FILE = \"\"|" machine/mill.ini
HOME=$PWD/home "$top/tests/lib/with-display" linuxcnc -r machine/mill.ini > screen.log 2> screen.err < /dev/null
echo "status $?"
cat machine/transcript
grep -c "while executing" screen.err
grep -A12 "Traceback\|started again" screen.err
rm -rf machine home screen.log screen.err
