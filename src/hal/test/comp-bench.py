#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Costs of components, for `make bench`: comp-bench.py TOP

1. Instructions of a call of pid, stepgen, encoder and limit3, one channel each, that follow a
   sine in virtual time (counted by valgrind).
2. Time in which halcompile builds one component.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

TOP = Path(sys.argv[1]).resolve()
SECONDS = 4                 # virtual
SETUP = """
loadrt siggen num_chan=1
loadrt limit3
loadrt pid num_chan=1
loadrt stepgen step_type=2,0
loadrt encoder num_chan=1
loadrt threads name1=base period1=50000 name2=servo period2=1000000
setp siggen.0.amplitude 10
setp limit3.0.maxv 40
setp limit3.0.maxa 400
setp pid.0.Pgain 20
setp pid.0.Igain 5
setp pid.0.Dgain 0.1
setp pid.0.FF1 1
setp pid.0.maxoutput 50
setp pid.0.enable 1
setp stepgen.0.position-scale 100
setp stepgen.0.maxaccel 1000
setp stepgen.0.enable 1
setp encoder.0.position-scale 100
net cmd siggen.0.sine => limit3.0.in pid.0.command stepgen.0.position-cmd
net fb encoder.0.position => pid.0.feedback
net a stepgen.0.phase-A => encoder.0.phase-A
net b stepgen.0.phase-B => encoder.0.phase-B
addf stepgen.make-pulses base
addf encoder.update-counters base
addf siggen.0.update servo
addf encoder.capture-position servo
addf limit3.0 servo
addf pid.0.do-pid-calcs servo
addf stepgen.capture-position servo
addf stepgen.update-freq servo
"""
# What is reported: module, symbol of the function in its source, thread, channels.
FUNCTIONS = {
    "pid.N.do-pid-calcs": ("pid", "do_pid_calcs", "servo", 1),
    "limit3.N": ("limit3", "__comp_call__", "servo", 1),
    "encoder.update-counters": ("encoder", "update_counters", "base", 1),
    "encoder.capture-position": ("encoder", "capture_position", "servo", 1),
    "stepgen.make-pulses": ("stepgen", "make_pulses", "base", 2),
    "stepgen.capture-position": ("stepgen", "capture_position", "servo", 2),
    "stepgen.update-freq": ("stepgen", "update_freq", "servo", 2),
}
COMPONENT = 'component bench_build "x";\npin in float a;\npin out float b;\nfunction _;\nlicense "GPL";\n;;\nb = 2 * a;\n'


def instructions(folder: Path) -> None:
    if not shutil.which("valgrind"):
        print("components: no valgrind, not measured")
        return
    env = dict(os.environ, KERF_INSTANCE="bench-comp", KERF_CLOCK="virtual", RTAPI_FIFO_PATH="/kerf-bench-comp")
    log = open(folder / "log", "w")

    def run(*words: str, program: str = "halcmd", under: tuple[str, ...] = ()) -> None:
        subprocess.run([*under, str(TOP / "bin" / program), *words], env=env, check=True, stdin=subprocess.DEVNULL,
                       stdout=log, stderr=log)

    (folder / "setup.hal").write_text(SETUP)
    run("start", program="rtapi_app", under=("valgrind", "--tool=callgrind", "--trace-children=yes",
                                             f"--callgrind-out-file={folder}/callgrind.%p"))
    beats = {}
    try:
        run("-f", str(folder / "setup.hal"))
        run("start")
        run("sleep", str(SECONDS), program="kerf-clock")
        run("stop")
        for thread in ("base", "servo"):
            beats[thread] = int(subprocess.run([str(TOP / "bin/halcmd"), "getp", f"{thread}.threadbeat"], env=env,
                                               check=True, text=True, stdout=subprocess.PIPE).stdout)
    finally:
        run("exit", program="rtapi_app")
    text = ""
    for file in folder.glob("callgrind.*"):
        text += subprocess.run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", "--auto=no", str(file)],
                               text=True, stdout=subprocess.PIPE).stdout
    for name, (module, symbol, thread, channels) in FUNCTIONS.items():
        found = re.search(rf"^\s*([\d,]+) .*[:/]{symbol}(?:'\d+)? \[.*/{module}\.so\]", text, re.M)
        if not found:
            sys.exit(f"components: no {symbol} of {module} among what valgrind counted")
        count = int(found.group(1).replace(",", ""))
        print(f"components: {name}: {count / beats[thread]:.0f} instructions a call"
              + (f" ({channels} channels)" if channels > 1 else ""))


def build_time(folder: Path) -> None:
    (folder / "bench_build.comp").write_text(COMPONENT)
    for mode in ("--preprocess", "--compile"):
        times = []
        for _ in range(5):
            begin = time.monotonic()
            subprocess.run([str(TOP / "bin/halcompile"), mode, "bench_build.comp"], cwd=folder, check=True,
                           stdout=subprocess.DEVNULL)
            times.append(time.monotonic() - begin)
        print(f"halcompile {mode}: {min(times):.2f} s, best of 5")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="kerf-bench-") as name:
        instructions(Path(name))
        build_time(Path(name))
