# SPDX-License-Identifier: GPL-2.0-or-later
"""Buttons of an operator's panel (scan codes of a Mesa 7i73) as HAL pins and commands: what is behind `panelui`.

config    _panelui.ini: reading and checking
keys      scan codes: which key goes down and up
panel     buttons, their states, pins and actions
commands  what a button may ask of LinuxCNC
"""
