# SPDX-License-Identifier: GPL-2.0-or-later
# FP-088: what G10 or a screen sets is in the database before the command is done: its program is
# killed after that, and the next reload tells the operator and goes on with the table file.
import os
import signal
import subprocess
from mill import *


def log():
    text = open("db.log").read().split("\n")[:-1] if os.path.exists("db.log") else []
    if text:
        os.remove("db.log")
    return text


on()
print([(t.id, t.zoffset) for t in poll().tool_table if t.id > 0])
print(mdi("T10 M6"), poll().tool_in_spindle, log())
print(mdi("G10 L1 P2 Z51.25 R3.5"), log())
print(mdi("G10 L1 P10 Z62.5"), log(), poll().tool_table[0].zoffset)
c.tool_offset(10, 63, 0, 4, 0, 0, 1)
print(c.wait_complete(), log(), poll().tool_table[0].zoffset)
print(mdi("T1 M6"), mdi("T0 M6"), log(), poll().tool_in_spindle)
print(open("db.txt").read())
c.load_tool_table()
print(c.wait_complete(), [(t.id, t.zoffset, t.diameter) for t in poll().tool_table if t.id > 0])
db = int(subprocess.run(["pgrep", "-n", "-f", os.getcwd() + "/db|./db"], stdout=subprocess.PIPE, text=True).stdout)
os.kill(db, signal.SIGKILL)
messages()
print(mdi("G10 L1 P2 Z1"), messages())
c.load_tool_table()
print(c.wait_complete(), messages()[-1:], [t.id for t in poll().tool_table if t.id > 0])
