#!/bin/bash
# The real screen under Xvfb with real keys: power, home, jog by holding a key, run, abort.
unset KERF_CLOCK
top=$(cd ../../.. && pwd)
out=$(mktemp -d)
exec 3<> <(:)
Xvfb -displayfd 3 -screen 0 1024x600x24 3> "$out/number" 2> /dev/null & server=$!
trap 'kill $server; wait $server; rm -rf "$out"' EXIT
for _ in $(seq 200); do [ -s "$out/number" ] && break; sleep 0.05; done
export DISPLAY=:$(cat "$out/number")
cp -r "$top/configs/sim/mill" "$out/machine"
printf 'G21 G90 F600\nG1 X30\nM2\n' > "$out/part.ngc"
linuxcnc -r -D axis "$out/machine/mill.ini" "$out/part.ngc" > "$out/log" 2>&1 < /dev/null & session=$!
/usr/bin/python3 - <<'END'
import subprocess, sys, time
import linuxcnc

def key(*args):
    subprocess.run(["xdotool", *args], check=True)

def until(condition, what, seconds=15):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        try:
            s.poll()
            if condition():
                print(what)
                return
        except linuxcnc.error:
            pass
        time.sleep(0.02)
    print("NOT", what)
    key("key", "alt+F4")
    sys.exit(0)

window = ""
for _ in range(300):
    window = subprocess.run(["xdotool", "search", "--name", "^AXIS$"], stdout=subprocess.PIPE, text=True).stdout.split()
    if window:
        break
    time.sleep(0.05)
key("windowfocus", window[0])
s = linuxcnc.stat()
time.sleep(0.5)
key("key", "F1")
until(lambda: s.task_state == linuxcnc.STATE_ESTOP_RESET, "out of emergency stop")
key("key", "F2")
until(lambda: s.task_state == linuxcnc.STATE_ON, "on")
key("key", "ctrl+Home")
until(lambda: all(s.homed[:3]) and s.inpos, "homed")
key("keydown", "Right")
until(lambda: s.position[0] > 1.0, "jogging")
key("keyup", "Right")
until(lambda: s.current_vel == 0 and s.inpos and s.position[0] > 1.0, "stopped on release")
time.sleep(0.3)
key("key", "r")
until(lambda: s.interp_state != linuxcnc.INTERP_IDLE, "running")
key("key", "Escape")
until(lambda: s.interp_state == linuxcnc.INTERP_IDLE and s.current_vel == 0, "aborted")
subprocess.run(["xdotool", "windowclose", window[0]])
END
wait $session
echo "session ended with $?"
