# SPDX-License-Identifier: GPL-2.0-or-later
"""Waiting for things to happen in a running controller, for scripts and tests.

Times are seconds of the controller's clock, positions machine units. A time-out raises
LinuxCNC_Exception.
"""

import linuxcnc

try:
    import kerf_clock
    _now, _sleep = kerf_clock.now, kerf_clock.sleep
except ImportError:
    import time
    _now, _sleep = time.time, time.sleep


class LinuxCNC_Exception(Exception):
    """What was waited for did not happen in time."""


class LinuxCNC:
    """A controller seen through linuxcnc.command, stat and error_channel (made when not given)."""

    def __init__(self, command=None, status=None, error=None):
        self.command = command or linuxcnc.command()
        self.status = status or linuxcnc.stat()
        self.error = error or linuxcnc.error_channel()

    def _wait(self, done, timeout, what, step=0.1):
        end = _now() + timeout
        while True:
            self.status.poll()
            if done():
                return
            if _now() > end:
                raise LinuxCNC_Exception(what() if callable(what) else what)
            _sleep(step)

    def wait_for_linuxcnc_startup(self, timeout=10.0):
        """Until the controller is up, idle and in emergency stop. RuntimeError when it does not come."""
        def ready():
            s = self.status
            return (s.angular_units != 0.0 and s.axis_mask != 0 and s.cycle_time != 0.0
                    and s.exec_state == linuxcnc.EXEC_DONE and s.interp_state == linuxcnc.INTERP_IDLE and s.inpos
                    and s.linear_units != 0.0 and s.max_acceleration != 0.0
                    and s.max_velocity != 0.0 and s.program_units != 0 and s.rapidrate != 0.0
                    and s.state == linuxcnc.RCS_DONE and s.task_state == linuxcnc.STATE_ESTOP)
        end = _now() + timeout
        while True:
            try:
                self.status.poll()
                if ready():
                    return
            except linuxcnc.error:
                pass
            if _now() > end:
                raise RuntimeError("the controller did not come up")
            _sleep(0.1)

    def all_joints_homed(self, joints):
        """True when each joint whose flag in `joints` is true is homed."""
        self.status.poll()
        return all(self.status.homed[n] for n, wanted in enumerate(joints) if wanted)

    def wait_for_home(self, joints, timeout=10.0):
        self._wait(lambda: self.all_joints_homed(joints), timeout, "timed out waiting for joints to home")

    def wait_for_axis_to_stop(self, axis_letter, timeout=10.0):
        """Until two looks in a row show the same position."""
        axis = "xyzabcuvw".index(axis_letter.lower())
        print("waiting for axis", axis_letter, "to stop")
        self.status.poll()
        before = [None]

        def stopped():
            now = self.status.position[axis]
            same = before[0] is not None and abs(now - before[0]) <= 0.000001
            before[0] = now
            return same
        self._wait(stopped, timeout, f"axis {axis_letter} didn't stop jogging!")

    def jog_axis(self, axis_letter, target, vel=5.0, timeout=10.0):
        """Jogs towards target until it is passed, then stops; no other axis may move."""
        axis = "xyzabcuvw".index(axis_letter.lower())
        self.status.poll()
        start = self.status.position
        print("jogging axis", axis_letter, "from", start[axis], "to", target)
        up = start[axis] < target
        self.command.jog(linuxcnc.JOG_CONTINUOUS, 0, axis, abs(vel) if up else -abs(vel))
        self._wait(lambda: self.status.position[axis] > target if up else self.status.position[axis] < target, timeout,
                   lambda: f"failed to jog axis {axis_letter} to {target}; it is at {self.status.position[axis]}", 0.01)
        self.command.jog(linuxcnc.JOG_STOP, 0, axis)
        self.wait_for_axis_to_stop(axis_letter, timeout)
        print("    jogged axis", axis_letter, "to", self.status.position[axis])
        for n in range(9):
            if n != axis and self.status.position[n] != start[n]:
                raise LinuxCNC_Exception(f"axis {'xyzabcuvw'[n]} moved from {start[n]} to {self.status.position[n]} "
                                         "but should not have")

    def wait_for_axis_to_stop_at(self, axis_letter, target, timeout=10.0, tolerance=0.0001):
        axis = "xyzabcuvw".index(axis_letter.lower())
        end = _now() + timeout
        self.wait_for_axis_to_stop(axis_letter, timeout)
        self._wait(lambda: abs(self.status.position[axis] - target) <= tolerance, max(0.0, end - _now()),
                   lambda: f"axis {axis_letter} stopped at {self.status.position[axis]}, not at {target}")

    def wait_for_interp_state(self, target_state, timeout=10.0):
        self._wait(lambda: self.status.interp_state == target_state, timeout,
                   lambda: f"interpreter stayed in state {self.status.interp_state}, not {target_state}", 0.001)

    def wait_for_tool_in_spindle(self, expected_tool, timeout=10.0):
        self._wait(lambda: self.status.tool_in_spindle == expected_tool, timeout,
                   lambda: f"tool {self.status.tool_in_spindle} stayed in the spindle, not {expected_tool}")
