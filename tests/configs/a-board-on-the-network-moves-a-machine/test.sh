#!/bin/bash
# configs/by_interface/mesa starts against a simulated board, homes, and moves by the board's step generators.
# FP-143: when the board's watchdog bites in the middle of a move, the machine goes off and the operator is told,
# and when he has answered, it goes on from where the board counted; the same (FP-145) when the connection is lost.
top=$(cd ../../.. && pwd)
here=$PWD
. "$top/tests/lib/hm2-address"
scratch=$(mktemp -d); trap 'rm -rf "$scratch"' EXIT
cp -r "$top/configs/by_interface/mesa/hm2-stepper/." "$scratch"
cd "$scratch" || exit 1
linuxcnc_check_ini -e 7i96s.ini 2>&1 | grep -v PROGRAM_PREFIX
coproc BOARD { /usr/bin/python3 "$top/tests/lib/hm2_board.py" "$hm2_address" 7I96S plain; }
board_in=${BOARD[1]} board=$BOARD_PID
read -r line <&"${BOARD[0]}"
sed -i "s/^BOARD_IP = .*/BOARD_IP = $hm2_address/; s/^HALFILE = .*/&\nHALFILE = patient.hal/
    s,^DISPLAY = .*,DISPLAY = ./display,
    s/^CONFIG = \"/&enable_raw /; /^HALUI/d" 7i96s.ini
echo 'setp [HOSTMOT2](BOARD).packet-read-timeout 2000000000' > patient.hal
printf '#!/bin/sh\nexec /usr/bin/python3 %s/script.py > out 2>&1\n' "$here" > display
chmod +x display
export KERF_CLOCK=virtual HOME=$scratch PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$top/tests/task/lib:$PYTHONPATH
linuxcnc -r 7i96s.ini < /dev/null > log 2>&1 || tail -n 20 log
cat out
grep -oE 'Watchdog has bit!|connection to .* lost' log | sed "s/$hm2_address/BOARD_IP/" | sort -u
exec {board_in}>&-
wait "$board"
