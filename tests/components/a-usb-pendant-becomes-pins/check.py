# SPDX-License-Identifier: GPL-2.0-or-later
"""xhc-hb04 with a pendant in place of libusb: buttons, rotary, wheel, steps, display, a pendant that goes and comes
(FP-156: a hundred times), one with other codes."""
import struct
from pathlib import Path

from hal_outside import pins, until
from usb_pendant import Pendant, coordinates, end

layouts = Path(__file__).resolve().parents[3] / "lib/hallib"
pendant = Pendant("xhc-hb04", "xhc-hb04", 0xEB70, 6, 48)
folder, start, ready, image, loops = pendant.folder, pendant.start, pendant.ready, pendant.image, pendant.loops
get, setp, on = pendant.get, pendant.setp, pendant.on


def report(button=0, rotary=0, wheel=0):
    pendant.send(struct.pack("BBBBbB", 4, button, 0, rotary, wheel, 0))


def shown():
    return coordinates(image()[3:27])


print("== without a pendant")
patient = start("-x", PENDANT="/nowhere")
program = start("-H", "-s", "2", "-I", str(layouts / "xhc-hb04-layout2.cfg"))
until(ready, "ready at once")
print(pins("xhc-hb04.*"))
print(on("connected", "require_pendant"), get("stepsize"), get("jog.scale"))
print("== buttons and rotary")
pendant.appear()
until(lambda: on("connected"), "found")
report(0x02, 0x12)
until(lambda: on("button-start-pause"), "pressed")
print(on("jog.enable-off", "jog.enable-x", "jog.enable-y", "jog.enable-z", "jog.enable-a", "jog.enable-feed-override",
         "jog.enable-spindle-override"))
report(0x07, 0x13)
until(lambda: on("button-zero-z"), "zero of the selected axis")
print(on("button-start-pause", "button-zero", "button-zero-x", "button-zero-y", "button-zero-a", "button-half-z"))
for rotary, name in ((0x11, "x"), (0x18, "a"), (0x14, "spindle-override"), (0x15, "feed-override")):
    report(0, rotary)
    until(lambda: on("jog.enable-" + name), "selected: " + name)
print(on("button-zero", "button-zero-z", "jog.enable-x", "jog.enable-a"))
report()
until(lambda: on("sleeping"), "sleeps")
report(0x0D, 0)
until(lambda: not on("sleeping") and on("button-step"), "awake")
print("== wheel and steps")
setp("jog.max-velocity", 100)
for value in ("1", "5", "10", "20", "1"):
    print(get("stepsize"), get("jog.scale"), end=" ")
    setp("stepsize-up", 1)
    until(lambda: get("stepsize") != value, "up")
    setp("stepsize-up", 0)
    loops()
setp("stepsize-down", 1)
until(lambda: get("stepsize") == "1", "down")
setp("stepsize-up", 1)
loops()
print("both:", get("stepsize"))
setp("stepsize-down", 0)
setp("stepsize-up", 0)
report(0, 0x12, 3)
until(lambda: get("jog.counts") == "3" and get("jog.counts-neg") == "-3", "counts")
print(get("jog.increment"), on("jog.minus-y", "jog.plus-x"))
report(0, 0x12, -5)
until(lambda: get("jog.counts") == "-2", "counts back")
until(lambda: get("jog.velocity") == "0" and not on("jog.plus-y", "jog.minus-y"), "at rest, nothing moves")
print("== display")
for name, value in (("x.pos-absolute", 12.34567), ("x.pos-relative", -0.00004), ("y.pos-absolute", -1.99996),
                    ("y.pos-relative", 70000), ("z.pos-relative", -3.5), ("a.pos-relative", 90.25),
                    ("feed-override", 1.2), ("spindle-override", 0.5), ("feed-value", 10), ("spindle-rps", -20),
                    ("inch-icon", 1)):
    setp(name, value)
until(lambda: image()[36] == 0x80 and shown()[3] > 12, "shown")
loops()
print(shown(), struct.unpack("<4h", image()[27:35]), image()[:3].hex(), image()[35])
report(0, 0x18)
until(lambda: shown()[0] == 90.25, "A in place of X")
print("== a pendant that goes and comes back")
report(0x02, 0x11, 7)
until(lambda: on("button-start-pause"), "pressed")
pendant.vanish()
until(lambda: not on("connected"), "lost")
print(on("button-start-pause", "jog.enable-x", "jog.plus-x"), get("jog.velocity"), get("jog.counts"))
pendant.appear()
until(lambda: on("connected"), "found again")
end(program)
print("== FP-156: a hundred times gone by a transfer error of each kind, with a button down and the wheel turning")
program = start("-H", "-I", str(layouts / "xhc-hb04-layout2.cfg"), PENDANT_PACE="200")
until(ready)
setp("jog.max-velocity", 100)
for n in range(100):
    until(lambda: on("connected"))
    before = get("jog.counts")
    report(0x02, 0x11, 3)
    until(lambda: get("jog.counts") != before and on("button-start-pause", "jog.enable-x") != [])
    pendant.vanish(0xFC + n % 4)
    until(lambda: not on("connected"))
    if on("button-start-pause", "jog.enable-x", "jog.enable-off", "jog.plus-x") or get("jog.velocity") != "0":
        print("not at rest")
    if int(get("jog.counts")) != int(before) + 3:
        print("the counts moved")
    pendant.appear()
until(lambda: on("connected"), "found again")
print("radio loss: no report comes any more")
report(0x02, 0x11, 3)
until(lambda: get("jog.counts") == "303")
until(lambda: get("jog.velocity") == "0" and not on("jog.plus-x", "jog.minus-x"), "nothing moves")
program.terminate()
said = program.communicate()[0].splitlines()
print(program.returncode, said.count("xhc-hb04: the pendant is lost"))
print("== FP-156: a clone with other numbers and codes")
layout = folder / "clone.cfg"
pendant.appear("10cf:eb71")
layout.write_text("[XHC-HB04]\nBUTTON = 02:button-start-pause\n")
program = start("-H", "-I", str(layout))
until(ready)
print("with the usual numbers:", on("connected"))
end(program)
layout.write_text("[XHC-HB04]\nDEVICE = 10cf:eb71\nBUTTON = 02:button-start-pause\n")
program = start("-H", "-I", str(layout))
until(lambda: ready() and on("connected"), "found by its numbers")
report(0x1C, 0x21, 1)
report(0x02, 0x21)
until(lambda: on("button-start-pause"), "codes that are known act")
print(on("jog.enable-x", "jog.enable-y"))
end(program)
layout.write_text("[XHC-HB04]\nDEVICE = 10cf:eb71\nBUTTON = 02:button-start-pause\nBUTTON = 1C:button-macro-1\n"
                  "ROTARY = 21:x\nROTARY = 22:feed-override\n")
program = start("-H", "-I", str(layout))
until(lambda: ready() and on("connected"))
report(0x1C, 0x21, 1)
until(lambda: on("button-macro-1") and on("jog.enable-x"), "learned")
report(0, 0x22)
until(lambda: on("jog.enable-feed-override"), "learned, too")
report(0, 0x12)
until(lambda: on("jog.enable-y"), "the usual codes stay")
end(program)
pendant.appear()
print("== one that must be there")
program = start("-x", "-H")
until(lambda: ready() and on("connected", "require_pendant") == ["connected", "require_pendant"], "ready with it")
pendant.vanish()
pendant.appear()
print("ends with", program.wait(20), program.stdout.read().splitlines())
print("not found: ends with", patient.wait(30), patient.stdout.read().splitlines())
print("== without HAL, and mistakes")
report(0x17, 0x11, -1)
program = start()
print(program.stdout.readline().strip(), program.stdout.readline().strip())
end(program)
Path(folder / "bad.cfg").write_text("[XHC-HB04]\nBUTTON = zz:name\n")
Path(folder / "device.cfg").write_text("[XHC-HB04]\nBUTTON = 01:a\nDEVICE = pendant\n")
Path(folder / "rotary.cfg").write_text("[XHC-HB04]\nBUTTON = 01:a\nROTARY = 21:b\n")
Path(folder / "none.cfg").write_text("[OTHER]\n")
for options in (["-s", "6"], ["-q"], ["-I", str(folder / "bad.cfg")], ["-I", str(folder / "none.cfg")],
                ["-I", str(folder / "device.cfg")], ["-I", str(folder / "rotary.cfg")],
                ["-I", "/nothing.cfg"]):
    program = start(*options)
    print(program.wait(20), program.stdout.read().splitlines()[:1][0].replace(str(folder), ""))
