#!/bin/bash
export PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH"
realtime start 2>/dev/null
timeout 100 /usr/bin/python3 check.py
halrun -U >/dev/null 2>&1
rm -f line
