# SPDX-License-Identifier: GPL-2.0-or-later
"""Windows with room for all that they say, in every language and at every size of letters.

    Fit(root, style, restyle)      # what tkstyle.apply() does

A window that appears and asks for more than it has gets it. Where the screen has no more, what scrolls gives way;
then letters (and at last what is large for touch) become smaller, down to those of a usual screen. What may scroll as a
whole (tkscroll) does so where that is not enough.
"""

import re
import tkinter as tk
import tkinter.font

from .tkscroll import Scrolled, Scrolling

FRAME_PX = 40           # of the screen's height, for the desktop's title and bar; a menu of the window is above that
STEPS = 12              # at most, for one window
LEAST_STEP, MOST_STEP = 0.75, 0.97

FIELDS = ("TEntry", "TCombobox", "TSpinbox")
SCROLLED, FEW_LINES = ("Text", "Listbox", "Treeview", "Canvas"), 4

# Lengths in pixels that widgets were given, by class. Themes and named fonts follow by themselves.
LENGTHS = {"Canvas": ("width", "height"), "Label": ("wraplength", "padx", "pady"), "TLabel": ("wraplength", "padding"),
           "TFrame": ("padding",), "TLabelframe": ("padding",), "TScale": ("length",),
           "Scale": ("length", "width", "sliderlength"),
           **dict.fromkeys(("Button", "Menubutton", "Checkbutton", "Radiobutton"), ("padx", "pady"))}
GAPS = ("padx", "pady", "ipadx", "ipady")


def place_of(window):
    """Its left upper corner on the screen, with frame and menu."""
    told = re.search(r"[+](-?\d+)[+](-?\d+)$", window.wm_geometry())
    return tuple(map(int, told.groups())) if told else (window.winfo_x(), window.winfo_y())


def menu_height(window):
    """Pixels of its menu bar as its letters are now."""
    call = window.tk.call
    menus = [child for child in window.tk.splitlist(call("winfo", "children", window))
             if str(call("winfo", "class", child)) == "Menu"]
    return max((int(call("winfo", "reqheight", menu))
                for menu in menus if str(call(menu, "cget", "-type")) == "menubar"), default=0)


def room_of(window):
    """Pixels that a window may have: width, height."""
    return (window.winfo_screenwidth(),
            window.winfo_screenheight()
            - max(FRAME_PX, window.winfo_rooty() - place_of(window)[1], menu_height(window)))


def asked(window):
    """What a window asks for now."""
    Scrolling.of(window).settle()
    return window.winfo_reqwidth(), window.winfo_reqheight()


def share_of(window, size=None):
    """How much of the size that it asks for a window can get, in its worse direction; 1 or more: all."""
    return min(most / wanted for most, wanted in zip(room_of(window), size or asked(window)))


def step_for(share):
    """The next factor for letters that are too large by that much."""
    return max(LEAST_STEP, min(MOST_STEP, share))


def scale_option(widget, option, factor, get, put):
    """A length, or several of them, in pixels."""
    lengths = [round(float(str(widget.winfo_pixels(str(part)))) * factor)
               for part in widget.tk.splitlist(str_or_tuple(get(option)))]
    if any(lengths):
        put(**{option: lengths if len(lengths) > 1 else lengths[0]})


def str_or_tuple(value):
    return value if isinstance(value, tuple) else str(value or "0")


def give_way(widget):
    """What scrolls asks for no more than a few lines, below this widget."""
    for child in widget.winfo_children():
        kind = child.winfo_class()
        if kind in SCROLLED and str(child.cget("yscrollcommand")):
            lines = child.winfo_pixels(f"{FEW_LINES * 4}m") if kind == "Canvas" else FEW_LINES
            if int(child.winfo_pixels(str(child.cget("height")))) > lines:
                child.configure(height=int(lines))
        give_way(child)


def views(widget):
    """What may scroll as a whole, below this widget."""
    for child in widget.winfo_children():
        if isinstance(child, Scrolled):
            yield child
        else:
            yield from views(child)


def give_room(view, asked, room, least=(1, 1)):
    """A view asks for what is left where all asks for asked() and has room; not for less than `least`, if it needs
    that."""
    most = room
    for _ in range(3):          # a bar takes room, for which the other one may be needed
        view.limit(*most)
        over = [a - r for a, r in zip(asked(), room)]
        if max(over) <= 0:
            return
        most = [max(a - o, n) if o > 0 else m for a, o, m, n in zip(view.asks(), over, most, least)]
    view.limit(*most)


def enlarge(window, wanted):
    """At least this size, as far as the screen has it, and on the screen."""
    most, now = room_of(window), (window.winfo_width(), window.winfo_height())
    size = tuple(min(max(n, w), m) for n, w, m in zip(now, wanted, most))
    at = place_of(window)
    place = tuple(max(0, min(p, m - s)) for p, m, s in zip(at, most, size))
    if (size, place) != (now, at):
        window.minsize(*(min(least, s) for least, s in zip(window.minsize(), size)))
        window.geometry("{}x{}+{}+{}".format(*size, *place))


def onto_screen(window):
    """Into the screen, as large as it asks for."""
    if window.winfo_exists():
        enlarge(window, asked(window))


def fields_anew(widget):
    """What is typed in keeps its letters in the middle: ttk has them where they were before the theme changed."""
    for child in widget.winfo_children():
        if child.winfo_class() in FIELDS:
            child.configure(font=str(child.cget("font")))
        fields_anew(child)


class Fit:
    """restyle() sets fonts and themes by the style, whose scale and touch it changes; pads(style): padY of what is
    pressed and not themed, by class."""

    def __init__(self, root, style, restyle, pads):
        self.root, self.style, self.restyle, self.pads = root, style, restyle, pads
        self.pending = set()
        root.bind_all("<Map>", self._appears, "+")
        root.bind_all("<Configure>", self._changes, "+")

    def _appears(self, event):
        window = event.widget
        if isinstance(window, tk.Wm) and window not in self.pending and not window.wm_overrideredirect():
            self.pending.add(window)
            window.after_idle(self._look, window)

    def _changes(self, event):
        """Something came into a window that makes it larger than the screen."""
        if (isinstance(event.widget, tk.Wm)
                and any(size > most for size, most in zip((event.width, event.height), room_of(event.widget)))):
            self._appears(event)

    def _look(self, window):
        self.pending.discard(window)
        if window.winfo_exists():
            self.fit(window)

    def fit(self, window):
        wanted = asked(window)
        if share_of(window) < 1:
            window.before_giving_way = wanted           # for tkstyle.centre(), should it come later
            give_way(window)
            enlarge(window, wanted)
        if share_of(window) * self.style.scale < 1:         # smaller letters are not enough
            self.scroll(window)
        for _ in range(STEPS):
            share = share_of(window)
            if share >= 1 or not self.shrink(share):
                break
            fields_anew(self.root)
        self.scroll(window)
        enlarge(window, asked(window))

    def scroll(self, window):
        """Panels that the window has no room for."""
        for view in views(window):
            if share_of(window) < 1:
                give_room(view, lambda: asked(window), room_of(window))

    def shrink(self, share):
        """Letters and gaps by about this share; False when they are as small as they may be."""
        style = self.style
        if style.scale > 1:
            before, style.scale = style.scale, max(1.0, style.scale * step_for(share))
            self._lengths(self.root, style.scale / before)
            self._fonts(style.scale / before)
        elif style.touch > 0:
            before, style.touch = self.pads(style), style.touch - 0.25
            self._pads(self.root, before, self.pads(style))
        else:
            return False
        self.restyle()
        return True

    def _pads(self, widget, before, now):
        """Of what has them from the style, below this widget."""
        for child in widget.winfo_children():
            kind = child.winfo_class()
            # rounded when the letters became smaller
            if kind in before and abs(child.winfo_pixels(str(child.cget("pady"))) - before[kind]) <= 1:
                child.configure(pady=now[kind])
            self._pads(child, before, now)

    def _fonts(self, factor):
        """Those that the program made."""
        for name in tkinter.font.names(self.root):
            if not name.startswith("Tk"):
                font = tkinter.font.nametofont(name, self.root)
                font.configure(size=round(font.cget("size") * factor))

    def _lengths(self, widget, factor):
        """Those that widgets below this one were given."""
        for child in widget.winfo_children():
            kind = child.winfo_class()
            for option in LENGTHS.get(kind, ()):
                scale_option(child, option, factor, child.cget, child.configure)
            if child.winfo_manager() in ("grid", "pack"):
                info, change = ((child.grid_info, child.grid_configure) if child.winfo_manager() == "grid"
                                else (child.pack_info, child.pack_configure))
                for option in GAPS:
                    scale_option(child, option, factor, info().get, change)
            if kind == "Treeview":
                for column in ("#0", *child.cget("columns")):
                    child.column(column, width=round(child.column(column, "width") * factor),
                                 minwidth=round(child.column(column, "minwidth") * factor))
            for column in range(child.grid_size()[0]):
                least = child.columnconfigure(column)["minsize"]
                if least:
                    child.columnconfigure(column, minsize=round(least * factor))
            self._lengths(child, factor)
