#!/bin/bash
# FP-191: on small screens, at 4K and with letters up to three times as large no text is cut off and no window
# leaves the screen, in no language; letters grow with the screen; the dark colours are readable.
export HOME=$PWD/home KERF_CLOCK=virtual PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH"
mkdir home
realtime start 2> /dev/null
halcmd -f net.hal
printf 'o<pocket> sub\n#<width> = #1 (=40 width, X)\no<pocket> endsub\n' > pocket.ngc
printf 'T1 P1 D10 ;mill\nT2 P2 D6\n' > tool.tbl
printf '[KINS]\nJOINTS = 1\n[HAL]\nHALFILE = t.hal\n[JOINT_0]\nF = 1\nAMPLITUDE = 1\n' > machine.ini
printf 'setp siggen.0.frequency [JOINT_0]F\nsetp siggen.0.amplitude [JOINT_0]AMPLITUDE\n' > t.hal
for screen in 1024x600:1:light 1024x600:1:light:de 1024x600:1:dark:fr 1366x768:1.5:dark 3840x2160::dark 3840x2160:3:light; do
    IFS=: read -r size scale theme language <<< "$screen"
    echo "== $size, scale ${scale:-of the screen}, $theme${language:+, $language}"
    KERF_SCALE=$scale KERF_THEME=$theme LANGUAGE=$language LC_ALL=C.UTF-8 timeout 100 ../../lib/with-display "$size" /usr/bin/python3 windows.py
done
echo '== what is the same in every language'
timeout 100 ../../lib/with-display 1024x600 /usr/bin/python3 windows.py untranslated
realtime stop 2> /dev/null
rm -rf home tool.tbl machine.ini t.hal pocket.ngc
