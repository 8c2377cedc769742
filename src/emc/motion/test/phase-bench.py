#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Instructions of a servo cycle by phase, for `make bench`: phase-bench.py TOP

Runs motmod under valgrind in virtual time, idle and on short lines with blends, on an XYZ, a
linear delta and a five-axis machine; prints the mean per cycle of motion-controller and of each
phase (planner and kinematics, which the position phase calls, apart as well).
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

TOP = Path(sys.argv[1]).resolve()
CYCLES = 3000
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
        pos = [at[0] + 20 * math.sin(n / 10), at[1] + 20 * math.cos(n / 7), at[2] + 2 * math.sin(n / 3), *at[3:]]
        m.send(km.SET_LINE, pos=pos, vel=20, ini_maxvel=50, acc=500, ini_maxjerk=1e9, id=n, motion_type=2, turn=-1)
    m.sleep(0.01)
print('cycles', m.status()['heartbeat'])
m.close()
"""
NAMES = ("motion_controller", "motion_command_handler", "phase_[a-z_]+", "read_homing_in_pins", "write_homing_out_pins",
         "spindle_index", "tpRunCycle", "kinematicsInverse", "kinematicsForward")


def measure(machine: str, moving: bool, folder: Path) -> dict[str, float]:
    env = dict(os.environ, KERF_INSTANCE="bench-motion", KERF_CLOCK="virtual", KERF_CLOCK_HANG_S="600",
               MOTION_BENCH_UNDER=f"valgrind --tool=callgrind --callgrind-out-file={folder}/callgrind.%p",
               PYTHONPATH=f"{TOP}/tests/motion/lib:{TOP}/lib/python", PATH=f"{TOP}/scripts:{TOP}/bin:{os.environ['PATH']}")
    script = DRIVER.format(machine=MACHINES[machine], cycles=CYCLES, moving=moving)
    out = subprocess.run(["/usr/bin/python3", "-c", script], env=env, check=True, capture_output=True, text=True).stdout
    cycles = int(re.search(r"cycles (\d+)", out)[1])
    counts: dict[str, float] = {}
    for f in folder.glob("callgrind.*"):
        text = subprocess.run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", str(f)], check=True,
                              capture_output=True, text=True).stdout
        for ir, name in re.findall(rf"^ *([\d,]+) \([^)]*\)\s+\S*?:({'|'.join(NAMES)})(?:'\d+)?(?: |$)", text, re.M):
            counts[name] = max(counts.get(name, 0), int(ir.replace(",", "")) / cycles)
        f.unlink()
    return counts


def main() -> None:
    if not shutil.which("valgrind"):
        print("motion: no valgrind, not measured")
        return
    with tempfile.TemporaryDirectory() as folder:
        columns = [(m, moving) for m in MACHINES for moving in (False, True)]
        found = {c: measure(*c, Path(folder)) for c in columns}
    print("instructions of a servo cycle, mean" + "".join(f"{m + (' moving' if on else ' idle'):>14}" for m, on in columns))
    names = sorted({n for counts in found.values() for n in counts}, key=lambda n: -max(c.get(n, 0) for c in found.values()))
    for name in names:
        print(f"{name:35}" + "".join(f"{found[c].get(name, 0):14.0f}" for c in columns))


main()
