# SPDX-License-Identifier: GPL-2.0-or-later
"""What an operator does in front of a machine that runs alone: answers it, and gives up when it waits in vain."""

import time

from . import clock

WALL_S = 2.0           # programs beside the controller need wall time: nothing is given up before
QUESTION = "hal_manualtoolchange"


class Attendant:
    """Looks at a running program from time to time. patience: seconds of the controller's clock without progress."""

    def __init__(self, machine, patience):
        self.machine, self.patience = machine, patience
        self.last, self.since, self.wall = None, clock.now(), time.monotonic()

    def look(self, stat):
        """Presses what M0, M1 and a manual tool change wait for. Returns why the run is given up, or None."""
        l = self.machine.linuxcnc
        if stat.interp_state == l.INTERP_PAUSED and stat.paused and stat.task_paused:
            self.machine.command.auto(l.AUTO_RESUME)
        self.change_tool()
        seen = (stat.motion_line, stat.current_line, stat.delay_left, stat.tool_in_spindle, stat.exec_state,
                stat.interp_state, stat.actual_position)
        if seen != self.last or stat.exec_state == l.EXEC_WAITING_FOR_SYSTEM_CMD:
            self.last, self.since, self.wall = seen, clock.now(), time.monotonic()
        elif clock.now() - self.since > self.patience and time.monotonic() - self.wall > WALL_S:
            return f"line {stat.motion_line or stat.current_line}: no progress for {self.patience:g} s: {self.waits_for(stat)}"
        return None

    @staticmethod
    def change_tool():
        import hal
        if hal.component_exists(QUESTION):
            try:
                asked = hal.get_value(f"{QUESTION}.change") and not hal.get_value(f"{QUESTION}.changed")
                hal.set_p(f"{QUESTION}.change_button", "1" if asked else "0")
            except RuntimeError:         # the pin has a button of its own, or the component just ends
                pass

    def waits_for(self, stat):
        """The pins that a machine which stands still may wait for."""
        import hal

        def is_on(pin):
            try:
                return hal.get_value(pin)
            except RuntimeError:
                return False
        l = self.machine.linuxcnc
        if stat.exec_state in (l.EXEC_WAITING_FOR_IO, l.EXEC_WAITING_FOR_MOTION_AND_IO):
            for asks, answers in (("tool-prepare", "tool-prepared"), ("tool-change", "tool-changed")):
                if is_on(f"iocontrol.0.{asks}"):
                    return f"iocontrol.0.{asks} is on, nothing answers on iocontrol.0.{answers}"
        if stat.exec_state == l.EXEC_WAITING_FOR_SPINDLE_ORIENTED:
            return "no spindle.N.is-oriented"
        for n in range(stat.spindles):
            if is_on(f"spindle.{n}.on") and not is_on(f"spindle.{n}.at-speed"):
                return f"spindle.{n}.on is on, spindle.{n}.at-speed is not"
        if is_on("motion.feed-hold") or is_on("motion.feed-inhibit"):
            return "motion.feed-hold or motion.feed-inhibit is on"
        if stat.feedrate == 0:
            return "the feed override is 0"
        return "it waits for an input"
