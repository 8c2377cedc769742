#!/bin/bash
# As set, the other way round, and with a word that is none. Joint 0 coasts while sum2.0.in1 is
# not 0: its command follows the feedback then.
run() {
    ../lib/machine-test script.py JOINT_0.FERROR=4 JOINT_0.MIN_FERROR=4 "$@" -hal '!net x-pos' -hal 'loadrt sum2' -hal 'addf sum2.0 servo-thread' \
        -hal 'net x-cmd joint.0.motor-pos-cmd => sum2.0.in0' -hal 'net x-fb sum2.0.out => joint.0.motor-pos-fb'
}
echo "== as it comes"; run
echo "== the other way round"
run TASK.LIMIT_SWITCH_SPINDLE=rest TASK.AMP_FAULT_SPINDLE=REST TASK.FOLLOWING_ERROR_SPINDLE=OFF TASK.LIMIT_SWITCH_RETRACT=AUTO
echo "== left by hand"; run TASK.LIMIT_SWITCH_RETRACT=NO
echo "== a mistake"
run TASK.LIMIT_SWITCH_SPINDLE=SOON | grep -E "must be|did not start"
