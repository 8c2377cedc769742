#!/bin/bash
# FP-190: without a display, or with one that does not answer, each window says so and ends, within seconds.
printf 'T1 P1\n' > tool.tbl; printf '[HAL]\n' > m.ini
export HOME=$PWD
realtime start 2> /dev/null
halcmd loadrt siggen
for display in "" ":4711"; do
    for program in halshow "halmeter -s pin siggen.0.sine" "emccalib -ini m.ini" "tooledit tool.tbl" ngcgui monitor-xhc-hb04 "sim_pin siggen.0.amplitude" \
            "halmeter" "/usr/bin/python3 -m kerf.pickconfig"; do
        DISPLAY=$display timeout 20 $program < /dev/null > out 2>&1; status=$?
        echo "'$display' ${program%% *}: $status $(grep -v '^Note' out | tail -n 1)"
    done
done
realtime stop 2> /dev/null
rm -f out tool.tbl m.ini
