# SPDX-License-Identifier: GPL-2.0-or-later
"""How the screen looks: colours, sizes, room for fingers. All of it changes while the screen runs."""

import tkinter as tk
import tkinter.ttk

from kerf import tkstyle

from .icons import Icons

# What AXIS has beside the colours of all Tk programs.
LIGHT = {"dro_back": "#101418", "dro": "#e8f0f6", "running": "#804040", "number": "#70767f", "chosen": "#b9d3ee", "trough": "#c9c5bd", "mark": "#fffffe"}
DARK = {"dro_back": "#0d1013", "dro": "#e8f0f7", "running": "#904848", "number": "#8a919c", "chosen": "#3f5f86", "trough": "#44474c", "mark": "#1e1f23"}
TOUCH, TOUCH_LOW = 1.45, 1.2     # buttons and sliders for gloves; on a low screen
SCALES = (0.0, 1.0, 1.25, 1.5, 1.75, 2.0)      # 0: from the screen
LEAST_WINDOW = (760, 520)


class LooksPart:
    """Part of App: the look of the window."""

    def first_look(self):
        """Before the widgets are made."""
        root = self.root
        root.tk.eval("namespace eval ::axis {}")
        root.tk.call("font", "create", "AxisBold", "-family", "DejaVu Sans", "-size", -13, "-weight", "bold")
        self.apply_style()
        self.icons = Icons(root, self.icon_px(), self.style.dark)
        width, height = root.winfo_screenwidth(), root.winfo_screenheight()
        px = self.style.px
        root.geometry(f"{min(px(1280), width)}x{min(px(860), height - 40)}")
        low = self.low() or (self.touch() and height < 800)
        for name, value in (("code_lines", 3 if self.low() else 4 if low else 9), ("gap", 2 if low else px(8)), ("spindle_side", "left" if low else "top")):
            root.tk.setvar(f"::axis::{name}", value)
        root.minsize(min(LEAST_WINDOW[0], width), min(LEAST_WINDOW[1], height - 40))

    def touch(self):
        return self.prefs.getpref("large_touch_targets", False)

    def low(self):
        """True for a screen that is low for what it has to show."""
        return self.root.winfo_screenheight() < tkstyle.SMALL_SCREEN * self.style.scale

    def roominess(self):
        """How much larger than usual buttons and sliders are."""
        return 1.0 if not self.touch() else TOUCH_LOW if self.low() else TOUCH

    def padding(self):
        return self.style.px(9 if self.roominess() > TOUCH_LOW else 5 if self.roominess() > 1 else 2)

    def letters_px(self):
        return -int(self.root.tk.call("font", "configure", "TkDefaultFont", "-size"))     # tkstyle gives pixels

    def icon_px(self):
        return self.style.px(24 * self.roominess())

    def apply_style(self):
        """Fonts, option database, colours of the Tcl side."""
        root = self.root
        self.style = style = tkstyle.apply(root, self.prefs.getpref("dark_theme", False), fits=False)
        colours = dict(style.colours) | (DARK if style.dark else LIGHT)
        for name, value in colours.items():
            root.tk.setvar(f"::axis::colour({name})", value)
        self.colours = colours
        root.tk.call("font", "configure", "AxisBold", "-size", -self.letters_px())
        touch, pad = self.roominess(), self.padding()
        for pattern, value in (("*Listbox.Font", "TkFixedFont"), ("*troughColor", colours["trough"]), ("*Button.borderWidth", 1),
                               ("*Entry.highlightThickness", 1), ("*Scrollbar.borderWidth", 1), ("*Scrollbar.width", style.px(15 * touch)),
                               ("*Scale.borderWidth", 1), ("*Scale.width", style.px(15 * touch * touch)),
                               ("*Scale.sliderLength", style.px(28 * touch)), ("*Button.padY", pad), ("*Button.padX", style.px(8)),
                               ("*Checkbutton.selectColor", colours["mark"]), ("*Radiobutton.selectColor", colours["mark"]),
                               ("*Checkbutton.padY", pad // 2), ("*Radiobutton.padY", pad // 2), ("*readonlyBackground", colours["field"])):
            root.option_add(pattern, value, "startupFile")
        tkinter.ttk.Style(root).configure("TCombobox", padding=style.px(8 if touch > 1 else 3))

    def restyle(self):
        """After a change of theme, scale or touch: every widget follows."""
        before = self.colours
        self.apply_style()
        mapping = {}
        for name, old in before.items():
            mapping.setdefault(old.lower(), self.colours[name])
        self.recolour(self.root, mapping)
        for book in (".pane.top.tabs", ".pane.top.right"):
            for page in self.root.tk.splitlist(self.root.tk.call(book, "pages")):
                self.root.tk.call(book, "itemconfigure", page, "-background", self.colours["face"], "-foreground", self.colours["ink"],
                                  "-activebackground", self.colours["pressed"], "-activeforeground", self.colours["ink"])
        self.resize_widgets()
        self.icons.restyle(self.icon_px(), self.style.dark)
        self.text_colours()
        self.preview.text_px = self.letters_px()
        self.preview.invalidate()
        self.widget_signs.pop("readout", None)
        self.root.tk.call("update_state")

    def recolour(self, widget, mapping):
        """Changes options whose value is a colour of the old theme; colours that users gave stay."""
        tcl = self.root.tk
        path = str(widget)
        try:
            rows = tcl.splitlist(tcl.call(path, "configure"))
        except tk.TclError:
            rows = ()
        for row in rows:
            row = tcl.splitlist(row)
            if len(row) == 5:
                new = mapping.get(str(row[4]).lower())
                if new is not None and ("ground" in str(row[0]).lower() or "color" in str(row[0]).lower()):
                    try:
                        tcl.call(path, "configure", str(row[0]), new)
                    except tk.TclError:
                        pass        # an option that cannot be changed later
        for child in tcl.splitlist(tcl.call("winfo", "children", path)):
            if str(tcl.call("winfo", "class", child)) != "Togl":
                self.recolour(child, mapping)

    def resize_widgets(self):
        """Room in buttons and sliders."""
        tcl, style = self.root.tk, self.style
        touch, pad = self.roominess(), self.padding()
        sizes = {"Button": (("-pady", pad),), "Checkbutton": (("-pady", pad // 2),), "Radiobutton": (("-pady", pad // 2),),
                 "Scale": (("-width", style.px(15 * touch * touch)), ("-sliderlength", style.px(28 * touch))),
                 "Scrollbar": (("-width", style.px(15 * touch)),)}

        def walk(path):
            for option, value in sizes.get(str(tcl.call("winfo", "class", path)), ()):
                tcl.call(path, "configure", option, value)
            for child in tcl.splitlist(tcl.call("winfo", "children", path)):
                walk(str(child))
        walk(".")

    def text_colours(self):
        t = self.widgets.text
        t.configure(inactiveselectbackground=self.colours["select"])
        t.tag_configure("lineno", foreground=self.colours["number"])
        t.tag_configure("executing", background=self.colours["running"], foreground="#ffffff")
        t.tag_configure("sel", background=self.colours["select"], foreground="#ffffff")
        t.tag_configure("ignored", foreground="#808080")
        for tag in ("executing", "sel"):         # above the numbers
            t.tag_raise(tag)

    # -- what the View menu calls ----------------------------------------------------------

    def set_dark(self, on):
        self.prefs.putpref("dark_theme", bool(on))
        self.restyle()

    def set_touch(self, on):
        self.prefs.putpref("large_touch_targets", bool(on))
        self.restyle()

    def set_scale(self, scale):
        self.prefs.putpref("interface_scale", float(scale), float)
        self.restyle()
