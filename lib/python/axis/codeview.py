# SPDX-License-Identifier: GPL-2.0-or-later
"""The program's text. Of a long file only a window of lines is in the widget; the rest stays in the file.

Lines are counted from 1. The file is the snapshot that the machine runs, so it does not change.
"""

import codecs

import numpy as np

WINDOW = 6000            # lines in the widget
MARGIN = 500             # nearer to an end of the window than this: it moves
CHUNK = 1 << 22          # bytes read at a time


def line_starts(path):
    """Offsets of the lines' first bytes, and the size."""
    starts, at = [np.zeros(1, np.int64)], 0
    with open(path, "rb") as f:
        while block := f.read(CHUNK):
            starts.append(np.flatnonzero(np.frombuffer(block, np.uint8) == 10) + (at + 1))
            at += len(block)
    return np.concatenate(starts), at


def shown(data):
    """A line as it is shown: tabs expanded, no line end."""
    return data.decode(errors="backslashreplace").rstrip("\n").replace("\r", "").expandtabs()


class CodeView:
    """Fills the widget `text` and its scroll bar."""

    def __init__(self, text, scrollbar):
        self.text, self.bar = text, scrollbar
        self.path = None
        self.starts, self.size = np.zeros(1, np.int64), 0
        self.base = 0                    # lines before the window
        self.count = 0                   # lines in it
        self.tags = {}                   # tag -> line
        self.ignored = 0                 # so many lines at the beginning are not run
        self.moving = False
        text.configure(yscrollcommand=self.scrolled)
        scrollbar.configure(command=self.yview)

    @property
    def total(self):
        return len(self.starts) if self.path else 0

    def load(self, path, index=None):
        """index: line_starts(path), where it is known."""
        self.path = path
        self.starts, self.size = index or line_starts(path)
        self.tags.clear()
        self.ignored = 0
        self.fill(0)
        self.text.yview_moveto(0)

    def lines(self, first, last):
        """Texts of lines first+1 to last."""
        if not self.path or first >= last:
            return []
        end = int(self.starts[last]) if last < len(self.starts) else self.size
        begin = int(self.starts[first])
        with open(self.path, "rb") as f:
            f.seek(begin)
            data = f.read(end - begin)
        parts = (data.removeprefix(codecs.BOM_UTF8) if begin == 0 else data).split(b"\n")
        return [shown(part) for part in parts[:last - first]]

    def line_text(self, line):
        return self.lines(line - 1, line)[0] if 1 <= line <= self.total else ""

    # -- the window ------------------------------------------------------------------------

    def fill(self, base):
        """Puts the lines behind `base` into the widget."""
        self.base = max(0, min(base, self.total - WINDOW))
        lines = self.lines(self.base, min(self.total, self.base + WINDOW))
        self.count = len(lines)
        t = self.text
        t.configure(state="normal")
        t.delete("1.0", "end")
        chunks = []
        for n, line in enumerate(lines, self.base + 1):
            chunks += ["%6d: " % n, "lineno", line + "\n", ""]
        if chunks:
            chunks[-2] = chunks[-2][:-1]
            t.insert("end", *chunks)
        t.configure(state="disabled")
        for tag, line in self.tags.items():
            self.show_tag(tag, line)
        self.show_ignored()

    def row(self, line):
        """The line's row in the widget, or None."""
        row = line - self.base
        return row if 1 <= row <= self.count else None

    def see(self, line):
        if not 1 <= line <= self.total:
            return
        if self.row(line) is None:
            self.fill(line - WINDOW // 2)
        self.text.see(f"{self.row(line)}.0")

    def top(self):
        """Line at the upper edge, with its fraction of a page lost."""
        return self.base + int(self.text.index("@0,0").split(".")[0])

    def line_at(self, x, y):
        return self.base + int(self.text.index(f"@{x},{y}").split(".")[0])

    def mark(self, tag, line):
        """The tag is on this line alone; 0 or less: on none."""
        self.text.tag_remove(tag, "1.0", "end")
        self.tags.pop(tag, None)
        if line > 0:
            self.tags[tag] = line
            self.show_tag(tag, line)

    def ignore_before(self, line):
        """Lines before this one are grey: the start skipped them."""
        self.ignored = max(0, line - 1)
        self.show_ignored()

    def show_ignored(self):
        self.text.tag_remove("ignored", "1.0", "end")
        rows = min(self.ignored - self.base, self.count)
        if rows > 0:
            self.text.tag_add("ignored", "1.0", f"{rows}.end")

    def show_tag(self, tag, line):
        row = self.row(line)
        if row is not None:
            self.text.tag_add(tag, f"{row}.0", f"{row}.end")

    # -- scrolling -------------------------------------------------------------------------

    def scrolled(self, low, high):
        low, high = float(low), float(high)
        if self.total <= WINDOW:
            self.bar.set(low, high)
            return
        self.bar.set((self.base + low * self.count) / self.total, (self.base + high * self.count) / self.total)
        near_top = low * self.count < MARGIN and self.base > 0
        near_end = (1 - high) * self.count < MARGIN and self.base + self.count < self.total
        if (near_top or near_end) and not self.moving:
            self.moving = True
            self.text.after_idle(self.move_window)

    def move_window(self):
        try:
            top = self.top()
            self.fill(top - WINDOW // 2)
            self.text.yview(f"{top - self.base}.0")
        finally:
            self.moving = False

    def yview(self, what, *args):
        """The scroll bar's command."""
        if what == "moveto" and self.total > WINDOW:
            line = 1 + int(max(0.0, min(1.0, float(args[0]))) * self.total)
            self.moving = True
            try:
                if self.row(line) is None or self.row(min(self.total, line + 100)) is None:
                    self.fill(line - WINDOW // 2)
                self.text.yview(f"{line - self.base}.0")
            finally:
                self.moving = False
        else:
            self.text.yview(what, *args)
