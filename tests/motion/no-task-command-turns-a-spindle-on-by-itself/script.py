# No order of abort, estop, machine off, mode change, M70 to M73, pause, tool change and restart turns
# a spindle on: it starts only by M3, M4, M72 (which restores M3) or a spindle command, or by a program
# that runs; words and overrides alter the speed of one that turns (FP-029). That each of them does
# happen, often, in states where it has an effect, is counted.
import os
import random
from collections import Counter

import hal
from mill import *

h = hal.component(f"watch{os.getpid()}")
h.ready()
rng = random.Random(int(os.environ.get("SEED", "5")))
PROGRAM = "spindle.ngc"
with open(PROGRAM, "w") as f:
    f.write("g21 g90 g17 g40\nm70\nm3 s800\ng1 x5 f600\nm73\ng4 p0.2\nm5\nx6\nm72\nx7\nt1 m6\nx0\nm2\n")


def outputs():
    return {f"{n}.{p}": hal.get_value(f"spindle.{n}.{p}") for n in (0, 1)
            for p in ("on", "forward", "reverse", "orient", "speed-out-abs")}


def mdi(text):
    def act():
        c.mode(MODE_MDI)
        until(lambda s: s.task_mode == MODE_MDI, 2)
        c.mdi(text)
    return act


def mode(m):
    return lambda: c.mode(m)


def run():
    c.mode(MODE_AUTO)
    if until(lambda s: s.task_mode == MODE_AUTO, 2):
        c.program_open(PROGRAM)
        c.auto(AUTO_RUN, 0)


SPEED = {"forward", "reverse", "speed-out-abs"}  # of a spindle that is on
TURN = SPEED | {"on"}
NOTHING = set()
ACTS = {
    "m3": (mdi("m3 s500"), TURN), "m4": (mdi("m4 s300"), TURN), "m5": (mdi("m5"), NOTHING), "s": (mdi("s900"), SPEED),
    "m3 of 1": (mdi("m3 $1 s450"), TURN), "m5 of 1": (mdi("m5 $1"), NOTHING), "m5 of all": (mdi("m5 $-1"), NOTHING),
    "m19": (mdi("m19 r0 q0.1"), {"orient"}), "m70": (mdi("m70"), NOTHING), "m72": (mdi("m72"), TURN),
    "m73": (mdi("m73"), NOTHING), "m71": (mdi("m71"), NOTHING), "change": (mdi("t2 m6"), NOTHING),
    "g96": (mdi("g96 d900 s100"), SPEED), "g97": (mdi("g97 s400"), SPEED), "move": (mdi("g1 x3 f900"), NOTHING),
    "m2": (mdi("m2"), NOTHING), "abort": (c.abort, NOTHING), "estop": (lambda: c.state(STATE_ESTOP), NOTHING),
    "reset": (lambda: c.state(STATE_ESTOP_RESET), NOTHING), "machine on": (lambda: c.state(STATE_ON), NOTHING),
    "machine off": (lambda: c.state(STATE_OFF), NOTHING), "manual": (mode(MODE_MANUAL), NOTHING),
    "auto": (mode(MODE_AUTO), NOTHING), "pause": (lambda: c.auto(AUTO_PAUSE), NOTHING),
    "resume": (lambda: c.auto(AUTO_RESUME), NOTHING),
    "step": (lambda: c.auto(AUTO_STEP), TURN), "run": (run, TURN),
    "spindle on": (lambda: c.spindle(SPINDLE_FORWARD, 350), TURN),
    "spindle off": (lambda: c.spindle(SPINDLE_OFF), NOTHING), "half speed": (lambda: c.spindleoverride(0.5), NOTHING),
    "override": (lambda: c.spindleoverride(1.0), SPEED), "init": (c.task_plan_synch, NOTHING),
    "restart": (lambda: (c.state(STATE_ESTOP_RESET), c.state(STATE_ON)), NOTHING),
    "teleop": (lambda: c.teleop_enable(1), NOTHING), "free": (lambda: c.teleop_enable(0), NOTHING),
    "home": (lambda: c.home(0), NOTHING), }
c.state(STATE_ESTOP_RESET)
c.state(STATE_ON)
need(lambda s: s.task_state == STATE_ON, "machine on")
c.home(-1)
need(lambda s: all(s.homed[:3]), "homing")
before, still, done, rose = outputs(), set(), Counter(), Counter()
STEPS, deck = 800, []
for step in range(STEPS):
    if not deck:
        deck = list(ACTS) + ["restart"] * 4 + ["m3", "m3 of 1", "run", "run"]
        rng.shuffle(deck)
    name = deck.pop()
    act, allowed = ACTS[name]
    done[name, poll().task_state == STATE_ON, s.task_mode == MODE_AUTO and s.interp_state != INTERP_IDLE] += 1
    act()
    until(lambda s: s.echo_serial_number == c.serial, 1)
    sleep(rng.choice([0.01, 0.05, 0.3]))
    if name in ("abort", "estop", "machine off"):
        still = set()
    may, after = allowed | still, outputs()
    for pin in after:
        spindle, what = pin.split(".", 1)
        if after[pin] > before[pin]:
            rose[name, pin] += 1
            if what not in may or (what != "orient" and "on" not in may and not before[spindle + ".on"]):
                raise SystemExit(f"step {step}: '{name}' raised {pin}: {before} {after} {messages()}")
        if what == "on" and after[pin] and (after[spindle + ".orient"] or name in ("estop", "machine off")):
            raise SystemExit(f"step {step}: '{name}' leaves a spindle on: {after}")
    idle = poll().interp_state == INTERP_IDLE and s.exec_state == EXEC_DONE and not s.queue
    still = set() if idle else may  # lines that wait, and the rest of a program
    before = after
    messages()
for name in ACTS:
    if sum(done[name, True, running] for running in (False, True)) < 5:
        raise SystemExit(f"'{name}' was tried less than 5 times while the machine was on")
for name in ("abort", "estop", "machine off", "pause", "resume", "step", "manual", "half speed"):
    if not done[name, True, True]:
        raise SystemExit(f"'{name}' was never tried in a running program")
for pin in before:
    starts = sum(n for (_, p), n in rose.items() if p == pin)
    if starts < (0 if pin in ("1.reverse", "1.orient") else 3):
        raise SystemExit(f"{pin} rose {starts} times: nothing was tried")
print(f"{STEPS} steps")
