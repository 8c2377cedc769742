#!/bin/bash
glue=PYTHON.PATH_PREPEND=$EMC2_HOME/nc_files/remap_lib/python-stdglue
echo "machine in mm"
../lib/machine-test script.py -machine remap "$glue" || exit
echo "machine in inches"
exec ../lib/machine-test script.py -machine remap "$glue" TRAJ.LINEAR_UNITS=inch "RS274NGC.RS274NGC_STARTUP_CODE=G17 G20 G40 G49 G54 G80 G90 G94 G97" \
    TOOLSENSOR.X=12 TOOLSENSOR.Y=-8 TOOLSENSOR.Z=-2.4 TOOLSENSOR.MAXPROBE=-2.4 TOOLSENSOR.NOSE=-6.3 TOOLSENSOR.SEARCH_VEL=24 \
    TOOLSENSOR.PROBE_VEL=2.4 CHANGE_POSITION.X=0 CHANGE_POSITION.Y=-8 CHANGE_POSITION.Z=6 -hal "setp plate.in0 -4"
