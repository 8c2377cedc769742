# SPDX-License-Identifier: GPL-2.0-or-later
# A command with an infinite number, or one that is none, is refused and told, whoever gives it: nothing moves and no
# limit, override, output or tool is touched by it.
from mill import *

on()
c.teleop_enable(0)
c.wait_complete()
nan, inf = float("nan"), float("inf")


def state():
    poll()
    return (s.position, s.joint_position, s.feedrate, s.rapidrate, s.max_velocity, s.aout, s.task_state,
            s.spindle[0]["override"], s.spindle[0]["speed"], tuple(t.zoffset for t in s.tool_table),
            tuple((j["min_position_limit"], j["max_position_limit"]) for j in s.joint))


COMMANDS = {
    "feed override": c.feedrate,
    "rapid override": c.rapidrate,
    "largest velocity": c.maxvel,
    "spindle override": c.spindleoverride,
    "spindle": lambda v: c.spindle(SPINDLE_FORWARD, v),
    "analog output": lambda v: c.set_analog_output(0, v),
    "jog": lambda v: c.jog(JOG_CONTINUOUS, 1, 0, v),
    "speed of a step": lambda v: c.jog(JOG_INCREMENT, 1, 0, v, 1),
    "length of a step": lambda v: c.jog(JOG_INCREMENT, 1, 0, 10, v),
    "lower limit": lambda v: c.set_min_limit(0, v),
    "upper limit": lambda v: c.set_max_limit(0, v),
    "tool length": lambda v: c.tool_offset(1, v, 0, 0, 0, 0, 0),
}
for what, command in COMMANDS.items():
    results = []
    before = state()
    for value in nan, inf, -inf:
        command(value)
        results.append(c.wait_complete(1))
        sleep(0.2)
    print(what, results, set(messages()), "untouched:", state() == before)
print(mdi("G53 G0 X1 Y1"), messages(), xyz())
