# SPDX-License-Identifier: GPL-2.0-or-later
import errno
import os
import shutil
import subprocess
import sys
from pathlib import Path

SCRATCH, HERE = Path(sys.argv[1]), Path.cwd()
MACHINE = SCRATCH / "machine"
POSITIONS, JOURNAL = MACHINE / "pos.txt", MACHINE / "mill.var.journal"
OLD = "".join(f"{x}\n" for x in (1.25, *[0] * 15))
CALLS = 9                    # of one write, at most


def lay():
    shutil.rmtree(MACHINE, ignore_errors=True)
    shutil.copytree(Path(os.environ["EMC2_HOME"]) / "configs/sim/mill", MACHINE)
    ini = MACHINE / "mill.ini"
    ini.write_text("\n".join(line for line in ini.read_text().splitlines() if not line.startswith("HALUI"))
                   .replace("[TRAJ]", "[TRAJ]\nPOSITION_FILE = pos.txt"))
    POSITIONS.write_text(OLD)


def session(what, failing=""):
    """One session; what its display printed."""
    display = MACHINE / "display"
    display.write_text(f"#!/bin/sh\nunset LD_PRELOAD\nexec /usr/bin/python3 {HERE}/display.py {what} > out 2>&1\n")
    display.chmod(0o755)
    task = MACHINE / "task"
    task.write_text(f"#!/bin/sh\nLD_PRELOAD={SCRATCH}/failing_writes.so FAILING_WRITES={failing} exec milltask \"$@\"\n")
    task.chmod(0o755)
    words = f"s|^TASK *=.*|TASK = {task}|"
    subprocess.run(["sed", "-i", words, MACHINE / "mill.ini"], check=True)
    subprocess.run(["linuxcnc", "-r", "-D", str(display), "mill.ini"], cwd=MACHINE, stdin=subprocess.DEVNULL,
                   capture_output=True)
    out = MACHINE / "out"
    return out.read_text() if out.exists() else "(no display)"


def positions():
    found = POSITIONS.read_text() if POSITIONS.exists() else ""
    numbers = [float(x) for x in found.split()]
    if found == OLD:
        return "old"
    return "new" if len(numbers) == 16 and abs(numbers[0] - 7.5) < 1e-6 and found.endswith("\n") else found


def record(path):
    text = path.read_text() if path.exists() else None
    if text is None:
        return "none"
    return "whole" if text.endswith("mill.ini\n") and ("\nline 0\n" in text or "\nline 2\n" in text) else text


for error in (0, errno.ENOSPC):
    found = []
    for number in range(1, CALLS + 1):
        lay()
        session("position", f"{POSITIONS}:{number}:{error}")
        found.append(positions())
    print("positions, error", error, *sorted(set(found)))
    print("next start knows where it is:", session("look").split())
for error, numbers in ((0, range(1, 2 * CALLS)), (errno.ENOSPC, (1, 2, 4, 7))):
    found = []
    for number in numbers:
        lay()
        POSITIONS.unlink()
        session("journal", f"{JOURNAL}:{number}:{error}")
        found.append(record(JOURNAL))
    print("journals, error", error, *sorted(set(found)))
    print("next start knows the run:", session("look").split())
