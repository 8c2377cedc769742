#!/usr/bin/python3
import os
import signal

import hal
import operator_lib as lib
import session
from kerf import clock


def enabled():
    try:
        return bool(hal.get_value("joint.0.amp-enable-out"))
    except RuntimeError:                 # the machine is taken down already
        return False


def script(op):
    out = open("../transcript", "w", buffering=1)
    op.power_on()
    op.home()
    op.hold("Left")
    op.wait(0.3)
    print("moves:", abs(op.stat.joint[0]["velocity"]) > 0, file=out)
    ended = []                           # the launcher ends the screen
    for end in (signal.SIGINT, signal.SIGTERM):
        signal.signal(end, lambda *_: ended.append(True))
    session.kill("milltask")
    for _ in range(500):
        clock.sleep(0.02)
        if ended or not op.app.tick() or not enabled():
            break
    else:
        print("nothing happened within 10 s", file=out)
    print("joint enabled:", enabled(), file=out)
    os._exit(0)


lib.run(script)
