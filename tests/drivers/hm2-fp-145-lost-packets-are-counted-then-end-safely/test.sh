#!/bin/bash
# A lost packet costs nothing but is counted: pins keep their values, settings are written again. When packet-error-
# level reaches packet-error-limit, io_error stops all transfers, the board's watchdog switches the outputs off, it
# is told once, and the operator can go on without loading anew. Also (FP-142): health pins for the operator's stop
# chain.
../../lib/with-hm2-board <<'END' | uniq
poke 0xF200 0x100
wait 0.003
get %.gpio.008.in
say one answer is cut
poke 0xF004 1
wait 0.0035
get %.packet-error-total
get %.packet-error
get %.packet-error-level
get %.gpio.008.in
get %.io_error
wait 1
say a lost packet of writes had the direction of a pin: it is written again
poke 0xF010 1
setp %.gpio.002.is_output 1
wait 0.01
get %.packet-error-total
peek 0x1100
wait 1
say an answer that comes not at all
setp %.packet-read-timeout 1000000000
poke 0xF000 1
wait 0.01
get %.packet-error-total
setp %.packet-read-timeout 2000000000
say increments below 1 are 1; the level falls by one in each good cycle
setp %.packet-error-increment 0
poke 0xF004 3
wait 0.0015
wait 0.1
get %.packet-error-increment
get %.packet-error-level
get %.packet-error-total
say too many
setp %.packet-error-increment 2
poke 0xF004 7
wait 0.1
get %.packet-error-level
get %.packet-error-exceeded
get %.packet-error-total
get %.io_error
get %.packet-error
say the operator goes on: settings are written again
setp %.io_error 0
wait 0.1
get %.io_error
get %.packet-error
get %.packet-error-exceeded
get %.packet-error-level
setp %.watchdog.has_bit 0
wait 0.1
get %.watchdog.has_bit
peek 0x1100
say 3000 cycles in which one packet in four goes wrong: cut, doubled, late, foreign, too long, not heard
setp %.packet-error-limit 1000000
setp %.stepgen.00.maxaccel 0
setp %.stepgen.00.position-scale 1000
setp %.stepgen.00.steplen 1000
setp %.stepgen.00.stepspace 1000
setp %.stepgen.00.enable 1
setp %.stepgen.00.position-cmd 3
poke 0xF014 4
wait 3
get %.io_error
setp %.gpio.005.is_output 1
wait 0.1
say they end: everything is as it was asked for
setp %.raw.write_address 0xF014
setp %.raw.write_data 0
setp %.raw.write_strobe 1
wait 0.03
setp %.raw.write_strobe 1
wait 0.03
setp %.raw.write_strobe 1
wait 1
get %.packet-error
get %.watchdog.has_bit
peek 0x1100
get %.stepgen.00.position-fb
say more than the limit is possible only by the limit
setp %.packet-error-limit 100
poke 0xF004 20
wait 0.02
get %.io_error
END
