#!/bin/bash
# Three-phase PWM, RC servos, relays, outputs, inputs, one-shots, period meters, galvanometers, resolvers and the
# DPLL: what the pins ask for is in the registers, and the other way round. The board's registers are memory here.
../../lib/with-hm2-board -b 7I80HD-16 -f full <<'END'
say three-phase PWM: middle, then ends; setup with sample time and dead time
peek 0x5000
setp %.3pwmgen.00.scale 2
setp %.3pwmgen.00.A-value 2
setp %.3pwmgen.00.B-value -9
setp %.3pwmgen.00.C-value 0
peek 0x5000
peek 0x5200
peek 0x5300
say a fault is shown; an enable that the board does not have is asked for again
poke 0x5100 2
get %.3pwmgen.00.fault
setp %.3pwmgen.00.enable 1
peek 0x5100
poke 0x5100 2
get %.3pwmgen.00.fault
peek 0x5100
setp %.3pwmgen.frequency 10000000
wait 0.002
get %.3pwmgen.frequency
say RC servos: 1.5 ms
setp %.rcpwmgen.00.width 90
setp %.rcpwmgen.00.scale 180
setp %.rcpwmgen.00.offset 1
peek 0x5800
peek 0x5900
setp %.rcpwmgen.00.width -900
wait 0.002
get %.rcpwmgen.00.width
setp %.rcpwmgen.rate 5000
wait 0.002
get %.rcpwmgen.rate
say relays and outputs
setp %.ssr.00.out-01 1
setp %.ssr.00.invert-00 1
peek 0x6800
peek 0x6900
setp %.ssr.00.rate 0
peek 0x6900
setp %.outm.00.out-08 1
peek 0x9800
say inputs
poke 0x7A00 0x5
poke 0x7B00 0x4
wait 0.002
get %.inmux.00.input-00
get %.inmux.00.input-01-not
get %.inmux.00.raw-input-00
setp %.inmux.00.input-03-slow 1
peek 0x7900
peek 0x7800
get %.inmux.00.scan_width
setp %.inmux.00.scan_rate 1000000
wait 0.002
get %.inmux.00.scan_rate
say hand wheels: 8 bits that turn over
poke 0x7C00 0x0000FF70
poke 0x7C00 0x000001E0
poke 0x7C00 0x00000150
get %.inmux.00.enc0-count
get %.inmux.00.enc1-count
setp %.inmux.00.enc0-reset 1
wait 0.002
get %.inmux.00.enc0-count
say one-shot
setp %.oneshot.00.width1 2
setp %.oneshot.00.enable1 1
setp %.oneshot.00.trigger_select1 9
setp %.oneshot.00.trigger_select2 4
setp %.oneshot.00.trigger_on_rise2 1
peek 0xA000
peek 0xA200
peek 0xA400
peek 0xA500
get %.oneshot.00.trigger_select1
say period meter: 1 kHz, a quarter on
poke 0xA900 100000
poke 0xAA00 25000
wait 0.002
get %.periodm.00.frequency
get %.periodm.00.period_us
get %.periodm.00.duty_cycle
setp %.periodm.00.averages 9999
setp %.periodm.00.invert 1
wait 0.002
get %.periodm.00.averages
peek 0xA800
get %.periodm.00.minimum_frequency
say galvanometers
peek 0x8E00
setp %.xy2mod.00.posx-cmd 0.5
setp %.xy2mod.00.enable 1
peek 0x8C00
peek 0x8E00
get %.xy2mod.00.posx-fb
say resolvers: a turn and a half
poke 0x7400 0x40000000
wait 0.002
poke 0x7400 0x80000000
wait 0.002
poke 0x7400 0xC0000000
wait 0.002
setp %.resolver.00.index-enable 1
poke 0x7400 0x10000000
wait 0.002
get %.resolver.00.index-enable
get %.resolver.00.position
get %.resolver.00.angle
get %.resolver.00.rawcounts
poke 0x7300 429496730
wait 0.002
get %.resolver.00.velocity
poke 0x7000 0
setp %.resolver.excitation-khz 4.5
wait 0.01
get %.resolver.excitation-khz
peek 0x7000
say DPLL at 1 kHz
get %.dpll.base-freq-khz
get %.dpll.prescale
peek 0x6000
peek 0x6200
peek 0x6300
peek 0x6400
setp %.encoder.timer-number 1
peek 0x3500
setp %.stepgen.timer-number 2
peek 0x2A00
setp %.encoder.muxed-skew 45
wait 0.002
get %.encoder.muxed-skew
peek 0x3400
say step generator with latch: the index leaves the mode register when it came
setp %.stepgen.00.index-enable 1
setp %.stepgen.00.swap_step_dir 1
peek 0x2200
poke 0x2200 0x4
wait 0.002
get %.stepgen.00.index-enable
get %.stepgen.00.position-latch
END
