# SPDX-License-Identifier: GPL-2.0-or-later
"""Tuning values: pins that HAL files set from the INI file, and writing their values back into it."""

import math
import os
import re
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path

from .. import files
from ..language import _
from ..tree import Tree
from . import watch

HEADER = re.compile(r"\s*\[\s*([A-Za-z_]\w*)\s*\]")
VARIABLE = re.compile(r"(\s*)([A-Za-z_]\w*)(\s*=[ \t]*)(\S*)(.*)", re.S)
INCLUDE = re.compile(r"#INCLUDE[ \t]+(\S.*?)\s*$")
SETTING = re.compile(r"\s*(?:setp\s+(\S+)\s+|([^\s=]+)\s*=\s*)(\S+)")
SOURCE = re.compile(r"\[(\w+)\]\(?(\w+)\)?")
SUPPORTED = ["TUNE", "JOINT_n", "AXIS_l", "SPINDLE_n"]
MAX_INCLUDES = 15


class NotPossible(Exception):
    """For the user: what, why, what to do."""


def lines_of(path):
    """Physical lines with their ends; bytes as characters, so that they can be written back unchanged."""
    # Python ends lines in many letters
    return re.findall(r"[^\n]*\n|[^\n]+", Path(path).read_bytes().decode("latin-1"))


def walk(path, section="", depth=0):
    """(file, index, section, match) for each variable, includes followed in their place. Returns the last section."""
    if depth >= MAX_INCLUDES:
        return section
    for index, line in enumerate(lines_of(path)):
        include, header = INCLUDE.match(line), HEADER.match(line)
        if include:
            other = Path(os.path.expanduser(include[1]))
            other = other if other.is_absolute() else Path(path).parent / other
            if other.is_file():
                section = yield from walk(other, section, depth + 1)
        elif line.lstrip()[:1] in ("#", ";"):
            continue
        elif header:
            section = header[1]
        elif match := VARIABLE.match(line):
            yield Path(path), index, section, match
    return section


def hal_files(ini):
    """Files of the lines HALFILE and POSTGUI_HALFILE between [HAL] and the next section; Tcl files are left out."""
    inside, found = False, []
    for line in lines_of(ini):
        header, match = HEADER.match(line), VARIABLE.match(line)
        if line.lstrip()[:1] in ("#", ";"):
            continue
        if header:
            inside = header[1] == "HAL"
        elif inside and match and match[2] in ("HALFILE", "POSTGUI_HALFILE") and not match[4].endswith(".tcl"):
            if path := find_hal(ini, match[4]):
                found.append(path)
    return found


def find_hal(ini, name):
    own, library = Path(ini).parent, [Path(os.environ.get("HALLIB_DIR") or Tree.find().hallib)]
    library += [Path(p) for p in os.environ.get("HALLIB_PATH", "").split(os.pathsep) if p and p != "."]
    if name.startswith("LIB:"):
        places, name = library, name[4:]
    else:
        places = [own] + library
    return next((p / name for p in places if (p / name).is_file()), None)


def supported(token, joints):
    """Whether a value comes from a section for tuning."""
    if "TUNE" in token or re.search(r"AXIS_[A-Z]", token) or re.search(r"SPINDLE_\d(?!\d)", token):
        return True
    match = re.search(r"JOINT_(\d+)", token)
    return bool(match) and int(match[1]) < joints


def written(value):
    """A HAL value as text for the INI file, never with an exponent."""
    if isinstance(value, bool):
        return str(int(value))
    return format(Decimal(repr(value)), "f").removesuffix(".0") if isinstance(value, float) else str(value)


@dataclass
class Value:
    """One INI variable and the pins that have its value."""
    section: str
    name: str           # as written first
    items: list
    test: tuple = ()    # values before the running test

    def read(self):
        """Of the first pin; None when it is gone."""
        return self.items[0].value()

    def text(self):
        value = self.read()
        return watch.GONE if value is None else written(value)


class Calibration:
    """All values of a machine. sections: name -> list of Value, in the order of the files."""

    def __init__(self, ini):
        """Raises NotPossible."""
        self.ini = Path(ini)
        try:
            variables = [(s, m[2].lower(), m[4]) for _, _, s, m in walk(self.ini)]
            joints = next((int(v) for s, n, v in variables if s == "KINS" and n == "joints" and v.isdigit()), 0)
            self.sections = {}
            for path in hal_files(self.ini):
                for line in lines_of(path):
                    self._take(line, joints)
        except OSError as error:
            raise NotPossible(f"{error.filename}: {error.strerror}") from None

    def _take(self, line, joints):
        match = None if "#" in line else SETTING.match(line)
        if not match or not supported(match[3], joints):
            return
        source = SOURCE.search(match[3])
        if not source:
            return
        item = self._item(match[1] or match[2])
        if not item:
            return
        values = self.sections.setdefault(source[1], [])
        known = next((v for v in values if v.name.lower() == source[2].lower()), None)
        if known:
            known.items.append(item)
        else:
            values.append(Value(source[1], source[2], [item]))

    @staticmethod
    def _item(name):
        for kind in ("pin", "param"):
            item = watch.Item(kind, name)
            if item.info:
                return item
        return None

    def test(self, changes):
        """changes: [(Value, text)]. All are set or none. Raises NotPossible."""
        wanted = []
        for value, text in changes:
            try:
                wanted.append((value, watch.convert(value.items[0].type, text)))
            except ValueError as error:
                raise NotPossible(f"[{value.section}]{value.name}: {error}") from None
        before = [(value, tuple(i.value() for i in value.items)) for value, _ in wanted]
        try:
            for value, new in wanted:
                for item in value.items:
                    item.set(new)
        except (RuntimeError, ValueError) as error:
            self._restore(before)
            raise NotPossible(_("[%s]%s: %s: %s; nothing is changed")
                              % (value.section, value.name, item.name, error)) from None
        for value, old in before:
            value.test = old

    def cancel(self, values):
        """Back to before test(). Raises NotPossible."""
        if problem := self._restore([(v, v.test) for v in values]):
            raise NotPossible(problem)

    @staticmethod
    def _restore(before):
        problem = ""
        for value, old in before:
            for item, number in zip(value.items, old):
                try:
                    item.set(number)
                except (RuntimeError, ValueError) as error:
                    problem = f"{item.name}: {error}"
        return problem

    # -- the INI file -------------------------------------------------------------------

    def changes(self):
        """(file, index, new line, text of what changes) for values whose HAL value differs from the INI text."""
        found, places = [], {}
        for path, index, section, match in walk(self.ini):
            places.setdefault((section, match[2].lower()), (path, index, match))
        for values in self.sections.values():
            for value in values:
                place = places.get((value.section, value.name.lower()))
                now = value.read()
                if not place or now is None:
                    continue
                path, index, match = place
                if same(match[4], now):
                    continue
                line = "".join((match[1], match[2], match[3], written(now), match[5]))
                found.append((path, index, line, f"[{value.section}]{match[2]} = {match[4]} -> {written(now)}"))
        return found

    def save(self):
        """The values in HAL go into the file; what was changed, one text each. Raises NotPossible."""
        if self.ini.name.endswith(".ini.expanded"):
            raise NotPossible(_("%s is made from another INI file each time the machine starts: values are to be "
                                "changed in that one (%s)") % (self.ini, self.ini.name[:-len('.expanded')]))
        for value in (v for values in self.sections.values() for v in values):
            if isinstance(now := value.read(), float) and not math.isfinite(now):
                raise NotPossible(_("[%s]%s: the value in HAL is %s: an INI file holds numbers only; nothing is saved")
                                  % (value.section, value.name, now))
        changes = self.changes()
        for path in {c[0] for c in changes}:
            if not os.access(path, os.W_OK):
                raise NotPossible(_("%s is not writable: chmod u+w, or copy the configuration to your own folder")
                                  % path)
        for path in {c[0] for c in changes}:
            lines = lines_of(path)
            for change in changes:
                if change[0] == path:
                    lines[change[1]] = change[2]
            try:
                files.replace(path, "".join(lines).encode("latin-1"))
            except OSError as error:
                raise NotPossible(f"{path}: {error.strerror}") from None
        return [c[3] for c in changes]


def same(text, value):
    """Whether the INI text means this HAL value."""
    try:
        return watch.convert("bit", text) == value if isinstance(value, bool) else float(text) == float(value)
    except ValueError:
        return False
