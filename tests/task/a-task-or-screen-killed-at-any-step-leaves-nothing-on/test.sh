#!/bin/bash
# kill -9 of task, then of the screen, at each step of a program with spindles, coolant, probing and tool changes. Another program looks at
# every cycle of the realtime part until it is unloaded.
export KERF_CLOCK=virtual
out=$(mktemp -d); trap 'rm -rf "$out"' EXIT
export HOME=$out PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$PWD/../lib:$PWD/../../lib:$PYTHONPATH
cp -r "$EMC2_HOME/configs/sim/mill" "$out/machine"
sed -i 's/^HALUI *=.*//; s/^\[TRAJ\]/[TRAJ]\nNO_FORCE_HOMING = 1/' "$out/machine/mill.ini"
cat >> "$out/machine/spindle.hal" <<'HAL'
net flood iocontrol.0.coolant-flood
net mist iocontrol.0.coolant-mist
HAL
for victim in milltask screen; do
step=0
rm -f "$out/last"
while [ ! -e "$out/last" ] && [ $step -lt 40 ]; do
    printf '#!/bin/sh\nexec /usr/bin/python3 %s/script.py %s %s %s > %s/trouble 2>&1\n' "$PWD" $step "$out" $victim "$out" > "$out/display"; chmod +x "$out/display"
    linuxcnc -r -D "$out/display" "$out/machine/mill.ini" > "$out/log" 2>&1 < /dev/null
    status=$?
    if [ ! -e "$out/last" ]; then
        for _ in $(seq 500); do [ -e "$out/seen" ] && break; sleep 0.02; done
        cat "$out/seen" || { cat "$out/trouble" "$out/log"; break; }
        rm -f "$out/seen"
        [ $status -ne 0 ] && { [ $victim = screen ] || grep -q 'milltask (process [0-9]*) died' "$out/log"; } || { echo "the launcher did not say so: $status"; cat "$out/log"; }
        grep -c '^T[0-9]' "$out/machine/mill.tbl" | grep -vx 4
        awk '{ if (NF != 2) bad = 1; } END { if (bad || NR < 100) print "parameters:", NR }' "$out/machine/mill.var"
    fi
    step=$((step + 1))
done
cat "$out/trouble"
done
