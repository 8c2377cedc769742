#!/bin/bash
# elbpcom against the simulated board: the packets of the protocol's description, sizes found out, and no answer.
. ../../lib/hm2-address
coproc BOARD { /usr/bin/python3 ../../lib/hm2_board.py "$hm2_address"; }
board_in=${BOARD[1]} board=$BOARD_PID
read -r line <&"${BOARD[0]}"
ask() { echo "elbpcom $*"; elbpcom --ip "$hm2_address" -t 2 "$@" 2>&1; }
ask -a 0x100 -r 4
ask --read-info
ask -s 7 -a 0 -r 16
ask -s 2 --address 2 --read 6
ask -a 0x1000 -w 0f000000
ask -a 0x100 --size 4 -r 16 -n
ask 81420001 82420401
ask -a 0x101 -r 3 --size 2
ask -w 12x
printf '81420001\n' | ask
exec {board_in}>&-
wait "$board"
ask -t 0.05 -a 0x100 --size 4 -r 4
