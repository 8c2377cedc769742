# SPDX-License-Identifier: GPL-2.0-or-later
# FP-082, FP-086: comments, blank lines, lines of others, long comments and all digits survive a
# save, whatever the locale; the file keeps its place behind a link, and the old one is beside it.
import os
from mill import *

os.rename("mill.tbl", "real.tbl")
os.symlink("real.tbl", "mill.tbl")
os.chmod("real.tbl", 0o640)
old = open("real.tbl", newline="").read()
on()
print([(t.id, t.zoffset, t.diameter) for t in poll().tool_table if t.id > 0])
print(mdi("G10 L1 P1 Z46.5"))
print(open("mill.tbl", newline="").read())
print(os.path.islink("mill.tbl"), oct(os.stat("real.tbl").st_mode & 0o777),
      open("real.tbl.bak", newline="").read() == old)
print(mdi("G10 L1 P1 Z46.25"), mdi("G10 L1 P1 Z46.5"))
again = open("mill.tbl", newline="").read()
print(mdi("G10 L1 P1 Z46.5"), again == open("mill.tbl", newline="").read())
# A table that can not be written ends the command with an error the operator sees.
messages()
os.remove("mill.tbl")
os.mkdir("mill.tbl")
print(mdi("G10 L1 P1 Z40"), [m.rsplit(":", 1)[0] for m in messages()])
