# SPDX-License-Identifier: GPL-2.0-or-later
"""ngcgui in tabs of AXIS: [DISPLAY]TKPKG = Ngcgui 1.0, one tab for each [DISPLAY]NGCGUI_SUBFILE.

The Tcl packages Ngcgui and Ngcguittt (tcl/pkgIndex.tcl) call ::ngcgui::embed and ::ngcgui::embed_text, which offer()
has made.
"""

import tempfile
from pathlib import Path
from tkinter import messagebox, ttk

from .. import tkstyle
from ..language import _, N_
from ..position import coordinate
from .ngcgui import DEFAULT_OUT, Page, options, take_ini
from .ngcfiles import find_file
from . import ngcgui_text

COMMAND, TEXT_COMMAND = "::ngcgui::embed", "::ngcgui::embed_text"
CUSTOM = _("Custom")


class Tabs:
    """Pages of one AXIS; app: its App; subfiles: of the first pages, "" is Custom."""

    def __init__(self, app, subfiles):
        self.app, self.pages, self.count = app, [], 0
        self.folder = tempfile.TemporaryDirectory(prefix="ngcgui-")     # of the programs; gone with AXIS
        root = app.root
        self.style = getattr(app, "style",
                             None) or tkstyle.Style(tkstyle.DARK if tkstyle.wants_dark() else tkstyle.LIGHT,
                                                    tkstyle.wants_dark(), tkstyle.screen_scale(root))
        self.words = (self.find("DISPLAY", "NGCGUI_OPTIONS") or "").split()
        for name in subfiles:
            self.add(name.strip('"'))

    def find(self, section, name):
        return self.app.ini.find(section, name)

    def add(self, subfile, preamble=None):
        """One more tab; preamble: in place of [DISPLAY]NGCGUI_PREAMBLE."""
        o = options([])
        o.autosend = "noauto" not in self.words
        take_ini(o, lambda s, n: None if n == "NGCGUI_SUBFILE" else self.find(s, n))
        o.preamble = preamble or o.preamble
        base = Path(self.app.settings.ini_path).resolve().parent
        o.subfile, o.preamble, o.postamble = (find_file(n, self.find, base) for n in (subfile, o.preamble, o.postamble))
        o.output = str(Path(self.folder.name) / DEFAULT_OUT)
        title = Path(subfile).stem if subfile else CUSTOM
        self.count += 1
        name = f"ngcgui{self.count}"
        frame = self.app.wrap(str(self.app.add_tab(name, title)))
        page = EmbeddedPage(frame, self.style, o, self, name)
        page.frame.pack(fill="both", expand=True)
        self.pages.append(page)
        return page

    def notebook(self, *words):
        return self.app.root.tk.call(".pane.top.right", *words)

    def remove(self, page):
        """The tab goes; one with features asks first."""
        if page.program.features and not messagebox.askyesno("ngcgui",
                                                             _("%d features are in no file yet. Remove the tab?")
                                                             % len(page.program.features), parent=self.app.root):
            return
        self.pages.remove(page)
        self.notebook("raise", "preview")
        self.notebook("delete", page.name)

    def move(self, page, step):
        """One place to the left or right among the tabs of ngcgui."""
        place = self.pages.index(page) + step
        if 0 <= place < len(self.pages):
            names = [str(n) for n in self.app.root.tk.splitlist(self.notebook("pages"))]
            self.notebook("move", page.name, names.index(self.pages[place].name))
            self.pages.remove(page)
            self.pages.insert(place, page)

    def with_features(self):
        """Pages, from left to right, that have features in no file yet."""
        return [p for p in self.pages if p.program.features]


class EmbeddedPage(Page):
    """A page that shares its program with the others: Finalize takes the features of all."""

    def __init__(self, frame, style, o, tabs, name):
        self.tabs, self.name = tabs, name
        super().__init__(frame, style, o, tabs.find, self.position)
        self.buttons["Exit"].pack_forget()
        self.bind_keys(lambda key, action: frame.bind_class(self.key_tag, key, action))
        # and what AXIS does
        frame.bind_class(self.key_tag, "<Escape>", lambda event: tabs.notebook("raise", "preview") and None)
        row = ttk.Frame(self.frame)
        row.pack(side="bottom", fill="x")
        for text, option, action in ((N_("new"), "nonew", lambda: tabs.add(o.subfile)),
                                     (N_("remove"), "noremove", lambda: tabs.remove(self)),
                                     (N_("\N{LEFTWARDS ARROW} move"), "", lambda: tabs.move(self, -1)),
                                     (N_("move \N{RIGHTWARDS ARROW}"), "", lambda: tabs.move(self, 1))):
            if not option or option not in tabs.words:
                self.buttons[text] = ttk.Button(row, text=_(text), takefocus=False, command=action)
                self.buttons[text].pack(side="left", padx=1)
        self.dress(row)

    def position(self, letter):
        return coordinate(self.tabs.app.stat, letter)

    def finalize(self):
        """The features of all pages, in the order of the tabs, become one program."""
        for page in self.tabs.with_features():
            if page is not self:
                self.program.features += page.program.features
                page.restart()
        super().finalize()

    def send(self):
        if self.last:
            self.tabs.app.load(str(Path(self.last).resolve()))
            self.say(_("Opened: %s") % self.last)


def offer(app):
    """Makes the commands that the Tcl packages call."""
    made = []

    def forms(*_words):
        made.append(Tabs(app, app.ini.findall("DISPLAY", "NGCGUI_SUBFILE") or [""]))
        return ""

    def text(*_words):
        app.text_page = ngcgui_text.add(made[-1] if made else Tabs(app, []))
        return ""
    app.root.tk.createcommand(COMMAND, forms)
    app.root.tk.createcommand(TEXT_COMMAND, text)
