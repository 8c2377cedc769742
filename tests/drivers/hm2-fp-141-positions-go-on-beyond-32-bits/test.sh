#!/bin/bash
# FP-141: more than 2^32 counts of an encoder and of a step generator, either way, with an accelerated counter
# (150,000 cycles): the speed of the position never shows a jump, and the position is the true one at the end.
top=$(cd ../../.. && pwd)
rtlib=$(dirname "$(dirname "$(command -v rtapi_app)")")/rtlib
trap 'rm -f kerf_fast_board.c t.hal "$rtlib/kerf_fast_board.so"' EXIT
{ echo "#define BOARD_HEADER \"$top/src/hal/drivers/mesa-hostmot2/hm2_llio.h\""; cat fast_board.c; } > kerf_fast_board.c
EXTRA_CFLAGS="-I$top/src/hal" halcompile --install kerf_fast_board.c >&2 || exit 1
export KERF_CLOCK=virtual
for direction in 1 -1; do
    cat > t.hal <<END
loadrt hostmot2
loadrt kerf_fast_board direction=$direction
loadrt ddt count=2
loadrt wcomp count=2
loadrt counter num_chan=2
loadrt threads name1=servo period1=1000000
addf board.read servo
addf ddt.0 servo
addf ddt.1 servo
addf wcomp.0 servo
addf wcomp.1 servo
addf counter.update-counters servo
net encoder board.encoder.00.position => ddt.0.in
net steps board.stepgen.00.position-fb => ddt.1.in
net encoder-speed ddt.0.out => wcomp.0.in
net steps-speed ddt.1.out => wcomp.1.in
setp wcomp.0.min $((direction * 32000000 - 1))
setp wcomp.0.max $((direction * 32000000 + 1))
setp wcomp.1.min $((direction * 30000000 - 1))
setp wcomp.1.max $((direction * 30000000 + 1))
net encoder-steady wcomp.0.out => counter.0.phase-A
net steps-steady wcomp.1.out => counter.1.phase-A
start
loadusr -w kerf-clock sleep 150
stop
getp board.encoder.00.position
getp board.stepgen.00.position-fb
getp servo.threadbeat
getp counter.0.rawcounts
getp counter.1.rawcounts
getp board.encoder.00.count
END
    halrun -f t.hal 2>/dev/null | grep -v '^hm2'
done
