# SPDX-License-Identifier: GPL-2.0-or-later
"""How the Tk programs look: fonts that follow the screen, a light and a dark set of colours.

    root = tk.Tk(className="Halshow")
    style = tkstyle.apply(root)         # once, before the first widget
    style.colours["value"], style.px(8)

Environment: KERF_THEME=light|dark, KERF_TOUCH=0|1 for what is large enough for gloves (else what AXIS remembers),
KERF_SCALE=1 to 3 (else what AXIS remembers, else from the screen).
"""

import configparser
import contextlib
import functools
import os
import signal
import sys
import tkinter as tk
import tkinter.font
import traceback
from dataclasses import dataclass
from pathlib import Path
from tkinter import ttk

from .failures import Recorder
from .tkfit import Fit
from .tree import Tree

LIGHT = {"face": "#eceae6", "ink": "#1c1c1a", "field": "#ffffff", "line": "#b8b4ac", "pressed": "#dcd8d0",
         "select": "#2563a8",
         "faint": "#6a6a66", "off": "#8c8c86", "good": "#18794e", "bad": "#b3261e", "warn": "#ffd75e", "pin": "#1c1c1a",
         "signal": "#1f45c4", "param": "#6e3400", "true": "#ffe000", "false": "#b22222", "on": "#ff5a4d",
         "chart": "#2563a8", "heading": "#dcd8d0"}
DARK = {"face": "#2b2d30", "ink": "#e8e6e3", "field": "#1e1f22", "line": "#55585c", "pressed": "#3d4045",
        "select": "#3d7dc8",
        "faint": "#a5a5a0", "off": "#7c7c78", "good": "#6cc998", "bad": "#ff8a80", "warn": "#6b5600", "pin": "#e8e6e3",
        "signal": "#8fb1ff", "param": "#e0a070", "true": "#ffe000", "false": "#b22222", "on": "#d8382c",
        "chart": "#6ba6e8", "heading": "#3a3d41"}
NORMAL_PX = 13          # height of letters at a scale of 1, pixels
SMALL_SCREEN = 700      # pixels: less high screens have smaller letters
MAX_SCALE = 3.0


@dataclass
class Style:
    """What apply() found: colours by purpose, how many pixels a pixel of a usual screen is, room for gloves (0 to 1).

    scale and touch become less while a window does not fit on the screen (tkfit).
    """
    colours: dict
    dark: bool
    scale: float
    touch: float = 0.0

    def px(self, pixels):
        """A length on this screen, from one on a usual screen."""
        return max(1, round(pixels * self.scale))

    def roomy(self, pixels, more):
        """A length, with so many pixels more where fingers have to hit."""
        return self.px(pixels + more * self.touch)


def remembered(name, kind, default):
    """What AXIS keeps in ~/.axis_preferences; kind: "getboolean" or "getfloat"."""
    values = configparser.RawConfigParser()
    try:
        values.read(Path.home() / ".axis_preferences")
        return getattr(values, kind)("DEFAULT", name, fallback=default)
    except (configparser.Error, ValueError, OSError, RuntimeError):
        return default


def wants_dark():
    theme = os.environ.get("KERF_THEME", "")
    return theme == "dark" if theme else remembered("dark_theme", "getboolean", False)


def wants_touch():
    given = os.environ.get("KERF_TOUCH", "")
    return given != "0" if given else remembered("large_touch_targets", "getboolean", False)


def desktop_dpi():
    """What a desktop wants letters to be drawn for (X resource Xft.dpi: dots per inch); 0 where none said it."""
    try:
        reader = tk.Tk(baseName="Xft", className="Xft")         # resources are found by the name of a program
        reader.withdraw()
        found = reader.option_get("dpi", "Dpi")
        reader.destroy()
        return float(found or 0)
    except (tk.TclError, ValueError):
        return 0.0


def screen_scale(root):
    """1 on a usual screen; more where pixels are small: by its resolution, by its size in
    pixels, or as the desktop is set."""
    try:
        given = float(os.environ.get("KERF_SCALE") or remembered("interface_scale", "getfloat", 0.0))
    except ValueError:
        given = 0.0
    if given > 0:
        return min(max(given, 1.0), MAX_SCALE)
    by_density = getattr(root, "kerf_density", root.winfo_fpixels("1i") / 96)
    by_height = root.winfo_screenheight() / 1080 if root.winfo_screenheight() > 1200 else 1.0
    return min(max(by_density, by_height, desktop_dpi() / 96, 1.0), MAX_SCALE)


def style_of(widget):
    """What apply() found for the widget's program; without it a usual screen."""
    return getattr(widget._root(), "kerf_style", None) or Style(LIGHT, False, 1.0)


def follow(widget, resize):
    """resize() now and whenever the scale changes, as long as the widget is there."""
    root = widget._root()
    root.kerf_followers = [(w, action)
                           for w, action in getattr(root, "kerf_followers", ())
                           if w.winfo_exists()] + [(widget, resize)]
    resize()


def _tell_scale(root, style):
    """Lengths in points and millimetres, and drawings, have the scale, too."""
    if not hasattr(root, "kerf_density"):
        root.kerf_density = root.winfo_fpixels("1i") / 96
    root.tk.call("tk", "scaling", (style.scale if style.scale > 1 else min(root.kerf_density, 1.0)) * 96 / 72)
    for widget, resize in getattr(root, "kerf_followers", ()):
        if widget.winfo_exists():
            resize()


def apply(root, dark=None, fits=True, most=MAX_SCALE):
    """Sets fonts, colours and sizes of all widgets of this program; returns the Style. fits: windows get the room they
    need. most: scale."""
    dark = wants_dark() if dark is None else dark
    style = Style(DARK if dark else LIGHT, dark, min(screen_scale(root), most), float(fits and wants_touch()))

    def restyle():
        letters = style.px(NORMAL_PX if root.winfo_screenheight() >= SMALL_SCREEN else NORMAL_PX - 1)
        for name in ("TkDefaultFont", "TkTextFont", "TkMenuFont", "TkHeadingFont", "TkCaptionFont", "TkTooltipFont"):
            tkinter.font.nametofont(name, root).configure(family="DejaVu Sans", size=-letters, weight="normal")
        tkinter.font.nametofont("TkFixedFont", root).configure(family="DejaVu Sans Mono", size=-letters)
        _options(root, style.colours, style)
        _themed(ttk.Style(root), style.colours, style, letters)
        _tell_scale(root, style)
    root.kerf_style = style
    restyle()
    root.configure(background=style.colours["face"])
    if fits:
        Fit(root, style, restyle, pressed_pads)
    return style


def pressed_pads(style):
    """padY of what is pressed and is not themed (panels), by class."""
    flat = style.roomy(1, 6)
    return {"Button": style.roomy(4, 7), "Menubutton": style.roomy(4, 7), "Checkbutton": flat, "Radiobutton": flat}


def _options(root, colours, style):
    """Widgets that are not themed: text, lists, menus, canvases."""
    for kind, pad in pressed_pads(style).items():
        root.option_add(f"*{kind}.padY", pad, "startupFile")
    for pattern, value in (("*Font", "TkDefaultFont"), ("*Text.Font", "TkFixedFont"), ("*background", colours["face"]),
                           ("*foreground", colours["ink"]), ("*activeBackground", colours["pressed"]),
                           ("*activeForeground", colours["ink"]), ("*disabledForeground", colours["off"]),
                           ("*highlightThickness", 0), ("*highlightColor", colours["select"]),
                           ("*highlightBackground", colours["face"]), ("*disabledBackground", colours["face"]),
                           ("*readonlyBackground", colours["face"]), ("*Entry.background", colours["field"]),
                           ("*Text.background", colours["field"]), ("*Listbox.background", colours["field"]),
                           ("*Canvas.background", colours["field"]), ("*selectBackground", colours["select"]),
                           ("*selectForeground", "#ffffff"), ("*insertBackground", colours["ink"]),
                           ("*Checkbutton.selectColor", colours["field"]),
                           ("*Radiobutton.selectColor", colours["field"]), ("*Spinbox.background", colours["field"]),
                           ("*Spinbox.buttonBackground", colours["face"]), ("*Scale.troughColor", colours["pressed"]),
                           ("*Scale.width", style.roomy(15, 15)), ("*Scale.sliderLength", style.roomy(30, 15)),
                           ("*Scale.length", style.px(100)), ("*Menu.borderWidth", 1),
                           ("*Menu.selectColor", colours["ink"]), ("*Menu.activeBorderWidth", style.roomy(2, 5)),
                           # Tk's file dialogs have white lists in every theme.
                           ("*TkFDialog*Canvas.foreground", "black"), ("*TkChooseDir*Canvas.foreground", "black"),
                           ("*TCombobox*Listbox.font", "TkDefaultFont")):
        root.option_add(pattern, value, "startupFile")


def _themed(theme, colours, style, letters):
    theme.theme_use("clam")
    line, face = colours["line"], colours["face"]
    theme.configure(".", background=face, foreground=colours["ink"], fieldbackground=colours["field"], bordercolor=line,
                    lightcolor=face, darkcolor=face, troughcolor=colours["pressed"], selectbackground=colours["select"],
                    selectforeground="#ffffff",
                    insertcolor=colours["ink"], focuscolor=colours["select"], font="TkDefaultFont")
    theme.map(".", foreground=[("disabled", colours["off"])])
    theme.configure("TButton", padding=(style.px(10), style.roomy(4, 7)), anchor="center")
    theme.configure("Toolbutton", padding=(style.px(5), style.roomy(2, 8)))
    theme.map("TButton", background=[("disabled", face), ("pressed", line), ("active", colours["pressed"])])
    theme.configure("Small.TButton", padding=(style.roomy(4, 4), style.roomy(1, 9)), width=-4)
    for name in ("TCheckbutton", "TRadiobutton"):
        theme.configure(name, indicatorsize=style.roomy(14, 8), padding=style.roomy(2, 6),
                        indicatorbackground=colours["field"], indicatorforeground=colours["ink"])
        theme.map(name, background=[("active", face)],
                  indicatorbackground=[("pressed", colours["pressed"]), ("!disabled", colours["field"])])
    theme.configure("TMenubutton", arrowsize=style.px(5), padding=(style.px(6), style.roomy(4, 7)))
    for name in ("Horizontal.TScale", "Vertical.TScale"):
        theme.configure(name, sliderlength=style.roomy(30, 15), arrowsize=style.roomy(14, 22), background=line,
                        lightcolor=line, darkcolor=line)
        theme.map(name, background=[("disabled", face), ("active", colours["select"])])
    theme.configure("TEntry", padding=(style.px(3), style.roomy(3, 7)))
    theme.map("TEntry", fieldbackground=[("disabled", face), ("readonly", face)])
    theme.configure("TCombobox", padding=(style.px(3), style.roomy(3, 7)), arrowsize=style.roomy(14, 10))
    theme.map("TCombobox", fieldbackground=[("readonly", colours["field"])], foreground=[("readonly", colours["ink"])],
              selectbackground=[("readonly", colours["field"])], selectforeground=[("readonly", colours["ink"])])
    for name in ("Vertical.TScrollbar", "Horizontal.TScrollbar"):
        theme.configure(name, arrowsize=style.roomy(14, 10), background=line, lightcolor=line, darkcolor=line,
                        arrowcolor=colours["ink"], gripcount=0)
        theme.map(name, **{part: [("disabled", face), ("active", colours["off"])]
                           for part in ("background", "lightcolor", "darkcolor")})
    theme.configure("Treeview", rowheight=round(letters * (1.65 + style.touch)), background=colours["field"],
                    foreground=colours["ink"], fieldbackground=colours["field"], indent=style.px(18), borderwidth=1)
    theme.map("Treeview", background=[("selected", colours["select"])], foreground=[("selected", "#ffffff")])
    theme.configure("Treeview.Heading", background=colours["heading"], padding=style.roomy(3, 6))
    theme.map("Treeview.Heading", background=[("active", colours["pressed"])])
    theme.configure("Treeview.Item", indicatorsize=style.roomy(12, 8))
    theme.configure("TNotebook", tabmargins=(style.px(2), style.px(4), style.px(2), 0))
    theme.configure("TNotebook.Tab", padding=(style.px(10), style.roomy(4, 7)), background=colours["pressed"])
    theme.map("TNotebook.Tab", background=[("selected", face)],
              padding=[("selected", (style.px(10), style.roomy(6, 7)))])
    theme.configure("TLabelframe", bordercolor=line)
    theme.configure("Value.TLabel", font="TkFixedFont")
    theme.configure("Faint.TLabel", foreground=colours["faint"])
    theme.configure("Bad.TLabel", foreground=colours["bad"])
    theme.configure("Horizontal.TPanedwindow", background=face)
    theme.configure("Sash", sashthickness=style.roomy(6, 8), gripcount=style.px(10))


def centre(window, width, height, minimum=None):
    """Places a window in the middle of the screen: pixels, at most what the screen has."""
    width, height = map(max, (width, height), getattr(window, "before_giving_way", (0, 0)))
    width, height = min(width, window.winfo_screenwidth()), min(height, window.winfo_screenheight() - 40)
    x, y = (window.winfo_screenwidth() - width) // 2, max(0, (window.winfo_screenheight() - height) // 2 - 20)
    window.geometry(f"{width}x{height}+{x}+{y}")
    if minimum:
        window.minsize(min(minimum[0], width), min(minimum[1], height))


def need_letters(root):
    """Raises TclError, which says what to do, where Tk finds no font at all."""
    try:
        tk.Label(root, text="x").destroy()
    except tk.TclError as error:
        raise tk.TclError("no font is installed: install one, for example the package fonts-dejavu-core") from error


def open_display(program, class_name):
    """The root window. Without a display: says so on standard error, exit status 1."""
    if not os.environ.get("DISPLAY"):
        sys.exit(f"{program}: no display (DISPLAY is not set)")
    try:
        root = tk.Tk(className=class_name)
        need_letters(root)
    except tk.TclError as error:
        sys.exit(f"{program}: {error}")

    recorder = Recorder(program, os.environ.get("INI_FILE_NAME", ""), Tree.find().version())
    for event in ("<KeyPress>", "<ButtonPress>"):
        root.bind_all(event, lambda e: recorder.note(e.type.name, e.keysym if e.keysym != "??" else e.num, e.widget),
                      "+")

    def trouble(kind, value, place):
        """Errors are told and the program goes on. What was under way when an interrupt ended the window misses it."""
        if kind is KeyboardInterrupt:
            root.at_interrupt()
        if root.interrupted or kind is KeyboardInterrupt:
            return
        text = "".join(traceback.format_exception(kind, value, place))
        print(f"{text}{program}: report: {recorder.write(text)}", file=sys.stderr)
    root.report_callback_exception = trouble
    root.at_interrupt = root.destroy
    hear_signals(root)
    return root


def hear_signals(root):
    """Interrupts (halcmd unload, Control-C, a closed terminal) call at_interrupt() at once, also while a message box
    waits. Tk knows nothing of Python's signals: a pipe wakes it."""
    root.interrupted = False

    def end():
        root.at_interrupt()

    def interrupted(*_signal):
        if not root.interrupted:
            root.interrupted = True
            with contextlib.suppress(tk.TclError):
                root.after(0, end)
                return
        raise KeyboardInterrupt         # the window is gone, or something takes long

    def drain(heard, _mask):
        with contextlib.suppress(BlockingIOError):
            os.read(heard, 4096)
    if signal.getsignal(signal.SIGHUP) is signal.SIG_DFL:       # nohup ignores it
        signal.signal(signal.SIGHUP, signal.default_int_handler)
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) is signal.default_int_handler:
            signal.signal(number, interrupted)
    heard = wake_up_pipe()
    root.createfilehandler(heard, tk.READABLE, drain)


@functools.cache
def wake_up_pipe():
    """Becomes readable with each signal that Python handles."""
    heard, wake = os.pipe2(os.O_NONBLOCK | os.O_CLOEXEC)
    signal.set_wakeup_fd(wake, warn_on_full_buffer=False)
    return heard


def run(root, close):
    """The main loop of a window that has something to keep: close() ends it without questions, also at an interrupt."""
    root.at_interrupt = close
    try:
        root.mainloop()
    except KeyboardInterrupt:
        close()
