# SPDX-License-Identifier: GPL-2.0-or-later
"""Defaults of the Tk option database for programs that show previews."""
import os
import tkinter

DEFAULTS = (
    ("*Menu.tearOff", "0"), ("*Label.padX", "0"), ("*Label.padY", "0"), ("*Entry.background", "#fff"),
    ("*Text.background", "#fff"), ("*Scale.highlightThickness", "0"), ("*Button.highlightThickness", "0"),
    ("*Togl.background", "#000"), ("*Togl.tool_ambient", "#666666"), ("*Togl.tool_light_x", "1"),
    ("*Togl.tool_light_y", "-1"), ("*Togl.tool_light_z", "1"),
)


def install(root):
    """Loads fonts, colours and Togl.* below the user's own settings; then ~/.axisrc-like options of
    the X resources file named by KERF_TK_OPTIONS, if there is one."""
    from axis.compose import ALPHA, COLOURS
    own_colours = [(f"*Togl.{name}", value) for name, value in (COLOURS | ALPHA).items()]
    for pattern, value in (*DEFAULTS, *own_colours):
        root.option_add(pattern, value, "widgetDefault")
    own = os.environ.get("KERF_TK_OPTIONS")
    if own:
        try:
            root.option_readfile(own, "userDefault")
        except tkinter.TclError as e:
            print(f"{own}: {e}")
