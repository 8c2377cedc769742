# SPDX-License-Identifier: GPL-2.0-or-later
"""Texts of the help windows. User code may change help1 and help2 before the window is shown."""

from kerf.language import N_

ABOUT = """AXIS %s

The operator's screen of a realtime machine controller.
Licence: GNU General Public License, version 2 or later."""

SHIFT = N_("Shift with these")       # the only name of keys that is a text
help1 = [
    ("F1", "Emergency stop"), ("F2", "Turn machine on or off"), ("F3", "Manual control"), ("F5", "MDI"),
    ("Esc", "Stop"), ("", ""),
    ("X, Y, Z, A", "Select an axis"), ("←, →", "Jog first axis"), ("↑, ↓", "Jog second axis"),
    ("PgUp, PgDn", "Jog third axis"), ("[, ]", "Jog fourth axis"), (SHIFT, "Jog at the highest speed"),
    ("−, =", "Jog the selected axis"), ("I, Shift-I", "Next, previous increment"), ("C", "Jog continuously"),
    (", .", "Jog speed"), ("< >", "Angular jog speed"),
    ("; '", "Highest velocity"), ("", ""),
    ("Home", "Home the selected axis"), ("Ctrl-Home", "Home all"), ("End", "Touch off"),
    ("Ctrl-End", "Touch off the tool"), ("Shift-Home", "Zero the selected axis here"), ("L", "Override limits"),
]
help2 = [
    ("O", "Open a program"), ("Ctrl-R", "Reload it"), ("Ctrl-S", "Save it as"), ("R", "Run"), ("T", "Step"),
    ("P", "Pause"), ("S", "Resume"), ("", ""),
    ("`, 1 … 9, 0", "Feed override 0 %, 10 % … 90 %, 100 %"), ("F7", "Mist"), ("F8", "Flood"),
    ("F9, F10", "Spindle clockwise, counterclockwise"),
    ("F11, F12", "Spindle slower, faster"), ("B, Shift-B", "Brake off, on"), ("", ""),
    ("F4", "Preview, DRO, other tabs"), ("V", "Next view"), ("D", "Drag or rotate"), ("!", "Inches or millimetres"),
    ("@", "Actual or commanded position"), ("#", "Machine or relative position"), ("$", "Joints or axes"),
    ("Ctrl-K", "Clear the live plot"), ("Ctrl-E", "Panel"), ("Ctrl-Space", "Clear messages"),
]
