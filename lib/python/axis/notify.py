# SPDX-License-Identifier: GPL-2.0-or-later
"""Messages to the operator: a stack in the lower right corner of the window, the newest at its end.

It never grows over the tool bar or the readout: what has no room is counted above it, and comes when others are closed.
"""

import tkinter as tk

from kerf.language import _

from . import dialogs

MOST = 11                # the next one removes the oldest
WRAP_PX = 300
WIDEST, HIGHEST = 0.35, 0.5         # of the window
MANY = 3                 # from so many on all can be closed at once
MARGIN_X, MARGIN_Y, GAP = 16, 36, 2
COLOURS = {"error": ("#7a1f1f", "#ffffff", "✖"), "info": ("#1f4a7a", "#ffffff", "ℹ")}
GROUND, CUT = "#3a3d41", "…"


class Message(tk.Frame):
    """One of them. text: all of it, however much is seen."""

    def __init__(self, stack, kind, text):
        back, fore, sign = COLOURS[kind]
        super().__init__(stack.frame, background=back, padx=8, pady=6, highlightthickness=1,
                         highlightbackground="#ffffff")
        self.stack, self.kind, self.text = stack, kind, text
        self.sign = tk.Label(self, text=sign, background=back, foreground=fore)
        self.label = tk.Label(self, text=text, background=back, foreground=fore, justify="left")
        self.label.bind("<Button-1>", lambda event: self.show_all())
        self.cross = stack.button(self, "✕", lambda: stack.remove(self))
        self.sign.pack(side="left", anchor="n")
        self.cross.pack(side="right", anchor="n")
        self.label.pack(side="left", padx=6)

    def height(self):
        """Pixels that it asks for; known at once, unlike those of the frame."""
        edge = int(str(self.cget("pady"))) + int(str(self.cget("highlightthickness")))
        return max(part.winfo_reqheight() for part in (self.sign, self.label, self.cross)) + 2 * edge

    def fit(self, width, height):
        """Lines of at most this width, and so many of them that the message has this height (pixels)."""
        self.label.configure(text=self.text, wraplength=width)
        fits, too_long = 0, len(self.text) if self.height() > height else 0
        while too_long - fits > 1:
            tried = (fits + too_long) // 2
            self.label.configure(text=self.text[:tried] + CUT)
            fits, too_long = (tried, too_long) if self.height() <= height else (fits, tried)
        if fits:
            self.label.configure(text=self.text[:fits] + CUT)

    def show_all(self):
        """A click on a text that is cut shows it whole."""
        if str(self.label.cget("text")) != self.text:
            dialogs.ask(self.stack.root, _("Message"), self.label.cget("text").split("\n")[0], self.kind, 0, _("OK"),
                        extra=self.text, escape=0)


class Notifications:
    """add(kind, text) with kind "error" or "info"; on_change(any error shown) is told."""

    def __init__(self, root, on_change=lambda error: None, wrap=WRAP_PX):
        self.root, self.on_change, self.wrap = root, on_change, wrap
        self.frame = tk.Frame(root)
        self.pad = 0             # pixels above and below what closes a message
        self.shown = []          # (kind, Message), oldest first
        self.header = tk.Frame(self.frame)
        self.size = None         # of the window, when messages were placed
        root.bind("<Configure>", self._resized, "+")

    def button(self, holder, text, command):
        return tk.Button(holder, text=text, background=holder.cget("background"), foreground="#ffffff", relief="flat",
                         takefocus=False, padx=2 + self.pad, pady=self.pad, command=command)

    def add(self, kind, text):
        kind = kind if kind in COLOURS else "info"
        self.shown.append((kind, Message(self, kind, text)))
        while len(self.shown) > MOST:
            self.shown.pop(0)[1].destroy()
        self.place()

    def remove(self, box):
        self.shown = [(k, b) for k, b in self.shown if b is not box]
        box.destroy()
        self.place()

    def clear(self, kind=None):
        """Removes all, or those of one kind."""
        for k, box in list(self.shown):
            if kind is None or k == kind:
                self.remove(box)

    def drop(self, unwanted):
        """Removes messages for whose text unwanted(text) is true."""
        for _kind, box in list(self.shown):
            if unwanted(box.text):
                self.remove(box)

    def place(self):
        """Shows the newest ones that have room, above them how many more there are."""
        self.size = self.root.winfo_width(), self.root.winfo_height()
        # A window that was never shown has no size yet.
        width, height = (have if have > 1 else asked
                         for have, asked in zip(self.size, (self.root.winfo_reqwidth(), self.root.winfo_reqheight())))
        for child in self.frame.pack_slaves():
            child.pack_forget()
        self.header.destroy()
        if self.shown:
            self.header = self._head()
            room = round(HIGHEST * height) - self.header.winfo_children()[1].winfo_reqheight()
            most, seen = room, []
            for _kind, box in reversed(self.shown):
                box.fit(min(self.wrap, round(WIDEST * width)), most)
                room -= box.height() + 2 * GAP
                if room < 0 and seen:
                    break
                seen.insert(0, box)
            earlier = len(self.shown) - len(seen)
            if earlier:
                self.header.winfo_children()[0].configure(text=_("%d earlier messages") % earlier)
            for box in ([self.header] if earlier or len(seen) >= MANY else []) + seen:
                box.pack(side="top", fill="x", pady=GAP)
            self.frame.place(relx=1, rely=1, x=-MARGIN_X, y=-MARGIN_Y, anchor="se")
            self.frame.lift()
        else:
            self.frame.place_forget()
        self.on_change(any(k == "error" for k, _box in self.shown))

    def _head(self):
        """The line above many messages."""
        header = tk.Frame(self.frame, background=GROUND, padx=8, pady=2, highlightthickness=1,
                          highlightbackground="#ffffff")
        tk.Label(header, background=GROUND, foreground="#ffffff").pack(side="left")
        self.button(header, _("Close all"), self.clear).pack(side="right")
        return header

    def _resized(self, event):
        if event.widget is self.root and self.shown and (event.width, event.height) != self.size:
            self.root.after_idle(self.place)
