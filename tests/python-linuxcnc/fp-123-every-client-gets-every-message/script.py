# SPDX-License-Identifier: GPL-2.0-or-later
import subprocess
import sys

import linuxcnc as module
from mill import *

a, b = module.message_log(), module.message_log()
print("none yet:", a.poll(), b.poll())
c.error_msg("first")
first = c.serial
c.text_msg("second")
c.display_msg("third")
sleep(0.1)
print("queue, one reader:", e.poll())
show = lambda log: [(m["number"], m["kind"], m["text"], m["source"], m["command"] - first) for m in log.poll()]
print("a:", show(a))
print("b:", show(b))
print("again:", a.poll())
on()
need(lambda s: s.motion_mode == TRAJ_MODE_TELEOP, "teleop")
c.jog(JOG_INCREMENT, 1, 0, 10, 5)
sleep(0.1)
c.mdi("G0 X1")
failed = c.serial
c.wait_complete()
print("who and why:", [(m["text"], m["source"], m["command"] == failed) for m in a.poll()])
print("time:", 0 < (m := b.poll())[-1]["time"] <= clock.now(), [x["time"] for x in m] == sorted(x["time"] for x in m))
print("one that comes later:", [m["text"] for m in module.message_log().poll()][:3])
other = clock.run([sys.executable, "-c", "import linuxcnc; print(len(linuxcnc.message_log().poll()))"],
                  stdout=subprocess.PIPE, text=True).stdout
print("another process:", int(other) == len(module.message_log().poll()))
messages()
for n in range(50):
    c.text_msg(f"many {n}")
    messages()
news = a.poll()
print("50 at once:", len(news), news[0]["text"], news[-1]["text"], "missed", a.missed)
for n in range(40):
    c.text_msg(f"one by one {n}")
    messages()
    b.poll()
print("one by one:", b.missed == 51 - 32)
