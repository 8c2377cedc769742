#!/usr/bin/python3
"""Everything on the screen has room and can be read: themes, sizes, touch, every page, menu and dialog
(tests/lib/room.py).

LOOKS: LANGUAGE:SCALE:THEME[:touch] words, the language is that of the process. TONGUE=long: every text 40 % longer.
PICTURES=FOLDER: pictures, too.
"""
import os
import sys

import room
from kerf import language

if os.environ.get("TONGUE") == "long":
    language.catalogue = room.longer
import operator_lib as lib
from axis import dialogs
from axis.touchoff import Checker

TOUCH_PX, TOUCH_SCREEN_PX = 30, 700
ASK = dialogs.ask


class Looker:
    def __init__(self, op):
        self.op, self.app, self.told = op, op.app, set()

    def look(self, name, touch=0):
        for _ in range(3):
            self.op.root.update()
        for line in room.troubles(self.op.root, touch):
            if line not in self.told:
                self.told.add(line)
                print("   ", name, line)
        if "PICTURES" in os.environ:
            from PIL import ImageGrab
            ImageGrab.grab(xdisplay=os.environ["DISPLAY"]).save(f"{os.environ['PICTURES']}/{name}.png")

    def dialog(self, name, show, *path):
        """Opens a dialog, looks at it and closes it."""
        def seen():
            self.look(name)
            for window in self.op.root.tk.splitlist(self.op.root.tk.call("winfo", "children", ".")):
                if str(self.op.root.tk.call("winfo", "class", window)) == "Dialog":
                    modal.answer(None)
        modal = None
        wait = dialogs.Modal.wait

        def waited(dialog, focus=None):
            nonlocal modal
            modal = dialog
            self.op.root.after(1, seen)
            return wait(dialog, focus)
        dialogs.Modal.wait = waited
        try:
            show()
        finally:
            dialogs.Modal.wait = wait


DIALOGS = {
    "close": lambda op: op.app.confirm_close(),
    "touch-off": lambda op: op.root.tk.call("touch_off_system"),
    "mistyped": lambda op: dialogs.Touchoff(op.root, op.app.translate("Touch Off (system)"), "X", "1 [", "mm",
                                            Checker(op.app.settings, "none.var"), "P0", None, op.app.translate).wait(),
    "grid": lambda op: op.app.custom_grid(),
    "properties": lambda op: op.root.tk.call("gcode_properties"),
    "rehome": lambda op: op.root.tk.call("home_all_joints"),
    "limits": lambda op: dialogs.ask(op.root, op.app.translate("Program exceeds machine limits"),
                                     "\n".join(LIMITS), "warning", 1,
                                     *map(op.app.translate, ("Re-Check", "Run Anyway", "Cancel")), escape=2),
    "restore": lambda op: dialogs.ask(op.root, op.app.translate("Run from line %d") % 80,
                                      op.app.translate("Before the program goes on at line %d, this is done:") % 80,
                                      "warning", 2, *map(op.app.translate,
                                                         ("Restore and run", "Run without", "Cancel")),
                                                         extra="G0 X1\n" * 40, escape=2),
    "read-only": lambda op: dialogs.ask(op.root, op.app.translate("File not Writable:") + "part.ngc",
                                        op.app.translate("The file cannot be changed: open it to read, or "
                                                         "save a copy first?"),
                                        "warning", 0, *map(op.app.translate, ("Edit-readonly", "Save", "Cancel"))),
}
LIMITS = [f"Program exceeds machine maximum on axis {c}" for c in "XYZABCUVW"] * 3


def same_letters(tcl, menu):
    """Entries of a menu, and of those below it, that are chosen by the same underlined letter."""
    last, found = str(tcl.call(menu, "index", "end")), {}
    for n in range(int(last) + 1 if last not in ("none", "") else 0):
        if str(tcl.call(menu, "type", n)) in ("separator", "tearoff"):
            continue
        text, at = str(tcl.call(menu, "entrycget", n, "-label")), int(str(tcl.call(menu, "entrycget", n, "-underline")))
        if at >= 0:
            found.setdefault(text[at:at + 1].lower(), []).append(text)
    for child in map(str, tcl.splitlist(tcl.call("winfo", "children", menu))):
        yield from same_letters(tcl, child)
    yield from (f"{menu}: {letter}: {texts}" for letter, texts in found.items() if len(texts) > 1)


def many_messages(op, looker, name, touch):
    """More than there is room for, one without an end: the newest is seen, the tool bar and the readout are, and all
    can be closed."""
    shown, root = op.app.notifications, op.root
    for n in range(50):
        shown.add("error", f"{n}: " + op.app.translate("Program exceeds machine maximum on axis %s") % "X"
                  * (1 + 10 * (n % 3)) + " " + "x" * 40)
    shown.add("info", "a line without an end " * 200)
    looker.look(name + "-many-messages", touch)
    frame = shown.frame
    if (frame.winfo_rooty() < root.winfo_rooty() + root.winfo_height() * 0.4
            or frame.winfo_width() > root.winfo_width() * 0.45):
        print("   ", name, "messages over the readout:", frame.winfo_geometry(), root.winfo_geometry())
    if not shown.shown[-1][1].winfo_viewable():
        print("   ", name, "the newest message is not in sight")
    closed = 0
    while shown.shown:
        seen = [box for _kind, box in shown.shown if box.winfo_ismapped()]
        seen[-1].cross.invoke()
        root.update()
        closed += 1
    if closed != 11 or frame.winfo_ismapped():
        print("   ", name, "closed one by one:", closed)


def script(op):
    sys.stdout = open("transcript", "w", buffering=1)
    dialogs.ask = ASK
    app, looker = op.app, Looker(op)
    print("screen:", op.root.winfo_screenheight(), "title of the left tab:",
          op.root.tk.call(".pane.top.tabs", "itemcget", "manual", "-text"))
    op.power_on()
    op.home()
    for line in same_letters(op.root.tk, ".menu"):
        print("    ", line)
    for words in os.environ["LOOKS"].split():
        _, scale, theme, *touch = words.split(":")
        app.set_dark(theme == "dark")
        app.set_touch(bool(touch))
        app.set_scale(float(scale or 0))
        name = words.replace(":", "-")
        roomy = touch and op.root.winfo_screenheight() >= TOUCH_SCREEN_PX * app.style.scale
        for tab in ("mdi", "manual"):
            app.raise_tab(tab)
            op.wait(0.1)
            looker.look(f"{name}-{tab}", TOUCH_PX if roomy else 0)
        for dialog, show in DIALOGS.items():
            looker.dialog(f"{name}-{dialog}", lambda: show(op))
        for window in (".about", ".keys"):
            op.root.tk.call("::axis::show_window", window)
            looker.look(name + window.replace(".", "-"))
            op.root.tk.call("wm", "withdraw", window)
        for kind in ("error", "info"):
            app.notifications.add(kind,
                                  app.translate("Before the program goes on at line %d, this is done:") % 17
                                  + " /home/somebody/linuxcnc/nc_files/a-part-with-a-long-name.ngc")
        looker.look(name + "-messages")
        many_messages(op, looker, name, TOUCH_PX if roomy else 0)
        print(words, "letters", app.letters_px(), "icon", app.icons.get("run").width(), "background",
              app.widgets.homebutton.cget("background") == app.colours["face"])


lib.run(script)
