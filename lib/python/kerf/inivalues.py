# SPDX-License-Identifier: GPL-2.0-or-later
"""All variables of an INI file for scripts, read by the one parser (through inivalue)."""

import re
import subprocess

LETTERS = "XYZABCUVW"
_ESCAPES = {"a": "\a", "b": "\b", "f": "\f", "n": "\n", "r": "\r", "t": "\t", "v": "\v", "\\": "\\"}


def _unescape(text):
    return re.sub(r"\\(x[0-9a-fA-F]{2}|.)",
                  lambda m: chr(int(m[1][1:], 16)) if len(m[1]) == 3 else _ESCAPES.get(m[1], m[0]), text)


def trivkins_letters(kinematics):
    """Letters by joint of [KINS]KINEMATICS = trivkins..., upper case (one each); "" for other kinematics."""
    words = kinematics.split()
    if not words or words[0] != "trivkins":
        return ""
    return next((w.partition("=")[2].upper() for w in words[1:] if w.lower().startswith("coordinates=")), LETTERS)


class IniError(Exception):
    """The file cannot be read; the text holds the parser's messages."""


class IniValues:
    """Variables of one file: section -> name -> list of values in file order."""

    def __init__(self, path, env=None):
        done = subprocess.run(["inivalue", "--variables", "--content", "--prefix", str(path)], env=env,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.messages = done.stderr
        if done.returncode:
            raise IniError(done.stderr)
        self.sections = {}
        for line in done.stdout.splitlines():
            section, rest = line[1:].split("]", 1)
            name, value = rest.split("=", 1)
            self.sections.setdefault(section, {}).setdefault(name, []).append(_unescape(value))

    def get(self, section, name, default=None):
        """First value, or the default when the variable is missing."""
        values = self.sections.get(section, {}).get(name)
        return values[0] if values else default

    def all(self, section, name):
        """All values in file order."""
        return list(self.sections.get(section, {}).get(name, []))
