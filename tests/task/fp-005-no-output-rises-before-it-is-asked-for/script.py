# SPDX-License-Identifier: GPL-2.0-or-later
# Power-up, connecting clients, reset, machine on, mode changes, opening and closing programs, reload of tools: no
# output but the enables rises, and these only with their command.
import os

import hal
from mill import *

NAMES = os.environ["OUTPUTS"].split()


def seen(what):
    print(f"{what}:", [n for i, n in enumerate(NAMES) if hal.get_value(f"flipflop.{i}.out")])


me = hal.component("watch")
me.ready()
sleep(2)
seen("power-up")
for n in range(5):
    linuxcnc.stat().poll()
    linuxcnc.command().debug(0)
    linuxcnc.error_channel().poll()
seen("clients")
for m in (MODE_MDI, MODE_AUTO, MODE_MANUAL):
    mode(m)
c.mdi("M3 S100")
c.wait_complete()
Path("p.ngc").write_text("M3 S100\nM8\nM64 P0\nM2\n")
c.program_open(str(Path("p.ngc").resolve()))
c.wait_complete()
c.reset_interpreter()
c.load_tool_table()
c.wait_complete()
c.spindle(SPINDLE_FORWARD, 100)
c.flood(1)
c.mist(1)
c.auto(AUTO_RUN, 0)
c.wait_complete(1)
seen("commands while stopped")
c.state(STATE_ON)
c.wait_complete(1)
sleep(0.5)
seen("on while stopped")
c.state(STATE_ESTOP_RESET)
need(lambda s: s.task_state == STATE_ESTOP_RESET, "reset")
sleep(0.5)
seen("reset")
for m in (MODE_MDI, MODE_AUTO, MODE_MANUAL):
    mode(m)
c.state(STATE_ON)
need(lambda s: s.task_state == STATE_ON, "on")
sleep(0.5)
seen("on")
for m in (MODE_MDI, MODE_AUTO, MODE_MANUAL):
    mode(m)
c.program_open(str(Path("p.ngc").resolve()))
c.wait_complete()
c.abort()
c.load_tool_table()
c.wait_complete()
c.state(STATE_OFF)
c.state(STATE_ON)
c.wait_complete()
c.state(STATE_ESTOP)
c.wait_complete()
sleep(0.5)
seen("modes, program opened, abort, reload, off, on, emergency stop")
