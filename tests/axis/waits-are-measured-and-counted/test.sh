#!/bin/bash
# FP-138: where a machine waits nobody wrote down: spindles, tool changers and users' programs are measured and remembered.
. "$TEST_DIR/../lib/machine.sh"
export PART=$PWD/part.ngc ASKS=$PWD/asks.ngc
cat > part.ngc <<'NGC'
G21 G90 F3000
T1 M6
G43
M3 S6000
G1 X10 Y0 Z0
M5
G4 P4
S3000 M3
G1 X20
S9000
G1 X30
M101
T2 M6
G1 X10
M5
M2
NGC
printf 'G21\nM66 P0 L3 Q5\nM66 P0 L0\nM0\nG0 X1\nM2\n' > asks.ngc
mkdir -p programs; printf '#!/bin/sh\nexec kerf-clock sleep 1.5\n' > programs/M101; chmod +x programs/M101
ini_edit="/^HALFILE = spindle.hal/a HALFILE = $PWD/slow.hal
/^\[RS274NGC\]/a USER_M_PATH = $PWD/programs"
cat > slow.hal <<'HAL'
loadrt timedelay names=changer
addf changer servo-thread
setp changer.on-delay 0.8
unlinkp iocontrol.0.tool-changed
net tool-change => changer.in
net tool-changed changer.out => iocontrol.0.tool-changed
HAL
screen_test mill operator_script.py
cat machine/transcript
grep -i -A8 traceback screen.err
rm -rf machine home programs part.ngc asks.ngc slow.hal screen.log screen.err
