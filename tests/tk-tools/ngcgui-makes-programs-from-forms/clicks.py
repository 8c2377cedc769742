import os
from pathlib import Path

from kerf import tkstyle
from kerf.tktools import ngcfiles, ngcgui
import room
from tk_hand import Hand

root = tkstyle.open_display("ngcgui", "Ngcgui")
style = tkstyle.apply(root)
o = ngcgui.options(["-S", "subs/pocket.ngc", "-p", ":G21", "--noauto"])
page = ngcgui.Page(root, style, o, coordinate=lambda letter: {"x": 3.5}.get(letter))
page.frame.pack(fill="both", expand=True)
page.bind_keys(root.bind_all)
tkstyle.centre(root, style.px(720), style.px(560))
hand = Hand(root)
bad = style.colours["bad"]


def said():
    return page.status.cget("text")


print(said(), [(e.get(), e.cget("foreground") == bad) for _, e, _ in page.rows], room.troubles(root))
print("picture:", page.image and (page.image.width(), page.image.height()), bool(page.picture.winfo_ismapped()))
hand.click(page.buttons["Create Feature"])
print(said(), str(page.buttons["MakeFile"].cget("state")))
hand.click(page.rows[2][1])
hand.type("500")
hand.key("Return")
hand.type("2")
hand.click(page.rows[0][1])
hand.type("d")
print("twice x:", page.rows[0][2].get())
hand.type("x")
print("x:", page.rows[0][2].get())
hand.key("ctrl+f")
print(said(), page.buttons["Create Feature"].cget("text"))
hand.key("ctrl+r")
print("kept:", page.values())
page.retain.set(False)
hand.key("ctrl+r")
print("read again:", page.values())
hand.key("ctrl+c")
print("cleared:", page.values())
page.read("subs/text.ngc")
print(said(), page.form.name)
with hand.answers("cancel"):
    hand.click(page.buttons["Exit"])
hand.click(page.buttons["MakeFile"])
copies = [folder / "auto.ngc" for folder in ngcfiles.backup_folders()]
print(said(), any(f.exists() and f.read_text() == Path("auto.ngc").read_text() for f in copies))
hand.key("ctrl+a")
print(page.buttons["MakeFile"].cget("text"), os.path.exists("auto.ngc.new"))
hand.click(page.buttons["Exit"])
