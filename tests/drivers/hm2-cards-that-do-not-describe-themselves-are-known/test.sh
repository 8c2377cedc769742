#!/bin/bash
# 8I20 and 7I64 have no tables of what they have: names, types and limits are those of the peer (2.9) for the same
# simulated cards. With use_serial_numbers cards have their numbers in their names.
clean() {
    sed -E 's/^ *[0-9]+ +(bit|float|u32|s32) +/\1 /; s/ +/ /g' | grep -vE 'input-(0[1-9]|1)|output-(0[1-9]|1)|^$'
}
../../lib/with-hm2-board -f old-cards <<'END' | clean
wait 0.05
show pin %.8i20
show param %.8i20
show pin %.7i64
show param %.7i64
setp %.8i20.0.0.current 10
setp %.8i20.0.0.angle 0.5
setp %.7i64.0.1.output-07 1
wait 0.01
say what goes out comes in again, from the first bit on
get %.7i64.0.1.input-07
get %.7i64.0.1.analog0
get %.8i20.0.0.card-temp
get %.8i20.0.0.bus-voltage
get %.8i20.0.0.status.ext-reset
get %.8i20.0.0.status.no-enable
say beyond the limit of the card
setp %.8i20.0.0.current 1000
setp %.8i20.0.0.angle 0
wait 0.01
get %.8i20.0.0.bus-voltage
END
echo 'getp hm2_8i20.001f.nvkqp' | ../../lib/with-hm2-board -f old-cards -m use_serial_numbers=1
: | ../../lib/with-hm2-board -f old-cards -m sserial_baudrate=115200 -l | grep -o 'registered$'
