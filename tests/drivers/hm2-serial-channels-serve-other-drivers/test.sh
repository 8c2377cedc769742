#!/bin/bash
# The functions of hostmot2-serial.h: another driver sets channels up and finds its data in the board's registers.
rtlib=$(dirname "$(dirname "$(command -v rtapi_app)")")/rtlib
trap 'rm -f kerf_client.c "$rtlib/kerf_client.so"' EXIT
cp client.c kerf_client.c
halcompile --install kerf_client.c >&2 || exit 1
echo "buffered SPI"
../../lib/with-hm2-board -f serial -c enable_raw <<'END'
stop
loadrt kerf_client which=bspi board=%
setp client.out 0xCAFE
start
wait 0.01
peek 0x680C
peek 0x6814
peek 0x6900
poke 0x6800 4321
wait 0.002
getp client.echo
END
echo "serial channels"
../../lib/with-hm2-board -f uart <<'END'
stop
loadrt kerf_client which=uart board=%
start
say bit rate, mode, four bytes and one
peek 0x7210
peek 0x7310
peek 0x7A10
peek 0x701C
peek 0x7010
say frames: bit rates, mode of sending, frames that were sent
peek 0x8200
peek 0x8300
peek 0x8A00
peek 0xF024
END
echo "bytes as pins"
../../lib/with-hm2-board -f uart <<'END'
stop
loadrt mesa_uart names=%.uart.0
addf %.uart.0.receive servo 2
addf %.uart.0.send servo 3
setp %.uart.0.tx-data-00 0x41
setp %.uart.0.tx-data-01 0x42
setp %.uart.0.tx-bytes 2
start
peek 0x7004
poke 0x7900 3
poke 0x7808 0x636261
wait 0.003
get %.uart.0.rx-bytes
get %.uart.0.rx-data-00
get %.uart.0.rx-data-02
END
echo "a lost answer to a direct read is counted, no more"
../../lib/with-hm2-board -f uart <<'END'
stop
setp %.packet-read-timeout 500000000
loadrt mesa_uart names=%.uart.0
addf %.uart.0.receive servo 2
start
wait 0.01
poke 0xF000 2
wait 0.05
get %.io_error
get %.packet-error-total
END
