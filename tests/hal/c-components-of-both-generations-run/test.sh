#!/bin/bash
# Two components, legacy and typed, compiled against include/ only: they load, run cycle by
# cycle in one thread with an init function, get instances, and unload while the thread runs.
. ../module-tree.sh
export KERF_CLOCK=virtual
[ -n "${KERF_CLOCK_SLOT-}" ] || exec kerf-clock run bash "$0" # time passes in sleeps only
module_tree oldstyle.c typed.c
tree/bin/rtapi_app start 2>/dev/null
cat > run.hal <<'HAL'
loadrt threads name1=servo period1=1000000
loadrt oldstyle num_chan=2 names=,second
loadrt typed
net a old.0.out typed.0.in
setp old.0.in 3
setp second.limit 2
initf typed.0.begin servo
addf old.0.update servo
addf typed.0.run servo
addf second.update servo 1
show thread
show pin typed old second
show param typed old second
HAL
halcmd -f run.hal | sed 's/^ *[0-9]* /ID /; s/( *[0-9]*, *[0-9]* *)/( T, T )/'
tree/bin/rtapi_app newinst typed extra yes || echo "newinst: $?"
halcmd setp typed.0.offset 1
halcmd addf extra.run servo
halcmd start
kerf-clock sleep 0.0055
halcmd stop
for n in old.0.out old.0.count second.count typed.0.out typed.0.ticks typed.0.bits typed.0.started typed.0.big extra.out servo.threadbeat; do
    echo "$n $(halcmd getp $n)"
done
halcmd start
halcmd unloadrt oldstyle
halcmd -s show thread | sed 's/ [0-9]* [0-9]*$//'
halcmd list pin old second
halcmd unloadrt typed
halcmd unloadrt threads
halcmd show thread
halcmd list pin
halcmd list comp | sed 's/halcmd[0-9]*/halcmd/'
