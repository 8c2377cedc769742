#!/bin/bash
# HAL text in every form with a Tcl file that runs programs, a rose engine homed to the middle of its disc, tools of a
# program (with and without fixed pockets), files with CRLF and tabs, a pendant that is not there, a laser whose codes wait
# and run subs, a mill with gears on a parallel port, 16 joints on nine letters: each starts, homes, runs its program and stops.
export HALVALUE=2.5
exec ../lib/run-written '^Traceback'
