# SPDX-License-Identifier: GPL-2.0-or-later
"""The canon of previews: what a program would draw.

Lengths are inches, angles degrees, feeds inches a second. Nothing here needs a display.
"""
from rs274.glcanon_bake import ARC, FEED, TRAVERSE, ProgramGeometry
from rs274.interpret import ArcsToSegmentsMixin, Translated

_REMOVED = {
    "traverse": "read program_geometry (kind 0)", "feed": "read program_geometry (kind 1)",
    "arcfeed": "read program_geometry (kind 2)", "moves": "read program_geometry",
    "move_cats": "read program_geometry.kinds", "preview_zero_rxy": "read program_geometry.extents_zero_rxy",
}


def __getattr__(name):
    """GlCanonDraw needs a display's modules: they come when it is asked for."""
    if name == "GlCanonDraw":
        from rs274.glcanon_draw import GlCanonDraw
        return GlCanonDraw
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


class GLCanon(Translated, ArcsToSegmentsMixin):
    lineno = -1

    def __init__(self, colors=None, geometry="XYZABCUVW", is_foam=0, foam_w=1.5, foam_z=0.0):
        self.colors = colors or {}
        self.geometry = geometry
        self.is_foam = is_foam
        self.foam_w, self.foam_z = foam_w, foam_z
        self.program_geometry = ProgramGeometry()
        self.program_geometry.configure(geometry, (0.0,) * 9, is_foam, foam_z=foam_z, foam_w=foam_w)
        self.dwells = []
        self.tool_list = []
        self.dwell_time = 0.0
        self.choice = None
        self.highlight_line = None
        self.lo = (0.0,) * 9
        self.first_move = True
        self.in_arc = False
        self.feedrate = 1.0
        self.suppress = 0
        self.state = None
        self.xo = self.yo = self.zo = self.ao = self.bo = self.co = self.uo = self.vo = self.wo = 0.0
        self.notify = 0
        self.notify_message = ""
        self.preview_incomplete = False
        for name in ("", "_notool", "_zero_rxy", "_notool_zero_rxy"):
            setattr(self, "min_extents" + name, [0.0] * 3)
            setattr(self, "max_extents" + name, [0.0] * 3)

    def __getattr__(self, name):
        if name in _REMOVED:
            raise AttributeError(f"GLCanon.{name} was removed (see retire-canon-move-lists); {_REMOVED[name]}")
        raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    # ---- what the program says ----
    def next_line(self, state):
        self.state = state
        self.lineno = state.sequence_number

    def comment(self, text):
        if not text.startswith(("AXIS,", "PREVIEW,")):
            return
        parts = text.split(",")
        command, value = parts[1], parts[2] if len(parts) > 2 else ""
        if command == "stop":
            raise KeyboardInterrupt
        if command == "hide":
            self.suppress += 1
        elif command == "show":
            self.suppress -= 1
        elif command in ("XY_Z_POS", "UV_Z_POS") and len(parts) > 2:
            metric = self.state is not None and 210 in self.state.gcodes
            try:
                height = float(value) / 25.4 if metric else float(value)
            except ValueError:
                height = 5.0 / 25.4 if command == "XY_Z_POS" else 30.0
            if command == "XY_Z_POS":
                self.foam_z = self.program_geometry.foam_z = height
            else:
                self.foam_w = self.program_geometry.foam_w = height
        elif command == "notify":
            self.notify += 1
            self.notify_message = value or "(AXIS,notify):%d" % self.notify

    def message(self, text):
        pass

    def check_abort(self):
        pass

    def set_feed_rate(self, rate):
        self.feedrate = rate / 60.0

    def set_traverse_rate(self, rate):
        pass

    def set_xy_rotation(self, degrees):
        Translated.set_xy_rotation(self, degrees)
        self.rotation_xy = degrees

    def tool_offset(self, xo, yo, zo, ao, bo, co, uo, vo, wo):
        self.first_move = True
        before = (self.xo, self.yo, self.zo, self.ao, self.bo, self.co, self.uo, self.vo, self.wo)
        after = (xo, yo, zo, ao, bo, co, uo, vo, wo)
        self.lo = tuple(p + b - a for p, b, a in zip(self.lo, before, after))
        self.xo, self.yo, self.zo, self.ao, self.bo, self.co, self.uo, self.vo, self.wo = after

    def change_tool(self, tool):
        self.first_move = True
        self.tool_list.append(tool)
        self.program_geometry.mark_toolchange(self.lineno, self.lo, tool)

    # ---- moves ----
    def _record(self, kind, end, feed=0.0):
        self.program_geometry.add_move(self.lineno, kind, self.lo, end, feed, (self.xo, self.yo, self.zo))

    def straight_traverse(self, x, y, z, a, b, c, u, v, w):
        if self.suppress > 0:
            return
        end = tuple(self.rotate_and_translate(x, y, z, a, b, c, u, v, w))
        if not self.first_move:
            self._record(TRAVERSE, end)
        self.lo = end

    def straight_feed(self, x, y, z, a, b, c, u, v, w):
        if self.suppress > 0:
            return
        self.first_move = False
        end = tuple(self.rotate_and_translate(x, y, z, a, b, c, u, v, w))
        self._record(FEED, end, self.feedrate)
        self.lo = end

    straight_probe = straight_feed

    def rigid_tap(self, x, y, z):
        if self.suppress > 0:
            return
        self.first_move = False
        bottom = tuple(self.rotate_and_translate(x, y, z, 0, 0, 0, 0, 0, 0)[:3]) + self.lo[3:]
        top = self.lo
        self._record(FEED, bottom, self.feedrate)
        self.lo = bottom
        self._record(FEED, top, self.feedrate)
        self.lo = top

    def arc_feed(self, *args):
        if self.suppress > 0:
            return
        self.first_move = False
        self.in_arc = True
        try:
            ArcsToSegmentsMixin.arc_feed(self, *args)
        finally:
            self.in_arc = False

    def straight_arcsegments(self, segments):
        self.first_move = False
        for point in segments:
            point = tuple(point)
            self._record(ARC, point, self.feedrate)
            self.lo = point

    def _plane(self):
        return int(self.state.gcodes[3] / 10 - 17) if self.state is not None else 0

    def dwell(self, seconds):
        if self.suppress > 0:
            return
        self.dwell_time += seconds
        self._dwell_mark("dwell", seconds)

    def user_defined_function(self, index, p, q):
        if self.suppress > 0:
            return
        self._dwell_mark("m1xx", 0.0)

    def _dwell_mark(self, colour, seconds):
        self.dwells.append((self.lineno, self.colors.get(colour), self.lo[0], self.lo[1], self.lo[2], self._plane()))
        self.program_geometry.mark_dwell(self.lineno, self.lo, seconds)

    # ---- results ----
    def calc_extents(self):
        """"zero_rxy": as if the program were turned back by the rotation that is in force now, after its end."""
        g = self.program_geometry
        g.rotation = self.rotation_cos, self.rotation_sin, self.g5x_offset_x, self.g5x_offset_y
        self.min_extents, self.max_extents = g.extents
        self.min_extents_notool, self.max_extents_notool = g.extents_notool
        self.min_extents_zero_rxy, self.max_extents_zero_rxy = g.extents_zero_rxy
        self.min_extents_notool_zero_rxy, self.max_extents_notool_zero_rxy = g.extents_notool_zero_rxy

    @property
    def g0_length(self):
        return self.program_geometry.rapid_length

    @property
    def g1_length(self):
        return self.program_geometry.cutting_length

    def run_time(self, max_feed):
        """Seconds at feeds of at most max_feed inches a second, rapids at max_feed."""
        rapids = self.program_geometry.rapid_length / max_feed if max_feed > 0 else 0.0
        return self.program_geometry.cutting_time(max_feed) + rapids + self.dwell_time


