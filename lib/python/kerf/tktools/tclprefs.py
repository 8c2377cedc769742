# SPDX-License-Identifier: GPL-2.0-or-later
"""Preference files that are Tcl scripts: read in a safe interpreter, written whole."""

import sys
import tkinter

from .. import files


def read(path, commands=()):
    """Global variables that the script sets (texts), and the arguments given to each of `commands`.

    A file that is missing gives nothing; a mistake in it is told on standard error and ends the reading.
    """
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            script = file.read()
    except OSError:
        return {}, {}
    tcl = tkinter.Tcl()
    tcl.eval("interp create -safe prefs")
    calls = {}
    for name in commands:
        tcl.createcommand(f"kerf_{name}", lambda *words, n=name: calls.setdefault(n, []).append(words))
        tcl.call("interp", "alias", "prefs", name, "", f"kerf_{name}")
    
    def names():
        return [str(n) for n in tcl.splitlist(tcl.call("prefs", "eval", "info globals"))]
    before = set(names())
    try:
        tcl.call("prefs", "eval", script)
    except tkinter.TclError as error:
        print(f"{path}: {str(error).splitlines()[0]}", file=sys.stderr)
    values = {}
    for name in names():
        if name in before or name in ("errorInfo", "errorCode"):
            continue
        try:
            values[name] = str(tcl.call("prefs", "eval", ["set", f"::{name}"]))
        except tkinter.TclError:
            pass        # an array
    return values, calls


def words(text):
    """The elements of a Tcl list; a text that is none is one element."""
    tcl = tkinter.Tcl()
    try:
        return [str(w) for w in tcl.splitlist(text)]
    except tkinter.TclError:
        return [text]


def quoted(value):
    """As one word of a Tcl script; a list or tuple as a list."""
    tcl = tkinter.Tcl()
    tcl.call("set", "value", tuple(value) if isinstance(value, (list, tuple)) else str(value))
    return tcl.eval("list $value")


def write(path, text):
    """The whole file at once. Raises OSError; then the old file is still there."""
    files.replace(path, text)
