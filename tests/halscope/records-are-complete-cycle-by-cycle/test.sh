#!/bin/bash
# scope_rt in a thread of 25 us: records hold every cycle, before and after the trigger, and the
# same values as sampler takes in the same cycles. In virtual time.
export KERF_CLOCK=virtual
cat > t.hal <<'HAL'
loadrt threads name1=base period1=25000 name2=slow period2=50000
loadrt siggen
loadrt sampler cfg=lf depth=60000
addf siggen.0.update base
setp siggen.0.frequency 40
net beat base.threadbeat sampler.0.pin.0
net sine siggen.0.sine sampler.0.pin.1
addf sampler.0 base
HAL
realtime start 2>/dev/null
halcmd -f t.hal
PYTHONPATH=../lib:$PYTHONPATH /usr/bin/python3 test.py
halcmd stop
halcmd unload all
realtime stop
rm -f t.hal
