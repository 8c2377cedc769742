# SPDX-License-Identifier: GPL-2.0-or-later
# The names in Tk's own file dialogs, in the light and the dark theme: black and white differ.
import os
import tkinter
from tkinter import filedialog

from kerf import tkstyle


def canvases(root, path):
    if root.tk.call("winfo", "class", path) == "Canvas":
        yield path
    for child in root.tk.splitlist(root.tk.call("winfo", "children", path)):
        yield from canvases(root, child)


def look(root, path, seen):
    """What the list of names shows, then the dialog is closed."""
    root.update()
    for canvas in canvases(root, path):
        for item in root.tk.splitlist(root.tk.call(canvas, "find", "all")):
            if root.tk.call(canvas, "type", item) == "text":
                colours = root.tk.call(canvas, "itemcget", item, "-fill"), root.tk.call(canvas, "cget", "-background")
                letters, ground = (sum(root.winfo_rgb(str(c))) / 3 / 65535 for c in colours)
                seen.append((str(root.tk.call(canvas, "itemcget", item, "-text")), abs(letters - ground) > 0.5))
    root.tk.call("set", "::tk::Priv(selectFilePath)", "")      # as Cancel does


os.makedirs("folder/inner", exist_ok=True)
open("folder/part.ngc", "w").close()
for theme in ("light", "dark"):
    os.environ["KERF_THEME"] = theme
    for name, path, ask in (("file", ".__tk_filedialog", filedialog.askopenfilename),
                            ("folder", ".__tk_choosedir", filedialog.askdirectory)):
        root, seen = tkinter.Tk(), []
        tkstyle.apply(root)
        root.after(300, lambda: look(root, path, seen))
        ask(initialdir="folder")
        print(theme, name, *sorted(seen))
        root.destroy()
