# SPDX-License-Identifier: GPL-2.0-or-later
"""property.py FIRST-LAST [MACHINE ...]: random sequences with these seeds on every machine of fuzz.py, with and without
jerk limits and external offsets. Prints each finding and, at the end or when interrupted, how many sequences of each
machine were run. A seed is found again with the seeds of its chunk before it. `make property SEEDS=1-2000`."""
import signal
import sys
from collections import Counter

from fuzz import WEIGHTS, Sequence, fuzz, machine

CHUNK = 25  # sequences on one machine before it is started anew

first, last = (int(word) for word in sys.argv[1].split("-"))
names = sys.argv[2:] or ["xyz", "gantry", "delta", "five"]
run, found = Counter(), Counter()
signal.signal(signal.SIGTERM, lambda *_: sys.exit("ended early"))
try:
    for chunk in range(first, last + 1, CHUNK):
        for kind in [(name, jerk, ratio) for name in names for jerk in (0.0, 5000.0) for ratio in (0.0, 0.3)]:
            m = machine(*kind)
            weights = dict(WEIGHTS, eoffset=10) if kind[2] else WEIGHTS
            for seed in range(chunk, min(chunk + CHUNK, last + 1)):
                problems, _ = fuzz(m, seed, weights, Sequence)
                run[kind] += 1
                if problems:
                    found[kind] += 1
                    print(*kind, problems, flush=True)
                    m.close()
                    m = machine(*kind)
            m.close()
finally:
    for kind, count in run.items():
        print("{} jerk {:g} offsets {:g}: {} sequences, {} with findings".format(*kind, count, found[kind]))
sys.exit(bool(found))
