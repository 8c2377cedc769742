#!/bin/bash
# Files as people write them for their machines (keys, menus, pins, pages, defaults, jog pads), with what the reference names.
. "$TEST_DIR/../lib/machine.sh"
printf 'G21\nG1 X10 F600\nG1 X0\nM2\n' > part.ngc
export FILES=$TEST_DIR/files
ini_edit="s|^DISPLAY = .*|&\nUSER_COMMAND_FILE = $FILES/00-pins.py|; s|^CYCLE_TIME = 0.100|CYCLE_TIME = 20|"
screen_test mill screen.py "$PWD/part.ngc"
cat machine/transcript
echo "tracebacks: $(grep -c Traceback screen.err) (that of the mistake)"
printf "G21\nG1 X10 F1000\nG1 X0\nM2\n" > part.ngc
for file in "$TEST_DIR"/starts/*; do
    export NUMBER=$(basename "$file" | cut -c1)
    echo "== $(basename "$file")"
    ini_edit="s|^DISPLAY = .*|&\nUSER_COMMAND_FILE = $file|; s|^CYCLE_TIME = 0.100|CYCLE_TIME = 20|"
    screen_test mill starts.py "$PWD/part.ngc"
    cat machine/transcript
    grep -A12 Traceback screen.err
done
rm -rf machine home part.ngc secret.ngc screen.log screen.err
