#!/bin/bash
# Cards at a smart-serial port say themselves what they have. Single errors are counted and borne; too many stop the
# port, with the card's name and the reason; then (FP-142) inputs become false, and run off and on starts it again.
# A parameter that the card keeps is written between stop and start. What a channel's x leaves out is GPIO.
../../lib/with-hm2-board -f serial <<'END'
wait 0.01
get %.sserial.port-0.port_state
setp %.7i76.0.0.output-03 1
setp %.7i76.0.0.output-15-invert 1
setp %.7i76.0.0.spinout 50
setp %.7i76.0.0.spinena 1
setp %.7i73.0.2.output-00 1
poke 0xF310 250
wait 0.003
get %.7i76.0.0.input-03
get %.7i76.0.0.input-15
get %.7i76.0.0.input-03-not
get %.7i76.0.0.analog
get %.7i76.0.0.spinison
get %.7i76.0.0.enc.rawcounts
get %.7i73.0.2.input-00
get %.7i73.0.2.input-03
say the counter of 8 bits turns over; the index is at a full turn
setp %.7i76.0.0.enc.index-enable 1
poke 0xF310 6
get %.7i76.0.0.enc.rawcounts
get %.7i76.0.0.enc.count
get %.7i76.0.0.enc.position
say limits and scale of a number
setp %.7i76.0.0.spinout-maxlim 80
setp %.7i76.0.0.spinout 1000
wait 0.003
get %.7i76.0.0.analog
setp %.7i76.0.0.spinout 0
say one bad transfer of card 2: card 0 goes on
poke 0xF304 4
poke 0xF308 2
setp %.7i73.0.2.output-05 1
setp %.7i76.0.0.output-05 1
poke 0xF300 1
wait 0.002
get %.sserial.port-0.fault-count
get %.7i73.0.2.input-05
wait 0.05
get %.sserial.port-0.fault-count
get %.sserial.port-0.port_state
say 100 of them
poke 0xF300 100
wait 0.05
get %.sserial.port-0.port_state
get %.7i73.0.2.input-00
get %.7i73.0.2.input-00-not
setp %.sserial.port-0.run 0
wait 0.01
get %.sserial.port-0.port_state
poke 0xF300 0
setp %.sserial.port-0.run 1
wait 0.02
get %.sserial.port-0.port_state
get %.7i73.0.2.input-00
say an error of a card is told once; commands that are not done are counted
poke 0xF30C 0x04000000
wait 0.02
poke 0xF30C 0
poke 0xF314 5
wait 0.004
get %.sserial.port-0.fault-count
wait 0.1
say a parameter: only between stop and start
setp %.7i73.0.2.nvunitnumber 4711
wait 0.01
setp %.sserial.port-0.run 0
wait 0.01
setp %.sserial.port-0.run 1
wait 0.02
get %.sserial.port-0.port_state
get %.7i73.0.2.nvunitnumber
END
echo "one channel left out"
printf 'show pin %%.7i*enc.count\nwait 0.01\nget %%.sserial.port-0.port_state\n' |
    ../../lib/with-hm2-board -l -f serial -c 'sserial_port_0=x' | grep -E 'enc.count|rx[02]|Pin 000|state'
