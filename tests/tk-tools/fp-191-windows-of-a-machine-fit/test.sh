#!/bin/bash
# FP-191: so do those that need a running machine, with all that they open: tests/tk-tools/fp-191-windows-fit-every-screen.
export PYTHONPATH="$TEST_DIR/../lib:$TEST_DIR/../../lib:$PYTHONPATH" LC_ALL=C.UTF-8
looks=${LOOKS:-1024x600 long:1:light de:2:dark:touch,3840x2160 fr::dark}
while read -rd, size rest; do
    echo "== $size"
    FIT_LOOKS=$rest timeout ${LOOKS:+3}250 ../../lib/with-display "$size" ../../task/lib/machine-test script.py "DISPLAY.INCREMENTS=1mm, .1in, 1/16in" || echo "    ended with $?"
done <<< "$looks,"
