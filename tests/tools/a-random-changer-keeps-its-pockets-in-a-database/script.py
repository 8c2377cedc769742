# SPDX-License-Identifier: GPL-2.0-or-later
# FP-084, FP-088: with a random changer the database hears who goes to which pocket, and after each step, a
# reload and a stop in the middle, shared data, status and database agree.
import os

from mill import *


def log():
    text = open("db.log").read().split("\n")[:-1] if os.path.exists("db.log") else []
    if text:
        os.remove("db.log")
    return text


def show(what, result=""):
    poll()
    print(f"{what}: {result} T{s.tool_in_spindle} number {getp('iocontrol.0.tool-number')} from {s.tool_from_pocket} "
          f"{tools_in_pockets()}",
          "" if tools_in_pockets() == (kept := tools_in_pockets("db.txt")) else f"DATABASE {kept}", log(), messages())


on()
show("start")
show("T3 M6", mdi("T3 M6"))
show("T30 M6", mdi("T30 M6"))
show("T30 again", mdi("T30 M6"))
show("M61 Q7", mdi("M61 Q7"))
show("unknown tool", mdi("T99 M6"))
show("G10 L1 of the tool in the spindle", mdi("G10 L1 P7 Z71"))
show("G10 L1 of another", mdi("G10 L1 P12 Z46"))
mdi("G43")
print(poll().tool_offset[2], s.tool_table[0].zoffset)
mdi("G49")
c.load_tool_table()
show("reload", c.wait_complete())
for moment in ("prepare", "change"):
    halcmd("unlinkp", f"iocontrol.0.tool-{moment}d")
    setp(f"iocontrol.0.tool-{moment}d", 0)
    mode(MODE_MDI)
    c.mdi("T3 M6")
    need(lambda s: getp(f"iocontrol.0.tool-{moment}") == "TRUE", moment)
    c.abort()
    c.wait_complete()
    sleep(0.1)
    show(f"stopped in {moment}")
    halcmd("net", f"tool-{moment}", f"iocontrol.0.tool-{moment}d")
show("afterwards", mdi("T12 M6"))
