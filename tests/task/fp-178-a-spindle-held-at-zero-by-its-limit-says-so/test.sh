#!/bin/bash
# FP-178: the reverse limit is that of the forward direction unless set; a command that a limit of 0 holds back
# is told to the operator.
for limits in "SPINDLE_0.MAX_REVERSE_VELOCITY=" "SPINDLE_0.MAX_REVERSE_VELOCITY=0" "SPINDLE_0.MAX_REVERSE_VELOCITY=500"; do
    echo "= $limits"
    ../lib/machine-test spindle.py SPINDLE_0.MAX_FORWARD_VELOCITY=3000 ${limits:+$limits}
done
