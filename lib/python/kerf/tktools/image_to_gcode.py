# SPDX-License-Identifier: GPL-2.0-or-later
"""image-to-gcode [FILE]: a program that cuts a grey picture as a relief, on standard output.

A filter for screens ([FILTER]png = image-to-gcode). The window asks for size, tool and pattern and remembers
them in ~/.image2gcoderc; without a display the remembered ones are taken.
"""

import dataclasses
import io
import os
import pickle
import sys
import tkinter as tk
from pathlib import Path
from tkinter import filedialog, ttk

import numpy
from PIL import Image

from .. import files, relief, tkstyle
from ..language import _

PROGRAM = "image-to-gcode"
REMEMBERED = Path("~/.image2gcoderc")
LABELS = {
    "units": _("Units"), "invert": _("Invert image"), "normalize": _("Normalize image"),
    "expand": _("Extend image border"), "tolerance": _("Tolerance"), "pixel_size": _("Pixel size"),
    "feed_rate": _("Feed rate"), "plunge_feed_rate": _("Plunge feed rate"), "spindle_speed": _("Spindle speed"),
    "pattern": _("Scan pattern"), "converter": _("Scan direction"),
    "depth": _("Depth"), "pixelstep": _("Step over (pixels)"), "tool_diameter": _("Tool diameter"),
    "safety_height": _("Safety height"), "tool_type": _("Tool type"),
    "bounded": _("Lace bounding"), "contact_angle": _("Contact angle"), "roughing_offset": _("Roughing offset"),
    "roughing_depth": _("Roughing depth a pass")}
LARGEST = 220  # px of the picture in the window


class _Plain(pickle.Unpickler):
    """The file holds numbers; anything else in it is refused."""

    def find_class(self, module, name):
        raise pickle.UnpicklingError(f"{module}.{name}")


def remembered():
    """Settings of the last time; the defaults where there are none."""
    settings = relief.Settings()
    try:
        with open(REMEMBERED.expanduser(), "rb") as f:
            values = _Plain(f).load()
    except FileNotFoundError:
        return settings
    except (OSError, pickle.UnpicklingError, EOFError, ValueError, AttributeError, IndexError, KeyError, ImportError,
            TypeError, OverflowError, MemoryError) as error:
        print(f"{PROGRAM}: {REMEMBERED.expanduser()} is not used: {error}", file=sys.stderr)
        return settings
    if isinstance(values, dict):
        for field in dataclasses.fields(settings):
            try:
                setattr(settings, field.name, type(field.default)(values[field.name]))
            except (KeyError, TypeError, ValueError):
                pass
    return settings


def remember(settings):
    try:
        files.replace(REMEMBERED.expanduser(), pickle.dumps(dataclasses.asdict(settings), protocol=2))
    except OSError as error:
        print(f"{PROGRAM}: {error}", file=sys.stderr)


def grey_of(image):
    """Values from 0 to 1; pictures with 16 bits keep them."""
    if image.mode.startswith("I"):
        data = numpy.asarray(image, dtype=float)
        return data / (65535.0 if data.max() > 255 else 255.0)
    if image.mode == "F":
        return numpy.clip(numpy.asarray(image, dtype=float), 0, 1)
    return numpy.asarray(image.convert("L"), dtype=float) / 255.0


def report(percent, last=[-1]):
    """FILTER_PROGRESS for the screen that runs the filter."""
    if os.environ.get("AXIS_PROGRESS_BAR") and int(percent) != last[0]:
        last[0] = int(percent)
        print(f"FILTER_PROGRESS={last[0]}", file=sys.stderr, flush=True)


class Window:
    """Asks for the settings; `settings` is None after Cancel."""

    def __init__(self, root, image, name, settings):
        self.root, self.start, self.settings = root, settings, None
        style = tkstyle.apply(root)
        root.title(_("Image to gcode: %s") % name)
        box = ttk.Frame(root, padding=style.px(8))
        box.pack(fill="both", expand=True)
        small = image.convert("L")
        small.thumbnail((style.px(LARGEST), style.px(LARGEST)))
        data = io.BytesIO()
        small.save(data, "PNG")
        self.picture = tk.PhotoImage(data=data.getvalue(), master=root)
        side = ttk.Frame(box)
        side.grid(row=0, column=0, sticky="n", padx=(0, style.px(10)))
        ttk.Label(side, image=self.picture).pack()
        self.size = ttk.Label(side, style="Faint.TLabel")
        self.size.pack(anchor="w", pady=(style.px(4), 0))
        form = ttk.Frame(box)
        form.grid(row=0, column=1, sticky="n")
        self.pixels, self.fields = image.size, {}
        columns = 2
        names = list(LABELS)
        per_column = (len(names) + columns - 1) // columns
        for n, field in enumerate(names):
            row, column = n % per_column, n // per_column * 2
            ttk.Label(form, text=LABELS[field]).grid(row=row, column=column, sticky="w",
                                                     padx=(style.px(8) if column else 0, style.px(6)), pady=style.px(1))
            self.field(form, field).grid(row=row, column=column + 1, sticky="ew", pady=style.px(1))
        self.told = ttk.Label(box, style="Bad.TLabel")
        self.told.grid(row=1, column=0, columnspan=2, sticky="w", pady=(style.px(6), 0))
        buttons = ttk.Frame(box)
        buttons.grid(row=2, column=0, columnspan=2, sticky="e", pady=(style.px(6), 0))
        self.ok = ttk.Button(buttons, text="OK", command=self.accept)
        self.cancel = ttk.Button(buttons, text=_("Cancel"), command=root.destroy)
        self.ok.pack(side="left", padx=style.px(4))
        self.cancel.pack(side="left")
        root.bind("<Return>", lambda _event: self.accept())
        root.bind("<Escape>", lambda _event: root.destroy())
        self.show_size()

    def field(self, parent, name):
        value = getattr(self.start, name)
        if name in relief.CHOICES:
            variable = tk.StringVar(self.root, _(relief.CHOICES[name][value]))
            choices = [_(choice) for choice in relief.CHOICES[name]]
            widget = ttk.Combobox(parent, textvariable=variable, values=choices, state="readonly",
                                  width=max(18, *map(len, choices)))
        elif isinstance(value, bool):
            variable = tk.BooleanVar(self.root, value)
            widget = ttk.Checkbutton(parent, variable=variable)
        else:
            variable = tk.StringVar(self.root, f"{value:g}")
            widget = ttk.Entry(parent, textvariable=variable, width=12)
        variable.trace_add("write", lambda *_: self.show_size())
        self.fields[name] = variable
        return widget

    def read(self):
        """The settings as they stand in the form. Raises Mistake."""
        settings = relief.Settings()
        for name, variable in self.fields.items():
            text = variable.get()
            if name in relief.CHOICES:
                value = [_(c) for c in relief.CHOICES[name]].index(text)
            elif isinstance(getattr(settings, name), bool):
                value = bool(text)
            else:
                try:
                    value = type(getattr(settings, name))(text)
                except ValueError:
                    raise relief.Mistake((_("%s: %r is no whole number") if name == "pixelstep"
                                          else _("%s: %r is no number")) % (LABELS[name], text)) from None
            setattr(settings, name, value)
        settings.check()
        return settings

    def show_size(self):
        if len(self.fields) < len(LABELS):
            return
        try:
            settings = self.read()
        except relief.Mistake as mistake:
            self.told.configure(text=str(mistake))
            return
        self.told.configure(text="")
        unit = ("in", "mm")[settings.units]
        wide, high = (n * settings.pixel_size for n in self.pixels)
        self.size.configure(text=_("%d x %d pixels: %.4g x %.4g %s") % (*self.pixels, wide, high, unit))

    def accept(self):
        try:
            self.settings = self.read()
        except relief.Mistake as mistake:
            self.told.configure(text=str(mistake))
            return
        self.root.destroy()


def ask(name, image):
    """Settings from the window, or the remembered ones where there is no display."""
    if not os.environ.get("DISPLAY"):
        print(f"{PROGRAM}: no display: the settings of {REMEMBERED} are taken", file=sys.stderr)
        return remembered()
    root = tkstyle.open_display(PROGRAM, "ImageToGcode")
    window = Window(root, image, os.path.basename(name), remembered())
    root.mainloop()
    if window.settings is None:
        sys.exit(f"{PROGRAM}: User pressed cancel")
    remember(window.settings)
    return window.settings


def main(arguments):
    if len(arguments) > 1 or arguments[:1] in (["-h"], ["--help"]):
        print(__doc__, file=sys.stderr)
        return 0 if len(arguments) == 1 else 2
    if arguments:
        name = arguments[0]
    else:
        root = tkstyle.open_display(PROGRAM, "ImageToGcode")
        root.withdraw()
        name = filedialog.askopenfilename(parent=root, title=_("Open image"),
                                          filetypes=[(_("Images"), "*.png *.gif *.jpg *.jpeg *.tif *.tiff *.bmp"),
                                                     (_("All files"), "*")])
        root.destroy()
        if not name:
            sys.exit(f"{PROGRAM}: User pressed cancel")
    try:
        image = Image.open(name)
        grey = grey_of(image)
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError) as error:
        sys.exit(f"{PROGRAM}: {name}: {error}")
    try:
        relief.convert(grey, ask(name, image), print, report)
        sys.stdout.flush()
    except relief.Mistake as mistake:
        sys.exit(f"{PROGRAM}: {mistake}")
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    return 0
