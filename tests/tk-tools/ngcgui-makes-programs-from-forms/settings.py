# What the INI file gives to the window.
import os
from pathlib import Path

from kerf.tktools import ngcgui


def look(page):
    root, buttons = page.parent.winfo_toplevel(), page.buttons
    page.rows[1][2].set("2")
    page.create()
    page.finalize()
    print(page.form.path, page.program.postamble, page.font, page.program.features, page.form.picture, page.image)
    root.destroy()


class Watched(ngcgui.Page):
    def __init__(self, parent, *rest):
        super().__init__(parent, *rest)
        parent.after(1, look, self)


ngcgui.Page = Watched
print("status", ngcgui.main(["-i", "shape.ini"]))
print([word.replace(os.environ["HOME"], "~")
       for word in Path("gcmc.words").read_text().split() if "include" in word or "define" in word])
print(Path("auto.ngc").read_text().split()[:1], Path("auto.ngc").read_text().split()[-2:])
