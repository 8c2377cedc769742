#!/bin/bash
# Everything in the windows is pressed in any order: no window raises an error, none hangs. The seed is printed with an error.
export HOME=$PWD/home KERF_CLOCK=virtual PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH"
mkdir home; cd home
realtime start 2> /dev/null
halcmd -f ../net.hal
LC_ALL=C.UTF-8 timeout 200 "$TEST_DIR/../../lib/with-display" /usr/bin/python3 "$TEST_DIR/press.py"
realtime stop 2> /dev/null
cd ..; rm -rf home
