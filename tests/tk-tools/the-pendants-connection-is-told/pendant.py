from kerf import tkstyle
from kerf.tktools.monitor_xhc_hb04 import CONNECTED, REQUIRED, Monitor, Window
from tk_hand import Hand

for required in (False, True):
    for sequence in ((True, True, False, False, True), (False, True)):
        pins = {REQUIRED: required}
        monitor = Monitor(pins.get)
        told = []
        for connected in sequence:
            pins[CONNECTED] = connected
            told.append(monitor.step() if not monitor.ended else "(ended)")
        print(required, sequence, told)
pins = {REQUIRED: False, CONNECTED: True}
root = tkstyle.open_display("monitor", "Monitor")
window = Window(root, Monitor(pins.get))
hand = Hand(root)
window.tick()
print("hidden:", root.state())
pins[CONNECTED] = False
window.tick()
hand.settle()
print("shown:", root.state(), window.label.cget("text"))
hand.click(window.button)
print("after OK:", root.state())
del pins[CONNECTED]
print("component gone, go on:", window.tick())
root.destroy()
