# SPDX-License-Identifier: GPL-2.0-or-later
"""The page of text in AXIS: [DISPLAY]TKPKG = Ngcguittt 1.0 behind Ngcgui 1.0. It makes a subroutine file of a text
with the program [DISPLAY]TTT, and opens a page of ngcgui with it."""

import tkinter as tk
from pathlib import Path
from tkinter import filedialog, ttk

from ..language import _, N_
from .ngcfiles import NotUsable, form_of, is_value, start_folder
from .textfiles import DEFAULT, Failed, Tracing, command_of, subroutine, word_of, write

FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
LOOK_MS = 50
PATIENCE_S = 30
ROWS = (("text", N_("Text"), ""), ("font", N_("Font file"), FONT), ("scale", N_("Scale"), "1"),
        ("more", N_("More options"), ""), ("name", N_("Name of the subfile"), ""))


class TextPage:
    """tabs: the Tabs of ngcgui."""

    def __init__(self, frame, style, tabs):
        self.tabs, self.tracing, self.looks = tabs, None, 0
        self.program = tabs.find("DISPLAY", "TTT") or DEFAULT
        px = style.px
        self.frame = ttk.Frame(frame, padding=px(8))
        self.values, self.entries = {}, {}
        for row, (key, label, value) in enumerate(ROWS):
            ttk.Label(self.frame, text=_(label)).grid(row=row, column=0, sticky="w", padx=(0, px(8)), pady=px(2))
            self.values[key] = tk.StringVar(frame, value)
            self.entries[key] = tk.Entry(self.frame, textvariable=self.values[key], relief="flat", highlightthickness=1,
                                         highlightbackground=style.colours["line"],
                                         highlightcolor=style.colours["select"])
            self.entries[key].grid(row=row, column=1, sticky="ew", pady=px(2))
            self.entries[key].bind("<Return>", lambda event: self.make())
        self.frame.columnconfigure(1, weight=1)
        self.frame.rowconfigure(len(ROWS) + 1, weight=1)
        self.choose = ttk.Button(self.frame, text=_("Browse"), command=self.choose_font, takefocus=False)
        self.choose.grid(row=1, column=2, padx=(px(4), 0))
        self.button = ttk.Button(self.frame, text=_("Make the subfile"), command=self.make, takefocus=False)
        self.button.grid(row=len(ROWS), column=1, sticky="w", pady=px(6))
        self.status = ttk.Label(self.frame, anchor="w", padding=px(4), relief="sunken")
        self.status.grid(row=len(ROWS) + 2, column=0, columnspan=3, sticky="ew")
        self.status.bind("<Configure>", lambda event: self.status.configure(wraplength=event.width - px(12)))
        self.say(_("%s makes a subfile of the text") % self.program)

    def say(self, text, bad=False):
        self.status.configure(text=text, style="Bad.TLabel" if bad else "TLabel")

    def choose_font(self):
        present = Path(self.values["font"].get())
        if path := filedialog.askopenfilename(parent=self.frame, title=_("Font file"), initialdir=str(present.parent),
                                              filetypes=((_("Fonts"), "*.ttf *.otf *.pfb"), (_("All files"), "*"))):
            self.values["font"].set(path)

    def path(self):
        """Where the file goes: the folder of subfiles; its name follows the text where none is given."""
        typed = self.values["name"].get().strip().removesuffix(".ngc")
        name = word_of(typed, "") or "ttt_" + word_of(self.values["text"].get(), "text")
        base = Path(self.tabs.app.settings.ini_path).resolve().parent
        return base / start_folder(self.tabs.find) / f"{name}.ngc"

    def make(self):
        """Starts the program; look() takes what it writes."""
        if self.tracing is not None:
            return
        text, font, scale = (self.values[k].get().strip() for k in ("text", "font", "scale"))
        if not text:
            self.say(_("Type a text"), True)
        elif scale and not (is_value(scale) and float(scale) > 0):
            self.say(_("%s: %r is no number above zero") % (_("Scale"), scale), True)
        elif font and not Path(font).is_file():
            self.say(_("There is no file %s") % font, True)
        else:
            try:
                self.tracing = Tracing(command_of(self.program, font, scale, text, self.values["more"].get()))
            except (Failed, ValueError) as error:
                self.say(str(error), True)
                return
            self.looks = 0
            self.button.configure(state="disabled")
            self.say(_("%s runs") % self.tracing.name)
            self.frame.after(LOOK_MS, self.look)

    def look(self):
        """Until the program is done."""
        self.looks += 1
        try:
            code = self.tracing.poll()
            if code is None and self.looks * LOOK_MS > PATIENCE_S * 1000:
                self.tracing.end()
                raise Failed(_("%s does not end") % self.tracing.name)
            if code is None:
                self.frame.after(LOOK_MS, self.look)
                return
            self.finish(code)
        except Failed as error:
            self.say(str(error), True)
        self.tracing = None
        self.button.configure(state="normal")

    def finish(self, code):
        path, text = self.path(), self.values["text"].get().strip()
        info = ", ".join(w for w in (text, Path(self.values["font"].get().strip()).stem,
                                     self.values["scale"].get().strip()) if w)
        try:
            write(path, subroutine(path.stem, code, info))
            form_of(path)
        except (NotUsable, OSError) as error:
            raise Failed(str(error)) from None
        self.say(_("Made: %s") % path)
        shown = [page for page in self.tabs.pages if page.form and Path(page.form.path) == path]
        for page in shown:
            page.reread()
        if not shown:
            self.tabs.add(str(path), self.tabs.find("DISPLAY", "TTT_PREAMBLE"))


def add(tabs):
    """The page as a tab behind those of ngcgui."""
    frame = tabs.app.wrap(str(tabs.app.add_tab("ngcguittt", "ttt")))
    page = TextPage(frame, tabs.style, tabs)
    page.frame.pack(fill="both", expand=True)
    return page
