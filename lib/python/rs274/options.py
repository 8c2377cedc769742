# SPDX-License-Identifier: GPL-2.0-or-later
"""Defaults of the Tk option database for programs that show previews."""
import os
import tkinter

DEFAULTS = (
    ("*Menu.tearOff", "0"), ("*Label.padX", "0"), ("*Label.padY", "0"), ("*Entry.background", "#fff"), ("*Text.background", "#fff"),
    ("*Scale.highlightThickness", "0"), ("*Button.highlightThickness", "0"), ("*Togl.background", "#000"),
)


def install(root):
    """Loads fonts, colours and Togl.* below the user's own settings; then ~/.axisrc-like options of
    the X resources file named by KERF_TK_OPTIONS, if there is one."""
    for pattern, value in DEFAULTS:
        root.option_add(pattern, value, "widgetDefault")
    own = os.environ.get("KERF_TK_OPTIONS")
    if own:
        try:
            root.option_readfile(own, "userDefault")
        except tkinter.TclError as e:
            print(f"{own}: {e}")
