# SPDX-License-Identifier: GPL-2.0-or-later
# FP-183, FP-185: coordinates are set in the system in force; the form names it and shows the old values.
import tkinter as tk
from pathlib import Path

import linuxcnc
from kerf import tkstyle
from kerf.tktools import tklinuxcnc
from kerf.tktools.machine import Machine, increment_mm
from mill import *

root = tkstyle.open_display("tklinuxcnc", "TkLinuxcnc")
root.report_callback_exception = lambda *what: print("TRACEBACK", what)
m = Machine("mill.ini")
w = tklinuxcnc.Window(root, m)
tklinuxcnc.source_user_file(root, m)
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


def key(name, state=0):
    root.event_generate(f"<KeyPress-{name}>", state=state)
    root.update()
    root.event_generate(f"<KeyRelease-{name}>", state=state)
    for _ in range(3):
        root.update()
        root.after(25)
    root.update()
    wait()


def let_go(name):
    """Longer than a key that repeats is up."""
    root.event_generate(f"<KeyRelease-{name}>")
    done = []
    root.after(80, lambda: done.append(1))
    while not done:
        root.update()
        sleep(0.001)


def state():
    return [w.state_buttons[n].cget("text") for n in w.state_buttons]


def dro():
    w.show()
    return [float(v.cget("text")) for v in w.values]


def messages():
    return [text for text, _ in w.popups.shown]


wait()
print(root.title(), root.tk.call(".mine", "cget", "-text"))
print({title: [menu.entrycget(i, "label") for i in range(menu.index("end") + 1) if menu.type(i) != "separator"]
       for title, menu in w.menus.items()})
print("position:", w.font.actual("family"), w.font.cget("size"), w.font.cget("slant"),
      str(w.values[0].cget("font")) == w.font.name)
w.help()
top = next(t for t in root.winfo_children() if isinstance(t, tk.Toplevel))
print("help:", next(t for t in top.winfo_children() if isinstance(t, tk.Text)).get("1.0", "end").strip())
top.destroy()
button = next(iter(w.state_buttons.values()))
button.event_generate("<Enter>")
print("balloon:", w.tip.winfo_children()[0].cget("text"), end=" | ")
button.event_generate("<Leave>")
print(w.tip, end=" | ")
w.balloons.set(False)
button.event_generate("<Enter>")
print("off:", w.tip)
print(state())
key("F1")
key("F2")
print(state())
for i in range(3):
    key(str(i))
    key("Home")
    until(lambda s, i=i: s.homed[i], 60)
    wait(0.3)
print("homed:", all(poll().homed[:3]), dro())
print("== jogging")
key("x")
root.event_generate("<KeyPress-Right>")
wait(0.5)
moving = poll().actual_position[0]
for _ in range(5):              # the key repeats
    root.event_generate("<KeyRelease-Right>")
    root.event_generate("<KeyPress-Right>")
    wait(0.05)
print("repeating keys do not stop it:", poll().actual_position[0] > moving, w.jog.key)
let_go("Right")
print("let go:", w.jog.running)
wait(1.0)
rest = poll().actual_position[0]
wait(0.5)
print("at rest:", poll().actual_position[0] == rest, rest > 1)
root.event_generate("<KeyPress-Up>")
wait(0.2)
root.event_generate("<FocusOut>")
wait(1.0)
rest = poll().actual_position[1]
wait(0.5)
print("focus lost:", w.jog.running, poll().actual_position[1] == rest)
root.event_generate("<KeyRelease-Up>")
key("c")
print(w.incremental.get())
before = poll().actual_position[0]
key("Left")
wait(2.0)
print("by an increment:", round(poll().actual_position[0] - before, 4))
key("i")
before = poll().actual_position[2]
key("y")
key("minus")
wait(3.0)
print(w.incremental.get(), w.selected.get(), round(poll().actual_position[1] - rest, 4))
print([increment_mm(t) for t in ("1mm", ".1in", "1/8 in", "5")])
print("== MDI")
key("F5")
print(state()[-1], root.focus_get() is w.mdi)
w.mdi.insert(0, "G10 L20 P0 X5")
w.mdi.event_generate("<Return>")
wait(0.5)
print("X is", dro()[0])
w.mdi.delete(0, "end")
w.mdi.insert(0, "G0 X1 Y2 M3 S100")
w.mdi.event_generate("<Return>")
wait(6.0)
print(dro()[:2], state()[2], "| typing does nothing else:", w.mdi.get())
w.mdi.focus_force()
w.mdi.event_generate("<F3>")        # from the entry: the next keys jog
wait()
print("keys go to the entry:", root.focus_get() is w.mdi)
for widget, event in ((w.increments, "<<ComboboxSelected>>"), (w.text, "<ButtonPress-1>")):
    widget.focus_force()
    widget.event_generate(event)
    root.update()
    before = poll().actual_position[2]
    w.incremental.set("1mm")
    (root.focus_get() or root).event_generate("<KeyPress-Prior>")
    wait(1.0)
    print("jogs after a click there:", round(poll().actual_position[2] - before, 3))
w.relative.set(0)
machine = dro()[0]
w.relative.set(1)
w.units.set("inches")
print("other coordinates:", round(machine - poll().actual_position[0], 4), dro()[1], w.info.cget("text").split()[:2])
w.units.set("auto")
key("F9")
wait(0.5)
print(state()[2])
key("F7")
wait(0.3)
print(state()[1])
print("== program")
Path("part.ngc").write_text("G21 G90 G0 X0 Y0\nG1 X20 F600\nG4 P1\nG1 Y10\nM2\n")
w.open_file("part.ngc")
wait(0.2)
print(state()[-1], w.program_label.cget("text").split("/")[-1], "|", w.text.get("2.0", "2.end"))
key("r")
wait(0.6)
print("running line:", bool(w.text.tag_ranges("running")), w.program_label.cget("text").split(": ")[-1])
key("5")
print("feed override", round(poll().feedrate, 2), round(w.feed.get()))
key("p")
wait(1.0)
print(w.program_label.cget("text").split(": ")[-1])
key("x")
print("no mode change while it runs:", m.mode(linuxcnc.MODE_MANUAL), poll().task_mode == linuxcnc.MODE_AUTO)
key("s")
until(lambda s: s.interp_state == linuxcnc.INTERP_IDLE and s.inpos, 60)
wait(0.3)
print("end:", dro()[:2])
key("r")
wait(0.5)
key("Escape")
wait(0.5)
print("aborted:", poll().interp_state == linuxcnc.INTERP_IDLE, round(poll().current_vel, 3))
print("== windows")
w.popups.set_coordinates()
top, entries, accept = w.popups.last_form
print(top.title(), [e.split()[:2] for e in entries])
next(iter(entries.values())).insert(0, "7")
accept()
wait(0.5)
print("set:", dro()[0], state()[-1])
m.mode(linuxcnc.MODE_MDI)
c.mdi("G55")
c.wait_complete()
wait(0.2)
w.popups.set_coordinates()
top, entries, accept = w.popups.last_form
print(top.title())
list(entries.values())[1].insert(0, "-3")
accept()
wait(0.5)
print("set:", dro()[1], [round(v, 3) for v in poll().g5x_offset[:2]], round(poll().g92_offset[1], 3))
w.mdi.delete(0, "end")
w.mdi.insert(0, "G1 X99999 F100")
w.send_mdi()
wait(0.5)
print(messages())
w.exit()
c.state(linuxcnc.STATE_ESTOP)
