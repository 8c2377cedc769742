# SPDX-License-Identifier: GPL-2.0-or-later
"""halconfig: HAL as a tree, changed by commands and saved as a file. halshow is the newer program."""

import os
import tkinter as tk
from tkinter import messagebox, ttk

from .. import tkstyle
from . import halshow

TITLE = "HAL Configuration"
QUESTION = "What is to be kept of HAL as it is now?"
KINDS = {"all": "all", "net": "netl"}       # what halcmd saves: everything; signals with their pins
FILE_TYPES = (("HAL files", "*.hal"), ("All files", "*"))


class Window(halshow.Window):
    """The window of halshow with menus for saving; the third page is for commands."""

    def __init__(self, root):
        self.answers = None
        super().__init__(root, halshow.Preferences(None))
        root.title(TITLE)
        self.book.tab(self.settings.scroll, state="hidden")
        page = self.modify = ttk.Frame(self.book, padding=self.style.px(12))
        ttk.Label(page, text="Commands of halcmd go into the line below: setp, net, addf and others.\nWhat they print is on the page SHOW.",
                  justify="left", wraplength=self.style.px(420)).pack(anchor="w")
        self.book.add(page, text=" MODIFY ")

    def _menus(self):
        bar = tk.Menu(self.root)
        self.root.configure(menu=bar)
        self.menus = {}
        expand = (("Expand All", self.expand), ("Collapse All", self.collapse), ("Expand Pins", lambda: self.expand("pin")),
                  ("Expand Parameters", lambda: self.expand("param")), ("Expand Signals", lambda: self.expand("sig")))
        for title, entries in (
                ("File", (("Refresh", self.reload_tree), ("Save", lambda: self.save_hal("all")), ("Save INI Tuning", None), ("Save HAL Ini", None),
                          ("Save HAL Net", lambda: self.save_hal("net")), ("Save and Exit", self.save_and_exit), ("Exit", self.exit))),
                ("View", expand), ("Help", (("About...", self.about),))):
            menu = self.menus[title] = tk.Menu(bar, tearoff=False)
            bar.add_cascade(label=title, menu=menu, underline=0)
            for label, action in entries:
                menu.add_command(label=label, command=action or (lambda: None), state="normal" if action else "disabled")

    @property
    def mode(self):
        """The page with commands counts as the one that shows."""
        return "watchhal" if self.book.index("current") == 1 else "showhal"

    def about(self):
        messagebox.showinfo(TITLE, f"{TITLE}\nhalshow has watch lists with files, and settings.", parent=self.root)

    def save_hal(self, kind):
        """True when a file has been written."""
        path = self.ask_file.asksaveasfilename(parent=self.root, title="Save", filetypes=FILE_TYPES, defaultextension=".hal")
        if not path or self.hal("save", KINDS[kind], f"{path}.new") is None:
            return False
        try:
            os.replace(f"{path}.new", path)
        except OSError as error:
            self.say(f"{path}: {error.strerror}", True)
            return False
        self.say(f"Saved {path}")
        return True

    def save_and_exit(self):
        if self.save_hal("all"):
            self.leave()

    def leave(self):
        if self.timer:
            self.root.after_cancel(self.timer)
        self.root.destroy()

    def exit(self):
        """Asks what is to be saved."""
        if self.answers and self.answers.winfo_exists():
            return
        px = self.style.px
        top = self.answers = tk.Toplevel(self.root)
        top.title(TITLE)
        top.transient(self.root)
        ttk.Label(top, text=QUESTION, padding=px(14)).pack()
        row = ttk.Frame(top, padding=px(8))
        row.pack()

        def answer(kind):
            top.destroy()
            if kind == "leave" or (kind != "stay" and self.save_hal(kind)):
                self.leave()
        self.answer_buttons = {}
        for text, kind in (("Save All", "all"), ("Save Tune", ""), ("Save as Netlist", "net"), ("Don't Save", "leave"), ("Cancel", "stay")):
            button = self.answer_buttons[text] = ttk.Button(row, text=text, command=lambda k=kind: answer(k), state="normal" if kind else "disabled")
            button.pack(side="left", padx=px(3))
        top.bind("<Escape>", lambda event: top.destroy())

    def save_preferences(self):
        """There are none."""


def main(_arguments):
    root = tkstyle.open_display("halconfig", "Halconfig")
    Window(root)
    root.mainloop()
    return 0
