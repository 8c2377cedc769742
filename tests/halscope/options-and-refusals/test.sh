#!/bin/bash
# How halscope is called: options, sizes, no display, a second one, no realtime; and how scope_rt is loaded.
export KERF_CLOCK=virtual
here=$PWD
scratch=$(mktemp -d)
cd $scratch
say() { echo "=> $?"; }
shown() { timeout 60 $here/../../lib/with-display 800x600 "$@" 2>&1; }
# Runs halscope until its window is there, then ends it as `halcmd unload` does.
cat > once.py <<'PY'
import os
import signal
import sys
import kerf.halscope.main
import kerf.halscope.screen as screen


class Once(screen.Screen):
    def __init__(self, root, settings, acq, style):
        super().__init__(root, settings, acq, style)
        print("samples", acq.samples, flush=True)
        root.after(100, lambda: os.kill(os.getpid(), signal.SIGTERM))


screen.Screen = Once
sys.exit(kerf.halscope.main.main(sys.argv[1:]))
PY
halscope -h | sed -n 1p; say
env -u DISPLAY halscope 2>&1; say
halscope -z 2>&1 | sed -n 1p
halscope 1x 2>&1 | sed -n 1p
halscope 1 2 2>&1 | sed -n 1p
echo "# no realtime"
shown /usr/bin/python3 once.py; say
realtime start 2>/dev/null
for n in 10 999 1000001 x; do halcmd loadrt scope_rt num_samples=$n 2>/dev/null; say; done
halcmd list funct scope
echo "# sizes: of the command line, of the configuration, clamped"
shown /usr/bin/python3 once.py -o out.halscope 500; say
halcmd unloadrt scope_rt
printf '# SAMPLES 7000\nFROB 1\n' > in.halscope
shown /usr/bin/python3 once.py -i in.halscope -o out.halscope; say
head -2 out.halscope
shown /usr/bin/python3 once.py -i in.halscope -o no/such/folder 2000; say
echo "# a second one"
cat > second.py <<'PY'
import subprocess
import time
import hal
c = hal.component("halscope")
c.ready()
process = subprocess.Popen(["halscope"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
subprocess.run(["xdotool", "search", "--sync", "--onlyvisible", "--class", "dialog"], stdout=subprocess.DEVNULL)      # the box that says so
for _ in range(100):
    if process.poll() is None:
        subprocess.run(["xdotool", "key", "Return"])
        time.sleep(0.2)
print(process.communicate()[0].splitlines()[-1], process.returncode)
PY
shown /usr/bin/python3 second.py
halcmd list comp | tr ' ' '\n' | grep -c halscope
halcmd unload all
realtime stop
rm -rf $scratch
