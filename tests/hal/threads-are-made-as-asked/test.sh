#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# `threads`: one thread of 1 ms without arguments, up to three, fastest first; a period of 0 or an
# empty name leaves one out, fpN does nothing; what cannot be made makes the load fail and leaves
# nothing; unloading removes the threads. Each case in a HAL of its own: the first thread decides its clock.
export KERF_CLOCK=virtual
commands=$(mktemp --suffix=.hal)
trap 'rm -f "$commands"' EXIT
threads() {
    echo "-- threads $*"
    cat >"$commands" <<HAL
loadrt threads $*
show thread
unloadrt threads
show thread
list pin
HAL
    halrun -s -k -f "$commands" 2>&1 | grep -v '^Note:\|^$\|^/'
}
threads
threads name1=base period1=50000 fp1=0 name2=servo period2=1000000 name3=slow period3=10000000 fp3=1
threads name1=only period1=0 name2=second period2=2000000
threads 'name1=""' name2=second period2=2000000
threads name1=slow period1=2000000 name2=fast period2=1000000
threads name1=same name2=same period2=1000000
threads name4=x
