#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Instructions of a servo cycle by phase, for `make bench`: phase-bench.py TOP

Runs motmod under valgrind in virtual time, idle and on short lines with blends, on an XYZ, a
linear delta and a five-axis machine; prints per cycle of motion-controller and of each phase
(planner and kinematics, which the position phase calls, apart as well) median and worst.
"""
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

TOP = Path(sys.argv[1]).resolve()
CYCLES = 600
BEGIN = 50  # dumps left out: what runs once
MACHINES = {
    "xyz": "Machine()",
    "delta": "Machine(kins='lineardeltakins', low=-1000, high=1000)",
    "five": "Machine(joints=6, kins='5axiskins', axes='xyzbcw')",
}
DRIVER = """
import math
import kerf_motion as km
import motion_bench
from motion_bench import Machine
m = {machine}
m.mode(km.COORD)
at = m.status()['carte_pos_cmd']
n = 0
end = m.now() + {cycles} * 0.001
while m.now() < end:
    while {moving} and m.status()['depth'] < 40:
        n += 1
        pos = [at[0] + 20 * math.sin(n / 60), at[1] + 20 * math.cos(n / 45), at[2] + 2 * math.sin(n / 20), *at[3:]]
        m.send(km.SET_LINE, pos=pos, vel=40, ini_maxvel=50, acc=500, ini_maxjerk=1e9, id=n, motion_type=2, turn=-1)
    m.sleep(0.01)
print('cycles', m.status()['heartbeat'])
m.close()
"""
NAMES = ("motion_controller", "motion_command_handler", "phase_[a-z_]+", "read_homing_in_pins", "write_homing_out_pins",
         "spindle_index", "tpRunCycle", "kinematicsInverse", "kinematicsForward")


def one_cycle(dump: Path, names: dict[str, str]) -> dict[str, int]:
    """Instructions of each function of a dump, with what it calls; names: of functions by number, kept over dumps."""
    counts: dict[str, int] = {}
    callee = ""
    costs = False
    for line in dump.read_text().splitlines():
        if line.startswith(("cfn=", "fn=")):
            number, _, name = line.partition("=")[2].partition(" ")
            if name:
                names[number] = name
            if line.startswith("c"):
                callee = names.get(number, "")
        elif line.startswith("calls="):
            costs = True
        elif costs:
            counts[callee] = counts.get(callee, 0) + int(line.split()[-1])
            costs = False
    return counts


def measure(machine: str, moving: bool, folder: Path) -> dict[str, list[int]]:
    """Instructions in each cycle, by function."""
    env = dict(os.environ, KERF_INSTANCE="bench-motion", KERF_CLOCK="virtual", KERF_CLOCK_HANG_S="600",
               MOTION_BENCH_UNDER=f"valgrind --tool=callgrind --dump-after=motion_controller "
                                  f"--callgrind-out-file={folder}/dump",
               PYTHONPATH=f"{TOP}/tests/motion/lib:{TOP}/lib/python",
               PATH=f"{TOP}/scripts:{TOP}/bin:{os.environ['PATH']}")
    script = DRIVER.format(machine=MACHINES[machine], cycles=CYCLES, moving=moving)
    subprocess.run(["/usr/bin/python3", "-c", script], env=env, check=True, capture_output=True, text=True)
    cycles: dict[str, list[int]] = {}
    names: dict[str, str] = {}
    dumps = sorted(folder.glob("dump.*"), key=lambda f: int(f.suffix[1:]) if f.suffix[1:].isdigit() else 0)
    first = len(dumps) - CYCLES + BEGIN  # before: start, homing, change of mode
    for n, f in enumerate(dumps):
        counts = one_cycle(f, names)
        f.unlink()
        if n < first:
            continue
        for name, count in counts.items():
            name = name.split("'")[0]
            if re.fullmatch("|".join(NAMES), name):
                cycles.setdefault(name, []).append(count)
    return cycles


def main() -> None:
    if not shutil.which("valgrind"):
        print("motion: no valgrind, not measured")
        return
    columns = [(m, moving) for m in MACHINES for moving in (False, True)]
    found = {}
    for c in columns:
        with tempfile.TemporaryDirectory() as folder:
            found[c] = measure(*c, Path(folder))
    print("instructions of a servo cycle, median / worst"
          + "".join(f"{m + (' moving' if on else ' idle'):>16}" for m, on in columns))
    names = sorted({n for cycles in found.values() for n in cycles},
                   key=lambda n: -max(statistics.median(c.get(n, [0])) for c in found.values()))
    for name in names:
        print(f"{name:45}" + "".join(f"{statistics.median(v):8.0f} /{max(v):6d}"
                                     for v in (found[c].get(name, [0]) for c in columns)))


main()
