#!/bin/bash
# FP-181: machines of a grid of options (axes, units, homing, backlash) pass the check without a warning, start,
# home and move within their limits.
rm -rf work; mkdir work; trap 'cd ..; rm -rf work' EXIT
cd work
/usr/bin/python3 ../grid.py
for m in */; do
    m=${m%/}
    linuxcnc_check_ini -e $m/m.ini 2>&1 | sed "s/^/$m: /"
    kerf-run --ini $m/m.ini --picture p.png $m/m.ngc > out 2> err
    echo "$m: status $?, limits: $(sed -n 's/^Limits *//p' out)"
    grep -v '^line\|^Note' err || :
done
