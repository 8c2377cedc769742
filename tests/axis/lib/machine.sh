# SPDX-License-Identifier: GPL-2.0-or-later
# machine.sh: source it. screen_test NAME SCRIPT.py [PROGRAM]: runs a script as the display of a simulated machine.
export KERF_CLOCK=virtual
top=$(cd "$TEST_DIR/../../.." && pwd)
export PYTHONPATH="$top/tests/axis/lib:$top/tests/lib:$PYTHONPATH"
screen_test() { # name of a sample machine (or its folder/name), display script, [program]
    local ini=machine/${1##*/}.ini
    rm -rf machine home; cp -r "$top/configs/sim/${1%/*}" machine; mkdir home
    sed -i "s|^PROGRAM_PREFIX.*|PROGRAM_PREFIX = $top/nc_files|" "$ini"
    [ -z "${ini_edit:-}" ] || sed -i "$ini_edit" "$ini"
    HOME=$PWD/home "$top/tests/lib/${screen_server:-with-display}" ${screen_size:-1024x768} linuxcnc -r -D "$PWD/$2 ${3:-}" "$ini" > screen.log 2> screen.err < /dev/null
    echo "status $?"
}
