# SPDX-License-Identifier: GPL-2.0-or-later
"""The AXIS screen.

settings  what the INI file says          prefs     what the screen remembers
variables Tk variables of the widgets     commands  what menus, buttons and keys call
jog       jogging and its end             program   opening files, filters, preview data
dro       texts of the position display   camera, scene, preview   the picture
dialogs, notify, icons                    app       puts them together, updates, user's code

The widgets themselves are built by tcl/axis.tcl.
"""
