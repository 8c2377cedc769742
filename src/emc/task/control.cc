// SPDX-License-Identifier: GPL-2.0-or-later
//
// control.cc - see control.hh.
#include "control.hh"

bool Control::take(pid_t pid, const std::string &name) {
    if (pid <= 0 || (pid_ != 0 && pid_ != pid)) return false;
    pid_ = pid;
    name_ = name;
    watch_ = ProcessWatch(pid);
    return true;
}

void Control::release() {
    pid_ = 0;
    name_.clear();
    watch_ = ProcessWatch();
}

bool Control::ends_control(const NMLmsg &m) {
    if (m._type == EMC_TASK_ABORT_TYPE) return true;
    if (m._type != EMC_TASK_SET_STATE_TYPE) return false;
    const int state = static_cast<const EMC_TASK_SET_STATE &>(m).state;
    return state == EMC_TASK_STATE_ESTOP || state == EMC_TASK_STATE_OFF;
}

bool Control::for_everybody(const NMLmsg &m) {
    switch (m._type) {
    case EMC_TASK_ABORT_TYPE:
    case EMC_TASK_PLAN_PAUSE_TYPE:
    case EMC_TASK_PLAN_RESUME_TYPE: // of what somebody paused
    case EMC_TRAJ_ABORT_TYPE:
    case EMC_TRAJ_PAUSE_TYPE:
    case EMC_TRAJ_RESUME_TYPE:
    case EMC_JOG_STOP_TYPE:
    case EMC_JOINT_HALT_TYPE:
    case EMC_SPINDLE_OFF_TYPE:
    case EMC_SPINDLE_BRAKE_ENGAGE_TYPE:
    case EMC_COOLANT_MIST_OFF_TYPE:
    case EMC_COOLANT_FLOOD_OFF_TYPE:
    case EMC_TRAJ_SET_SCALE_TYPE:
    case EMC_TRAJ_SET_RAPID_SCALE_TYPE:
    case EMC_TRAJ_SET_MAX_VELOCITY_TYPE:
    case EMC_TRAJ_SET_SPINDLE_SCALE_TYPE:
    case EMC_OPERATOR_ERROR_TYPE:
    case EMC_OPERATOR_TEXT_TYPE:
    case EMC_OPERATOR_DISPLAY_TYPE:
    case EMC_SET_DEBUG_TYPE:
    case EMC_NULL_TYPE: return true;
    default: return ends_control(m);
    }
}
