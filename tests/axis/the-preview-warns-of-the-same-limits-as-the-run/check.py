#!/usr/bin/python3
# 60 seeded programs with offsets, rotation, G92, tool lengths, both units and arcs in every plane. The reader in C++
# and the canon in Python find the same extents; the labels in the preview and the warnings before a run say the same,
# which is what the extents with the tool say.
import random
import tempfile
from types import SimpleNamespace

import gcode
import programs
from axis.program import limit_warnings
from programs import MILL, TOOLS, program
from rs274.glcanon import GLCanon

NAMES = ("min_extents", "max_extents", "min_extents_notool", "max_extents_notool")


class Canon(GLCanon):
    def get_axis_mask(self): return 7
    def get_external_length_units(self): return 1.0
    def get_external_angular_units(self): return 1.0
    def get_tool(self, n): return TOOLS[n] if n < len(TOOLS) else (-1,) + (0.0,) * 12 + (0,)
    def get_block_delete(self): return False


composer = programs.composer()
wrong, warned, quiet = [], 0, 0
with tempfile.TemporaryDirectory() as folder:
    path = folder + "/program.ngc"
    for seed in range(60):
        r = random.Random(seed)
        with open(path, "w") as file:
            file.write(program(r))
        loaded = programs.load(path, folder + f"/{seed}.var", composer)
        canon = Canon()
        canon.parameter_file = folder + f"/{seed}.canon.var"
        result, line = gcode.parse(path, canon, ["G21"])
        if loaded.error or result > gcode.MIN_ERROR:
            wrong.append(f"{seed}: {loaded.error} {result} line {line}")
            continue
        canon.calc_extents()
        found = [*loaded.extents, *loaded.extents_tool]
        if any(abs(a - b) > 1e-6 for name, box in zip(NAMES, found) for a, b in zip(getattr(canon, name), box)):
            wrong.append(f"{seed}: extents {found} and {[getattr(canon, name) for name in NAMES]}")
        reach = r.uniform(60, 130)
        axis = dict(min_position_limit=-reach, max_position_limit=reach)
        composer.stat = SimpleNamespace(axis=[axis] * 9, tool_offset=[0.0, 0.0, r.choice((0.0, 21.0))] + [0.0] * 6,
                                        g5x_offset=[0.0] * 9, g92_offset=[0.0] * 9, g5x_index=1, rotation_xy=0.0)
        expected = [f"Program exceeds machine {name} on axis {letter}" for i, letter in enumerate("XYZ")
                    for name, over in (("minimum", 25.4 * canon.min_extents_notool[i] < -reach),
                                       ("maximum", 25.4 * canon.max_extents_notool[i] > reach)) if over]
        told = limit_warnings(composer.program, MILL, composer.stat)
        flagged = 0
        for view in ("z", "x"):         # X and Y, then Z
            composer.camera.set_view(view)
            labels = composer.add_extents(composer.camera.matrix(800, 600))
            flagged += sum(bad for _, _, name, bad in (labels[:6] if view == "z" else labels[3:])
                           if name == "label_limit")
        # the end and the length
        wanted = sum({0: 0, 1: 2, 2: 3}[sum(letter == e[-1] for e in expected)] for letter in "XYZ")
        if told != expected or flagged != wanted:
            wrong.append(f"{seed}: told {told}, {flagged} labels, expected {expected}, {wanted}")
        warned, quiet = warned + bool(expected), quiet + (not expected)
print("\n".join(wrong) or "the same")
print("programs with and without warnings:", min(warned, quiet) > 5)
