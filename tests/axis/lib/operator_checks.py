# SPDX-License-Identifier: GPL-2.0-or-later
"""What must be true of screen and machine whatever an operator did."""

import linuxcnc


def still_jogging(op):
    """A joint that moves in manual mode although no key is held (homing and its like come to their own end)."""
    op.wait(1.5)
    s = op.stat
    if (s.task_mode != linuxcnc.MODE_MANUAL or s.task_state != linuxcnc.STATE_ON
            or any(j["homing"] for j in s.joint[:s.joints])):
        return None
    if op.app.jogger.running:
        return f"jogs without an owner's key: {op.app.jogger.running}"
    before = s.actual_position
    op.wait(0.3)
    s = op.stat
    if s.task_mode == linuxcnc.MODE_MANUAL and not any(j["homing"] for j in s.joint[:s.joints]) and \
            any(abs(a - b) > 1e-3 for a, b in zip(before, s.actual_position)):
        return "moves although nobody asks for it"
    return None


def outside_limits(op):
    """Homed joints beyond their soft limits."""
    s = op.stat
    for n, joint in enumerate(s.joint[:s.joints]):
        if (joint["homed"] and not joint["min_position_limit"]
                - 1e-3 <= s.joint_actual_position[n] <= joint["max_position_limit"] + 1e-3):
            yield f"joint {n} at {s.joint_actual_position[n]}"


def work(op):
    """Ends what goes on, powers on and homes."""
    op.key("Escape")
    op.wait(1.0)
    s = op.stat
    if s.task_state == linuxcnc.STATE_ESTOP:
        op.key("F1")
        op.wait(0.3)
    if op.stat.task_state != linuxcnc.STATE_ON:
        op.key("F2")
        op.wait(0.5)
    op.key("F3")
    if not op.app.all_homed():
        op.key("Home", state=4)
        op.wait(8.0)
