# SPDX-License-Identifier: GPL-2.0-or-later
# A jog begins with a press of its button or a joystick that leaves its dead band, and with nothing else: neither a
# change of jog-speed nor a joystick that trembles begins one of a button held since the machine was off, or since the
# jog was ended by an abort, an emergency stop or another mode. What is let go afterwards disturbs nobody.
import hal

from mill import *

me = hal.component("panel")
me.ready()


def put(pin, value):
    hal.set_p("halui." + pin, str(value))


def press(pin):
    put(pin, 1)
    sleep(0.05)
    put(pin, 0)
    sleep(0.1)


def rest():
    put("joint.0.plus", 0)
    put("joint.0.minus", 0)
    put("joint.1.analog", 0)
    need(lambda s: not any(j["velocity"] for j in s.joint[:3]), "rest")
    sleep(0.1)


def ready():
    if poll().task_state != STATE_ON:
        on(home=False)
    c.mode(MODE_MANUAL)
    c.wait_complete()
    c.teleop_enable(0)
    c.wait_complete()
    sleep(0.1)


def moves():
    """Which joints move, now and while speed and joystick change a little."""
    seen = set()
    for speed, way in ((600, 0.80), (610, 0.81), (600, 0.79)):
        put("joint.jog-speed", speed)
        if hal.get_value("halui.joint.1.analog"):
            put("joint.1.analog", way)
        sleep(0.2)
        poll()
        seen |= {n for n in range(3) if s.joint[n]["velocity"]}
    return sorted(seen)


def hold():
    put("joint.0.plus", 1)
    put("joint.1.analog", 0.8)
    sleep(0.2)


sleep(0.2)
put("joint.jog-speed", 600)
hold()
ready()
print("held since before the machine was on:", moves(), messages())
rest()
hold()
print("pressed:", moves())
for what in "estop.activate", "machine.off", "abort", "mode.teleop", "mode.mdi while at rest":
    rest()
    if "rest" in what:
        press("mode.mdi")
        hold()
    else:
        hold()
        press(what)
    ready()
    print(f"held through {what}:", moves(), set(messages()))
    rest()
    hold()
    print("  pressed again:", moves())
rest()
hold()
put("joint.1.analog", -0.8)
sleep(0.3)
print("a joystick swung to the other side:", poll().joint[1]["velocity"] < -7)
put("joint.1.analog", 0)
print("speed 0, then more of it:", end=" ")
put("joint.jog-speed", 0)
sleep(0.5)
print(poll().joint[0]["velocity"], end=" ")
put("joint.jog-speed", 600)
sleep(0.5)
print(poll().joint[0]["velocity"] > 9)
print("two buttons, the last one rules, also when the speed changes:", end=" ")
put("joint.0.minus", 1)
sleep(0.5)
put("joint.jog-speed", 300)
sleep(0.5)
print(round(poll().joint[0]["velocity"], 1))
put("joint.jog-speed", "nan")
sleep(0.3)
print("a speed that is none stops:", poll().joint[0]["velocity"], messages())
put("joint.jog-speed", 600)
rest()
put("joint.0.plus", 1)
put("joint.0.minus", 1)
sleep(0.3)
print("both at once:", poll().joint[0]["velocity"])
rest()

print("== let go after the jog was ended")
hold()
put("spindle.0.increase", 1)
sleep(0.1)
press("estop.activate")
rest()
put("spindle.0.increase", 0)
sleep(0.1)
print("in emergency stop:", messages())
ready()
c.home(-1)
need(lambda s: all(s.homed[:3]), "home")
c.teleop_enable(0)
c.wait_complete()
hold()
press("abort")
program("G21 G90 G0 X0 Y0\nG1 F600 X5\nM2\n")
c.auto(AUTO_RUN, 0)
sleep(0.1)
for pin in "joint.0.plus", "joint.1.analog":
    put(pin, 0)
    sleep(0.1)
print("in a program:", messages(), "its result:", c.wait_complete(30), xyz(3)[:2])

print("== steps")
ready()
for value in 0, "nan", "inf", "-inf":
    put("joint.0.increment", value)
    before = xyz()
    press("joint.0.increment-plus")
    press("joint.0.increment-minus")
    sleep(0.5)
    print(value, xyz() == before, messages())
print("machine on:", poll().task_state == STATE_ON)
