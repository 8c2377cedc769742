# SPDX-License-Identifier: GPL-2.0-or-later
# Each group of halui's pins, driven as buttons and read as lamps.
import hal

from mill import *

me = hal.component("buttons")
me.ready()


def put(pin, value):
    hal.set_p("halui." + pin, str(value))


def get(pin):
    value = hal.get_value("halui." + pin)
    return round(value, 4) + 0.0 if isinstance(value, float) else int(value)


def press(pin, hold=0.05, after=0.05):
    put(pin, 1)
    sleep(hold)
    put(pin, 0)
    sleep(after)


def show(what, *pins):
    print(f"{what}: " + " ".join(f"{p}={get(p)}" for p in pins), messages() or "")


sleep(0.1)
MACHINE = ("machine.is-on", "estop.is-activated")
show("start", *MACHINE, "mode.is-manual", "mode.is-auto", "mode.is-mdi", "mode.is-joint", "mode.is-teleop",
     "program.is-idle", "machine.units-per-mm", "max-velocity.value", "feed-override.value", "rapid-override.value",
     "spindle.0.override.value", "spindle.0.brake-is-on", "joint.0.is-selected", "axis.x.is-selected")
press("machine.on")
show("on in estop", *MACHINE)
press("estop.reset")
show("estop.reset", *MACHINE)
put("joint.jog-speed", 600)
put("axis.jog-speed", 600)
press("joint.0.plus")
show("jog while off", *MACHINE)
press("machine.on")
show("machine.on", *MACHINE)
press("machine.off")
show("machine.off", *MACHINE)
press("machine.on")
press("estop.activate")
show("estop.activate", *MACHINE)
press("estop.reset")
press("machine.on")

print("== homing")
press("joint.1.home", after=1)
show("joint.1.home", "joint.0.is-homed", "joint.1.is-homed", "joint.2.is-homed", "joint.selected.is-homed")
press("joint.1.select")
show("joint.1.select", "joint.selected", "joint.0.is-selected", "joint.1.is-selected", "joint.selected.is-homed")
press("joint.selected.unhome")
show("selected.unhome", "joint.1.is-homed")
press("joint.selected.home", after=1)
show("selected.home", "joint.1.is-homed")
press("joint.1.unhome")
show("joint.1.unhome", "joint.1.is-homed")
press("home-all", after=3)
show("home-all", "joint.0.is-homed", "joint.1.is-homed", "joint.2.is-homed", "mode.is-teleop")

print("== modes")
for m in ("joint", "teleop", "mdi", "auto", "manual", "joint"):
    press(f"mode.{m}", after=0.2)
    show(m, *(f"mode.is-{k}" for k in ("manual", "auto", "mdi", "joint", "teleop")))

print("== joint jogs")
put("joint.0.plus", 1)
sleep(1)
put("joint.jog-speed", 1200)
sleep(1)
put("joint.0.plus", 0)
sleep(0.5)
print("plus for 1 s at 10 mm/s, 1 s at 20:", 29 < xyz()[0] < 30.5)
press("joint.0.minus", hold=1, after=0.5)
print("minus for 1 s:", 9 < xyz()[0] < 11)
press("axis.x.plus", hold=0.5)
print("axis pins in joint mode do nothing:", 9 < xyz()[0] < 11)
before = xyz()[2]
put("joint.2.increment", 0.5)
press("joint.2.increment-plus", after=1)
press("joint.2.increment-plus", after=1)
press("joint.2.increment-minus", after=1)
print("increments:", round(xyz()[2] - before, 3))
put("joint.0.analog", 0.15)
sleep(0.3)
x = xyz()[0]
put("joint.0.analog", 0.5)
sleep(1)
moved = xyz()[0] - x
put("joint.0.analog", 0)
sleep(0.3)
x = xyz()[0]
sleep(0.3)
print("analog half:", 9 < moved < 10.5, "stopped:", xyz()[0] == x)
put("joint.jog-speed", 600)
press("joint.0.select")
put("joint.selected.plus", 1)
sleep(0.5)
press("joint.2.select", hold=0.5, after=0.05)
x = xyz()[0]
sleep(0.3)
print("selected jog goes over to joint 2:", xyz()[0] - x < 0.1, xyz()[2] > 3)
put("joint.selected.plus", 0)
put("joint.selected.increment", -1)
sleep(0.5)
z = xyz()[2]
press("joint.selected.increment-plus", after=1)
print("selected increment:", round(xyz()[2] - z, 3), get("joint.selected"))

print("== axis jogs")
press("mode.teleop", after=0.2)
press("axis.y.select")
show("axis.y.select", "axis.selected", "axis.x.is-selected", "axis.y.is-selected", "axis.z.is-selected")
y = xyz()[1]
press("axis.selected.plus", hold=1, after=0.5)
print("selected plus:", 9 < xyz()[1] - y < 10.5)
press("axis.y.minus", hold=1, after=0.5)
print("minus:", abs(xyz()[1] - y) < 0.5)
press("joint.1.plus", hold=0.5)
print("joint pins in teleop do nothing:", abs(xyz()[1] - y) < 0.5)
y = xyz()[1]
x = xyz()[0]
put("axis.x.increment", 2)
press("axis.x.increment-plus", after=1)
put("axis.selected.increment", 3)
press("axis.selected.increment-minus", after=1)
print("increments:", round(xyz()[0] - x, 3), round(xyz()[1] - y, 3))
x = xyz()[0]
put("axis.x.analog", -1)
sleep(1)
put("axis.x.analog", 0)
sleep(0.5)
print("analog:", -10.5 < xyz()[0] - x < -9)
show("still", *(f"mode.is-{k}" for k in ("teleop", "manual")))
print(all(abs(get(f"axis.{l}.pos-commanded") - xyz()[i]) < 1e-3 and abs(get(f"axis.{l}.pos-feedback") - xyz()[i]) < 2e-3
          for i, l in enumerate("xyz")))

print("== overrides")
for name in ("feed-override", "rapid-override", "spindle.0.override"):
    steps = []
    value = lambda: steps.append(get(f"{name}.value"))
    for pin in ("increase", "increase", "decrease", "reset"):
        press(f"{name}.{pin}")
        value()
    for counts in (3, -2):
        put(f"{name}.counts", counts)
        sleep(0.1)
        value()
    put(f"{name}.count-enable", 0)
    put(f"{name}.counts", 10)
    sleep(0.1)
    put(f"{name}.count-enable", 1)
    sleep(0.1)
    value()
    put(f"{name}.scale", 0.05)
    put(f"{name}.direct-value", 1)
    sleep(0.1)
    value()
    put(f"{name}.counts", 15)
    sleep(0.1)
    value()
    for _ in range(30):
        press(f"{name}.increase", 0.03, 0.03)
    value()
    for _ in range(60):
        press(f"{name}.decrease", 0.03, 0.03)
    value()
    press(f"{name}.reset")
    value()
    print(name, steps)
put("max-velocity.scale", 30)
press("max-velocity.increase")
show("max-velocity ends at MAX_LINEAR_VELOCITY", "max-velocity.value")
press("max-velocity.decrease")
put("max-velocity.counts", -2)
sleep(0.1)
show("max-velocity", "max-velocity.value")
c.maxvel(200)

print("== spindle, coolant")
S = ("spindle.0.is-on", "spindle.0.runs-forward", "spindle.0.runs-backward", "spindle.0.brake-is-on")
speed = lambda: poll().spindle[0]["speed"]
for pin in ("start", "stop", "reverse", "stop", "forward", "increase", "increase", "decrease", "stop",
            "brake-off", "brake-on"):
    press(f"spindle.0.{pin}", after=0.1)
    show(f"{pin} {speed():g}", *S)
for pin, lamp in (("mist.on", "mist.is-on"), ("flood.on", "flood.is-on"), ("mist.off", "mist.is-on"),
                  ("flood.off", "flood.is-on")):
    press(pin)
    show(pin, lamp)

print("== MDI commands")
show("before", "halui-mdi-is-running", "mode.is-manual")
put("mdi-command-00", 1)
need(lambda s: get("halui-mdi-is-running"), "MDI command")
show("running", "mode.is-mdi", "halui-mdi-is-running")
sleep(3)
put("mdi-command-00", 0)
show("after", "mode.is-manual", "halui-mdi-is-running")
print(xyz(3)[0])
press("mdi-command-02")
press("mdi-command-01")
sleep(60)
show("two in a row", "mode.is-manual", "halui-mdi-is-running")
print(xyz(3)[:2])
press("mdi-command-03", after=1)
show("one that fails", "mode.is-mdi", "halui-mdi-is-running")
press("mdi-command-00", after=2)
show("and one that works", "mode.is-manual", "halui-mdi-is-running")
press("mode.mdi")
for line in ("S1000", "G10 L2 P1 X5 Y6 R90", "G92 Z1"):
    mdi(line)
sleep(0.2)
show("offsets", "axis.x.pos-relative", "axis.y.pos-relative", "axis.z.pos-relative")
for line in ("G92.1", "G10 L2 P1 X0 Y0 R0", "T1 M6", "G43"):
    mdi(line)
sleep(0.2)
show("tool", "axis.z.pos-relative", "tool.number", "tool.length_offset.z", "tool.diameter")
mdi("T0 M6")
mdi("G49")
sleep(0.1)
show("no tool", "tool.number", "tool.length_offset.z", "tool.diameter")
press("mode.manual")
press("spindle.0.reverse")
show(f"reverse at S {speed()}", *S)
press("spindle.0.stop")

print("== programs")
RUN = ("program.is-idle", "program.is-running", "program.is-paused", "mode.is-auto")
press("program.run")
show("run without a program", *RUN)
for pin in ("optional-stop", "block-delete"):
    for way in ("off", "on"):
        press(f"program.{pin}.{way}")
        show(f"{pin}.{way}", f"program.{pin}.is-on")
program("G21 G90 G0 X0 Y0\nG1 F600 X10\nG1 X20\nG1 X0\nM2\n")
press("program.run")
show("run", *RUN)
sleep(1)
press("program.pause", after=0.3)
x = xyz()
sleep(0.5)
show("pause", *RUN)
print("stands:", xyz() == x)
press("program.resume", after=0.3)
show("resume", *RUN)
print("moves:", xyz() != x)
press("program.stop", after=0.5)
show("stop", *RUN)
press("program.step", after=3)
show("step", *RUN)
press("program.step", after=3)
press("abort", after=0.3)
show("abort", *RUN)
press("program.run", after=20)
show("to the end", *RUN)
print(xyz(3))

print("== the end of halui lets go of the buttons")
press("mode.manual")
put("joint.jog-speed", 600)
press("mode.joint", after=0.2)
put("axis.selected.plus", 1)
press("axis.x.select", after=0.2)
print("selecting an axis in joint mode moves nothing:", xyz(3)[0], messages())
put("axis.selected.plus", 0)
put("joint.0.plus", 1)
sleep(0.5)
halcmd("unloadusr", "halui")
sleep(0.5)
x = xyz()[0]
sleep(0.5)
print("stopped:", 1 < x < 12 and xyz()[0] == x)
