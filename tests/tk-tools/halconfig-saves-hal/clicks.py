from types import SimpleNamespace

from kerf import tkstyle
from kerf.tktools import halconfig
import room
from tk_hand import Hand

root = tkstyle.open_display("halconfig", "Halconfig")
window = halconfig.Window(root)
hand = Hand(root)
files = ["", "nets.hal", "all.hal"]
window.ask_file = SimpleNamespace(asksaveasfilename=lambda **k: files.pop(0))
print(root.title(), [window.book.tab(i, "text").strip()
                     for i in window.book.tabs() if window.book.tab(i, "state") != "hidden"])
print({t: [(m.entrycget(i, "label"), m.entrycget(i, "state")) for i in range(m.index("end") + 1)]
       for t, m in window.menus.items()})
window.book.select(window.modify)
hand.cleared(window.command, "newsig fresh bit")
hand.key("Return")
print(window.status.cget("text"), window.tree.exists("sig+sig+fresh"))
window.menus["File"].invoke("Save HAL Net")
print("given up:", window.status.cget("text"))
window.exit()
hand.settle()
print([(t, str(b.cget("state"))) for t, b in window.answer_buttons.items()], room.troubles(root))
hand.click(window.answer_buttons["Cancel"])
print("there:", bool(root.winfo_exists()))
window.menus["File"].invoke("Save HAL Net")
print(window.status.cget("text"))
window.exit()
hand.settle()
hand.click(window.answer_buttons["Save All"])
print(files)
