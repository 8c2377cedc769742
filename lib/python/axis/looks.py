# SPDX-License-Identifier: GPL-2.0-or-later
"""How the screen looks: colours, sizes, room for fingers. All of it changes while the screen runs."""

import math
import tkinter as tk
import tkinter.ttk

from kerf import tkfit, tkstyle
from kerf.tkscroll import Scrolling

from . import dialogs
from .icons import Icons
from .notify import WRAP_PX

# What AXIS has beside the colours of all Tk programs.
LIGHT = {"dro_back": "#101418", "dro": "#e8f0f6", "running": "#804040", "number": "#70767f", "chosen": "#b9d3ee",
         "trough": "#c9c5bd", "mark": "#fffffe"}
DARK = {"dro_back": "#0d1013", "dro": "#e8f0f7", "running": "#904848", "number": "#8a919c", "chosen": "#34496a",
        "trough": "#44474c", "mark": "#1e1f23"}
TOUCH = 1.7                     # buttons and sliders for gloves, where the screen has room for them
USUAL_WINDOW, SASH = (1280, 860), 10
PUT_SASH = ".pane sash place 0"
LEAST_PANEL = 150, 64           # of a panel that scrolls
PANEL_COST = 0.75               # smaller letters than that, of what they were without, are worse than a panel that scrolls
CODE_LINES = 6                   # of the program in sight on a low screen, if there is room
HELP_LETTERS = 36                # of a line of the quick reference
TOUCH_STEP, LEAST_TOUCH = 0.05, 1.1
SCALES = (0.0, 1.0, 1.25, 1.5, 1.75, 2.0)      # 0: from the screen


class LooksPart:
    """Part of App: the look of the window."""

    def first_look(self):
        """Before the widgets are made."""
        root = self.root
        self.full_size()
        root.tk.eval("namespace eval ::axis {}")
        root.tk.call("font", "create", "AxisBold", "-family", "DejaVu Sans", "-size", -13, "-weight", "bold")
        self.apply_style()
        self.icons = Icons(root, self.icon_px(), self.style.dark)
        self.layout()

    def layout(self):
        """What a low screen has beside each other, or less of."""
        low = self.low() or (self.touch() and self.root.winfo_screenheight() < 800 * self.style.scale)
        for name, value in (("code_lines", 3 if self.low() else 4 if low else 9),
                            ("gap", 2 if low else self.style.px(8)), ("spindle_side", "left" if low else "top")):
            self.root.tk.setvar(f"::axis::{name}", value)

    def touch(self):
        return self.prefs.getpref("large_touch_targets", False)

    def low(self):
        """True for a screen that is low for what it has to show."""
        return self.root.winfo_screenheight() < tkstyle.SMALL_SCREEN * self.style.scale

    def roominess(self):
        """How much larger than usual buttons and sliders are."""
        return min(TOUCH, self.most_touch) if self.touch() else 1.0

    def padding(self):
        return self.style.px(2 + 7 * (self.roominess() - 1) / (TOUCH - 1))

    def letters_px(self):
        return -int(self.root.tk.call("font", "configure", "TkDefaultFont", "-size"))     # tkstyle gives pixels

    def icon_px(self):
        return self.style.px(24 * self.roominess())

    def apply_style(self):
        """Fonts, option database, colours of the Tcl side."""
        root = self.root
        self.style = style = tkstyle.apply(root, self.prefs.getpref("dark_theme", False), fits=False,
                                           most=self.most_scale)
        colours = dict(style.colours) | (DARK if style.dark else LIGHT)
        for name, value in colours.items():
            root.tk.setvar(f"::axis::colour({name})", value)
        self.colours = colours
        root.tk.call("font", "configure", "AxisBold", "-size", -self.letters_px())
        touch, pad = self.roominess(), self.padding()
        for pattern, value in (("*Listbox.Font", "TkFixedFont"), ("*troughColor", colours["trough"]),
                               ("*Button.borderWidth", 1), ("*Entry.highlightThickness", 1),
                               ("*Scrollbar.borderWidth", 1), ("*Scrollbar.width", style.px(15 * touch)),
                               ("*Scale.borderWidth", 1), ("*Scale.width", style.px(15 * touch * touch)),
                               ("*Scale.sliderLength", style.px(28 * touch)), ("*Button.padY", pad),
                               ("*Button.padX", style.px(8)), ("*Checkbutton.selectColor", colours["mark"]),
                               ("*Radiobutton.selectColor", colours["mark"]), ("*Checkbutton.padY", pad * 2 // 3),
                               ("*Radiobutton.padY", pad * 2 // 3), ("*readonlyBackground", colours["field"])):
            root.option_add(pattern, value, "startupFile")
        theme = tkinter.ttk.Style(root)
        theme.configure("TCombobox", padding=style.px(8 if touch > 1 else 3))
        for name in ("Vertical.TScrollbar", "Horizontal.TScrollbar"):
            theme.configure(name, arrowsize=style.px(14 * touch))

    def asked(self):
        """The size with room for everything. Panes are asked one by one: together they ask for what they have."""
        call = self.root.tk.call
        Scrolling.of(self.root).settle()
        call("::axis::arrange")
        self.root.update_idletasks()
        call(".pane", "configure", "-height",
             sum(int(call("winfo", "reqheight", pane)) for pane in (".pane.top", ".pane.bottom")) + SASH)
        self.root.update_idletasks()
        return max(self.root.winfo_reqwidth(), *(int(call("winfo", "reqwidth", pane))
                                                 for pane in (".pane.top", ".pane.bottom"))), self.root.winfo_reqheight()

    def fit_screen(self):
        """Letters, then what is large for touch, become smaller until the window has its room on the screen. Panels
        for which that is not enough, or costs too much, scroll: letters are as large as the rest of the window allows.
        """
        root, views, wanted = self.root, [view for view in self.views if view.winfo_exists()], self.style.scale
        fits = self.shrink_to_fit(views, (math.inf, math.inf), not views)
        low = math.inf, LEAST_PANEL[1]
        if views and not (fits and self.style.scale >= PANEL_COST * self.scale_with(views, low, wanted)):
            for most in (low, LEAST_PANEL):
                scale = self.scale_with(views, most, wanted)
                if scale < 1 and most is low:
                    continue
                self.full_size()
                self.most_scale = max(scale, 1.0)
                self.restyle()
                if self.shrink_to_fit(views, most, most is LEAST_PANEL):
                    break
        room = tkfit.room_of(root)
        for view in views:
            tkfit.give_room(view, self.asked, room, tuple(map(self.style.px, LEAST_PANEL)))
        self.more_code(room[1] - self.asked()[1])
        asked = self.asked()
        root.minsize(*map(min, asked, room))
        if root.winfo_ismapped():
            tkfit.enlarge(root, asked)
        else:
            root.geometry("{}x{}".format(*map(min, map(max, asked, self.usual_size()), room)))
        root.tk.call("::axis::break_menus")
        for label in self.widgets.help_window.winfo_children():
            label.configure(wraplength=dialogs.letters(root, HELP_LETTERS))

    def usual_size(self):
        return tuple(map(self.style.px, USUAL_WINDOW))

    def places(self):
        """What a user's file may choose about the window: the command that sets it, and the words of the value."""
        tcl, found = self.root.tk, {}
        tcl.call("update", "idletasks")
        for ask, put in (("wm minsize .", "wm minsize ."), ("wm geometry .", "wm geometry ."),
                         (".pane.bottom.t.text cget -height", ".pane.bottom.t.text configure -height"),
                         (".pane sash coord 0", PUT_SASH)):
            if put != PUT_SASH or len(tcl.call(".pane", "panes")) > 1:
                found[put] = tcl.eval(ask)
        return found

    def put(self, chosen):
        """The last word about these places."""
        for command, value in chosen.items():
            self.root.tk.eval(f"{command} {value}")
        if PUT_SASH in chosen and not self.root.winfo_ismapped():      # the panes take their sizes when they are seen
            again = f"{PUT_SASH} {chosen[PUT_SASH]}"
            self.root.tk.eval(f"bind .pane <Map> {{bind .pane <Map> {{}}; after idle {{after idle {{{again}}}}}}}")

    def limit(self, views, most):
        """What each view asks for at most, in the pixels of a usual screen."""
        for view in views:
            view.limit(*(pixels * self.style.scale for pixels in most))

    def scale_with(self, views, most, wanted):
        """About the scale that the window would have with views that ask for so much."""
        self.limit(views, most)
        return min(wanted, self.style.scale * tkfit.share_of(self.root, self.asked()))

    def full_size(self):
        self.most_scale, self.most_touch = tkstyle.MAX_SCALE, TOUCH      # less where the screen has no room for more

    def shrink_to_fit(self, views, most, hopeless_too):
        """Whether the window has room now. hopeless_too: letters become smaller even if that cannot be enough."""
        for _ in range(2 * tkfit.STEPS):
            self.limit(views, most)
            share = tkfit.share_of(self.root, self.asked())
            if share >= 1:
                return True
            if not hopeless_too and share * self.style.scale * self.roominess() ** 2 < 1:
                return False
            if self.style.scale > 1:
                self.most_scale = max(1.0, self.style.scale * tkfit.step_for(share))
            elif self.roominess() > LEAST_TOUCH:
                self.most_touch = self.roominess() - TOUCH_STEP
            else:
                return False
            self.restyle()
        return False

    def more_code(self, spare):
        """Lines of the program that a low screen has room for, out of so many pixels."""
        line = int(self.root.tk.call("font", "metrics", "TkFixedFont", "-linespace"))
        lines = int(self.root.tk.getvar("::axis::code_lines"))
        self.root.tk.setvar("::axis::code_lines", max(lines, min(CODE_LINES, lines + spare // line)))
        self.root.tk.call("::axis::arrange")

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
                self.root.tk.call(book, "itemconfigure", page, "-background", self.colours["face"], "-foreground",
                                  self.colours["ink"], "-activebackground", self.colours["pressed"],
                                  "-activeforeground", self.colours["ink"])
            font = self.root.tk.call(book, "cget", "-font")
            for name in ("TkCaptionFont", font):         # another one and back: the tabs are measured anew
                self.root.tk.call(book, "configure", "-font", name)
        self.layout()
        self.resize_widgets()
        self.icons.restyle(self.icon_px(), self.style.dark)
        self.root.tk.call("::axis::renew_dots")
        tkfit.fields_anew(self.root)
        self.text_colours()
        self.notifications.wrap, self.notifications.pad = self.style.px(WRAP_PX), self.padding() - self.style.px(2)
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
        sizes = {"Button": (("-pady", pad),), "Checkbutton": (("-pady", pad * 2 // 3),),
                 "Radiobutton": (("-pady", pad * 2 // 3),),
                 "Scale": (("-width", style.px(15 * touch * touch)), ("-sliderlength", style.px(28 * touch))),
                 "Scrollbar": (("-width", style.px(15 * touch)),)}

        def walk(path):
            for option, value in sizes.get(str(tcl.call("winfo", "class", path)), ()):
                tcl.call(path, "configure", option, value)
            for child in tcl.splitlist(tcl.call("winfo", "children", path)):
                walk(str(child))
        walk(".")
        tcl.call("grid", "configure", ".pane.top.tabs.fmdi.command", "-ipady", pad)
        tcl.call("::axis::arrange")

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

    def change(self, name, value, kind=bool):
        """A preference of the look: the window as if it had started so."""
        self.prefs.putpref(name, kind(value), kind)
        self.full_size()
        self.restyle()
        self.fit_screen()

    def set_dark(self, on):
        self.change("dark_theme", on)

    def set_touch(self, on):
        self.change("large_touch_targets", on)

    def set_scale(self, scale):
        self.change("interface_scale", scale, float)
        tkfit.enlarge(self.root, self.usual_size())      # as if it had started so: lines of the program have their room
