#!/bin/bash
# Files as people write them for their machines (keys, menus, pins, pages, defaults, jog pads), with what the reference names.
. "$TEST_DIR/../lib/machine.sh"
printf 'G21\nG1 X10 F600\nG1 X0\nM2\n' > part.ngc
export FILES=$TEST_DIR/files
ini_edit="s|^DISPLAY = .*|&\nUSER_COMMAND_FILE = $FILES/00-pins.py|; s|^CYCLE_TIME = 0.100|CYCLE_TIME = 20|"
screen_test mill screen.py "$PWD/part.ngc"
cat machine/transcript
echo "tracebacks: $(grep -c Traceback screen.err) (that of the mistake)"
rm -rf machine home part.ngc screen.log screen.err
