# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs one program on a machine without a screen, and reports what it did.

`kerf-run` starts the launcher in a copy of the configuration's folder with this module
as its display. The display homes the machine, runs the program and measures: cycle
time, distances, and for each joint the highest velocity, acceleration and jerk against
its limits (component limitcheck, every servo cycle). Units: machine units and seconds.
"""

import argparse
import array
import json
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from . import clock
from .attendant import Attendant
from .inivalues import IniError, IniValues
from .tree import Tree

POLL_S = 0.05          # of the controller's clock, between looks at the status
SAMPLE_S = 0.010       # period of the samples of the path
READY_S = 20.0         # for the machine to answer
PATIENCE_S = 300.0     # of the controller's clock, for a program that does not go on


class RunError(Exception):
    """Ends the run with exit status 1; the text is for the user."""


def tool_lines(ini, folder):
    """Lines of the machine's tool table, from its file or its database program."""
    program = ini.get("EMCIO", "DB_PROGRAM")
    try:
        if not program:
            return (folder / (ini.get("EMCIO", "TOOL_TABLE") or "tool.tbl")).read_text(errors="replace").splitlines()
        done = subprocess.run(program.split(), cwd=folder, input="g\n", stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, text=True, timeout=READY_S)
        return done.stdout.splitlines()
    except (OSError, subprocess.SubprocessError):
        return []


def read_tools(ini, folder):
    """Tools of a machine as the interpreter takes them: number, nine offsets, diameter, two angles, orientation."""
    tools = [(0, *[0.0] * 12, 0)]        # the spindle
    for line in tool_lines(ini, folder):
        words = {m[1].upper(): float(m[2]) for m in re.finditer(r"([A-Za-z])\s*([+-]?[\d.]+)", line.split(";")[0])}
        if "T" in words:
            tools.append((int(words["T"]), *(words.get(c, 0.0) for c in "XYZABCUVWDIJ"), int(words.get("Q", 0))))
    return tools


def check_program(program, ini_path, env):
    """Reads the whole program once; raises RunError with place and reason of a mistake. Pins of the machine are
    not there yet: what is wrong behind the first `#<_hal[...]>` is told when it runs."""
    import gcode
    folder = Path(ini_path).parent
    ini = IniValues(ini_path, env)
    letters = (ini.get("TRAJ", "COORDINATES") or "XYZ").upper()
    with tempfile.TemporaryDirectory() as scratch:
        var = folder / (ini.get("RS274NGC", "PARAMETER_FILE") or "rs274ngc.var")
        copy = Path(scratch) / "check.var"
        if var.exists():
            shutil.copyfile(var, copy)
        startup = ini.get("RS274NGC", "RS274NGC_STARTUP_CODE")
        program, there = Path(program).resolve(), Path.cwd()
        os.chdir(folder)  # as task: the folder of relative SUBROUTINE_PATHs
        try:
            result = gcode.load(str(program), str(copy), [startup] if startup else None,
                                tools=read_tools(ini, folder),
                                axis_mask=sum(1 << i for i, c in enumerate("XYZABCUVW") if c in letters),
                                linear_units=1.0 if ini.get("TRAJ", "LINEAR_UNITS", "mm") in ("mm", "metric")
                                else 1 / 25.4, ini=str(ini_path), interpreter=ini.get("TASK", "INTERPRETER", ""))
        finally:
            os.chdir(there)
    if result.error and "#<_hal[" not in result.error:
        raise RunError(result.fault["report"].rstrip())


class Machine:
    """A running controller, seen through the Python modules of its users."""

    def __init__(self, ini_path):
        import linuxcnc
        self.linuxcnc = linuxcnc
        self.ini = IniValues(ini_path)
        self.stat, self.command = linuxcnc.stat(), linuxcnc.command()
        self.errors = linuxcnc.error_channel()
        self.joints = int(self.ini.get("KINS", "JOINTS"))
        self.problems = []

    def poll(self):
        """Fresh status; operator errors are collected."""
        self.stat.poll()
        while True:
            message = self.errors.poll()
            if not message:
                return self.stat
            kind, text = message
            if kind in (self.linuxcnc.NML_ERROR, self.linuxcnc.OPERATOR_ERROR):
                self.problems.append(text)
            else:
                print(text, file=sys.stderr)

    def wait(self, condition, what, timeout=READY_S):
        """Waits until condition(stat); an operator error or the time-out ends the run."""
        end = clock.now() + timeout
        while not condition(self.poll()):
            if self.problems:
                raise RunError("\n".join(self.problems))
            if clock.now() > end:
                raise RunError(f"{what}: no answer from the machine within {timeout:g} s")
            clock.sleep(POLL_S / 5)

    def prepare(self):
        """Out of emergency stop, on, and every joint homed."""
        l, c = self.linuxcnc, self.command
        c.state(l.STATE_ESTOP_RESET)
        self.wait(lambda s: s.task_state != l.STATE_ESTOP, "emergency stop reset")
        c.state(l.STATE_ON)
        self.wait(lambda s: s.task_state == l.STATE_ON, "machine on")
        c.mode(l.MODE_MANUAL)
        self.wait(lambda s: s.task_mode == l.MODE_MANUAL, "manual mode")
        if all(self.stat.homed[:self.joints]):
            return
        c.teleop_enable(0)
        self.wait(lambda s: s.motion_mode == l.TRAJ_MODE_FREE, "joint mode")
        c.home(-1)
        self.wait(lambda s: all(s.homed[:self.joints]), "homing", 300.0)
        self.wait(lambda s: s.inpos and s.interp_state == l.INTERP_IDLE, "end of homing")

    def start(self, program):
        l, c = self.linuxcnc, self.command
        c.mode(l.MODE_AUTO)
        self.wait(lambda s: s.task_mode == l.MODE_AUTO, "auto mode")
        c.program_open(str(program))
        c.wait_complete(READY_S)
        self.poll()
        c.auto(l.AUTO_RUN, 0)
        self.wait(lambda s: s.echo_serial_number == c.serial, "program start")    # a short one may have ended by then


class Measurement:
    """limitcheck on every joint and samples of the path; units as in the INI file."""

    def __init__(self, machine, samples=None):
        """samples: file for the commands of every joint in every servo cycle (rows of doubles)."""
        import hal
        self.hal, self.machine = hal, machine
        self.samples = open(samples, "wb") if samples else None
        ini, n = machine.ini, machine.joints
        self.axes = [a for a in "XYZABCUVW" if a in (ini.get("TRAJ", "COORDINATES") or "XYZ").upper()]
        lines = [f"loadrt limitcheck count={n}"]
        # A module loads once: a machine that has these itself is watched without a picture of its path.
        loaded = {name for name in ("sampler", "threads") if hal.component_exists(name)}
        self.has_path = not loaded
        if not self.has_path:
            if samples:
                raise RunError("this machine loads sampler or threads itself: --samples cannot be used")
            print("the machine loads sampler or threads itself: no picture, no distances", file=sys.stderr)
        else:
            lines += [f"loadrt threads name1=measure-thread period1={round(SAMPLE_S * 1e9)}",
                      f"loadrt sampler depth=4096,16384 cfg={'f' * len(self.axes)}s,{'f' * n}"]
        for j in range(n):
            section = f"JOINT_{j}"
            lines += [f"addf limitcheck.{j} servo-thread",
                      f"setp limitcheck.{j}.max-vel {float(ini.get(section, 'MAX_VELOCITY', '1'))}",
                      f"setp limitcheck.{j}.max-acc {float(ini.get(section, 'MAX_ACCELERATION', '1'))}",
                      f"setp limitcheck.{j}.max-jerk {float(ini.get(section, 'MAX_JERK', '0'))}",
                      f"setp limitcheck.{j}.min-pos {float(ini.get(section, 'MIN_LIMIT', '-1e99'))}",
                      f"setp limitcheck.{j}.max-pos {float(ini.get(section, 'MAX_LIMIT', '1e99'))}"]
            lines.append(self.link(f"joint.{j}.pos-cmd",
                                   f"limitcheck.{j}.pos-cmd" + f" sampler.1.pin.{j}" * self.has_path))
        if self.has_path:
            for i, axis in enumerate(self.axes):
                lines.append(self.link(f"axis.{axis.lower()}.pos-cmd", f"sampler.0.pin.{i}"))
            lines += [self.link("motion.motion-type", f"sampler.0.pin.{len(self.axes)}"),
                      "addf sampler.0 measure-thread"]
        if self.samples:
            lines.append("addf sampler.1 servo-thread")
        with tempfile.NamedTemporaryFile("w", suffix=".hal") as f:
            f.write("\n".join(lines) + "\n")
            f.flush()
            done = clock.run(["halcmd", "-f", f.name], stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if done.returncode:
            raise RunError(f"cannot set up the measurement: {done.stderr.strip()}")
        self.component = hal.component(f"kerf-run-{os.getpid()}")
        self.component.ready()
        self.stream = hal.stream(self.component, hal.sampler_base) if self.has_path else None
        self.commands = hal.stream(self.component, hal.sampler_base + 1) if self.samples else None
        self.path = []
        self.distance = {"feed": 0.0, "rapid": 0.0}
        self.read()
        self.path.clear()
        self.distance = dict.fromkeys(self.distance, 0.0)
        if self.samples:
            self.samples.truncate(0)
            self.samples.seek(0)

    def link(self, source, target):
        """A net command that also works when the source is in a net already."""
        done = clock.run(["halcmd", "-s", "show", "pin", source], stdin=subprocess.DEVNULL,
                         stdout=subprocess.PIPE, text=True)
        for line in done.stdout.splitlines():
            words = line.split()
            if source in words and "==>" in words:
                return f"net {words[words.index('==>') + 1]} => {target}"
        return f"net kerf-run-{source.replace('.', '-')} {source} => {target}"

    def read(self):
        """Takes in the samples that have come since the last call."""
        while self.commands is not None:
            row = self.commands.read()
            if row is None:
                break
            array.array("d", row).tofile(self.samples)
        last = self.path[-1] if self.path else None
        while self.stream is not None:
            sample = self.stream.read()
            if sample is None:
                return
            *point, kind = sample
            point = tuple(point[:3]) if len(point) >= 3 else tuple(point) + (0.0,) * (3 - len(point))
            if last is not None:
                step = math.dist(point, last[0])
                if step == 0.0 and kind == last[1]:
                    continue
                if kind in (1, 2, 3, 5):
                    self.distance["rapid" if kind == 1 else "feed"] += step
            last = (point, kind)
            self.path.append(last)

    def worst(self):
        """Per joint: (quantity, highest value, limit) for velocity, acceleration and jerk."""
        get = self.hal.get_value
        return [[(name, get(f"limitcheck.{j}.worst-{short}"), get(f"limitcheck.{j}.max-{short}"))
                 for name, short in (("velocity", "vel"), ("acceleration", "acc"), ("jerk", "jerk"))]
                for j in range(self.machine.joints)]

    def violations(self):
        """Names of the limits that were exceeded."""
        get = self.hal.get_value
        return [f"joint {j} {name}" for j in range(self.machine.joints)
                for name, pin in (("velocity", "vel"), ("acceleration", "acc"), ("jerk", "jerk"), ("position", "pos"))
                if get(f"limitcheck.{j}.{pin}-violation")]


class Progress:
    """A line that shows where the program is: rewritten on a terminal, else now and then."""

    def __init__(self, lines):
        self.lines, self.begin, self.last = max(1, lines), time.monotonic(), 0.0
        self.terminal = sys.stderr.isatty()

    def show(self, line, seconds, force=False):
        wall = time.monotonic() - self.begin
        if not force and wall - self.last < (0.2 if self.terminal else 2.0):
            return
        self.last = wall
        done = min(1.0, line / self.lines)
        text = f"line {line:6d} of {self.lines}  {100 * done:3.0f} %  machine time {hms(seconds)}"
        if self.terminal:
            bar = "#" * round(30 * done)
            sys.stderr.write(f"\r[{bar:30s}] {text} ")
            if force:
                sys.stderr.write("\n")
        else:
            sys.stderr.write(text + "\n")
        sys.stderr.flush()


def hms(seconds):
    """h:mm:ss.s"""
    minutes, s = divmod(seconds, 60)
    h, m = divmod(int(minutes), 60)
    return f"{h}:{m:02d}:{s:04.1f}"


def run_display(argv):
    """The display program of kerf-run: `-ini FILE`; orders come in KERF_RUN (JSON)."""
    order = json.loads(os.environ["KERF_RUN"])
    clock.join("kerf-run", 900)
    ini_path = argv[argv.index("-ini") + 1]
    program = order["program"]
    report = {"program": program, "problems": []}
    machine = None
    try:
        machine = Machine(ini_path)
        machine.poll()
        machine.prepare()
        measure = Measurement(machine, order.get("samples"))
        with open(program, "rb") as f:
            progress = Progress(sum(1 for _ in f))
        begin, wall = clock.now(), time.monotonic()
        machine.start(program)
        l = machine.linuxcnc
        attendant = Attendant(machine, order["patience"])
        ended = None
        while True:
            s = machine.poll()
            measure.read()
            progress.show(s.motion_line, clock.now() - begin)
            if s.interp_state == l.INTERP_IDLE and s.queue == 0 and s.inpos:
                ended = clock.now()
                break
            given_up = attendant.look(s)
            if given_up:
                raise RunError("\n".join(machine.problems + [given_up]))
            clock.sleep(POLL_S)
        report["cycle_time"] = ended - begin
        report["wall_time"] = time.monotonic() - wall
        machine.poll()
        report["problems"] = machine.problems
        progress.show(progress.lines if not machine.problems else machine.stat.motion_line, ended - begin, True)
        report.update(distance=measure.distance, joints=measure.worst(), violations=measure.violations(),
                      position=list(machine.stat.actual_position), axes=measure.axes,
                      linear_units=machine.ini.get("TRAJ", "LINEAR_UNITS"), path=measure.path)
    except RunError as e:
        report["problems"] = [str(e)]
    except Exception as e:                      # the launcher must see an end, whatever happens
        report["problems"] = (machine.problems if machine else []) + [f"{type(e).__name__}: {e}"]
    with open(order["report"], "w") as f:
        json.dump(report, f)
    clock.leave()
    return 1 if report["problems"] else 0


def copy_folder(folder, scratch):
    """Copies a machine's folder below scratch; where its files say `../`, what lies there is linked."""
    depth = 0
    for path in folder.rglob("*"):
        if path.is_file() and path.stat().st_size < 1 << 20:
            for m in re.finditer(rb"(?:\.\./)+", path.read_bytes()):
                depth = max(depth, len(m[0]) // 3)
    depth = min(depth, len(folder.parents) - 1)
    chain = [folder, *folder.parents][depth::-1]
    copy = Path(scratch) / "tree"
    for ancestor, child in zip(chain, chain[1:]):
        copy.mkdir()
        for entry in ancestor.iterdir():
            if entry != child:
                (copy / entry.name).symlink_to(entry)
        copy = copy / child.name
    shutil.copytree(folder, copy)
    return copy


def print_report(report, picture):
    unit = report["linear_units"] or "unit"
    print(f"Program            {report['program']}")
    print(f"Cycle time         {hms(report['cycle_time'])}  ({report['cycle_time']:.3f} s on the machine)")
    print(f"Wall time          {report['wall_time']:.2f} s  "
          f"({report['cycle_time'] / max(report['wall_time'], 1e-9):.0f} times real time)")
    print(f"Distance           feed {report['distance']['feed']:.1f} {unit}, rapid "
          f"{report['distance']['rapid']:.1f} {unit}")
    for j, rows in enumerate(report["joints"]):
        parts = []
        for name, worst, limit in rows:
            share = f" of {limit:g} ({100 * worst / limit:.1f} %)" if limit else " (no limit)"
            parts.append(f"{name} {worst:.4g}{share}")
        print(f"Joint {j}            " + ", ".join(parts))
    print("Limits             " + ("EXCEEDED: " + ", ".join(report["violations"]) if report["violations"]
                                   else "none exceeded"))
    at = "  ".join(f"{a} {report['position']['XYZABCUVW'.index(a)]:.4f}" for a in report["axes"])
    print(f"Final position     {at}")
    print(f"Picture            {picture}")


def main(argv):
    if "-ini" in argv and "KERF_RUN" in os.environ:
        return run_display(argv)
    tree = Tree.find()
    p = argparse.ArgumentParser(prog="kerf-run", description="Run a program on a simulated machine and report.")
    p.add_argument("program", nargs="?", default=str(tree.nc_files / "bracket.ngc"), help="G-code file")
    p.add_argument("--ini", default=str(tree.configs / "sim/mill/mill.ini"), help="machine (default: sim/mill)")
    p.add_argument("--realtime", action="store_true", help="at real speed instead of in virtual time")
    p.add_argument("--picture", help="PNG file of the tool path (default: beside the current folder's name)")
    p.add_argument("--samples", help="write every joint's command of every servo cycle to this file (doubles)")
    p.add_argument("--patience", type=float, default=PATIENCE_S, metavar="S",
                   help=f"give up when the program makes no progress for S seconds of the machine (default "
                        f"{PATIENCE_S:g})")
    p.add_argument("--json", help="also write the report to this file")
    o = p.parse_args(argv)
    program = os.path.abspath(o.program)
    if not os.path.isfile(program):
        print(f"{o.program}: no such program", file=sys.stderr)
        return 1
    if not os.path.isfile(o.ini):
        print(f"{o.ini}: no such INI file", file=sys.stderr)
        return 1
    picture = os.path.abspath(o.picture or Path(program).stem + ".png")
    env = tree.environment()
    os.environ.update(env)
    with tempfile.TemporaryDirectory(prefix="kerf-run-") as scratch:
        folder = copy_folder(Path(o.ini).resolve().parent, scratch)
        ini_path = folder / Path(o.ini).name
        report_file = Path(scratch) / "report.json"
        try:
            check_program(program, ini_path, env)
        except (RunError, IniError) as e:
            print(e, file=sys.stderr)
            return 1
        env.update(KERF_CLOCK="real" if o.realtime else os.environ.get("KERF_CLOCK", "virtual"),
                   KERF_RUN=json.dumps({"program": program, "report": str(report_file), "patience": o.patience,
                                      "samples": os.path.abspath(o.samples) if o.samples else None}))
        env.setdefault("KERF_INSTANCE", f"run{os.getpid()}")
        log = Path(scratch) / "log"
        with open(log, "w") as out:
            child = subprocess.Popen(["linuxcnc", "-r", "-D", "kerf-run", str(ini_path)], env=env,
                                     stdin=subprocess.DEVNULL, stdout=out)
            for sig in (signal.SIGINT, signal.SIGTERM):
                signal.signal(sig, lambda *_: child.terminate())
            status = child.wait()
        try:
            report = json.loads(report_file.read_text())
        except OSError:
            sys.stderr.write(log.read_text())
            print("the machine did not start: see the messages above", file=sys.stderr)
            return status or 1
    if o.json:
        Path(o.json).write_text(json.dumps(report))
    if report["problems"]:
        for text in report["problems"]:
            print(text, file=sys.stderr)
        return 1
    from . import picture as drawing
    drawing.draw(report["path"], picture, report["linear_units"])
    print_report(report, picture)
    return 1 if report["violations"] else status
