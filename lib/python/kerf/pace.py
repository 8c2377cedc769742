# SPDX-License-Identifier: GPL-2.0-or-later
"""How much of a long path a picture draws at once: what the computer does in the time that there is for it.

While the view turns a frame has `budget` vertices; afterwards the exact picture is drawn in slices of `slice` vertices,
between which the screen does its other work. Both are learned from the seconds that the last ones took.
"""

FRAME_S, SLICE_S = 1 / 50, 0.05
LEAST_BUDGET, FIRST_BUDGET, MOST_BUDGET = 500, 40000, 400000
LEAST_SLICE, FIRST_SLICE, MOST_SLICE = 1000, 8000, 200000


class Pace:
    def __init__(self):
        self.budget, self.slice = FIRST_BUDGET, FIRST_SLICE

    def frame_took(self, seconds, exact):
        """exact: nothing was left out."""
        if exact and seconds < FRAME_S:
            return                   # nothing is learned
        factor = min(1.3, max(0.3, FRAME_S / max(seconds, 1e-4)))
        self.budget = int(min(MOST_BUDGET, max(LEAST_BUDGET, self.budget * factor)))

    def slice_took(self, seconds):
        factor = min(2.0, max(0.25, SLICE_S / max(seconds, 1e-4)))
        self.slice = int(min(MOST_SLICE, max(LEAST_SLICE, self.slice * factor)))

    def slices(self, first, count):
        """Pieces (first entries and counts, as kerf_raster.Drawing.choose() gives them) in portions."""
        self.slice = max(LEAST_SLICE, min(self.slice, int(self.budget * SLICE_S / FRAME_S)))
        part, left = ([], []), self.slice
        for f, n in zip(first, count):
            while n > 1:
                take = min(n, left)
                if take > 1:
                    part[0].append(f)
                    part[1].append(take)
                    left -= take
                    f, n = f + take - 1, n - take + 1
                if left <= 1:
                    yield part
                    part, left = ([], []), self.slice
        if part[0]:
            yield part
