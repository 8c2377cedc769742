# SPDX-License-Identifier: GPL-2.0-or-later
# A button and a script at once: the script notices, gives nothing more, and both are told apart.
import hal

from kerf.sequence import *
from mill import *

me = hal.component("buttons")
me.ready()
on()
need(lambda s: s.motion_mode == TRAJ_MODE_TELEOP, "teleop")


def press(pin):
    hal.set_p("halui." + pin, "1")
    sleep(0.1)
    hal.set_p("halui." + pin, "0")
    sleep(0.1)


done = []
try:
    with Sequence() as run:
        run.mode(MODE_MDI)
        run.mdi("G0 X10")
        done.append("X10")
        press("mdi-command-00")
        run.mdi("G0 X20")
        done.append("X20")
except Broken as end:
    print("a button between two steps:", done, type(end).__name__)
need(lambda s: s.state == RCS_DONE and not hal.get_value("halui.halui-mdi-is-running"), "end of the button's command")
print("the button's command was done, the script's next one was not:", xyz(3)[:2])

done = []
try:
    with Sequence() as run:
        run.mode(MODE_MDI)
        stop_at = clock.now() + 0.3
        poll_once = run.stat.poll

        class Stat:
            pressed = False

            def poll(self):
                if clock.now() > stop_at and not Stat.pressed:
                    Stat.pressed = True
                    hal.set_p("halui.abort", "1")
                poll_once()

            def __getattr__(self, name):
                return getattr(real, name)

        real, run.stat = run.stat, Stat()
        run.mdi("G1 F600 X0")
        done.append("X0")
        run.mdi("G0 X30")
except Broken as end:
    print("the abort button during a step:", done, type(end).__name__)
sleep(0.5)
print("stands between:", 0 < xyz(3)[0] < 10, "idle:", poll().interp_state == INTERP_IDLE)
hal.set_p("halui.abort", "0")
sleep(0.1)
with Sequence() as run:
    run.mode(MODE_MDI)
    run.mdi("G0 X1 Y1")
print("a new sequence works:", xyz(3)[:2])
