# SPDX-License-Identifier: GPL-2.0-or-later
# FP-080, FP-084: pockets differ from numbers; T of the tool in the spindle drops older preselections;
# an abort at each moment of a change leaves table, status and file agreeing.
from mill import *


def show(what, result=""):
    poll()
    shared, kept = tools_in_pockets(), tools_in_pockets("mill.tbl")
    print(f"{what:24} {result} T{s.tool_in_spindle} prepared {s.pocket_prepped} number "
          f"{getp('iocontrol.0.tool-number')} table {shared}",
          "" if shared == kept else f"FILE {kept}", messages())


on()
show("start")
show("T12 M6", mdi("T12 M6"))
mdi("T3")
mdi("T30")
show("T12 M6, it is in", mdi("T12 M6"))
mdi("T3")
show("T30 M6", mdi("T30 M6"))
show("M6 alone", mdi("M6"))
show("M61 Q3", mdi("M61 Q3"))
show("T0 M6", mdi("T0 M6"))
show("T99", mdi("T99 M6"))
show("G10 L1", mdi("G10 L1 P30 Z33"))
mdi("T12 M6")
mdi("G43")
print(poll().tool_offset[2], s.tool_table[0].zoffset)
for tool in (30, 12, 99):   # in its pocket, in the spindle, nowhere: no other tool's record is overwritten
    c.tool_offset(tool, 34.5, 0, 4, 0, 0, 0)
    show(f"tool_offset T{tool}", c.wait_complete())
    print([l.split()[0] for l in open("mill.tbl") if "Z+34.5" in l or "Z34.5" in l])
c.load_tool_table()
show("reload", c.wait_complete())
for moment in ("prepare", "change"):
    for stop in (c.abort, lambda: c.state(STATE_ESTOP), lambda: c.state(STATE_OFF)):
        halcmd("unlinkp", f"iocontrol.0.tool-{moment}d")
        setp(f"iocontrol.0.tool-{moment}d", 0)
        mode(MODE_MDI)
        c.mdi("T30 M6")
        need(lambda s: getp(f"iocontrol.0.tool-{moment}") == "TRUE", moment)
        stop()
        c.wait_complete()
        setp(f"iocontrol.0.tool-{moment}d", 1)
        sleep(0.1)
        show(f"stopped in {moment}")
        setp(f"iocontrol.0.tool-{moment}d", 0)
        halcmd("net", f"tool-{moment}", f"iocontrol.0.tool-{moment}d")
        if poll().task_state != STATE_ON:
            on(home=False)
show("afterwards", mdi("T30 M6"))
