#!/bin/bash
# FP-176: the components behind the axis tests of the wizards: an axis that was jogged a little stands where
# the button was let go and goes nowhere by itself; a run ends where it began when its button is let go.
export KERF_CLOCK=virtual
realtime start
kerf-clock run /usr/bin/python3 bench.py
realtime stop
