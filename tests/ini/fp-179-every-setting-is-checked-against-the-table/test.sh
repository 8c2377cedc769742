#!/bin/bash
# FP-179, FP-180 and the units of FP-178: each mistake in a good machine gives one message with file, line
# and what is allowed; with -e the exit status is 1. A clean machine gives none.
rm -rf work; mkdir work; trap 'cd ..; rm -rf work' EXIT
top=$(cd ../../.. && pwd)
cd work
cp "$top"/configs/sim/mill/*.hal "$top"/configs/sim/mill/mill.tbl .
check() { # sed expression
    echo "# $1"
    sed "s,PROGRAM_PREFIX = .*,PROGRAM_PREFIX = .,; $1" "$top/configs/sim/mill/mill.ini" > m.ini
    linuxcnc_check_ini -e m.ini 2>&1
    echo "=> $?"
}
check ''
echo "== names"
check '70,90s/^MIN_FERROR/MIN_FEROR/'
check 's/^\[EMCIO\]/[EMC_IO]/'
check 's/^\[TRAJ\]/&\nMAX_VELOCITY = 3/'
check 's/^\[KINS\]/&\nTOOL_TABLE = x/'
check 's/^\[KINS\]/&\nFAVOURITE_COLOUR = blue/'
check 's/^\[KINS\]/&\nJOINTS = 3/'
check 's/^\[HAL\]/&\nHALCMD = show\nHALCMD = show/'
check 's/^\[JOINT_2\]/[JOINT_7]/'
check 's/^\[AXIS_Z\]/[AXIS_2]/'
check 's/^\[AXIS_Z\]/[AXIS_B]/'
check 's/^\[AXIS_Z\]/[AXIS_z]/'
check 's/^EMCMOT = motmod/& num_spindles=2/'
check 's/coordinates=XYZ/coordinates=XYZY/; s/^COORDINATES.*/COORDINATES = XYZY/'
echo "== the user's own settings, named by a file of the machine, are welcome"
echo 'setp spindle-ramp.maxv [SPINDLE_0]RAMP' > own.hal
check 's/^\[SPINDLE_0\]/&\nRAMP = 2000/; s/^HALFILE = spindle.hal/&\nHALFILE = own.hal/'
echo 'setp spindle-ramp.maxv [MY_RAMP](MAXV)' > own.hal
check 's/^\[SPINDLE_0\]/[MY_RAMP]\nMAXV = 2000\n&/; s/^HALFILE = spindle.hal/&\nHALFILE = own.hal/'
rm own.hal
echo "== values: FP-180"
check 's/^MAX_FEED_OVERRIDE.*/MAX_FEED_OVERRIDE = 1.5 # a comment/'
check 's/^TOOL_TABLE.*/TOOL_TABLE = mill.tbl ; tools/'
check 's/^COORDINATES.*/& ; the letters/; s/coordinates=XYZ//'
check 's/^PARAMETER_FILE.*/& # kept offsets/'
check '70,90s/^FERROR = 1.0/FERROR = 1,5/'
check '70,90s/^FERROR = 1.0/FERROR = 1mm/'
check '70,90s/^FERROR = 1.0/FERROR = one/'
check 's/^COMM_TIMEOUT.*/COMM_TIMEOUT = -1/'
check 's/^DISPLAY = axis/&\nLINEAR_UNITS = FURLONG/'
check 's/^COMM_TIMEOUT/NOTHING = 0\nSHMEM_KEY = x\nCOMM_TIMEOUT/'
check 's/^TASK = milltask/&\nINTERP_MAX_LEN = 0/'
check 's/^\[TRAJ\]/&\nNO_PROBE_JOG_ERROR = perhaps/'
echo "== units: FP-178"
check 's/^MAX_VELOCITY = 60/MAX_VELOCITY = 6000/'
check 's/^LINEAR_UNITS = mm/LINEAR_UNITS = inch/; s/^MAX_LIMIT = 400/MAX_LIMIT = 4000/'
check 's/^SERVO_PERIOD.*/SERVO_PERIOD = 1/'
check 's/^COMM_TIMEOUT.*/BASE_PERIOD = 2000000/'
check '/^\[TASK\]/,/^$/s/^CYCLE_TIME.*/CYCLE_TIME = 10/'
check 's/^MAX_REVERSE_VELOCITY.*/&\nMIN_REVERSE_VELOCITY = 20000/'
check 's/^MAX_FORWARD_VELOCITY.*/MAX_FORWARD_VELOCITY = 0/'
echo "== what does not go together"
check 's/^MIN_LIMIT = -200/MIN_LIMIT = 300/'
check 's/^HOME = 0/HOME = 900/'
check 's/^HOME_SEARCH_VEL = 0/HOME_SEARCH_VEL = 20/'
check '70,90s/^MIN_FERROR = 0.2/MIN_FERROR = 2/'
check 's/^HALUI.*//; $a [HALUI]\nMDI_COMMAND = G0 X0'
check '/^\[TRAJ\]/,/^$/s/^DEFAULT_LINEAR_VELOCITY.*/DEFAULT_LINEAR_VELOCITY = 2000/'
check 's/^TOOL_TABLE.*/&\nTOOL_CHANGE_POSITION = 1 2/'
check 's/^\[DISPLAY\]/&\nEMBED_TAB_NAME = x/'
check 's/^HALFILE = mill.hal/&\nHALFILE =/'
check 's/^EMCMOT = motmod/&\nSHMEM_KEY = 111/'
check 's/^EMCMOT = motmod/& key=111\nSHMEM_KEY = 111/'
echo "== files"
check 's/^HALFILE = mill.hal/HALFILE = mil.hal/'
check 's/^HALFILE = mill.hal/HALFILE = LIB:no.tcl/'
check 's/^TOOL_TABLE.*/TOOL_TABLE = none.tbl/'
check 's/^\[RS274NGC\]/&\nSUBROUTINE_PATH = .:subs\nUSER_M_PATH = mill.tbl/'
check 's/^\[RS274NGC\]/&\nREMAP = M400 modalgroup=10 ngc=m400/'
check 's,^PARAMETER_FILE.*,PARAMETER_FILE = nowhere/p.var,'
check 's/^TASK = milltask/TASK = miltask/'
check 's/^DISPLAY = axis/DISPLAY = ..\/nothing/'
check '$a [PYTHON]\nTOPLEVEL = .'
echo "== macros (FP-078)"
cat > touch.ngc <<'END'
o<touch> sub
G38.3 Z-5 F10
o1 if [#5070 EQ 0]
  (MSG, nothing there: #5070)
o1 endif
g91 G38.2 Z-1 (slow) F2
G0 Z1
o2 if [#5063 GT 3 AND #5070 EQ 1] ; dead
o2 endif
G38.4 Z1
o3 while [# 5070 EQ 0]
o3 endwhile
o<touch> endsub
o<other> sub
o4 if [#5070 EQ 0]
o4 endif
o<other> endsub
END
check ''
rm touch.ngc
echo "== an include is named"
echo 'MIN_FEROR = 3' > joint.inc
check '$a #INCLUDE joint.inc'
linuxcnc_check_ini m.ini > /dev/null 2>&1; echo "without -e: $?"
mkdir folder.ini; touch empty.ini
for f in nowhere.ini folder.ini empty.ini; do linuxcnc_check_ini $f 2>&1; echo "$f: $?"; done
