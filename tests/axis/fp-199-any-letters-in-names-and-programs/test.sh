#!/bin/bash
# FP-199: folders, INI, HAL, program and comments with letters of any language, in UTF-8 and in bytes that are none: all of it works, texts
# show such bytes escaped. First without a screen in two locales, then the gcode module, then AXIS.
. "$TEST_DIR/../lib/machine.sh"
folder=$PWD/"Fräse Ø"
mkdir "$folder"
cp -r "$top/configs/sim/mill" "$folder/mühle"
(
    cd "$folder/mühle" || exit 1
    mv mill.ini mühle.ini
    mv mill.hal größe.hal
    sed -i 's|mill.hal|größe.hal|; s|^HALUI.*||; s|^DISPLAY *=.*|DISPLAY = ./display|' mühle.ini
    printf '#!/bin/sh\nexec /usr/bin/python3 "%s/display.py" > out 2>&1\n' "$TEST_DIR" > display; chmod +x display
    printf 'G21 G90 (Fräsen: ø 6 mm)\n(MSG, Werkzeug – Fräser)\nG1 X1 F600 ; größer\nM2\n' > 'Teil ü 1.ngc'
    printf 'G21 G90 (Fr\xe4sen)\n(MSG, Fr\xe4ser)\nG1 X2 F600\nM2\n' > $'lat\xe4.ngc'
    printf 'G21 G90\nG1 X2 F600 \xe4\nM2\n' > bad.ngc
    for locale in C.UTF-8 C; do
        echo "== $locale"
        LC_ALL=$locale HOME=$folder KERF_CLOCK=virtual PYTHONPATH="$top/tests/task/lib:$PYTHONPATH" linuxcnc -r mühle.ini > log 2>&1 < /dev/null
        echo "status $?"
        cat out
    done
    echo "== module"
    /usr/bin/python3 "$TEST_DIR/module.py"
)
echo "== AXIS"
program=$PWD/$'lat\xe4.ngc'
cp "$folder/mühle/"$'lat\xe4.ngc' "$program"
screen_test mill screen.py "$program"
cat machine/transcript
grep -i -A8 'traceback\|fault' screen.err
rm -rf machine home "$folder" "$program" screen.log screen.err
