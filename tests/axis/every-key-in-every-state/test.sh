#!/bin/bash
# Every key of the reference's table, and many that must do nothing, in every state: what the machine is told, what the screen shows.
. "$TEST_DIR/../lib/machine.sh"
cat > part.ngc <<'NGC'
G21 G90 G94
G1 X0.1 F60
G1 X300
M2
NGC
run() { # machine, states, [keys]
    echo "== $1"
    STATES=$2 KEYS=${3:-} screen_test $1 keys.py "$PWD/part.ngc"
    cat machine/transcript
    grep -i -A12 traceback screen.err
}
ini_edit='s|^CYCLE_TIME = 0.100|CYCLE_TIME = 20|'
axes="Left Right Up Down bracketleft minus less greater grave 1 x a dollar Home End d v"
run mill "estop unhomed spindle entry run paused"
MENUS=1 run mill ""
run mill "off manual mdi" "F2 F3 F4 F5 F7 F9 F11 b o r t p s Left minus i v Escape Home End space"
run xyza "manual" "$axes"
run lathe "unhomed manual" "$axes"
run gantry "unhomed joint manual mdi" "$axes r"
ini_edit="$ini_edit;s|^HOME = 0|HOME = 100|;s|^HOME_SEARCH|HOME_FINAL_VEL = 5\n&|"      # homing takes its time
run mill "moving mdimoving homing" "F1 F2 F3 F5 F9 Tab r t p s b o l Escape x 5 minus Left KP_4 Home End i"
rm -rf machine home part.ngc screen.log screen.err
