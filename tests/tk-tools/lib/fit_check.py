# SPDX-License-Identifier: GPL-2.0-or-later
"""Looks at windows in one process: languages, sizes of letters, themes, large touch targets.

    fit_check.run(PROGRAMS, looks)      # name: function that makes the window on a root and returns it

A look is LANGUAGE:SCALE:THEME[:touch]; the language "long" has every text 40 % longer; scale "" is that of the screen.
ONLY=NAME[,NAME]: not all windows. PICTURES=FOLDER: pictures of them, too.
"""
import gettext
import os
import re
import tkinter.font
from pathlib import Path

import room
from kerf import language, tkstyle
from kerf.language import _
from kerf.tree import Tree

TOUCH_PX, TOUCH_SCREEN_PX = 30, 760         # a finger in a glove; on screens at least so high


def texts(widget):
    """Whatever the widgets, menus and pages below this one say."""
    for child in widget.winfo_children():
        kind = child.winfo_class()
        if kind == "Menu":
            yield from (child.entrycget(n, "label")
                        for n in range((child.index("end") or 0) + 1) if child.type(n) not in ("separator", "tearoff"))
        elif kind == "TNotebook":
            yield from (child.tab(page, "text") for page in child.tabs())
        elif kind == "Canvas":
            yield from (child.itemcget(item, "text") for item in child.find_all() if child.type(item) == "text")
        elif kind == "Toplevel":
            yield child.title()
        elif "text" in child.keys():
            yield str(child.cget("text"))
        yield from texts(child)


def untranslated(root):
    """Texts with words that did not pass through a catalogue, as a set."""
    found = {" ".join(re.sub("\u00ab.*\u00bb", "", text, flags=re.S).split()) for text in [root.title(), *texts(root)]}
    return {text for text in found if re.search("[a-zA-Z]{2}", text)}


def pages(root, window):
    """Shows one page of a window after another."""
    for page in window.book.tabs() if hasattr(window, "book") else [None]:
        if page:
            window.book.select(page)
        root.update()
        root.update()
        yield


def each(programs, look):
    """Every window once, under this name."""
    for name, make in programs.items():
        if name in os.environ.get("ONLY", name).split(","):
            root = tkstyle.open_display(name, "Test")
            root.report_callback_exception = lambda *what: print("TRACEBACK", what)
            look(name, root, make(root))
            root.update()
            for later in root.tk.splitlist(root.tk.call("after", "info")):
                root.tk.call("after", "cancel", later)
            root.destroy()


def show_untranslated(programs):
    """Prints the texts that come from no catalogue. The catalogue is replaced before the windows are imported:
    mark_translated()."""
    def look(name, root, window):
        for page in pages(root, window):
            pass
        print(f"{name}:", "; ".join(sorted(untranslated(root))))
    each(programs, look)


def picture(root, name):
    from PIL import ImageGrab
    root.lift()
    root.update()
    ImageGrab.grab(xdisplay=os.environ["DISPLAY"]).save(Path(os.environ["PICTURES"]) / f"{name}.png")


def colours(root, style):
    """Pairs of the theme that are too alike to be read."""
    for back, inks in (("face", ("ink", "bad", "good", "faint")),
                       ("field", ("ink", "pin", "signal", "param", "chart", "bad", "good", "faint"))):
        for ink in inks:
            ratio = room.contrast(*([c / 65535 for c in root.winfo_rgb(style.colours[name])] for name in (ink, back)))
            if ratio < (3 if ink == "chart" else room.CONTRAST):
                print(f"{ink} on {back}: contrast {ratio:.1f}")


def run(programs, looks):
    """Prints what has no room or cannot be read in each look, and how large letters are."""
    for words in looks:
        tongue, scale, theme, *touch = words.split(":")
        os.environ.update(KERF_SCALE=scale, KERF_THEME=theme, KERF_TOUCH="1" if touch else "0")
        catalogue = (room.longer() if tongue == "long"
                     else gettext.translation("linuxcnc", Tree.find().locale, [tongue], fallback=True))
        language.catalogue = lambda found=catalogue: found
        told = set()

        def look(name, root, window):
            roomy = TOUCH_PX if touch and root.winfo_screenheight() >= TOUCH_SCREEN_PX * float(scale or 1) else 0
            for n, page in enumerate(pages(root, window)):
                told.update(f"{name}{line}" for line in room.troubles(root, roomy))
                if "PICTURES" in os.environ:
                    picture(root, f"{words.replace(':', '-')}-{name}-{n}")
        each(programs, look)
        root = tkstyle.open_display("letters", "Test")
        style = tkstyle.apply(root)
        print(words, _("Cancel"), "letters", -tkinter.font.nametofont("TkDefaultFont", root).cget("size"))
        colours(root, style)
        root.update()
        root.destroy()
        for line in sorted(told):
            print("   ", line)
