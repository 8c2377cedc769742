# SPDX-License-Identifier: GPL-2.0-or-later
# A button and a script at once: the script has control, everybody sees it, the button's command is refused and
# the sequence goes on undisturbed; what stops is taken from anybody.
import hal
import os
import subprocess
import sys

from kerf.sequence import *
from mill import *

sys.path.insert(0, str(Path(os.environ["EMC2_HOME"]) / "tests/nml/lib"))
import wire

me = hal.component("buttons")
me.ready()
on()
need(lambda s: s.motion_mode == TRAJ_MODE_TELEOP, "teleop")


# Another program: overrides are taken, a second sequence is not let in.
OTHER = """
import linuxcnc
from kerf import clock
from kerf.sequence import Busy, Sequence
clock.join("other", 600)
linuxcnc.command().feedrate(0.5)
try:
    Sequence("another one")
except Busy as busy:
    print(type(busy).__name__, busy.messages)
"""
TAKEN = """
import linuxcnc
from kerf import clock
clock.join("other", 600)
c, s = linuxcnc.command(), linuxcnc.stat()
c.take_control("a program that crashes")
s.poll()
print("in control:", s.control_name)
"""


def press(pin):
    hal.set_p("halui." + pin, "1")
    sleep(0.1)
    hal.set_p("halui." + pin, "0")
    sleep(0.1)


with Sequence("the script") as run:
    run.mdi("G0 X10")
    print("who has control:", poll().control_name, s.control_pid == os.getpid())
    press("mdi-command-00")
    press("mode.manual")
    press("spindle.0.start")
    print("refused:", messages(), "halui waits for nothing:", not hal.get_value("halui.halui-mdi-is-running"))
    run.mdi("G1 F600 X11", timeout=5)
    print("mode", s.task_mode == MODE_MDI, "spindle", poll().spindle[0]["enabled"], xyz(3)[:2])
    before = s.feedrate
    other = clock.run(["/usr/bin/python3", "-c", OTHER], stdout=subprocess.PIPE, text=True).stdout
    print(other.strip(), "feed override:", before, poll().feedrate)
    Path("part.ngc").write_text("G0 X12\nG4 P0.5\nG0 Y1\nM2\n")
    run.program_open(str(Path("part.ngc").resolve()))
    run.auto(AUTO_RUN, 0)
    print("each command brings its mode:", poll().task_mode == MODE_AUTO, xyz(3)[:2])
print("afterwards:", poll().control_pid, repr(s.control_name), messages())
press("mdi-command-00")
need(lambda s: s.state == RCS_DONE and not hal.get_value("halui.halui-mdi-is-running"), "end of the button's command")
print("the button's command is done now:", xyz(3)[:2])
# A program that ends without giving control back has lost it.
print(clock.run(["/usr/bin/python3", "-c", TAKEN], stdout=subprocess.PIPE, text=True).stdout.strip())
print("its control has gone with it:", until(lambda s: s.control_pid == 0, 1))

done = []
try:
    with Sequence() as run:
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
print("stands between:", 0 < xyz(3)[0] < 12, "idle:", poll().interp_state == INTERP_IDLE)
hal.set_p("halui.abort", "0")
sleep(0.1)
with Sequence() as run:
    run.mode(MODE_MDI)
    run.mdi("G0 X1 Y1")
print("a new sequence works:", xyz(3)[:2])
# A program of another computer takes control, and loses it with its connection.
far = wire.Client()
name = b"far away"
print("over TCP:", far.write(wire.COMMAND, wire.struct.pack(">iqiI", 532, 64, 0, len(name)) + name)[1] == 3,
      until(lambda s: s.control_name == "far away", 2), mdi("G0 X2") == RCS_ERROR, messages())
far.socket.close()
print("gone with its connection:", until(lambda s: s.control_pid == 0, 600), mdi("G0 X2"), xyz(3)[:2])
