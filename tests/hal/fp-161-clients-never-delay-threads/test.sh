#!/bin/bash
# A thread's cycle takes no lock: it goes on while a stopped client holds the database lock,
# and while twenty clients ask for everything all the time.
export KERF_CLOCK=real
realtime="$EMC2_HOME/scripts/realtime"
trap '$realtime stop 2>/dev/null' EXIT
$realtime start 2>/dev/null
halcmd loadrt threads name1=t period1=1000000
halcmd start
"$EMC2_HOME/objects/test/hal-robust" beat t.threadbeat
before=$(halcmd getp t.threadbeat)
for n in $(seq 20); do (for k in 1 2 3; do halcmd show all; done >/dev/null) & done
wait $(jobs -p)
after=$(halcmd getp t.threadbeat)
[ "$after" -gt "$before" ] && echo "the thread ran while 20 clients asked"
