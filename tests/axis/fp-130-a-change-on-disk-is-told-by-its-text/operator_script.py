#!/usr/bin/python3
import hashlib
import os
import sys

import linuxcnc
import operator_lib as lib
from axis.program import properties


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    app, path = op.app, os.path.abspath(sys.argv[-1])
    op.power_on()
    op.home()
    with open(path) as f:
        text = f.read()
    digest = hashlib.sha256(text.encode()).hexdigest()

    seen = []

    def told(wait=0.5):
        """What was told since the last time."""
        op.wait(wait)
        news = op.messages()[len(seen):]
        seen.extend(news)
        return ["changed" if "on disk" in m else "gone" if "gone from" in m else "open it again" if "open it again" in m
                else m for m in news]

    def runs():
        op.key("r")
        op.wait(0.2)
        started = op.stat.interp_state != linuxcnc.INTERP_IDLE
        op.idle()
        return "started" if started else "not started", app.line_text(3), told(0)

    def write(new, times=None):
        with open(path, "w") as f:
            f.write(new)
        if times:
            os.utime(path, ns=times)

    def shown():
        return dict(properties(app.shown_file, None, app.preview.program, app.settings, True,
                               kept=app.kept))["SHA-256"].replace("\n", "") == digest

    print("task has the hash:", op.stat.program_hash == digest, "properties:", shown())
    os.utime(path, (1, 1))
    print("another time:", told(), runs())
    write(text)
    print("saved without a change:", told(), runs())
    before = os.stat(path)
    write(text.replace("Y20", "Y25"), (before.st_atime_ns, before.st_mtime_ns))
    print("another text of the same length, with the same time:", told(), runs(),
          "properties of what is loaded:", shown())
    write(text)
    print("taken back:", told(), runs())
    write(text.replace("Y20", "Y25"))
    print("changed again:", told())
    digest = hashlib.sha256(text.replace("Y20", "Y25").encode()).hexdigest()
    op.key("r", state=4)         # Control-R: reload
    print("reloaded:", told(), "properties:", shown(), runs())
    os.remove(path)
    print("removed:", told())


lib.run(script)
