# SPDX-License-Identifier: GPL-2.0-or-later
"""ngcgui: programs from subroutine files, by filling in forms."""

import argparse
import base64
import io
import os
import subprocess
import sys
import tkinter as tk
from pathlib import Path
from tkinter import filedialog, messagebox, ttk

from .. import position, tkstyle
from ..language import _, N_
from .ngcfiles import NotUsable, Program, find_file, folders_of, form_of, is_value, start_folder
from .widgets import Scrolled

TITLE = "ngcgui"
PICTURE = (320, 240)        # at most, pixels
DEFAULT_OUT = "auto.ngc"
COORDINATES = "xyzabcuvw"
KEYS = _("""Ctrl-a  autosend on, off           Ctrl-n  restart
Ctrl-c  clear the entries          Ctrl-p  preamble        Ctrl-P  postamble
Ctrl-d  default values             Ctrl-r  read the subfile again
Ctrl-e  edit the last file         Ctrl-R  retain values on reading
Ctrl-E  expand the subroutine      Ctrl-q  verbose
Ctrl-f  create a feature           Ctrl-s  status
Ctrl-F  finalize                   Ctrl-u  edit the subfile
Ctrl-k  this list                  Ctrl-U  edit the preamble
x y z a b c u v w in an entry: the present coordinate; d: twice x""")


class Page:
    """One form with its program. find(section, name) reads the INI file; coordinate(letter) the machine's position."""

    def __init__(self, parent, style, options, find=lambda *_: None, coordinate=None):
        self.parent, self.style, self.o, self.find, self.coordinate = parent, style, options, find, coordinate
        self.form, self.rows, self.last, self.key_tag = None, [], None, f"NgcguiKeys{id(self)}"
        self.program = Program(options.preamble, options.postamble, options.m2)
        self.retain, self.expand = tk.BooleanVar(parent, True), tk.BooleanVar(parent, False)
        self.autosend, self.verbose = tk.BooleanVar(parent, options.autosend), tk.BooleanVar(parent, not options.quiet)
        px = style.px
        self.frame = ttk.Frame(parent, padding=px(6))
        self.status = ttk.Label(self.frame, anchor="w", padding=px(4), relief="sunken")
        self.status.pack(side="bottom", fill="x")
        self.status.bind("<Configure>", lambda event: self.status.configure(wraplength=event.width - px(12)))
        self.font = self._font()
        self._controls()
        self.dress(self.frame)
        self.entries = Scrolled(self.frame, style)
        self.entries.pack(side="left" if not options.vert else "top", fill="both", expand=True, padx=px(6))
        if options.subfile:
            self.read(options.subfile)
        else:
            self.say(_("Choose a subfile"))

    def _font(self):
        """The font that is asked for, or None."""
        if not self.o.font:
            return None
        try:
            self.parent.tk.call("font", "actual", self.o.font)
        except tk.TclError as error:
            print(f"ngcgui: font {self.o.font}: {error}", file=sys.stderr)
            return None
        for kind in ("TButton", "TCheckbutton"):
            ttk.Style(self.parent).configure(f"Ngcgui.{kind}", font=self.o.font)
        return self.o.font

    def dress(self, widget):
        """Gives the page's font to a widget and what is in it."""
        if self.font is None:
            return
        if isinstance(widget, (ttk.Button, ttk.Checkbutton)):
            widget.configure(style=f"Ngcgui.{widget.winfo_class()}")
        elif "font" in widget.keys():
            widget.configure(font=self.font)
        for child in widget.winfo_children():
            self.dress(child)

    def _controls(self):
        px = self.style.px
        self.controls = Scrolled(self.frame, self.style)
        self.controls.pack(side="left" if not self.o.vert else "top", fill="y")
        box = self.controls.inner
        self.buttons, self.names = {}, {}

        def button(text, action):
            self.buttons[text] = ttk.Button(box, text=_(text), command=action, takefocus=False)
            self.buttons[text].pack(fill="x", pady=px(1))
        for text, action in ((N_("Preamble"), self.choose_preamble), (N_("Subfile"), self.choose_subfile),
                             (N_("Postamble"), self.choose_postamble)):
            button(text, action)
            self.names[text] = ttk.Label(box, style="Faint.TLabel", anchor="w")
            self.names[text].pack(fill="x")
        for text, variable in ((N_("Retain values on Subfile read"), self.retain),
                               (N_("Expand subroutine"), self.expand), (N_("Autosend"), self.autosend),
                               (N_("Verbose ngcfile"), self.verbose)):
            ttk.Checkbutton(box, text=_(text), variable=variable, takefocus=False,
                            command=self.show_state).pack(fill="x")
        for text, action in ((N_("Create Feature"), self.create), (N_("Reread"), self.reread),
                             (N_("Restart"), self.restart), (N_("MakeFile"), self.finalize),
                             (N_("SendFileToAxis"), self.send), (N_("Exit"), self.exit)):
            button(text, action)
        self.picture = ttk.Label(box, anchor="center")
        self.controls.wheel(*box.winfo_children())
        self.controls.fit_width(px(900))

    def say(self, text, bad=False):
        self.status.configure(text=text, style="Bad.TLabel" if bad else "TLabel")

    def show_state(self):
        """Names and labels that follow what is chosen."""
        self.program.verbose = self.verbose.get()
        count = len(self.program.features)
        self.buttons["Create Feature"].configure(text=_("Create Next") if count else _("Create Feature"),
                                                 state="normal" if self.form else "disabled")
        self.buttons["MakeFile"].configure(text=_("Finalize") if self.autosend.get() else _("MakeFile"),
                                           state="normal" if count else "disabled")
        self.buttons["SendFileToAxis"].configure(state="normal" if self.last else "disabled")
        for text, name in (("Preamble", self.program.preamble), ("Subfile", self.form.path.name if self.form else ""),
                           ("Postamble", self.program.postamble)):
            self.names[text].configure(text=os.path.basename(name) if not name.startswith(":") else name)

    # -- the form -----------------------------------------------------------------------

    def read(self, path):
        """Shows the form of a file; the old one stays when it is not usable."""
        try:
            form = form_of(path, folders_of(self.find("DISPLAY", "GCMC_INCLUDE_PATH")))
        except (NotUsable, OSError) as error:
            self.say(str(error), True)
            self.show_state()
            return False
        kept = ({row[0].name: row[2].get() for row in self.rows}
                if self.retain.get() and self.form and self.form.path == form.path else {})
        self.form = form
        self.show_form(kept)
        self.say(form.info or _("%s: %d parameters") % (form.path.name, len(form.parameters)))
        return True

    def show_form(self, kept):
        px, inner = self.style.px, self.entries.inner
        for child in inner.winfo_children():
            child.destroy()
        self.rows = []
        ttk.Label(inner, text=self.form.info or self.form.path.name, wraplength=px(420)).grid(row=0, column=0, columnspan=3, sticky="w", pady=(0, px(6)))
        for row, parameter in enumerate(self.form.parameters, 1):
            text = tk.StringVar(inner, kept.get(parameter.name, parameter.default))
            number = ttk.Label(inner, text=f"{parameter.number}", style="Faint.TLabel")
            entry = tk.Entry(inner, textvariable=text, width=self.o.vwidth, justify="right", highlightthickness=1,
                             relief="flat", borderwidth=1, highlightbackground=self.style.colours["line"],
                             highlightcolor=self.style.colours["select"])
            label = ttk.Label(inner, text=parameter.label or parameter.name, wraplength=px(8) * self.o.cwidth)
            for column, widget in enumerate((number, entry, label)):
                widget.grid(row=row, column=column, sticky="w", padx=px(3), pady=px(1),
                            ipady=self.style.roomy(1, 7) - 1 if widget is entry else 0)
            self.entries.wheel(number, entry, label)
            text.trace_add("write", lambda *_, t=text, e=entry: self.colour(t, e))
            entry.bindtags((self.key_tag, *entry.bindtags()))
            entry.bind("<KeyPress>", lambda event, t=text: self.entry_key(event, t))
            for key, step in (("<Return>", 1), ("<Down>", 1), ("<Up>", -1)):
                entry.bind(key, lambda event, r=row - 1, s=step: self.rows[(r + s) % len(self.rows)][1].focus_set())
            self.rows.append((parameter, entry, text))
            self.colour(text, entry)
        self.dress(inner)
        self.show_picture()
        self.show_state()

    def colour(self, text, entry):
        entry.configure(foreground=self.style.colours["ink" if is_value(text.get()) else "bad"])

    def show_picture(self):
        self.image = None
        if self.form.picture and not self.o.noiframe:
            try:
                from PIL import Image
                picture, data = Image.open(self.form.picture), io.BytesIO()
                picture.thumbnail(PICTURE)
                picture.convert("RGBA").save(data, "PNG")
                self.image = tk.PhotoImage(master=self.parent, data=base64.b64encode(data.getvalue()))
            except (OSError, ImportError) as error:
                self.say(f"{self.form.picture}: {error}", True)
        self.picture.configure(image=self.image or "")
        if self.image:
            self.picture.pack(fill="x", pady=self.style.px(6))
        else:
            self.picture.pack_forget()
        self.controls.fit_width(self.style.px(900))

    def entry_key(self, event, text):
        """A letter stands for the machine's coordinate."""
        key = event.char.lower()
        if event.state & 0xC or not key or key not in COORDINATES + "d" or not self.coordinate:
            return None
        value = self.coordinate("x" if key == "d" else key)
        if value is not None:
            text.set(f"{2 * value if key == 'd' else value:.4f}")
        return "break"

    def values(self):
        return [text.get() for _parameter, _entry, text in self.rows]

    def clear(self):
        for _parameter, _entry, text in self.rows:
            text.set("")

    def defaults(self):
        for parameter, _entry, text in self.rows:
            text.set(parameter.default)

    def reread(self):
        if self.form:
            self.read(self.form.path)

    # -- files --------------------------------------------------------------------------

    def folder(self):
        return Path(self.o.directory) if self.o.directory else start_folder(self.find)

    def ask_file(self, title):
        return filedialog.askopenfilename(parent=self.parent, title=title, initialdir=self.folder(),
                                          filetypes=((_("Subroutines"), "*.ngc *.gcmc"), (_("All files"), "*")))

    def choose_subfile(self):
        if path := self.ask_file(_("Subfile")):
            self.read(path)

    def choose_preamble(self):
        if path := self.ask_file(_("Preamble")):
            self.program.preamble = path
            self.show_state()

    def choose_postamble(self):
        if path := self.ask_file(_("Postamble")):
            self.program.postamble = path
            self.show_state()

    def edit(self, path):
        if path and not str(path).startswith(":"):
            editor = os.environ.get("VISUAL") or self.find("DISPLAY", "EDITOR") or "xdg-open"
            try:
                subprocess.Popen(editor.split() + [str(path)], stdin=subprocess.DEVNULL, start_new_session=True)
            except OSError as error:
                self.say(f"{editor}: {error.strerror}", True)

    # -- features -----------------------------------------------------------------------

    def create(self):
        """One more feature with the values shown."""
        if not self.form:
            return False
        try:
            self.program.add(self.form, self.values(), self.expand.get())
        except (ValueError, NotUsable) as error:
            self.say(str(error), True)
            return False
        self.say(_("Features: %d, the last one from %s") % (len(self.program.features), self.form.path.name))
        self.show_state()
        return True

    def restart(self):
        self.program.features.clear()
        self.say(_("No features"))
        self.show_state()

    def finalize(self):
        """The program is written; with Autosend AXIS opens it."""
        if not self.program.features:
            self.say(_("There is no feature: Create Feature makes one"), True)
            return
        try:
            self.last = self.program.write(self.o.output or DEFAULT_OUT)
        except OSError as error:
            self.say(f"{error.filename}: {error.strerror}", True)
            return
        count = len(self.program.features)
        self.program.features.clear()
        self.say(_("%s: %d features") % (self.last, count))
        self.show_state()
        if self.autosend.get():
            self.send()

    def send(self):
        if not self.last:
            return
        try:
            done = subprocess.run(["axis-remote", str(Path(self.last).resolve())], stdin=subprocess.DEVNULL,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                  timeout=20)
            problem = done.stdout.strip() if done.returncode else ""
        except (OSError, subprocess.TimeoutExpired) as error:
            problem = str(error)
        self.say(_("Not sent: %s") % problem if problem else _("Sent to AXIS: %s") % self.last, bool(problem))

    def exit(self):
        """Features that are in no file are asked for."""
        if self.program.features:
            answer = messagebox.askyesnocancel(TITLE,
                                               _("%d features are in no file yet.\nWrite it?")
                                               % len(self.program.features), parent=self.parent)
            if answer is None:
                return
            if answer:
                self.finalize()
                if self.program.features:
                    return
        self.parent.winfo_toplevel().destroy()

    def show_keys(self):
        messagebox.showinfo(TITLE, KEYS, parent=self.parent)

    def show_status(self):
        self.say(_("%d features, last file: %s") % (len(self.program.features), self.last or _("none")))

    def bind_keys(self, bind):
        """bind(key, handler): for the whole window, or a class of widgets."""
        def flip(variable):
            variable.set(not variable.get())
            self.show_state()
        actions = {"a": lambda: flip(self.autosend), "c": self.clear, "d": self.defaults,
                   "e": lambda: self.edit(self.last), "E": lambda: flip(self.expand),
                   "f": self.create, "F": self.finalize, "k": self.show_keys, "n": self.restart,
                   "p": self.choose_preamble, "P": self.choose_postamble,
                   "r": self.reread, "R": lambda: flip(self.retain), "q": lambda: flip(self.verbose),
                   "s": self.show_status, "S": self.show_status,
                   "u": lambda: self.edit(self.form.path if self.form else None),
                   "U": lambda: self.edit(self.program.preamble)}
        for key, action in actions.items():
            def handler(_event, a=action):
                a()
                return "break"
            bind(f"<Control-{key}>", handler)


def machine_position():
    """The function that tells a coordinate of the running machine, or None."""
    def coordinate(letter):
        import linuxcnc
        try:
            stat = linuxcnc.stat()
            stat.poll()
        except linuxcnc.error:
            return None
        return position.coordinate(stat, letter)
    return coordinate


def options(arguments):
    p = argparse.ArgumentParser(prog="ngcgui", description="Programs from subroutine files.", allow_abbrev=False)
    p.add_argument("-D", dest="directory", metavar="DIR", help="folder of the files")
    p.add_argument("-i", dest="ini", metavar="INI", help="INI file")
    p.add_argument("-S", dest="subfile", default="", metavar="FILE", help="subfile")
    p.add_argument("-p", dest="preamble", default="", metavar="FILE", help="preamble (a file, or :G-code;G-code)")
    p.add_argument("-P", dest="postamble", default="", metavar="FILE", help="postamble")
    p.add_argument("-o", dest="output", default=DEFAULT_OUT, metavar="FILE", help=f"program ({DEFAULT_OUT})")
    p.add_argument("-a", dest="autosend", action="store_true", help="send the program to AXIS")
    p.add_argument("--noauto", dest="autosend", action="store_false", help="do not send it")
    p.add_argument("-N", "--nom2", dest="m2", action="store_false", help="%% around the program, not m2 at its end")
    p.add_argument("--font", metavar="FONT", help="font (Tcl)")
    kind = p.add_mutually_exclusive_group()
    kind.add_argument("--horiz", dest="vert", action="store_false", help="parts beside each other (default)")
    kind.add_argument("--vert", dest="vert", action="store_true", help="parts above each other")
    p.add_argument("--cwidth", type=int, metavar="N", default=40, help="width of comments, letters (40)")
    p.add_argument("--vwidth", type=int, metavar="N", default=10, help="width of values, letters (10)")
    p.add_argument("--quiet", action="store_true", help="no comments in the result")
    p.add_argument("--noiframe", action="store_true", help="no pictures")
    p.set_defaults(vert=False, autosend=False)
    return p.parse_args(arguments)


def take_ini(o, find):
    """What the command line leaves open comes from the INI file."""
    o.subfile = o.subfile or find("DISPLAY", "NGCGUI_SUBFILE") or ""
    o.preamble = o.preamble or find("DISPLAY", "NGCGUI_PREAMBLE") or ""
    o.postamble = o.postamble or find("DISPLAY", "NGCGUI_POSTAMBLE") or ""
    o.font = o.font or find("DISPLAY", "NGCGUI_FONT")
    words = (find("DISPLAY", "NGCGUI_OPTIONS") or "").split()
    o.m2 = o.m2 and "nom2" not in words
    o.noiframe = o.noiframe or "noiframe" in words
    if "noauto" in words:
        o.autosend = False


def main(arguments):
    o = options(arguments)
    find = lambda *_: None      # noqa: E731
    if o.ini:
        import linuxcnc
        try:
            ini = linuxcnc.ini(o.ini)
        except linuxcnc.error as error:
            print(f"ngcgui: {error}", file=sys.stderr)
            return 1
        find = ini.find
        take_ini(o, find)
    root = tkstyle.open_display("ngcgui", "Ngcgui")
    style = tkstyle.apply(root)
    root.title(TITLE)
    look = (lambda section, name: o.directory if name == "NGCGUI_SUBFILE_PATH" else None) if o.directory else find
    for name in ("subfile", "preamble", "postamble"):
        setattr(o, name, find_file(getattr(o, name), look, Path(o.ini).parent if o.ini and not o.directory else "."))
    page = Page(root, style, o, find, machine_position())
    page.frame.pack(fill="both", expand=True)
    page.bind_keys(root.bind_all)
    root.update_idletasks()
    tkstyle.centre(root, style.px(720), max(style.px(520), root.winfo_reqheight()), (style.px(480), style.px(360)))
    root.protocol("WM_DELETE_WINDOW", page.exit)
    root.mainloop()
    return 0
