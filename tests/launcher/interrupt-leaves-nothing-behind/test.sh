#!/bin/bash
# Ctrl-C, Ctrl-\\ and TERM end a running machine in order: status 0 and nothing is left. Task that still waits for motion ends, too.
unset KERF_CLOCK
export KERF_INSTANCE=${KERF_INSTANCE:-intr}
top=$(cd ../../.. && pwd)
out=$(mktemp -d); trap 'rm -rf "$out"' EXIT
cp -r "$top/configs/sim/mill" "$out/machine"
printf '#!/bin/sh\ntouch %s/ready\nexec sleep 60\n' "$out" > "$out/display"; chmod +x "$out/display"
for signal in INT QUIT TERM; do
    rm -f "$out/ready"
    # A background job of a script ignores INT; python's launcher sets its own handler again.
    linuxcnc -r -D "$out/display" "$out/machine/mill.ini" > "$out/log" 2>&1 < /dev/null &
    guard=$!
    for _ in $(seq 500); do [ -e "$out/ready" ] && break; sleep 0.02; done
    kill -$signal $guard
    wait $guard
    echo "$signal: status $?"
    [ -e "/tmp/linuxcnc.lock.$KERF_INSTANCE" ] && echo "lock file left"
    realtime status
    grep -c "Shutting down" "$out/log"
done

cd "$out/machine" || exit 1
ini=$out/machine/mill.ini
export INI_FILE_NAME=$ini
linuxcncsvr -ini "$ini" && realtime start 2> /dev/null
milltask -ini "$ini" 2> "$out/log" & task=$!
until halcmd list comp 2> /dev/null | grep -q inihal; do sleep 0.02; done
sleep 0.1
kill $task; wait $task; echo "task: status $?"
grep motion "$out/log"
kill "$(pgrep -f "^linuxcncsvr -ini $ini")"; realtime stop; realtime status || true
