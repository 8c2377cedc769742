#!/bin/bash
# FP-191: so do panels as people write them, and the windows that have no text of their own.
export TEST_DIR HOME=$PWD/home KERF_CLOCK=virtual PYTHONPATH="$TEST_DIR/../lib:$TEST_DIR/../../lib:$PYTHONPATH" LC_ALL=C.UTF-8
mkdir home
realtime start 2> /dev/null
halcmd -f ../fp-191-windows-fit-every-screen/net.hal
looks=${LOOKS:-1024x600 en:1:light long:2:dark:touch,1366x768 en:1:dark:touch,3840x2160 fr::dark long:3:dark}
while read -rd, size rest; do
    echo "== $size"
    timeout ${LOOKS:+3}250 ../../lib/with-display "$size" /usr/bin/python3 windows.py $rest 2> errors || { echo "    ended with $?"; cat errors; }
done <<< "$looks,"
realtime stop 2> /dev/null
rm -rf home start.png errors
