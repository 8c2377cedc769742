#!/bin/bash
# The board's watchdog runs from the first write on and only writes pet it. When it bites, outputs let go, has_bit
# rises and the cause is told, once; nothing goes out until the operator clears has_bit, then everything is written
# again.
../../lib/with-hm2-board <<'END' | sed 's/threadbeat =[1-9][0-9]*/threadbeat goes on/'
get %.watchdog.has_bit
setp %.gpio.000.is_output 1
setp %.gpio.000.out 1
peek 0x0C00
get %.gpio.000.in
say no packet for 10 ms
poke 0xF00C 10000000
wait 0.002
get %.watchdog.has_bit
peek 0xF260
wait 1
get %.watchdog.has_bit
get %.gpio.000.in
say the operator answers
setp %.watchdog.has_bit 0
wait 0.005
get %.watchdog.has_bit
peek 0xF260
wait 1
get %.watchdog.has_bit
get %.gpio.000.in
say has_bit set by hand: nothing pets any more
setp %.watchdog.has_bit 1
wait 0.02
peek 0x0D00
peek 0xF260
setp %.watchdog.has_bit 0
wait 0.01
peek 0x0D00
say a time that is shorter than one and a half periods is told
setp %.watchdog.timeout_ns 1400000
wait 0.01
peek 0x0C00
say without writes it bites
delf %.write servo
wait 0.01
get %.watchdog.has_bit
say the driver goes while the thread runs: the thread goes on
unloadrt hm2_eth
wait 0.01
get servo.threadbeat
END
