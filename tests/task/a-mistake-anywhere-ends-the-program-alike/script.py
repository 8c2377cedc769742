# SPDX-License-Identifier: GPL-2.0-or-later
# Wherever a mistake is found (reading a line, executing it, in a sub, a remap, a user's program, at a
# queue buster), the moves before it are done first. Then the program ends as by an abort: spindle and
# coolant off, operator told, line known; and the next program runs.
import re

import mill
from mill import *


def messages():
    return [re.sub(r"/\S*/", "", m) for m in mill.messages()]


START = "G21 G90 G54 G49 G80 G40\nM3 S500\nM8\nG0 X1\n"
SUB = "o<inner> sub\nG0 X2\n{}\nG0 X7\no<inner> endsub\n"
MISTAKES = {
    "reading": ("G0 X2\nG1 X[1/0\nG0 X7\n", 2),
    "executing": ("F100 G0 X2\nG2 X10 Y0 R1\nG0 X7\n", 2),
    "reading, after feeds": ("G1 F1000 X1.5\nG1 X2\nG999\nG0 X7\n", 2),
    "executing, after feeds": ("G1 F1000 X1.5\nG1 X2\nG2 X10 Y0 R1\nG0 X7\n", 2),
    "after many lines": ("".join(f"G0 X{n % 2}\n" for n in range(200)) + "G0 X2\nG1 X[1/0]\n", 2),
    "after a queue buster": ("G0 X2\nM66 P0 L0\nG1 X[1/0]\n", 2),
    "behind a dwell": ("G0 X2\nG4 P0.5\nG1 X[1/0]\n", 2),
    "in a sub": (SUB.format("G1 X[1/0]") + "o<inner> call\nG0 X8\n", 2),
    "in a sub's sub": (SUB.format("G2 X10 R1 F100").replace("inner", "deep")
                       + "o<inner> sub\no<deep> call\nG0 X6\no<inner> endsub\no<inner> call\n", 2),
    "in a loop": ("#1=0\no1 while [#1 LT 5]\n#1=[#1+1]\nG0 X#1\nG0 Y[1/[3-#1]]\no1 endwhile\n", 3),
    "no such sub": ("G0 X2\no<nowhere> call\nG0 X7\n", 2),
    "no such tool": ("G0 X2\nT99 M6\nG0 X7\n", 2),
    "no offset": ("G0 X2\nG43 H99\nG0 X7\n", 2),
    "in a remap": ("M400\nG0 X7\n", 2),
    "in a remap's Python": ("G0 X2\nM401\nG0 X7\n", 2),
    "missing word of a remap": ("G0 X2\nM402\nG0 X7\n", 2),
    "a remap's second call": ("M402 P2\nM402\nG0 X7\n", 2),
    "user's M code": ("G0 X2\nM120\nG0 X7\n", 2),
    "unknown M code": ("G0 X2\nM199\nG0 X7\n", 2),
    "cutter compensation": ("F1000\nG0 X0 Y0\nG41 D1\nG1 X1 Y-1\nG1 X2\nG1 Y-1.1\nG1 X1.9\nG40\n", None),
    "no end": ("G0 X2\n", 2),
    "beyond the limit": ("G0 X2\nG0 X5000\nG0 X7\n", None),  # motion refuses it, and stops
}


def off():
    poll()
    return not (s.spindle[0]["enabled"] or s.flood)


on()
mdi("T1 M6")
for name, (text, x) in MISTAKES.items():
    if poll().task_state != STATE_ON:
        on()
    mdi("G0 X0 Y0 Z0")
    messages()
    result = run(START + text + ("" if name == "no end" else "M2\n"))
    until(lambda s: s.interp_state == INTERP_IDLE and s.queue == 0, 200)
    sleep(0.6)
    told = messages()
    place = max(0, poll().error_line - START.count("\n"))
    print(f"{name}: {told} line {place} {'off' if off() else 'STILL ON'} idle {s.interp_state == INTERP_IDLE}"
          + ("" if x is None or abs(s.position[0] - x) < 1e-6 else f" X{s.position[0]:.3f} instead of {x}")
          + ("" if s.call_level == 0 else f" LEVEL {s.call_level}"))
    if name == "cutter compensation":  # stays on, as documented
        mdi("G40")
    if (s.task_state == STATE_ON
            and (run("G0 X3\nM2\n") != RCS_DONE or abs(poll().position[0] - 3) > 1e-6 or not off() or messages())):
        print("    the next program does not run", xyz())
# MDI: what was queued behind the mistake is dropped, and the move before it is stopped.
mdi("G0 X0")
messages()
for line in ("M3 S500", "M66 P0 L3 Q0.5", "G1 F1000 X2", "G1 X[1/0]", "G1 X5", "M8"):
    c.mdi(line)
c.wait_complete(10)
sleep(0.6)
print("MDI queue:", messages(), 0 < poll().position[0] < 2 and not s.current_vel, "off" if off() else "STILL ON",
      poll().queued_mdi_commands)
print("and on:", mdi("G0 X3"), xyz()[0], messages())
