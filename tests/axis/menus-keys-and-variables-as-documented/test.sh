#!/bin/bash
# What the reference lists, on a machine with trivial and one with other kinematics: menus in order with accelerators,
# tool bar, tabs, variables, Tcl globals, keys that are bound, preferences and their defaults.
. "$TEST_DIR/../lib/machine.sh"
for machine in mill xyza lathe gantry; do
    echo "== $machine"
    screen_test $machine list.py
    cat machine/transcript
    grep -i -A8 traceback screen.err
done
rm -rf machine home screen.log screen.err
