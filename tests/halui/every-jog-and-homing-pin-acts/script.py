# SPDX-License-Identifier: GPL-2.0-or-later
# Each jog pin of each joint and axis, of the selected ones, the dead bands, home and unhome, and the counts of the
# largest velocity. Pins of axes that the machine has not do nothing.
import hal

from mill import *

me = hal.component("buttons")
me.ready()
wrong = []


def put(pin, value):
    hal.set_p("halui." + pin, str(value))


def at(n):
    return poll().position[n]


def check(what, good):
    if not good:
        wrong.append((what, s.position[:3], messages()))


def still(n):
    """Waits for rest; where the axis is then."""
    need(lambda s: s.inpos and not any(s.axis[i]["velocity"] for i in range(3)), "rest")
    sleep(0.1)
    need(lambda s: s.inpos, "rest")
    return at(n)


def held(pin, n, sign):
    before = still(n)
    put(pin, 1)
    sleep(0.4)
    check(pin + " moves", sign * (at(n) - before) > 0.5)
    put(pin, 0)
    after = still(n)
    sleep(0.2)
    check(pin + " stops", at(n) == after and sign * (after - before) > 0.5)


def analog(kind, name, n):
    put(f"{kind}.jog-deadband", 0.3)
    before = still(n)
    put(f"{kind}.{name}.analog", 0.25)
    sleep(0.3)
    check(f"{kind}.{name}.analog in the dead band", at(n) == before)
    put(f"{kind}.{name}.analog", -0.5)
    sleep(0.4)
    check(f"{kind}.{name}.analog", at(n) < before - 0.3)
    put(f"{kind}.{name}.analog", 0)
    still(n)


def step(prefix, n, pins=("increment-plus", "increment-minus")):
    put(prefix + ".increment", 0.75)
    for pin, sign in zip(pins, (1, -1)):
        before = still(n)
        put(f"{prefix}.{pin}", 1)
        sleep(0.3)
        after = still(n)
        put(f"{prefix}.{pin}", 0)
        sleep(0.1)
        check(f"{prefix}.{pin}", abs(after - before - sign * 0.75) < 1e-6)


on(home=False)
put("joint.jog-speed", 300)
put("axis.jog-speed", 300)
for j in range(3):
    put(f"joint.{j}.home", 1)
    need(lambda s: s.homed[j], f"home of joint {j}")
    put(f"joint.{j}.home", 0)
for j in range(3):
    c.teleop_enable(0)
    c.wait_complete()
    put(f"joint.{j}.unhome", 1)
    need(lambda s: not s.homed[j], f"unhome of joint {j}")
    put(f"joint.{j}.unhome", 0)
    sleep(0.05)
    put(f"joint.{j}.home", 1)
    need(lambda s: s.homed[j], f"home of joint {j}")
    put(f"joint.{j}.home", 0)
mdi("G53 G0 X10 Y10 Z-50")
mode(MODE_MANUAL)
c.teleop_enable(0)
c.wait_complete()
for j in range(3):
    held(f"joint.{j}.plus", j, 1)
    held(f"joint.{j}.minus", j, -1)
    analog("joint", str(j), j)
    step(f"joint.{j}", j)
    put(f"joint.{j}.select", 1)
    sleep(0.1)
    put(f"joint.{j}.select", 0)
    check(f"joint.{j}.select",
          hal.get_value("halui.joint.selected") == j and hal.get_value(f"halui.joint.{j}.is-selected"))
    held("joint.selected.plus", j, 1)
    held("joint.selected.minus", j, -1)
    step("joint.selected", j)
print("joints:", wrong)
c.teleop_enable(1)
c.wait_complete()
for n, a in enumerate("xyz"):
    held(f"axis.{a}.plus", n, 1)
    held(f"axis.{a}.minus", n, -1)
    analog("axis", a, n)
    step(f"axis.{a}", n)
    put(f"axis.{a}.select", 1)
    sleep(0.1)
    put(f"axis.{a}.select", 0)
    check(f"axis.{a}.select",
          hal.get_value("halui.axis.selected") == n and hal.get_value(f"halui.axis.{a}.is-selected"))
    held("axis.selected.plus", n, 1)
    held("axis.selected.minus", n, -1)
    step("axis.selected", n)
print("axes:", wrong)
before = poll().position
for a in "abcuvw":
    for pin in ("plus", "minus", "increment-plus", "increment-minus", "select"):
        put(f"axis.{a}.{pin}", 1)
        sleep(0.05)
        put(f"axis.{a}.{pin}", 0)
    put(f"axis.{a}.increment", 1)
    put(f"axis.{a}.analog", 1)
    sleep(0.05)
    put(f"axis.{a}.analog", 0)
sleep(0.2)
print("axes that are not there:", poll().position == before, messages())


def limit():
    sleep(0.15)
    return round(poll().max_velocity, 4)


put("max-velocity.scale", 0.1)
put("max-velocity.count-enable", 0)
put("max-velocity.counts", 3)
first = limit()
put("max-velocity.count-enable", 1)
print("counts while disabled do not count:", limit() == first)
c.maxvel(0.2)
c.wait_complete()
put("max-velocity.counts", 6)
print("counts:", limit(), end=" ")
put("max-velocity.direct-value", 1)
print("direct:", limit(), end=" ")
put("max-velocity.counts", 4)
print(limit(), end=" ")
put("max-velocity.direct-value", 0)
put("max-velocity.increase", 1)
print("increase:", limit(), end=" ")
put("max-velocity.increase", 0)
put("max-velocity.decrease", 1)
print("decrease:", limit())
