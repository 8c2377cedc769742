#!/bin/bash
# Sample machines that load a drawn view of themselves: the window opens, its pins are the joints, the picture moves with them.
export KERF_CLOCK=virtual
export HOME=$PWD/home
top=$(cd ../../.. && pwd)
run() { # folder, machine, view, pins
    rm -rf machine home; cp -r "$top/configs/sim/$1" machine; mkdir home
    sed -i 's/^\[TRAJ\]/&\nNO_FORCE_HOMING = 1/' machine/$2.ini
    VIEW=$3 PINS=$4 "$top/tests/lib/with-display" linuxcnc -r -D "$PWD/look.py" machine/$2.ini > run.log 2>&1 < /dev/null || cat run.log
    cat seen 2> /dev/null || cat run.log
    rm -rf machine home seen run.log
}
run fiveaxis table-table xyzac-trt-gui "table-x saddle-y spindle-z tilt-a rotate-c"
run robots puma pumagui "joint1 joint2 joint3 joint4 joint5 joint6"
