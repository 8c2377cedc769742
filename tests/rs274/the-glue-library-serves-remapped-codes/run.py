# SPDX-License-Identifier: GPL-2.0-or-later
"""stdglue: T, M6, M61, S, F and cycles by procedures; its errors."""
import os

from harness import *

TOP = os.path.abspath("../../..")
LIB = os.path.join(TOP, "nc_files/remap_lib/python-stdglue")
INI = f"""[EMC]
VERSION=1.1
[TRAJ]
LINEAR_UNITS=mm
[PYTHON]
TOPLEVEL={LIB}/python/toplevel.py
PATH_PREPEND={LIB}/python
PATH_APPEND={LIB}
[RS274NGC]
SUBROUTINE_PATH=subs
REMAP=T prolog=prepare_prolog ngc=prepare epilog=prepare_epilog
REMAP=M6 modalgroup=6 prolog=change_prolog ngc=change epilog=change_epilog
REMAP=M61 modalgroup=6 prolog=settool_prolog ngc=settool epilog=settool_epilog
REMAP=S prolog=setspeed_prolog ngc=setspeed epilog=setspeed_epilog
REMAP=F prolog=setfeed_prolog ngc=setfeed epilog=setfeed_epilog
REMAP=G84.2 modalgroup=1 argspec=xyzqpr prolog=cycle_prolog ngc=cycle epilog=cycle_epilog
"""
TOOLS = "T5 P7 Z1\nT2 P4 Z2\nT3 P9 Z3\n"


def run(program, codes=None, ini=INI):
    codes = {"prepare": 1, "change": 1, "settool": 1, "setspeed": 1, "setfeed": 1, **(codes or {})}
    subs = {f"subs/{name}.ngc": f"o<{name}> sub\n{body}\no<{name}> "
                                f"endsub{'' if codes[name] is None else f' [{codes[name]}]'}\n" for name, body in (
        ("prepare", "(print,prepare %d#<tool> %d#<pocket>)"),
        ("change", "(print,change %d#<tool_in_spindle> %d#<selected_tool> %d#<current_pocket> %d#<selected_pocket>)"),
        ("settool", "(print,set %d#<tool> %d#<pocket>)"), ("setspeed", "(print,speed %d#<speed>)"),
        ("setfeed", "(print,feed %d#<feed>)"))}
    subs["subs/cycle.ngc"] = "o<cycle> sub\n(print,cycle %d#<motion_code> z %d#<z> r %d#<r> q %d#<q>)\nG91 G0 X1\nG90\no<cycle> endsub\n"
    return rs274(program + "\nM2\n", ini=ini, files=subs, tools=TOOLS)


r = run("G90 G17 G21\nT2\nM6\n(print,in spindle %d#5400)\nS500\nF200\nM61 Q3")
check(r.status == 0, r.err)
check(r.printed == ["prepare 2 4", "change -1 2 1 2", "in spindle 2", "speed 500", "feed 200", "set 3 9"], r.printed)
names = [c for c in r.calls if c[0] in ("SELECT_TOOL", "CHANGE_TOOL", "CHANGE_TOOL_NUMBER", "SET_SPINDLE_SPEED")]
check(names == [("SELECT_TOOL", [2]), ("CHANGE_TOOL", []), ("SET_SPINDLE_SPEED", [0, 500]),
                ("CHANGE_TOOL_NUMBER", [3])], names)
r = run("F100\nG84.2 X1 Z-2 R3 Q4\nX5\nX6 Z-8")
check(r.status == 0 and r.printed[1:] == ["cycle 842 z -2 r 3 q 4", "cycle -1 z -2 r 3 q 4", "cycle -1 z -8 r 3 q 4"],
      (r.printed, r.err))
for program, codes, want in (
        ("T77", {}, "T77: pocket not found"), ("T2", {"prepare": -1}, "T2: aborted (return code -1.0)"),
        ("T2", {"prepare": None}, "the T remap procedure prepare did not return a value"),
        ("T2\nM6", {"change": -2}, "M6 aborted (return code -2.0)"),
        ("T2\nG41.1 D1\nM6", {}, "Cannot change tools with cutter radius compensation on"),
        ("M61", {}, "M61 requires a Q parameter"), ("M61 Q-2", {}, "M61: Q value < 0"),
        ("M61 Q55", {}, "M61 failed: requested tool 55 not in table"),
        ("M61 Q3", {"settool": -1}, "M61 aborted (return code -1.0)"),
        ("S5", {"setspeed": -3}, "S: remap procedure returned -3.000000"),
        ("F1\nG84.2 X1 Z1 R-1 Q1", {}, "G84.2: R word must be > 0 if used (-1.0000)"),
        ("G84.2 X1 Z1 R1 Q1", {}, "G84.2: feed rate must be > 0"),
        ("F1\nG84.2 X1 Z1 R1 P-1", {}, "G84.2: P word must be >= 0 if used (-1.0000)"),
        ("F1\nG41.1 D1\nG84.2 X1 Z1 R1 Q1", {}, "G84.2: Cannot use canned cycles with cutter compensation on")):
    r = run(program, codes)
    check(r.status == 1 and want in r.err.split("\n"), f"{program}: {r.err}")
r = run("M61 Q2", ini=INI.replace("prolog=settool_prolog ngc=settool epilog=settool_epilog", "python=set_tool_number"))
check(r.status == 0 and ("CHANGE_TOOL_NUMBER", [2]) in r.calls, (r.out, r.err))
r = run("T2\nM6", ini=INI.replace("prolog=change_prolog ngc=change epilog=change_epilog", "python=ignore_m6"))
check(r.status == 0 and "CHANGE_TOOL" not in r.out, r.out + r.err)
done()
