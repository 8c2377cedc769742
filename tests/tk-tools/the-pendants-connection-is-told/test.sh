#!/bin/bash
# monitor-xhc-hb04: which changes of the pendant's connection the operator reads of, and when it ends.
export PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH"
timeout 60 ../../lib/with-display /usr/bin/python3 pendant.py
realtime start 2> /dev/null
timeout 20 ../../lib/with-display monitor-xhc-hb04 2>&1; echo "without the component: $?"
realtime stop 2> /dev/null
