# SPDX-License-Identifier: GPL-2.0-or-later
"""The record of a program's moves: arrays for drawing and picking, extents, lengths, times.

Lengths are inches, angles degrees, feeds inches a second. Points are machine coordinates of the
controlled point: work offsets applied, tool offset not.
"""
import math
from array import array

import numpy

TRAVERSE, FEED, ARC, JUMP, DWELL, TOOLCHANGE = range(6)
NOTHING = (9e99,) * 3, (-9e99,) * 3


class _Box:
    """Least and greatest X Y Z."""

    def __init__(self):
        self.low, self.high = [9e99] * 3, [-9e99] * 3

    def add(self, x, y, z):
        low, high = self.low, self.high
        if x < low[0]: low[0] = x
        if y < low[1]: low[1] = y
        if z < low[2]: low[2] = z
        if x > high[0]: high[0] = x
        if y > high[1]: high[1] = y
        if z > high[2]: high[2] = z

    @property
    def value(self):
        if self.low[0] > self.high[0]:
            return [0.0] * 3, [0.0] * 3
        return list(self.low), list(self.high)


def _turn(axis, point, degrees):
    """Rotates (x, y, z) about axis 0, 1 or 2."""
    s, c = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
    i, j = ((1, 2), (0, 2), (0, 1))[axis]
    p = list(point)
    p[i], p[j] = point[i] * c - point[j] * s, point[i] * s + point[j] * c
    return p


class ProgramGeometry:
    """Filled by a canon, read by whoever draws.

    positions(plane), lines and kinds have one entry a vertex: a vertex ends the piece that began
    at the vertex before it. kinds: 0 traverse, 1 feed, 2 arc are drawn; 3 jump, 4 dwell, 5 tool
    change are not. tools holds an ordinal a vertex; tool_number(ordinal) is the tool, None for 0.
    """

    def __init__(self, geometry="XYZABCUVW", offsets=(0.0,) * 9, is_foam=False):
        self.configure(geometry, offsets, is_foam)
        self.clear()

    def configure(self, geometry, ro, is_foam=False, coordinates="XYZABCUVW", foam_z=0.0, foam_w=1.5):
        """[DISPLAY]GEOMETRY, the work offset that rotations respect, foam cutting; for moves to come."""
        self.geometry = (geometry or "XYZABCUVW").upper()
        self.offsets = tuple(ro) + (0.0,) * (9 - len(ro))
        self.coordinates = coordinates.upper()
        self.is_foam = bool(is_foam)
        self.foam_z, self.foam_w = foam_z, foam_w
        self._letters = []
        sign = 1.0
        for letter in self.geometry:
            if letter == "-":
                sign = -1.0
            elif letter in "XYZABCUVW":
                self._letters.append((letter, sign))
                sign = 1.0
        self._plain = ([l for l, s in self._letters if l in "XYZ"] == ["X", "Y", "Z"]
                       and all(s > 0 for l, s in self._letters))
        self._turns = "!" in self.geometry and any(l in "ABC" and l in self.coordinates for l, s in self._letters)

    def clear(self):
        self._points = array("f")
        self._uv = array("f")
        self._lines, self._kinds, self._tools = array("i"), array("B"), array("i")
        self._tool_numbers = [None]
        self._ends = array("d")         # x y z of each piece's ends, tool offset in x y z
        self._last_end = None
        self.rotation = 1.0, 0.0, 0.0, 0.0      # (cos, sin, x0, y0) that extents_zero_rxy turns back
        self._drawn = _Box()
        self._where = None
        self._feeds = {}
        self._spans = None
        self.n_moves = 0
        self.rapid_length = self.cutting_length = self.dwell_time = 0.0

    # ---- filling ----
    def place(self, p):
        """Where a point of nine axes is drawn."""
        if self._plain and not self._turns:
            if not (p[6] or p[7] or p[8]):
                return p[0], p[1], p[2]
        point, o = [0.0, 0.0, 0.0], self.offsets if self._turns else (0.0,) * 9
        for letter, sign in self._letters:
            n = "XYZABCUVW".index(letter)
            if n < 3 or n > 5:
                point[n % 3] += sign * (p[n] - o[n])
            elif self._turns and letter in self.coordinates:
                point = _turn(n - 3, point, sign * (p[n] - o[n]))
        return point[0] + o[0], point[1] + o[1], point[2] + o[2]

    def _vertex(self, line, kind, p):
        if self.is_foam:
            x, y, z = p[0], p[1], self.foam_z
            self._uv.extend((p[6], p[7], self.foam_w))
        else:
            x, y, z = self.place(p)
        self._points.extend((x, y, z))
        self._lines.append(line)
        self._kinds.append(kind)
        self._tools.append(len(self._tool_numbers) - 1)
        self._spans = None
        if kind <= ARC:
            self._drawn.add(x, y, z)

    def add_move(self, line, kind, start, end, feed=0.0, tool_offset=(0.0, 0.0, 0.0)):
        """A straight piece."""
        if self._where != start:
            self._vertex(line, JUMP, start)
        turn = max(abs(e - s) for s, e in zip(start[3:6], end[3:6]))
        if turn > 0 and self._turns:
            steps = math.ceil(max(10, turn / 10))
            for n in range(1, steps):
                self._vertex(line, kind, tuple(s + (e - s) * n / steps for s, e in zip(start, end)))
        self._vertex(line, kind, end)
        self._where = end
        self.n_moves += 1
        for p in (end,) if self._last_end == (start, tool_offset) else (start, end):
            self._ends.extend((*p[:3], *tool_offset[:3]))
        self._last_end = end, tool_offset
        length = math.dist(start[:3], end[:3])
        if kind == TRAVERSE:
            self.rapid_length += length
        else:
            self.cutting_length += length
            self._feeds[feed] = self._feeds.get(feed, 0.0) + length

    def add_moves(self, moves, kind, tool_offset=(0.0, 0.0, 0.0)):
        """Pieces in order: (line, start, end) or (line, start, end, feed)."""
        for move in moves:
            self.add_move(move[0], kind, move[1], move[2], move[3] if len(move) > 3 else 0.0, tool_offset)

    def mark_jump(self, line, position):
        """The tool is somewhere else without a drawn move."""
        self._vertex(line, JUMP, position)
        self._where = tuple(position)

    def mark_dwell(self, line, position, seconds=0.0):
        self._vertex(line, DWELL, position)
        self._where = tuple(position)
        self.dwell_time += seconds

    def mark_toolchange(self, line, position, tool=None):
        self._tool_numbers.append(tool)
        self._vertex(line, TOOLCHANGE, position)
        self._where = tuple(position)

    # ---- reading ----
    def positions(self, plane=0):
        """N x 3 float32. plane 1: the second plane of a foam cutter."""
        data = self._uv if plane and self.is_foam else self._points
        return (numpy.frombuffer(data, dtype=numpy.float32).reshape(-1, 3).copy() if data
                else numpy.empty((0, 3), numpy.float32))

    @property
    def lines(self):
        return numpy.array(self._lines, dtype=numpy.int32)

    @property
    def kinds(self):
        return numpy.array(self._kinds, dtype=numpy.uint8)

    @property
    def tools(self):
        return numpy.array(self._tools, dtype=numpy.int32)

    def tool_number(self, ordinal):
        return self._tool_numbers[ordinal] if 0 <= ordinal < len(self._tool_numbers) else None

    @property
    def n_vertices(self):
        return len(self._lines)

    @property
    def is_empty(self):
        return self.n_moves == 0

    def _extents(self, tool, turned_back=False):
        """Least and greatest of the controlled point; tool: with the tool offset added (which is not turned)."""
        if not self._ends:
            return [0.0] * 3, [0.0] * 3
        x, y, z, *offset = numpy.array(self._ends).reshape(-1, 6).T
        if turned_back:
            c, s, x0, y0 = self.rotation
            x, y = (x - x0) * c + (y - y0) * s + x0, (y - y0) * c - (x - x0) * s + y0
        ends = [v + t if tool else v for v, t in zip((x, y, z), offset)]
        return [float(v.min()) for v in ends], [float(v.max()) for v in ends]

    # "notool": of the controlled point itself; the others have the tool offset added.
    @property
    def extents_notool(self):
        return self._foam(self._extents(True))

    @property
    def extents(self):
        return self._foam(self._extents(False))

    @property
    def extents_zero_rxy(self):
        return self._extents(False, True)

    @property
    def extents_notool_zero_rxy(self):
        return self._extents(True, True)

    @property
    def drawn_extents(self):
        return self._drawn.value

    def _foam(self, box):
        if self.is_foam and not self.is_empty:
            box[0][2], box[1][2] = min(self.foam_z, self.foam_w), max(self.foam_z, self.foam_w)
        return box

    def cutting_time(self, max_feed):
        """Seconds in feed; max_feed in inches a second."""
        total = 0.0
        for feed, length in self._feeds.items():
            rate = min(max_feed, feed) if feed > 0 else max_feed
            if rate > 0:
                total += length / rate
        return total

    def spans_for_line(self, line):
        """[(first vertex, behind the last vertex)] of what a source line draws; each span begins with
        the vertex that its first piece starts from."""
        if self._spans is None:
            self._spans = {}
            for n, (l, k) in enumerate(zip(self._lines, self._kinds)):
                if k > ARC or n == 0:
                    continue
                spans = self._spans.setdefault(l, [])
                if spans and spans[-1][1] == n:
                    spans[-1] = spans[-1][0], n + 1
                else:
                    spans.append((n - 1, n + 1))
        return list(self._spans.get(line, ()))
