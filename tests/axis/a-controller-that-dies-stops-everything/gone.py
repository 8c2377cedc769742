#!/usr/bin/python3
# VICTIM display: the screen is killed while a jog key is held. VICTIM halui: the other operator's interface is.
import os
import re
import signal

import hal
import linuxcnc
import operator_lib as lib
import session
from kerf import clock


def onlooker(out):
    """Every cycle of the realtime part, to its last."""
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    os.setsid()
    clock.join("onlooker", 900)
    enabled, at, before = True, 0.0, 1.0
    try:
        while True:
            enabled, before, at = hal.get_value("joint.0.amp-enable-out"), at, hal.get_value("joint.0.motor-pos-cmd")
            clock.sleep(0.001)
    except RuntimeError:        # the pins are gone
        pass
    print("the screen is killed: at the end the joint is enabled:", bool(enabled), "and", "moves" if at != before else "stands", file=out)
    out.close()
    os.rename("../seen.new", "../seen")
    os._exit(0)


def script(op):
    out = open("../seen.new", "w", buffering=1)
    op.power_on()
    op.home()
    op.hold("Left")
    op.wait(0.3)
    print("moves:", abs(op.stat.joint[0]["velocity"]) > 0, file=out)
    if os.environ["VICTIM"] == "display":
        if os.fork() == 0:
            onlooker(out)
        clock.sleep(0.05)
        os.kill(os.getpid(), signal.SIGKILL)
    session.kill("halui")
    op.wait(0.5)
    print("halui is killed: still", "moves" if abs(op.stat.joint[0]["velocity"]) > 0 else "stands", end=", ", file=out)
    op.let_go("Left")
    op.wait(1.0)
    print("let go:", "moves" if abs(op.stat.joint[0]["velocity"]) > 0 else "stands", end=", ", file=out)
    op.key("F5")
    op.type("G0 X1")
    op.idle()
    print("the screen goes on:", op.position(0) == 1.0, file=out)
    op.until(op.messages, "a message of halui's end", 1e6)       # the launcher sees it within a moment of real time
    print(re.sub(r"\d+", "N", " ".join(op.messages())), file=out)
    out.close()
    os.rename("../seen.new", "../seen")


lib.run(script)
