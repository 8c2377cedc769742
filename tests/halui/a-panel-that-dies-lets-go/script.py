# SPDX-License-Identifier: GPL-2.0-or-later
# FP-142: a panel whose program is killed, or ends, while its button and joystick are held: the jogs end at once. The
# launcher tells it of a program that it started, and what that one had switched on goes off.
import os
import signal
import time

import hal

from mill import *

me = hal.component("test")
me.ready()
on()
hal.set_p("halui.axis.jog-speed", "12")


def pid():
    return next(int(l.split()[3]) for l in halcmd("show", "comp").splitlines() if l.split()[2] == "pendant")


def in_wall_time(condition):
    """Waits for programs that know no other time."""
    clock.suspend()
    end = time.monotonic() + 20
    while not (met := condition()) and time.monotonic() < end:
        time.sleep(0.01)
    clock.resume()
    return bool(met)


def speeds():
    return [round(poll().axis[n]["velocity"], 3) for n in range(2)]


def end_it(number, what):
    process = pid()
    Path("press").touch()
    in_wall_time(lambda: hal.get_value("stick"))
    need(lambda s: s.axis[0]["velocity"] > 0 and s.axis[1]["velocity"] > 0, "jogs")
    print(f"{what}: jogs", speeds(), end=" ")
    os.kill(process, number)
    in_wall_time(lambda: not Path(f"/proc/{process}/exe").exists())
    stopped = until(lambda s: speeds() == [0, 0], 1)
    print("stopped:", stopped)
    Path("press").unlink()


end_it(signal.SIGKILL, "killed")
lamp = in_wall_time(lambda: not hal.get_value("lamp"))
print("its lamp falls:", lamp, "told:", until(lambda s: any("pendant" in m for m in messages()), 600))
clock.run(["halcmd", "loadusr", "-Wn", "pendant", "./pendant.py"], stderr=subprocess.DEVNULL)
for name in "button", "stick", "lamp":
    hal.connect("pendant." + name, name)
sleep(0.2)
end_it(signal.SIGTERM, "ended")
sleep(1)
print("nothing begins again:", speeds())
