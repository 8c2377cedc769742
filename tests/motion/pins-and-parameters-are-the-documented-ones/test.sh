#!/bin/bash
# Name, type, direction and initial value of everything motmod creates: with all optional pins,
# with names and numbers for inputs and outputs, at the greatest sizes, and by default.
list() { # MOTMOD-PARAMETERS: what a kinematics with these parameters shows
    cat > machine.tmp.hal <<END
loadrt trivkins coordinates=xyz kinstype=both
loadrt tpmod
loadrt homemod
loadrt motmod $1
show pin
show param
show funct
show thread
END
    halrun -s -f machine.tmp.hal 2>/dev/null | sed -E 's/ (0x)?[0-9a-f]{9,}//g; s/ +/ /g; s/^ //' | sort
}
trap 'rm -f machine.tmp.hal' EXIT
all() { list "num_joints=2 num_extrajoints=1 num_spindles=1 unlock_joints_mask=2 num_misc_error=1 names_dout=a,b names_din=x,y,z num_aio=1"; }
all | grep -vE '^homemod|^$| axis\.[^xw]|__|YES .*thread'
echo "== axes"
all | grep -oE ' axis\.[a-z]\.eoffset$'
echo "== the greatest"
list "num_joints=16 num_spindles=8 num_dio=64 num_aio=64 num_misc_error=64" |
    grep -oE '(joint|spindle)\.[0-9]+\.(pos-cmd|at-speed)$|(digital|analog)-(in|out)-63|misc-error-63' | sort -V
echo "== by default"
list "" | grep -oE 'joint.*\.pos-cmd|spindle.*\.on$|motion\.(digital|analog|misc).*$' | sort -V
echo "== named"
list "num_joints=1 names_ain=volt names_aout=p,q,r names_misc_errors=oil,air" | grep -oE 'motion\.(ain|aout|analog|err|misc|din|dout|digital).*$' | sort -V
echo "== threads"
list "num_joints=1 base_period_nsec=30000 servo_period_nsec=1000000" | grep -E '[0-9] YES .*thread'
