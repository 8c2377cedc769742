# SPDX-License-Identifier: GPL-2.0-or-later
"""halconfig: HAL as a tree, changed by commands and saved as a file. halshow is the newer program."""

import tkinter as tk
from tkinter import messagebox, ttk

from .. import tkstyle
from ..language import _, N_
from . import halshow

TITLE = _("HAL Configuration")
QUESTION = _("What is to be kept of HAL as it is now?")
KINDS = {"all": "all", "net": "netl"}       # what halcmd saves: everything; signals with their pins
FILE_TYPES = ((_("HAL files"), "*.hal"), (_("All files"), "*"))


class Window(halshow.Window):
    """The window of halshow with menus for saving; the third page is for commands."""

    def __init__(self, root):
        self.answers = None
        super().__init__(root, halshow.Preferences(None))
        root.title(TITLE)
        self.book.tab(self.settings.scroll, state="hidden")
        page = self.modify = ttk.Frame(self.book, padding=self.style.px(12))
        ttk.Label(page, text=_("Commands of halcmd go into the line below: setp, net, addf and others.\n"
                               "What they print is on the page SHOW."),
                  justify="left", wraplength=self.style.px(420)).pack(anchor="w")
        self.book.add(page, text=_(" MODIFY "))

    def _menus(self):
        bar = tk.Menu(self.root)
        self.root.configure(menu=bar)
        self.menus = {}
        expand = ((N_("Expand All"), self.expand), (N_("Collapse All"), self.collapse),
                  (N_("Expand Pins"), lambda: self.expand("pin")),
                  (N_("Expand Parameters"), lambda: self.expand("param")),
                  (N_("Expand Signals"), lambda: self.expand("sig")))
        for title, entries in (
                (N_("File"), ((N_("Refresh"), self.reload_tree), (N_("Save"), lambda: self.save_hal("all")),
                              (N_("Save INI Tuning"), None), (N_("Save HAL Ini"), None),
                          (N_("Save HAL Net"), lambda: self.save_hal("net")), (N_("Save and Exit"), self.save_and_exit),
                          (N_("Exit"), self.exit))),
                (N_("View"), expand), (N_("Help"), ((N_("About..."), self.about),))):
            menu = self.menus[title] = tk.Menu(bar, tearoff=False)
            bar.add_cascade(label=_(title), menu=menu, underline=0)
            for label, action in entries:
                menu.add_command(label=_(label), command=action or (lambda: None),
                                 state="normal" if action else "disabled")

    @property
    def mode(self):
        """The page with commands counts as the one that shows."""
        return "watchhal" if self.book.index("current") == 1 else "showhal"

    def about(self):
        messagebox.showinfo(TITLE, _("%s\nhalshow has watch lists with files, and settings.") % TITLE, parent=self.root)

    def save_hal(self, kind):
        """True when a file has been written."""
        path = self.ask_file.asksaveasfilename(parent=self.root, title=_("Save"), filetypes=FILE_TYPES,
                                               defaultextension=".hal")
        if not path or self.hal("save", KINDS[kind], path) is None:
            return False
        self.say(_("Saved %s") % path)
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
        for text, kind in ((N_("Save All"), "all"), (N_("Save Tune"), ""), (N_("Save as Netlist"), "net"),
                           (N_("Don't Save"), "leave"), (N_("Cancel"), "stay")):
            button = self.answer_buttons[text] = ttk.Button(row, text=_(text), command=lambda k=kind: answer(k),
                                                            state="normal" if kind else "disabled")
            button.pack(side="left", padx=px(3))
        top.bind("<Escape>", lambda event: top.destroy())

    def save_preferences(self):
        """There are none."""


def main(_arguments):
    root = tkstyle.open_display("halconfig", "Halconfig")
    Window(root)
    tkstyle.run(root, root.destroy)
    return 0
