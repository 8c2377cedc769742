# SPDX-License-Identifier: GPL-2.0-or-later
"""Containers (they have add()), what is said to them, and elements for the whole window."""

import tkinter as tk

from .base import Directive


TAB_EDGE = 12       # pixels beside the last tab


class Container:
    """holder(): what children are made in; add(child) places one."""

    def holder(self):
        return self


class Box(tk.Frame, Container):
    def __init__(self, master, panel, bd=0, relief=tk.FLAT, **options):
        super().__init__(master, bd=bd, relief=relief, **options)
        self.settings = dict(self.start)


class Vbox(Box):
    start = {"side": "top", "fill": "x", "anchor": "center", "expand": "yes"}

    def add(self, child):
        child.pack(**self.settings)


class Hbox(Box):
    start = {"side": "left", "fill": "y", "anchor": "center"}

    def add(self, child):
        """boxexpand has no effect here."""
        child.pack(**{n: v for n, v in self.settings.items() if n != "expand"})


class Setting(Directive):
    """Changes how the following children of a box are placed."""

    def apply(self, container):
        if isinstance(container, Box):
            container.settings[self.name] = self.value


class Boxfill(Setting):
    def __init__(self, master, panel, fill):
        self.name, self.value = "fill", str(fill or "none").lower()


class Boxanchor(Setting):
    def __init__(self, master, panel, anchor):
        self.name, self.value = "anchor", anchor


class Boxexpand(Setting):
    def __init__(self, master, panel, expand):
        self.name, self.value = "expand", expand or "no"


class Labelframe(tk.LabelFrame, Container):
    def __init__(self, master, panel, **options):
        super().__init__(master, **options)

    def add(self, child):
        child.pack(side="top", fill="both", expand="yes")


class Table(tk.Frame, Container):
    """Rows are begun by tablerow; cells that a span has taken are skipped."""

    def __init__(self, master, panel, flexible_rows=(), flexible_columns=(), uniform_rows="",
                 uniform_columns="", **options):
        super().__init__(master, **options)
        self.row = self.column = 0
        self.span, self.sticky, self.taken = (1, 1), "ne", set()
        for numbers, configure in ((flexible_rows, self.rowconfigure), (flexible_columns, self.columnconfigure)):
            for number in numbers:
                configure(number, weight=1)
        for letters, configure in ((uniform_rows, self.rowconfigure), (uniform_columns, self.columnconfigure)):
            for number, letter in enumerate(letters, 1):
                if not letter.isspace():
                    configure(number, uniform=letter)

    def begin_row(self):
        self.row, self.column = self.row + 1, 1

    def add(self, child):
        while (self.row, self.column) in self.taken:
            self.column += 1
        rows, columns = self.span
        child.grid(row=self.row, column=self.column, rowspan=rows, columnspan=columns, sticky=self.sticky)
        self.taken |= {(self.row + r, self.column + c) for r in range(rows) for c in range(columns)}
        self.column += columns
        self.span = (1, 1)


class InTable(Directive):
    def apply(self, container):
        if not isinstance(container, Table):
            raise SystemExit(f"<{type(self).__name__.lower()}> stands outside of a table")
        self.tell(container)


class Tablerow(InTable):
    def __init__(self, master, panel):
        pass

    def tell(self, table):
        table.begin_row()


class Tablespan(InTable):
    def __init__(self, master, panel, rows=1, columns=1):
        self.span = int(rows), int(columns)

    def tell(self, table):
        table.span = self.span


class Tablesticky(InTable):
    def __init__(self, master, panel, sticky):
        self.sticky = sticky

    def tell(self, table):
        table.sticky = sticky_of(self.sticky)


def sticky_of(text):
    if set(str(text)) - set("nsew"):
        raise SystemExit(f"tablesticky: letters out of nsew are expected, not {text!r}")
    return text


class Tabs(tk.Widget, Container):
    """A BWidget notebook; one name for each child."""

    def __init__(self, master, panel, names=(), **options):
        master.tk.call("package", "require", "BWidget")
        tk.Widget.__init__(self, master, "NoteBook", options)
        self.names, self.pages, self.waiting = [str(name) for name in names], 0, None

    def holder(self):
        """The frame of the next page."""
        number = self.pages
        self.pages += 1
        text = self.names[number] if number < len(self.names) else f"Tab-{number + 1}"
        path = self.tk.call(self._w, "insert", "end", f"p{number}", "-text", text)
        frame = tk.Frame.__new__(tk.Frame)          # made by BWidget
        frame.tk, frame.master, frame._w, frame.children = self.tk, self, str(path), {}
        frame._name = str(path).rpartition(".")[2]
        self.children[frame._name] = frame
        return frame

    def add(self, child):
        child.pack(fill="both", expand="yes")
        if self.pages == 1:
            self.tk.call(self._w, "raise", "p0")
        if self.waiting is None:
            self.waiting = self.after_idle(self.widen)

    def tint(self):
        """The strip beside the names has the panel's ground."""
        self.tk.call(f"{self._w}.c", "configure", "-background", self.master["background"])

    def widen(self):
        """Room for what the pages hold when all is made, and for all names: the notebook thinks of its pages alone."""
        self.waiting = None
        if self.winfo_exists():
            self.tk.call(self._w, "compute_size")
            names = self.tk.splitlist(self.tk.call(f"{self._w}.c", "bbox", "page"))
            if names and int(names[2]) + TAB_EDGE > int(self["width"]):
                self.configure(width=int(names[2]) + TAB_EDGE)


class Include(tk.Frame, Container):
    """Another panel file; prefix takes the place of the component's in the names of its pins."""

    def __init__(self, master, panel, src=None, expand="yes", fill="both", anchor="center", prefix=None, **options):
        super().__init__(master, **options)
        if not src:
            raise ValueError("src = file is needed")
        self.settings = {"expand": expand, "fill": fill, "anchor": anchor}
        panel.include(self, src, prefix)

    def add(self, child):
        child.pack(side="top", **self.settings)


class Title(Directive):
    def __init__(self, master, panel, title=None, iconname=None):
        top = master.winfo_toplevel()
        if title is not None:
            top.wm_title(title)
        if iconname is not None:
            top.wm_iconname(iconname)

    def apply(self, container):
        pass


class Axisoptions(Directive):
    def __init__(self, master, panel):
        from rs274 import options
        options.install(master.winfo_toplevel())

    def apply(self, container):
        pass


class Option(Directive):
    def __init__(self, master, panel, pattern, value, priority=None):
        master.option_add(pattern, value, priority)

    def apply(self, container):
        pass


class Image(Directive):
    def __init__(self, master, panel, name, **options):
        panel.images[name] = tk.PhotoImage(name=name, master=master, **options)

    def apply(self, container):
        pass
