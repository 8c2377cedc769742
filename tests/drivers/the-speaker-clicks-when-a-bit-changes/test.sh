#!/bin/bash
# Each change of one of the eight bits inverts bit 1 of port 0x61 for a cycle; the other bits of the port stay. The driver
# is built here on registers that are HAL pins.
rtlib=$(dirname "$(dirname "$(command -v rtapi_app)")")/rtlib
trap 'rm -f kerf_test_port.c t.hal "$rtlib/kerf_test_port.so"' EXIT
top=$(cd ../../.. && pwd)
{ echo "#include \"$top/src/hal/components/comp_util.h\""; printf '#define DRIVER "hal_speaker"\n#define SOURCE "%s/src/hal/drivers/hal_speaker.c"\n' "$top"
  cat ../a-parallel-port-has-its-pins-modes-and-reset/port.c; } > kerf_test_port.c
EXTRA_CFLAGS="-I$top/src/hal" halcompile --install kerf_test_port.c >&2 || exit 1
export KERF_CLOCK=virtual
{
    cat <<'END'
loadrt kerf_test_port
loadrt threads name1=slow period1=1000000000
addf speaker.0.write slow
setp sim.61.in 0x31
start
loadusr -w kerf-clock sleep 1.5
getp sim.61.writes
setp speaker.0.pin-05-out 1
loadusr -w kerf-clock sleep 1
getp sim.61.out
setp sim.61.in 0x33
loadusr -w kerf-clock sleep 1
getp sim.61.out
getp sim.61.writes
setp speaker.0.pin-05-out 0
setp speaker.0.pin-00-out 1
loadusr -w kerf-clock sleep 3
getp sim.61.writes
END
} > t.hal
halrun -f t.hal 2>&1 | grep -v '^Note'
printf 'loadrt hal_speaker\nloadrt threads name1=t\naddf speaker.0.write t\nstart\nsetp speaker.0.pin-07-out 1\nloadusr -w kerf-clock sleep 0.01\nshow funct speaker\n' > t.hal
halrun -f t.hal 2>&1 | grep -o 'speaker.0.write'
