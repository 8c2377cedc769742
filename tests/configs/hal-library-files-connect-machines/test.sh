#!/bin/bash
# Machines made of files of the HAL library start, home, run a program within their limits and stop.
unset KERF_CLOCK
rm -rf work; mkdir work; trap 'cd ..; rm -rf work' EXIT
cd work
python3 ../machines.py
printf 'G20 G90 G0 X1 Y1\nG1 F60 X2 Z-0.5\nG2 X3 Y2 I1 J0\nG0 Z0\nM2\n' > part.ngc
for m in */; do
    m=${m%/}
    if [ -e $m/connect-only ]; then
        linuxcnc -r -n $m/$m.ini < /dev/null > $m/out 2>&1 && echo "$m: connects" || tail -n 5 $m/out
        continue
    fi
    kerf-run --ini $m/$m.ini --picture p.png part.ngc > $m/out 2> $m/err
    status=$?
    echo "$m: status $status, limits: $(sed -n 's/^Limits *//p' $m/out)"
    [ $status = 0 ] || tail -n 5 $m/err
    [ $status = 0 ] || tail -n 5 $m/err >&2
done
