#!/bin/bash
# SSI, BiSS and Fanuc encoders: fields by the format, over 32-bit words, Gray code, parts and turns; data that stays
# invalid is told once; wrong formats are named.
../../lib/with-hm2-board -f serial -c "enable_raw num_dplls=0 ssi_chan_1=nothing%4penc%12efault%1b%1pbits%3f \
biss_chan_0=pos%17geraw%20um%20sangle%8u fanuc_chan_0=AA64" <<'END'
addf %.trigger-encoders servo
say SSI: 21 bits at 500 kHz, started by the function
peek 0x5204
peek 0x5300
poke 0x5300 0
poke 0x5004 0x1AFF0
poke 0x5300 0
get %.ssi.01.enc.rawcounts
get %.ssi.01.fault
poke 0x5004 0x140010
poke 0x5300 0
delf %.trigger-encoders servo
poke 0x5300 0
wait 0.003
get %.ssi.01.enc.rawcounts
get %.ssi.01.fault-not
get %.ssi.01.bits-00
get %.ssi.01.bits-02
say BiSS
poke 0x5B00 0
peek 0x5900
peek 0x5A00
setp %.biss.00.frequency-khz 1000
setp %.biss.00.timer-number 2
peek 0x5900
peek 0x5A00
say Fanuc: an encoder of 16 bits and 16 turns
poke 0x6500 0
poke 0x6000 0x00FF8160
wait 0.002
get %.fanuc.00.batt_fail
get %.fanuc.00.encoder.rawcounts
peek 0x6300
peek 0x6400
say no answer for five seconds
poke 0x6200 0x80000000
wait 4
get %.fanuc.00.data-invalid
wait 1.1
get %.fanuc.00.data-invalid
poke 0x6200 0
wait 0.1
get %.fanuc.00.data-invalid
END
for format in 'a%0u' 'a%8q' '%8u' a8u 'a%60sb%60s'; do
    echo "format $format"
    : | ../../lib/with-hm2-board -f serial -c "ssi_chan_0=$format" | grep ssi_chan
done
