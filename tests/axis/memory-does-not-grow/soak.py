#!/usr/bin/python3
import os
from statistics import median

import linuxcnc
import operator_lib as lib
from kerf import clock
from process_sizes import sizes

HOURS = float(os.environ.get("SOAK_HOURS", "0.05"))
LOOKS = 20
KEYS = ("v", "at", "numbersign", "exclam", "F4", "5", "0", "F3", "F5", "F3")
LIMIT_KB = 3000              # of growth in the second half


def report(hour, found):
    with open(os.environ.get("SOAK_REPORT", "/dev/stderr"), "a") as f:
        print(f"{hour:6.2f} h:", *(f"{name} {kb} kB {files} files;" for name, (kb, files) in sorted(found.items())),
              file=f)


def script(op):
    out = open("transcript", "w", buffering=1)
    print("drawn with:", op.app.preview.picture.kind, file=out)
    lib.CYCLE_S = 0.5
    op.power_on()
    op.home()
    op.app.accept_limits = lambda: True
    op.key("r")
    op.wait(5)
    print("runs:", op.stat.interp_state != linuxcnc.INTERP_IDLE, file=out)
    samples, began = [], clock.now()
    for turn in range(LOOKS):
        for _ in range(2 if HOURS < 1 else 20):
            op.wait(HOURS * 3600 / LOOKS / (2 if HOURS < 1 else 20))
            op.key(KEYS[turn % len(KEYS)])
        op.app.notifications.clear()
        samples.append(sizes())
        if HOURS >= 1:
            report((clock.now() - began) / 3600, samples[-1])
    print("still runs:", op.stat.interp_state != linuxcnc.INTERP_IDLE, file=out)
    grown = {}
    for name in samples[-1]:
        kb = [s[name][0] for s in samples if name in s]
        if len(kb) < LOOKS:          # it came and goes again
            continue
        # by the least and by the middle of five looks: for a while a child that is started makes pages private, a new
        # estimate or preview takes room, and between two of them there is less than else
        growth = min(of(kb[-5:]) - of(kb[8:13]) for of in (min, median))
        if growth > LIMIT_KB or samples[-1][name][1] > samples[LOOKS // 2][name][1] + 2:
            grown[name] = [s.get(name) for s in samples]
    if len(samples[-1]) > len(samples[LOOKS // 2]) + 2:
        grown["processes"] = [len(s) for s in samples]
    print("processes watched, the X server among them:",
          len(samples[-1]) >= 6 and any(name.startswith("Xvfb") for name in samples[-1]), "grown in the second half:",
          grown, file=out)


lib.run(script)
