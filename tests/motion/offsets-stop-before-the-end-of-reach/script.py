# SPDX-License-Identifier: GPL-2.0-or-later
"""External offsets of a linear delta towards the end of the arms' reach, where a joint moves without bound for a step
of the tool: they stop before it within the joints' limits, come back, and start there again."""
import kerf_motion as km
from fuzz import machine

for letter, x, y in (("y", 0, -100), ("x", 90, -20), ("y", 0, -138.2), ("y", 0, -138.27)):
    for jerk in (0.0, 5000.0):
        m = machine("delta", jerk, 0.3)
        m.set(f"axis.{letter}.eoffset-scale", 0.1)
        m.set(f"axis.{letter}.eoffset-enable", 1)
        m.mode(km.COORD)
        m.line(x, y, 0, vel=30)
        m.rest()
        m.reset_limits()
        way = 0
        for counts in (-400 if letter == "y" else 400, 0, -600 if letter == "y" else 600, 0):
            m.set(f"axis.{letter}.eoffset-counts", counts)
            m.sleep(25)
            way = max(way, abs(m.get(f"axis.{letter}.eoffset")))
        print(letter, x, y, f"jerk {jerk:g}", "beyond:", m.violations(), "moved:", way > 1,
              "stopped before:", way < 59.9, "came back:", abs(m.get(f"axis.{letter}.eoffset")) < 1e-6)
        m.close()
