# SPDX-License-Identifier: GPL-2.0-or-later
"""The widgets of PyVCP panels.

Every element is made by ELEMENTS[name](master, panel, **options); options that it does not know go to the Tk widget.
Widgets have follow(), called each 0.1 s, when they show or take pins, and tint() when their colours follow the ground.
"""

from .base import Directive, Panel, keep_readable
from .buttons import Button, Checkbutton, Multilabel, Label, Radiobutton
from .controls import Dial, Jogwheel, Scale, Spinbox
from .layout import (Axisoptions, Boxanchor, Boxexpand, Boxfill, Hbox, Image, Include, Labelframe, Option,
                     Table, Tablerow, Tablespan, Tablesticky, Tabs, Title, Vbox)
from .shown import Bar, ImageBit, ImageU32, Led, Meter, Number, Rectled, S32, Timer, U32

ELEMENTS = {
    "led": Led, "rectled": Rectled, "button": Button, "checkbutton": Checkbutton, "radiobutton": Radiobutton,
    "label": Label, "multilabel": Multilabel, "number": Number, "u32": U32, "s32": S32, "timer": Timer, "bar": Bar,
    "meter": Meter, "spinbox": Spinbox, "scale": Scale, "dial": Dial, "jogwheel": Jogwheel, "image_bit": ImageBit,
    "image_u32": ImageU32, "vbox": Vbox, "hbox": Hbox, "labelframe": Labelframe, "table": Table, "tablerow": Tablerow,
    "tablespan": Tablespan, "tablesticky": Tablesticky, "tabs": Tabs, "boxfill": Boxfill, "boxanchor": Boxanchor,
    "boxexpand": Boxexpand, "include": Include, "title": Title, "axisoptions": Axisoptions, "option": Option,
    "image": Image, }
__all__ = ["Directive", "ELEMENTS", "Panel", "keep_readable"]
