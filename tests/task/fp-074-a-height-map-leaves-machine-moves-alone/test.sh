#!/bin/bash
exec ../lib/machine-test script.py -file probe_points.txt AXIS_Z.OFFSET_AV_RATIO=0.2 \
    -hal "loadusr -W z_level_compensation" -hal "net height z_level_compensation.counts axis.z.eoffset-counts" \
    -hal "net unit z_level_compensation.scale axis.z.eoffset-scale" -hal "setp z_level_compensation.method 1" \
    -hal "setp axis.z.eoffset-enable 1"
