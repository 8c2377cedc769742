# SPDX-License-Identifier: GPL-2.0-or-later
# FP-112: a sub called by MDI goes on with motion after a probe.
# FP-113: what stands before a failing tool change's return is done before the sub ends.
# FP-115: a remapped M6 called twice from a sub changes twice, from MDI and in auto.
# FP-116: a program stopped at any point leaves nothing behind for the next one.
# FP-117: messages come at their place in motion; (LOG,) and (PRINT,) are the read-ahead forms.
from pathlib import Path

from mill import *

Path("twice.ngc").write_text("""o<twice> sub
T1 M6
G90 G1 X1 F3000
T2 M6
G1 X2
o<twice> endsub
""")
Path("probing.ngc").write_text("""o<probing> sub
G91 G38.3 Z-1 F600
G1 X1 F3000
G1 Y1
G90
o<probing> endsub
""")
on()
for how in ("mdi", "auto"):
    mdi("M61 Q0 G49 G90")
    mdi("G0 X0 Y0 Z0 M65 P0")
    messages()
    if how == "mdi":
        result = mdi("o<twice> call")
    else:
        result = run("o<twice> call\nM2\n")
    idle()
    print(how, "twice:", result, "tool", s.tool_in_spindle, "x", xyz()[0], messages())
    mdi("G49 G90 G0 X0 Y0 Z0")
    result = mdi("o<probing> call") if how == "mdi" else run("o<probing> call\nM2\n")
    idle()
    print(how, "probing:", result, xyz())
    mdi("G49 G90 G0 X0 Y0 Z-1")
    messages()
    result = mdi("T3 M6") if how == "mdi" else run("T3 M6\nM2\n")
    idle()
    print(how, "failed:", result, "tool", s.tool_in_spindle, "z", xyz()[2], "output", s.dout[0], messages())

# A program that is stopped somewhere and another that is opened.
big = "G21 G90 F6000\n" + "".join(f"N{n} G1 X{n % 40 / 10:.3f} Y{n % 70 / 10:.3f} (line {n})\n"
                                  for n in range(1, 30000)) + "M2\n"
for wait in (0.05, 0.3, 0.77):
    program(big, "big.ngc")
    c.auto(AUTO_RUN, 0)
    need(lambda s: s.motion_line > 3, "start of the big program")
    sleep(wait)
    c.abort()
    idle()
    print("small after", wait, run("G90 G0 X1\nX2\nM2\n", name="small.ngc"), xyz()[0], messages())

# Where messages come.
program("G90 G1 F600 X0 Y0\n(msg,first)\nG1 X5\n(msg,second)\nG1 X10\nM2\n")
mode(MODE_AUTO)
c.auto(AUTO_RUN, 0)
found = []
need(lambda s: any([found.append((m, round(s.position[0]))) for m in messages()]) or len(found) > 0, "first message")
need(lambda s: any([found.append((m, round(s.position[0]))) for m in messages()]) or len(found) > 1, "second message")
idle()
print(found)
