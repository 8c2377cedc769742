# SPDX-License-Identifier: GPL-2.0-or-later
# FP-132: the tool table or the parameter file can not be written (a full disk, rights; here a folder stands in the
# way): the operator is told, once until it works again, the old file stays, and the next save has everything.
import os
from mill import *


def file_of(word, name):
    return [l.strip() for l in open(name) if l.startswith(word)]


on()
mdi("G10 L2 P1 X1")
mdi("M66 P0 L0")
os.mkdir("mill.tbl.new")
print("tools:", mdi("G10 L1 P1 Z3"), messages(), file_of("T1 ", "mill.tbl"))
print("program:", run("G0 X3\nG10 L1 P1 Z4\nG0 X5\nM2\n"), xyz(), messages(), poll().error_line)
os.rmdir("mill.tbl.new")
print("tools:", mdi("G10 L1 P2 R1"), messages(), file_of("T1 ", "mill.tbl"), file_of("T2 ", "mill.tbl"))
os.mkdir("mill.var.new")
for n in range(3):
    print("parameters:", mdi(f"G10 L2 P1 X{n + 7}"), mdi("M66 P0 L0"), messages(), file_of("5221", "mill.var"))
os.rmdir("mill.var.new")
print("parameters:", mdi("M66 P0 L0"), messages(), file_of("5221", "mill.var"))
os.mkdir("mill.var.new")
print("again:", mdi("G10 L2 P1 X2"), mdi("M66 P0 L0"), messages(), file_of("5221", "mill.var"))
os.rmdir("mill.var.new")
