# SPDX-License-Identifier: GPL-2.0-or-later
# FP-081, FP-083, FP-084, FP-085, FP-087, FP-089: parameters, status and motion say the same of tools.
from mill import *


def say(what):
    mdi(f"(debug,{what})")
    return [float(v) for v in messages()[-1].split()]


on()
print(mdi("G10 L1 P1 Z0"), mdi("T1 M6 G43"))
# FP-081: a tool of no length keeps G43, and no code changes by itself.
poll()
print("G43 with length 0", 430 in s.gcodes, s.tool_offset[2])
print(mdi("T2 M6"), 430 in poll().gcodes, s.tool_offset[2])
print(mdi("G43"), s.tool_offset[2] if poll() else 0)
# FP-083: G43 with the change, then a move of another axis: Z stays where it is.
mdi("G49 G0 Z80")
z = poll().position[2]
mdi("T3 M6 G43")
print("G43 with M6 moves nothing", poll().position[2] == z, "and a move in X", mdi("G0 X3"), poll().position[2] == z)
# FP-089: in the spindle, applied, selected, by parameter.
mdi("M61 Q2 G43 H4")
print("spindle tool, its length; applied length", say("#5400 #5403 #5083"), poll().tool_offset[2], s.tool_in_spindle)
print("G43.2 H1 adds", mdi("G10 L1 P1 Z1.5"), mdi("G43.2 H1"), say("#5083"), poll().tool_offset[2])
print("G43.2 with axis words alone", mdi("G43.2 X1 Z2"), messages(), say("#5081 #5083"), poll().tool_offset[:3])
print("G43.1", mdi("G43.1 Z7"), say("#5083"), poll().tool_offset[2], "G49", mdi("G49"), say("#5083"),
      poll().tool_offset[2])
mdi("T1")
print("selected and current", say("#<_selected_tool> #<_current_tool>"), poll().pocket_prepped)
mdi("M61 Q0")
print("none", say("#5400 #5403"), poll().tool_in_spindle)
# FP-085: the same contact measured under work offsets, rotation and units.
setp("motion.probe-input", 0)
machine = set()
for setting in ("G54 G21", "G55 G21", "G54 G20", "G59 G21"):
    mdi("G10 L2 P2 X5 Z-7 R30")
    mdi("G10 L2 P6 Z12.5 Y3")
    mdi("G21 G53 G0 Z60")
    mdi(setting)
    mode(MODE_MDI)
    c.mdi("G91 G38.2 Z-" + ("2 F10" if "G20" in setting else "50 F300"))
    until(lambda s: s.position[2] < 50, step=0.0005)
    setp("motion.probe-input", 1)
    result = c.wait_complete(30)
    setp("motion.probe-input", 0)
    mdi("G90")
    machine.add(round(poll().probed_position[2], 2))
    print(setting, result, messages(), "tripped", s.probe_tripped)
    unit = 25.4 if "G20" in setting else 1
    print(" work coordinate plus offset is the machine's",
          abs(say("#5063")[0] * unit + s.g5x_offset[2] - s.probed_position[2]) < 1e-3)
print("one machine coordinate", len(machine))
# Short feed moves are held back to be joined: what is held when M61 comes is made.
for mode in ("G61", "G64 P0.1"):
    mdi("G49 G21 G90 G53 G0 X0 Y0 Z0")
    run(f"G21 G90 {mode} F3000\nG53 G1 X5\nG53 G1 X10\nM61 Q4\nG91 G1 Y5\nM2\n")
    idle()
    print("before M61, after it", mode, xyz(3)[:2], messages())
