#!/bin/bash
# The pins ini.* begin with the INI file's values, and a change acts at once, as if it had been read from there.
exec ../../task/lib/machine-test pins.py AXIS_X.MAX_JERK=40000 JOINT_0.MAX_JERK=50000 TRAJ.MAX_LINEAR_JERK=60000 \
    -hal "loadrt limitcheck count=1" -hal "addf limitcheck.0 servo-thread" -hal "net x-checked joint.0.pos-cmd => limitcheck.0.pos-cmd"
