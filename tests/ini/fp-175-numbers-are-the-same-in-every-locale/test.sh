#!/bin/bash
# FP-175 (entry fields: the tests of touch-off, tooledit and halshow): where the decimal sign is a comma, programs read and write numbers with a point all the same; a
# comma in a number is pointed out, never taken for thousands.
rm -rf work; mkdir work; trap 'rm -rf work' EXIT
localedef -c -i es_ES -f UTF-8 work/es_ES.UTF-8 2> /dev/null
export LOCPATH=$PWD/work
LC_ALL=es_ES.UTF-8; export LC_ALL
printf '[TUNE]\nSCALE = 160.5\nBAD = 120,0\n' > work/a.ini
for v in SCALE BAD; do inivalue --sec=TUNE --var=$v --type=real work/a.ini 2>&1 | sed "s,$PWD/,,"; done
cat > work/a.hal <<'END'
loadrt scale
setp scale.0.gain [TUNE]SCALE
getp scale.0.gain
setp scale.0.gain 120,0
END
halrun -i work/a.ini -f work/a.hal 2>&1 | grep -v -i "^Note\|realtime\|posix\|override\|capabilit\|setcap" | sed "s,$PWD/,,"
/usr/bin/python3 - <<'END'
import locale
locale.setlocale(locale.LC_ALL, "")
import linuxcnc
ini = linuxcnc.ini("work/a.ini")
print(locale.localeconv()["decimal_point"], ini.getreal("TUNE", "SCALE"))
END
printf 'G21 G90 G0 X1.5\nF100.25 G1 X2.5\nM2\n' > work/a.ngc
rs274 -g work/a.ngc | grep -E 'STRAIGHT|FEED_RATE'
kerf-run --ini ../../../configs/sim/mill/mill.ini --picture work/p.png work/a.ngc 2> /dev/null | grep Final
