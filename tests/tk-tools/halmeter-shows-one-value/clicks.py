import subprocess

from kerf import tkstyle
from kerf.tktools.halmeter import Window, parse
from tk_hand import Hand

root = tkstyle.open_display("halmeter", "Halmeter")
window = Window(root, *parse(["-g", "20", "30"]))
hand = Hand(root)
print(root.title(), [window.value.cget("text"), window.label.cget("text")], root.winfo_rootx(), root.winfo_rooty(),
      root.winfo_width() == window.style.px(270))
chooser = window.chooser
print(chooser.window.title(), [chooser.book.tab(i, "text") for i in range(3)])
pins = chooser.lists["pin"]
hand.click(pins, x=20, y=8)
print(window.label.cget("text"), window.value.cget("text"))
chooser.book.select(1)
root.update()
for row in range(6):
    signals = chooser.lists["sig"]
    x, y, width, height = signals.bbox(row)
    hand.click(signals, x=x + 5, y=y + height // 2)
    print(window.label.cget("text"), repr(window.value.cget("text")))
print("wide enough:", window.value.winfo_reqwidth() <= root.winfo_width())
window.probe("sig", "z-pipe")
window.show()
print("a port without a buffer, silently:", window.value.cget("text").strip())
window.probe("sig", "x-s32")
for words in (["delsig", "x-s32"], ["newsig", "x-s32", "bit"]):
    subprocess.run(["halcmd", *words], check=True)
    for _ in range(10):
        window.show()
    print(words[0], window.value.cget("text"))
hand.click(chooser.find)
hand.type("u64")
print(chooser.lists["sig"].get(0, "end"))
hand.key("Escape")
print("closed:", not chooser.window.winfo_exists())
hand.click(window.buttons["Select"])
print("again:", bool(window.chooser.window.winfo_exists()), window.chooser.book.index("current"))
hand.click(window.buttons["Exit"])
root = tkstyle.open_display("halmeter", "Halmeter")
window = Window(root, *parse(["-s", "signal", "x-float", "-g", "5", "6", "150"]))
root.update()
print(root.title(), window.value.cget("text"), root.winfo_width(), root.winfo_height() <= window.style.px(24),
      window.label.winfo_ismapped())
window.exit()
