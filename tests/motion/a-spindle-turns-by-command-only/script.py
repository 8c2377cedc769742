# Nothing of a spindle turns on by itself (state machine test of motmod, eight spindles): whatever the
# order of start, stop, orientation, brake, faults, abort, machine off and on, mode changes, pause and
# tool offsets, an output rises only in the cycles of a command that asks for it.
import random

import kerf_motion as km
from motion_bench import Machine

SPINDLES = 8
m = Machine(motmod=f"num_spindles={SPINDLES}")
m.send(km.SET_NUM_SPINDLES, spindle=SPINDLES)
for s in range(SPINDLES):
    m.send(km.SET_SPINDLE_PARAMS, spindle=s, maxLimit=6000, minLimit=-5000, min_pos_speed=20,
           max_neg_speed=-30, offset=100)
rng = random.Random(3)


def outputs(s):
    p = f"spindle.{s}."
    return dict(on=m.get(p + "on"), forward=m.get(p + "forward"), reverse=m.get(p + "reverse"),
                orient=m.get(p + "orient"), speed=m.get(p + "speed-out-abs"))


def start(s):
    speed = rng.choice([-7000, -1000, 1, 500, 3000, 7000])
    m.send(km.SPINDLE_ON, spindle=s, vel=speed, state=1, ini_maxvel=0, acc=0)


def cmd(code, **fields):
    return lambda s: m.send(code, spindle=s, **fields)


def pin(name, value):
    return lambda s: m.set(f"spindle.{max(s, 0)}.{name}", value)


def machine(value):
    def act(_):
        m.send(km.ABORT)
        (m.enable if value else m.disable)()
    return act


RISES = {  # action: what it may switch on
    "start": (start, {"on", "forward", "reverse", "speed"}),
    "speed alone": (lambda s: m.send(km.SPINDLE_ON, spindle=s, vel=rng.choice([-900, 0, 700]), state=0, ini_maxvel=0,
                                     acc=0), set()),
    "faster": (cmd(km.SPINDLE_INCREASE), {"speed"}),
    "override": (lambda s: m.send(km.SPINDLE_SCALE, spindle=max(s, 0), scale=rng.choice([0, 0.5, 1, 1.5])),
                 {"speed", "forward", "reverse"}),
    "override enable": (lambda s: m.send(km.SS_ENABLE, mode=rng.choice([0, 1])), {"speed", "forward", "reverse"}),
    "inhibit": (pin("inhibit", 1), set()),
    "free": (pin("inhibit", 0), {"speed", "forward", "reverse"}),
    "orient": (cmd(km.SPINDLE_ORIENT, orientation=90, mode=0), {"orient"}),
    "oriented": (lambda s: (m.set(f"spindle.{max(s, 0)}.is-oriented", 1), m.sleep(0.003),
                            m.set(f"spindle.{max(s, 0)}.is-oriented", 0)), set()),
    "orient fault": (lambda s: (m.set(f"spindle.{max(s, 0)}.orient-fault", 5), m.sleep(0.003),
                                m.set(f"spindle.{max(s, 0)}.orient-fault", 0)), set()),
    "stop": (cmd(km.SPINDLE_OFF), set()),
    "slower": (cmd(km.SPINDLE_DECREASE), set()),
    "brake": (cmd(km.SPINDLE_BRAKE_ENGAGE), set()),
    "release": (cmd(km.SPINDLE_BRAKE_RELEASE), set()),
    "abort": (lambda s: m.send(km.ABORT), set()),
    "off": (machine(0), set()),
    "on": (machine(1), set()),
    "fault": (lambda s: (m.set(f"spindle.{max(s, 0)}.amp-fault-in", 1), m.sleep(0.003),
                         m.set(f"spindle.{max(s, 0)}.amp-fault-in", 0)), set()),
    "free mode": (lambda s: m.send(km.FREE), set()),
    "teleop": (lambda s: m.send(km.TELEOP), set()),
    "coord": (lambda s: m.send(km.COORD), set()),
    "pause": (lambda s: m.send(km.PAUSE), set()),
    "resume": (lambda s: m.send(km.RESUME), set()),
    "step": (lambda s: m.send(km.STEP), set()),
    "move": (lambda s: m.line(rng.uniform(-9, 9), 0, 0), set()),
    "tool offset": (lambda s: m.send(km.SET_OFFSET, tool_offset=[0, 0, rng.random()]), set()),
    "jog": (lambda s: m.send(km.JOG_INCR, joint=0, axis=0, vel=5, offset=1), set()),
    "home": (lambda s: m.send(km.JOINT_HOME, joint=0), set()),
}
names = list(RISES)
steps = 0
before = [outputs(s) for s in range(SPINDLES)]
for _ in range(4000):
    name = rng.choice(names)
    act, allowed = RISES[name]
    chosen = rng.choice([-1, 0, 1, 2, 7])
    act(chosen)
    m.sleep(rng.choice([0.002, 0.003, 0.01]))
    after = [outputs(s) for s in range(SPINDLES)]
    for s in range(SPINDLES):
        for what, value in after[s].items():
            if value > before[s][what] and what not in allowed:
                raise SystemExit(f"step {steps}: '{name}' of {chosen} raised {what} of spindle {s}: "
                                 f"{before[s]} {after[s]}")
        if after[s]["orient"] and after[s]["on"]:
            raise SystemExit(f"step {steps}: '{name}' leaves spindle {s} turning and orienting (FP-029)")
        if not after[s]["on"] and (after[s]["speed"] or after[s]["forward"] or after[s]["reverse"]):
            raise SystemExit(f"step {steps}: '{name}' turns spindle {s} that is off: {after[s]} (FP-029)")
        if after[s]["speed"] > 6000 or (after[s]["reverse"] and after[s]["speed"] > 5000):
            raise SystemExit(f"step {steps}: spindle {s} is over its limit: {after[s]}")
        if (name == "stop" and chosen in (-1, s)
                and (after[s]["on"] or after[s]["speed"] or not m.get(f"spindle.{s}.brake"))):
            raise SystemExit(f"step {steps}: spindle {s} does not stop: {after[s]}")
    before = after
    steps += 1
    m.errors()
print(f"{steps} steps")
