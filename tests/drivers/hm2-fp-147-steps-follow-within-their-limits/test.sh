#!/bin/bash
# Times of the pulses are in the board's registers as set, in their order, with more than they hold cut and told;
# the speed never goes above what they allow, nor above maxvel, and never turns its sign. The position follows and
# stops where it was sent.
../../lib/with-hm2-board <<'END'
setp %.stepgen.00.steplen 2000
setp %.stepgen.00.stepspace 3000
setp %.stepgen.00.dirsetup 4000
setp %.stepgen.00.dirhold 5000
setp %.stepgen.01.steplen 1000000
say clocks of 10 ns: direction set-up and hold, length, space
peek 0x2300
peek 0x2400
peek 0x2500
peek 0x2600
peek 0x2504
get %.stepgen.01.steplen
say position
setp %.stepgen.00.position-scale 1000
setp %.stepgen.00.maxaccel 100
setp %.stepgen.00.position-cmd 5
wait 0.01
get %.stepgen.00.position-fb
setp %.stepgen.00.enable 1
wait 0.1
get %.stepgen.00.velocity-fb
wait 1.4
get %.stepgen.00.position-fb
get %.stepgen.00.dbg_step_rate
say maxvel
setp %.stepgen.00.maxvel 2
setp %.stepgen.00.position-cmd -5
wait 1
get %.stepgen.00.velocity-fb
peek 0x2000
wait 5
get %.stepgen.00.position-fb
say more than the pulses allow: 200 kHz, either way
setp %.stepgen.00.maxvel 1e9
setp %.stepgen.00.maxaccel 0
setp %.stepgen.00.control-type 1
setp %.stepgen.00.velocity-cmd 1e9
wait 0.01
get %.stepgen.00.velocity-fb
get %.stepgen.00.maxvel
peek 0x2000
setp %.stepgen.00.velocity-cmd -1e9
wait 0.01
get %.stepgen.00.velocity-fb
setp %.stepgen.00.steplen 0
setp %.stepgen.00.stepspace 0
setp %.stepgen.00.maxvel 0
wait 0.01
get %.stepgen.00.dbg_step_rate
setp %.stepgen.00.velocity-cmd 1e9
wait 0.01
get %.stepgen.00.dbg_step_rate
say disabled: at once
setp %.stepgen.00.enable 0
wait 0.002
peek 0x2000
get %.stepgen.00.velocity-fb
say position-reset, scale 0, wrong type, table
setp %.stepgen.00.position-reset 1
wait 0.002
get %.stepgen.00.position-fb
setp %.stepgen.00.position-scale 0
setp %.stepgen.00.step_type 17
wait 0.002
get %.stepgen.00.position-scale
get %.stepgen.00.step_type
setp %.stepgen.00.step_type 2
peek 0x2200
setp %.stepgen.00.table-data-0 0x44332211
setp %.stepgen.00.step_type 4
peek 0x2200
peek 0x2700
peek 0x2800
END
