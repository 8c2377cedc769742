#!/bin/bash
# The screen ends, task is killed, the launcher, the realtime part, with three drives running: they are told to stop.
export PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH"
timeout 200 /usr/bin/python3 -B check.py
