#!/bin/bash
# tklinuxcnc from power on to the end of a part: keys, jogging that stops on release and loss of focus, MDI, a program.
export PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH"
exec ../../lib/with-display ../../task/lib/machine-test script.py DISPLAY.USER_COMMAND_FILE=user.tcl "DISPLAY.INCREMENTS=1mm, .1in" -file "$TEST_DIR/user.tcl"
