# SPDX-License-Identifier: GPL-2.0-or-later
"""watcher.py VICTIM FOLDER: runs a program, kills the victim and writes to FOLDER/seen what became of the outputs."""
import os
import resource
import signal
import sys
import time
from pathlib import Path

import hal
import linuxcnc
import session
from kerf import clock

victim, folder = sys.argv[1], Path(sys.argv[2])
PINS = ("spindle.0.on", "motion.motion-enabled", "joint.0.amp-enable-out", "motion.digital-out-00",
        "motion.analog-out-00")
SIGNALS = ("flood", "mist", "estop-loop")
clock.join("observer", 900)
me = hal.component("observer")
me.ready()
s, c = linuxcnc.stat(), linuxcnc.command()
for order in (linuxcnc.STATE_ESTOP_RESET, linuxcnc.STATE_ON):
    c.state(order)
    c.wait_complete()
c.mode(linuxcnc.MODE_AUTO)
NAMES = "".join(f"#<name{n}> = 1\n" for n in range(100000)) if victim == "memory" else ""
(folder / "p.ngc").write_text("M3 S1000\nM7\nM8\nM64 P0\nM68 E0 Q5\nF30\nG1 X1\n" + "G1 X0\nG1 X1\n" * 600 + NAMES
                              + "G1 X300\nX0\nM2\n")
c.program_open(str(folder / "p.ngc"))
c.auto(linuxcnc.AUTO_RUN, 0)


def high():
    return [p for p in PINS if hal.get_value(p)] + [x for x in SIGNALS if hal.get_value(x)]


def moving():
    a = hal.get_value("joint.0.motor-pos-cmd")
    clock.sleep(0.01)
    return hal.get_value("joint.0.motor-pos-cmd") != a


while not (len(high()) == len(PINS) + len(SIGNALS) and moving()):
    clock.sleep(0.01)
if os.fork():
    if victim == "display":     # it ends
        os._exit(0)
    if victim == "launcher-and-task":
        launcher = os.getppid()
        guard = int(Path(f"/proc/{launcher}/stat").read_text().rsplit(")", 1)[1].split()[1])
        for signal_number in (signal.SIGSTOP, signal.SIGKILL):      # neither sees the other one end
            for pid in (guard, launcher):
                os.kill(pid, signal_number)
    if victim == "memory":      # task gets no more than it has: reading ahead ends it
        for pid in session.processes("milltask"):
            resource.prlimit(pid, resource.RLIMIT_AS, (1, resource.RLIM_INFINITY))
    else:
        session.kill("milltask")
    clock.leave()
    signal.pause()
signal.signal(signal.SIGTERM, signal.SIG_IGN)    # a child looks on, to see what comes after
os.setsid()
clock.join("onlooker", 900)
left, at, before = high(), 0.0, 1.0
still, end = 0, time.monotonic() + 60      # what stops it lives in wall time
# every cycle of the realtime part, to its last; nobody ends it when the launcher is gone too
try:
    while victim != "launcher-and-task" or (still < 500 and time.monotonic() < end):
        still = still + 1 if before == at and not left else 0
        left, before, at = high(), at, hal.get_value("joint.0.motor-pos-cmd")
        clock.sleep(0.001)
except RuntimeError:        # the pins are gone
    pass
(folder / "seen.new").write_text(f"    still on at the end: {left}, motion {'goes on' if at != before else 'stands'}\n")
os.rename(folder / "seen.new", folder / "seen")
os._exit(0)
