#!/bin/bash
# FP-171: halscope starts, and an operator's clicks do what the window says: first dialog, channels,
# run modes, trigger, mouse, offset, files, prompts, the configuration that stays. The clock is
# virtual at the speed of the wall clock; every step waits for what it should bring about.
export KERF_CLOCK=virtual:4
here=$PWD
scratch=$(mktemp -d)
cat > $scratch/t.hal <<'HAL'
loadrt threads name1=base period1=100000 name2=servo period2=1000000
loadrt siggen
loadrt and2
addf siggen.0.update servo
setp siggen.0.frequency 20
setp siggen.0.amplitude 2
net square siggen.0.square
start
HAL
realtime start 2>/dev/null
halcmd -f $scratch/t.hal
cd $scratch
timeout 100 $here/../../lib/with-display 1100x750 /usr/bin/python3 $here/clicks.py 2>&1
echo "status $?"
cat autosave.halscope
halcmd getp siggen.0.amplitude        # HAL lives on
halcmd stop
halcmd unload all
realtime stop
rm -rf $scratch
