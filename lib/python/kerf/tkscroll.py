# SPDX-License-Identifier: GPL-2.0-or-later
"""A frame that scrolls where it asks for more room than it gets, and is a usual frame where it does not.

    view = Scrolled(master)
    tk.Label(view.inner, text="...").pack()

A scroll bar is there only in a direction that needs one. The wheel scrolls over all that does not use it itself
(Shift: to the side); what gets the keyboard's focus comes into sight.
"""

import math
import tkinter as tk
import tkinter.font
from tkinter import ttk

LOOK_MS = 100           # Tk tells when what is inside changes, not always when that asks for another size
WHEEL_LINES = 3
WHEEL_MS = 1000         # so long a wheel that scrolls under a resting pointer goes on scrolling
WHEEL = ("<Button-4>", "<Button-5>", "<MouseWheel>", "<Shift-Button-4>", "<Shift-Button-5>", "<Shift-MouseWheel>")
SHIFT = 1


def turns(event):
    """+1 or -1 for a step of the wheel."""
    if event.num in (4, 5):
        return 1 if event.num == 4 else -1
    return 1 if event.delta > 0 else -1


def bars_for(need, room, thick):
    """Which bars (across, down) are needed, each of which takes room from the other direction."""
    across = down = False
    for _ in range(2):
        across = need[0] > room[0] - thick * down
        down = need[1] > room[1] - thick * across
    return across, down


class Scrolled(tk.Frame):
    def __init__(self, master, **options):
        super().__init__(master, class_="Scrolled", **options)
        self.port = tk.Frame(self, class_="ScrolledPort")
        self.inner = tk.Frame(self.port, class_="ScrolledPage")
        self.bars = tuple(ttk.Scrollbar(self, orient=orient, takefocus=0,
                                        command=lambda *words, n=n: self.scroll_bar(n, *words))
                          for n, orient in enumerate(("horizontal", "vertical")))
        self.most = math.inf, math.inf      # pixels that it asks for
        self.at, self.shown = [0, 0], None
        Scrolling.of(self).add(self)
        self.bind("<Configure>", lambda _: self.layout())
        self.bind("<Destroy>", self.gone)
        self.waiting, self.soon_waits = self.after_idle(self.look), True

    # -- sizes ----------------------------------------------------------------------------

    def limit(self, width, height):
        """It asks for no more than this."""
        self.most = max(width, 1), max(height, 1)
        self.layout()

    def thick(self):
        return self.bars[1].winfo_reqwidth()

    def need(self):
        """What is inside asks for."""
        return self.inner.winfo_reqwidth(), self.inner.winfo_reqheight()

    def asks(self):
        need, thick = self.need(), self.thick()
        across, down = bars_for(need, self.most, thick)
        return (int(min(need[0] + thick * down, self.most[0])), int(min(need[1] + thick * across, self.most[1])))

    def layout(self):
        """Everything has its place for the size that is wanted and the one that is there."""
        asks = self.asks()
        if asks != (int(str(self["width"])), int(str(self["height"]))):
            self.configure(width=asks[0], height=asks[1])
        have = (self.winfo_width(), self.winfo_height()) if self.winfo_width() > 1 else asks
        need, thick = self.need(), self.thick()
        bars = bars_for(need, have, thick)
        room = [max(have[0] - thick * bars[1], 1), max(have[1] - thick * bars[0], 1)]
        self.at = [max(0, min(at, n - r)) for at, n, r in zip(self.at, need, room)]
        shown = bars, room, need, list(self.at), thick
        if shown == self.shown:
            return
        self.shown = shown
        self.port.place(x=0, y=0, width=room[0], height=room[1])
        self.inner.place(x=-self.at[0], y=-self.at[1], width=max(need[0], room[0]), height=max(need[1], room[1]))
        for n, (bar, wanted) in enumerate(zip(self.bars, bars)):
            if not wanted:
                bar.place_forget()
                continue
            bar.set(self.at[n] / need[n], (self.at[n] + room[n]) / need[n])
            if n == 0:
                bar.place(x=0, y=room[1], width=room[0], height=thick)
            else:
                bar.place(x=room[0], y=0, width=thick, height=room[1])

    def look(self):
        self.soon_waits = False
        try:
            self.layout()
            self.after_cancel(self.waiting)
            self.waiting = self.after(LOOK_MS, self.look)
        except tk.TclError:
            if str(self) in Scrolling.of(self).views:       # else a signal ended the program meanwhile
                raise

    def soon(self):
        """Something inside has changed."""
        if not self.soon_waits:
            self.soon_waits = True
            self.after_cancel(self.waiting)
            self.waiting = self.after_idle(self.look)

    def gone(self, event):
        if event.widget is self:
            self.after_cancel(self.waiting)
            Scrolling.of(self).remove(self)

    # -- scrolling ------------------------------------------------------------------------

    def scrolls(self):
        """Which ways there is more than can be seen: across, down."""
        return self.shown[0] if self.shown else (False, False)

    def move(self, way, pixels):
        self.at[way] = int(pixels)
        self.layout()

    def lines(self, count):
        return count * tkinter.font.nametofont("TkDefaultFont", self).metrics("linespace")

    def scroll_bar(self, way, what, number, unit=""):
        """The protocol of scroll bars: moveto SHARE, scroll N units|pages."""
        room, need = self.shown[1][way], self.shown[2][way]
        if what == "moveto":
            self.move(way, float(number) * need)
        else:
            self.move(way, self.at[way] + int(float(number)) * (room * 0.9 if unit == "pages" else self.lines(1)))

    def see(self, path):
        """Brings a widget of `inner` into sight, its left upper corner at least. One that the pointer is on stays."""
        if str(self.tk.call("winfo", "containing", *self.winfo_pointerxy())) == path:
            return
        for way, (place, size) in enumerate((("rootx", "width"), ("rooty", "height"))):
            begin = int(self.tk.call("winfo", place, path)) - int(self.tk.call("winfo", place, self.inner))
            end = begin + int(self.tk.call("winfo", size, path))
            self.at[way] = min(max(self.at[way], end - self.shown[1][way]), begin)
        self.layout()


class Scrolling:
    """What all views of a program share: bindings, and whether the wheel scrolls just now."""

    def __init__(self, root):
        self.root, self.views, self.scrolled = root, {}, None
        root.bind_all("<FocusIn>", self.focus, "+")
        for event in ("<Configure>", "<Map>", "<Unmap>"):
            root.bind_all(event, self.changed, "+")
        for event in WHEEL:
            root.bind_all(event, self.wheel, "+")

    @staticmethod
    def of(widget):
        root = widget._root()
        if not hasattr(root, "kerf_scrolling"):
            root.kerf_scrolling = Scrolling(root)
        return root.kerf_scrolling

    def settle(self):
        """All views ask for what is in them now."""
        self.root.update_idletasks()
        for view in self.views.values():
            view.layout()
        self.root.update_idletasks()

    def add(self, view):
        self.views[str(view)] = view

    def remove(self, view):
        self.views.pop(str(view), None)

    def around(self, path):
        """The views around a widget, the nearest first."""
        while path := path.rpartition(".")[0]:
            if path in self.views:
                yield self.views[path]

    def changed(self, event):
        path = str(event.widget)
        for view in self.around(path):
            if path.startswith(f"{view.inner}."):
                view.soon()

    def focus(self, event):
        path = str(event.widget)
        for view in self.around(path):
            if any(view.scrolls()) and path.startswith(f"{view.inner}."):
                view.see(path)

    def uses_wheel(self, path):
        call = self.root.tk.call
        return any(str(call("bind", tag, event))
                   for tag in map(str, self.root.tk.splitlist(call("bindtags", path))) if tag != "all"
                   for event in ("<Button-4>", "<MouseWheel>"))

    def goes_on(self, event):
        """The wheel has just scrolled and the pointer has not moved: what came under it was not chosen."""
        return (self.scrolled is not None and self.scrolled[1:] == (event.x_root, event.y_root)
                and 0 <= event.time - self.scrolled[0] < WHEEL_MS)

    def wheel(self, event):
        path = str(event.widget)
        if self.uses_wheel(path) and not self.goes_on(event):
            return
        for view in self.around(path):
            across, down = view.scrolls()
            if across or down:
                way = 0 if across and (event.state & SHIFT or not down) else 1
                if (across, down)[way]:
                    view.move(way, view.at[way] - turns(event) * view.lines(WHEEL_LINES))
                    self.scrolled = event.time, event.x_root, event.y_root
                return


def wheel_scrolls(event):
    """Whether a step of the wheel over a widget that uses it belongs to the scrolling that it came into sight by."""
    scrolling = getattr(event.widget._root(), "kerf_scrolling", None)
    return scrolling is not None and scrolling.goes_on(event)
