# SPDX-License-Identifier: GPL-2.0-or-later
"""latency-test: longest interval and jitter of one or two threads, in a window or as lines.

Runs a HAL session of its own through halrun: threads fast and slow, a timedelta in each, a
component `lat` with the pins that show them (max interval sl bl, jitter sj bj, last interval
st bt; reset). Afterwards the worst jitter ever seen is kept in ~/.latency. Times are ns.
"""

import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from .. import clock, files
from .periods import two_periods
from .session import Platform, ToolError, realtime_running

USAGE = """Usage: latency-test [base-period [servo-period]]
       latency-test period

Periods are numbers with s, ms, us or ns (below 1000 without a unit: us); '-' for no such
thread. One period: a servo thread only. Default: 25us 1ms.
Options: --nox prints a line a second instead of a window, --seconds N ends after N seconds.
"""
PANEL_PINS = ("sl", "sj", "st", "bl", "bj", "bt")


def session_text(base_ns: int, servo_ns: int, panel: str) -> str:
    """The .hal file of the session."""
    lines = []
    if base_ns:
        lines.append(f"loadrt threads name1=fast period1={base_ns} name2=slow period2={servo_ns}")
        threads = (("b", 0, "fast"), ("s", 1, "slow"))
    else:
        lines.append(f"loadrt threads name1=slow period1={servo_ns}")
        threads = (("s", 0, "slow"),)
    lines.append(f"loadrt timedelta count={len(threads)}")
    lines += [f"addf timedelta.{n} {thread}" for _, n, thread in threads]
    lines.append(f"loadusr -Wn lat {panel}")
    for letter, n, _ in threads:
        lines.append(f"net {letter}l timedelta.{n}.max => lat.{letter}l")
        lines.append(f"net {letter}j timedelta.{n}.jitter => lat.{letter}j")
        lines.append(f"net {letter}t timedelta.{n}.out => lat.{letter}t")
    resets = " ".join(f"timedelta.{n}.reset" for _, n, _ in threads)
    lines += [f"net reset lat.reset => {resets}", "start", "waitusr lat", ""]
    return "\n".join(lines)


def keep_worst(path: Path, jitter_ns: int) -> int:
    """Writes the larger of the kept and the given jitter; returns it."""
    try:
        worst = int(path.read_text().split()[0])
    except FileNotFoundError:
        worst = 0
    except (OSError, ValueError, IndexError):
        print(f"latency-test: {path} holds no number of nanoseconds", file=sys.stderr)
        worst = 0
    worst = max(worst, jitter_ns)
    files.replace(path, f"{worst}\n")
    return worst


def end_panel():
    """Ends the panel, also one that is just starting, and with it the session in order; for as
    long as this program runs."""
    while True:
        subprocess.run(["halcmd", "unloadusr", "lat"], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL, check=False)
        time.sleep(0.2)


def main(arguments: list[str]) -> int:
    nox, seconds, words = False, 0, []
    rest = list(arguments)
    while rest:
        word = rest.pop(0)
        if word in ("-h", "--help"):
            print(USAGE, end="")
            return 0
        if word == "--nox":
            nox = True
        elif word == "--seconds" and rest and rest[0].isdigit():
            seconds = int(rest.pop(0))
        elif word.startswith("-") and word != "-":
            print(USAGE, end="", file=sys.stderr)
            return 1
        else:
            words.append(word)
    try:
        base_ns, servo_ns = two_periods(words)
    except ValueError as problem:
        print(f"latency-test: {problem}", file=sys.stderr)
        return 1
    if not nox and not os.environ.get("DISPLAY"):
        print("latency-test: no DISPLAY: printing a line a second (as with --nox)", file=sys.stderr)
        nox = True
    try:
        if realtime_running():
            raise ToolError("Realtime is running already: end the running session first (halrun -U)")
        print(Platform().banner(), flush=True)
    except ToolError as problem:
        print(f"latency-test: {problem}", file=sys.stderr)
        return 1
    with tempfile.TemporaryDirectory() as folder:
        worst = Path(folder) / "worst"
        panel = (f"{sys.executable} -m kerf.haltools.latency_panel {'--nox ' if nox else ''}"
                 f"--seconds {seconds} --worst {worst} {base_ns} {servo_ns}")
        script = Path(folder) / "lat.hal"
        script.write_text(session_text(base_ns, servo_ns, panel))
        python = str(Path(__file__).resolve().parents[2])
        env = dict(os.environ, PYTHONPATH=os.pathsep.join(
            p for p in (python, os.environ.get("PYTHONPATH")) if p))
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, lambda *_: threading.Thread(target=end_panel, daemon=True).start())
        status = clock.run(["halrun", "-f", str(script)], env=env).returncode
        if worst.exists():
            kept = keep_worst(Path.home() / ".latency", int(worst.read_text()))
            print(f"worst jitter of this run: {worst.read_text().strip()} ns, ever: {kept} ns (~/.latency)")
    return status
