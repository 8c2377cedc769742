#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Scales that a HAL file sets to 0 before the first cycle: they become 1 (stepgen documents that
# this one stays), and no output is infinite, full on, or no number. The same with a negative pwm-freq.
set -eu
hal=$(mktemp --suffix=.hal)
trap 'rm -f "$hal"' EXIT
cat > "$hal" <<EOF
loadrt siggen
loadrt pwmgen output_type=0,0
loadrt counter
loadrt encoder num_chan=1
loadrt sim_encoder
loadrt stepgen step_type=0,0 ctrl_type=v,p
loadrt sampler depth=20 cfg=b
loadrt threads name1=t period1=1000000
setp siggen.0.frequency 100
net a siggen.0.clock counter.0.phase-A encoder.0.phase-A
setp counter.0.position-scale 0
setp encoder.0.position-scale 0
setp encoder.0.counter-mode 1
setp sim-encoder.0.scale 0
setp sim-encoder.0.speed 0.3
setp pwmgen.0.scale 0
setp pwmgen.0.enable 1
setp pwmgen.0.value 0.7
setp pwmgen.1.pwm-freq -5
setp pwmgen.1.enable 1
setp pwmgen.1.value 0.7
setp stepgen.0.position-scale 0
setp stepgen.0.velocity-cmd 300
setp stepgen.0.enable 1
setp stepgen.1.position-scale 0
setp stepgen.1.position-cmd 4
setp stepgen.1.enable 1
addf siggen.0.update t
addf counter.update-counters t
addf counter.capture-position t
addf encoder.update-counters t
addf encoder.capture-position t
addf sim-encoder.make-pulses t
addf sim-encoder.update-speed t
addf pwmgen.make-pulses t
addf pwmgen.update t
addf stepgen.make-pulses t
addf stepgen.update-freq t
addf stepgen.capture-position t
addf sampler.0 t
start
loadusr -w halsampler -n 16 /dev/null
stop
show pin *.position* *scale *.scale *.velocity sim-encoder.0.rawcounts pwmgen.?.curr-dc pwmgen.?.pwm-freq
show param stepgen.?.position-scale stepgen.?.frequency
EOF
KERF_CLOCK=virtual halrun -s -f "$hal"
