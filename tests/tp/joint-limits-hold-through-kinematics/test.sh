#!/bin/bash
# Joints with limits of their own behind linear and other kinematics: the positions of the joints are
# differentiated, with and without limits of jerk, in random programs and events.
status=0
for kins in gantry corexy delta five-axis scara; do
    for jerk in "" -j; do
        echo "$kins $jerk"
        "$EMC2_HOME"/objects/test/tp-property $jerk -k $kins -n 5 || status=1
    done
done
exit $status
