#!/bin/bash
# hal-histogram: how often a pin has which value, counted each cycle of the thread that handles
# it; bins, tails and figures are those of a known ramp. Nothing of it stays behind.
export KERF_CLOCK=virtual
realtime start 2> /dev/null
kerf-clock run bash -c '
halcmd loadrt threads name1=fast period1=1000000 name2=slow period2=10000000
halcmd loadrt and2 count=1
halcmd loadrt updown count=1
halcmd loadrt not count=1
halcmd addf not.0 fast
halcmd addf updown.0 fast
halcmd net tick not.0.out not.0.in updown.0.countup
halcmd addf and2.0 slow
halcmd setp updown.0.max 9
halcmd setp updown.0.wrap 1
halcmd start
run() { echo "# $*"; hal-histogram --nox "$@" 2>&1; echo "=> $?"; }
run --seconds 1 --binsize 1 --nbins 4 --minvalue 2 updown.0.count
run --seconds 1 --binsize 1 --nbins 2 --legacy not.0.out
run --seconds 1 --minvalue 0 --binsize 10 --nbins 3 slow.threadbeat
run no.such.pin
run --nbins 0 updown.0.count 2>&1 | tail -2
run --binsize 0 updown.0.count 2>&1 | tail -2
echo left: $(halcmd list sig)
halcmd list comp histo
halcmd show thread | grep histo
'
halrun -U 2> /dev/null
