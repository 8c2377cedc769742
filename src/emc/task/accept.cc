// SPDX-License-Identifier: GPL-2.0-or-later
//
// accept.cc - the table; see accept.hh. A test drives each command in each situation.
#include "accept.hh"

#include <cmath>
#include <type_traits>
#include <unordered_map>

// clang-format off
const std::vector<AcceptRow> &accept_table() {
    static const std::vector<AcceptRow> table = {
        //                                      off man idle read paus wait mdi
        {EMC_OPERATOR_ERROR_TYPE,                   "yyyyyyy"},
        {EMC_OPERATOR_TEXT_TYPE,                    "yyyyyyy"},
        {EMC_OPERATOR_DISPLAY_TYPE,                 "yyyyyyy"},
        {EMC_NULL_TYPE,                             "yyyyyyy"},
        {EMC_SET_DEBUG_TYPE,                        "yyyyyyy"},
        {EMC_JOINT_SET_BACKLASH_TYPE,               "yyyyyyy"},
        {EMC_JOINT_SET_HOMING_PARAMS_TYPE,          "yyyyyyy"},
        {EMC_JOINT_SET_FERROR_TYPE,                 "yyyyyyy"},
        {EMC_JOINT_SET_MIN_FERROR_TYPE,             "yyyyyyy"},
        {EMC_JOINT_UNHOME_TYPE,                     "yyyyyyy"},
        {EMC_JOINT_LOAD_COMP_TYPE,                  "ynnnnnn"},
        {EMC_JOINT_SET_MIN_POSITION_LIMIT_TYPE,     "nynnnnn"},
        {EMC_JOINT_SET_MAX_POSITION_LIMIT_TYPE,     "nynnnnn"},
        {EMC_JOINT_HALT_TYPE,                       "nynnnnn"},
        {EMC_JOINT_HOME_TYPE,                       "nynnnnn"},
        {EMC_JOG_CONT_TYPE,                         "nyynnny"},
        {EMC_JOG_INCR_TYPE,                         "nyynnny"},
        {EMC_JOG_ABS_TYPE,                          "nyynnny"},
        {EMC_JOG_STOP_TYPE,                         "nyynnny"},
        {EMC_JOINT_OVERRIDE_LIMITS_TYPE,            "mynnnnn"},
        {EMC_TRAJ_PAUSE_TYPE,                       "nyyyyyn"},
        {EMC_TRAJ_RESUME_TYPE,                      "nyyyyyn"},
        {EMC_TRAJ_ABORT_TYPE,                       "nyyyyyn"},
        {EMC_TRAJ_SET_SCALE_TYPE,                   "yyyyyyy"},
        {EMC_TRAJ_SET_RAPID_SCALE_TYPE,             "yyyyyyy"},
        {EMC_TRAJ_SET_MAX_VELOCITY_TYPE,            "yyyyyyy"},
        {EMC_TRAJ_SET_SPINDLE_SCALE_TYPE,           "yyyyyyy"},
        {EMC_TRAJ_SET_FO_ENABLE_TYPE,               "yyyyyyy"},
        {EMC_TRAJ_SET_FH_ENABLE_TYPE,               "yyyyyyy"},
        {EMC_TRAJ_SET_SO_ENABLE_TYPE,               "yyyyyyy"},
        {EMC_TRAJ_SET_VELOCITY_TYPE,                "ynnnnnn"},
        {EMC_TRAJ_SET_ACCELERATION_TYPE,            "ynnnnnn"},
        {EMC_SPINDLE_SPEED_TYPE,                    "nyynyny"},
        {EMC_SPINDLE_ON_TYPE,                       "nyynyny"},
        {EMC_SPINDLE_OFF_TYPE,                      "nyynyny"},
        {EMC_SPINDLE_BRAKE_RELEASE_TYPE,            "nyynyny"},
        {EMC_SPINDLE_BRAKE_ENGAGE_TYPE,             "nyynyny"},
        {EMC_SPINDLE_ORIENT_TYPE,                   "nnynyny"},
        {EMC_SPINDLE_WAIT_ORIENT_COMPLETE_TYPE,     "nnynyny"},
        {EMC_SPINDLE_INCREASE_TYPE,                 "nyyyyyy"},
        {EMC_SPINDLE_DECREASE_TYPE,                 "nyyyyyy"},
        {EMC_SPINDLE_CONSTANT_TYPE,                 "nyyyyyy"},
        {EMC_COOLANT_MIST_ON_TYPE,                  "nyyyyyy"},
        {EMC_COOLANT_MIST_OFF_TYPE,                 "nyyyyyy"},
        {EMC_COOLANT_FLOOD_ON_TYPE,                 "nyyyyyy"},
        {EMC_COOLANT_FLOOD_OFF_TYPE,                "nyyyyyy"},
        {EMC_TASK_SET_MODE_TYPE,                    "yyyyyyy"},
        {EMC_TASK_SET_STATE_TYPE,                   "yyyyyyy"},
        {EMC_TASK_ABORT_TYPE,                       "yyyyyyy"},
        {EMC_TASK_PLAN_INIT_TYPE,                   "yyynnny"},
        {EMC_TASK_PLAN_OPEN_TYPE,                   "yyynnny"},
        {EMC_TASK_PLAN_CLOSE_TYPE,                  "yyynnny"},
        {EMC_TASK_PLAN_SYNCH_TYPE,                  "yynnnny"},
        {EMC_TASK_PLAN_RUN_TYPE,                    "niynnnn"},
        {EMC_TASK_PLAN_RESTORE_TYPE,                "nnynnnn"},
        {EMC_TASK_PLAN_RESTORE_CONFIRM_TYPE,        "nnynnnn"},
        {EMC_TASK_TAKE_CONTROL_TYPE,                "yyyyyyy"},
        {EMC_TASK_RELEASE_CONTROL_TYPE,             "yyyyyyy"},
        {EMC_TASK_MDI_CANCEL_TYPE,                  "yyyyyyy"},
        {EMC_TASK_PLAN_EXECUTE_TYPE,                "nyynyyy"},
        {EMC_TASK_PLAN_PAUSE_TYPE,                  "nyyyyyy"},
        {EMC_TASK_PLAN_RESUME_TYPE,                 "nyyyyyy"},
        {EMC_TASK_PLAN_REVERSE_TYPE,                "nyyyyyy"},
        {EMC_TASK_PLAN_FORWARD_TYPE,                "nyyyyyy"},
        {EMC_TASK_PLAN_STEP_TYPE,                   "nnyyyyn"},
        {EMC_TASK_PLAN_SET_OPTIONAL_STOP_TYPE,      "yyyyyyy"},
        {EMC_TASK_PLAN_SET_BLOCK_DELETE_TYPE,       "yyyyyyy"},
        {EMC_TASK_PLAN_OPTIONAL_STOP_TYPE,          "nyyyyyy"},
        {EMC_TRAJ_CLEAR_PROBE_TRIPPED_FLAG_TYPE,    "yyyyyyy"},
        {EMC_TRAJ_PROBE_TYPE,                       "yyyyyyy"},
        {EMC_AUX_INPUT_WAIT_TYPE,                   "yyyyyyy"},
        {EMC_TRAJ_RIGID_TAP_TYPE,                   "yyyyyyy"},
        {EMC_MOTION_SET_DOUT_TYPE,                  "yynnnny"},
        {EMC_MOTION_SET_AOUT_TYPE,                  "yynnnny"},
        {EMC_MOTION_ADAPTIVE_TYPE,                  "yynnnny"},
        {EMC_TRAJ_SET_TELEOP_ENABLE_TYPE,           "yyynnny"},
        {EMC_TOOL_LOAD_TOOL_TABLE_TYPE,             "qqqnnnq"},
        {EMC_TOOL_SET_OFFSET_TYPE,                  "qqqnnnq"},
        {EMC_TOOL_SET_NUMBER_TYPE,                  "qqnnnnn"},
    };
    return table;
}
// clang-format on

Answer accept(NMLTYPE type, Situation s) {
    static const std::unordered_map<NMLTYPE, const AcceptRow *> rows = [] {
        std::unordered_map<NMLTYPE, const AcceptRow *> m;
        for (const AcceptRow &r : accept_table()) m[r.type] = &r;
        return m;
    }();
    auto it = rows.find(type);
    return it == rows.end() ? Answer::no : static_cast<Answer>(it->second->answers[static_cast<int>(s)]);
}

Situation situation(const EMC_TASK_STAT &task) {
    if (task.state != EMC_TASK_STATE_ON) return Situation::off;
    if (task.mode == EMC_TASK_MODE_MDI) return Situation::mdi;
    if (task.mode != EMC_TASK_MODE_AUTO) return Situation::manual;
    switch (task.interpState) {
    case EMC_TASK_INTERP_READING: return Situation::auto_reading;
    case EMC_TASK_INTERP_PAUSED: return Situation::auto_paused;
    case EMC_TASK_INTERP_WAITING: return Situation::auto_waiting;
    default: return Situation::auto_idle;
    }
}

namespace {
struct NumberCheck { // shown the fields of a message
    const char *bad = nullptr;
    template <class T> void operator()(const nml::Field &field, const T &v) {
        if (!bad && !good(v)) bad = field.name;
    }
    static bool good(double v) { return std::isfinite(v); }
    static bool good(const PmCartesian &p) { return good(p.x) && good(p.y) && good(p.z); }
    static bool good(const EmcPose &p) {
        return good(p.tran) && good(p.a) && good(p.b) && good(p.c) && good(p.u) && good(p.v) && good(p.w);
    }
    template <class T> static std::enable_if_t<!std::is_floating_point_v<T>, bool> good(const T &) { return true; }
};

template <class M> const char *check([[maybe_unused]] const NMLmsg &m) {
    NumberCheck numbers;
    if constexpr (std::is_base_of_v<RCS_CMD_MSG, M>) M::fields(numbers, static_cast<const M &>(m));
    return numbers.bad;
}
} // namespace

const char *field_without_number(const NMLmsg &command) {
    switch (command._type) {
#define F(...)
#define S(...)
#define L(...)
#define MSG(NAME, NUMBER, BASE, ...) case NUMBER: return check<NAME>(command);
#include "messages.def"
#undef MSG
#undef F
#undef S
#undef L
    default: return nullptr;
    }
}
