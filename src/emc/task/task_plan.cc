// SPDX-License-Identifier: GPL-2.0-or-later
//
// task_plan.cc - what commands do, reading ahead in a program, MDI.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "kerf_clock.h"
#include "rcs_print.hh"
#include "task.hh"
#include "task_text.hh"

namespace {
constexpr int64_t CHAIN_PATIENCE_NS = 500'000'000; // for relays of an emergency stop chain to close
constexpr size_t COPY_A_CYCLE = 1024 * 1024; // bytes of a program, a few ms; shorter ones are open at once

// Of commands that are given while a program is being opened: those that need it.
bool needs_program(NMLTYPE type) {
    switch (type) {
    case EMC_TASK_PLAN_RUN_TYPE:
    case EMC_TASK_PLAN_STEP_TYPE:
    case EMC_TASK_PLAN_RESTORE_TYPE:
    case EMC_TASK_PLAN_EXECUTE_TYPE:
    case EMC_TASK_PLAN_CLOSE_TYPE:
    case EMC_TASK_PLAN_INIT_TYPE:
    case EMC_TASK_SET_MODE_TYPE: return true;
    default: return false;
    }
}
}

void Task::plan() {
    EMC_TASK_STAT &t = stat_.task;
    if (wait_ && idle()) wait_ = false;
    bool fresh = command_ && command_serial_ != stat_.echo_serial_number;
    if (opening_ && copy_program(fresh && needs_program(command_.type()) ? SIZE_MAX : COPY_A_CYCLE) != 0) {
        plan_error_ = true;
        control_error_ |= control_.owned_by(command_writer_);
    }
    Situation s = situation(t);
    bool took = false; // a command was done, which takes the place of reading ahead
    if (fresh) {
        const NMLmsg &m = *command_;
        if (error_stop_due_) watch_program_error();
        Answer a = refused_stranger_ ? Answer::no : accept(m._type, s);
        if (a == Answer::manual) a = t.mode == EMC_TASK_MODE_MANUAL ? Answer::yes : Answer::ignore;
        int r = 0;
        const char *bad = a == Answer::yes || a == Answer::queue ? field_without_number(m) : nullptr;
        if (bad) r = refuse_number(m, bad);
        else switch (a) {
        case Answer::yes:
            r = do_command(m);
            took = m._type != EMC_TASK_PLAN_STEP_TYPE;
            break;
        case Answer::queue:
            list_.append(m, 0);
            wait_and_synch();
            break;
        case Answer::ignore:
            if (m._type == EMC_TASK_PLAN_RUN_TYPE && motion_.external_offsets_applied()) r = -1;
            break;
        default:
            r = refused_stranger_ ? refuse_stranger(m) : refuse(m, s);
            break;
        }
        if (Control::ends_control(m)) control_.release();
        if (r != 0 && !refused_stranger_) {
            plan_error_ = true;
            control_error_ |= control_.owned_by(command_writer_);
        }
    }
    switch (s) {
    case Situation::auto_idle: if (restore_ == Restore::looking) look_ahead(); break;
    case Situation::auto_reading:
        if (restore_ == Restore::tool) restore_step();
        else if (!took) read_ahead();
        break;
    case Situation::auto_waiting: if (!took) finish_program(); break;
    case Situation::mdi: mdi_cycle(); break;
    default: break;
    }
}

int Task::refuse(const NMLmsg &m, Situation s) {
    const char *name = emc_symbol_lookup(m._type);
    char text[LINELEN];
    switch (s) {
    case Situation::off:
        snprintf(text, sizeof text, "command (%s) cannot be executed until the machine is out of E-stop and turned on",
                 name);
        break;
    case Situation::manual: snprintf(text, sizeof text, "can't do that (%s:%d) in manual mode", name, m._type); break;
    case Situation::auto_idle:
        snprintf(text, sizeof text, "can't do that (%s) in auto mode with the interpreter idle", name);
        break;
    case Situation::auto_reading:
        snprintf(text, sizeof text, "can't do that (%s) in auto mode with the interpreter reading", name);
        break;
    case Situation::auto_paused:
        snprintf(text, sizeof text, "can't do that (%s) in auto mode with the interpreter paused", name);
        break;
    case Situation::auto_waiting:
        snprintf(text, sizeof text, "can't do that (%s) in auto mode with the interpreter waiting", name);
        break;
    case Situation::mdi: snprintf(text, sizeof text, "can't do that (%s:%d) in MDI mode", name, m._type); break;
    }
    operator_error(text);
    return -1;
}

int Task::refuse_stranger(const NMLmsg &m) {
    operator_error((control_.name() + " has control of the machine: " + emc_symbol_lookup(m._type) +
                    " of another program was refused. Abort ends its control")
                       .c_str());
    return -1;
}

int Task::refuse_number(const NMLmsg &m, const char *field) {
    const std::string name = emc_symbol_lookup(m._type);
    operator_error((name + " was refused: its " + field + " is no finite number").c_str());
    return -1;
}

int Task::take_control(const char *name) {
    if (control_.take(command_writer_, *name ? name : "a program")) {
        stat_.control_serial = command_serial_;
        control_error_ = false;
        return 0;
    }
    operator_error(control_.taken() ? (control_.name() + " has control of the machine").c_str()
                                    : "Nobody knows which program wants control of the machine");
    return -1;
}

void Task::wait_and_synch() {
    wait_ = true;
    canon_->FINISH(); // a line that could have been joined with the next one is waited for, too
    list_.append(EMC_TASK_PLAN_SYNCH(), interp_->line());
}

// ---- commands that only the operator gives; the rest is shared with the list ----

int Task::do_command(const NMLmsg &m) {
    if (debug_ & EMC_DEBUG_TASK_ISSUE)
        rcs_print("Issuing %s -- \t (%d)\n", emc_symbol_lookup(m._type), command_serial_);
    switch (m._type) {
    case EMC_TASK_SET_MODE_TYPE: return set_mode(as<EMC_TASK_SET_MODE>(m).mode);
    case EMC_TASK_SET_STATE_TYPE: return set_state(as<EMC_TASK_SET_STATE>(m).state);
    case EMC_TASK_ABORT_TYPE:
        {
            abort_task();
            motion_.traj_abort();
            io_.abort(EMC_ABORT_TASK_ABORT);
            all_spindles_off();
            on_abort(EMC_ABORT_TASK_ABORT);
        }
        return 0;
    case EMC_TASK_PLAN_OPEN_TYPE: return plan_open(as<EMC_TASK_PLAN_OPEN>(m));
    case EMC_TASK_PLAN_CLOSE_TYPE: return plan_close();
    case EMC_TASK_PLAN_RUN_TYPE:
        if (const int line = as<EMC_TASK_PLAN_RUN>(m).line; run_from_line_restores_ && line > 0)
            return plan_restore(line);
        else return plan_run(line);
    case EMC_TASK_PLAN_RESTORE_TYPE: return plan_restore(as<EMC_TASK_PLAN_RESTORE>(m).line);
    case EMC_TASK_PLAN_RESTORE_CONFIRM_TYPE: return plan_restore_confirm(as<EMC_TASK_PLAN_RESTORE_CONFIRM>(m).line);
    case EMC_TASK_TAKE_CONTROL_TYPE: return take_control(as<EMC_TASK_TAKE_CONTROL>(m).name);
    case EMC_TASK_RELEASE_CONTROL_TYPE:
        if (control_.owned_by(command_writer_)) control_.release();
        return 0;
    case EMC_TASK_MDI_CANCEL_TYPE: return mdi_cancel(as<EMC_TASK_MDI_CANCEL>(m).line_serial);
    case EMC_TASK_PLAN_STEP_TYPE: return plan_step();
    case EMC_TASK_PLAN_RESUME_TYPE: return plan_resume();
    case EMC_TASK_PLAN_EXECUTE_TYPE: return plan_execute(as<EMC_TASK_PLAN_EXECUTE>(m).command);
    case EMC_TASK_PLAN_REVERSE_TYPE: return motion_.send(EMCMOT_REVERSE);
    case EMC_TASK_PLAN_FORWARD_TYPE: return motion_.send(EMCMOT_FORWARD);
    case EMC_TASK_PLAN_SET_OPTIONAL_STOP_TYPE:
        canon_->optional_stop = as<EMC_TASK_PLAN_SET_OPTIONAL_STOP>(m).state;
        return 0;
    case EMC_TASK_PLAN_SET_BLOCK_DELETE_TYPE:
        canon_->block_delete = as<EMC_TASK_PLAN_SET_BLOCK_DELETE>(m).state;
        return 0;
    case EMC_SET_DEBUG_TYPE:
        debug_ = as<EMC_SET_DEBUG>(m).debug;
        stat_.debug = static_cast<int>(debug_);
        return motion_.set_debug(debug_);
    case EMC_JOINT_SET_BACKLASH_TYPE:
        return motion_.set_joint_backlash(as<EMC_JOINT_SET_BACKLASH>(m).joint, as<EMC_JOINT_SET_BACKLASH>(m).backlash);
    case EMC_JOINT_SET_HOMING_PARAMS_TYPE: return motion_.set_homing_params(as<EMC_JOINT_SET_HOMING_PARAMS>(m));
    case EMC_JOINT_SET_FERROR_TYPE:
        return motion_.set_joint_ferror(as<EMC_JOINT_SET_FERROR>(m).joint, as<EMC_JOINT_SET_FERROR>(m).ferror);
    case EMC_JOINT_SET_MIN_FERROR_TYPE:
        return motion_.set_joint_min_ferror(as<EMC_JOINT_SET_MIN_FERROR>(m).joint,
                                            as<EMC_JOINT_SET_MIN_FERROR>(m).ferror);
    case EMC_JOINT_SET_MIN_POSITION_LIMIT_TYPE:
        return motion_.set_joint_min_limit(as<EMC_JOINT_SET_MIN_POSITION_LIMIT>(m).joint,
                                           as<EMC_JOINT_SET_MIN_POSITION_LIMIT>(m).limit);
    case EMC_JOINT_SET_MAX_POSITION_LIMIT_TYPE:
        return motion_.set_joint_max_limit(as<EMC_JOINT_SET_MAX_POSITION_LIMIT>(m).joint,
                                           as<EMC_JOINT_SET_MAX_POSITION_LIMIT>(m).limit);
    case EMC_JOINT_HALT_TYPE: return motion_.jog_stop(as<EMC_JOINT_HALT>(m).joint, 1);
    case EMC_JOINT_HOME_TYPE: return motion_.home(as<EMC_JOINT_HOME>(m).joint);
    case EMC_JOINT_UNHOME_TYPE: return motion_.unhome(as<EMC_JOINT_UNHOME>(m).joint);
    case EMC_JOINT_OVERRIDE_LIMITS_TYPE: return override_limits(as<EMC_JOINT_OVERRIDE_LIMITS>(m).joint);
    case EMC_JOINT_LOAD_COMP_TYPE:
        {
            const EMC_JOINT_LOAD_COMP &c = as<EMC_JOINT_LOAD_COMP>(m);
            return motion_.load_comp(c.joint, c.file, c.type);
        }
    case EMC_JOG_CONT_TYPE:
        {
            const EMC_JOG_CONT &j = as<EMC_JOG_CONT>(m);
            if (j.joint_or_axis >= 0 && j.joint_or_axis < (j.jjogmode ? EMCMOT_MAX_JOINTS : EMCMOT_MAX_AXIS))
                jog_owners_.started({j.joint_or_axis, j.jjogmode ? 1 : 0}, command_writer_);
            return motion_.jog_cont(j.joint_or_axis, j.vel, j.jjogmode);
        }
    case EMC_JOG_INCR_TYPE:
        {
            const EMC_JOG_INCR &j = as<EMC_JOG_INCR>(m);
            jog_owners_.ended({j.joint_or_axis, j.jjogmode ? 1 : 0});
            return motion_.jog_incr(j.joint_or_axis, j.incr, j.vel, j.jjogmode);
        }
    case EMC_JOG_ABS_TYPE:
        {
            const EMC_JOG_ABS &j = as<EMC_JOG_ABS>(m);
            jog_owners_.ended({j.joint_or_axis, j.jjogmode ? 1 : 0});
            return motion_.jog_abs(j.joint_or_axis, j.pos, j.vel, j.jjogmode);
        }
    case EMC_JOG_STOP_TYPE:
        {
            const EMC_JOG_STOP &j = as<EMC_JOG_STOP>(m);
            jog_owners_.ended({j.joint_or_axis, j.jjogmode ? 1 : 0});
            return motion_.jog_stop(j.joint_or_axis, j.jjogmode);
        }
    case EMC_TRAJ_SET_TELEOP_ENABLE_TYPE:
        return motion_.set_mode(as<EMC_TRAJ_SET_TELEOP_ENABLE>(m).enable ? EMC_TRAJ_MODE_TELEOP : EMC_TRAJ_MODE_FREE);
    case EMC_TRAJ_SET_SCALE_TYPE: return motion_.scale(EMCMOT_FEED_SCALE, as<EMC_TRAJ_SET_SCALE>(m).scale);
    case EMC_TRAJ_SET_RAPID_SCALE_TYPE: return motion_.scale(EMCMOT_RAPID_SCALE, as<EMC_TRAJ_SET_RAPID_SCALE>(m).scale);
    case EMC_TRAJ_SET_MAX_VELOCITY_TYPE: return motion_.set_max_velocity(as<EMC_TRAJ_SET_MAX_VELOCITY>(m).velocity);
    case EMC_TRAJ_SET_SPINDLE_SCALE_TYPE:
        return motion_.scale(EMCMOT_SPINDLE_SCALE, as<EMC_TRAJ_SET_SPINDLE_SCALE>(m).scale,
                             as<EMC_TRAJ_SET_SPINDLE_SCALE>(m).spindle);
    case EMC_TRAJ_PAUSE_TYPE: stat_.task.task_paused = 1; return motion_.send(EMCMOT_PAUSE);
    case EMC_TRAJ_RESUME_TYPE: stat_.task.task_paused = 0; return motion_.send(EMCMOT_RESUME);
    case EMC_TRAJ_ABORT_TYPE: return motion_.traj_abort();
    case EMC_SPINDLE_INCREASE_TYPE:
        if (hands_at_the_spindle()) return -1;
        return motion_.spindle_command(EMCMOT_SPINDLE_INCREASE, as<EMC_SPINDLE_INCREASE>(m).spindle);
    case EMC_SPINDLE_DECREASE_TYPE:
        return motion_.spindle_command(EMCMOT_SPINDLE_DECREASE, as<EMC_SPINDLE_DECREASE>(m).spindle);
    case EMC_SPINDLE_CONSTANT_TYPE: return 0;
    case EMC_SPINDLE_ON_TYPE:
        if (hands_at_the_spindle()) return -1;
        {
            EMC_SPINDLE_ON on = as<EMC_SPINDLE_ON>(m);
            if (stat_.task.interpState != EMC_TASK_INTERP_IDLE) motion_.keep_surface_speed(&on);
            switched_by_hand(on.spindle, on.speed > 0 ? 1 : on.speed < 0 ? -1 : 0);
            return issue(on);
        }
    case EMC_SPINDLE_OFF_TYPE:
        switched_by_hand(as<EMC_SPINDLE_OFF>(m).spindle, 0);
        return issue(m);
    case EMC_COOLANT_MIST_ON_TYPE:
    case EMC_COOLANT_MIST_OFF_TYPE:
    case EMC_COOLANT_FLOOD_ON_TYPE:
    case EMC_COOLANT_FLOOD_OFF_TYPE:
        {
            const int r = issue(m);
            if (stat_.task.interpState == EMC_TASK_INTERP_IDLE)
                interp_->coolant_switched(stat_.io.coolant.mist, stat_.io.coolant.flood);
            return r;
        }
    case EMC_NULL_TYPE: return 0;
    default: return issue(m);
    }
}

// Until a tool change is confirmed nobody starts a spindle. True with a message.
bool Task::hands_at_the_spindle() {
    if (!io_.changing()) return false;
    operator_error("No spindle starts while a tool change waits for its confirmation (iocontrol.0.tool-changed)");
    return true;
}

// What a program does next, and what it saves and restores, follows the operator's hand.
void Task::switched_by_hand(int spindle, int dir) {
    canon_->spindle_is(spindle, dir);
    if (stat_.task.interpState != EMC_TASK_INTERP_IDLE) return; // a program that is read ahead has its own state
    interp_->spindle_switched(spindle, dir > 0 ? CANON_CLOCKWISE : dir < 0 ? CANON_COUNTERCLOCKWISE : CANON_STOPPED);
}

int Task::set_mode(int mode) {
    EMC_TASK_STAT &t = stat_.task;
    if (mode != t.mode && t.mode == EMC_TASK_MODE_AUTO && t.interpState != EMC_TASK_INTERP_IDLE) {
        operator_error("Can't switch mode while mode is AUTO and interpreter is not IDLE");
        return 0;
    }
    if (mode < EMC_TASK_MODE_MANUAL || mode > EMC_TASK_MODE_MDI) return -1;
    if (mode == EMC_TASK_MODE_MANUAL && t.mode != EMC_TASK_MODE_MANUAL) {
        abort_task();
        t.currentLine = 0;
        stop_stepping();
        clear_program();
        synch_later();
    }
    if (stat_.motion.jogging_active) {
        rcs_print("Ignoring task mode change while jogging\n");
        return 0;
    }
    if (mode == EMC_TASK_MODE_MANUAL) {
        requested_mode_ = mode;
        return motion_.set_mode(all_homed() ? EMC_TRAJ_MODE_TELEOP : EMC_TRAJ_MODE_FREE);
    }
    int r = motion_.set_mode(EMC_TRAJ_MODE_COORD);
    abort_task();
    synch();
    requested_mode_ = mode;
    return r;
}

int Task::set_state(int state) {
    switch (state) {
    case EMC_TASK_STATE_ON:
        {
            io_.flood(false);
            if (fault_stop_.waiting()) all_spindles_off();
            if (!stat_.io.aux.estop) return leave_limit_switch() ? motion_.enable() : -1;
            operator_error("The machine stays off: the emergency stop chain is open (iocontrol.0.emc-enable-in)");
            return -1;
        }
    case EMC_TASK_STATE_OFF:
        motion_.traj_abort();
        all_spindles_off();
        motion_.disable();
        io_.abort(EMC_ABORT_TASK_STATE_OFF);
        io_.flood(false);
        abort_task();
        motion_.unhome(-2);
        on_abort(EMC_ABORT_TASK_STATE_OFF);
        synch();
        return 0;
    case EMC_TASK_STATE_ESTOP_RESET:
        io_.estop_off();
        chain_due_ = kerf_clock_now_ns() + CHAIN_PATIENCE_NS;
        io_.flood(false);
        abort_task();
        io_.abort(EMC_ABORT_TASK_STATE_ESTOP_RESET);
        all_spindles_off();
        on_abort(EMC_ABORT_TASK_STATE_ESTOP_RESET);
        synch();
        return 0;
    case EMC_TASK_STATE_ESTOP:
        chain_due_ = 0;
        motion_.traj_abort();
        all_spindles_off();
        io_.estop_on();
        motion_.disable();
        io_.flood(false);
        abort_task();
        io_.abort(EMC_ABORT_TASK_STATE_ESTOP);
        all_spindles_off();
        motion_.unhome(-2);
        on_abort(EMC_ABORT_TASK_STATE_ESTOP);
        synch();
        return 0;
    default: return -1;
    }
}

// ---- programs ----

int Task::plan_open(const EMC_TASK_PLAN_OPEN &m) {
    std::string name = m.file;
    if (m.remote_filesize > 0) { // comes in pieces from another machine
        if (upload_fd_ < 0) {
            plan_close();
            const char *tmp = getenv("TMPDIR");
            std::string base =
                name.substr(name.find_last_of('/') == std::string::npos ? 0 : name.find_last_of('/') + 1);
            upload_name_ = std::string(tmp && *tmp ? tmp : "/tmp") + "/" + base + ".XXXXXX";
            upload_fd_ = mkstemp(upload_name_.data());
            upload_done_ = 0;
            if (upload_fd_ < 0) {
                operator_error(("can't open " + upload_name_).c_str());
                return -1;
            }
        }
        size_t n = std::min(m.remote_buffersize, sizeof m.remote_buffer);
        if (write(upload_fd_, m.remote_buffer, n) != static_cast<ssize_t>(n)) {
            close(upload_fd_);
            unlink(upload_name_.c_str());
            upload_fd_ = -1;
            operator_error(("can't write " + upload_name_).c_str());
            return -1;
        }
        upload_done_ += n;
        if (upload_done_ < m.remote_filesize) return 0;
        close(upload_fd_);
        upload_fd_ = -1;
        name = upload_name_;
    } else {
        plan_close(); // clients that open a second program need not close the first
    }
    forget_restore();
    stat_.task.motionLine = stat_.task.currentLine = stat_.task.readLine = 0;
    forget_fault();
    opening_ = ngc::ProgramCopy::begin(name);
    if (opening_) return copy_program(COPY_A_CYCLE);
    return open_failed(name, interp_->open(name.c_str())); // it says why
}

// Copies some more of the program that is being opened; when it is there, opens it.
int Task::copy_program(size_t bytes) {
    const int more = opening_->step(bytes);
    if (more > 0) {
        eager_ = true;
        return 0;
    }
    const std::shared_ptr<ngc::ProgramCopy> copy = std::move(opening_);
    if (more < 0) {
        operator_error(("can't read " + copy->path() + ": " + strerror(errno)).c_str());
        return -1;
    }
    const std::shared_ptr<ngc::ProgramCopy> before = copies_->program();
    copies_->set_program(copy);
    const std::string name = copy->path();
    if (const int r = interp_->open(name.c_str()); r != INTERP_OK) {
        copies_->set_program(before); // that one stays open
        return open_failed(name, r);
    }
    program_ = name;
    copy_text(stat_.program_hash, copy->hash().c_str());
    copy_text(stat_.task.file, name.c_str());
    return 0;
}

int Task::open_failed(const std::string &name, int code) {
    interp_failed(code, false);
    stat_.task.interpState = EMC_TASK_INTERP_IDLE;
    error_stop_due_ = false;
    operator_error(("can't open " + name).c_str());
    return -1;
}

int Task::plan_close() {
    int r = interp_->close();
    if (!upload_name_.empty()) {
        unlink(upload_name_.c_str());
        upload_name_.clear();
    }
    if (r > INTERP_MIN_ERROR) {
        operator_error("failed to close file");
        return -1;
    }
    return 0;
}

int Task::plan_init() {
    interp_->set_mdi_slice(0);
    int r = interp_->init(interp_options());
    if (r > INTERP_MIN_ERROR) {
        operator_error(interp_->error_text(r));
        if (!interp_->fault().file.empty()) rcs_print_error("%s\n", interp_->fault().report().c_str());
        return r;
    }
    if (auto code = ini_.findString("RS274NGC_STARTUP_CODE", "RS274NGC");
        code && !code->empty() && code->size() < LINELEN) {
        do r = interp_->execute(r == INTERP_EXECUTE_FINISH ? nullptr : code->c_str());
        while (r == INTERP_EXECUTE_FINISH && interp_->call_level() > 0);
        if (r == INTERP_EXECUTE_FINISH) r = INTERP_OK;
        if (r > INTERP_MIN_ERROR) operator_error(interp_->error_text(r));
        interp_->set_mdi_slice(static_cast<int>(interp_max_len_));
        if (r > INTERP_MIN_ERROR && !ini_.findStringV("INTERPRETER", "TASK", "").empty())
            return 0; // it is of another language
        return r;
    }
    interp_->set_mdi_slice(static_cast<int>(interp_max_len_));
    return 0;
}

// Homed, and the program is the one that was opened; false with a message.
bool Task::may_run() {
    if (!all_homed() && !settings_.no_force_homing) {
        operator_error("Can't run a program when not homed");
        return false;
    }
    if (program_.empty()) {
        operator_error("No program is open");
        return false;
    }
    const std::string other = copies_->changed();
    if (other.empty()) return true;
    operator_error(other == program_
                       ? (other + " was changed after it was opened: open it again to run what it says now").c_str()
                       : (other + " was changed after " + program_ +
                          " had called it: open the program again to run what it says now")
                             .c_str());
    return false;
}

// What a running program calls may change on disk: it goes on with what it has, and says so.
void Task::watch_copies() {
    constexpr int64_t EVERY_NS = 500'000'000;
    if (stat_.task.mode != EMC_TASK_MODE_AUTO || stat_.task.interpState == EMC_TASK_INTERP_IDLE) return;
    const int64_t now = kerf_clock_now_ns();
    if (now < copies_looked_at_ + EVERY_NS) return;
    copies_looked_at_ = now;
    for (const std::string &path : copies_->news())
        operator_text((path + " was changed on disk. The program goes on with it as it was when first called; "
                              "open the program again to take the new one")
                          .c_str());
}

int Task::plan_run(int line) {
    EMC_TASK_STAT &t = stat_.task;
    if (!may_run()) return -1;
    forget_restore();
    stop_stepping();
    error_stop_due_ = false;
    t.interpreter_errcode = 0;
    forget_fault();
    if (!interp_->file_open())
        if (const int r = interp_->open(program_.c_str()); r != INTERP_OK) return open_failed(program_, r);
    start_line_ = line;
    running_tag_ = {};
    t.interpState = EMC_TASK_INTERP_READING;
    t.task_paused = 0;
    return 0;
}

int Task::plan_step() {
    EMC_TASK_STAT &t = stat_.task;
    switch (t.interpState) {
    case EMC_TASK_INTERP_IDLE:
        if (plan_run(0) != 0) return -1;
        motion_.send(EMCMOT_PAUSE);
        remembered_interp_ = EMC_TASK_INTERP_READING;
        t.interpState = EMC_TASK_INTERP_PAUSED;
        t.task_paused = 1;
        return 0;
    case EMC_TASK_INTERP_PAUSED:
        stepping_ = step_given_ = stat_.motion.traj.single_stepping = true;
        if (stat_.motion.traj.paused && stat_.motion.traj.queue > 0) motion_.send(EMCMOT_STEP);
        else t.interpState = remembered_interp_;
        t.task_paused = 1;
        return 0;
    default:
        stepping_ = step_given_ = stat_.motion.traj.single_stepping = true;
        return 0;
    }
}

int Task::plan_pause() {
    EMC_TASK_STAT &t = stat_.task;
    int r = motion_.send(EMCMOT_PAUSE);
    if (t.interpState != EMC_TASK_INTERP_PAUSED) remembered_interp_ = t.interpState;
    t.interpState = EMC_TASK_INTERP_PAUSED;
    t.task_paused = 1;
    return r;
}

int Task::plan_resume() {
    int r = motion_.send(EMCMOT_RESUME);
    if (stat_.task.interpState == EMC_TASK_INTERP_PAUSED) // else what is remembered is of an earlier run
        stat_.task.interpState = remembered_interp_;
    stat_.task.task_paused = 0;
    stop_stepping();
    return r;
}

const char *Task::tell_fault(int code) {
    stat_.task.interpreter_errcode = code;
    const Fault &f = interp_->fault();
    stat_.error_line = f.line;
    stat_.error_column = f.column;
    copy_text(stat_.error_file, f.file.c_str());
    copy_text(stat_.error_fix, f.fix.c_str());
    const char *text = interp_->error_text(code);
    operator_error(*text ? text : "Unknown interpreter error");
    return text;
}

void Task::forget_fault() {
    stat_.error_line = stat_.error_column = 0;
    stat_.error_file[0] = stat_.error_fix[0] = 0;
}

void Task::failed_at(int line) {
    if (stat_.error_line > 0 || line <= 0 || stat_.task.mode != EMC_TASK_MODE_AUTO ||
        stat_.task.interpState == EMC_TASK_INTERP_IDLE)
        return;
    stat_.error_line = line;
    copy_text(stat_.error_file, stat_.task.file);
}

// Says what went wrong; the program ends when all it asked for before has been done.
void Task::interp_failed(int code, bool executing) {
    canon_->FINISH(); // moves that are still being joined
    const char *text = tell_fault(code);
    const Fault &f = interp_->fault();
    if (f.line > 0 && !f.text.empty()) {
        printf("%s\n", f.report().c_str());
        fflush(stdout);
    }
    stat_.task.interpState = EMC_TASK_INTERP_WAITING;
    error_stop_due_ = true;
    if (executing) on_abort(EMC_ABORT_INTERPRETER_ERROR, text);
}

// Run from line: true while lines are only looked at. Their messages to the operator stay.
bool Task::skip_line() {
    if (start_line_ == 0) return false;
    int line = interp_->line();
    if (start_line_ > 0 && interp_->call_level() == 0 && line > start_line_) {
        start_line_ = 0;
        return false;
    }
    list_.drop_unless([](const InterpList::Entry &e) {
        switch (e.message.type()) {
        case EMC_OPERATOR_ERROR_TYPE:
        case EMC_TASK_PLAN_SYNCH_TYPE:
        // What the interpreter has in force is so for the display and for motion too.
        case EMC_TRAJ_SET_G5X_TYPE:
        case EMC_TRAJ_SET_G92_TYPE:
        case EMC_TRAJ_SET_ROTATION_TYPE:
        case EMC_TRAJ_SET_OFFSET_TYPE:
        case EMC_TRAJ_SET_TERM_COND_TYPE:
        case OffsetsNow::NUMBER: return true;
        default: return false;
        }
    });
    EmcPose here = stat_.motion.traj.position;
    double lin = stat_.motion.traj.linearUnits, ang = stat_.motion.traj.angularUnits, f = 1;
    if (canon_->GET_EXTERNAL_LENGTH_UNIT_TYPE() == CANON_UNITS_INCHES) f = 25.4;
    if (canon_->GET_EXTERNAL_LENGTH_UNIT_TYPE() == CANON_UNITS_CM) f = 10;
    for (double *p : {&here.tran.x, &here.tran.y, &here.tran.z, &here.u, &here.v, &here.w}) *p /= lin * f;
    for (double *p : {&here.a, &here.b, &here.c}) *p /= ang;
    canon_->ON_RESET();
    canon_->CANON_UPDATE_END_POINT(here);
    if (start_line_ > 0 && interp_->call_level() == 0 && line + 1 == start_line_) {
        synch();
        start_line_ = 0;
    }
    return true;
}

void Task::read_ahead() {
    EMC_TASK_STAT &t = stat_.task;
    for (size_t lines = 0; lines < interp_max_len_; lines++) {
        if (wait_ || list_.size() > interp_max_len_ || (lines > 0 && list_.size() > interp_max_len_ * 2 / 3)) return;
        int r = line_read_ ? INTERP_OK : interp_->read();
        line_read_ = false;
        t.readLine = interp_->line();
        copy_text(t.command, interp_->command());
        list_.set_level(interp_->call_level(), interp_->main_line());
        if (r > INTERP_MIN_ERROR) {
            interp_failed(r, false);
            return;
        }
        if (r == INTERP_ENDFILE || r == INTERP_EXIT) {
            t.interpState = EMC_TASK_INTERP_WAITING;
            t.motionLine = t.readLine = 0;
            return;
        }
        if (r == INTERP_OK) r = interp_->execute();
        note_offsets();
        t.callLevel = interp_->call_level();
        if (r > INTERP_MIN_ERROR) {
            interp_failed(r, true);
            return;
        }
        bool skipping = skip_line();
        if (r == INTERP_EXECUTE_FINISH) {
            wait_and_synch();
        } else if (r == INTERP_EXIT || r == INTERP_ENDFILE) {
            t.interpState = EMC_TASK_INTERP_WAITING;
            if (r == INTERP_ENDFILE) t.motionLine = t.readLine = 0;
            return;
        }
        if (skipping && t.interpState != EMC_TASK_INTERP_READING) return;
    }
}

void Task::finish_program() {
    EMC_TASK_STAT &t = stat_.task;
    if (!idle() || stat_.motion.traj.queue > 0 || stat_.io.status != RCS_DONE) return;
    if (interp_->file_open()) {
        if (plan_close() != 0) plan_error_ = true;
        list_.append(EMC_TASK_PLAN_SYNCH(), t.currentLine);
        return;
    }
    t.interpState = EMC_TASK_INTERP_IDLE;
    t.readLine = t.callLevel = 0;
    start_line_ = 0;
}

// ---- MDI ----

int Task::plan_execute(const char *text) {
    EMC_TASK_STAT &t = stat_.task;
    if (!all_homed() && !settings_.no_force_homing) {
        operator_error("Can't issue MDI command when not homed");
        return -1;
    }
    if (t.mode != EMC_TASK_MODE_MDI) {
        operator_error("Must be in MDI mode to issue MDI command");
        if (t.mode == EMC_TASK_MODE_MANUAL) list_.append(EMC_TASK_PLAN_SYNCH(), 0);
        return -1;
    }
    stop_stepping();
    if (!*text) return 0;
    const bool waits = !mdi_queue_.empty() || wait_ || mdi_continue_ || orders_left();
    if (mdi_queue_max_ == 0 ? waits || t.interpState != EMC_TASK_INTERP_IDLE : mdi_queue_.size() >= mdi_queue_max_) {
        operator_error(mdi_queue_max_ == 0
                           ? "An MDI line is still being executed: the next one was refused ([TASK]MDI_QUEUE = 0)"
                           : ("MDI lines waiting: " + std::to_string(mdi_queue_.size()) +
                              ", as many as [TASK]MDI_QUEUE allows: the next one was refused")
                                 .c_str());
        return -1;
    }
    if (!waits) return mdi_run(text);
    mdi_queue_.push_back({command_serial_, text});
    return 0;
}

// Takes a line out of those that wait; 0: all of them.
int Task::mdi_cancel(int serial) {
    const size_t before = mdi_queue_.size();
    mdi_queue_.erase(std::remove_if(mdi_queue_.begin(), mdi_queue_.end(),
                                    [&](const MdiLine &l) { return serial == 0 || l.serial == serial; }),
                     mdi_queue_.end());
    if (serial == 0 || mdi_queue_.size() < before) return 0;
    operator_error("That MDI line does not wait any more");
    return -1;
}

void Task::show_mdi_queue() {
    stat_.task.queuedMDIcommands = static_cast<int>(mdi_queue_.size());
    for (size_t i = 0; i < EMC_MDI_QUEUE_SHOWN; i++) {
        const bool waits = i < mdi_queue_.size();
        if (!waits && stat_.mdi_serial[i] == 0) return;
        stat_.mdi_serial[i] = waits ? mdi_queue_[i].serial : 0;
        copy_text(stat_.mdi_line[i], waits ? mdi_queue_[i].text.c_str() : "");
    }
}

int Task::mdi_run(const char *text) {
    EMC_TASK_STAT &t = stat_.task;
    copy_text(t.command, text);
    t.interpState = EMC_TASK_INTERP_READING;
    t.interpreter_errcode = 0;
    forget_fault();
    list_.set_level(0);
    return mdi_result(interp_->execute(text, 0));
}

int Task::mdi_result(int r) {
    EMC_TASK_STAT &t = stat_.task;
    t.callLevel = interp_->call_level();
    mdi_continue_ = mdi_sliced_ = false;
    note_offsets();
    if (r > INTERP_MIN_ERROR) {
        tell_fault(r);
        list_.clear();
        abort_task();
        io_.abort(EMC_ABORT_INTERPRETER_ERROR_MDI);
        all_spindles_off();
        on_abort(EMC_ABORT_INTERPRETER_ERROR_MDI, "interpreter error during MDI");
        command_failed();
        return -1;
    }
    if (r == INTERP_EXECUTE_FINISH) {
        mdi_continue_ = interp_->call_level() > 0;
        wait_and_synch();
        return 0;
    }
    if (r == INTERP_OK && interp_->mdi_waits()) {
        mdi_continue_ = mdi_sliced_ = true;
        return 0;
    }
    canon_->FINISH();
    if (r == INTERP_OK) return 0;
    t.interpreter_errcode = r;
    return -1; // M2 by MDI: done, and reported as failed, as documented
}

// A called subroutine goes on. False when there is none.
bool Task::mdi_goes_on() {
    if (!mdi_continue_) return false;
    const bool ready = mdi_sliced_ ? list_.size() <= interp_max_len_ : idle();
    if (ready && mdi_result(interp_->execute(nullptr)) != 0) command_failed();
    return true;
}

void Task::mdi_cycle() {
    EMC_TASK_STAT &t = stat_.task;
    if (wait_ || mdi_goes_on()) return;
    if (!mdi_queue_.empty()) {
        if (orders_left()) return;
        const std::string next = mdi_queue_.front().text;
        mdi_queue_.pop_front();
        if (mdi_run(next.c_str()) != 0) command_failed();
        return;
    }
    if (t.interpState != EMC_TASK_INTERP_IDLE && idle() && stat_.motion.traj.queue == 0 &&
        stat_.io.status == RCS_DONE) {
        t.interpState = EMC_TASK_INTERP_IDLE;
        t.command[0] = 0;
    }
}
