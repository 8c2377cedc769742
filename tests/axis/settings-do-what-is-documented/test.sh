#!/bin/bash
# The settings of [DISPLAY] and of the other sections that the screen reads: what each one does, and what is without it.
. "$TEST_DIR/../lib/machine.sh"
screen_test() { # as in the library, with more files beside the INI file
    rm -rf machine home; cp -r "$top/configs/sim/$1" machine; mkdir home
    sed -i "s|^PROGRAM_PREFIX.*|PROGRAM_PREFIX = $top/nc_files|" machine/$1.ini
    sed -i "$ini_edit" machine/$1.ini
    cp "$top/nc_files/star.ngc" machine/; cp "$top/nc_files/foam_wing.ngc" machine/wing.ngc; echo "set from_app yes" > machine/app.tcl; echo "a picture" > "machine/spaced name.spiral"
    printf '*Togl.%s\n' "backplotjog: #00ff00" "backplotjog_alpha: .5" "selected: red" > home/.Xdefaults
    HOME=$PWD/home "$top/tests/lib/with-display" linuxcnc -r -D "$PWD/$2" machine/$1.ini > screen.log 2> screen.err < /dev/null
    echo "status $?"
}
run() { # title, machine
    echo "== $1"
    screen_test $2 settings.py
    sed "s|$PWD|.|g" machine/transcript
    grep -i -A12 traceback screen.err
    grep "^axis:" screen.log | grep -v "without OpenGL" | sed "s|$PWD|.|g"
}
ini_edit='/^OPEN_FILE/d' run "a mill as it is: the built-in program" mill
ini_edit='s|^\[DISPLAY\]|&\nOPEN_FILE = ""|' run "OPEN_FILE = \"\"" xyza
ini_edit='s|^\[DISPLAY\]|&\nOPEN_FILE = gone.ngc|' run "OPEN_FILE = gone.ngc" xyza
ini_edit='s|^\[DISPLAY\]|&\nBACK_TOOL_LATHE = 1\nJOG_AXES = xz\nDRO_FORMAT_MM = %s %s\nGRAPHICAL_MAX_FILE_SIZE = -1|' run "a lathe with the tool behind, a format for two numbers, files of any size" lathe
ini_edit='s|^\[DISPLAY\]|&\nOPEN_FILE = star.ngc\nDEFAULT_ANGULAR_VELOCITY = 20\nMAX_ANGULAR_VELOCITY = 90\nMIN_ANGULAR_VELOCITY = 4\nCONE_BASESIZE = 5\nPOSITION_UNITS = inch\nDRO_FORMAT_IN = %8.2f\nGRAPHICAL_MAX_FILE_SIZE = 0.0001|' run "speeds of a rotary axis, digits of inches, a file too large to draw" xyza
ini_edit='s|^\[DISPLAY\]|&\nOPEN_FILE = ""\nFOAM_Z = 2\nFOAM_W = -8|' run "planes of a foam cutter" foam
ini_edit='s|^\[DISPLAY\]|&\nOPEN_FILE = wing.ngc|' run "planes that are not set" foam

cat > display <<INI
CYCLE_TIME = 50
POSITION_UNITS = inch
POSITION_OFFSET = MACHINE
POSITION_FEEDBACK = COMMANDED
MAX_FEED_OVERRIDE = 2
DEFAULT_LINEAR_VELOCITY = 10
MAX_LINEAR_VELOCITY = 50
MIN_LINEAR_VELOCITY = 0.5
MIN_VELOCITY = 0.25
DEFAULT_SPINDLE_SPEED = 450
INCREMENTS = 1/8 in, 5 mm, 1 cm,20um,100mil, 1/4, .5 inch
GRIDS = 3mm 1/2in
JOG_AXES = ZX
JOG_INVERT = z
HOMING_PROMPT = YES
EDITOR = $PWD/edit.sh -x
TOOL_EDITOR = $PWD/edit.sh
MDI_HISTORY_FILE = $PWD/machine/history.txt
TKAPP = app.tcl
DRO_FORMAT_MM = %7.1f
CONE_BASESIZE = 1.5
DISABLE_CONE_SCALING = 1
GCODE_VIEW_TOOL_MIN_DIA = 0.25
OPEN_FILE = star.ngc
ARCDIVISION = 8
INI
printf '#!/bin/sh\nfor last; do true; done\necho "$last" >> edited.part; [ $(wc -l < edited.part) -lt 2 ] || mv edited.part edited\n' > edit.sh
printf '#!/bin/sh\necho "FILTER_PROGRESS=50" >&2\necho "(made from $(cat "$1"))"; echo "G0 X1"; echo M2\n' > spiral.sh
chmod +x edit.sh spiral.sh
ini_edit="/^\[DISPLAY\]/,/^\[FILTER\]/{
/^DEFAULT_LINEAR\|^MAX_LINEAR\|^POSITION_\|^CYCLE_TIME\|^INCREMENTS\|^EDITOR\|^MAX_FEED\|^MIN_SP\|^MAX_SP/d
}
/^\[DISPLAY\]/r display
s|^PROGRAM_EXTENSION|PROGRAM_EXTENSION = .spiral,.sp\t\tA spiral\nspiral = $PWD/spiral.sh\n&|
s|^\[AXIS_Y\]|&\nTOUCHOFF_ACTUAL = minus|
s|^TASK = milltask|&\nMDI_QUEUED_COMMANDS = 3|"
EVERYTHING=1 run "everything set" mill
rm -rf machine home display edit.sh spiral.sh screen.log screen.err
