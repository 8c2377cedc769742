# SPDX-License-Identifier: GPL-2.0-or-later
"""FP-132: written atomically with the old version kept; a damaged file is named by line and left alone; an empty
one is reported; cut at every byte it never crashes the interpreter."""
import os
from harness import *

state = {}


def remember(d):
    state["text"] = open(d + "/p.var").read()
    state["bak"] = open(d + "/p.var.bak").read() if os.path.exists(d + "/p.var.bak") else None
    state["files"] = sorted(os.listdir(d))


good = "5161\t1.500000\n5220\t2.000000\n31\t-7.25\n5241\t3.0\n"
good = "31\t-7.25\n; a note\n5161\t1.500000\n5220\t2.000000\n5241\t3.0\n"
run = rs274("(print,#31 #5161 #5220 #5241)\n#31=8\n#32=9\nM2\n", var=good, keep=remember)
check(run.printed == ["-7.250000 1.500000 2.000000 3.000000"], run.printed)
lines = dict(l.split("\t") for l in state["text"].split("\n") if l)
check(lines["31"] == "8.000000" and "32" not in lines and len(lines) == 1 + 9 + 9 + 10 + 11 + 8 * 10, len(lines))
check([int(k) for k in lines] == sorted(int(k) for k in lines), "ascending")
check(state["bak"] is not None and "p.var.new" not in state["files"], "the old version is kept, nothing else left")
# written at once at the start, too
rs274("M2\n", keep=remember)
check("5220\t1.000000\n" in state["text"], "a new file")

for text, want, line in (("5161\t1\n5160\t2\n", "Parameter file out of order", 2),
                         ("31 1\n31 2\n", "Parameter file out of order", 2),
                         ("5602\t1\n", "Parameter number out of range", 1),
                         ("1 1\n0 1\n", "Parameter number out of range", 2)):
    run = rs274("M2\n", var=text, keep=remember)
    check(run.status == 1 and run.error == want, run.err)
    check(state["text"] == text and "p.var.new" not in state["files"], "a damaged file is left alone")
run = rs274("(print,#5220)\nM2\n", var="\n", keep=remember)
check("p.var: no line holds" in run.err and run.printed == ["1.000000"], run.err)
for cut in range(len(good)):
    run = rs274("(print,#31)\nM2\n", var=good[:cut] or " ", keep=remember)
    check(run.status in (0, 1) and run.out.endswith("\n"), f"cut at {cut}: {run.err}")
    check(run.status == 0 or state["text"] == good[:cut], f"cut at {cut}: overwritten")
run = rs274("M2\n", "-v", "/no/such/folder/x.var")
check(run.status == 0, run.err)
done()
