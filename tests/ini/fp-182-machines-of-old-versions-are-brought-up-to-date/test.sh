#!/bin/bash
# FP-182: an archive of machines of older versions is converted without a question where no display is; each
# then starts, homes and moves. The originals are kept byte for byte, a second conversion changes nothing, and
# converting the originals again gives the same.
unset DISPLAY
here=$PWD; rm -rf work work.first; mkdir work; trap 'rm -rf "$here/work" "$here/work.first"' EXIT
cd work
/usr/bin/python3 ../archive.py
printf 'G20 G90 G0 X0.2\nG1 F60 X0.4\nG0 X0\nM2\n' > part.ngc
cp -r . ../work.first 2>/dev/null; rm -rf ../work.first/work.first
for m in */; do
    m=${m%/}
    linuxcnc_check_ini $m/$m.ini > /dev/null 2>&1; before=$?
    KERF_CLOCK=virtual linuxcnc -r -D true $m/$m.ini < /dev/null > log 2>&1; started=$?
    sum=$(cat $m/$m.ini $m/$m.hal | cksum)
    update_ini $m/$m.ini > again
    diff -r ../work.first/$m $m/$m.old > differences && kept="originals kept" || kept=$(cat differences)
    cp -r $m/$m.old again.$m; update_ini -f again.$m/$m.ini > /dev/null
    [ "$sum" = "$(cat $m/$m.ini $m/$m.hal | cksum)" ] && twice="unchanged by a second run"
    diff again.$m/$m.hal $m/$m.hal && diff <(grep -v '^# Th' again.$m/$m.ini) <(grep -v '^# Th' $m/$m.ini) && same="converts the same again"
    : > run; : > problems; status=0
    # Its joints are not in home-all, so it is homed one by one.
    [ $m = unordered ] || kerf-run --ini $m/$m.ini --picture p.png part.ngc > run 2> problems || status=$?
    echo "$m: before $before, start $started, $kept, $twice, $(cat again), $same, run $status, $(sed -n 's/^Limits *//p' run)"
    [ $started = 0 ] && [ $status = 0 ] || cat log problems
    twice= same=
done
sed -n '/^\[TRAJ\]/,/^\[EMCIO\]/p; /^\[KINS\]/,$p' gantry/gantry.ini
grep -E 'kins|spindle|jog|joint.3' gantry/gantry.hal
grep -hE 'UNITS|MAX_LIMIT' numbers/numbers.ini fraction/fraction.ini | sort | uniq -c
grep -h 'HOME_SEQUENCE' unordered/unordered.ini bridge/bridge.ini
rm -rf ../work.first
