#!/bin/bash
# The terminal that linuxcnc was started from is closed in the middle of a program, or hangs up all that runs in it: the
# machine ends in order, nothing is left. With nohup it goes on.
unset KERF_CLOCK
export KERF_INSTANCE=${KERF_INSTANCE:-hangup}
exec /usr/bin/python3 -B hangup.py
