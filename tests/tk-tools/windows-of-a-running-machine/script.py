# SPDX-License-Identifier: GPL-2.0-or-later
import io
import os
import subprocess

import hal
import linuxcnc
from kerf import tkstyle
from kerf.tktools import debuglevel, hal_manualtoolchange, linuxcnctop, ngcgui, teach_in, tooledit
from kerf.tktools.tooltable import Table
from mill import *
from tk_hand import Hand

on()

print("== linuxcnctop")
root = tkstyle.open_display("linuxcnctop", "Linuxcnctop")
top = linuxcnctop.Window(root, linuxcnc.stat())
hand = Hand(root)


def line(name):
    return next(l for l in top.text.get("1.0", "end").split("\n") if l.startswith(name + "\t")).split("\t")


def red():
    return [top.text.get(a, b) for a, b in zip(*[iter(str(i) for i in top.text.tag_ranges("changed"))] * 2)]


print(root.title(), line("task_state"), line("file"), line("task_mode"))
for _ in range(25):
    top.update()
print("red:", red())
mdi("G0 X5")
top.stat.poll()
top.update()
print("red after a move:", "mdi" in red(), line("position")[1])
for _ in range(20):
    top.update()
print("red 2 s later:", red())
hand.click(top.button)
print("copied:", "task_state\ton" in root.clipboard_get(), len(root.clipboard_get().splitlines()) == len(top.values))
top.close()

print("== ngcgui")
mdi("G10 L2 P1 X1 Y0 R90")
mdi("G53 G0 X5 Y2")
print("in a turned system:", *(round(ngcgui.machine_position()(letter), 3) for letter in "xy"),
      ngcgui.machine_position()("a"))
mdi("G10 L2 P1 X0 Y0 R0")
mdi("G0 Y0")

print("== debuglevel")
c.debug(0x100000)
c.wait_complete()
root = tkstyle.open_display("debuglevel", "Debuglevel")
window = debuglevel.Window(root, linuxcnc.stat(), linuxcnc.command())
hand = Hand(root)
print([b.cget("text") for _, _, b in window.boxes], window.label.cget("text"))
hand.click(window.boxes[6][2], x=12)
hand.click(window.boxes[4][2], x=12)
print(window.label.cget("text"), hex(poll().debug))
hand.click(window.boxes[6][2], x=12)
print(hex(poll().debug))
window.close()

print("== teach-in")
out = io.StringIO()
root = tkstyle.open_display("teach-in", "Teachin")
window = teach_in.Window(root, linuxcnc.stat(), out)
hand = Hand(root)
mdi("M7")
hand.click(window.button)
mdi("G0 Y2")
hand.click(window.radios["Joint"], x=10)
hand.click(window.button)
print(out.getvalue(), window.label.cget("text"))
root.destroy()

print("== tool table of the running machine")
table = Table("mill.tbl")
root = tkstyle.open_display("tooledit", "Tooledit")
window = tooledit.Window(root, table, ["Z", "D"], "rc")
window.root.after_cancel(window.timer)
hand = Hand(root)
button = window.buttons["ReLoadTable"]
print("offered:", bool(button.winfo_manager()), button.cget("state"))
hand.cleared(window.sheet.entry(0, "D"), "7.25")
hand.click(button)
until(lambda s: any(t.diameter == 7.25 for t in s.tool_table))
tool = int(table.rows[0].get("T"))
print(window.status.cget("text"), [t.diameter for t in poll().tool_table if t.id == tool])
c.state(STATE_OFF)
need(lambda s: s.task_state != STATE_ON, "off")
window.look()
print("machine off:", button.cget("state"))
with hand.answers("ok"):
    window.quit()
print(window.table.modified)
other = tooledit.Controller("other.tbl")
print("another table:", other.look())

print("== tool change")
root = tkstyle.open_display("hal_manualtoolchange", "AxisToolChanger")
pins = {"number": tool, "change": True, "change_button": False, "changed": False}
window = hal_manualtoolchange.Window(root, hal_manualtoolchange.Exchange(pins))
os.environ["INI_FILE_NAME"] = "mill.ini"
window.tick()
hand = Hand(root)
print(root.title(), root.winfo_class(), "|", window.dialog.title(), "|", window.text.cget("text"))
for _ in range(110):
    window.tick()
print("hidden:", root.state(), "asked once:", bool(window.dialog), pins["changed"])
pins["change"] = False
window.tick()
print("taken back:", window.dialog, pins["changed"])
for number in (0, 77):
    pins.update(number=number, change=True)
    window.tick()
    root.update()
    print("|", window.text.cget("text"))
    hand.click(window.button)
    print("confirmed:", window.dialog, pins["changed"])
    pins["change"] = False
    window.tick()
    print(pins["changed"])
root.destroy()
print("the program:")
c.state(STATE_ON)
need(lambda s: s.task_state == STATE_ON, "on")


def windows(name):
    done = subprocess.run(["xdotool", "search", "--onlyvisible", "--name", name], stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, text=True)
    return done.stdout.split()


c.mode(MODE_MDI)
c.wait_complete()
c.mdi(f"T{tool} M6")
print("asks:", clock.wait_until(lambda: windows("Tool change"), 20.0, 0.1), "waits:", poll().tool_in_spindle != tool)
subprocess.run(["xdotool", "mousemove", "--window", windows("Tool change")[0], "20", "20"], check=True)
sleep(0.5)
subprocess.run(["xdotool", "key", "Return"], check=True)
print("changed:", until(lambda s: s.tool_in_spindle == tool, 20.0, 0.1), windows("Tool change"))
c.mdi("T0 M6")
print("asks for none:", clock.wait_until(lambda: windows("Tool change"), 20.0, 0.1), "tool", poll().tool_in_spindle)
c.abort()
print("closed by an abort:", clock.wait_until(lambda: not windows("Tool change"), 20.0, 0.1), "tool",
      poll().tool_in_spindle, hal.get_p("hal_manualtoolchange.changed"), messages())
