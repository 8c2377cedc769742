#!/usr/bin/python3
import os
import re
import signal

import hal
import hal.query
import operator_lib as lib
from axis import dialogs


def script(op):
    out = open("transcript", "w", buffering=1)
    app = op.app

    def killed(what, pid):
        os.kill(pid, signal.SIGKILL)
        op.until(op.messages, f"{what} is told", 1e6)       # processes end in wall time
        op.wait(0.5)
        print(what, [re.sub(r"\d+", "N", m) for m in op.messages()], file=out)
        app.notifications.clear()
    op.power_on()
    op.home()
    side = hal.query.comp("side")["pid"]
    print("checked:", hal.get_value("checked"), file=out)
    killed("a panel that POSTGUI loaded", side)
    print("checked:", hal.get_value("checked"), file=out)
    tab = int(open("../tab").read())
    killed("a program in a tab", tab)
    op.hold("Left")
    op.wait(0.3)
    print("the screen goes on: jogs", op.stat.joint[0]["velocity"] != 0, file=out)
    op.let_go("Left")
    op.wait(0.5)
    asked = []
    dialogs.ask = lambda root, title, text, *more, **options: asked.append(text) or 1
    app.confirm_close()
    app.spindle(1)               # FP-140: the exit dialog names a running spindle
    op.wait(0.3)
    app.confirm_close()
    op.key("r")
    op.wait(0.3)
    app.confirm_close()
    print(*asked, sep="\n", file=out)
    op.key("Escape")
    op.wait(0.5)


lib.run(script)
