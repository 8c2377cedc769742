# SPDX-License-Identifier: GPL-2.0-or-later
# Random commands of two clients and buttons of halui in every state, in programs with tool changes, probing, a
# mistake, M0 and M66; then one of seven stops. Nothing is on or rises after it, the machine stands, task answers, the
# operator is told of what he did not ask for, every tool is in the table, and the machine can
# be turned on and used again.
import os
import random

import hal
from mill import *

SEED, TURNS = int(os.environ.get("SEED", "1")), int(os.environ.get("TURNS", "10"))
dice, other = random.Random(SEED), linuxcnc.command()
PINS = ("spindle.0.on", "iocontrol.0.coolant-flood", "iocontrol.0.coolant-mist", "iocontrol.0.tool-change")
PROGRAMS = (BUSY, BUSY.replace("G38.3", "G38.2"), BUSY.replace("G1 X3", "G1 X3\nM66 P0 L3 Q0.5\nM0"),
            BUSY.replace("T2 M6", "T2 M6\nG10 L1 P2 Z50\nT3 M6"),
            BUSY.replace("G4 P0.4", "G4 P0.4\nG1 X2 F-1"),
            "G21\no1 repeat [200]\nG1 X1 F3000\nG1 X0\nM3 S[100 + #5420]\nM5\no1 endrepeat\nM2\n")
LINES = ("G1 X5 F2000", "M3 S300", "M5", "M7", "M9", "T1 M6", "T3 M6", "G38.3 Z50 F300", "G4 P0.2", "M66 P0 L1 Q1",
         "M62 P0", "M63 P0", "G10 L1 P2 Z51", "G92 X1", "G92.1",
         "M6", "junk", "M19 R0 Q1", "G33 Z10 K1", "M64 P0", "M65 P0")
BUTTONS = ["halui." + n for n in """program.run program.pause program.resume program.step program.stop abort mode.auto mode.manual mode.mdi mode.joint mode.teleop spindle.0.start
    spindle.0.stop spindle.0.forward spindle.0.reverse spindle.0.increase flood.on flood.off mist.on mist.off home-all joint.0.home joint.0.unhome joint.1.plus joint.1.minus axis.x.plus
    axis.y.minus machine.off estop.activate program.optional-stop.on program.block-delete.on""".split()]
held, wrong = set(), []


def press():
    button = dice.choice(BUTTONS)
    hal.set_p(button, "1")
    held.add(button)
    if dice.random() < 0.7:
        sleep(0.02)
        hal.set_p(button, "0")
        held.discard(button)


def edit_table():
    Path("new.tbl").write_text(Path("mill.tbl").read_text())
    os.rename("new.tbl", "mill.tbl")
    other.load_tool_table()


def jog(kind, *distance):
    c.jog(kind, dice.random() < 0.5, dice.randrange(3),
          *([dice.uniform(-20, 20), *distance] if kind != JOG_STOP else []))


COMMANDS = (press, press, press, press, edit_table, c.load_tool_table, c.task_plan_synch, c.reset_interpreter,
            c.override_limits, other.abort, lambda: c.mode(dice.choice((1, 2, 3))),
            lambda: c.auto(AUTO_RUN, dice.choice((0, 0, 3, 8))),
            lambda: c.auto(dice.choice((AUTO_STEP, AUTO_PAUSE, AUTO_RESUME))),
            lambda: other.auto(dice.choice((AUTO_REVERSE, AUTO_FORWARD))), lambda: c.mdi(dice.choice(LINES)),
            lambda: other.mdi(dice.choice(LINES)),
            lambda: c.spindle(dice.choice((SPINDLE_FORWARD, SPINDLE_REVERSE, SPINDLE_OFF, SPINDLE_INCREASE)), 200),
            lambda: c.flood(dice.choice((0, 1))), lambda: c.mist(dice.choice((0, 1))),
            lambda: jog(JOG_CONTINUOUS), lambda: jog(JOG_INCREMENT, 1), lambda: jog(JOG_STOP),
            lambda: c.home(dice.choice((-1, 0, 1))), lambda: c.unhome(dice.choice((-1, 0, 2))),
            lambda: c.teleop_enable(dice.choice((0, 1))), lambda: c.feedrate(dice.choice((0, 0.5, 1, 1.5))),
            lambda: c.spindleoverride(dice.choice((0.5, 1))),
            lambda: c.set_digital_output(0, dice.choice((0, 1))), lambda: c.tool_offset(2, 51, 0, 3, 0, 0, 0),
            lambda: c.maxvel(dice.choice((0, 1, 100))), lambda: c.set_feed_hold(dice.choice((0, 1))),
            lambda: c.traj_mode(dice.choice((1, 2, 3))), lambda: c.program_open(str(Path("p.ngc").resolve())),
            lambda: other.state(dice.choice((STATE_ESTOP, STATE_ESTOP_RESET, STATE_ON, STATE_ON))))


def chain(closed):
    halcmd("unlinkp", "iocontrol.0.emc-enable-in")
    hal.set_p("iocontrol.0.emc-enable-in", str(int(closed)))


FAULTS = {"limit": "joint.0.neg-lim-sw-in", "amplifier": "joint.1.amp-fault-in", "spindle": "spindle.0.amp-fault-in"}
STOPS = {"abort": c.abort, "off": lambda: c.state(STATE_OFF), "estop": lambda: c.state(STATE_ESTOP),
         "chain": lambda: chain(False), **{name: lambda pin=pin: hal.set_p(pin, "1") for name, pin in FAULTS.items()}}


def high():
    return [p for p in PINS if hal.get_value(p)]


def joints():
    return [hal.get_value(f"joint.{j}.motor-pos-cmd") for j in range(3)]


def tools():
    return sorted(line.split()[0] for line in open("mill.tbl") if line.startswith("T"))


def ready():
    """Let go of everything, on and homed, with nothing on."""
    for pin in [*held, *FAULTS.values()]:
        hal.set_p(pin, "0")
    held.clear()
    chain(True)
    sleep(0.05)
    for do in (lambda: c.feedrate(1), lambda: c.spindleoverride(1), lambda: c.maxvel(100), lambda: c.set_feed_hold(1),
               lambda: c.auto(AUTO_FORWARD), c.abort, lambda: c.state(STATE_ESTOP_RESET), lambda: c.state(STATE_ON),
               lambda: c.mode(MODE_MANUAL), lambda: c.traj_mode(TRAJ_MODE_FREE)):
        do()
        c.wait_complete()
    need(lambda s: s.task_state == STATE_ON, "machine on")
    if high():
        wrong.append((turn, "on after the machine was turned on", high()))
    if not all(s.homed[:3]):
        c.home(-1)
        need(lambda s: all(s.homed[:3]), "homing")
    messages()
    for line in ("G49 G92.1 M65 P0", "G53 G0 X0 Z80"):
        if mdi(line) != RCS_DONE:
            wrong.append((turn, line, messages()))


def stopped(how, asked):
    beat = poll().taskbeat
    sleep(0.3)
    at, on_now = joints(), high()
    sleep(0.8)
    poll()
    if (on_now or high() or joints() != at or s.interp_state != INTERP_IDLE or s.queue or s.taskbeat < beat + 500
            or tools() != all_tools):
        wrong.append((turn, how, on_now, high(), joints(), at, s.interp_state, s.queue, s.taskbeat - beat, tools()))
    if not messages() and not asked:
        wrong.append((turn, how, "the operator was not told"))


all_tools = tools()
on()
for turn in range(TURNS):
    ready()
    Path("p.ngc").write_text(dice.choice(PROGRAMS))
    if dice.random() < 0.8:
        program(Path("p.ngc").read_text(), "p.ngc")
        c.auto(AUTO_RUN, 0)
        sleep(dice.uniform(0, 3))
    for _ in range(dice.randrange(1, 12)):
        dice.choice(COMMANDS)()
        sleep(dice.choice((0, 0.001, 0.01, 0.1, 0.3)))
    how = dice.choice(list(STOPS))
    sleep(0.1)
    messages()
    asked = how in ("abort", "off", "estop") or poll().task_state != STATE_ON
    STOPS[how]()
    c.wait_complete()
    sleep(0.05)
    stopped(how, asked)
print(TURNS, "stops", wrong)
