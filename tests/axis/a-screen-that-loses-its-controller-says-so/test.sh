#!/bin/bash
# The screen says when what it shows is old: task is stopped (SIGSTOP) and goes on; AXIS on another computer loses its server while
# a jog key is held. No traceback, no jog goes on.
. "$TEST_DIR/../lib/machine.sh"
export KERF_CLOCK=virtual:1     # real programs beside the machine
rm -rf machine home seen far.log state; cp -r "$top/configs/sim/mill" machine; mkdir home
cp axisrc home/.axisrc
printf '#!/bin/sh\nexec /usr/bin/python3 %s/far.py\n' "$PWD" > machine/far; chmod +x machine/far
HOME=$PWD/home "$top/tests/lib/with-display" linuxcnc -r -D ./far machine/mill.ini > screen.log 2> screen.err < /dev/null
echo "status $?"
cat seen
grep -i -A12 traceback screen.err screen.log far.log
rm -rf machine home seen state far.log screen.log screen.err
