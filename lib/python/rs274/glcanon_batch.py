# SPDX-License-Identifier: GPL-2.0-or-later
"""Canons that take straight moves in batches: one call for thousands of rows."""
from rs274.glcanon import GLCanon

ROW = 13  # kind, line, x y z a b c u v w, feed rate, spindle speed


class MoveBatchMixin:
    """Hands the rows of a batch to the ordinary methods of the canon, in order.

    batch_progress(lineno) is called once a batch, with the line of its last row.
    """

    use_move_batches = True
    batch_spindle_speed = 0.0

    def batch_progress(self, lineno):
        pass

    def move_batch(self, rows):
        values = rows.cast("d")
        last = None
        for at in range(0, len(values), ROW):
            kind, line = int(values[at]), int(values[at + 1])
            position = tuple(values[at + 2:at + 11])
            self.lineno = last = line
            self.feedrate = values[at + 11] / 60.0
            self.batch_spindle_speed = values[at + 12]
            if kind == 0:
                self.straight_traverse(*position)
            elif kind == 1:
                self.straight_feed(*position)
            elif kind == 2:
                self.straight_probe(*position)
            elif kind == 3:
                self.rigid_tap(*position[:3])
            elif kind == 4:
                self.dwell(position[0])
            elif kind == 5:
                self.user_defined_function(int(position[0]), position[1], position[2])
            elif kind == 6:
                self.change_tool(int(position[0]))
            elif kind == 7:
                self.tool_offset(*position)
        if last is not None:
            self.batch_progress(last)


class BatchGLCanon(MoveBatchMixin, GLCanon):
    """GLCanon that is fed in batches."""
