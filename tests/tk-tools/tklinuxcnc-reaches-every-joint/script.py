# SPDX-License-Identifier: GPL-2.0-or-later
import tkinter as tk

import linuxcnc
from kerf import tkstyle
from kerf.tktools import tklinuxcnc
from kerf.tktools.machine import Machine
from mill import *

root = tkstyle.open_display("tklinuxcnc", "TkLinuxcnc")
root.report_callback_exception = lambda *what: print("TRACEBACK", what)
m = Machine("gantry.ini")
w = tklinuxcnc.Window(root, m)
root.after_cancel(w.timer)
root.update()
root.focus_force()


def wait(seconds=0.1):
    """The machine's time passes, the screen follows."""
    end = clock.now() + seconds
    while clock.now() < end:
        m.stat.poll()
        w.show()
        w.m_errors()
        root.update()
        sleep(0.02)


def key(name, widget=root, held=0.0):
    widget.event_generate(f"<KeyPress-{name}>")
    root.update()
    wait(held)
    widget.event_generate(f"<KeyRelease-{name}>")
    for _ in range(3):
        root.update()
        root.after(25)
    root.update()
    wait()


def rows():
    return [label.cget("text") for label in w.names if label.winfo_manager()]


def moved(action):
    """Joints that an action moves."""
    before = poll().joint_actual_position[:4]
    action()
    wait(0.5)
    return [j for j, (a, b) in enumerate(zip(before, poll().joint_actual_position)) if abs(a - b) > 0.01]


wait()
key("F1")
key("F2")
print("before homing:", rows())
print("Page Up moves", moved(lambda: key("Prior", held=0.2)), "selected", w.selected.get())
for name in "xz":
    key(name)
    print(f"{name} selects", w.selected.get(), end="; ")
print("= moves", moved(lambda: key("equal", held=0.2)))
for number in (3, 0, 1, 2):
    key(str(number))
    key("Home")
    print("Home of", number, "homes it:", until(lambda s: s.homed[number], 60),
          [j for j in range(4) if poll().homed[j]])
wait()
need(lambda s: s.motion_mode == linuxcnc.TRAJ_MODE_TELEOP, "world mode")
print("after it:", rows())
print("y and = move", moved(lambda: (key("y"), key("equal", held=0.2))))
key("dollar")
print("joints chosen:", rows(), "3 and = move", moved(lambda: (key("3"), key("equal", held=0.2))))
mode(linuxcnc.MODE_MDI)         # leaves motion in coordinated mode
mode(linuxcnc.MODE_MANUAL)
wait()
print("after MDI:", rows(), "1 and = move", moved(lambda: (key("1"), key("equal", held=0.2))))
key("dollar")
print("world:", rows(), "y and = move", moved(lambda: (key("y"), key("equal", held=0.2))))
key("y")
key("Home")
wait()
print("Home of Y:", rows(), [j for j in range(4) if poll().homed[j]])
need(lambda s: all(s.homed[:4]), "homing of joint 1", 60)
wait()
print("then:", rows(), [text for text, _ in w.popups.shown])

mdi("G10 L1 P1 Z30 R3")
mdi("G10 L1 P2 Z40 R4 X1")
mdi("G20")
m.mode(linuxcnc.MODE_AUTO)
w.popups.tool_offset()
top, entries, accept = w.popups.last_form


def form(number):
    tool, length, diameter = entries.values()
    tool.delete(0, "end")
    tool.insert(0, number)
    root.update()
    return length, diameter


print("inches:", *(float(e.get()) for e in form("1")), "of another tool:", *(float(e.get()) for e in form("2")),
      "of none:", [e.get() for e in form("77")])
length, diameter = form("2")
length.delete(0, "end")
length.insert(0, "2")
accept()
wait(0.5)
tool = poll().toolinfo(2)
print("mm in the table:", *(round(tool[n], 3) for n in ("zoffset", "diameter", "xoffset")), "mode kept:",
      poll().task_mode == linuxcnc.MODE_AUTO)
mode(linuxcnc.MODE_MANUAL)

w.popups.set_coordinates()
top, entries, accept = w.popups.last_form
top.update()
first = next(iter(entries.values()))
first.focus_force()
key("F1", first)
print("F1 in a form:", poll().task_state == linuxcnc.STATE_ESTOP)
w.exit()
