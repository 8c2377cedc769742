#!/usr/bin/env python3
import linuxcnc
s = linuxcnc.stat()
s.poll()
print("in the spindle:", s.tool_in_spindle, s.tool_table[0].id)
for t in s.tool_table[1:4]:
    print("T%d Z%.3f D%.3f" % (t.id, t.zoffset, t.diameter))
info = s.toolinfo(1)
print(info["toolno"], info["pocketno"], round(info["zoffset"], 3), info["comment"])
