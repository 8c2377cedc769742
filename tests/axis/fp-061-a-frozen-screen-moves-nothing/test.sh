#!/bin/bash
# FP-061: the process of the screen is stopped (SIGSTOP) while a jog key or button is held: the axis stops, the reason is told. When it goes on,
# with the key held or let go meanwhile, nothing starts by itself, also not what was typed meanwhile. Up to there the speed is constant.
. "$TEST_DIR/../lib/machine.sh"
export KERF_CLOCK=virtual:0.1  # the screen is beside it, in wall time
rm -rf machine home seen slow state; cp -r "$top/configs/sim/xyza" machine; mkdir home
cp hand.py machine/; cp axisrc home/.axisrc
cat > machine/screen <<'SH'
#!/bin/sh
/usr/bin/python3 -c 'from kerf import clock; clock.join("screen"); clock.leave()'   # has no place in the order
KERF_CLOCK=real exec axis "$@"
SH
chmod +x machine/screen
sed -i 's|^\[HAL\]|[APPLICATIONS]\nAPP = ./hand.py\n[HAL]|; s|^DISPLAY *=.*|DISPLAY = ./screen|; s|^PROGRAM_PREFIX.*|PROGRAM_PREFIX = .|' machine/xyza.ini
HOME=$PWD/home "$top/tests/lib/with-display" linuxcnc -r machine/xyza.ini > screen.log 2> screen.err < /dev/null
echo "status $?"
cat seen
grep -i -A12 traceback screen.err screen.log
rm -rf machine home seen slow state screen.log screen.err
