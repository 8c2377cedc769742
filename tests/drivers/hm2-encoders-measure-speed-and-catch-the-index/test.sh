#!/bin/bash
# Speed by time stamps, over rates from many counts in a cycle to one in many; 0 after vel-timeout. The index sets the
# position to zero where it was, exactly; quadrature errors are told and stay.
../../lib/with-hm2-board <<'END'
setp %.encoder.00.scale 100
say 10 counts in a cycle of 1 ms
poke 0xF100 655360
wait 0.1
get %.encoder.00.velocity
get %.encoder.00.velocity-rpm
say 1 count in 20 cycles
poke 0xF100 3277
wait 0.3
get %.encoder.00.velocity
say 1 in 200, backwards: the first of them gives 0
poke 0xF100 -328
wait 2.1
get %.encoder.00.velocity
setp %.encoder.00.vel-timeout 0.1
wait 0.4
poke 0xF100 0
wait 0.2
get %.encoder.00.velocity
say position is a hundredth of count
setp %.encoder.00.reset 1
wait 0.002
get %.encoder.00.position
setp %.encoder.00.reset 0
say the index: every 1000 counts
poke 0xF180 1000
poke 0xF100 655360
setp %.encoder.00.index-enable 1
peek 0x3100
wait 0.1
get %.encoder.00.index-enable
get %.encoder.00.rawlatch
get %.encoder.00.position-latched
poke 0xF100 0
wait 0.002
get %.encoder.00.rawcounts
get %.encoder.00.count
get %.encoder.00.position
say no clearing
setp %.encoder.00.no_clear_on_index 1
setp %.encoder.00.index-enable 1
poke 0xF100 655360
wait 0.15
get %.encoder.00.index-enable
poke 0xF100 0
wait 0.002
get %.encoder.00.count
get %.encoder.00.count-latched
say settings
setp %.encoder.01.filter 0
setp %.encoder.01.counter-mode 1
setp %.encoder.01.index-mask 1
setp %.encoder.01.index-mask-invert 1
setp %.encoder.01.index-invert 1
peek 0x3104
peek 0x3400
setp %.encoder.sample-frequency 1000000
peek 0x3400
get %.encoder.sample-frequency
peek 0x3200
setp %.encoder.hires-timestamp 1
peek 0x3200
say quadrature error
poke 0xF1C0 0x8001
wait 0.002
get %.encoder.00.quad-error
get %.encoder.00.input-a
get %.encoder.00.input-b
setp %.encoder.00.quad-error-enable 1
wait 0.004
get %.encoder.00.quad-error
poke 0xF1C0 0
wait 0.002
get %.encoder.00.quad-error
setp %.encoder.00.quad-error-enable 0
wait 0.002
get %.encoder.00.quad-error
setp %.encoder.00.scale 0
wait 0.002
get %.encoder.00.scale
END
