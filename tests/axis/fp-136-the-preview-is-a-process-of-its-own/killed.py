#!/usr/bin/python3
"""A screen that is killed leaves neither the process that reads nor a filter with what it started."""
import os
import signal
import subprocess
import sys
import time

SCREEN = """
import subprocess, sys, threading, time
from axis.reading import Reading
from kerf import process
reading = Reading(dict(filename="endless.ngc", parameter_file="var"), 100.0, [], 1000.0, 400)
threading.Thread(target=reading.result, daemon=True).start()
import os
filter = subprocess.Popen([sys.executable, process.__file__, str(os.getpid()), "sh", "-c", "sleep 1234567 & echo $! $$; wait"], stdout=subprocess.PIPE, text=True)
print(reading.child.pid, filter.pid, filter.stdout.readline().strip(), flush=True)
time.sleep(1000)
"""


def alive(pid):
    try:
        with open(f"/proc/{pid}/stat") as f:
            return f.read().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


os.chdir(sys.argv[1])
screen = subprocess.Popen([sys.executable, "-c", SCREEN], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
pids = [int(word) for word in screen.stdout.readline().split()]
print("running:", [alive(pid) for pid in pids])
screen.send_signal(signal.SIGKILL)
screen.wait()
while any(map(alive, pids)):                     # the test's own time limit ends a failure
    time.sleep(0.02)
print("left behind:", [alive(pid) for pid in pids])
