#!/bin/bash
# Status, debug flags, taught positions, the tool table and a manual tool change beside a running machine.
export PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH"
exec ../../lib/with-display ../../task/lib/machine-test script.py -hal '!iocontrol.0.tool-change' -hal 'loadusr -W hal_manualtoolchange' \
    -hal 'net tool-change iocontrol.0.tool-change => hal_manualtoolchange.change' \
    -hal 'net tool-changed iocontrol.0.tool-changed <= hal_manualtoolchange.changed' \
    -hal 'net tool-number iocontrol.0.tool-prep-number => hal_manualtoolchange.number'
