# SPDX-License-Identifier: GPL-2.0-or-later
"""A tool table as tooledit shows it: texts of cells by the letter of their word.

Lines are taken apart by the controller's own reader (kerf_tooltext). What cannot be shown in a
cell is kept: words of unknown letters stay on their line, lines that are no tool go to the top.
"""

import math
import sys
from dataclasses import dataclass, field
from pathlib import Path

import kerf_tooltext

from ..language import _
from ..numbertext import plain

COMMENT = ";"
WHOLE = "TPQ"               # letters whose values are whole numbers
ANGLES = "IJ"
ORDER = "TPXYZABCUVWDIJQ"   # of a written line
COLUMNS = {"x": "X", "y": "Y", "z": "Z", "a": "A", "b": "B", "c": "C", "u": "U", "v": "V", "w": "W", "diam": "D",
           "front": "I", "back": "J", "orien": "Q"}
MAX_ANGLE = 360
MAX_ORIENTATION = 9


def number(letter, text):
    """The value of a cell. Raises ValueError."""
    if letter in WHOLE:
        return int(plain(text))
    value = float(plain(text))
    if not math.isfinite(value):
        raise ValueError(text)
    return value


def is_number(letter, text):
    try:
        number(letter, text)
        return True
    except ValueError:
        return False


def shown(letter, value):
    return f"{value:d}" if letter in WHOLE else f"{value:f}" if letter in ANGLES else f"{value:.9g}"


def chosen_columns(words):
    """Letters for the words of a command line, in their order (all when there are none), and complaints."""
    letters, complaints = [], []
    for word in words:
        letter = COLUMNS.get(word.lower())
        if not letter:
            complaints.append(f"unknown column: {word} (one of {' '.join(COLUMNS)})")
        elif letter in letters:
            complaints.append(f"column {word} is given twice")
        else:
            letters.append(letter)
    return letters or list(COLUMNS.values()), complaints


@dataclass
class Row:
    """One tool. cells: text by letter, COMMENT too; a missing one is empty."""
    cells: dict = field(default_factory=dict)
    extra: list = field(default_factory=list)       # words of unknown letters, as written
    exact: dict = field(default_factory=dict)       # letter: (cell, value with all its digits) where the cell has fewer

    def get(self, letter):
        return self.cells.get(letter, "")

    def line(self):
        words = []
        for letter in ORDER:
            text = self.get(letter).strip()
            if not text:
                continue
            cell, value = self.exact.get(letter, (None, None))
            if cell == text:
                text = repr(value)
            elif text.startswith("0"):
                text = short(text)
            words.append(letter + text)
        words += self.extra
        if self.get(COMMENT):
            words.append(COMMENT + self.get(COMMENT))
        return "  ".join(words).strip()


def short(text):
    """0.50 becomes 0.5; never fewer digits than the value needs."""
    try:
        value = float(text)
    except ValueError:
        return text
    return f"{value:g}" if float(f"{value:g}") == value else repr(value)


class Table:
    """The tools of a file, and what else is in it."""

    def __init__(self, path):
        """Raises OSError."""
        self.path = Path(path)
        self.reread()

    def reread(self):
        """The file again; changes are forgotten. Raises OSError."""
        data = self.path.read_bytes()
        try:
            text, self.encoding = data.decode(), "utf-8"
        except UnicodeDecodeError:
            text, self.encoding = data.decode("latin-1"), "latin-1"
        self.rows, self.comments, self.rejected = [], [], []
        for count, line in enumerate(text.split("\n")[:-1] if text.endswith("\n") else text.split("\n") if text else [],
                                     1):
            self._take(count, line.rstrip("\r"))
        if self.rejected:
            print(f"tooledit: {self.path}: Bogus lines in file ignored (they stay in the file)", file=sys.stderr)
        self.stamp = self.look()
        self.saved = self.text()

    def _take(self, count, line):
        words, comment = kerf_tooltext.split(line)
        if not words:
            self.comments.append((comment or "").rstrip())
            return
        row = Row()
        for letter, text, column in words:
            if letter not in ORDER:
                row.extra.append(letter + text)
                continue
            try:
                value = number(letter, text)
            except ValueError:
                return self._reject(count, column, f"{letter}{text} is no number", line)
            row.cells[letter] = shown(letter, value)
            if letter not in WHOLE and float(row.cells[letter]) != value:
                row.exact[letter] = (row.cells[letter], value)
        if not row.get("T"):
            return self._reject(count, 1, "no tool number (T)", line)
        row.cells[COMMENT] = (comment or "").strip()
        self.rows.append(row)

    def _reject(self, count, column, why, line):
        print(f"tooledit: {self.path}:{count}:{column}: {why}: {line.strip()}", file=sys.stderr)
        self.rejected.append(line)

    def text(self):
        """What would be written."""
        lines = [COMMENT + c for c in self.comments] + self.rejected + [row.line() for row in self.rows]
        return "".join(line + "\n" for line in lines)

    @property
    def modified(self):
        return self.text() != self.saved

    def save(self):
        """The old file stays as FILE.bak. Raises OSError; then nothing has changed."""
        text = self.text()
        kerf_tooltext.replace_file(str(self.path),
                                   text.encode(self.encoding, "replace" if self.encoding != "utf-8" else "strict"),
                                   True)
        self.saved, self.stamp = text, self.look()

    def look(self):
        """Tells one state of the file from another; None when it is gone."""
        try:
            info = self.path.stat()
            return info.st_mtime_ns, info.st_size, info.st_ino
        except OSError:
            return None

    def problems(self, random_changer=False):
        """What keeps the table from being saved, one text each."""
        found, tools, pockets = [], {}, {}
        for place, row in enumerate(self.rows, 1):
            name = _("row %d (tool %s)") % (place, row.get('T') or '?')
            for letter in ORDER:
                text = row.get(letter).strip()
                if letter in "TP" and not (text.isascii() and text.isdigit()):
                    what = _("tool") if letter == "T" else _("pocket")
                    found.append(_("%s: %s %r must be a whole number, 0 or more") % (name, what, text))
                elif text and not is_number(letter, text):
                    found.append((_("%s: %s %r is not a whole number") if letter in WHOLE
                                  else _("%s: %s %r is not a number")) % (name, letter, text))
                elif text and letter == "Q" and not 0 <= int(text) <= MAX_ORIENTATION:
                    found.append(_("%s: orientation %s must be 0 to %d") % (name, text, MAX_ORIENTATION))
                elif text and letter in ANGLES and abs(float(text)) > MAX_ANGLE:
                    found.append((_("%s: front angle %s must be -%d to %d") if letter == "I"
                                  else _("%s: back angle %s must be -%d to %d"))
                                 % (name, text, MAX_ANGLE, MAX_ANGLE))
            for letter, seen, what in (("T", tools, _("tool")), ("P", pockets, _("pocket"))):
                text = row.get(letter).strip()
                if (letter == "T" or random_changer) and text.isdigit():
                    if int(text) in seen:
                        found.append(_("%s: %s %d is also in row %d") % (name, what, int(text), seen[int(text)]))
                    seen.setdefault(int(text), place)
        return found

    def sort(self, letter, decreasing=False):
        """By a column; cells without a number last."""
        def key(row):
            text = row.get(letter).strip()
            if letter == COMMENT:
                return text.lower()
            return float(text) if is_number(letter, text) else -math.inf if decreasing else math.inf
        self.rows.sort(key=key, reverse=decreasing)
