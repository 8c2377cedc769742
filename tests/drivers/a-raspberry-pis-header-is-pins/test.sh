#!/bin/bash
# hal_pi_gpio on a board that is files: the pins of each header, masks, registers while it runs and at the end; boards
# and masks that can not be.
KERF_BOARD_ROOT=$(realpath "$(mktemp -d)")
export KERF_BOARD_ROOT KERF_CLOCK=virtual
trap 'rm -rf "$KERF_BOARD_ROOT" t.hal look' EXIT
mkdir -p "$KERF_BOARD_ROOT/proc/device-tree" "$KERF_BOARD_ROOT/dev"
registers="$KERF_BOARD_ROOT/dev/gpiomem"
run() { halrun -f t.hal 2>&1 | grep -vE "^Note|exited without|waitpid|not loaded|insmod for" | sed "s,$KERF_BOARD_ROOT,,; s/t.hal:[0-9]*: //"; }
board() { # revision [model]
    printf '%s\0' "${2-Raspberry Pi 4 Model B Rev 1.2}" > "$KERF_BOARD_ROOT/proc/device-tree/model"
    printf 'processor\t: 0\n\nHardware\t: BCM2835\nRevision\t: %s\nSerial\t: 1\n' "$1" > "$KERF_BOARD_ROOT/proc/cpuinfo"
    head -c 4096 /dev/zero > "$registers"
}
put() { /usr/bin/python3 -c 'import struct, sys; f = open(sys.argv[1], "r+b"); f.seek(int(sys.argv[2]) * 4); f.write(struct.pack("<I", int(sys.argv[3], 0)))' "$registers" "$@"; }
# functions (a digit a GPIO), what was set and cleared last
cat > look <<'END'
#!/usr/bin/python3
import os, struct
words = struct.unpack("<16I", open(os.environ["KERF_BOARD_ROOT"] + "/dev/gpiomem", "rb").read(64))
print("functions", "".join(str(words[n // 10] >> n % 10 * 3 & 7) for n in range(30)), f"set {words[7]:07x} cleared {words[10]:07x}")
END
chmod +x look

echo "== pins of each header"
for each in 0002 0003 1000003 000e 0010 900092 a02082 c03112 d03114 a22082; do
    board $each
    printf 'loadrt hal_pi_gpio\nshow pin hal_pi_gpio\n' > t.hal
    echo "$each: $(run | awk '$3 == "IN" { sub(/.*pin-/, "", $NF); sub(/-out.*/, "", $NF); printf "%s ", $NF }')"
done
echo "== masks, and names"
board c03112
for words in "dir=0x3 exclude=0x3fffff0" "dir=5 exclude=-16" "dir=017 exclude=0xFFFFFFF8"; do
    printf 'loadrt hal_pi_gpio %s\nshow pin hal_pi_gpio\nshow funct hal_pi_gpio\n' "$words" > t.hal
    echo "-- $words"
    run | grep -o ' \(IN\|OUT\) *FALSE *hal_pi_gpio.*\|hal_pi_gpio.\(read\|write\)$'
done
echo "== registers"
put 0 0x900
put 2 1
put 13 0x10
cat > t.hal <<'END'
loadrt hal_pi_gpio dir=0x2008003 exclude=0x1ff7ff0
loadrt threads name1=t period1=1000000
addf hal_pi_gpio.read t
addf hal_pi_gpio.write t
loadusr -w ./look
start
loadusr -w kerf-clock sleep 0.01
getp hal_pi_gpio.pin-07-in
getp hal_pi_gpio.pin-29-in
setp hal_pi_gpio.pin-03-out 1
setp hal_pi_gpio.pin-13-out 1
loadusr -w kerf-clock sleep 0.01
loadusr -w ./look
setp hal_pi_gpio.pin-03-out 0
loadusr -w kerf-clock sleep 0.01
loadusr -w ./look
END
run
./look

echo "== in simulated time, without the files of a board, no pin moves"
printf '%s\n' "loadrt hal_pi_gpio dir=1" "loadrt threads name1=t period1=1000000" "addf hal_pi_gpio.read t" "addf hal_pi_gpio.write t" \
    start "loadusr -w kerf-clock sleep 0.01" "getp hal_pi_gpio.pin-05-in" > t.hal
env -u KERF_BOARD_ROOT halrun -f t.hal 2>&1 | grep -v ^Note
echo "== what can not be"
for words in dir=12x exclude=0x1FFFFFFFF "dir=0 exclude=z"; do
    echo "loadrt hal_pi_gpio $words" > t.hal
    run
done
echo "loadrt hal_pi_gpio" > t.hal
board c04170
run
board c03999
run
board a02082 "Orange Pi Zero"
run
echo > "$KERF_BOARD_ROOT/proc/cpuinfo"
printf 'Raspberry Pi 3' > "$KERF_BOARD_ROOT/proc/device-tree/model"
run
rm "$KERF_BOARD_ROOT/proc/device-tree/model"
run
board a02082
rm "$registers"
run
