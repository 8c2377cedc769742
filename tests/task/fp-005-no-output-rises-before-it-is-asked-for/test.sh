#!/bin/bash
# Every output of motion and I/O has a flip-flop of its own that would keep the shortest pulse, from the first cycle on.
outputs="spindle.0.on spindle.0.forward spindle.0.reverse iocontrol.0.coolant-flood iocontrol.0.coolant-mist iocontrol.0.tool-change
iocontrol.0.tool-prepare iocontrol.0.user-enable-out joint.0.amp-enable-out joint.1.amp-enable-out motion.digital-out-00 motion.digital-out-63 motion.motion-enabled"
words=(-hal "loadrt flipflop count=$(wc -w <<< "$outputs")")
n=0
for o in $outputs; do
    words+=(-hal "addf flipflop.$n servo-thread" -hal "net seen-$n $o flipflop.$n.set")
    case $o in
    iocontrol.0.user-enable-out) words[-1]="net estop-loop flipflop.$n.set" ;;
    iocontrol.0.tool-prepare) words[-1]="net tool-prepare flipflop.$n.set" ;;
    iocontrol.0.tool-change) words[-1]="net tool-change flipflop.$n.set" ;;
    esac
    n=$((n + 1))
done
OUTPUTS=$(echo $outputs) exec ../lib/machine-test script.py "$@" TRAJ.NO_FORCE_HOMING=1 EMCMOT.EMCMOT="motmod num_dio=64" HAL.HALUI=halui "${words[@]}"
