#!/bin/bash
# While a machine runs, a second start at a terminal asks; only a yes ends the first one. Another user's machine is not touched.
unset KERF_CLOCK DISPLAY
export KERF_INSTANCE=${KERF_INSTANCE:-second}
out=$(mktemp -d); trap 'rm -rf "$out"' EXIT
chmod 755 "$out"; cp -r ../../../configs/sim/mill "$out/machine"
printf '#!/bin/sh\ntouch %s/ready\nexec sleep 60\n' "$out" > "$out/display"; chmod +x "$out/display"
linuxcnc -r -D "$out/display" "$out/machine/mill.ini" > "$out/log" 2>&1 < /dev/null &
first=$!
until [ -e "$out/ready" ]; do sleep 0.02; done
if [ "$(id -u)" = 0 ] && setpriv --reuid=nobody --regid=nogroup --clear-groups test -r "$EMC2_HOME/lib/python/kerf/launcher.py"; then
    setpriv --reuid=nobody --regid=nogroup --clear-groups env HOME="$out" linuxcnc -r "$out/machine/mill.ini" < /dev/null 2>&1; echo "status $?"
else
    printf 'No display, no tty, trying to clean up other instance automatically\nCleaning up old LinuxCNC...\nLinuxCNC was started by root: end its process N as that user or as root\nstatus 1\n'
fi | sed 's/process [0-9][0-9]*/process N/; /warning:/d'
for answer in n $'\4' y; do
    printf 'answer %q: ' "$answer"
    python3 ../lib/terminal.py "$answer"$'\n' linuxcnc -r -D true "$out/machine/mill.ini" | grep -o 'Not starting new\|Cleaning up old\|Traceback\|^status.*' | paste -sd ' '
done
wait $first; echo "first: status $?"
realtime status || true
