#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Instructions of the planner's servo cycle, median and worst: cycle-bench.py PATH/tp-cycle [CYCLES].

Each call of tpRunCycle is counted by valgrind's callgrind; the first tenth of the cycles is not
counted (the first moves come in)."""
import glob
import re
import statistics
import subprocess
import sys
import tempfile


def counts(program, machine, phase, cycles):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["valgrind", "--tool=callgrind", "--toggle-collect=tpRunCycle", "--dump-after=tpRunCycle",
                        f"--callgrind-out-file={folder}/out", program, machine, phase, str(cycles)],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        out = {}
        for name in glob.glob(f"{folder}/out.*"):
            total = re.search(r"^(?:summary|totals): (\d+)", open(name).read(), re.M)
            if total:
                out[int(name.rsplit(".", 1)[1])] = int(total.group(1))
        return [out[n] for n in sorted(out)][cycles // 10:cycles]


def main():
    program, cycles = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 1500
    print(f"{'machine':10s} {'phase':8s} {'median':>8s} {'worst':>8s}  instructions of tpRunCycle")
    for machine in ("xyz", "delta", "five-axis"):
        for phase in ("idle", "moving", "jerk"):
            n = counts(program, machine, phase, cycles)
            print(f"{machine:10s} {phase:8s} {int(statistics.median(n)):8d} {max(n):8d}", flush=True)


main()
