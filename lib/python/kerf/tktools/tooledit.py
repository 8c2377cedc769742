# SPDX-License-Identifier: GPL-2.0-or-later
"""tooledit: tool tables in a window."""

import os
import sys
import time
import tkinter as tk
from pathlib import Path
from tkinter import messagebox, ttk

from .. import instance, tkstyle
from ..language import _, N_
from . import tclprefs
from .sheet import Column, Sheet
from .tooltable import COLUMNS, COMMENT, Row, Table, chosen_columns, is_number

POLL_MS = 2000
LOCK = "/tmp/linuxcnc.lock"     # while a machine runs
CHARS = {"T": 5, "P": 5, "D": 9, "I": 10, "J": 10, "Q": 6, COMMENT: 18}
AXIS_CHARS = 8
TITLES = {"T": _("TOOL"), "P": _("POC"), "D": _("DIAM"), "I": _("FRONT"), "J": _("BACK"), "Q": _("ORIEN"),
          COMMENT: _("COMMENT")}
USAGE = f"""Usage: tooledit [COLUMN...] FILE
Edits a tool table. Columns: {' '.join(COLUMNS)} (default: all)."""


class Controller:
    """The running controller, when its tool table is this file."""

    def __init__(self, path):
        self.path, self.stat, self.random = Path(path).resolve(), None, False

    def look(self):
        """"none": another table or no controller; "busy"; "ready": on and idle."""
        if not os.path.exists(instance.suffixed(LOCK)):
            self.stat = None
            return "none"
        import linuxcnc
        try:
            self.stat = self.stat or linuxcnc.stat()
            self.stat.poll()
            ini = linuxcnc.ini(self.stat.ini_filename)
        except (linuxcnc.error, OSError):
            self.stat = None
            return "none"
        table = ini.find("EMCIO", "TOOL_TABLE")
        self.random = (ini.find("EMCIO", "RANDOM_TOOLCHANGER") or "0") not in ("0", "")
        if not table or (Path(self.stat.ini_filename).parent / os.path.expanduser(table)).resolve() != self.path:
            return "none"
        ready = self.stat.task_state == linuxcnc.STATE_ON and self.stat.interp_state == linuxcnc.INTERP_IDLE
        return "ready" if ready else "busy"

    def reload(self):
        import linuxcnc
        linuxcnc.command().load_tool_table()


class Window:
    def __init__(self, root, table, letters, rc):
        self.root, self.table, self.rc = root, table, Path(rc)
        self.letters = ["T", "P"] + letters + [COMMENT]
        self.controller, self.warned, self.order = Controller(table.path), None, (None, False)
        self.timer = None
        style = self.style = tkstyle.apply(root)
        root.title(f"tooledit: {table.path.name}")
        columns = [Column(c, TITLES.get(c, c), CHARS.get(c, AXIS_CHARS), c == COMMENT) for c in self.letters]
        self.status = ttk.Label(root, anchor="w", padding=style.px(4))
        self.status.pack(side="bottom", fill="x")
        self._make_buttons()
        self.sheet = Sheet(root, style, columns, lambda key, text: key == COMMENT or is_number(key, text),
                           self.changed, self.sort)
        self.sheet.pack(fill="both", expand=True, padx=style.px(4), pady=style.px(4))
        root.update_idletasks()
        least = self.bar.winfo_reqwidth() + style.px(8)         # with all buttons
        tkstyle.centre(root, max(self.sheet.winfo_reqwidth() + style.px(30), least), style.px(460),
                       (least, style.px(240)))
        values = tclprefs.read(rc)[0]
        if "geometry" in values:
            try:
                root.geometry(values["geometry"])
            except tk.TclError:
                pass
        root.protocol("WM_DELETE_WINDOW", self.quit)
        for key, action in (("<Control-s>", self.save), ("<Control-q>", self.quit)):
            root.bind(key, lambda event, a=action: a() and None)
        self.sheet.show(table.rows)
        rejected = _("; %d bogus lines stay in the file as they are") % len(table.rejected) if table.rejected else ""
        self.say(_("%d tools") % len(table.rows) + rejected)
        self.changed()
        self.poll()

    def _make_buttons(self):
        bar = self.bar = ttk.Frame(self.root, padding=self.style.px(4))
        bar.pack(side="bottom", fill="x")
        self.buttons = {}
        for name, action in ((N_("Delete"), self.delete), (N_("AddTool"), self.add), (N_("ReRead"), self.reread),
                             (N_("SaveFile"), self.save), (N_("ReLoadTable"), self.reload), (N_("Quit"), self.quit)):
            self.buttons[name] = ttk.Button(bar, text=_(name), command=action)
            self.buttons[name].pack(side="left", expand=True, fill="x", padx=self.style.px(2))

    def say(self, text, bad=False):
        self.status.configure(text=text, style="Bad.TLabel" if bad else "TLabel")

    def changed(self):
        """A cell or a tick changed."""
        self.buttons["Delete"].configure(state="normal" if self.sheet.ticked else "disabled")
        self.root.title(f"tooledit: {self.table.path.name}{' *' if self.table.modified else ''}")

    # -- buttons ------------------------------------------------------------------------

    def delete(self):
        gone = {id(row) for row in self.sheet.ticked_rows()}
        self.table.rows[:] = [row for row in self.table.rows if id(row) not in gone]
        self.sheet.show(self.table.rows)
        self.say(_("%d deleted (in the file with SaveFile)") % len(gone))
        self.changed()

    def add(self):
        self.table.rows.append(Row({"T": "NEW", "P": "NEW", COMMENT: time.strftime("Added %Y%m%d")}))
        self.sheet.show(self.table.rows)
        self.sheet.focus_cell(len(self.table.rows) - 1)
        self.changed()

    def sort(self, letter):
        decreasing = self.order == (letter, False)
        self.order = (letter, decreasing)
        self.table.sort(letter, decreasing)
        self.sheet.show(self.table.rows)
        text = _("Sorted by %s, decreasing") if decreasing else _("Sorted by %s, increasing")
        self.say(text % TITLES.get(letter, letter))
        self.changed()

    def reread(self):
        try:
            self.table.reread()
        except OSError as error:
            return self.say(str(error), True)
        self.warned = None
        self.sheet.show(self.table.rows)
        self.say(_("Read again: %d tools") % len(self.table.rows))
        self.changed()
        return None

    def save(self):
        """True when the file has the table now."""
        self.root.focus_set()
        problems = self.table.problems(self.controller.random and self.controller.look() != "none")
        if problems:
            self.show_problems(problems)
            self.say(_("Not saved"), True)
            return False
        self.look_at_file()
        if self.warned and not messagebox.askyesno("tooledit",
                                                   _("%s.\nReplace it with what is shown here?") % self.warned,
                                                   parent=self.root):
            return False
        try:
            self.table.save()
        except (OSError, UnicodeEncodeError) as error:
            self.say(_("Not saved: %s") % error, True)
            return False
        self.warned = None
        self.say(_("Saved %s; the old file is %s.bak") % (self.table.path, self.table.path.name))
        self.changed()
        return True

    def reload(self):
        if self.save():
            self.controller.reload()
            self.say(_("Saved; the controller reads the table again"))

    def quit(self):
        if self.table.modified:
            answer = messagebox.askyesnocancel("tooledit", _("Save the changes to %s?") % self.table.path.name,
                                               parent=self.root)
            if answer is None or (answer and not self.save()):
                return
        self.remember()
        if self.timer:
            self.root.after_cancel(self.timer)
        self.root.destroy()

    def show_problems(self, problems):
        """A list of what is wrong."""
        window = tk.Toplevel(self.root)
        window.title("tooledit: " + _("please correct"))
        window.transient(self.root)
        style = self.style
        ttk.Button(window, text=_("Close"), command=window.destroy).pack(side="bottom", pady=style.px(8))
        box = tk.Listbox(window, width=min(90, max(len(p) for p in problems) + 2), height=min(20, len(problems) + 1))
        bar = ttk.Scrollbar(window, command=box.yview)
        box.configure(yscrollcommand=bar.set)
        bar.pack(side="right", fill="y")
        box.pack(fill="both", expand=True, padx=style.px(6), pady=style.px(6))
        for text in problems:
            box.insert("end", text)
        window.bind("<Escape>", lambda event: window.destroy())
        self.problem_window = window

    # -- outside world ------------------------------------------------------------------

    def poll(self):
        self.look()
        self.timer = self.root.after(POLL_MS, self.poll)

    def look(self):
        """Whether the file and the controller are as before."""
        button = self.buttons["ReLoadTable"]
        state = self.controller.look()
        if state == "none":
            button.pack_forget()
        elif not button.winfo_manager():
            button.pack(side="left", expand=True, fill="x", padx=self.style.px(2), before=self.buttons["Quit"])
        button.configure(state="normal" if state == "ready" else "disabled")
        self.look_at_file()

    def look_at_file(self):
        stamp = self.table.look()
        if stamp != self.table.stamp:
            self.table.stamp = stamp
            self.warned = (_("Warning: File changed by another process") if stamp
                           else _("Warning: File deleted by another process"))
            self.say(self.warned, True)

    def remember(self):
        """The place of the window, for the next time; the first time tells which columns there are."""
        first = not self.rc.exists()
        try:
            kept = ([] if first else [line
                                      for line in self.rc.read_text().splitlines()
                                      if not line.split()[:2] == ["set", "geometry"]])
            tclprefs.write(self.rc, "\n".join(kept + [f"set geometry {self.root.geometry()}", ""]))
        except (OSError, UnicodeError) as error:
            print(f"tooledit: {self.rc}: {error}", file=sys.stderr)
            return
        if first:
            names = {letter: name for name, letter in COLUMNS.items()}
            used = " ".join(names[letter] for letter in self.letters if letter in names)
            messagebox.showinfo("tooledit",
                                _("Columns used: %s\n\nThe columns can be chosen:\n    tooledit x z diam FILE\n"
                                  "or in the INI file:\n    [DISPLAY]TOOL_EDITOR = tooledit x z diam") % used,
                                  parent=self.root)


def main(arguments):
    if not arguments or arguments[0] in ("-h", "--help"):
        print(USAGE, file=sys.stderr)
        return 0 if arguments else 1
    letters, complaints = chosen_columns(arguments[:-1])
    for text in complaints:
        print(f"tooledit: {text}", file=sys.stderr)
    try:
        table = Table(arguments[-1])
    except OSError as error:
        print(f"tooledit: {arguments[-1]}: {error.strerror}", file=sys.stderr)
        return 1
    root = tkstyle.open_display("tooledit", "Tooledit")
    Window(root, table, letters, Path.home() / ".tooleditrc")
    root.mainloop()
    return 0
