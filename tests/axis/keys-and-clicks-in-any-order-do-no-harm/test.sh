#!/bin/bash
# A random operator (seeded): keys, clicks, menus, held jog keys, dialogs answered in any way, in any state.
# Never a traceback, no motion that nobody asked for, screen and machine agree. FP-060, FP-061.
. "$TEST_DIR/../lib/machine.sh"
cp "$TEST_DIR/part.txt" part.ngc
screen_test mill random_operator.py "$PWD/part.ngc"
cat machine/transcript
grep -q 'faults: 0' machine/transcript || cat screen.log screen.err >&2
grep -i -A12 traceback screen.err
rm -rf machine home part.ngc screen.log screen.err
