# No order of abort, estop, machine off, mode change, M70 to M73, pause, tool change and restart turns
# the spindle on: the outputs rise only after M3, M4, S, M19, M72 (which restores M3) or a spindle command (FP-029, FP-025).
import os
import random

import hal
from mill import *

h = hal.component(f"watch{os.getpid()}")
h.ready()
rng = random.Random(int(os.environ.get("SEED", "5")))
PROGRAM = "spindle.ngc"
with open(PROGRAM, "w") as f:
    f.write("g21 g90 g17 g40\nm70\nm3 s800\ng1 x5 f600\nm73\ng4 p0.2\nm5\nx6\nm72\nx7\nt1 m6\nx0\nm2\n")


def outputs():
    return {p: hal.get_value(f"spindle.0.{p}") for p in ("on", "forward", "reverse", "orient", "speed-out-abs")}


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


TURN = {"on", "forward", "reverse", "speed-out-abs"}
ACTS = {
    "m3": (mdi("m3 s500"), TURN), "m4": (mdi("m4 s300"), TURN), "m5": (mdi("m5"), set()), "s": (mdi("s900"), TURN),
    "m19": (mdi("m19 r0 q0.1"), {"orient"}), "m70": (mdi("m70"), set()), "m72": (mdi("m72"), TURN),
    "m73": (mdi("m73"), set()), "m71": (mdi("m71"), set()), "change": (mdi("t2 m6"), set()), "g96": (mdi("g96 d900 s100"), TURN),
    "g97": (mdi("g97 s400"), TURN), "move": (mdi("g1 x3 f900"), set()), "m2": (mdi("m2"), set()),
    "abort": (c.abort, set()), "estop": (lambda: c.state(STATE_ESTOP), set()), "reset": (lambda: c.state(STATE_ESTOP_RESET), set()),
    "machine on": (lambda: c.state(STATE_ON), set()), "machine off": (lambda: c.state(STATE_OFF), set()),
    "manual": (mode(MODE_MANUAL), set()), "auto": (mode(MODE_AUTO), set()),
    "pause": (lambda: c.auto(AUTO_PAUSE), set()), "resume": (lambda: c.auto(AUTO_RESUME), None),
    "step": (lambda: c.auto(AUTO_STEP), None), "run": (run, None),
    "spindle off": (lambda: c.spindle(SPINDLE_OFF), set()), "stop override": (lambda: c.spindleoverride(0.5), {"speed-out-abs"}),
    "override": (lambda: c.spindleoverride(1.0), TURN),
    "init": (c.task_plan_synch, set()), "traj": (lambda: c.teleop_enable(1), set()), "home": (lambda: c.home(0), set()),
}
c.state(STATE_ESTOP_RESET)
c.state(STATE_ON)
need(lambda s: s.task_state == STATE_ON, "machine on")
c.home(-1)
need(lambda s: all(s.homed[:3]), "homing")
before, program_may = outputs(), False
for step in range(400):
    name = rng.choice(list(ACTS) + ["machine on", "reset", "m3", "run"])
    act, allowed = ACTS[name]
    act()
    sleep(rng.choice([0.01, 0.05, 0.3]))
    if name in ("abort", "estop", "machine off", "manual", "m2"):
        program_may = False
    if allowed is None:
        program_may = True  # lines of the program may start it
    after = outputs()
    rising = {p for p in after if after[p] > before[p]}
    if rising - (allowed or set()) - (TURN if program_may else set()):
        raise SystemExit(f"step {step}: '{name}' raised {sorted(rising)}: {before} {after} {messages()}")
    if after["on"] and after["orient"]:
        raise SystemExit(f"step {step}: '{name}': turning and orienting")
    if name in ("estop", "machine off") and (after["on"] or after["speed-out-abs"]):
        raise SystemExit(f"step {step}: '{name}' leaves the spindle on: {after}")
    before = after
    messages()
print("400 steps")
