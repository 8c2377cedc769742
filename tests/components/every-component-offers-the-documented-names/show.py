#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Loads every realtime component, with options and without, and prints the names, types,
directions and defaults of its pins and parameters, and its functions, to be compared with
what is documented for configurations: none may ever change.

A line for each instance: `LOAD | INSTANCE: NAME TYPE DIRECTION[=DEFAULT], ... | FUNCTIONS`,
types and directions as in the manual pages, defaults of 0 left out; `..N`: N numbered alike.
A load that fails prints what it says, and its error."""

from __future__ import annotations

import re
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, "..")
from harness import Session  # noqa: E402

TOP = Path("../../..").resolve()
# What to load components with; those without a line are loaded as they are.
LOADS = {
    "bldc": ["cfg=nha,q,qi,i", "cfg=f,h,n", "cfg=nB,n6,nB6,nH,nF", ""],
    "bitmerge": ["personality=3", ""], "bitslice": ["personality=3"],
    "boss_plc": ["", "debug=1 count=2"],
    "carousel": ["", "pockets=8,24,6 encoding=gray,index,single num_sense=4 dir=1"],
    "counter": ["", "num_chan=2", "num_chan=9"], "debounce": ["cfg=2,1", "", "cfg=51"],
    "demux": ["", "personality=2"],
    "demux_generic": ["config=bb4,ff2,su2,us3", ""], "mux_generic": ["config=bb4,ff2,su2,us3", "", "config=b1", "config=ff", "config=8", "config=ffb8"],
    "encoder": ["", "names=a,b", "num_chan=1 names=a", "num_chan=9"],
    "encoder_ratio": ["", "num_chan=2", "names=a"], "enum": ["enums=E;A;B;;C,D;X;Y", "enums=E;A names=key"],
    "gantry": ["personality=2"], "histobinstream": ["keys=777"], "joint_axis_mapper": ["coord=xyy", ""],
    "latencybinstream": ["keys=778"], "lcd": ["fmt_strings=%f%d|%u%b10,%x"], "limit_axis": ["", "personality=3"],
    "lincurve": ["", "personality=3"], "logic": ["personality=0x1f02,0x103"],
    "matrix_kb": ["config=2x2s,2x11", "config=1x2 names=keys", "config=2", "config=3x40s",
                  "config=1x2,2x1 names=a"], "max31855": ["personality=2"],
    "message": ["names=a messages=text"], "modmath": ["", "mod_dir=2"], "moveoff": ["names=mv personality=2", ""],
    "multiswitch": ["", "cfg=2,3"], "output_buffer": ["personality=2"], "pid": ["", "num_chan=1 debug=1", "names=x"],
    "pushmsg": ["msgs=i|name|text.{f:value}", ""], "pwmgen": ["output_type=0,1,2", "", "output_type=3"],
    "radiobutton": ["personality=2"], "sampler": ["depth=4,4 cfg=fbsulk,r", "", "depth=4 cfg=x"],
    "siggen": ["", "num_chan=2", "names=wave"], "sim_encoder": ["", "names=a"], "sim_parport": ["names=parport.0"],
    "spindle": ["", "numgears=2", "numgears=17"],
    "stepgen": ["step_type=0,1,2,4,5,11 ctrl_type=p,v,,V", "step_type=15 user_step_type=1,2", "", "step_type=16",
                "step_type=0 ctrl_type=x"],
    "streamer": ["depth=4 cfg=fbsulk", ""], "supply": ["", "num_chan=2", "num_chan=0"],
    "watchdog": ["num_inputs=2", "", "num_inputs=33"], "weighted_sum": ["wsum_sizes=2,1", "", "wsum_sizes=0,1", "wsum_sizes=1,-1"],
    "classicladder_rt": ["", "numPhysInputs=2 numPhysOutputs=1 numS32in=1 numS32out=1 numFloatIn=1 numFloatOut=1"],
}
ALSO = ["classicladder_rt", "sampler", "streamer"]
DIRECTION = {"IN": "in", "OUT": "out", "I/O": "io", "RO": "r", "RW": "rw"}
ZERO = {"FALSE", "0", "0x00000000"}


def components() -> list[str]:
    folder = TOP / "src/hal/components"
    own = [p.stem for p in folder.iterdir() if p.suffix == ".c"
           or p.suffix == ".comp" and "option userspace" not in p.read_text()]
    converters = [p.stem for p in (TOP / "rtlib").glob("conv_*.so")]
    return sorted(own + converters + ALSO)


def instance(name: str, prefixes: set[str]) -> tuple[str, str]:
    """A full name, split after its instance: a function's name, or the module's and a number."""
    for prefix in sorted(prefixes, key=len, reverse=True):
        if name.startswith(prefix + "."):
            return prefix, name[len(prefix) + 1:]
    start, _, rest = name.partition(".")
    number, _, end = rest.partition(".")
    return (f"{start}.{number}", end) if number.isdigit() and end else (start, rest)


def folded(items: list[str]) -> list[str]:
    """`in-00 bit in, in-01 bit in` as `in-00..2 bit in`: runs whose names differ in one number."""
    out: list[str] = []
    last, count = None, 0
    for item in items:
        name, rest = item.split(" ", 1)
        number = re.search(r"\d+(?!.*\d)", name)
        key = number and (name[:number.start()], len(number[0]), name[number.end():], rest)
        if key and last and key == last[0] and int(number[0]) == last[1] + 1:
            last, count = (key, last[1] + 1), count + 1
            begin, end = out[-1].split(" ", 1)
            out[-1] = f"{begin.split('..')[0]}..{count} {end}"
        else:
            out.append(item)
            last, count = (key, int(number[0])) if key else None, 1
    return out


def host_output(folder: str) -> str:
    """What the realtime host has printed; it was started by the first command."""
    return Path(folder, "0.err").read_text()


def show(session: Session, folder: str, name: str, options: str) -> None:
    load = f"{name} {options}".strip()
    said = len(host_output(folder))
    if session.command(folder, "halcmd", "loadrt", name, *options.split())[0]:
        says = host_output(folder)[said:]
        number = re.search(r"rtapi_app_main: .* (\(-\d+\))", says)
        print(f"{load} | fails: {says.splitlines()[0]} {number[1] if number else ''}".rstrip())
        return
    functions = [line.split()[-1] for line in session.command(folder, "halcmd", "-s", "show", "funct")[1].splitlines()
                 if len(line.split()) > 4]
    found: dict[str, list[str]] = {}
    for kind in ("pin", "param"):
        for line in session.command(folder, "halcmd", "-s", "show", kind)[1].splitlines():
            words = line.split()
            if len(words) < 5 or words[2] not in DIRECTION or re.search(r"\.(time|tmax|tmax-increased)$", words[4]):
                continue
            start, rest = instance(words[4], set(functions))
            value = "" if words[3] in ZERO else f"={words[3]}"
            found.setdefault(start, []).append(f"{rest} {words[1]} {DIRECTION[words[2]]}{value}")
    for start, items in found.items():
        own = [f for f in functions if f == start or f.startswith(start + ".")]
        functions = [f for f in functions if f not in own]
        print(f"{load} | {start}: {', '.join(folded(items))} | {' '.join(own)}".rstrip(" |"))
    if functions:
        print(f"{load} | functions {' '.join(functions)}")
    session.command(folder, "halcmd", "unloadrt", name)


def main() -> None:
    session = Session()
    with tempfile.TemporaryDirectory() as folder:
        session.command(folder, "realtime", "start")
        try:
            for name in components():
                for options in LOADS.get(name, [""]):
                    show(session, folder, name, options)
        finally:
            session.command(folder, "realtime", "stop")


if __name__ == "__main__":
    main()
