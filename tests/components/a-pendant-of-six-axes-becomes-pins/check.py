# SPDX-License-Identifier: GPL-2.0-or-later
"""xhc-whb04b-6 with a pendant in place of libusb: keys and Fn, rotaries, wheel, modes, overrides, display, sleep, a
pendant that goes and comes, unknown codes."""
import re

from hal_outside import halcmd, pins, until
from usb_pendant import Pendant, coordinates, end

pendant = Pendant("xhc-whb04b-6", "whb", 0xEB93, 8, 24)
get, setp, on, start, image, loops = pendant.get, pendant.setp, pendant.on, pendant.start, pendant.image, pendant.loops
AXES = "xyzabc"
FEEDS = {"2": 0x0D, "5": 0x0E, "10": 0x0F, "30": 0x10, "60": 0x1A, "100": 0x1B, "lead": 0x1C}
AXIS_OFF = 6
FN, CONTINUOUS, STEP = 0x0C, 0x0E, 0x0F
state = {"feed": 0x0D, "axis": AXIS_OFF}


def report(key1=0, key2=0, wheel=0, **rotaries):
    state.update(rotaries)
    pendant.send(bytes([4, 0x55, key1, key2, state["feed"], state["axis"], wheel & 0xFF, 0]))


def do(key1=0, key2=0, wheel=0, **rotaries):
    """A report that the program has taken."""
    report(key1, key2, wheel, **rotaries)
    loops()


def true(pattern):
    """Pins of outputs that are TRUE."""
    lines = (line.split() for line in halcmd("show", "pin", pattern).splitlines())
    return sorted(words[4].removeprefix("whb.") for words in lines if words[2:4] == ["OUT", "TRUE"])


def press(*codes):
    """What is TRUE while keys are held, besides the place of the rotaries."""
    do(*codes)
    held = [n for n in true("whb.*") if not re.match(r"pendant|halui.feed.selected|axis|halui.axis", n)]
    do()
    return held


def sees(name, value):
    setp("halui." + name, value)


print("== without a pendant")
patient = start("-t", "-P", "eb99", PENDANT="/nowhere")
program = start("-H")
until(pendant.ready, "ready at once")
print(pins("whb.*"))
print(true("whb.*"))
print("not found: ends with", patient.wait(30), patient.stdout.read().splitlines())
print("== keys, alone and with Fn")
pendant.appear()
until(lambda: on("pendant.is-connected"), "found")
sees("program.is-idle", 1)
for mode in ("auto", "joint", "manual", "mdi", "teleop"):
    halcmd("net", mode, "whb.halui.mode." + mode, "whb.halui.mode.is-" + mode)     # each mode comes when it is asked for
for code in range(1, 0x11):
    print(f"{code:02x}", press(code), press(FN, code) if code != FN else "")
print("both orders of the two places:", press(0, 5), "two keys:", press(4, 5), "and Fn behind one:", press(4, FN))
print("== what is on already")
for what in ("machine", "flood", "mist", "spindle"):
    sees(what + ".is-on", 1)
print(press(1), press(FN, 0x0E), press(FN, 0x0F), press(0x0B), press(FN, 6), press(FN, 7))
print("direction turns round:", press(FN, 0x0B), end=" ")
sees("spindle.is-on", 0)
print(press(0x0B), press(FN, 0x0B), press(0x0B))
print("== a program runs")
for pin in ("run", "pause", "resume"):
    setp(f"halui.program.is-{'idle' if pin == 'run' else 'running' if pin == 'pause' else 'paused'}", 0)
for pin, condition in (("run", "is-idle"), ("pause", "is-running"), ("resume", "is-paused")):
    sees("program." + condition, 1)
    report(3)
    until(lambda: on(f"halui.program.{pin}"), pin)
    sees("program." + condition, 0)
    until(lambda: not on(f"halui.program.{pin}") and on("button.start-pause"), "done")
    do()
print("== modes that do not come")
for mode in ("auto", "joint", "manual", "mdi", "teleop"):
    halcmd("unlinkp", "whb.halui.mode." + mode)
    halcmd("unlinkp", "whb.halui.mode.is-" + mode)
    sees("mode.is-" + mode, 0)
print(press(8), press(9), press(0x0D))
print("== axes and feeds")
for number, letter in enumerate(AXES):
    do(axis=0x11 + number)
    print(true("whb.*axis*"))
do(CONTINUOUS)
sees("max-velocity.value", 50)
for name, code in FEEDS.items():
    do(0, feed=code)
    scales = [f"{get('axis.x.jog-scale')} {get('axis.c.jog-vel-mode')}"]
    selected = true("whb.halui.feed.selected-*")
    for key in (STEP, CONTINUOUS):
        do(key)
        loops()
        scales.append(f"{get('axis.x.jog-scale')} {get('axis.c.jog-vel-mode')}")
    do()
    print(selected, scales)
do(feed=0x9B)
print("again:", true("whb.halui.feed.selected-*"))
print("== wheel")
do(axis=0x12, feed=0x0E)
do(STEP)
do()


def counts():
    return [get(f"axis.{letter}.jog-counts") for letter in AXES]


do(wheel=3)
print("a program runs:", counts())
sees("mode.is-manual", 1)
do(wheel=3)
do(wheel=-5)
print("manual:", counts())
do(axis=0x13, wheel=9)
print("with another axis:", counts())
do(wheel=1)
print("then:", counts())
sees("joint.z.is-homed", 1)
report(wheel=1)
until(lambda: on("halui.mode.teleop"), "a homed joint moves with its axis: teleop")
until(lambda: counts()[2] == "2" and not on("halui.mode.teleop"), "refused: the joint moves")
do(wheel=1)
print("not asked again:", counts())
sees("mode.is-manual", 0)
sees("program.is-idle", 1)
report(wheel=1)
until(lambda: on("halui.mode.manual"), "idle: manual is asked for")
sees("mode.is-manual", 1)
until(lambda: counts()[2] == "4", "and it moves")
sees("machine.is-on", 0)
do(wheel=1)
print("machine off:", counts())
sees("machine.is-on", 1)
do(feed=0x1C)
do(wheel=1)
print("Lead:", counts(), true("whb.halui.*-override*"))
print("== display")
for n, letter in enumerate(AXES):
    sees(f"axis.{letter}.pos-feedback", (n + 1) * -1.5)
    sees(f"axis.{letter}.pos-relative", 12.34567 + n)
sees("feed-override.value", 1.2)
sees("spindle-override.value", 0.8)
sees("spindle-speed-cmd", -12345)
sees("spindle.is-on", 1)


def shown():
    b = image()
    return b[:3].hex(), f"{b[3]:02x}", [round(v, 4) for v in coordinates(b[4:16])], \
        [int.from_bytes(b[n:n + 2], "little") for n in (16, 18)]


loops()
print(shown())
do(0x10, axis=0x14, feed=0x0D)
do(STEP)
print(shown())
do(CONTINUOUS)
do(FN, 6)
sees("machine.is-on", 0)
sees("axis.a.pos-relative", "nan")
loops()
print(shown())
sees("machine.is-on", 1)
print("== sleeps, and is unplugged")
do(5, axis=0x11)
print(true("whb.halui.*"))
pendant.send(bytes([4, 1, 0, 0, 0, 0, 0, 9]))
until(lambda: on("pendant.is-sleeping"), "sleeps")
print(true("whb.*"))
report(4)
loops()
print("dropped:", on("button.feed-plus"))
do(4)
print("awake:", true("whb.*"))
pendant.vanish()
until(lambda: not on("pendant.is-connected"), "lost")
print(true("whb.*"), {get(f"axis.{letter}.jog-scale") for letter in AXES}, counts())
pendant.appear()
until(lambda: on("pendant.is-connected"), "found again")
for _ in range(5):
    pendant.vanish()
    while on("pendant.is-connected"):
        pass
    pendant.appear()
    while not on("pendant.is-connected"):
        pass
print("and 5 times more")
do(0x1D, axis=0x20, feed=0x33)
do(0x1D, axis=0x20, feed=0x33)
print("unknown codes:", true("whb.*"))
program.terminate()
said = program.communicate(timeout=20)[0].splitlines()
print("ends with", program.returncode, *sorted(set(said)), sep="\n")
print("== options -B, -s, -f, -a, and another product")
pendant.product = 0xEB99
pendant.appear()
program = start("-HsfBat", "-P", "eb99")
until(pendant.ready, "ready with it")
sees("machine.is-on", 1)
do(feed=0x1B, axis=0x11)
do(STEP)
do()
large = [get("axis.x.jog-scale")]
do(feed=0x1A)
print("large steps:", large + [get("axis.x.jog-scale")])
for rotary, override in ((0x1C, "spindle"), (0x0D, "feed")):
    do(feed=rotary)
    for clicks, direction in ((2, "increase"), (-1, "decrease")):
        pin = f"halui.{override}-override.{direction}"
        report(wheel=clicks)
        until(lambda: on(pin), pin)
        until(lambda: not on(pin), "lowered at rest")
    print(get("halui.spindle-override.scale"), get("halui.feed-override.scale"))
do(STEP)
print(get("halui.feed-override.scale"))
pendant.vanish()
until(lambda: not on("pendant.is-connected"), "lost")
print(true("whb.*"))
program.terminate()
said = program.communicate(timeout=20)[0].splitlines()
print("ends with", program.returncode, *sorted({line.split()[0] for line in said}))
for what in ("received", "checksum"):
    print(next(line for line in said if line.startswith(what)))
print("== without HAL, and mistakes")
pendant.appear()
program = start("-P", "eb99")
print(program.stdout.readline().strip())
report(FN, 4, -1, axis=0x16)
for _ in range(3):
    print(program.stdout.readline().strip())
end(program)
for options in (["-q"], ["x"], ["-P", "12345"], ["-P", "zz"]):
    program = start(*options)
    print(program.wait(20), program.stdout.read().splitlines()[0])
