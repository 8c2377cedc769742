#!/bin/bash
# A random operator (seeded): keys, clicks (fast, double), menus, held jog keys, dialogs answered in any way, in any state, while halui,
# other clients, the safety chain and limit switches do what they like; then task is killed under his hands.
# Never a traceback, no motion that nobody asked for or beyond limits, screen and machine agree. FP-060, FP-061.
. "$TEST_DIR/../lib/machine.sh"
cat > chain.hal <<'HAL'
loadrt and2 names=chain
addf chain servo-thread
unlinkp iocontrol.0.emc-enable-in
net estop-loop chain.in0
setp chain.in1 1
net estop-ok chain.out => iocontrol.0.emc-enable-in
HAL
ini_edit="s|^HALFILE = spindle.hal|&\nHALFILE = $PWD/chain.hal|; s/^MIN_LIMIT = -[34]00/MIN_LIMIT = -40/; s/^MAX_LIMIT = [34]00/MAX_LIMIT = 40/; s/_LIMIT = 200/_LIMIT = 60/"
for kill in -1 ${KILL:-30}; do
    cp "$TEST_DIR/part.txt" part.ngc
    KILL=$kill screen_test mill random_operator.py "$PWD/part.ngc"
    cat machine/transcript
    grep -q 'faults: 0\|tracebacks: 0' machine/transcript || cat screen.log screen.err >&2
    grep -i -A12 traceback screen.err
done
rm -rf machine home part.ngc chain.hal screen.log screen.err
