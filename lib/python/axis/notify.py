# SPDX-License-Identifier: GPL-2.0-or-later
"""Messages to the operator: a stack in the lower right corner of the window."""

import tkinter as tk

MOST = 11                # the next one removes the oldest
WRAP_PX = 300
COLOURS = {"error": ("#7a1f1f", "#ffffff", "✖"), "info": ("#1f4a7a", "#ffffff", "ℹ")}


class Notifications:
    """add(kind, text) with kind "error" or "info"; on_change(any error shown) is told."""

    def __init__(self, root, on_change=lambda error: None, wrap=WRAP_PX):
        self.root, self.on_change, self.wrap = root, on_change, wrap
        self.frame = tk.Frame(root)
        self.pad = 0             # pixels above and below what closes a message
        self.shown = []          # (kind, widget), oldest first

    def add(self, kind, text):
        kind = kind if kind in COLOURS else "info"
        back, fore, sign = COLOURS[kind]
        box = tk.Frame(self.frame, background=back, padx=8, pady=6, highlightthickness=1, highlightbackground="#ffffff")
        tk.Label(box, text=sign, background=back, foreground=fore).pack(side="left", anchor="n")
        tk.Label(box, text=text, background=back, foreground=fore, wraplength=self.wrap, justify="left").pack(side="left", padx=6)
        tk.Button(box, text="✕", background=back, foreground=fore, relief="flat", takefocus=False, padx=2 + self.pad, pady=self.pad,
                  command=lambda: self.remove(box)).pack(side="right", anchor="n")
        box.pack(side="bottom", fill="x", pady=2)
        self.shown.append((kind, box))
        while len(self.shown) > MOST:
            self.remove(self.shown[0][1])
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
        for _, box in list(self.shown):
            if unwanted(box.winfo_children()[1].cget("text")):
                self.remove(box)

    def place(self):
        if self.shown:
            self.frame.place(relx=1, rely=1, x=-16, y=-36, anchor="se")
            self.frame.lift()
        else:
            self.frame.place_forget()
        self.on_change(any(k == "error" for k, _ in self.shown))
