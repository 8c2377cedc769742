#!/bin/bash
# A machine with all nine axes; A is unlimited and B wrapped.
v=(KINS.KINEMATICS="trivkins coordinates=XYZABCUVW" KINS.JOINTS=9 "TRAJ.COORDINATES=X Y Z A B C U V W" RS274NGC.ORIENT_OFFSET=0
   TRAJ.MAX_LINEAR_VELOCITY=500 TRAJ.MAX_ANGULAR_VELOCITY=1000 AXIS_B.WRAPPED_ROTARY=1)
n=0
for a in X Y Z A B C U V W; do
    type=LINEAR limit=1000
    case $a in A | B | C) type=ANGULAR limit=1e9 ;; esac
    for s in AXIS_$a JOINT_$n; do
        v+=($s.MIN_LIMIT=-$limit $s.MAX_LIMIT=$limit $s.MAX_VELOCITY=500 $s.MAX_ACCELERATION=5000)
    done
    v+=(JOINT_$n.TYPE=$type JOINT_$n.FERROR=1 JOINT_$n.MIN_FERROR=0.5 JOINT_$n.HOME=0 JOINT_$n.HOME_OFFSET=0 JOINT_$n.HOME_SEARCH_VEL=0
        JOINT_$n.HOME_LATCH_VEL=0 JOINT_$n.HOME_SEQUENCE=0)
    n=$((n + 1))
done
h=()
for j in 3 4 5 6 7 8; do h+=(-hal "net fb$j joint.$j.motor-pos-cmd => joint.$j.motor-pos-fb"); done
exec ../../task/lib/machine-test script.py "${v[@]}" "${h[@]}"
