#!/bin/bash
# Remapped built-in codes, codes and subs in Python, wear by tool number, HAL in two passes, extra joints, a locking
# indexer, shared home switches, switchable kinematics, random tools, two spindles, a cutter, an INI file of version 1.0:
# each machine starts, homes, runs its program within its limits and stops.
unset KERF_CLOCK DISPLAY
rm -rf work; mkdir work; trap 'cd ..; rm -rf work' EXIT
cd work
/usr/bin/python3 ../machines.py "$LINUXCNC_NCFILES_DIR/remap_lib/python-stdglue"
for m in */; do
    m=${m%/}
    timeout 60 kerf-run --ini $m/$m.ini --picture p.png $m/part.ngc > out 2> err
    status=$?
    echo "$m: status $status, limits: $(sed -n 's/^Limits *//p' out)"
    grep -h '^ *P is\|^[xy]=' out err | sort -u
    [ $status = 0 ] || tail -n 5 err
done
