#!/bin/bash
# Registers of PWM generators for each output type, with the resolution that the frequency leaves.
../../lib/with-hm2-board <<'END'
say 20 kHz of 200 MHz: 12 bits; mode is double buffered
peek 0x4100
peek 0x4200
peek 0x4300
setp %.pwmgen.00.scale 10
setp %.pwmgen.00.value 5
peek 0x4000
setp %.pwmgen.00.enable 1
peek 0x4000
peek 0x4400
setp %.pwmgen.00.value -10
peek 0x4000
setp %.pwmgen.00.value 1000
peek 0x4000
say output types
setp %.pwmgen.00.output-type 2
peek 0x4100
setp %.pwmgen.00.output-type 3
peek 0x4100
setp %.pwmgen.00.output-type 4
peek 0x4100
setp %.pwmgen.00.output-type 5
wait 0.002
get %.pwmgen.00.output-type
say offset mode: half is zero
setp %.pwmgen.00.offset-mode 1
setp %.pwmgen.00.value 0
peek 0x4000
say frequencies: 100 kHz has 10 bits; what the clock cannot do is told
setp %.pwmgen.pwm_frequency 100000
peek 0x4100
peek 0x4200
setp %.pwmgen.pwm_frequency 1000000
wait 0.002
get %.pwmgen.pwm_frequency
peek 0x4200
setp %.pwmgen.pwm_frequency 0
setp %.pwmgen.pdm_frequency 0
wait 0.002
get %.pwmgen.pwm_frequency
get %.pwmgen.pdm_frequency
END
