#!/bin/bash
# tklinuxcnc while everything is pressed in any order: no error, no move beyond the limits, and screen and machine agree.
export PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH"
exec ../../lib/with-display ../../task/lib/machine-test script.py "DISPLAY.INCREMENTS=1mm, 10mm"
