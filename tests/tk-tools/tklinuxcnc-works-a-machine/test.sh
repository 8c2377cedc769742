#!/bin/bash
# tklinuxcnc from power on to the end of a part: keys, jogging that stops on release and loss of focus, MDI, a program.
export PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH"
exec ../../lib/with-display ../../task/lib/machine-test script.py DISPLAY.USER_COMMAND_FILE=user.tcl "DISPLAY.INCREMENTS=1mm, .1in" \
    DISPLAY.HELP_FILE=help.txt DISPLAY.BALLOON_HELP=1 "DISPLAY.POSITION_FONT={DejaVu Sans} -31 italic" -file "$TEST_DIR/user.tcl" -file "$TEST_DIR/help.txt"
