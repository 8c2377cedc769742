#!/bin/bash
# A wizard's stepper, the same of version 1.0, a gantry, a lathe with encoder, a foam cutter in Tcl with arguments, an arm by
# Denavit-Hartenberg numbers, a tool changer with codes of its own, ladder logic, servos with included and sourced files, a
# panel of Python programs: each starts, homes, runs its program within its limits and stops. A card that is not there is named.
unset KERF_CLOCK DISPLAY
rm -rf work; mkdir work; trap 'cd ..; rm -rf work' EXIT
cd work
/usr/bin/python3 ../machines.py
for m in */; do
    m=${m%/}
    timeout 60 kerf-run --ini $m/$m.ini --picture p.png $m/part.ngc > out 2> err
    status=$?
    echo "$m: status $status, limits: $(sed -n 's/^Limits *//p' out)"
    grep -h '^ *P is\|^M111\|no such module' out err | sort -u
    [ $status = 0 ] || tail -n 8 err >&2
done
