# FP-073: the tool setter's macro of the sample machine, called in mm and in inches with offsets in force, gives the
# same length and leaves the units as they were. FP-077: the tool goes up, across, and down only in moves that a
# contact ends; one on the way stops it. FP-078: a setter that is not touched is told by the macro itself.
import os

from mill import *

on()
clearance = float(linuxcnc.ini(os.environ["INI_FILE_NAME"]).find("CHANGE_POSITION", "Z"))


def measure():
    """Runs T1 M6; what is wrong with the way it took."""
    wrong = set()
    c.mdi("T1 M6")
    last = poll().joint_position[:3]
    while True:
        sleep(0.002)
        poll()
        p = s.joint_position[:3]
        if max(abs(a - b) for a, b in zip(p[:2], last[:2])) > 1e-6 and p[2] < clearance - 0.05:
            wrong.add("across, below the clearance")
        if p[2] < last[2] - 0.02 and s.motion_type != MOTION_TYPE_PROBING:
            wrong.add("down without a probe")
        last = p
        if s.interp_state == INTERP_IDLE and s.queue == 0 and s.exec_state == EXEC_DONE:
            return sorted(wrong)


for units in ("G21", "G20"):
    for line in (units, "G10 L2 P1 X1 Y2 Z3", "G52 Z0.5", "G91", "F33", "G10 L1 P1 Z0"):
        mdi(line)
    wrong = measure()
    print(f"{units}: length {s.tool_table[1].zoffset:.3f}, G20 {200 in s.gcodes}, G91 {910 in s.gcodes}, "
          f"F{s.settings[1]:.0f}", wrong, messages())
mdi("G90 G52 Z0")
setp("plate.in0", -1000)
measure()
print("no contact:", messages())
setp("plate.in0", 0)
measure()
print("something in the way:", messages())
