#!/bin/bash
# FP-191: on small screens, at 4K and with letters up to three times as large no text is cut off and no window leaves
# the screen, in no language; letters grow with the screen and give way where it has no room; all colours are readable.
# LOOKS="SCREEN LOOK...[,SCREEN LOOK...]": other ones (scripts/fit-matrix has all).
export HOME=$PWD/home KERF_CLOCK=virtual PYTHONPATH="$TEST_DIR/../lib:$TEST_DIR/../../lib:$PYTHONPATH" LC_ALL=C.UTF-8
mkdir home
realtime start 2> /dev/null
halcmd -f net.hal
printf 'o<pocket> sub\n#<width> = #1 (=40 width, X)\no<pocket> endsub\n' > pocket.ngc
printf 'T1 P1 D10 ;mill\nT2 P2 D6\n' > tool.tbl
printf '[KINS]\nJOINTS = 1\n[HAL]\nHALFILE = t.hal\n[JOINT_0]\nF = 1\nAMPLITUDE = 1\n' > machine.ini
printf 'setp siggen.0.frequency [JOINT_0]F\nsetp siggen.0.amplitude [JOINT_0]AMPLITUDE\n' > t.hal
looks=${LOOKS:-1024x600 de:1:dark long:1:light long:2:dark:touch,1366x768 de:1.5:dark long:1:light:touch,3840x2160 fr::dark long:3:light}
while read -rd, size rest; do
    echo "== $size"
    timeout ${LOOKS:+3}250 ../../lib/with-display "$size" /usr/bin/python3 windows.py $rest || echo "    ended with $?"
done <<< "$looks,"
if [ -z "${LOOKS:-}" ]; then
    echo '== what is the same in every language'
    timeout 100 ../../lib/with-display 1024x600 /usr/bin/python3 windows.py untranslated
fi
realtime stop 2> /dev/null
rm -rf home tool.tbl machine.ini t.hal pocket.ngc
