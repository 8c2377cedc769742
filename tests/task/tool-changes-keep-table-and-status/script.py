# SPDX-License-Identifier: GPL-2.0-or-later
from mill import *


def tool(what):
    poll()
    t = s.tool_table[0]
    print(f"{what:10} in spindle {s.tool_in_spindle} from {s.tool_from_pocket} prepared {s.pocket_prepped} spindle "
          f"entry {t.id} {t.zoffset} {t.diameter}"
          f" pins {getp('iocontrol.0.tool-number')} {getp('iocontrol.0.tool-prep-number')}", messages())


on()
tool("start")
print(mdi("T2"))
tool("T2")
print(mdi("M6"))
tool("M6")
print(mdi("G43"), poll().tool_offset[2])
print(mdi("M6"), messages())
print(mdi("T9 M6"), messages())
print(mdi("T2 M6"))
tool("same")
print(mdi("T0 M6"))
tool("T0")
print(mdi("M61 Q3"))
tool("M61")
print(mdi("G10 L1 P3 Z7 R2"), [(t.id, t.zoffset, t.diameter) for t in poll().tool_table])
print(open("mill.tbl").read())
c.tool_offset(3, 1.5, 0.5, 3.0, 0, 0, 1)
print(c.wait_complete(), poll().tool_table[0][:4], s.tool_table[0].orientation)
c.load_tool_table()
print(c.wait_complete(), poll().tool_table[0].zoffset, messages())
print(mdi("G10 L0"), messages())
print(s.toolinfo(3)["comment"], s.toolinfo(4)["diameter"])
for number in (0, 99):
    try:
        s.toolinfo(number)
    except ValueError as x:
        print(x)
# A change that is not answered waits; an abort ends it and drops the request.
halcmd("unlinkp", "iocontrol.0.tool-changed")
setp("iocontrol.0.tool-changed", 0)
mode(MODE_MDI)
c.mdi("T1 M6")
sleep(2)
poll()
print("waits", s.interp_state, s.exec_state, getp("iocontrol.0.tool-change"), getp("iocontrol.0.tool-prep-number"))
c.abort()
sleep(0.1)
poll()
print("aborted", s.interp_state, s.exec_state, s.state, getp("iocontrol.0.tool-change"), s.tool_in_spindle)
setp("iocontrol.0.tool-changed", 1)
# The table on disk gets another order between T and M6: the tool counts, not its place. One
# that is gone is not changed in.
table = open("mill.tbl").read()
for name, text in (("moved", "T77 P77 Z7\n" + table),
                   ("gone", "\n".join(l for l in table.splitlines() if not l.startswith("T4")) + "\n")):
    mdi("T1 M6")
    print(mdi("T4"), messages())
    open("mill.tbl", "w").write(text)
    c.load_tool_table()
    print(c.wait_complete(), messages())
    print(mdi("M6"), messages(), getp("iocontrol.0.tool-prep-index"))
    tool(name)
