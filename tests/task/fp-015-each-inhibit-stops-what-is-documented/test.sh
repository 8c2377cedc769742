#!/bin/bash
../lib/machine-test script.py JOINT_1.HOME=100 JOINT_1.HOME_FINAL_VEL=20 AXIS_Z.OFFSET_AV_RATIO=0.3 > seen
cat seen
grep -Fxc -f seen "$EMC2_HOME/docs/stops.md" | grep -q "^$(wc -l < seen)$" && echo "as documented" || echo "differs from docs/stops.md"
rm -f seen
