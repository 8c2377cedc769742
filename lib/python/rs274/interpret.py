# SPDX-License-Identifier: GPL-2.0-or-later
"""Building blocks of canons for gcode.parse().

Lengths are inches, angles degrees, whatever the program's units.
"""
import math

import gcode

AXES = "xyzabcuvw"
EMPTY_TOOL = (-1,) + (0.0,) * 12 + (0,)


class Translated:
    """Moves arrive in program coordinates and are handed on in machine coordinates (without
    tool offset): straight_traverse_translated, straight_feed_translated."""

    g92_offset_x = g92_offset_y = g92_offset_z = 0.0
    g92_offset_a = g92_offset_b = g92_offset_c = 0.0
    g92_offset_u = g92_offset_v = g92_offset_w = 0.0
    g5x_offset_x = g5x_offset_y = g5x_offset_z = 0.0
    g5x_offset_a = g5x_offset_b = g5x_offset_c = 0.0
    g5x_offset_u = g5x_offset_v = g5x_offset_w = 0.0
    g5x_index = 1
    rotation_xy = 0.0
    rotation_sin = 0.0
    rotation_cos = 1.0

    def rotate_and_translate(self, x, y, z, a, b, c, u, v, w):
        x += self.g92_offset_x
        y += self.g92_offset_y
        if self.rotation_xy:
            x, y = x * self.rotation_cos - y * self.rotation_sin, x * self.rotation_sin + y * self.rotation_cos
        return [
            x + self.g5x_offset_x, y + self.g5x_offset_y, z + self.g92_offset_z + self.g5x_offset_z,
            a + self.g92_offset_a + self.g5x_offset_a, b + self.g92_offset_b + self.g5x_offset_b,
            c + self.g92_offset_c + self.g5x_offset_c, u + self.g92_offset_u + self.g5x_offset_u,
            v + self.g92_offset_v + self.g5x_offset_v, w + self.g92_offset_w + self.g5x_offset_w,
        ]

    def straight_traverse(self, *position):
        self.straight_traverse_translated(*self.rotate_and_translate(*position))

    def straight_feed(self, *position):
        self.straight_feed_translated(*self.rotate_and_translate(*position))

    def set_g5x_offset(self, index, *offset):
        self.g5x_index = index
        for letter, value in zip(AXES, offset):
            setattr(self, "g5x_offset_" + letter, value)

    def set_g92_offset(self, *offset):
        for letter, value in zip(AXES, offset):
            setattr(self, "g92_offset_" + letter, value)

    def set_xy_rotation(self, degrees):
        self.rotation_xy = degrees
        self.rotation_sin = math.sin(math.radians(degrees))
        self.rotation_cos = math.cos(math.radians(degrees))


class ArcsToSegmentsMixin:
    """Arcs become chains of points: straight_arcsegments(list of 9-tuples)."""

    plane = 1
    arcdivision = 64

    def set_plane(self, plane):
        self.plane = plane

    def arc_feed(self, first_end, second_end, first_axis, second_axis, rotation, axis_end, a, b, c, u, v, w):
        self.lo = tuple(self.lo)
        self.straight_arcsegments(gcode.arc_to_segments(
            self, first_end, second_end, first_axis, second_axis, rotation, axis_end, a, b, c, u, v, w,
            self.arcdivision))


_random_index = -1  # place of the tool that the last change of a random changer put into the spindle


class StatMixin:
    """What the interpreter asks of the machine, answered from a linuxcnc.stat()."""

    def __init__(self, stat, random):
        self.s = stat
        self.random = random
        self.tools = list(stat.tool_table)

    def change_tool(self, tool_nr):
        global _random_index
        idx = self.get_index(tool_nr)
        if self.random:
            self.tools[0], self.tools[idx] = self.tools[idx], self.tools[0]
            _random_index = idx
        elif idx == 0:
            self.tools[0] = EMPTY_TOOL
        else:
            self.tools[0] = self.tools[idx]

    def get_tool(self, idx):
        if idx == _random_index and self.tools:
            return tuple(self.tools[0])
        if 0 <= idx < len(self.tools):
            return tuple(self.tools[idx])
        return EMPTY_TOOL

    def get_index(self, tool_nr):
        """Place of a tool in the table, 0 when it is not there."""
        for idx, tool in enumerate(self.tools):
            if idx > 0 and tool[0] == tool_nr:
                return idx
        return 0

    def get_external_angular_units(self):
        return self.s.angular_units or 1.0

    def get_external_length_units(self):
        return self.s.linear_units or 1.0

    def get_axis_mask(self):
        return self.s.axis_mask

    def get_block_delete(self):
        return self.s.block_delete


class PrintCanon:
    """Prints each call."""

    def set_g5x_offset(self, *args):
        print("set_g5x_offset", args)

    def set_g92_offset(self, *args):
        print("set_g92_offset", args)

    def next_line(self, state):
        print("next_line", state.sequence_number)
        self.state = state

    def set_plane(self, plane):
        print("set plane", plane)

    def set_feed_rate(self, rate):
        print("set feed rate", rate)

    def comment(self, text):
        print("#", text)

    def straight_traverse(self, *args):
        print("straight_traverse %.4g %.4g %.4g  %.4g %.4g %.4g  %.4g %.4g %.4g" % args)

    def straight_feed(self, *args):
        print("straight_feed %.4g %.4g %.4g  %.4g %.4g %.4g  %.4g %.4g %.4g" % args)

    def straight_probe(self, *args):
        print("straight_probe %.4g %.4g %.4g  %.4g %.4g %.4g  %.4g %.4g %.4g" % args)

    def dwell(self, seconds):
        if seconds < 0.1:
            print("dwell %f us" % (seconds * 1e6))
        else:
            print("dwell %f s" % seconds)

    def arc_feed(self, *args):
        print("arc_feed %.4g %.4g  %.4g %.4g %.4g  %.4g  %.4g %.4g %.4g  %.4g %.4g %.4g" % args)

    def rigid_tap(self, x, y, z):
        print("rigid_tap %.4g %.4g %.4g" % (x, y, z))

    def change_tool(self, tool):
        print("change_tool", tool)

    def tool_offset(self, *args):
        print("tool_offset", args)

    def set_xy_rotation(self, degrees):
        print("set_xy_rotation", degrees)

    def set_traverse_rate(self, rate):
        print("set_traverse_rate", rate)

    def message(self, text):
        print("message", text)

    def user_defined_function(self, index, p, q):
        print("user_defined_function", index, p, q)

    def check_abort(self):
        return False

    def get_axis_mask(self):
        return 0x1FF

    def get_external_angular_units(self):
        return 1.0

    def get_external_length_units(self):
        return 1.0

    def get_tool(self, idx):
        return EMPTY_TOOL

    def get_block_delete(self):
        return False
