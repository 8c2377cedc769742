#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Each component of src/hal is run by a table, or by the test named here, and has a
manual page that names all its functions, pins and parameters, with types and directions."""

from __future__ import annotations

import re
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, "..")
from harness import Session  # noqa: E402
from tables import read  # noqa: E402

TOP = Path("../../..").resolve()
FOLDERS = ["src/hal/components/*.comp", "src/hal/components/*.c"]
ELSEWHERE = ["src/hal/threads.c", "src/hal/stream/sampler.c", "src/hal/stream/streamer.c"]
# Tested elsewhere.
OTHER = {
    "histobinstream": "tests/components/histograms-stream-to-programs",
    "latencybinstream": "tests/components/histograms-stream-to-programs",
    "message": "tests/components/messages-are-printed",
    "pushmsg": "tests/components/messages-are-printed",
    "plasmac": "tests/components/plasmac-cuts",
    "raster": "tests/components/raster-follows-its-program",
    "sampler": "tests/hal/sampler-and-streamer-move-values-cycle-by-cycle",
    "sim_joint": "tests/homing",
    "streamer": "tests/hal/sampler-and-streamer-move-values-cycle-by-cycle",
    "thermistor": "tests/components/thermistor-measures",
    "threads": "tests/hal/threads-are-made-as-asked",
}
# What C components need to show all their pins.
LOADS = {
    "boss_plc": ["debug=1"], "counter": [], "debounce": ["cfg=2"], "demux_generic": ["config=bb4,ff2,su2,us2"],
    "encoder": [], "encoder_ratio": [], "enum": ["enums=E;A;B,D;C"], "lcd": ["fmt_strings=%f%d%u%b10"],
    "matrix_kb": ["config=2x2s"], "mux_generic": ["config=bb4,ff2,su2,us2"], "pid": ["debug=1"],
    "pushmsg": ["msgs=i|name|text {f:value}"], "pwmgen": ["output_type=0,1,2"], "siggen": [],
    "sampler": ["depth=4", "cfg=fbsulk"], "sim_encoder": [], "spindle": ["numgears=2"],
    "stepgen": ["step_type=0,1,2,11", "ctrl_type=p,v,p,p"],
    "streamer": ["depth=4", "cfg=fbsulk"], "supply": [], "threads": ["name1=a", "name2=b", "period2=2000000"],
    "watchdog": ["num_inputs=2"], "weighted_sum": ["wsum_sizes=2"],
}
DIRECTION = {"IN": "in", "OUT": "out", "I/O": "io", "RO": "r", "RW": "rw"}
mistakes: list[str] = []


def documented(page: str) -> list[tuple[re.Pattern[str], str]]:
    """Pattern of the name, and what follows it, of each item of an AsciiDoc page."""
    found = []
    for line in re.findall(r"^(\*\*.*|__.*)::$", page, re.M):
        parts = re.match(r"((?:\*\*.*?\*\*|__.*?__)+)(.*)", line)
        pattern = "".join("[^.]+?" if p.startswith("__") else re.escape(p[2:-2])
                          for p in re.findall(r"\*\*.*?\*\*|__.*?__", parts.group(1)))
        found.append((re.compile(pattern), parts.group(2).split("(default")[0].strip()))
    return found


def check_page(name: str, folder: str) -> None:
    items = documented((TOP / f"src/hal/components/man/{name}.adoc").read_text())
    session = Session(name)
    try:
        session.command(folder, "realtime", "start")
        status, _, errors = session.command(folder, "halcmd", "loadrt", name, *LOADS[name])
        if status:
            mistakes.append(f"{name}: does not load: {errors}")
        for kind in ("pin", "param", "funct"):
            for line in session.command(folder, "halcmd", "-s", "show", kind)[1].splitlines():
                words = line.split()
                if len(words) < 5 or re.search(r"\.(time|tmax|tmax-increased)$", words[4]):
                    continue
                full = words[-1] if kind == "funct" else words[4]
                want = "" if kind == "funct" else f"{words[1]} {DIRECTION[words[2]]}"
                if not any(p.fullmatch(full) and text in (want, want.replace(words[1], "type", 1))
                           for p, text in items):
                    mistakes.append(f"{name}: the page does not name {kind} {full} {want}")
    finally:
        session.command(folder, "realtime", "stop")


def main() -> int:
    sources = {p.stem: p for folder in FOLDERS for p in sorted(TOP.glob(folder))}
    sources |= {Path(name).stem: TOP / name for name in ELSEWHERE}
    tested = {t.module for path in Path("..").glob("*/*.table") for t in read(str(path))}
    for name, source in sources.items():
        section = 1 if "option userspace" in source.read_text() else 9
        if not (TOP / f"docs/build/man/man{section}/{name}.{section}").exists():
            mistakes.append(f"{name}: no manual page")
        if name not in tested and not (name in OTHER and (TOP / OTHER[name]).is_dir()):
            mistakes.append(f"{name}: no table in tests/components")
    with tempfile.TemporaryDirectory() as folder:
        for name in sorted(n for n, s in sources.items() if s.suffix == ".c"):
            if name in LOADS:
                check_page(name, folder)
            else:
                mistakes.append(f"{name}: not among LOADS of this test")
    print("\n".join(mistakes) or "all have")
    return bool(mistakes)


if __name__ == "__main__":
    sys.exit(main())
