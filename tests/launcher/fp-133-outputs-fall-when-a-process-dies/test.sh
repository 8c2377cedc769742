#!/bin/bash
# FP-133: kill -9 of task in the middle of a program with spindle, coolant, digital and analog outputs on, task that gets no more memory
# for a program that wants some, an ordinary end in the middle of one, and kill -9 of the
# whole launcher and task at once: while the realtime part still runs, outputs and enables fall and motion ends.
export KERF_CLOCK=virtual KERF_INSTANCE=${KERF_INSTANCE:-falls}
out=$(mktemp -d); trap 'rm -rf "$out"' EXIT
export HOME=$out PYTHONPATH=$PWD/../../lib:$PYTHONPATH
cp -r "$EMC2_HOME/configs/sim/mill" "$out/machine"
here=$PWD
sed -i 's/^HALUI *=.*//; s/^\[TRAJ\]/[TRAJ]\nNO_FORCE_HOMING = 1/' "$out/machine/mill.ini"
cat >> "$out/machine/spindle.hal" <<'HAL'
net flood iocontrol.0.coolant-flood
net mist iocontrol.0.coolant-mist
HAL
for victim in milltask memory display launcher-and-task; do
    printf '#!/bin/sh\nexec /usr/bin/python3 -B %s/watcher.py %s %s\n' "$here" $victim "$out" > "$out/display"; chmod +x "$out/display"
    linuxcnc -r -D "$out/display" "$out/machine/mill.ini" > "$out/log" 2>&1 < /dev/null
    echo "$victim: status $([ $? -ne 0 ] && echo not 0 || echo 0)"
    for _ in $(seq 500); do [ -e "$out/seen" ] && break; sleep 0.02; done
    cat "$out/seen" || cat "$out/log"
    rm -f "$out/seen"
done
# Of the last one the screen's processes, the server and the realtime part are left.
kill -9 $(grep -lzx "KERF_INSTANCE=$KERF_INSTANCE" /proc/[0-9]*/environ 2> /dev/null | xargs -r grep -lz '^LINUXCNC_SESSION=' | cut -d/ -f3 |
          while read -r p; do case $(cat /proc/$p/comm) in python3|linuxcncsvr) echo $p;; esac; done)
realtime stop
rm -f "/tmp/linuxcnc.lock.$KERF_INSTANCE"
