# SPDX-License-Identifier: GPL-2.0-or-later
"""Preferences that AXIS remembers: ~/.axis_preferences, an INI file with one section [DEFAULT]."""

import ast
import configparser
import io
import os
import sys
from pathlib import Path

from kerf import files

MAX_RECENT = 10


class Preferences:
    """Values by name; a missing one is written with its default when first asked for.

    A damaged file is kept as .axis_preferences.bad, and what .axis_preferences.bak keeps is taken; `damaged` says so
    then, else None.
    """

    def __init__(self, path=None):
        self.path = Path(path) if path else Path.home() / ".axis_preferences"
        self.values, self.damaged = configparser.RawConfigParser(), None
        try:
            self.values.read(self.path)
            if self.path.is_file() and not self.path.read_text().strip():
                raise configparser.Error("it is empty")
        except (configparser.Error, UnicodeDecodeError) as e:
            line = getattr(e, "lineno", None) or next((at for at, _ in getattr(e, "errors", ())), None)
            what = f"{self.path}:{line}: no preference" if line else f"{self.path}: {e}"
            print(f"axis: {what}; the file is kept with .bad behind its name", file=sys.stderr)
            self.values = self.kept()
            self.damaged = self.path.with_name(self.path.name + ".bad")
        except OSError as e:
            print(f"axis: {self.path}: {e.strerror}")
        try:
            if self.damaged:
                os.replace(self.path, self.damaged)
        except OSError as e:
            print(f"axis: {self.path}: {e.strerror}")

    def kept(self):
        """The values of the last version but one, as far as they can be read."""
        values = configparser.RawConfigParser()
        try:
            values.read(self.path.with_name(self.path.name + ".bak"))
        except (configparser.Error, UnicodeDecodeError, OSError):
            return configparser.RawConfigParser()
        return values

    def getpref(self, option, default=False, kind=bool):
        """Value of an option as `kind` (bool, float, int, str; repr: a Python literal)."""
        if self.values.has_option("DEFAULT", option):
            text = self.values.get("DEFAULT", option)
            try:
                if kind is bool:
                    return self.values.getboolean("DEFAULT", option)
                return ast.literal_eval(text) if kind is repr else kind(text)
            except (ValueError, SyntaxError):
                pass
        self.putpref(option, default, kind)
        return default

    def putpref(self, option, value, kind=bool):
        """Keeps a value; the file is written at once and never half."""
        self.values.set("DEFAULT", option, repr(value) if kind is repr else str(kind(value)))
        text = io.StringIO()
        self.values.write(text)
        try:
            files.replace(self.path, text.getvalue())
        except OSError as e:
            print(f"axis: preferences are not kept: {e}")

    def recent(self):
        """Paths of recent files, newest first."""
        found = self.getpref("recentfiles", [], repr)
        return [f for f in found if isinstance(f, str)] if isinstance(found, list) else []

    def add_recent(self, path):
        self.putpref("recentfiles", ([path] + [f for f in self.recent() if f != path])[:MAX_RECENT], repr)
