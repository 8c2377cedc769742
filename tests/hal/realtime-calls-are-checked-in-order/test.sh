#!/bin/bash
# Functions, threads, lists of functions and constructors from a realtime module: checks in
# their documented order, positions, rounding of periods, what `show` makes of it.
. ../module-tree.sh
export KERF_CLOCK=virtual
[ -n "${KERF_CLOCK_SLOT-}" ] || exec kerf-clock run bash "$0"
module_tree rtcheck.c
tree/bin/rtapi_app start >out.txt 2>/dev/null
tree/bin/rtapi_app load rtcheck
halcmd -s show thread | sed 's/^\([0-9]* YES [a-z]*\).*/\1/'
halcmd list funct
halcmd list comp | sed 's/halcmd[0-9]*/halcmd/'
halcmd start
kerf-clock sleep 0.01
halcmd -s show thread | sed 's/^\([0-9]* YES [a-z]*\).*/\1/'
tree/bin/rtapi_app unload rtcheck
halcmd -s show thread | sed 's/^\([0-9]* YES [a-z]*\).*/\1/'
tree/bin/rtapi_app exit
for i in 1 2 3 4 5 6 7 8 9; do tree/bin/rtapi_app ping || break; sleep 0.1; done
sed 's/component [0-9]* not/component N not/' out.txt
rm out.txt
