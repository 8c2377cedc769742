#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Costs of HAL and of the realtime host, for `make bench`: hal-bench.py TOP [SECONDS]

1. Time to make and connect 1,000, 10,000 and 100,000 pins (objects/test/hal-bench).
2. Instructions of a thread's cycle: of 100 empty functions and of one and2, as differences
   between sessions counted by valgrind in virtual time.
3. Wake-up lateness of a 1 ms thread beside cyclictest (package rt-tests) for SECONDS (20).
   Both with SCHED_FIFO where that is allowed; other load on the machine counts in both.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

TOP = Path(sys.argv[1]).resolve()
SECONDS = int(sys.argv[2]) if len(sys.argv) > 2 else 20
EMPTY = """
#include "rtapi.h"
#include "rtapi_app.h"
#include "hal.h"
MODULE_LICENSE("GPL");
static int id;
static void empty(void *arg, long period) { (void)arg; (void)period; }
int rtapi_app_main(void)
{
    int r = id = hal_init("empties");
    for (int i = 0; i < 100 && r >= 0; i++) r = hal_export_functf(empty, 0, 0, 1, id, "empty.%02d", i);
    return r < 0 ? r : hal_ready(id);
}
void rtapi_app_exit(void) { hal_exit(id); }
"""


class Session:
    """A host of its own in a small tree, so that modules of ours can be loaded."""

    def __init__(self, folder: Path, clock: str):
        self.folder = folder
        self.env = dict(os.environ, KERF_INSTANCE="bench", KERF_CLOCK=clock, RTAPI_FIFO_PATH="/kerf-bench",
                        LINUXCNC_FORCE_REALTIME="1")

    def app(self, *words, under=()):
        with open(self.folder / "log", "a") as log:
            subprocess.run([*under, str(self.folder / "bin/rtapi_app"), *words], env=self.env, stdout=log, stderr=log,
                           stdin=subprocess.DEVNULL, check=True)

    def halcmd(self, *words) -> str:
        return subprocess.run([str(TOP / "bin/halcmd"), *words], env=self.env, check=True, text=True,
                              stdout=subprocess.PIPE).stdout

    def sleep(self, seconds):
        subprocess.run([str(TOP / "bin/kerf-clock"), "sleep", str(seconds)], env=self.env, check=True)

    def end(self):
        self.app("exit")


def small_tree(folder: Path):
    for name in ("bin", "rtlib", "scripts"):
        (folder / name).mkdir()
    shutil.copy2(TOP / "bin/rtapi_app", folder / "bin")
    for module in ("hal_lib", "threads", "and2", "lateness"):
        shutil.copy2(TOP / f"rtlib/{module}.so", folder / "rtlib")
    (folder / "empties.c").write_text(EMPTY)
    subprocess.run([*os.environ.get("CC", "gcc").split(), "-O2", "-std=gnu11", "-fPIC", "-shared",
                    "-DRTAPI", "-DUSPACE", f"-I{TOP}/include", "-o", folder / "rtlib/empties.so", folder / "empties.c"],
                    check=True)


def cycle_instructions(folder: Path, functions: list[str]) -> tuple[int, int]:
    """Instructions of a session with these functions in the thread, and its cycles."""
    out = folder / "callgrind"
    s = Session(folder, "virtual")
    s.app("start", under=("valgrind", "--tool=callgrind", "--trace-children=yes", f"--callgrind-out-file={out}.%p"))
    try:
        s.app("load", "threads", "name1=t", "period1=1000000")
        s.app("load", "empties")
        s.app("load", "and2", "count=100")
        for f in functions:
            s.halcmd("addf", f, "t")
        s.halcmd("start")
        s.sleep(4)
        s.halcmd("stop")
        cycles = int(s.halcmd("getp", "t.threadbeat"))
    finally:
        s.end()
    total = 0
    for file in folder.glob("callgrind.*"):
        total = max(total, *(int(n) for n in re.findall(r"^(?:totals|summary): (\d+)", file.read_text(), re.M)), 0)
        file.unlink()
    return total, cycles


def instructions(folder: Path):
    if not shutil.which("valgrind"):
        print("cycle: no valgrind, not measured")
        return
    none, beats = cycle_instructions(folder, [])
    # A hundred of each, as what the threads do beside (waiting for their turn) differs by about a thousand a cycle.
    for title, name, share in (("100 empty functions", "empty.{:02d}", 1), ("one and2 (of 100)", "and2.{}", 100)):
        total, cycles = cycle_instructions(folder, [name.format(i) for i in range(100)])
        print(f"cycle: {title}: {(total - none * cycles // beats) / cycles / share:.0f} instructions more than "
              "an empty thread's")


def wake_up(folder: Path):
    s = Session(folder, "real")
    s.app("start")
    try:
        s.app("load", "threads", "name1=t", "period1=1000000")
        s.app("load", "lateness", "names=t")
        s.halcmd("addf", "lateness.t", "t")
        s.halcmd("start")
        test = None
        if shutil.which("cyclictest"):
            policy = ["-p", "98"] if os.geteuid() == 0 else []
            test = subprocess.Popen(["cyclictest", "-q", "-m", *policy, "-i", "1000", "-D", str(SECONDS)], text=True,
                                    stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        s.halcmd("setp", "lateness.t.reset", "1")
        s.sleep(SECONDS)
        value = lambda pin: int(s.halcmd("getp", f"lateness.t.{pin}"))
        bins = [value(f"bin-{i:02d}") for i in range(16)]
        below, middle = 0, 0
        for i, n in enumerate(bins):
            below += n
            if below * 2 >= sum(bins):
                middle = i
                break
        print(f"wake-up: 1 ms thread: {value('cycles')} cycles, half of them below {2 ** (middle + 10) / 1000:.1f} us, "
              f"worst {value('worst') / 1000:.1f} us, {value('overruns')} overruns")
        print("         bins (from 1 us, doubling):", " ".join(map(str, bins)))
        if test is None:
            print("wake-up: no cyclictest (package rt-tests), nothing to compare with")
        else:
            lines = [line for line in test.communicate()[0].splitlines() if "Max:" in line] or ["no result"]
            print("wake-up: cyclictest:", lines[-1])
    finally:
        s.end()


def main():
    env = dict(os.environ, KERF_INSTANCE="bench")
    subprocess.run([TOP / "objects/test/hal-bench", "1000", "10000", "100000"], env=env, check=True)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        small_tree(folder)
        instructions(folder)
        wake_up(folder)


if __name__ == "__main__":
    main()
