#!/bin/bash
# Small rules of buttons, sliders, options and dialogs: disabled means disabled, a step is a whole click, options follow the machine,
# an expression works wherever a number does, and what other programs or the user's code take away does no harm.
. "$TEST_DIR/../lib/machine.sh"
printf 'G21 G90\nG1 X1 F600\n/G1 X2\n' > part.ngc
for y in 3 4 5 6 7; do echo "G1 Y$y"; done >> part.ngc; echo M2 >> part.ngc
ini_edit="s|^EDITOR.*|EDITOR = /nowhere/editor|; s|^\[AXIS_Y\]|&\nTOUCHOFF_ACTUAL = PLUS|; s|^DISPLAY = .*|&\nUSER_COMMAND_FILE = $TEST_DIR/user.py|"
screen_test mill rules.py "$PWD/part.ngc"
cat machine/transcript || cat screen.log screen.err >&2
grep -c Traceback screen.err
cat > extra.ini <<INI
[JOINT_4]
TYPE = LINEAR
MIN_LIMIT = -100
MAX_LIMIT = 100
MAX_VELOCITY = 50
MAX_ACCELERATION = 500
HOME_SEQUENCE = 3
INI
ini_edit="s/^JOINTS = 4/JOINTS = 5/; s/^EMCMOT = motmod.*/EMCMOT = motmod num_extrajoints=1/; \$r $PWD/extra.ini"
screen_test gantry extra.py
cat machine/transcript || cat screen.log screen.err >&2
grep -c Traceback screen.err
rm -rf machine home part.ngc extra.ini screen.log screen.err
