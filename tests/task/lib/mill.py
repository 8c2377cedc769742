# SPDX-License-Identifier: GPL-2.0-or-later
"""The simulated mill for tests: commands, waits and what the operator was told."""
import subprocess
from pathlib import Path

import linuxcnc
from kerf import clock
from linuxcnc import *  # noqa: F401,F403

# A program with spindles, coolant, probing, an output and tool changes, four seconds long, with Z at 80 at its start.
BUSY = """G21 G90 G64 F1200
M3 S1000
M8
G1 X1
T1 M6
G43
G0 Z60
G10 L1 P4 Z41
G38.3 Z58 F300
M4 S500
M62 P0
G1 X3
M63 P0
T2 M6
M3 S800
M7
G4 P0.4
G1 X1 F60
M9
M5
M2
"""

clock.join("test", 900)
s, c, e = linuxcnc.stat(), linuxcnc.command(), linuxcnc.error_channel()


def poll():
    s.poll()
    return s


def until(condition, timeout=30.0, step=0.001):
    """Waits until condition(stat). False after timeout seconds."""
    return clock.wait_until(lambda: condition(poll()), timeout, step)


def need(condition, what, timeout=30.0):
    if not until(condition, timeout):
        raise SystemExit(f"no {what}: mode {s.task_mode} state {s.task_state} interp {s.interp_state} exec "
                         f"{s.exec_state} rcs {s.state} {messages()}")


def sleep(seconds):
    clock.sleep(seconds)


def messages():
    """Texts for the operator since the last call."""
    texts = []
    while m := e.poll():
        texts.append(m[1])
    return texts


def on(home=True):
    c.state(STATE_ESTOP_RESET)
    need(lambda s: s.task_state == STATE_ESTOP_RESET, "estop reset")
    c.state(STATE_ON)
    need(lambda s: s.task_state == STATE_ON, "machine on")
    if home:
        c.teleop_enable(0)
        c.wait_complete()
        c.home(-1)
        need(lambda s: all(s.homed[:s.joints]), "homing")


def mode(m):
    c.mode(m)
    need(lambda s: s.task_mode == m, f"mode {m}")


def mdi(line, timeout=60.0):
    """Runs a line; the result of wait_complete."""
    if poll().task_mode != MODE_MDI:
        mode(MODE_MDI)
    c.mdi(line)
    return c.wait_complete(timeout)


def program(text, name="test.ngc"):
    """Writes and opens a program, in auto mode."""
    Path(name).write_text(text)
    if poll().task_mode != MODE_AUTO:
        mode(MODE_AUTO)
    c.program_open(str(Path(name).resolve()))
    c.wait_complete()


def run(text, timeout=120.0, name="test.ngc"):
    """Runs a program to its end; the result of wait_complete."""
    program(text, name)
    c.auto(AUTO_RUN, 0)
    return c.wait_complete(timeout)


def busy_program():
    """From the same state each time."""
    mdi("M61 Q0 G49")
    mdi("G53 G0 X0 Z80")
    program(BUSY)


def idle(timeout=60.0):
    need(lambda s: s.interp_state == INTERP_IDLE and s.inpos and s.queue == 0, "idle machine", timeout)


def halcmd(*words):
    return clock.run(["halcmd", "-s", *words], stdout=subprocess.PIPE, text=True).stdout.strip()


def getp(pin):
    return halcmd("getp", pin)


def setp(pin, value):
    halcmd("setp", pin, str(value))


def tools_in_pockets(file=None):
    """(pocket, tool) of the shared tool data, or of the lines of a tool table or database file."""
    if file:
        return sorted((int(l.split()[1][1:]), int(l.split()[0][1:])) for l in open(file) if l.startswith("T"))
    text = clock.run(["tool_mmap_read", "0", "20"], stdout=subprocess.PIPE, text=True).stdout
    rows = [l.split() for l in text.splitlines()[2:]]
    return sorted((int(r[2]), int(r[1])) for r in rows if int(r[1]) >= 0)


def xyz(digits=4):
    poll()
    return tuple(round(v, digits) + 0.0 for v in s.position[:3])
