#!/bin/bash
# hal.query on a running system with threads, functions, aliases and links.
export KERF_CLOCK=virtual
[ -n "${KERF_CLOCK_SLOT-}" ] || exec kerf-clock run bash "$0"
realtime="$EMC2_HOME/scripts/realtime"
trap '$realtime stop >/dev/null 2>&1' EXIT
$realtime start >/dev/null 2>&1
halcmd loadrt threads name1=fast period1=500000 name2=slow period2=2000000
halcmd loadrt and2 names=x,y
halcmd addf x fast
halcmd addf y fast 1
halcmd initf x slow
halcmd net sig x.out y.in0
halcmd alias pin y.out result
halcmd alias param x.tmax slowest
/usr/bin/python3 test.py
