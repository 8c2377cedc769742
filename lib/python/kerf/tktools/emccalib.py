# SPDX-License-Identifier: GPL-2.0-or-later
"""emccalib: tuning of a running machine."""

import contextlib
import os
import sys
import tkinter as tk
from pathlib import Path
from tkinter import messagebox, ttk

from .. import tkstyle
from ..language import _, N_
from .calibration import SUPPORTED, Calibration, NotPossible
from .widgets import Scrolled

TITLE = "LinuxCNC Calibration"
USAGE = "Usage: emccalib [--] -ini FILE"
EDIT, TESTING = "edit", "testing"


class Tab:
    """The values of one section: edit, test, keep or take back."""

    def __init__(self, book, window, section, values):
        self.window, self.section, self.values, self.state = window, section, values, EDIT
        px = window.style.px
        page = self.page = ttk.Frame(book, padding=px(8))
        buttons = ttk.Frame(page)
        buttons.pack(side="bottom", pady=(px(8), 0))
        self.buttons = {}
        for name, action in (("OK", self.ok), (N_("Test"), self.test), (N_("Cancel"), self.cancel),
                             (N_("Refresh"), self.refresh)):
            self.buttons[name] = ttk.Button(buttons, text=_(name), command=action)
            self.buttons[name].pack(side="left", padx=px(4))
        table = self.table = Scrolled(page, window.style)
        table.pack(fill="both", expand=True)
        for column, title in enumerate((_("INI Name"), _("HAL's Value"), _("Next Value"))):
            ttk.Label(table.inner, text=title, anchor="w" if column == 0 else "e").grid(row=0, column=column, sticky="ew", padx=px(6), pady=px(4))
            table.inner.columnconfigure(column, weight=1)
        self.labels, self.entries = [], []
        for row, value in enumerate(values, 1):
            name = ttk.Label(table.inner, text=value.name, anchor="w")
            shown = ttk.Label(table.inner, style="Value.TLabel", anchor="e", width=16)
            entry = ttk.Entry(table.inner, width=16, justify="right", font="TkFixedFont")
            for column, widget in enumerate((name, shown, entry)):
                widget.grid(row=row, column=column, sticky="ew", padx=px(6), pady=px(1))
            table.wheel(name, shown, entry)
            entry.bind("<Return>", lambda event: self.test() if self.state == EDIT else None)
            self.labels.append(shown)
            self.entries.append(entry)
        book.add(page, text=section)
        self.refresh()

    def next(self, row, text):
        self.entries[row].configure(state="normal")
        self.entries[row].delete(0, "end")
        self.entries[row].insert(0, text)

    def arrange(self, state):
        """Which buttons and entries are alive."""
        self.state = state
        testing = state == TESTING
        for name, alive in (("OK", testing), ("Cancel", testing), ("Test", not testing), ("Refresh", not testing)):
            self.buttons[name].configure(state="normal" if alive else "disabled")
        for entry in self.entries:
            entry.configure(state="disabled" if testing else "normal")

    def refresh(self):
        """What HAL has, in both columns."""
        for row, value in enumerate(self.values):
            self.labels[row].configure(text=value.text())
            self.next(row, value.text())
        self.arrange(EDIT)

    def swap(self):
        """Shows HAL's values; the other column has those from before."""
        for row, value in enumerate(self.values):
            old = self.labels[row].cget("text")
            self.labels[row].configure(text=value.text())
            self.next(row, old)

    def test(self):
        try:
            self.window.model.test([(v, e.get()) for v, e in zip(self.values, self.entries)])
        except NotPossible as error:
            self.window.say(str(error), True)
            return
        self.swap()
        self.arrange(TESTING)
        self.window.say(_("[%s]: the new values are at work: OK keeps them, Cancel takes them back") % self.section)

    def ok(self):
        for row, value in enumerate(self.values):
            self.labels[row].configure(text=value.text())
            self.next(row, value.text())
        self.arrange(EDIT)
        self.window.say(_("[%s]: kept until the machine ends; Save To File writes them into the INI file")
                        % self.section)

    def cancel(self):
        try:
            self.window.model.cancel(self.values)
            self.window.say(_("[%s]: the old values are back") % self.section)
        except NotPossible as error:
            self.window.say(str(error), True)
        self.swap()
        self.arrange(EDIT)


class Window:
    def __init__(self, root, model):
        self.root, self.model = root, model
        style = self.style = tkstyle.apply(root)
        root.title(TITLE)
        self.status = ttk.Label(root, text=str(model.ini), anchor="w", padding=style.px(4), relief="sunken")
        self.status.pack(side="bottom", fill="x")
        bottom = ttk.Frame(root, padding=style.px(8))
        bottom.pack(side="bottom", fill="x")
        self.save_button = ttk.Button(bottom, text=_("Save To File"), command=self.save)
        self.save_button.pack(side="left", expand=True)
        self.quit_button = ttk.Button(bottom, text=_("Quit"), command=self.quit)
        self.quit_button.pack(side="left", expand=True)
        self.book = ttk.Notebook(root)
        self.book.pack(fill="both", expand=True, padx=style.px(4), pady=style.px(4))
        self.tabs = [Tab(self.book, self, section, values) for section, values in model.sections.items()]
        for tab in self.tabs:
            tab.table.fit_width(style.px(320))
        root.update_idletasks()
        tkstyle.centre(root, max(style.px(480), root.winfo_reqwidth()), root.winfo_reqheight(),
                       (style.px(320), style.px(240)))
        root.protocol("WM_DELETE_WINDOW", self.quit)

    def say(self, text, bad=False):
        self.status.configure(text=text, style="Bad.TLabel" if bad else "TLabel")

    def save(self):
        """True when the INI file has HAL's values."""
        try:
            changed = self.model.save()
        except (NotPossible, OSError) as error:
            messagebox.showerror(TITLE, str(error), parent=self.root)
            return False
        self.say(_("Saved %s: %s") % (self.model.ini.name, '; '.join(changed)) if changed
                 else _("The INI file has these values already"))
        return True

    def quit(self):
        """Values that would be lost with the machine are asked for."""
        try:
            changes = [c[3] for c in self.model.changes()]
        except OSError:
            changes = []
        if changes:
            answer = messagebox.askyesnocancel(TITLE,
                                               _("Values in use differ from the INI file:\n%s\n\nSave them?")
                                               % "\n".join(changes), parent=self.root)
            if answer is None or (answer and not self.save()):
                return
        self.root.destroy()


def ini_of(arguments):
    """The INI file that the command line names, else that of the environment; None: neither."""
    words = [w for w in arguments if w != "--"]
    if "-ini" in words[:-1]:
        return words[words.index("-ini") + 1]
    return os.environ.get("INI_FILE_NAME")


def main(arguments):
    if "-h" in arguments or "--help" in arguments:
        print(USAGE)
        return 0
    ini = ini_of(arguments)
    if not ini:
        print(USAGE, file=sys.stderr)
        return 1
    root = tkstyle.open_display("emccalib", "Emccalib")
    try:
        model = Calibration(Path(ini))
    except NotPossible as error:
        root.withdraw()
        print(f"emccalib: {error}", file=sys.stderr)
        with contextlib.suppress(tk.TclError):      # ended while the box was there
            messagebox.showerror(TITLE, str(error))
        return 1
    if not model.sections:
        tkstyle.apply(root)
        root.withdraw()
        text = (_("No HAL file of this machine sets a pin from a section for tuning:\n    setp PIN "
                  "[SECTION]NAME\nSections: %s") % (', '.join(SUPPORTED),))
        print(f"emccalib: {ini}: {text}", file=sys.stderr)
        with contextlib.suppress(tk.TclError):
            messagebox.showinfo(TITLE, text)
        return 1
    Window(root, model)
    root.mainloop()
    return 0
