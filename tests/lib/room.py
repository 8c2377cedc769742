# SPDX-License-Identifier: GPL-2.0-or-later
"""Whether a window has room for what it says, and can be read: for tests of everything that Tk draws.

    for line in room.troubles(root): print(line)        # every mapped window of this application
    language.catalogue = room.longer                    # before the window is made: each text 40 % longer

Each trouble is a line "path: what". Looked for:
  cut       a text has less room than its letters need, or a word of it is broken
  hidden    a widget or a text of a canvas lies outside of what holds it, and nothing scrolls there; or what scrolls
            has no room
  overlap   two widgets of one holder, or two texts of one canvas, lie over each other
  screen    a window or a menu is larger than the screen
  focus     a dialog's button does not show that the keyboard presses it
  contrast  letters and ground differ by less than 4.5 (WCAG 2.1), unless disabled
  small     with `touch`: something to press is lower than that many pixels
"""
import math
import re
import tkinter
from types import SimpleNamespace

PARKED = -40                # of a canvas: what lies above that is only measured there (BWidget)
SLACK = 1                   # pixels that nobody sees
CONTRAST, SEEN = 4.5, 3.0     # of letters, of lines
CLASSIC = ("Label", "Button", "Checkbutton", "Radiobutton", "Menubutton", "Message")
THEMED = ("TLabel", "TButton", "TCheckbutton", "TRadiobutton", "TMenubutton")
FIELDS = ("Entry", "Spinbox", "TEntry", "TSpinbox", "TCombobox")
PRESSED = ("Button", "Checkbutton", "Radiobutton", "TButton", "TCheckbutton", "TRadiobutton", "TMenubutton",
           "TCombobox", "TEntry", "Entry", "Scale", "TScale")
FEW_LINES = 6               # of a text that scrolls
LEAST_PORT = 48             # pixels of what scrolls as a whole
MORE = 0.4                  # of a text in a language with long words
NUMBER_DIGITS = 14          # what is shorter than this in an entry is a number or a name that must be seen whole


def longer_text(text):
    """The text with letters of the longer languages, MORE as long; formats, accelerators, keys in brackets stay."""
    def word(match):
        found = match.group()
        return (found if "%" in found or found.startswith("[") or not re.search("[A-Za-z]{2}", found)
                else found + ("\u00e4\u00eau\u00dfe\u00f1mo" * 9)[:math.ceil(MORE * len(found))])
    return re.sub(r"\[[^\]]*\]|\S+", word, text)


def longer():
    """A catalogue (kerf.language.catalogue) of a language whose every text is longer."""
    return SimpleNamespace(gettext=lambda text: text and longer_text(text))


def luminance(red, green, blue):
    """Of a colour, 0 to 1 each."""
    return sum(w * (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4)
               for w, c in ((0.2126, red), (0.7152, green), (0.0722, blue)))


class Look:
    """Walks the widgets of an application, those that Tcl made, too."""

    def __init__(self, root, touch=0, scrolled_x=True):
        self.root, self.tk, self.touch, self.found = root, root.tk, touch, []
        self.screen = root.winfo_screenwidth(), root.winfo_screenheight()

    # -- Tcl ------------------------------------------------------------------------------

    def call(self, *words):
        return self.tk.call(*words)

    def listed(self, value):
        """What Tcl gave, as a tuple: it may be a number or an object, too."""
        return self.tk.splitlist(str(value) if isinstance(value, (int, float)) else value)

    def number(self, path, *what):
        return ([int(float(str(self.call("winfo", w, path)))) for w in what] if len(what) > 1
                else int(float(str(self.call("winfo", what[0], path)))))

    def box(self, path):
        x, y, w, h = self.number(path, "rootx", "rooty", "width", "height")
        return x, y, x + w, y + h

    def option(self, path, name, default=""):
        try:
            return str(self.call(path, "cget", "-" + name)) if path else default
        except tkinter.TclError:
            return default

    def whole(self, path, name):
        try:
            return int(float(self.option(path, name, "0") or 0))
        except ValueError:
            return 0

    def style(self, path, kind, name, state=""):
        return " ".join(map(str, self.listed(self.call("ttk::style", "lookup", self.option(path, "style") or kind,
                                                       "-" + name, state))))

    def pixels(self, path, kind, name):
        """The first length of a themed widget's setting."""
        given = self.style(path, kind, name).split()
        return int(self.call("winfo", "pixels", path, given[0])) if given else 0

    def font(self, path, kind):
        return (self.option(path, "font") or (self.style(path, kind, "font") if kind.startswith("T") else "")
                or "TkDefaultFont")

    def measure(self, font, text):
        return int(self.call("font", "measure", font, text))

    def tell(self, path, what, *details):
        text = self.option(path, "text") or self.option(path, "label")
        self.found.append(f"{path}{f' {text!r}' if text else ''}: {what}: {' '.join(map(str, details))}")

    # -- the walk -------------------------------------------------------------------------

    def everything(self):
        self.root.update()
        self.root.update_idletasks()
        self.window(".")
        return self.found

    def window(self, path):
        if self.number(path, "ismapped"):
            x, y, width, height = self.number(path, "rootx", "rooty", "width", "height")
            if width > self.screen[0] or height > self.screen[1]:
                self.tell(path, "screen", f"{width}x{height} on {self.screen[0]}x{self.screen[1]}")
            elif x < 0 or y < 0 or x + width > self.screen[0] or y + height > self.screen[1]:
                self.tell(path, "screen", f"{width}x{height} at {x},{y} leaves {self.screen[0]}x{self.screen[1]}")
        self.inside(path, self.box(path), (False, False))

    def inside(self, path, visible, scrolls):
        """Children of a widget. visible: what can be seen of it. scrolls: whether more comes into sight that way."""
        laid = []
        for child in map(str, self.listed(self.call("winfo", "children", path))):
            kind = str(self.call("winfo", "class", child))
            if kind == "Menu":
                self.menu(child)
            elif str(self.call("winfo", "toplevel", child)) == child:
                self.window(child)
            elif not self.number(child, "ismapped"):
                if self.number(path, "viewable") and self.master(child) and kind not in ("Frame", "TFrame"):
                    self.tell(child, "hidden", "has no room at all")
            elif self.number(child, "viewable"):
                box = self.box(child)
                if kind not in ("Canvas", "Text") or str(self.call("winfo", "manager", child)) != "canvas":
                    laid.append((child, box))
                below = self.ways(child, kind)
                inner = tuple(f(a, b) for f, a, b in zip((max, max, min, min), visible, box))
                self.widget(child, kind, box, visible, scrolls)
                held = tuple(a or b for a, b in zip(scrolls, below))
                self.inside(child, inner, held)
        self.overlaps(path, laid)

    def ways(self, path, kind):
        """Which ways a widget scrolls."""
        if kind == "ScrolledPort":          # bars are beside it where they are needed (kerf.tkscroll)
            bars = {str(self.call(w, "cget", "-orient")) for w in map(str, self.listed(
                self.call("winfo", "children", path.rpartition(".")[0])))
                if str(self.call("winfo", "class", w)) == "TScrollbar" and self.number(w, "ismapped")}
            return "horizontal" in bars, "vertical" in bars
        if kind in ("Canvas", "Text", "Listbox", "Treeview"):
            return bool(self.option(path, "xscrollcommand")), bool(self.option(path, "yscrollcommand"))
        return False, False

    def overlaps(self, holder, laid):
        if str(self.call("winfo", "class", holder)) == "TPanedwindow":
            return
        laid = [(child, self.master(child), box) for child, box in laid]
        for n, (a, holds, p) in enumerate(laid):
            for b, other, q in laid[n + 1:]:
                width, height = min(p[2], q[2]) - max(p[0], q[0]), min(p[3], q[3]) - max(p[1], q[1])
                if width > SLACK and height > SLACK and holds and holds == other:
                    self.tell(b, "overlap", f"lies {width}x{height} over {a}")

    def master(self, path):
        """What lays a widget out, and in what; empty for one that floats on purpose."""
        manager = str(self.call("winfo", "manager", path))
        if manager in ("grid", "pack"):
            return manager + str(dict(zip(*[iter(map(str, self.listed(self.call(manager, "info", path))))] * 2))["-in"])
        return ""

    def widget(self, path, kind, box, visible, scrolls):
        width, height = box[2] - box[0], box[3] - box[1]
        out = [n for n, past in enumerate((box[0] < visible[0] - SLACK or box[2] > visible[2] + SLACK,
                                           box[1] < visible[1] - SLACK or box[3] > visible[3] + SLACK)) if past]
        leaf = kind in CLASSIC + THEMED + FIELDS + ("Scale", "TScale", "Listbox", "Canvas", "Treeview", "TNotebook",
                                                    "TProgressbar", "Text")
        if leaf and any(not scrolls[n] for n in out):
            self.tell(path, "hidden", f"{box} in {visible}")
        if kind in CLASSIC + THEMED:
            self.text(path, kind, width, height)
            if kind == "Button" and str(self.call("winfo", "class", self.call("winfo", "toplevel", path))) == "Dialog":
                self.focus(path)
        elif kind in FIELDS:
            self.field(path, kind, width, height)
        # the preview's picture
        elif kind == "Canvas" and str(self.call("winfo", "class", path.rpartition(".")[0] or ".")) != "Togl":
            self.canvas(path, width, height)
        elif kind == "Treeview":
            self.tree(path, width)
        elif kind == "TNotebook":
            self.tabs(path, width)
        elif kind == "Listbox" and not self.ways(path, kind)[0]:
            self.rows(path, width)
        elif kind == "Text":
            self.page(path, width, height)
        elif kind == "ScrolledPort":
            for size, way in zip((width, height), self.ways(path, kind)):
                if way and size < LEAST_PORT:
                    self.tell(path, "hidden", f"{size} pixels in sight of what scrolls")
        if (self.touch and kind in PRESSED and height < self.touch
                and self.option(path, "state", "normal") != "disabled"):
            self.tell(path, "small", f"{height} pixels")

    # -- kinds of widgets -----------------------------------------------------------------

    def text(self, path, kind, width, height):
        text = self.option(path, "text")
        picture = self.option(path, "image")
        if picture and self.option(path, "compound", "none") == "none":
            text = ""
        font, wrap = self.font(path, kind), self.whole(path, "wraplength")
        need = self.number(path, "reqwidth")
        if text and self.whole(path, "width") and not wrap:
            own = max(self.measure(font, line) for line in text.split("\n"))
            usual = abs(self.whole(path, "width")) * self.measure(font, "0") if self.whole(path, "width") > 0 else 0
            need = max(need - usual, 0) + own if usual else max(need, own)
        if text and kind != "Message" and need > width + SLACK:
            self.tell(path, "cut", f"needs {need} pixels, has {width}")
        if text and self.number(path, "reqheight") > height + SLACK:
            self.tell(path, "cut", f"needs {self.number(path, 'reqheight')} pixels of height, has {height}")
        if text and wrap:
            for word in text.split():
                if "/" not in word and self.measure(font, word) > wrap:
                    self.tell(path, "cut", f"{word!r} is broken at {wrap} pixels")
        if text:
            self.contrast(path, kind)

    def field(self, path, kind, width, height):
        font = self.font(path, "TkTextFont" if kind.startswith("T") else kind)
        values = ([str(v) for v in self.listed(self.call(path, "cget", "-values"))]
                  if kind in ("TCombobox", "TSpinbox") else [])
        text = str(self.call(path, "get"))
        state = self.option(path, "state", "normal")
        used = 4 + (self.pixels(path, kind, "arrowsize") + 2 * self.pixels(path, kind, "padding")
                    if kind.startswith("T") else 0)
        if state == "readonly" and kind == "TCombobox":
            texts = [v for v in values if len(v) < 40] + [text]
        else:
            texts = [text] if len(text) <= NUMBER_DIGITS or state == "readonly" else []
        for text in texts:
            if text and self.measure(font, text) + used > width + 3:
                self.tell(path, "cut", f"{text!r} needs {self.measure(font, text) + used} pixels, has {width}")
        if self.number(path, "reqheight") > height + SLACK:
            self.tell(path, "cut", f"needs {self.number(path, 'reqheight')} pixels of height, has {height}")
        _, top, _, high = map(int, map(str, self.listed(self.call(path, "bbox", 0))))
        if abs(2 * top + high - height) > 4:
            self.tell(path, "cut", f"letters from {top} to {top + high}, not in the middle of {height} pixels")
        self.contrast(path, kind)

    def canvas(self, path, width, height):
        across, down = self.ways(path, "Canvas")
        left, top = (float(str(self.call(path, f"canvas{axis}", 0))) for axis in "xy")
        texts = []
        for item in self.listed(self.call(path, "find", "all")):
            if (str(self.call(path, "type", item)) != "text"
                    or str(self.call(path, "itemcget", item, "-state")) == "hidden"):
                continue
            text, box = str(self.call(path, "itemcget", item, "-text")), self.listed(self.call(path, "bbox", item))
            if not text.strip() or not box or float(str(box[3])) < PARKED:
                continue
            x1, y1, x2, y2 = (float(str(v)) for v in box)
            x1, y1, x2, y2 = x1 + 1 - left, y1 + 1 - top, x2 - 1 - left, y2 - 1 - top
            if not across and (x1 < -SLACK or x2 > width + SLACK) or not down and (y1 < -SLACK or y2 > height + SLACK):
                self.tell(path, "hidden", f"{text!r} at {(x1, y1, x2, y2)} of {width}x{height}")
            for other, (p1, q1, p2, q2) in texts:
                if min(x2, p2) - max(x1, p1) > 2 and min(y2, q2) - max(y1, q1) > 4:
                    self.tell(path, "overlap", f"{text!r} over {other!r}")
            texts.append((text, (x1, y1, x2, y2)))

    def tree(self, path, width):
        font = self.style(path, "Treeview", "font") or "TkDefaultFont"
        columns = [str(c) for c in self.listed(self.call(path, "cget", "-displaycolumns"))]
        if columns == ["#all"]:
            columns = [str(c) for c in self.listed(self.call(path, "cget", "-columns"))]
        shown = [str(s) for s in self.listed(self.call(path, "cget", "-show"))]
        total = 0
        for column in (["#0"] if "tree" in shown else []) + columns:
            room = int(self.call(path, "column", column, "-width"))
            total += room
            heading = str(self.call(path, "heading", column, "-text"))
            if "headings" in shown and heading and self.measure("TkHeadingFont", heading) + 4 > room:
                self.tell(path, "cut", f"heading {heading!r} needs {self.measure('TkHeadingFont', heading) + 4} "
                                       f"pixels, has {room}")
            if column != "#0":
                longest = max((str(self.call(path, "set", item, column))
                               for item in self.listed(self.call(path, "children", ""))), key=len, default="")
                if 0 < len(longest) <= NUMBER_DIGITS and self.measure(font, longest) + 4 > room:
                    self.tell(path, "cut", f"{longest!r} in {heading!r} needs {self.measure(font, longest) + 4} "
                                           f"pixels, has {room}")
        if "tree" in shown and not self.ways(path, "Treeview")[0]:
            self.branches(path, "", font)
        if total > width + 2 and not self.ways(path, "Treeview")[0]:
            self.tell(path, "hidden", f"columns of {total} pixels in {width}")

    def branches(self, path, parent, font, depth=1):
        """The names of a tree's items in sight."""
        indent = self.pixels(path, "Treeview", "indent") or 20
        for item in self.listed(self.call(path, "children", parent)):
            box, text = self.listed(self.call(path, "bbox", item, "#0")), str(self.call(path, "item", item, "-text"))
            if box and len(text) <= NUMBER_DIGITS:
                room = min(int(str(box[2])), self.number(path, "width") - int(str(box[0]))) - depth * indent
                if self.measure(font, text) > room:
                    self.tell(path, "cut", f"{text!r} needs {self.measure(font, text)} pixels, has {room}")
            self.branches(path, item, font, depth + 1)

    def tabs(self, path, width):
        need = 0
        for tab in self.listed(self.call(path, "tabs")):
            pad = int(self.call("winfo", "pixels", path,
                                (self.style("", "TNotebook.Tab", "padding").split() or ["4"])[0]))
            need += self.measure(self.style("", "TNotebook.Tab", "font") or "TkDefaultFont",
                                 str(self.call(path, "tab", tab, "-text"))) + 2 * pad
        if need > width:
            self.tell(path, "cut", f"tabs need {need} pixels, have {width}")

    def rows(self, path, width):
        font = self.font(path, "Listbox")
        for text in map(str, self.listed(self.call(path, "get", 0, "end"))):
            if self.measure(font, text) > width:
                self.tell(path, "cut", f"row {text!r} needs {self.measure(font, text)} pixels, has {width}")
                break

    def page(self, path, width, height):
        across, down = self.ways(path, "Text")
        used = int(str(self.call(path, "count", "-update", "-ypixels", "1.0", "end")) or 0) if height > 1 else 0
        if not down and used > height + 2:
            self.tell(path, "cut", f"text of {used} pixels in {height}")
        line = int(self.call("font", "metrics", self.font(path, "Text"), "-linespace"))
        if (down and used > height and height < FEW_LINES * line
                and self.number(str(self.call("winfo", "toplevel", path)), "height") < self.screen[1] / 2):
            self.tell(path, "hidden", f"{height // line} lines in sight, and the screen has room for more")
        if not across and self.option(path, "wrap") == "none":
            seen = self.listed(self.call(path, "xview"))
            if float(str(seen[1])) - float(str(seen[0])) < 0.999:
                self.tell(path, "cut", "lines longer than the widget")

    def menu(self, path):
        if str(self.call("winfo", "class", path)) != "Menu" or self.option(path, "type") == "menubar":
            for child in map(str, self.listed(self.call("winfo", "children", path))):
                self.menu(child)
            return
        width, height = self.number(path, "reqwidth"), self.number(path, "reqheight")
        if height > self.screen[1] or width > self.screen[0]:
            self.tell(path, "screen", f"menu of {width}x{height} on {self.screen[0]}x{self.screen[1]}")
        for child in map(str, self.listed(self.call("winfo", "children", path))):
            self.menu(child)

    def focus(self, path):
        """A button that the keyboard may press shows when it would."""
        if self.option(path, "takefocus") != "0" and not (self.whole(path, "highlightthickness") and contrast(
                *(self.rgb(self.option(path, name)) for name in ("highlightcolor", "highlightbackground"))) >= SEEN):
            self.tell(path, "focus", "nobody sees whether the keyboard presses it")

    # -- colours --------------------------------------------------------------------------

    def rgb(self, colour):
        return tuple(int(str(v)) / 65535 for v in self.listed(self.call("winfo", "rgb", ".", colour)))

    def contrast(self, path, kind):
        if kind.startswith("T"):
            state = [str(s) for s in self.listed(self.call(path, "state"))]
            ground = "fieldbackground" if kind in FIELDS else "background"
            ink = self.option(path, "foreground") or self.style(path, kind, "foreground", state)
            back = self.option(path, "background") or self.style(path, kind, ground, state)
            off = "disabled" in state
        else:
            ink, off = self.option(path, "foreground"), self.option(path, "state", "normal") == "disabled"
            back = (self.option(path, "readonlybackground") if self.option(path, "state") == "readonly"
                    else self.option(path, "background"))
        if off or not ink or not back:
            return
        ratio = contrast(self.rgb(ink), self.rgb(back))
        if ratio < CONTRAST:
            self.tell(path, "contrast", f"{ink} on {back}: {ratio:.1f}")


def contrast(a, b):
    """Of two colours (red, green, blue from 0 to 1), 1 to 21."""
    a, b = sorted((luminance(*a), luminance(*b)))
    return (b + 0.05) / (a + 0.05)


def troubles(root, touch=0):
    return Look(root, touch).everything()
