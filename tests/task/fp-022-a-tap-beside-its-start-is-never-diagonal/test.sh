#!/bin/bash
exec ../lib/machine-test script.py -hal "loadrt sim_spindle" -hal "addf sim-spindle.0 servo-thread" \
    -hal "net spindle-turns spindle.0.speed-out-rps => sim-spindle.0.velocity-cmd" \
    -hal "net spindle-revs sim-spindle.0.position-fb => spindle.0.revs" -hal "net spindle-index sim-spindle.0.index-enable <=> spindle.0.index-enable"
