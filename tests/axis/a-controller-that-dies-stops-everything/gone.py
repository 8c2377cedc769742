#!/usr/bin/python3
# VICTIM display: the screen is killed while a jog key is held, and comes again. VICTIM halui: the other operator's
# interface is.
import os
import re
import signal

import linuxcnc
import operator_lib as lib
import session


def script(op):
    out = open("../seen.new", "a", buffering=1)
    if op.app.former is not None:            # the screen that came after the killed one
        op.wait(0.1)
        print("stopped within 2 mm:", abs(op.position(0) - float(open("../at").read())) < 2, "stands:",
              not any(j["velocity"] for j in op.stat.joint[:3]),
              "still on:", op.stat.task_state == linuxcnc.STATE_ON, op.messages()[1:], file=out)
        op.wait(1.0)
        print("nothing starts by itself:", not any(j["velocity"] for j in op.stat.joint[:3]), file=out)
        op.hold("Left")
        op.wait(0.3)
        print("moves:", abs(op.stat.joint[0]["velocity"]) > 0, file=out)
        op.let_go("Left")
        out.close()
        os.rename("../seen.new", "../seen")
        return
    op.power_on()
    op.home()
    op.hold("Left")
    op.wait(0.3)
    print("moves:", abs(op.stat.joint[0]["velocity"]) > 0, file=out)
    if os.environ["VICTIM"] == "display":
        with open("../at", "w") as at:
            print(op.position(0), file=at)
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
