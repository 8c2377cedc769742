import os
from pathlib import Path

import hal
from kerf import tkstyle
from kerf.tktools.calibration import Calibration
from kerf.tktools.emccalib import Window
from tk_hand import Hand

root = tkstyle.open_display("emccalib", "Emccalib")
window = Window(root, Calibration("machine.ini"))
hand = Hand(root)
tabs = {tab.section: tab for tab in window.tabs}
print(root.title())
for tab in window.tabs:
    print(tab.section, [(v.name, label.cget("text"), e.get())
                        for v, label, e in zip(tab.values, tab.labels, tab.entries)])


def said():
    return window.status.cget("text")


def states(tab):
    return {name: str(b.cget("state")) for name, b in tab.buttons.items()}


def columns(tab):
    return [(label.cget("text"), e.get()) for label, e in zip(tab.labels, tab.entries)]


zero, one, spindle = tabs["JOINT_0"], tabs["JOINT_1"], tabs["SPINDLE_0"]
print(states(zero))
hand.cleared(zero.entries[0], "12.5")
hand.cleared(zero.entries[1], "1e-7")
hand.click(zero.buttons["Test"])
print("at work:", hal.get_p("pid.0.Pgain"), hal.get_p("pid.0.deadband"), columns(zero), states(zero),
      str(zero.entries[0].cget("state")))
hand.click(zero.buttons["Cancel"])
print("taken back:", hal.get_p("pid.0.Pgain"), hal.get_p("pid.0.deadband"), columns(zero), states(zero)["Test"])
hand.click(zero.buttons["Test"])
hand.click(zero.buttons["OK"])
print("kept:", hal.get_p("pid.0.Pgain"), columns(zero), states(zero)["Test"], "|", said())
window.book.select(one.page)
root.update()
hand.cleared(one.entries[0], "3x")
hand.click(one.buttons["Test"])
print(said(), hal.get_p("pid.1.Pgain"), one.state)
hand.cleared(one.entries[0], "3")
hand.cleared(one.entries[1], "0.5")
hand.key("Return")
print("both pins of one name:", hal.get_p("pid.1.Pgain"), hal.get_p("pid.1.FF1"), one.state)
hand.click(one.buttons["OK"])
hal.set_p("pid.1.Igain", 0.75)
hand.click(one.buttons["Refresh"])
print("another hand's value:", columns(one))
window.book.select(spindle.page)
root.update()
hand.cleared(spindle.entries[0], "2")
hand.click(spindle.buttons["Test"])
print(said())
os.chmod("machine.ini", 0o444)
if os.geteuid():
    with hand.answers("ok"):
        hand.click(window.save_button)
else:
    print("box: machine.ini is not writable: chmod u+w, or copy the configuration to your own folder [ok]")
os.chmod("machine.ini", 0o644)
with hand.answers("cancel"):
    hand.click(window.quit_button)
hal.set_p("pid.1.Igain", float("inf"))
with hand.answers("ok"):
    hand.click(window.save_button)
hal.set_p("pid.1.Igain", 0.75)
hand.click(window.save_button)
print(said())
hand.click(window.save_button)
print(said())
Path("machine.ini.expanded").write_text(Path("machine.ini").read_text())
window.model.ini = Path("machine.ini.expanded")
with hand.answers("ok"):
    hand.click(window.save_button)
os.remove("machine.ini.expanded")
window.model.ini = Path("machine.ini")
hand.click(window.quit_button)
try:
    root.winfo_exists()
    print("still there")
except Exception:
    print("gone")
