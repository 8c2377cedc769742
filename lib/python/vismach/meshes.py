# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies from files: STL and OBJ, both as text."""

import numpy as np

from .parts import tell
from .shapes import Body, flat_normals


def lines_of(filename, data):
    """Lines of a file, of a text, or of a list of lines."""
    if data is None:
        with open(filename, encoding="latin-1") as file:
            return file.read().splitlines()
    return data.splitlines() if isinstance(data, str) else list(data)


class File:
    """Triangles that a file describes. Raises OSError, and ValueError with file and line."""

    def __init__(self, filename=None, data=None):
        if filename is None and data is None:
            raise TypeError(f"{type(self).__name__}: a filename or data is needed")
        self.source = filename or "data"
        self.points, self.normals = [], []
        for number, line in enumerate(lines_of(filename, data), 1):
            try:
                self.take(line.split())
            except (ValueError, IndexError):
                raise ValueError(f"{self.source}:{number}: {line.strip()!r} cannot be read") from None
        if len(self.points) % 3:
            raise ValueError(f"{self.source}: a triangle has no three corners")
        if not self.points:
            tell(f"{self.source}: no triangles; {type(self).__name__} reads text, not a binary file")
        self.body = Body(*self.finish(np.array(self.points, dtype=float).reshape(-1, 3),
                                      np.array(self.normals, dtype=float).reshape(-1, 3)))

    def finish(self, points, normals):
        """All-zero normals are computed from the corners."""
        missing = ~normals.any(axis=1)
        if missing.any():
            normals[missing] = flat_normals(points)[missing]
        return points, normals

    def draw(self):
        self.body.draw()


class AsciiSTL(File):
    def take(self, words):
        if words[:1] == ["facet"]:
            self.normal = [float(w) for w in words[2:5]] if len(words) >= 5 else [0, 0, 0]
        elif words[:1] == ["vertex"]:
            self.points.append([float(words[1]), float(words[2]), float(words[3])])
            self.normals.append(getattr(self, "normal", [0, 0, 0]))


class AsciiOBJ(File):
    """Only v, vn and f count; faces are convex."""

    def take(self, words):
        if not hasattr(self, "v"):
            self.v, self.vn = [], []
        if words[:1] == ["v"]:
            self.v.append([float(w) for w in words[1:4]])
        elif words[:1] == ["vn"]:
            self.vn.append([float(w) for w in words[1:4]])
        elif words[:1] == ["f"]:
            corners = [self.corner(word) for word in words[1:]]
            for pair in zip(corners[1:], corners[2:]):
                for point, normal in (corners[0], *pair):
                    self.points.append(point)
                    self.normals.append(normal)

    def corner(self, word):
        """Point and normal."""
        parts = word.split("/")
        return self.at(self.v, parts[0]), self.at(self.vn, parts[2]) if len(parts) > 2 and parts[2] else [0, 0, 0]

    def at(self, found, text):
        """Numbers count from 1, or backwards from -1."""
        number = int(text)
        if number == 0:
            raise ValueError
        return found[number - 1 if number > 0 else number]
