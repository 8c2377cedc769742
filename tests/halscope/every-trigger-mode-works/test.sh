#!/bin/bash
# Triggers of scope_rt: edges, levels, every type of value, automatic, forced, none; sources that
# are linked or go away while they are sampled. In virtual time.
export KERF_CLOCK=virtual
realtime start 2>/dev/null
halcmd loadrt threads name1=servo period1=1000000
PYTHONPATH=../lib:$PYTHONPATH /usr/bin/python3 test.py
halcmd stop
halcmd unload all
realtime stop
