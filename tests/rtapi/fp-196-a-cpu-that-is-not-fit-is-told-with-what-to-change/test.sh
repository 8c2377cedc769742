#!/bin/bash
# FP-196: with realtime, the frequency governor and the isolation of CPUs are looked at when it starts and by `verify`.
# The kernel's folder is one of ours.
. ../common.sh
export LINUXCNC_FORCE_REALTIME=1 KERF_SYSFS=$PWD/sys
unset RTAPI_CPU_NUMBER
realtime=$top/scripts/realtime
cpu=$KERF_SYSFS/devices/system/cpu
last=$(($(nproc --all) - 1))
trap '"$realtime" stop 2>/dev/null; rm -rf sys log' EXIT
machine() { # governors of CPU 0 and 1, isolated
    rm -rf sys
    mkdir -p "$cpu"/cpu{0,1}/cpufreq
    echo "$1" > "$cpu/cpu0/cpufreq/scaling_governor"
    echo "$2" > "$cpu/cpu1/cpufreq/scaling_governor"
    echo "$3" > "$cpu/isolated"
}
advice() { grep -A2 -e 'changes its speed' -e 'kept free' | grep -v '^--' | sed "s/isolcpus=$last/isolcpus=LAST/"; }
verify() { echo "== $*"; machine "$@"; "$realtime" verify 2>&1 > /dev/null | advice; }
verify performance performance 1
verify ondemand performance 1
verify performance schedutil 1
verify performance performance ""
verify powersave powersave ""
RTAPI_CPU_NUMBER=0 verify performance ondemand 1
RTAPI_CPU_NUMBER=1 verify performance performance 0-1,3
start() { # its output to a file: it keeps what it is given
    "$realtime" start > log 2>&1
    advice < log
    "$realtime" stop
}
echo "== at the start"
start
machine powersave powersave ""
start
echo "== quiet without realtime, and in virtual time"
LINUXCNC_FORCE_REALTIME=0 start
KERF_CLOCK=virtual start
