# SPDX-License-Identifier: GPL-2.0-or-later
# FP-086: the table is checked when it is read; the operator is told file, line and column. It begins with a byte order mark.
from mill import *

sleep(0.1)
for m in messages():
    print(m)
open("mill.tbl", "a").write("T20 P20 Dx\n")
on()
c.load_tool_table()
print(c.wait_complete(), [m for m in messages() if ":8:" in m])
import os
os.remove("mill.tbl")
c.load_tool_table()
print(c.wait_complete(), messages(), [t.id for t in poll().tool_table if t.id > 0])
