#!/bin/bash
# serport: pins, parameters and functions, what they make of the registers, and what is said of addresses that can not
# be. The driver is built here on registers that are HAL pins.
rtlib=$(dirname "$(dirname "$(command -v rtapi_app)")")/rtlib
trap 'rm -f kerf_test_port.c t.hal "$rtlib/kerf_test_port.so"' EXIT
top=$(cd ../../.. && pwd)
{ echo "#include \"$top/src/hal/components/comp_util.h\""; printf '#define DRIVER "serport"\n#define SOURCE "%s/src/hal/drivers/serport.c"\n' "$top"
  cat ../a-parallel-port-has-its-pins-modes-and-reset/port.c; } > kerf_test_port.c
EXTRA_CFLAGS="-I$top/src/hal" halcompile --install kerf_test_port.c >&2 || exit 1
export KERF_CLOCK=virtual
run() { halrun -f t.hal 2>&1 | grep -v '^Note\|insmod\|rtapi_app_main\|exited without\|waitpid\|not loaded' | sed 's/t.hal:[0-9]*: //'; }

printf 'loadrt kerf_test_port io=0x3f8\nshow pin serport\nshow param serport\nshow funct serport\n' > t.hal
run | grep -v '\.time\b\|\.tmax\b' | awk '$3 ~ /IN|OUT|RW|RO/ { print $2, $3, $4, $5 } $NF ~ /^serport.0.(read|write)$/ { print "function", $NF }'

cat > t.hal <<'END'
loadrt kerf_test_port io=0x3f8,0x2f8
loadrt threads name1=t period1=1000000
addf serport.0.read t
addf serport.0.write t
addf serport.1.read t
addf serport.1.write t
setp sim.3fe.in 0x8f
setp sim.2fe.in 0x70
setp serport.1.pin-3-out 1
setp serport.1.pin-4-out 1
setp serport.1.pin-4-out-invert 1
setp serport.1.pin-7-out-invert 1
start
loadusr -w kerf-clock sleep 0.01
show pin serport.*in
getp sim.3fb.out
getp sim.3fc.out
getp sim.2fb.out
getp sim.2fc.out
setp serport.0.pin-4-out 1
loadusr -w kerf-clock sleep 0.01
getp sim.3fb.out
getp sim.3fc.out
END
echo "== registers"
run | awk '$3 == "OUT" { print $4, $5; next } NF == 1 || /released/'
echo "== mistakes"
for words in "" io=0x2f8,8 io=0x12345; do
    printf 'loadrt kerf_test_port %s\n' "$words" > t.hal
    run
done
echo "== in simulated time a port is memory"
printf 'loadrt serport io=0x3f8\nloadrt threads name1=t\naddf serport.0.read t\nstart\nloadusr -w kerf-clock sleep 0.01\ngetp serport.0.pin-8-in\ngetp serport.0.ioaddr\n' > t.hal
run
