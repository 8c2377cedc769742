# SPDX-License-Identifier: GPL-2.0-or-later
import re

from mill import *

BOARD = "hm2_7i96s.0"


def poke(addr, value):
    for pin, v in (("address", addr), ("data", value), ("strobe", 1)):
        halcmd("setp", f"{BOARD}.raw.write_{pin}", str(v))
    sleep(0.003)


def where():
    return [round(p, 2) for p in poll().joint_actual_position[:3]]


def off(what):
    need(lambda s: s.task_state != STATE_ON, f"machine off after {what}")
    sleep(0.5)
    print(what, "->", {STATE_ESTOP: "emergency stop", STATE_OFF: "off"}.get(poll().task_state, s.task_state))
    for text in messages():
        print("  ", re.sub(r"\d+ns|iter=\d+|127[.\d]+", "...", text.strip()))


on()
mdi("G0 X10 Y5 Z3")
mdi("G2 X20 I5 F1200")
print(where())
print("counts", halcmd("getp", f"{BOARD}.stepgen.00.counts"), halcmd("getp", f"{BOARD}.stepgen.01.counts"))

mode(MODE_MDI)
c.mdi("G1 X100 F1200")
sleep(1)
poke(0xF00C, 10_000_000)
off("watchdog bite")
on(home=False)
before = where()[0]
mdi("G91 G0 X-10")
print("goes on from there", before > 25, round(where()[0] - before, 2))

mdi("G90")
c.mdi("G1 X-100 F1200")
sleep(1)
poke(0xF004, 7)
off("lost connection")
sleep(1)
halcmd("setp", f"{BOARD}.io_error", "0")
sleep(0.1)
on(home=False)
print("packet-error-total", halcmd("getp", f"{BOARD}.packet-error-total"))
