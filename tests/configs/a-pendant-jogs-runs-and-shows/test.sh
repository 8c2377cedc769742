#!/bin/bash
# LIB:xhc-hb04.tcl connects a pendant (its driver is replaced by bin/xhc-hb04) to a machine with X, Y, Z
# and C; C takes the switch's free position.
set -e
here=$PWD; rm -rf work; cp -r pendant work; trap 'rm -rf "$here/work"' EXIT
cd work
sed "/^HALUI/a HALFILE = LIB:basic_sim.tcl -no_use_hal_manualtoolchange\nHALFILE = LIB:xhc-hb04.tcl" machine.ini > m.ini
export KERF_CLOCK=virtual PYTHONPATH=$PWD/../../../task/lib:$PYTHONPATH
linuxcnc -r -D ./operate m.ini < /dev/null > log 2>&1 || { echo "status $?"; tail -n 30 log; }
grep '^xhc-hb04.tcl' log || :
cat out
for change in 's@^jogmode.*@jogmode = vnormal@' 's/^jogmode.*/jogmode = plus-minus/' 's/^jogmode.*/jogmode = wheely/' 's/^HALUI.*//' 's/^layout.*/layout = 3/' \
    's/^coords.*/coords = x y z q/'; do
    echo "= $change"
    sed "$change" m.ini > n.ini
    linuxcnc -r -D true n.ini < /dev/null > log 2>&1 && echo "starts" || grep '^xhc-hb04.tcl' log
done
sed -i 's/^\[HAL\]/[HAL]\nTWOPASS = on/' m.ini
linuxcnc -r -D true m.ini < /dev/null > log 2>&1 && echo "starts with TWOPASS" || cat log
