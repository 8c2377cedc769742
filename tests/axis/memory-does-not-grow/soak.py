#!/usr/bin/python3
import os
import sys

import linuxcnc
import operator_lib as lib

HOURS = float(os.environ.get("SOAK_HOURS", "0.05"))
KEYS = ("v", "at", "numbersign", "exclam", "F4", "5", "0", "F3", "F5", "F3")


def memory_kb():
    with open("/proc/self/status") as f:
        return next(int(line.split()[1]) for line in f if line.startswith("VmRSS"))


def script(op):
    out = open("transcript", "w", buffering=1)
    lib.CYCLE_S = 0.5
    op.power_on()
    op.home()
    op.app.accept_limits = lambda: True
    op.key("r")
    op.wait(5)
    print("runs:", op.stat.interp_state != linuxcnc.INTERP_IDLE, file=out)
    samples = []
    for turn in range(20):
        op.wait(HOURS * 3600 / 20)
        op.key(KEYS[turn % len(KEYS)])
        op.app.notifications.clear()
        samples.append(memory_kb())
    print("still runs:", op.stat.interp_state != linuxcnc.INTERP_IDLE, file=out)
    growth = max(samples[-3:]) - max(samples[8:11])
    print("growth in the second half below 3 MB:", True if growth < 3000 else samples, file=out)
    print("axis soak", HOURS, "hours, kB:", samples, file=sys.stderr)


lib.run(script)
