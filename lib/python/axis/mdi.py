# SPDX-License-Identifier: GPL-2.0-or-later
"""History of MDI commands, one a line in a file. No widgets here."""

import sys
from pathlib import Path

from kerf import files

MOST = 1000


class MdiHistory:
    """Oldest first. `at` is the place of the line shown; len(lines) means the empty line at the end."""

    def __init__(self, path):
        self.path = Path(path).expanduser()
        try:
            text = self.path.read_text(errors="replace")
            if "\ufffd" in text or "\0" in text:
                print(f"axis: {self.path}: some of it is no text", file=sys.stderr)
            self.lines = [line for line in text.replace("\0", "").splitlines() if line][-MOST:]
        except OSError:
            self.lines = []
        self.at = len(self.lines)

    def add(self, text):
        if not self.lines or self.lines[-1] != text:
            self.lines = (self.lines + [text])[-MOST:]
        self.at = len(self.lines)
        self.save()

    def step(self, direction):
        """The previous (-1) or next (1) line, in a ring with the empty line."""
        self.at = (self.at + direction) % (len(self.lines) + 1)
        return self.lines[self.at] if self.at < len(self.lines) else ""

    def clear(self):
        self.lines, self.at = [], 0
        self.save()

    def save(self):
        try:
            files.replace(self.path, "".join(line + "\n" for line in self.lines))
        except OSError as e:
            print(f"axis: MDI history is not kept: {e}")
