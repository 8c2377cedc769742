#!/usr/bin/python3
import ctypes
import os

import operator_lib as lib


def script(op):
    with open("transcript", "w") as out:
        # Task tells of a run that was cut off, if it had begun.
        print([m.split("Report:")[0] for m in op.messages() if "run was cut off" not in m], file=out)
    if os.environ["RUN"] == "crash":
        if op.app.former is None:
            op.power_on()
            op.home()
            for n in range(3000):
                op.app.recorder.note("a jog", n)
            op.key("r")
            op.wait(0.2)
        else:
            op.idle()
        ctypes.string_at(0)


lib.run(script)
