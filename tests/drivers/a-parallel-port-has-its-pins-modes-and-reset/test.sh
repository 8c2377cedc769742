#!/bin/bash
# Pins, parameters and functions of each mode, what they make of the registers, pulses that reset ends, and what is
# said of a cfg that can not be. The driver is built here on registers that are HAL pins.
rtlib=$(dirname "$(dirname "$(command -v rtapi_app)")")/rtlib
trap 'rm -f kerf_test_port.c t.hal "$rtlib/kerf_test_port.so"' EXIT
top=$(cd ../../.. && pwd)
{ echo "#define SOURCE \"$top/src/hal/drivers/hal_parport.c\""; cat port.c; } > kerf_test_port.c
sed -i "1i #include \"$top/src/hal/components/comp_util.h\"" kerf_test_port.c
EXTRA_CFLAGS="-I$top/src/hal" halcompile --install kerf_test_port.c >&2 || exit 1
export KERF_CLOCK=virtual

mode() {    # the pins, parameters and functions of a port in a mode
    echo "== $1"
    printf 'loadrt kerf_test_port cfg="0x378 %s"\nshow pin parport\nshow param parport\nshow funct parport\n' "$1" > t.hal
    halrun -f t.hal 2> /dev/null | grep -v '\.time\b\|\.tmax\b' | awk '$3 ~ /IN|OUT|RW/ { print $2, $3, $5 } $2 ~ /^[0-9]+$/ && $NF ~ /^parport/ { print "function", $NF }' |
        awk '/^bit/ { sub(/pin-[0-9]+/, "pin-NN", $0); n[$0]++; next } { print } END { for (k in n) print n[k], k }' | LC_ALL=C sort
}
for m in out in x epp; do mode $m; done

cat > t.hal <<'END'
loadrt kerf_test_port cfg="378_out 0x278_in"
loadrt threads name1=fast period1=100000
addf parport.read-all fast
addf parport.write-all fast
addf parport.0.reset fast
addf parport.1.reset fast
setp parport.0.pin-02-out 1
setp parport.0.pin-09-out-invert 1
setp parport.0.pin-01-out 1
setp parport.0.pin-16-out 1
setp sim.379.in 0x48
setp sim.278.in 0xa5
setp sim.27a.in 0
start
loadusr -w kerf-clock sleep 0.01
getp sim.378.out
getp sim.378.writes
getp sim.37a.out
getp sim.27a.out
getp parport.0.pin-10-in
getp parport.0.pin-11-in
getp parport.0.pin-11-in-not
getp parport.0.pin-15-in
getp parport.1.pin-02-in
getp parport.1.pin-03-in
setp parport.0.pin-03-out 1
setp parport.0.pin-03-out-reset 1
setp parport.0.reset-time 90000
loadusr -w kerf-clock sleep 0.01
getp parport.0.reset-time
getp sim.378.out
setp parport.0.pin-03-out-invert 1
setp parport.0.pin-03-out 0
loadusr -w kerf-clock sleep 0.01
getp sim.378.out
END
echo "== registers"
halrun -f t.hal 2>&1 | grep -v '^Note'

echo "== mistakes"
for c in "" "0x378 out 0x37g" "37812" "1 2 3 4 5 6 7 8 9 a"; do
    printf 'loadrt kerf_test_port cfg="%s"\n' "$c" > t.hal
    halrun -f t.hal 2>&1 | grep PARPORT
done
printf 'loadrt hal_parport cfg=f\n' > t.hal
KERF_CLOCK=real halrun -f t.hal 2>&1 | grep "Linux parallel"

echo "== in simulated time a port is memory: nothing is connected, a pulse ends as set"
cat > t.hal <<'END'
loadrt hal_parport cfg="0x378 out 0 in"
loadrt threads name1=fast period1=100000
addf parport.read-all fast
addf parport.write-all fast
addf parport.0.reset fast
setp parport.0.pin-02-out 1
setp parport.0.pin-02-out-reset 1
start
loadusr -w kerf-clock sleep 0.01
getp parport.0.pin-10-in
getp parport.0.pin-11-in
getp parport.0.pin-11-in-not
getp parport.1.pin-02-in
END
halrun -f t.hal 2>&1 | grep -v '^Note'
