# SPDX-License-Identifier: GPL-2.0-or-later
"""Words in any order and case, comments, lines that are not understood; lookups by number."""
from harness import *

table = """;comment line
T1 P1 D6 Z12.3456 ;endmill
t3 p7 x1 Y2 z3 a4 b5 c6 u7 v8 w9 i10 j20 q3
T5 P5 K9 ;no such letter
T9 P9 Z1.5e1junk
P11 T11 Z+2

   ;blank and comment
T12\tP12 Z1
"""
run = rs274("G43 H1\nG43 H3\nG43 H9\nG43 H11\nT3 M6\nM2\n", tools=table)
check(run.status == 0, run.err)
offsets = [v for n, v in run.calls if n == "USE_TOOL_LENGTH_OFFSET"]
mm = lambda *v: [round(x * 25.4, 4) if i < 3 or i > 5 else x for i, x in enumerate(v)]
check(near(offsets[0], mm(0, 0, 12.3456, 0, 0, 0, 0, 0, 0)), offsets[0])
check(near(offsets[1], mm(1, 2, 3, 4, 5, 6, 7, 8, 9)), offsets[1])
check(near(offsets[2], mm(0, 0, 15, 0, 0, 0, 0, 0, 0)), offsets[2])
check("Unrecognized line skipped:\n    T5 P5 K9 ;no such letter" in run.out, run.out)
rejected = rs274("T5\nM2\n", tools=table).err.splitlines()
check(any("4:7: the line is skipped: 'K9'" in line for line in rejected), rejected)
check("Requested tool 5 not found in the tool table" in rejected, rejected)
check("Requested tool 2 not found in the tool table" in rs274("T2\nM2\n", tools=table).err.splitlines(), "unknown tool")
run = rs274("T1 M6\nM61 Q3\nG10 L1 P1 Z5\nM2\n", tools=table)
check([v[:2] for n, v in run.calls if n == "SET_TOOL_TABLE_ENTRY"] == [[1, 1]], "not the tool in the spindle")
run = rs274("T1 M6\n(print,#5400 #5403 #5410)\nG10 L1 P1 Z5 R1 I11 J12 Q4\n(print,#5403 #5410 #5411 #5412 #5413)\nM2\n",
            tools=table)
check(run.printed[2] == "1.000000 12.345600 6.000000", run.printed)
entries = [v for n, v in run.calls if n == "SET_TOOL_TABLE_ENTRY"]
check(len(entries) == 2 and entries[0][:2] == [1, 1] and entries[1][:2] == [0, 1], entries)
check(run.printed[3].split()[2:] == ["11.000000", "12.000000", "4.000000"], run.printed)
run = rs274("M2\n", "-t", "nothere.tbl")
check("Failed to open tool table file 'nothere.tbl'" in run.err and run.status == 0, run.err)
done()
