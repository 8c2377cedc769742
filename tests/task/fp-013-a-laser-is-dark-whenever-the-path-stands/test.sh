#!/bin/bash
exec ../lib/machine-test script.py "$@" -hal "loadrt laserpower" -hal "addf laserpower.0 servo-thread" \
    -hal "setp laserpower.0.max-power 100" -hal "setp laserpower.0.vector-power 80" \
    -hal "net wanted motion.requested-vel laserpower.0.req-velocity" -hal "net real motion.current-vel laserpower.0.cur-velocity" \
    -hal "net left motion.distance-to-go laserpower.0.distance-to-go" -hal "net fire spindle.0.on laserpower.0.enabled"
