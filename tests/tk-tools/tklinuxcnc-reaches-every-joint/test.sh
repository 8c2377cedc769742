#!/bin/bash
# tklinuxcnc on a gantry with two motors for Y: joints are rows until all are homed, each key and Home reaches its own joint; then
# axes. The tool's length is in the program's units; another tool's data are that tool's; an emergency stop reaches through windows.
export PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH"
exec ../../lib/with-display ../../task/lib/machine-test script.py -machine gantry JOINT_1.HOME_SEQUENCE=2 JOINT_2.HOME_SEQUENCE=2
