#!/bin/bash
# FP-144: the line to the spindle's drive is lost in the middle of a cut. The lines of docs/stops.md hold the program.
# Drives live in real time.
export KERF_CLOCK=real
port=$(/usr/bin/python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')
trap 'rm -f drive.ini' EXIT
printf '%s\n' '[VFS11]' 'TYPE = tcpclient' 'TCPDEST = 127.0.0.1' "PORT = $port" 'TARGET = 3' 'RESPONSE_TIMEOUT = 0.1' \
    'RECONNECT_DELAY = 0.1' > drive.ini
hal=(-hal 'loadusr -Wn drive vfs11_vfd -n drive -I drive.ini' -hal 'setp drive.loop-time 0.01' -hal 'setp drive.enable 1'
     -hal 'net spindle-cmd => drive.speed-command')
while read -r line; do hal+=(-hal "$line"); done < <(sed -n '/^    # held by a lost drive/,/^$/s/^    //p' ../../../docs/stops.md | grep -v '^#')
../../task/lib/machine-test script.py HAL.HALUI=halui -file drive.ini "${hal[@]}"
