#!/bin/bash
rig=(-hal "!net [xyz]-pos" -hal "loadrt sim_joint count=3" -hal "setp sim-joint.0.home-from 10" -hal "setp sim-joint.1.start 7")
for j in 0 1 2; do
    rig+=(-hal "addf sim-joint.$j.read servo-thread 1" -hal "addf sim-joint.$j.write servo-thread"
          -hal "net cmd$j joint.$j.motor-pos-cmd => sim-joint.$j.cmd" -hal "net fb$j sim-joint.$j.fb => joint.$j.motor-pos-fb"
          -hal "net home$j sim-joint.$j.home-sw => joint.$j.home-sw-in")
done
settings=(JOINT_0.HOME_SEARCH_VEL=20 JOINT_0.HOME_LATCH_VEL=2 JOINT_0.HOME_OFFSET=5 JOINT_0.HOME=1 JOINT_0.HOME_FINAL_VEL=10
          JOINT_1.HOME_OFFSET=3 JOINT_1.HOME=4 JOINT_2.VOLATILE_HOME=1 JOINT_2.HOME_OFFSET=2 JOINT_2.HOME=2)
for absolute in 1 2; do
    echo "== HOME_ABSOLUTE_ENCODER=$absolute"
    ../../task/lib/machine-test script.py "${settings[@]}" JOINT_1.HOME_ABSOLUTE_ENCODER=$absolute "${rig[@]}" || exit 1
done
echo "== HOMEMOD=homecomp"
../../task/lib/machine-test script.py EMCMOT.HOMEMOD=homecomp "${rig[@]}"
