# SPDX-License-Identifier: GPL-2.0-or-later
# LIB:hookup_moveoff.tcl and moveoff_gui at a machine: a paused program is moved off, moved back, and goes on by itself.
import os
import sys
import tkinter as tk
sys.path.insert(0, os.path.join(os.environ["EMC2_HOME"], "src/hal/user_comps"))
import hal
import moveoff_gui
from mill import *

on()
need(lambda s: hal.component_exists("halui") and hal.component_is_ready("halui"), "halui")
options = moveoff_gui.parse("-axes xz -inc 2.5 -autoresume -delay 0".split())
offsets = moveoff_gui.Offsets(options, moveoff_gui.joint_numbers(options.axes, moveoff_gui.kinematics()))
print("joints", offsets.joints)
root = tk.Tk()
window = moveoff_gui.Window(root, offsets, options)


def look(seconds=0.5):
    """The machine's time passes, the window follows."""
    sleep(seconds)
    window.look()
    root.update()


def motors():
    return [round(hal.get_p(f"joint.{j}.motor-pos-cmd") - hal.get_p(f"joint.{j}.pos-cmd"), 3) for j in range(3)], \
        [round(hal.get_p(f"mv.pos-plusoffset-{j}") - hal.get_p(f"joint.{j}.motor-pos-cmd"), 3) for j in range(3)]


program("G21 G90\nG0 X10 Y10 Z40\nG1 F600 X60\nM2\n")
c.auto(AUTO_RUN, 0)
need(lambda s: s.position[0] > 20, "half way")
window.enable.set(True)
window.switched()
print("not while it runs:", offsets.enabled(), window.root.state())
c.auto(AUTO_PAUSE)
need(lambda s: s.paused and s.current_vel == 0, "pause")
look()
print(window.root.state(), "|", window.status["text"])
window.enable.set(True)
window.switched()
for button in [b for b in window.controls if isinstance(b, tk.Button) and b["text"] == "+"]:
    button.invoke()
for _ in range(4):
    look()
print(window.status["text"], motors(), [window.values[a]["text"] for a in "xz"])
at = poll().position[0]
window.enable.set(False)
window.switched()
need(lambda s: not offsets.applied(), "back")
print("back", motors(), "program stands:", poll().position[0] == at and bool(s.paused))
look(0.1)
for _ in range(400):            # the pulse ends by the window's own clock
    root.update()
    sleep(0.01)
    if not poll().paused:
        break
need(lambda s: s.interp_state == INTERP_IDLE, "end of the program")
print("went on by itself to", round(poll().position[0], 3), messages())
window.close()
