#!/bin/bash
# The probe document of machines that do not run, wrong settings, and the ways to end.
unset INI_FILE_NAME
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cat > "$scratch/m.ini" <<INI
[EMC]
MACHINE = five axes
[KINS]
KINEMATICS = xyzac-trt-kins coordinates=XYZAC
JOINTS = 5
[TRAJ]
COORDINATES = XYZAC
LINEAR_UNITS = inch
[AXIS_X]
MIN_LIMIT = -1
MAX_LIMIT = 2
[JOINT_0]
MAX_LIMIT = 2
HOME = 0.5
[JOINT_3]
TYPE = ANGULAR
MIN_LIMIT = -90
[MTCONNECT]
HAL_ITEM = pin=a.b, id=t1, type=TEMPERATURE
HAL_ITEM = pin=a.b, id=t1, type=TEMPERATURE
HAL_ITEM = pin=a.b, id=1t, type=TEMPERATURE
HAL_ITEM = pin=a.b, id=t2, type=WARMTH
HAL_ITEM = pin=a.b, type=LOAD
HAL_ITEM = pin=a.b, id=pos_x, type=LOAD
HAL_ITEM = pin=a.b, id=t3, type=LOAD, component=axis_c, subType=ACTUAL, units=PERCENT, name=drive C
HAL_ITEM = pin=a.b, id=t4, type=LOAD, component=roof
MODEL_AUTO = 1
MODEL_CHAIN = ZXYAC
MODEL_PARENT_C = BASE
MODEL_PARENT_SPINDLE = Z
MODEL_INVERT = X
MODEL_Z = z.obj
MODEL_Y = y.txt
INI
touch "$scratch/z.obj"
mtconnect-agent "$scratch/m.ini" --dump-probe 2>&1 >"$scratch/probe.xml"; echo "status $?"
/usr/bin/python3 show.py "$scratch/probe.xml"
mtconnect-agent 2>/dev/null; echo "no INI: $?"
mtconnect-agent "$scratch/none.ini" 2>/dev/null; echo "no file: $?"
printf '[MTCONNECT]\nENABLE = 0\n' > "$scratch/off.ini"
INI_FILE_NAME="$scratch/off.ini" mtconnect-agent; echo "off: $?"
