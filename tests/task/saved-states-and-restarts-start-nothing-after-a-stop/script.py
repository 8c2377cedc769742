# SPDX-License-Identifier: GPL-2.0-or-later
# A program that saves and restores its modal state (M70 to M73) is stopped at every step in each way: running, paused,
# stepped, paused with the spindle stopped by hand. Whatever the operator does next that is no start of a spindle or
# coolant, none of them rises; a start that restores switches on what it has shown, after the confirmation.
import random

import hal
from mill import *

TEXT = """o<work> sub
M73
M3 S700
M8
G1 X3
M5
G1 X4
o<work> endsub
G21 G90 G64 F2400
M5 M9
G0 X1
M4 S600
M7
M70
M5
M9
G1 X2
M72
G1 X0
o<work> call
M6 T2
o<work> call
M5
M9
G1 X1
M2
"""
PINS = ("spindle.0.on", "spindle.0.forward", "spindle.0.reverse", "iocontrol.0.coolant-flood",
        "iocontrol.0.coolant-mist", "iocontrol.0.tool-change",
        "iocontrol.0.tool-prepare")
R = random.Random(47)


def high():
    return [p for p in PINS if hal.get_value(p)]


def pause():
    c.auto(AUTO_PAUSE)
    sleep(R.choice((0.004, 0.1)))


def step():
    pause()
    for _ in range(R.randrange(1, 6)):
        c.auto(AUTO_STEP)
        sleep(0.05)


def by_hand():
    pause()
    c.spindle(SPINDLE_OFF)
    c.flood(FLOOD_OFF)
    sleep(0.02)


def wrong_order():
    """An order that fails: the program ends by itself."""
    hal.set_p("joint.1.amp-fault-in", "1")
    sleep(0.02)
    hal.set_p("joint.1.amp-fault-in", "0")


WAYS = {"running": lambda: None, "paused": pause, "stepped": step, "stopped by hand": by_hand}
STOPS = {"abort": c.abort, "off": lambda: c.state(STATE_OFF), "estop": lambda: c.state(STATE_ESTOP),
         "fault": wrong_order}
QUIET = "G21 G90 F2400\no<part> sub\nM73\nG1 X2\no<part> endsub\nM70\nG1 X1\nM72\no<part> call\nS900\nG1 X0\nM2\n"


def restoring(confirm):
    program(TEXT)
    c.restore(25)
    need(lambda s: s.restore_line == 25, f"restoring start: {messages()}")
    sleep(0.2)
    shown = high()
    if confirm:
        c.restore_confirm(25)
        until(lambda s: s.interp_state == INTERP_IDLE and not s.queue, 30)
    c.abort()
    c.wait_complete()
    return shown


def stepping():
    program(QUIET, "quiet.ngc")
    for _ in range(12):
        c.auto(AUTO_STEP)
        sleep(0.05)
    c.abort()


# What the operator does next; none of it starts a spindle or coolant.
NEXT = {"a move by MDI": lambda: mdi("G1 F2400 X0"), "S by MDI": lambda: mdi("S1200"),
        "restore by MDI": lambda: mdi("M72"), "a sub by MDI": lambda: (mdi("M70"), mdi("M72")),
        "a quiet program": lambda: run(QUIET, name="quiet.ngc"), "its steps": stepping,
        "resume": lambda: (mode(MODE_AUTO), c.auto(AUTO_RESUME), sleep(0.1), c.abort()),
        "modes": lambda: [mode(m) for m in (MODE_MANUAL, MODE_MDI, MODE_AUTO, MODE_MANUAL)],
        "a restoring start, shown": lambda: restoring(False), "a restoring start, confirmed": lambda: restoring(True)}
on()
program(TEXT)
c.auto(AUTO_RUN, 0)
begin = clock.now()
rose = set()
while poll().interp_state != INTERP_IDLE or s.queue:
    rose.update(high())
    sleep(0.005)
total = clock.now() - begin
print("the program alone:", xyz(1)[0], sorted(rose), high(), messages())
offsets = poll().g5x_offset, s.g92_offset, s.tool_offset
wrong, count = [], 0
for turn in range(4):
    for way, prepare in WAYS.items():
        for stop, do in STOPS.items():
            then = list(NEXT)[count % len(NEXT)]
            case = f"{way}, {stop}, {then}, stop {count}"
            count += 1
            mdi("M61 Q0 G0 X0 Y0")
            program(TEXT)
            c.auto(AUTO_RUN, 0)
            sleep(R.uniform(0.0, total))
            prepare()
            do()
            c.wait_complete()
            sleep(0.03)
            if high():
                wrong.append((case, "after the stop", high()))
            if poll().task_state != STATE_ON:
                on(home=False)
            messages()
            seen = set()
            watch = clock.now() + 0.1
            while clock.now() < watch:
                seen.update(high())
                sleep(0.002)
            NEXT[then]()
            seen.update(high())
            until(lambda s: s.interp_state == INTERP_IDLE and not s.queue, 30)
            seen.update(high())
            if seen:
                wrong.append((case, sorted(seen), messages()))
            if not all(poll().homed[:3]) or (s.g5x_offset, s.g92_offset, s.tool_offset) != offsets:
                wrong.append((case, "lost", s.homed[:3], s.g5x_offset[:3], s.tool_offset[:3]))
            c.abort()
            c.wait_complete()
print(count, "stops, wrong:", len(wrong))
for w in wrong:
    print(w)
