#!/bin/bash
# Each wrong parameter of motmod has its message, and the module does not load.
refused() { # KINEMATICS MOTMOD-PARAMETERS
    echo "-- $2"
    cat > machine.tmp.hal <<END
loadrt $1
loadrt tpmod
loadrt homemod
loadrt motmod $2
END
    halrun -f machine.tmp.hal > result.tmp 2>&1
    echo "status $?"
    grep -A3 -E '^MOTION:' result.tmp | grep -vE '^--|rtapi_app|waitpid|insmod|halcmd|Note|isolated|motmod:' | sed '/^$/d'
}
trap 'rm -f result.tmp machine.tmp.hal' EXIT
I="trivkins coordinates=xyz" B="trivkins coordinates=xyz kinstype=both"
refused "$I" num_joints=0
refused "$I" num_joints=17
refused "$B" "num_joints=3 num_extrajoints=4"
refused "$B" "num_joints=3 num_extrajoints=-1"
refused "$I" "num_joints=3 num_extrajoints=1"
refused "$I" num_spindles=9
refused "$I" num_spindles=-1
refused "$I" "num_dio=3 names_din=a"
refused "$I" "num_aio=3 names_aout=a"
refused "$I" "num_misc_error=3 names_misc_errors=a"
refused "$I" num_dio=65
refused "$I" num_aio=-2
refused "$I" num_misc_error=65
refused "$I" "base_period_nsec=2000000 servo_period_nsec=1000000"
