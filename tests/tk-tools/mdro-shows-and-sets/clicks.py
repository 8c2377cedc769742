import linuxcnc
from kerf import tkstyle
from kerf.tktools import mdro
from tk_hand import Hand

pins = {f"index-enable.{i}": False for i in range(3)}
place = [1.0, 2.5, 0.0]
root = tkstyle.open_display("mdro", "Mdro")
readout = mdro.Readout(list("XYZ"), place.__getitem__, "inch")
window = mdro.Window(root, readout, pins, 20)
hand = Hand(root)


def shown():
    window.show()
    return [v.cget("text") for v in window.values]


print(root.title(), shown(), [n for n in window.radios])
hand.click(window.buttons[0]["0"])
hand.click(window.buttons[1]["1/2"])
print(shown())
place[0] += 0.25
hand.click(window.radios["mm"], x=8)
print(shown())
hand.click(window.entries[2])
hand.type("12.7")
hand.key("Return")
print(shown(), repr(window.entries[2].get()))
hand.click(window.entries[0])
for key in ("-", "1", "2", "4", "⌫", ".", "5", "Enter"):
    hand.click(window.keys[key])
print(shown())
hand.type("1x")
hand.key("Return")
print("wrong:", window.entries[0].get(), shown()[0])
hand.click(window.keys["C"])
hand.click(window.radios["inch"], x=8)
hand.click(window.radios["CS2"], x=8)
print("another system:", shown())
hand.click(window.radios["MCS"], x=8)
print("machine:", shown(), str(window.entries[0].cget("state")), readout.enter(0, 5.0))
hand.click(window.buttons[0]["0"])
print(shown())
hand.click(window.buttons[1]["I"])
print("index:", pins["index-enable.1"], str(window.buttons[1]["I"].cget("state")))
pins["index-enable.1"] = False
window.show()
print(str(window.buttons[1]["I"].cget("state")))
window.close()
o = mdro.options(["-p", "30", "-m", "-l", "other.var", "XYZA"])
print(o.point_size, o.mm, o.load_cs, o.axes)
mdro.take_ini(o, linuxcnc.ini("mdro.ini"))
print(o.point_size, o.mm, o.load_cs, o.axes)
readout = mdro.Readout(list("XZ"), [0.0, 0.0].__getitem__, "mm")
readout.load("cs.var")
print(readout.names(), [readout.text(i) for i in (0, 1)])
readout.system = 2
print([readout.text(i) for i in (0, 1)])
