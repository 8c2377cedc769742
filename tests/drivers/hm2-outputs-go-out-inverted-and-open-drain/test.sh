#!/bin/bash
# A pin is an input until is_output; what the board's pins drive is read back by registers of the simulated board
# (0xF240 levels, 0xF260 driven) and of the firmware (DDR, alternate source, open drain, invert).
../../lib/with-hm2-board <<'END'
poke 0xF200 0x9
wait 0.003
say inputs
get %.gpio.000.in
get %.gpio.000.in_not
get %.gpio.001.in
get %.gpio.003.in
say out is not driven before is_output
setp %.gpio.000.out 1
setp %.gpio.001.out 1
peek 0xF260
setp %.gpio.000.is_output 1
setp %.gpio.001.is_output 1
setp %.gpio.001.invert_output 1
setp %.gpio.002.is_output 1
setp %.gpio.002.is_opendrain 1
setp %.gpio.002.out 1
setp %.gpio.003.is_opendrain 1
setp %.gpio.003.invert_output 1
say 0 drives high, 1 low, 2 floats, 3 is an input
peek 0x1100
peek 0x1300
peek 0x1400
peek 0x1200
peek 0xF240
peek 0xF260
get %.gpio.001.in
setp %.gpio.002.out 0
say 2 drives low; the step pin of stepgen 0 is inverted by its own name and by that of the pin
setp %.stepgen.00.step.invert_output 1
peek 0xF260
peek 0x1400
setp %.gpio.011.invert_output 0
peek 0x1400
say lamps
setp %.led.CR01 1
setp %.led.CR04 1
peek 0x0200
END
