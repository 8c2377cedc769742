#!/bin/bash
# halmeter: texts of all types, choosing with a click, small windows, options and what is wrong with them.
export HOME=$PWD KERF_CLOCK=virtual PYTHONPATH="$TEST_DIR/../../lib:$PYTHONPATH"
realtime start 2> /dev/null
halcmd loadrt siggen num_chan=1; halcmd loadrt and2 count=1
for t in bit float s32 u32 s64 u64; do halcmd newsig x-$t $t; done
halcmd newsig z-pipe port; halcmd sets x-s32 -5; halcmd sets x-u32 255; halcmd sets x-s64 -9000000000; halcmd sets x-u64 18446744073709551615; halcmd sets x-float 0.1; halcmd sets x-bit 1
LC_ALL=C.UTF-8 timeout 60 "$TEST_DIR/../../lib/with-display" /usr/bin/python3 clicks.py 2> said
grep -c "invalid port" said; rm said      # once for each list of all signals
for words in "-s" "wire x" "pin" "-g 5" "-x"; do halmeter $words 2>&1 | sed -n 1p; done
timeout 30 "$TEST_DIR/../../lib/with-display" bash -c 'halmeter -s pin no.such; echo "status $?"
    halmeter pin and2.0.in0 & pid=$!
    for i in $(seq 100); do halcmd show comp | grep -q "halmeter-$pid" && break; sleep 0.1; done
    halcmd show comp | grep -c "halmeter-$pid"; sleep 0.3; kill $pid; wait $pid; echo "status $?"; halcmd show comp | grep -c "halmeter-$pid"' 2>&1
realtime stop 2> /dev/null
