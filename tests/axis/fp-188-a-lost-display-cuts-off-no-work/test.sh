#!/bin/bash
# FP-188, FP-189: AXIS itself, ended by an exception out of its main loop, then with its X server (a Wayland compositor takes Xwayland with it).
# The program goes on; where the server comes back so does the screen; where it does not, the session ends when the program has.
. "$TEST_DIR/../lib/machine.sh"
export KERF_CLOCK=virtual:5     # real programs beside the machine
rm -rf machine home seen fault; cp -r "$top/configs/sim/mill" machine; mkdir home
cat > machine/part.ngc <<'NGC'
G21 G90
M66 P0 L0
o100 while [#5399 EQ 0]
G1 X10 F1200
G1 X0
M66 P0 L0
o100 endwhile
G1 X5
M2
NGC
cp outsider.py machine/
cat > machine/screen <<'SH'
#!/bin/sh
/usr/bin/python3 -c 'from kerf import clock; clock.join("screen"); clock.leave()'   # has no place in the order
exec axis "$@"
SH
chmod +x machine/screen
cp axisrc home/.axisrc
sed -i 's|^\[HAL\]|[APPLICATIONS]\nAPP = ./outsider.py\n[HAL]|; s|^PROGRAM_PREFIX.*|PROGRAM_PREFIX = .|; s|^DISPLAY *=.*|DISPLAY = ./screen\nOPEN_FILE = part.ngc\nPREVIEW_TIMEOUT = 1|' machine/mill.ini
number=$((1000 + $$ % 30000))    # nobody else's server may take the number of one that is gone
export DISPLAY=:$number
Xvfb $DISPLAY -screen 0 1024x768x24 -nolisten tcp -noreset -nolock 2> /dev/null &
export SERVER=$!
for _ in $(seq 400); do [ -S /tmp/.X11-unix/X$number ] && break; sleep 0.05; done
HOME=$PWD/home linuxcnc -r machine/mill.ini > screen.log 2> screen.err < /dev/null
echo "status $?"
kill $SERVER 2> /dev/null
rm -f /tmp/.X11-unix/X$number /tmp/.X$number-lock
cat seen
grep -h "screen crashed\|stopping everything" screen.err | sed 's/the machine, end process.*/the machine, end process N/' | sort -u
grep -l "RuntimeError: out of the main loop" home/.axis_reports/* | wc -l
ls /tmp/linuxcnc.lock.$KERF_INSTANCE 2> /dev/null
rm -rf machine home seen fault screen.log screen.err
