# SPDX-License-Identifier: GPL-2.0-or-later
# All of halui's pins in any order and at any pace, while a screen and a client of linuxcncrsh command too: emergency
# stop and machine off act at once, and when the machine is on again nothing goes on by itself, whatever is still held.
# SEED and ROUNDS choose another day.
import os
import random
import sys

import hal

from mill import *

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "linuxcncrsh/lib"))
from rsh import *

seed = int(os.environ.get("SEED") or random.randrange(10**6))
dice = random.Random(seed)
AT_ONCE_S = 0.2
REMOTE = ("SET JOG X 500", "SET JOG 0 500", "SET JOG_STOP X", "SET MODE MDI", "SET MDI G0 X3", "SET MODE AUTO",
          "SET RUN", "SET MIST ON", "SET SPINDLE FORWARD", "SET PAUSE", "SET MODE MANUAL", "SET TELEOP_ENABLE OFF")
SCREEN = (lambda: c.mode(dice.choice((MODE_MANUAL, MODE_AUTO, MODE_MDI))), lambda: c.mdi("G0 X5"),
          lambda: c.auto(AUTO_RUN, 0), lambda: c.jog(JOG_CONTINUOUS, False, 1, 5), lambda: c.jog(JOG_STOP, False, 1),
          lambda: c.teleop_enable(dice.choice((0, 1))), lambda: c.abort())
me = hal.component("panel")
me.ready()
inputs = {}
for line in halcmd("show", "pin", "halui.*").splitlines():
    _, kind, way, _, name = line.split()[:5]
    if way == "IN" and not name.startswith(("halui.machine", "halui.estop")):
        inputs.setdefault(kind, []).append(name)
wrong = []


def put(pin, value):
    hal.set_p(pin, str(value))


def press_something():
    what = dice.random()
    if what < 0.75:
        put(dice.choice(inputs["bit"]), dice.choice((0, 1)))
    elif what < 0.83:
        put(dice.choice(inputs["float"]), dice.choice((0, 0.1, 0.5, 1, -1, 600, 3000, -0.3)))
    elif what < 0.86:
        put(dice.choice(inputs["s32"]), dice.randrange(-50, 50))
    elif what < 0.95:
        dice.choice(SCREEN)()
    else:
        remote.say(dice.choice(REMOTE))
    if dice.random() < 0.5:
        sleep(dice.choice((0.001, 0.01, 0.03, 0.1, 0.5)))


def switched_on():
    return [poll().spindle[0]["enabled"], s.mist, s.flood] != [0, 0, 0]


def stop(pin):
    """Presses it; how long it takes."""
    put(pin, 1)
    begin = clock.now()
    if not until(lambda s: s.task_state != STATE_ON, 5):
        wrong.append(f"{pin} is not heard")
    taken = clock.now() - begin
    put(pin, 0)
    sleep(0.3)
    if any(j["velocity"] for j in poll().joint[:3]) or switched_on():
        wrong.append(f"something is on after {pin}")
    return taken


program("G21 G90\nM3 S500\nM8\n" + "".join(f"G1 F2000 X{n % 20} Y{n % 7}\n" for n in range(200)) + "M2\n")
mode(MODE_MANUAL)
server = Server()
remote = Client(server)
remote.say("SET WAIT_MODE RECEIVED")
on()
for _ in range(int(os.environ.get("ROUNDS") or 20)):
    for _ in range(dice.randrange(5, 60)):
        press_something()
    pin = dice.choice(("halui.estop.activate", "halui.machine.off"))
    taken = stop(pin)
    if taken > AT_ONCE_S:
        wrong.append(f"{pin} took {taken:.3f} s")
    on(home=False)
    before = poll().position
    for kind in "joint", "axis":
        put(f"halui.{kind}.jog-speed", dice.choice((100, 777, 1500)))
    sleep(1)
    if max(abs(a - b) for a, b in zip(poll().position, before)) > 1e-9 or switched_on():
        wrong.append("something goes on by itself, held: "
                     + " ".join(name for name in inputs["bit"] if hal.get_value(name)))
    messages()
print("halui lives:", "halui" in halcmd("list", "comp").split(), "linuxcncrsh:", server.process.poll())
print("wrong:", [f"seed {seed}"] + wrong if wrong else [])
