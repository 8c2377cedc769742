#!/bin/bash
# FP-190: without a display, with one that does not answer, or without any font, each window says so and ends, within seconds.
printf 'T1 P1\n' > tool.tbl; printf '[HAL]\n' > m.ini; echo '<pyvcp><label><text>"x"</text></label></pyvcp>' > p.xml
printf '<fontconfig><dir>%s/none</dir><cachedir>%s/none</cachedir></fontconfig>\n' "$PWD" "$PWD" > none.conf
export HOME=$PWD
realtime start 2> /dev/null
halcmd loadrt siggen
start_all() { # how it is called here
    for program in halshow "halmeter -s pin siggen.0.sine" "emccalib -ini m.ini" "tooledit tool.tbl" ngcgui monitor-xhc-hb04 "sim_pin siggen.0.amplitude" \
            "halmeter" "/usr/bin/python3 -m kerf.pickconfig" "pyvcp p.xml"; do
        timeout 20 $program < /dev/null > out 2>&1; status=$?
        echo "'$1' ${program%% *}: $status $(grep -v '^Note' out | tail -n 1)"
    done
}
DISPLAY='' start_all ''
DISPLAY=:4711 start_all :4711
export -f start_all
../../lib/with-display env FONTCONFIG_FILE="$PWD/none.conf" bash -c 'start_all "no font"'
realtime stop 2> /dev/null
rm -rf out tool.tbl m.ini p.xml none.conf none
