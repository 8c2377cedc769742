// SPDX-License-Identifier: GPL-2.0-or-later
//
// task_execute.cc - one order of the list after another: what each must wait for before and
// after, and what it does. Source: task sheet, section 6.
#include <algorithm>
#include <cstdio>
#include <unordered_map>

#include "kerf_clock.h"
#include "rcs_print.hh"
#include "task.hh"
#include "task_text.hh"

namespace {

struct Conditions { int before, after; };

// What an order of the list waits for before it is given, and what its giver waits for after.
const std::unordered_map<NMLTYPE, Conditions> &conditions() {
    constexpr int ALL = EMC_TASK_EXEC_WAITING_FOR_MOTION_AND_IO, IO = EMC_TASK_EXEC_WAITING_FOR_IO,
                  MOTION = EMC_TASK_EXEC_WAITING_FOR_MOTION, DONE = EMC_TASK_EXEC_DONE,
                  DELAY = EMC_TASK_EXEC_WAITING_FOR_DELAY;
    static const std::unordered_map<NMLTYPE, Conditions> table = {
        {EMC_OPERATOR_ERROR_TYPE, {ALL, DONE}},
        {EMC_OPERATOR_TEXT_TYPE, {ALL, DONE}},
        {EMC_OPERATOR_DISPLAY_TYPE, {ALL, DONE}},
        {EMC_SYSTEM_CMD_TYPE, {ALL, EMC_TASK_EXEC_WAITING_FOR_SYSTEM_CMD}},
        {EMC_TRAJ_PROBE_TYPE, {ALL, DONE}},
        {EMC_TRAJ_RIGID_TAP_TYPE, {ALL, DONE}},
        {EMC_TRAJ_CLEAR_PROBE_TRIPPED_FLAG_TYPE, {ALL, DONE}},
        {EMC_AUX_INPUT_WAIT_TYPE, {ALL, DELAY}},
        {EMC_SPINDLE_WAIT_ORIENT_COMPLETE_TYPE, {ALL, EMC_TASK_EXEC_WAITING_FOR_SPINDLE_ORIENTED}},
        {EMC_TOOL_LOAD_TYPE, {ALL, DONE}},
        {EMC_TOOL_UNLOAD_TYPE, {ALL, DONE}},
        {EMC_TOOL_LOAD_TOOL_TABLE_TYPE, {ALL, DONE}},
        {EMC_TOOL_SET_OFFSET_TYPE, {ALL, DONE}},
        {EMC_COOLANT_MIST_ON_TYPE, {ALL, DONE}},
        {EMC_COOLANT_MIST_OFF_TYPE, {ALL, DONE}},
        {EMC_COOLANT_FLOOD_ON_TYPE, {ALL, DONE}},
        {EMC_COOLANT_FLOOD_OFF_TYPE, {ALL, DONE}},
        {EMC_SPINDLE_SPEED_TYPE, {ALL, DONE}},
        {EMC_SPINDLE_ON_TYPE, {ALL, DONE}},
        {EMC_SPINDLE_OFF_TYPE, {ALL, DONE}},
        {EMC_SPINDLE_ORIENT_TYPE, {ALL, DONE}},
        {EMC_TASK_PLAN_PAUSE_TYPE, {ALL, DONE}},
        {EMC_TASK_PLAN_OPTIONAL_STOP_TYPE, {ALL, DONE}},
        {EMC_TASK_PLAN_END_TYPE, {ALL, DONE}},
        {EMC_TASK_PLAN_INIT_TYPE, {ALL, DONE}},
        {EMC_TASK_PLAN_RUN_TYPE, {ALL, DONE}},
        {EMC_TASK_PLAN_SYNCH_TYPE, {ALL, DONE}},
        {EMC_TASK_PLAN_EXECUTE_TYPE, {ALL, DONE}},
        {EMC_TRAJ_DELAY_TYPE, {ALL, DELAY}},
        {EMC_TRAJ_LINEAR_MOVE_TYPE, {IO, DONE}},
        {EMC_TRAJ_CIRCULAR_MOVE_TYPE, {IO, DONE}},
        {EMC_TRAJ_SET_VELOCITY_TYPE, {IO, DONE}},
        {EMC_TRAJ_SET_ACCELERATION_TYPE, {IO, DONE}},
        {EMC_TRAJ_SET_TERM_COND_TYPE, {IO, DONE}},
        {EMC_TRAJ_SET_SPINDLESYNC_TYPE, {IO, DONE}},
        {EMC_TRAJ_SET_FO_ENABLE_TYPE, {IO, DONE}},
        {EMC_TRAJ_SET_FH_ENABLE_TYPE, {IO, DONE}},
        {EMC_TRAJ_SET_SO_ENABLE_TYPE, {IO, DONE}},
        {EMC_TOOL_PREPARE_TYPE, {IO, DONE}},
        {EMC_TOOL_SET_NUMBER_TYPE, {IO, DONE}},
        {EMC_TRAJ_SET_OFFSET_TYPE, {MOTION, DONE}},
        {EMC_TRAJ_SET_G5X_TYPE, {MOTION, DONE}},
        {EMC_TRAJ_SET_G92_TYPE, {MOTION, DONE}},
        {EMC_TRAJ_SET_ROTATION_TYPE, {MOTION, DONE}},
        {EMC_MOTION_ADAPTIVE_TYPE, {MOTION, DONE}},
        {EMC_MOTION_SET_AOUT_TYPE, {MOTION, DONE}}, // with the next move: no wait, see precondition
        {EMC_MOTION_SET_DOUT_TYPE, {MOTION, DONE}},
    };
    return table;
}

} // namespace

/* A word that repeats what is in force: it need not wait, so that a path goes on over it. */
bool Task::changes_nothing(const NMLmsg &m) const {
    switch (m._type) {
    case EMC_COOLANT_FLOOD_ON_TYPE: return stat_.io.coolant.flood;
    case EMC_COOLANT_FLOOD_OFF_TYPE: return !stat_.io.coolant.flood;
    case EMC_COOLANT_MIST_ON_TYPE: return stat_.io.coolant.mist;
    case EMC_COOLANT_MIST_OFF_TYPE: return !stat_.io.coolant.mist;
    case EMC_SPINDLE_SPEED_TYPE:
        {
            const EMC_SPINDLE_SPEED &s = as<EMC_SPINDLE_SPEED>(m);
            return motion_.spindle_runs_at(s.spindle, s.speed, s.factor);
        }
    case EMC_SPINDLE_ON_TYPE:
        {
            const EMC_SPINDLE_ON &s = as<EMC_SPINDLE_ON>(m);
            return motion_.spindle_runs_at(s.spindle, s.speed, s.factor);
        }
    default: return false;
    }
}

int Task::precondition(const NMLmsg &m) const {
    if (changes_nothing(m)) return EMC_TASK_EXEC_DONE;
    if (m._type == EMC_MOTION_SET_AOUT_TYPE && !as<EMC_MOTION_SET_AOUT>(m).now) return EMC_TASK_EXEC_DONE;
    if (m._type == EMC_MOTION_SET_DOUT_TYPE && !as<EMC_MOTION_SET_DOUT>(m).now) return EMC_TASK_EXEC_DONE;
    if (m._type == OffsetsNow::NUMBER) return EMC_TASK_EXEC_DONE;
    auto it = conditions().find(m._type);
    return it == conditions().end() ? EMC_TASK_EXEC_ERROR : it->second.before;
}

int Task::postcondition(const NMLmsg &m) const {
    auto it = conditions().find(m._type);
    return it == conditions().end() ? EMC_TASK_EXEC_DONE : it->second.after;
}

void Task::execute() {
    EMC_TASK_STAT &t = stat_.task;
    if (t.execState == EMC_TASK_EXEC_ERROR || step_holds()) return;
    switch (t.execState) {
    case EMC_TASK_EXEC_DONE:
        if (stat_.motion.traj.queueFull || t.interpState == EMC_TASK_INTERP_PAUSED) return;
        if (pending_.message) issue_pending();
        else if (!list_.empty()) take_next();
        return;
    case EMC_TASK_EXEC_WAITING_FOR_MOTION_QUEUE:
        if (!stat_.motion.traj.queueFull) {
            set_exec(EMC_TASK_EXEC_DONE);
            eager_ = true;
        }
        return;
    case EMC_TASK_EXEC_WAITING_FOR_MOTION: wait_for(true, false); return;
    case EMC_TASK_EXEC_WAITING_FOR_IO: wait_for(false, true); return;
    case EMC_TASK_EXEC_WAITING_FOR_MOTION_AND_IO: wait_for(true, true); return;
    case EMC_TASK_EXEC_WAITING_FOR_DELAY: wait_delay(); return;
    case EMC_TASK_EXEC_WAITING_FOR_SYSTEM_CMD: wait_system_command(); return;
    case EMC_TASK_EXEC_WAITING_FOR_SPINDLE_ORIENTED: wait_orient(); return;
    default: set_exec(EMC_TASK_EXEC_ERROR); return;
    }
}

// With single stepping, work goes on while the line of the list is the one that was current
// when the last STEP was given.
bool Task::step_holds() {
    if (!stepping_) return false;
    if (step_given_) {
        step_given_ = false;
        step_line_ = stat_.task.currentLine;
        return false;
    }
    return stat_.task.currentLine != step_line_;
}

void Task::take_next() {
    EMC_TASK_STAT &t = stat_.task;
    pending_ = list_.take();
    t.currentLine = pending_.line;
    t.callLevel = pending_.level;
    order_line_ = pending_.main_line;
    motion_.set_id(pending_.line);
    set_exec(stat_.motion.traj.queueFull ? EMC_TASK_EXEC_WAITING_FOR_MOTION_QUEUE : precondition(*pending_.message));
    eager_ = true;
}

void Task::issue_pending() {
    if (debug_ & EMC_DEBUG_TASK_ISSUE)
        rcs_print("Issuing %s -- \t (line %d)\n", emc_symbol_lookup(pending_.message.type()), pending_.line);
    AnyMessage m = std::move(pending_.message);
    pending_ = {};
    int after = postcondition(*m);
    set_exec(EMC_TASK_EXEC_DONE);
    if (issue(*m) != 0) {
        failed_at(stat_.task.currentLine);
        set_exec(EMC_TASK_EXEC_ERROR);
    } else if (stat_.task.execState == EMC_TASK_EXEC_DONE) {
        set_exec(after);
    }
    eager_ = true;
}

void Task::wait_for(bool motion, bool io) {
    if ((motion && stat_.motion.status == RCS_ERROR) || (io && stat_.io.status == RCS_ERROR)) {
        set_exec(EMC_TASK_EXEC_ERROR);
        return;
    }
    if ((!motion || stat_.motion.status == RCS_DONE) && (!io || stat_.io.status == RCS_DONE)) {
        set_exec(EMC_TASK_EXEC_DONE);
        eager_ = true;
    }
}

bool Task::input_reached() {
    int value = input_.index >= 0 && input_.index < EMCMOT_MAX_DIO ? stat_.motion.synch_di[input_.index] : 0;
    switch (input_.wait_type) {
    case WAIT_MODE_HIGH: return value != 0;
    case WAIT_MODE_LOW: return value == 0;
    case WAIT_MODE_RISE:
        if (value == 0) input_armed_ = true;
        return input_armed_ && value != 0;
    case WAIT_MODE_FALL:
        if (value != 0) input_armed_ = true;
        return input_armed_ && value == 0;
    default: return false;
    }
}

void Task::wait_delay() {
    EMC_TASK_STAT &t = stat_.task;
    if (input_watched_ && input_reached()) {
        t.input_timeout = false;
        input_watched_ = false;
        set_exec(EMC_TASK_EXEC_DONE);
        eager_ = true;
        return;
    }
    int64_t left = delay_until_ - kerf_clock_now_ns();
    t.delayLeft = left > 0 ? static_cast<double>(left) / 1e9 : 0;
    if (left > 0) return;
    input_watched_ = false; // an M66 that timed out stays so (input_timeout), and is over
    set_exec(EMC_TASK_EXEC_DONE);
    eager_ = true;
}

int Task::user_code_failed() {
    const int line = stat_.task.currentLine;
    operator_error(((line > 0 ? "line " + std::to_string(line) + ": " : "") + child_.failure()).c_str());
    return -1;
}

void Task::wait_system_command() {
    int r = child_.poll();
    if (r == 0) return;
    if (r < 0) user_code_failed();
    set_exec(r > 0 ? EMC_TASK_EXEC_DONE : EMC_TASK_EXEC_ERROR);
    eager_ = true;
}

void Task::wait_orient() {
    int state = 0, fault = 0;
    for (int s = 0; s < stat_.motion.traj.spindles; s++)
        if (stat_.motion.spindle[s].orient_state > state) {
            state = stat_.motion.spindle[s].orient_state;
            fault = stat_.motion.spindle[s].orient_fault;
        }
    switch (state) {
    case EMCMOT_ORIENT_IN_PROGRESS:
        if (kerf_clock_now_ns() < orient_until_) return;
        operator_error("wait for orient complete: TIMED OUT");
        set_exec(EMC_TASK_EXEC_ERROR);
        return;
    case EMCMOT_ORIENT_FAULTED:
        {
            char text[LINELEN];
            snprintf(text, sizeof text, "wait for orient complete: FAULTED code=%d", fault);
            operator_error(text);
        }
        set_exec(EMC_TASK_EXEC_ERROR);
        return;
    case EMCMOT_ORIENT_NONE: rcs_print("wait for orient complete: nothing to do\n"); break;
    default: break;
    }
    set_exec(EMC_TASK_EXEC_DONE);
    eager_ = true;
}

// Ends what failed before the cycle ends: a client that sees the error may send its next
// command at once.
void Task::recover() {
    if (stat_.task.execState != EMC_TASK_EXEC_ERROR) return;
    failed_at(stat_.task.currentLine);
    abort_task();
    io_.abort(EMC_ABORT_TASK_EXEC_ERROR);
    spindles_off_after_fault();
    clear_program();
    stop_stepping();
    on_abort(EMC_ABORT_TASK_EXEC_ERROR);
    stat_.task.currentLine = 0;
    synch_later();
    command_failed();
}

// ---- orders: of the list, and those that the operator may give too ----

int Task::issue(const NMLmsg &m) {
    EMC_TASK_STAT &t = stat_.task;
    switch (m._type) {
    case EMC_OPERATOR_ERROR_TYPE: operator_error(as<EMC_OPERATOR_ERROR>(m).error); return 0;
    case EMC_OPERATOR_TEXT_TYPE: operator_text(as<EMC_OPERATOR_TEXT>(m).text); return 0;
    case EMC_OPERATOR_DISPLAY_TYPE: operator_display(as<EMC_OPERATOR_DISPLAY>(m).display); return 0;
    case EMC_SYSTEM_CMD_TYPE: return child_.start(as<EMC_SYSTEM_CMD>(m).string) ? 0 : user_code_failed();
    case EMC_TRAJ_LINEAR_MOVE_TYPE: return motion_.linear_move(as<EMC_TRAJ_LINEAR_MOVE>(m));
    case EMC_TRAJ_CIRCULAR_MOVE_TYPE: return motion_.circular_move(as<EMC_TRAJ_CIRCULAR_MOVE>(m));
    case EMC_TRAJ_PROBE_TYPE: return motion_.probe(as<EMC_TRAJ_PROBE>(m));
    case EMC_TRAJ_RIGID_TAP_TYPE: return motion_.rigid_tap(as<EMC_TRAJ_RIGID_TAP>(m));
    case EMC_TRAJ_CLEAR_PROBE_TRIPPED_FLAG_TYPE:
        stat_.motion.traj.probe_tripped = false;
        return motion_.send(EMCMOT_CLEAR_PROBE_FLAGS);
    case EMC_TRAJ_SET_VELOCITY_TYPE:
        return motion_.set_velocity(as<EMC_TRAJ_SET_VELOCITY>(m).velocity, as<EMC_TRAJ_SET_VELOCITY>(m).ini_maxvel);
    case EMC_TRAJ_SET_ACCELERATION_TYPE: return motion_.set_acceleration(as<EMC_TRAJ_SET_ACCELERATION>(m).acceleration);
    case EMC_TRAJ_SET_TERM_COND_TYPE:
        {
            const EMC_TRAJ_SET_TERM_COND &c = as<EMC_TRAJ_SET_TERM_COND>(m);
            if (c.planner_type > 0 && settings_.smooth_planner == 0) {
                operator_error("G64 R>0: no smooth planner available on this machine - set [TRAJ]MAX_LINEAR_JERK / "
                               "[TRAJ]SMOOTH_PLANNER");
                return -1;
            }
            int r = motion_.set_term_cond(c.cond, c.tolerance);
            if (r == 0 && c.planner_type >= 0)
                r = motion_.set_planner_type(c.planner_type > 0 ? settings_.smooth_planner : 0);
            if (r == 0 && c.scurve_peak_scale >= 0) r = motion_.set_scurve_peak_scale(c.scurve_peak_scale);
            return r;
        }
    case EMC_TRAJ_SET_SPINDLESYNC_TYPE:
        {
            const EMC_TRAJ_SET_SPINDLESYNC &c = as<EMC_TRAJ_SET_SPINDLESYNC>(m);
            return motion_.set_spindlesync(c.spindle, c.feed_per_revolution, c.velocity_mode);
        }
    case EMC_TRAJ_SET_OFFSET_TYPE:
        t.toolOffset = as<EMC_TRAJ_SET_OFFSET>(m).offset;
        return motion_.set_offset(t.toolOffset);
    case EMC_TRAJ_SET_G5X_TYPE:
        t.g5x_offset = as<EMC_TRAJ_SET_G5X>(m).origin;
        t.g5x_index = as<EMC_TRAJ_SET_G5X>(m).g5x_index;
        return 0;
    case EMC_TRAJ_SET_G92_TYPE: t.g92_offset = as<EMC_TRAJ_SET_G92>(m).origin; return 0;
    case EMC_TRAJ_SET_ROTATION_TYPE: t.rotation_xy = as<EMC_TRAJ_SET_ROTATION>(m).rotation; return 0;
    case EMC_TRAJ_SET_FO_ENABLE_TYPE: return motion_.enable_flag(EMCMOT_FS_ENABLE, as<EMC_TRAJ_SET_FO_ENABLE>(m).mode);
    case EMC_TRAJ_SET_FH_ENABLE_TYPE: return motion_.enable_flag(EMCMOT_FH_ENABLE, as<EMC_TRAJ_SET_FH_ENABLE>(m).mode);
    case EMC_TRAJ_SET_SO_ENABLE_TYPE:
        return motion_.enable_flag(EMCMOT_SS_ENABLE, as<EMC_TRAJ_SET_SO_ENABLE>(m).mode,
                                   as<EMC_TRAJ_SET_SO_ENABLE>(m).spindle);
    case EMC_MOTION_ADAPTIVE_TYPE: return motion_.enable_flag(EMCMOT_AF_ENABLE, as<EMC_MOTION_ADAPTIVE>(m).status);
    case EMC_TRAJ_DELAY_TYPE:
        delay_until_ = kerf_clock_now_ns() + static_cast<int64_t>(as<EMC_TRAJ_DELAY>(m).delay * 1e9);
        return 0;
    case EMC_MOTION_SET_AOUT_TYPE:
        {
            const EMC_MOTION_SET_AOUT &o = as<EMC_MOTION_SET_AOUT>(m);
            return motion_.set_aout(o.index, o.start, o.end, o.now);
        }
    case EMC_MOTION_SET_DOUT_TYPE:
        {
            const EMC_MOTION_SET_DOUT &o = as<EMC_MOTION_SET_DOUT>(m);
            return motion_.set_dout(o.index, o.start, o.end, o.now);
        }
    case EMC_AUX_INPUT_WAIT_TYPE:
        input_ = as<EMC_AUX_INPUT_WAIT>(m);
        input_armed_ = false;
        input_watched_ = input_.timeout != 0 && input_.wait_type != WAIT_MODE_IMMEDIATE;
        t.input_timeout = input_watched_;
        delay_until_ = kerf_clock_now_ns() + (input_watched_ ? static_cast<int64_t>(input_.timeout * 1e9) : 0);
        return 0;

    case EMC_SPINDLE_ON_TYPE:
        {
            const EMC_SPINDLE_ON &s = as<EMC_SPINDLE_ON>(m);
            return motion_.spindle_on(s.spindle, s.speed, s.factor, s.xoffset, s.wait_for_spindle_at_speed);
        }
    case EMC_SPINDLE_SPEED_TYPE:
        {
            const EMC_SPINDLE_SPEED &s = as<EMC_SPINDLE_SPEED>(m);
            return motion_.spindle_speed(s.spindle, s.speed, s.factor, s.xoffset);
        }
        case EMC_SPINDLE_OFF_TYPE:
            return motion_.spindle_off(as<EMC_SPINDLE_OFF>(m).spindle,
                                       as<EMC_SPINDLE_OFF>(m).wait_for_spindle_at_speed);
        case EMC_SPINDLE_BRAKE_RELEASE_TYPE:
            return motion_.spindle_command(EMCMOT_SPINDLE_BRAKE_RELEASE, as<EMC_SPINDLE_BRAKE_RELEASE>(m).spindle);
        case EMC_SPINDLE_BRAKE_ENGAGE_TYPE:
            return motion_.spindle_command(EMCMOT_SPINDLE_BRAKE_ENGAGE, as<EMC_SPINDLE_BRAKE_ENGAGE>(m).spindle);
        case EMC_SPINDLE_ORIENT_TYPE:
            return motion_.spindle_orient(as<EMC_SPINDLE_ORIENT>(m).spindle, as<EMC_SPINDLE_ORIENT>(m).orientation,
                                          as<EMC_SPINDLE_ORIENT>(m).mode);
        case EMC_SPINDLE_WAIT_ORIENT_COMPLETE_TYPE:
            orient_until_ =
                kerf_clock_now_ns() + static_cast<int64_t>(as<EMC_SPINDLE_WAIT_ORIENT_COMPLETE>(m).timeout * 1e9);
            return 0;

        case EMC_COOLANT_MIST_ON_TYPE: return io_.mist(true);
        case EMC_COOLANT_MIST_OFF_TYPE: return io_.mist(false);
        case EMC_COOLANT_FLOOD_ON_TYPE: return io_.flood(true);
        case EMC_COOLANT_FLOOD_OFF_TYPE: return io_.flood(false);
        case EMC_TOOL_PREPARE_TYPE: return io_.prepare(as<EMC_TOOL_PREPARE>(m).tool);
        case EMC_TOOL_LOAD_TYPE: return io_.load();
        case EMC_TOOL_UNLOAD_TYPE: return io_.unload();
        case EMC_TOOL_LOAD_TOOL_TABLE_TYPE: return io_.load_table(as<EMC_TOOL_LOAD_TOOL_TABLE>(m).file);
        case EMC_TOOL_SET_OFFSET_TYPE: return io_.set_offset(as<EMC_TOOL_SET_OFFSET>(m));
        case EMC_TOOL_SET_NUMBER_TYPE: return io_.set_number(as<EMC_TOOL_SET_NUMBER>(m).tool);

        case OffsetsNow::NUMBER: executed_offsets_ = as<OffsetsNow>(m); return 0;
        case EMC_TASK_PLAN_PAUSE_TYPE: return plan_pause();
        case EMC_TASK_PLAN_OPTIONAL_STOP_TYPE: return canon_->optional_stop ? plan_pause() : 0;
        case EMC_TASK_PLAN_END_TYPE: return 0;
        case EMC_TASK_PLAN_INIT_TYPE: return plan_init();
        case EMC_TASK_PLAN_RUN_TYPE: return plan_run(as<EMC_TASK_PLAN_RUN>(m).line);
        case EMC_TASK_PLAN_SYNCH_TYPE: synch(); return 0;
        case EMC_TASK_PLAN_EXECUTE_TYPE: return plan_execute(as<EMC_TASK_PLAN_EXECUTE>(m).command);
        default: rcs_print_error("task has no order %s (%d)\n", emc_symbol_lookup(m._type), m._type); return -1;
    }
}
