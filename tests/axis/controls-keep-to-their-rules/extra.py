#!/usr/bin/python3
# A machine with an extra joint, other kinematics: its button while it is homed, the readout, the offsets.
import sys

import linuxcnc
import operator_lib as lib

JOINTS = ".pane.top.tabs.fmanual.joints.joint"


def buttons(op):
    op.wait(0.1)
    return [n for n in range(5) if op.enabled(f"{JOINTS}{n}")]


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    app = op.app
    op.power_on()
    print("joints shown:", app.joints_shown, "off limits when nothing is homed:",
          [n for n in range(5) if n not in buttons(op)], "offsets shown at the start:",
          bool(app.vars.show_offsets.get()))
    app.command.home(4)
    op.until(lambda: op.stat.joint[4]["homed"], "the extra joint is homed")
    print("extra joint homed, may be chosen:", buttons(op))
    op.key("F2")
    app.command.unhome(4)
    op.until(lambda: not op.stat.joint[4]["homed"], "unhomed")
    op.power_on()
    print("unhomed:", buttons(op))
    op.home()
    app.command.teleop_enable(1)
    op.until(lambda: not app.joints_shown, "letters")
    print([line for line in app.preview.readout_lines if "E" in line])
    op.key("F5")
    print("MDI page by F5: mode", op.stat.task_mode == linuxcnc.MODE_MANUAL and "stays manual", end=" ")
    op.type("G0 X1")
    op.idle()
    print("first line: MDI", op.stat.task_mode == linuxcnc.MODE_MDI, end=" ")
    op.key("F3")
    print("manual page: manual", op.stat.task_mode == linuxcnc.MODE_MANUAL, "axes under control",
          op.stat.motion_mode == linuxcnc.TRAJ_MODE_TELEOP)


lib.run(script)
