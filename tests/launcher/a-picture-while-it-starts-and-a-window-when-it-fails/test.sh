#!/bin/bash
# On a display the picture of [DISPLAY]INTRO_GRAPHIC stands in the middle of the screen for INTRO_TIME seconds, or until
# the machine has ended; a start that fails opens a window with what the programs reported.
unset KERF_CLOCK
rm -rf work; mkdir work; export HOME=$(mktemp -d); trap 'cd ..; rm -rf work "$HOME"' EXIT
cd work
/usr/bin/python3 - <<'END'
import sys
sys.path.insert(0, "../../../configs/lib")
from machine import machine
machine("m", "HALFILE = LIB:basic_sim.tcl")
END
cat > look <<'END'
#!/bin/bash
# The display: waits for the picture, and without a word more for its end.
shown() { xdotool search --onlyvisible --class Tk getwindowgeometry 2> /dev/null | tr -d '\n' | grep -qE 'Position: 2[23][0-9],2[23][0-9].*Geometry: 56[0-9]x30[0-9]'; }
until shown; do sleep 0.1; done
echo "the picture is shown"
[ "$3" ] && exit
while shown; do sleep 0.1; done
echo "it has gone by itself"
END
chmod +x look
intro() { sed -i "/^INTRO/d; s,^DISPLAY = axis,&\nINTRO_GRAPHIC = $1\nINTRO_TIME = $2," m/m.ini; }
starts() { timeout 60 ../../../lib/with-display 1024x768 linuxcnc -r -D "$1" m/m.ini 2> err < /dev/null | grep -E 'picture|gone'; }
echo "== some seconds"; intro linuxcnc.gif 2; starts "$PWD/look"
echo "== longer than the machine runs; a picture of its own"
cp "$(dirname "$HALLIB_DIR")/../share/images/linuxcnc.gif" m/own.gif; intro own.gif 600; starts "$PWD/look x"
echo "== a start that fails"
sed -i 's,^HALFILE.*,HALFILE = none.hal,' m/m.ini
cat > fail <<'END'
linuxcnc m/m.ini > log 2>&1 < /dev/null
echo "status $?"
until xdotool search --name 'LinuxCNC terminated' > /dev/null 2>&1; do sleep 0.1; done
echo "the window is there"
xdotool search --name 'LinuxCNC terminated' key Escape
while xdotool search --name 'LinuxCNC terminated' > /dev/null 2>&1; do sleep 0.1; done
echo "and closes"
END
timeout 60 ../../../lib/with-display 1024x768 bash fail
grep -o 'CANNOT FIND FILE FOR:.*' log
ls "$HOME" | grep linuxcnc_ | sed "s,\.$KERF_INSTANCE\$,,"
