#!/bin/bash
# hal_bb_gpio on a board that is files: every pin of the headers and its line, inputs, outputs and LEDs with their
# inverses, registers while it runs and at the end; what can not be.
KERF_BOARD_ROOT=$(realpath "$(mktemp -d)")
export KERF_BOARD_ROOT KERF_CLOCK=virtual
trap 'rm -rf "$KERF_BOARD_ROOT" t.hal registers' EXIT
mkdir -p "$KERF_BOARD_ROOT/proc/device-tree" "$KERF_BOARD_ROOT/dev"
run() { halrun -f t.hal 2>&1 | grep -vE "^Note|exited without|waitpid|not loaded|insmod for" | sed "s,$KERF_BOARD_ROOT,,; s/t.hal:[0-9]*: //"; }
# registers put PORT OFFSET VALUE | look: directions, what was set and cleared last, of ports 0 to 3 | pad OFFSET
cat > registers <<'END'
#!/usr/bin/python3
import os, struct, sys
ports = (0x44E07000, 0x4804C000, 0x481AC000, 0x481AE000)
memory = open(os.environ["KERF_BOARD_ROOT"] + "/dev/mem", "r+b")
def word(at, value=None):
    memory.seek(at)
    return memory.write(struct.pack("<I", value)) if value is not None else struct.unpack("<I", memory.read(4))[0]
words = [int(w, 0) for w in sys.argv[2:]]
if sys.argv[1] == "put":
    word((ports[words[0]] if words[0] < 4 else 0x44E00000) + words[1], words[2])
elif sys.argv[1] == "look":
    print(*(" ".join(f"{word(p + r):08x}" for r in (0x134, 0x194, 0x190)) for p in ports), sep=", ")
else:
    print(f"pad {word(0x44E10000 + words[0]):02x}")
END
chmod +x registers
board() {
    printf 'ti,am335x-bone-black\0ti,am33xx\0' > "$KERF_BOARD_ROOT/proc/device-tree/compatible"
    rm -f "$KERF_BOARD_ROOT/dev/mem"
    truncate -s $((0x481AF000)) "$KERF_BOARD_ROOT/dev/mem"
    for clock in 0x408 0xac 0xb0 0xb4; do ./registers put 9 $clock 2; done
    for port in 0 1 2 3; do ./registers put $port 0x134 0xffffffff; done
}
board
echo "== names"
printf 'loadrt hal_bb_gpio user_leds=0,3 input_pins=807,923 output_pins=146,242\nshow pin bb_gpio\nshow funct bb_gpio\n' > t.hal
run | grep -o '\(IN\|OUT\) *FALSE *bb_gpio.*\|bb_gpio.\(read\|write\)$' | tr -s ' '
echo "== registers"
board
./registers put 0 0x138 0x00400000
./registers put 2 0x138 0x00000004
cat > t.hal <<'END'
loadrt hal_bb_gpio user_leds=1 input_pins=807,808,819 output_pins=846,942,925
loadrt threads name1=t period1=1000000
addf bb_gpio.read t
addf bb_gpio.write t
loadusr -w ./registers look
loadusr -w ./registers pad 0x890
loadusr -w ./registers pad 0x8a4
setp bb_gpio.p8.in-08-invert 1
start
loadusr -w kerf-clock sleep 0.01
show pin bb_gpio.p8.in-??
loadusr -w ./registers look
setp bb_gpio.userled1 1
setp bb_gpio.p8.out-46 1
setp bb_gpio.p9.out-42-invert 1
setp bb_gpio.p9.out-25 1
setp bb_gpio.p9.out-25-invert 1
loadusr -w kerf-clock sleep 0.01
loadusr -w ./registers look
END
run | awk '$3 == "OUT" { print $4, $5; next } /pad|,/'
./registers look
echo "== every pin"
codes=$(for header in 8 9; do for pin in {01..47}; do echo $header$pin; done; done)
{
    for code in $codes; do printf 'loadrt hal_bb_gpio output_pins=%s\nunloadrt hal_bb_gpio\n' "$code"; done
} > t.hal
halrun -k -f t.hal 2>&1 | grep -o 'pin p.*' | tr '\n' ' '
echo
echo "== in simulated time, without the files of a board, no pin moves"
printf '%s\n' "loadrt hal_bb_gpio input_pins=807 output_pins=911" "loadrt threads name1=t period1=1000000" "addf bb_gpio.read t" "addf bb_gpio.write t" \
    start "loadusr -w kerf-clock sleep 0.01" "getp bb_gpio.p8.in-07" > t.hal
env -u KERF_BOARD_ROOT halrun -f t.hal 2>&1 | grep -v ^Note
echo "== what can not be"
for words in "" user_leds=4 input_pins=700 input_pins=-807 "input_pins=807 output_pins=807" input_pins=807,807; do
    echo "loadrt hal_bb_gpio $words" > t.hal
    run
done
./registers put 9 0xb0 0x30000
run
rm "$KERF_BOARD_ROOT/dev/mem"
run
printf 'raspberrypi,4-model-b\0brcm,bcm2711\0' > "$KERF_BOARD_ROOT/proc/device-tree/compatible"
printf 'Raspberry Pi 4 Model B\0' > "$KERF_BOARD_ROOT/proc/device-tree/model"
run
