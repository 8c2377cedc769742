#!/bin/bash
# A random operator (SEED, STEPS; MACHINE: lathe, gantry, xyza, foam, fiveaxis/head-table): keys, clicks (fast, double),
# drags, menus, held jog keys, fields of a panel, dialogs answered in any way, in any state, while halui, other clients,
# axis-remote, the desktop, the safety chain and limit switches do what they like; then task is killed under his hands.
# Never a traceback; nothing moves, turns or flows that nobody asked for, or beyond limits; the whole screen agrees with
# the machine. FP-060, FP-061.
. "$TEST_DIR/../lib/machine.sh"
cat > chain.hal <<'HAL'
loadrt and2 names=chain
addf chain servo-thread
unlinkp iocontrol.0.emc-enable-in
net estop-loop chain.in0
setp chain.in1 1
net estop-ok chain.out => iocontrol.0.emc-enable-in
HAL
machine=${MACHINE:-mill}
ini_edit="s|^HALUI|HALFILE = $PWD/chain.hal\n&|; s|^CYCLE_TIME = 0.100|CYCLE_TIME = 20|"
[ $machine != mill ] || ini_edit="$ini_edit; s/^MIN_LIMIT = -[34]00/MIN_LIMIT = -40/; s/^MAX_LIMIT = [34]00/MAX_LIMIT = 40/; s/_LIMIT = 200/_LIMIT = 60/"
for kill in -1 ${KILL:-30}; do
    bash "$TEST_DIR/part-for.sh" $machine "$TEST_DIR/part.txt" > part.ngc
    KILL=$kill screen_test $machine random_operator.py "$PWD/part.ngc"
    grep -v '^axis: ' machine/transcript     # is told on the console
    grep -q 'faults: 0\|tracebacks: 0' machine/transcript || cat screen.log screen.err >&2
    grep -i -A12 traceback screen.err
done
rm -rf machine home part.ngc chain.hal screen.log screen.err
