# SPDX-License-Identifier: GPL-2.0-or-later
import os
from pathlib import Path

import linuxcnc
import tk_monkey
from kerf import tkstyle
from kerf.tktools import tklinuxcnc
from kerf.tktools.machine import Machine
from mill import *

on()
Path("part.ngc").write_text("G21 G90 F2000\n" + "".join(f"G1 X{20 * (n % 2)} Y{n}\n" for n in range(20)) + "M2\n")
seed = int(os.environ.get("SEED", "1"))
root = tkstyle.open_display("tklinuxcnc", "TkLinuxcnc")
m = Machine("mill.ini")
tklinuxcnc.Window.run_program = lambda self, *words: None
w = tklinuxcnc.Window(root, m)
root.after_cancel(w.timer)
limits = [(float(m.ini.find(f"JOINT_{j}", "MIN_LIMIT")), float(m.ini.find(f"JOINT_{j}", "MAX_LIMIT")))
          for j in range(3)]
beyond, count = [], [0]


def tick():
    """A while passes; now and then somebody switches the machine on again."""
    sleep(0.05)
    count[0] += 1
    if count[0] % 25 == 0:
        m.state(linuxcnc.STATE_ESTOP_RESET)
        m.state(linuxcnc.STATE_ON)
    m.stat.poll()
    w.show()
    w.m_errors()
    beyond.extend(p for p, (low, high) in zip(m.stat.joint_position, limits) if not low - 1e-6 <= p <= high + 1e-6)


monkey = tk_monkey.Monkey(root, seed, ["part.ngc"], leave={"Exit"}, tick=tick)
w.exit = lambda: None
for text in monkey.run(int(os.environ.get("ACTIONS", "250"))):
    print(f"seed {seed}: {text}")
print("beyond the limits:", beyond[:3], "still there:", monkey.alive())
w.abort()
sleep(2.0)
m.stat.poll()
w.show()
print("at rest:", m.stat.current_vel == 0, w.jog.running, m.stat.interp_state == linuxcnc.INTERP_IDLE)
shown = [w.state_buttons[n].cget("text") for n in ("estop", "mode")]
print("agree:", shown == [tklinuxcnc.STATES[m.stat.task_state], tklinuxcnc.MODES[m.stat.task_mode]])
