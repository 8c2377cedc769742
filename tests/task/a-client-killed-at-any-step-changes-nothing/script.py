# SPDX-License-Identifier: GPL-2.0-or-later
# kill -9 of halui, of a Python client and of linuxcncrsh, each in the middle of its work, in every tenth of a program
# with tool changes, probing and spindles: the program goes on to its end with every output as often as alone, nobody
# waits for the dead, and of halui, a part of the machine, the operator is told.
import time

import hal
import rsh
import session
from mill import *

PINS = ("spindle.0.on", "spindle.0.forward", "iocontrol.0.coolant-flood", "iocontrol.0.coolant-mist",
        "iocontrol.0.tool-change", "iocontrol.0.tool-prepare", "motion.digital-out-00")
STEPS = 10
CLIENT = """
import linuxcnc
from kerf import clock
clock.join("client", 600)
s, c, e = linuxcnc.stat(), linuxcnc.command(), linuxcnc.error_channel()
while True:
    s.poll()
    e.poll()
    c.feedrate(1.0)
    c.display_msg("from a client")
    s.toolinfo(2)
    clock.sleep(0.001)
"""


class Script:
    """A Python client that sends and reads as fast as it can."""

    def start(self):
        self.child = clock.spawn(["/usr/bin/python3", "-c", CLIENT], "client", priority=600)

    def act(self):
        pass

    def kill(self):
        self.child.kill()
        self.child.wait()


class Shell:
    """linuxcncrsh with a client that asks and commands."""

    def start(self):
        self.server = rsh.Server()
        self.client = rsh.Client(self.server)

    def act(self):
        # and never waits for the answers
        self.client.send("GET ABS_ACT_POS", "GET PROGRAM_LINE", "SET FEED_OVERRIDE 100")

    def kill(self):
        self.server.process.kill()
        self.server.process.wait()
        self.client.close()


class Halui:
    """Buttons: one is being pressed and let go."""

    def start(self):
        if not session.processes("halui"):
            if clock.run(["halcmd", "loadusr", "-Wn", "halui", "halui", "-ini", "mill.ini"], stdout=subprocess.DEVNULL,
                         stderr=subprocess.DEVNULL).returncode:
                print("halui did not come back")
        self.on = False

    def act(self):
        self.on = not self.on
        hal.set_p("halui.feed-override.reset", str(int(self.on)))

    def kill(self):
        session.kill("halui")


def look():
    return tuple(bool(hal.get_value(p)) for p in PINS)


def run_watched(victim=None, when=0.0):
    """How often each output rose, and the time; task's beat never stands for longer than 20 ms."""
    busy_program()
    messages()
    if victim:
        victim.start()
    before = look()
    c.auto(AUTO_RUN, 0)
    begin, rises, turns = clock.now(), [0] * len(PINS), 0
    beat, beat_at = 0, begin
    while poll().interp_state != INTERP_IDLE or clock.now() < begin + 0.5:
        if victim and clock.now() >= begin + when:
            victim.kill()
            victim = None
        elif victim and turns % 20 == 0:
            victim.act()
        turns += 1
        if s.taskbeat != beat:
            beat, beat_at = s.taskbeat, clock.now()
        elif clock.now() > beat_at + 0.02:
            print("task stands")
        now = look()
        rises = [n + (b and not a) for n, a, b in zip(rises, before, now)]
        before = now
        sleep(0.001)
    if any(before):
        print("on at the end:", before)
    return rises, clock.now() - begin


def told(name, timeout=20):
    """How many messages say that it died; they come in wall time."""
    found, end = 0, time.monotonic() + timeout
    clock.suspend()
    while not found and time.monotonic() < end:
        found = sum(name in m["text"] and "died" in m["text"] for m in log.poll())
        time.sleep(0.01)
    clock.resume()
    return found


on()
alone, total = run_watched()
log = linuxcnc.message_log()
print("alone, rises of each output:", alone, messages())
for victim in (Script(), Shell(), Halui()):
    name, wrong = type(victim).__name__, []
    for n in range(STEPS):
        rises, _ = run_watched(victim, total * n / STEPS + 0.003)
        if rises != alone or s.state != RCS_DONE or not all(s.homed[:3]) or s.tool_in_spindle != 2:
            wrong.append((n, s.state, s.tool_in_spindle, rises))
        if name == "Halui" and n == 0 and not told("halui"):    # the launcher knows those that it started
            wrong.append((n, "the operator was not told"))
        if mdi("G10 L1 P2 Z51") != RCS_DONE:
            wrong.append((n, "the next command"))
    print(name, STEPS, "times killed", wrong)
