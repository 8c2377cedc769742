#!/bin/bash
# Values of all types from halstreamer through streamer, sampler and halsampler: what comes in
# one cycle goes out in that cycle; full and empty queues are counted; clock modes.
export KERF_CLOCK=virtual
[ -n "${KERF_CLOCK_SLOT-}" ] || exec kerf-clock run bash "$0"
realtime="$EMC2_HOME/scripts/realtime"
trap '$realtime stop 2>/dev/null; rm -f setup.hal' EXIT
$realtime start >/dev/null 2>&1
cat > setup.hal <<'HAL'
loadrt threads name1=t period1=1000000
loadrt streamer depth=5,8 cfg=fbsulk,b
loadrt sampler depth=100,4 cfg=FBSULK,bs
addf streamer.0 t
addf sampler.0 t
addf sampler.1 t
net f streamer.0.pin.0 sampler.0.pin.0
net b streamer.0.pin.1 sampler.0.pin.1 sampler.1.pin.0
net s streamer.0.pin.2 sampler.0.pin.2 sampler.1.pin.1
net u streamer.0.pin.3 sampler.0.pin.3
net l streamer.0.pin.4 sampler.0.pin.4
net k streamer.0.pin.5 sampler.0.pin.5
HAL
halcmd -f setup.hal
halcmd show pin streamer.0 sampler.1 | sed 's/^ *[0-9]* / /'
halstreamer <<'END'
# a comment
0.5 1 -1 4000000000 -9000000000000000000 18000000000000000000
1e3 0 2147483647 0 9000000000000000000 0
bad 0 0 0 0 0
1 2 0 0 0 0
1 1
1 1 1x 0 0 0
-0.25 1 -2147483648 1 0 1 extra
END
echo "halstreamer: $?"
halcmd start
kerf-clock sleep 0.0065
halcmd stop
halcmd show pin streamer.0.curr streamer.0.empty streamer.0.under sampler.*.full sampler.*.curr sampler.*.over | sed 's/^ *[0-9]* / /'
halsampler -t -n 6
halsampler -c1 -n 3 -t out.txt; echo "halsampler: $?"; cat out.txt; rm out.txt
halsampler -n0; echo "halsampler: $?"
# Clock modes of streamer 1: the queue has 0 1 0 1 0 1; edges of `clock` move it on.
halcmd setp streamer.1.clock-mode 2
printf '0\n1\n0\n1\n0\n1\n' | halstreamer -c 1
halcmd addf streamer.1 t
for value in 1 1 0 1 0 0 1; do
    halcmd setp streamer.1.clock $value
    halcmd start; kerf-clock sleep 0.001; halcmd stop
    echo "clock $value depth $(halcmd getp streamer.1.curr-depth) out $(halcmd getp streamer.1.pin.0)"
done
