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
fi | sed 's/process [0-9]*/process N/; /warning:/d'
python3 - "$out/machine/mill.ini" <<'END'
import os, pty, sys
for answer in (b"n\n", b"\4", b"y\n"):
    pid, terminal = pty.fork()
    if pid == 0:
        os.execvp("linuxcnc", ["linuxcnc", "-r", "-D", "true", sys.argv[1]])
    text = b""
    try:
        while data := os.read(terminal, 4096):
            if b"[Y/n]" in data:
                os.write(terminal, answer)
            text += data
    except OSError:
        pass
    status = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
    print(answer, "status", status, *(t for t in ("Not starting new", "Cleaning up old", "Traceback") if t in text.decode()), flush=True)
END
wait $first; echo "first: status $?"
realtime status || true
