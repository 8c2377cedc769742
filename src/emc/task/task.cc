// SPDX-License-Identifier: GPL-2.0-or-later
//
// task.cc - the cycle, start and end, stopping, status. What commands do: task_plan.cc; the
// list: task_execute.cc.
#include "task.hh"

#include <dlfcn.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "emc_args.hh"
#include "emc/canon/hal_number.hh"
#include "kerf_clock.h"
#include "kerf_paths.h"
#include "nml_config.hh"
#include "rcs_print.hh"
#include "task_text.hh"
#include "timer.hh"

namespace {

constexpr double CHANNEL_RETRY_S = 1.0, CHANNEL_PATIENCE_S = 10.0;
constexpr size_t MESSAGES_MOST = 1000; // to the operator, while nobody reads them
constexpr int64_t MOTION_PATIENCE_NS = 60'000'000'000; // wall time
constexpr int64_t MS = 1'000'000;
constexpr int STARTUP_STEPS = 1000; // of the startup code: messages, and ms of waiting

int64_t wall_ns() {
    timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec * 1'000'000'000LL + t.tv_nsec;
}

} // namespace

Task::Task(std::string ini_file) : ini_file_(std::move(ini_file)), motion_(stat_), io_(stat_) {}

Task::~Task() {
    if (upload_fd_ >= 0) close(upload_fd_);
}

// ---- start and end ----

bool Task::connect_channels() {
    std::string file = ini_.findStringV("NML_FILE", "EMC", "");
    const char *nml = file.empty() ? nullptr : file.c_str();
    auto connect = [&](const char *buffer, std::unique_ptr<NML> *channel) {
        int quiet = verbose_nml_error_messages;
        verbose_nml_error_messages = 0;
        for (double waited = 0;; waited += CHANNEL_RETRY_S) {
            *channel = std::make_unique<NML>(emc_messages(), buffer, "emc", nml);
            if ((*channel)->valid() || (*channel)->status == CMS_CONFIG_ERROR) break;
            if (waited >= CHANNEL_PATIENCE_S) break;
            kerf_clock_sleep_ns(static_cast<int64_t>(CHANNEL_RETRY_S * 1e9));
        }
        verbose_nml_error_messages = quiet;
        if ((*channel)->valid()) return true;
        rcs_print_error("can't get %s buffer\n", buffer);
        return false;
    };
    for (const nml::BufferLine &b : nml::buffers_of(nml ? nml : default_nml_config_file()))
        if (b.name == "emcMessages" && !connect("emcMessages", &log_channel_)) return false;
    return connect("emcCommand", &command_channel_) && connect("emcStatus", &status_channel_) &&
           connect("emcError", &error_channel_);
}

// The built-in interpreter, or the one of the library [TASK]INTERPRETER names; null with a message.
std::unique_ptr<Interp> Task::make_interpreter(TaskCanon &canon) {
    const std::string name = ini_.findStringV("INTERPRETER", "TASK", "");
    std::string why;
    std::unique_ptr<Interp> made = ::make_interpreter(name, canon, &why);
    if (!made) rcs_print_error("emcTaskInit: %s\n", why.c_str());
    else if (!name.empty() && !interp_) rcs_print("emcTaskInit: using custom interpreter '%s'\n", name.c_str());
    return made;
}

InterpOptions Task::interp_options() const {
    InterpOptions options;
    options.ini_file = ini_file_;
    options.task = true;
    options.copies = copies_;
    return options;
}

// What the canon asks of task.
void Task::wire_canon() {
    canon_->source_line = [this] { return interp_ ? interp_->line() : 0; };
    canon_->user_code_exists = [this](int n) { return user_codes_.exists(n); };
    canon_->user_code_command = [this](int n, double p, double q) { return user_codes_.command(n, p, q); };
    canon_->hal_lookup = hal_number;
}

// Is the text a printf format for one int, or none?
static bool takes_one_integer(const std::string &format) {
    int values = 0;
    for (size_t at = 0; (at = format.find('%', at)) != std::string::npos; at++) {
        if (format[at + 1] == '%') {
            at++;
            continue;
        }
        at = format.find_first_not_of("-+ 0123456789", at + 1);
        if (at == std::string::npos || !strchr("dixX", format[at]) || ++values > 1) return false;
    }
    return true;
}

bool Task::start(const volatile int *stop) {
    if (!ini_.open(ini_file_)) return false;
    debug_ = static_cast<unsigned>(set_rcs_print(ini_));
    stat_.debug = static_cast<int>(debug_);
    if (debug_ & EMC_DEBUG_CONFIG)
        rcs_print("task: machine '%s' version '%s'\n", ini_.findStringV("MACHINE", "EMC", "<unknown>").c_str(),
                  ini_.findStringV("VERSION", "EMC", "unknown").c_str());
    if (auto t = ini_.findReal("CYCLE_TIME", "TASK")) cycle_time_ = *t;
    else rcs_print("[TASK] CYCLE_TIME not found in %s; using default %f\n", ini_file_.c_str(), cycle_time_);
    if (int n = ini_.findIntV("INTERP_MAX_LEN", "TASK", 1000); n > 0) interp_max_len_ = static_cast<size_t>(n);
    if (int n = ini_.findIntV("MDI_QUEUE", "TASK", -1); n >= 0) mdi_queue_max_ = static_cast<size_t>(n);
    run_from_line_restores_ = strcasecmp(ini_.findStringV("RUN_FROM_LINE", "TASK", "").c_str(), "restore") == 0;
    if (!fault_stop_.load(ini_)) return false;
    if (auto text = ini_.findString("IO_ERROR", "TASK")) {
        if (takes_one_integer(*text)) io_error_ = *text;
        else rcs_print_error("[TASK]IO_ERROR: '%s' may hold one %%d and no other %%; not used\n", text->c_str());
    }

    stat_.task.mode = EMC_TASK_MODE_MANUAL;
    stat_.task.state = EMC_TASK_STATE_ESTOP;
    stat_.task.execState = EMC_TASK_EXEC_DONE;
    stat_.task.interpState = EMC_TASK_INTERP_IDLE;
    stat_.task.programUnits = CANON_UNITS_MM;
    stat_.task.optional_stop_state = stat_.task.block_delete_state = true;
    for (int &c : stat_.task.activeGCodes) c = -1;
    for (int &c : stat_.task.activeMCodes) c = -1;
    copy_text(stat_.task.ini_filename, ini_file_.c_str());
    for (auto &j : stat_.motion.joint) {
        j.minPositionLimit = -1;
        j.maxPositionLimit = 1;
        j.units = 1;
        j.inpos = 1;
        j.jointType = EMC_LINEAR;
    }
    for (auto &a : stat_.motion.axis) { a.minPositionLimit = -1; a.maxPositionLimit = 1; }
    for (auto &s : stat_.motion.spindle) { s.brake = 1; s.spindle_scale = 1; }

    if (!io_.create(ini_)) return false;
    if (!connect_channels()) return false;
    if (!ini_pins_.create(ini_.findIntV("JOINTS", "KINS", 0))) {
        rcs_print("can't make the HAL component inihal\n");
        return false;
    }
    io_.init();

    // The HAL files load motion after task has started: wait until its first cycle was seen.
    // Each turn gives virtual time one millisecond and the rest of the machine some wall time.
    int64_t patience = wall_ns() + MOTION_PATIENCE_NS;
    while (!(motion_.attach(ini_) && motion_.alive())) {
        if (*stop) return false;
        if (wall_ns() > patience) {
            rcs_print_error(
                "can't connect to motion: no motion module was loaded, or its functions are in no running thread\n");
            return false;
        }
        timespec nap{0, 300'000};
        nanosleep(&nap, nullptr);
        kerf_clock_sleep_ns(MS);
        if (getppid() == 1 && access(ini_file_.c_str(), R_OK) != 0) return false;
    }
    if (load_settings(ini_, stat_, motion_, &settings_) != 0) {
        rcs_print_error("can't initialize motion\n");
        return false;
    }
    canon_settings_.tool_change_position = io_.tool_change_position;
    canon_settings_.parameter_file = ini_.findStringV("PARAMETER_FILE", "RS274NGC", "");
    canon_ = std::make_unique<TaskCanon>(stat_, list_, motion_.limits, canon_settings_);
    wire_canon();
    setenv("INI_FILE_NAME", ini_file_.c_str(), 1);
    update_motion();
    if (interp_ = make_interpreter(*canon_); !interp_) return false;
    interp_->set_loop_on_main_m99(true);
    if (int r = plan_init(); r != 0) {
        rcs_print_error("can't initialize interpreter\n");
        return false;
    }
    interp_->get_offsets(read_offsets_.values);
    executed_offsets_ = read_offsets_;
    user_codes_.scan(ini_, debug_);

    motion_.abort();
    all_spindles_off();
    io_.estop_on();
    motion_.disable();
    io_.abort(EMC_ABORT_TASK_STATE_ESTOP);
    motion_.unhome(-2);
    motion_.set_mode(EMC_TRAJ_MODE_FREE);
    update_motion();
    // What the startup code asked for is in force before the first command, which would clear the list.
    for (int i = 0; i < STARTUP_STEPS && !idle(); i++) {
        const bool waits = stat_.task.execState != EMC_TASK_EXEC_DONE;
        execute();
        if (waits && stat_.task.execState != EMC_TASK_EXEC_DONE) kerf_clock_sleep_ns(MS);
        update_motion();
    }
    open_journal();
    publish();
    ini_pins_.show(settings_); // the launcher starts the screen when these have their values: the status must be there
    return true;
}

// Tells the operator what a power cut or a crash has interrupted.
void Task::open_journal() {
    std::string file = ini_.findStringV(
        "JOURNAL", "TASK", canon_settings_.parameter_file.empty() ? "" : canon_settings_.parameter_file + ".journal");
    if (strcasecmp(file.c_str(), "none") == 0) file.clear();
    std::string trouble;
    cut_ = journal_.open(file, {io_.table(), ini_file_}, &trouble);
    if (!trouble.empty()) operator_error(trouble.c_str());
    if (cut_.empty()) return;
    const std::string program = cut_.get("program");
    stat_.cut_off_line = cut_.line();
    copy_text(stat_.cut_off_file, program.c_str());
    operator_display(("The last run was cut off at line " + cut_.get("line") + " of " +
                      program.substr(program.rfind('/') + 1) + " (" + cut_.get("time") + ", position " +
                      cut_.get("position") +
                      "). Home the machine, open the program and start at that line; all of it is in " + file)
                         .substr(0, LINELEN - 1)
                         .c_str());
    const std::string change = cut_.get("change");
    if (change != "?")
        operator_display(("It was changing to " + change + ": look which tool is in the spindle").c_str());
    rcs_print("%s", cut_.text().c_str());
}

void Task::run(const volatile int *stop) {
    enum { MOST_EAGER = 50 }; // cycles in a row without a rest; a program that loops without motion is eager for ever
    int eager = 0;
    RCS_TIMER timer(cycle_time_);
    double least = 1e9, most = 0, total = 0;
    unsigned excursions = 0;
    const bool quiet = getenv("QUIET_TASK") != nullptr;
    int64_t begin = kerf_clock_now_ns();
    while (!*stop) {
        eager_ = false;
        cycle();
        cycles_++;
        int64_t now = kerf_clock_now_ns();
        double took = static_cast<double>(now - begin) / 1e9;
        begin = now;
        least = std::min(least, took);
        most = std::max(most, took);
        total += took;
        if (cycle_time_ > 0 && took > 10 * cycle_time_ && ++excursions <= 10 && !quiet)
            rcs_print("task: main loop took %.6f seconds\n", took);
        eager = eager_ ? eager + 1 : 0;
        if ((!eager_ || eager >= MOST_EAGER) && cycle_time_ > 0) {
            eager = 0;
            timer.wait(); // an overrun skips whole periods
        }
        io_.cycle();
    }
    double cycles = cycles_ ? static_cast<double>(cycles_) : 1;
    rcs_print(
        "task: %lu cycles, min=%.6f, max=%.6f, avg=%.6f, %u latency excursions (> %dx expected cycle time of %.6fs)\n",
        cycles_, least, most, total / cycles, excursions, 10, cycle_time_);
}

void Task::shutdown() {
    if (interp_) interp_->exit();
    motion_.disable(); // first: a move that waits may switch outputs when it begins
    update_motion();
    for (int s = 0; s < stat_.motion.traj.spindles; s++)
        if (stat_.motion.spindle[s].enabled) motion_.spindle_off(s);
    for (int i = 0; i < EMCMOT_MAX_DIO; i++)
        if (stat_.motion.synch_do[i]) motion_.set_dout(i, 0, 0, 1);
    for (int i = 0; i < EMCMOT_MAX_AIO; i++)
        if (stat_.motion.analog_output[i] != 0) motion_.set_aout(i, 0, 0, 1);
    io_.estop_on(); // what its pins feed keeps the last value
    update_motion();
    if (!settings_.position_file.empty()) motion_.save_positions(settings_.position_file);
    tool_mmap_close();
}

// ---- one cycle ----

void Task::cycle() {
    stat_.task.taskbeat++;
    ini_pins_.poll(settings_, motion_);
    read_command();
    plan();
    execute();
    update_motion();
    watch_enable();
    watch_stalls();
    watch_estop();
    watch_errors();
    recover();
    watch_fault_stop();
    watch_program_error();
    watch_jogs();
    watch_control();
    watch_copies();
    const bool runs = stat_.task.mode == EMC_TASK_MODE_AUTO && stat_.task.interpState != EMC_TASK_INTERP_IDLE;
    if (runs && !cut_.empty()) { // its journal is overwritten
        cut_ = {};
        stat_.cut_off_line = 0;
        stat_.cut_off_file[0] = 0;
    }
    journal_.update(stat_, {program_, stat_.program_hash, main_line_, io_.changing_to()}, runs);
    send_messages();
    publish();
}

void Task::read_command() {
    enum { MOST_BEATS = 16 };
    NMLTYPE type = command_channel_->read();
    // Heartbeats are no commands: what became of the last one stays known, and the next one need not wait.
    for (int n = 0; type == EMC_JOG_HELD_TYPE && n < MOST_BEATS; n++, type = command_channel_->read()) {
        const auto &m = static_cast<const EMC_JOG_HELD &>(*command_channel_->get_address());
        jog_owners_.held({m.joint_or_axis, m.jjogmode ? 1 : 0}, kerf_clock_now_ns());
    }
    if (type <= 0 || type == EMC_JOG_HELD_TYPE) return;
    enum { FLOOD = 8 }; // so many wait behind it: they are taken without a rest, for a stop may be the last of them
    eager_ |= command_channel_->get_queue_length() > FLOOD;
    command_ = AnyMessage(*command_channel_->get_address());
    command_serial_ = static_cast<const RCS_CMD_MSG &>(*command_).serial_number;
    command_writer_ = command_channel_->last_writer();
    refused_stranger_ = !control_.allows(*command_, command_writer_);
    if (refused_stranger_) return; // what became of the owner's command stays known
    plan_error_ = execute_error_ = false;
    if (!control_.owned_by(command_writer_)) return;
    control_error_ = false;
    stat_.control_serial = command_serial_;
}

void Task::command_failed() {
    execute_error_ = true;
    control_error_ = true;
}

void Task::update_motion() {
    std::string error;
    motion_.update(&error);
    if (!error.empty()) {
        EMC_OPERATOR_ERROR m;
        copy_text(m.error, error.c_str());
        operator_message(m, EMC_SOURCE_MOTION); // motion printed it already
    }
    stat_.motion.debug = static_cast<int>(debug_);
    canon_->offsets_applied = motion_.external_offsets_applied();
    canon_->offsets = motion_.external_offsets();
}

void Task::watch_enable() {
    bool enabled = stat_.motion.traj.enabled;
    if (was_enabled_ && !enabled) motion_.unhome(-2);
    was_enabled_ = enabled;
}

// Motion holds by itself what it was doing when the computer stood still.
void Task::watch_stalls() {
    if (motion_.stalls() == stalls_) return;
    stalls_ = motion_.stalls();
    const int ended = motion_.stall_ended();
    if (ended == STALL_PROGRAM) plan_pause();
    double load[1] = {0};
    getloadavg(load, 1);
    const time_t now = time(nullptr);
    struct tm parts;
    char text[LINELEN], when[16];
    strftime(when, sizeof when, "%H:%M:%S", localtime_r(&now, &parts));
    snprintf(text, sizeof text, "%s: the computer stood still for %.3f s (load %.1f on %u CPUs)%s. \"realtime verify\" tells what to "
             "change", when, motion_.stall_time(), load[0], std::thread::hardware_concurrency(),
             ended == STALL_PROGRAM ? ": motion is held on its path, look at the tool and resume"
             : ended == STALL_JOG   ? ": the jog has ended"
                                    : "");
    operator_error(text);
}

void Task::watch_estop() {
    if (chain_due_ != 0 && kerf_clock_now_ns() >= chain_due_) {
        chain_due_ = 0;
        if (stat_.io.aux.estop)
            operator_error("Emergency stop was reset but the chain is open: iocontrol.0.emc-enable-in is FALSE");
    }
    if (!stat_.io.aux.estop) return;
    if (stat_.motion.traj.enabled) {
        chain_due_ = 0;
        operator_error("Emergency stop: the chain has opened (iocontrol.0.emc-enable-in is FALSE)");
        motion_.disable();
        abort_task();
        io_.abort(EMC_ABORT_AUX_ESTOP);
        all_spindles_off();
        motion_.unhome(-2);
        on_abort(EMC_ABORT_AUX_ESTOP);
        synch();
    }
    if (stat_.io.coolant.mist) io_.mist(false);
    if (stat_.io.coolant.flood) io_.flood(false);
    for (int s = 0; s < stat_.motion.traj.spindles; s++)
        if (stat_.motion.spindle[s].enabled) {
            motion_.spindle_off(s);
            canon_->spindle_is(s, 0);
        }
}

void Task::watch_errors() {
    for (const std::string &text : io_.news()) operator_error(text.c_str());
    bool io_failed = stat_.io.status == RCS_ERROR;
    if (io_failed && stat_.io.reason > 0) { // a soft fault: the program goes on
        if (!soft_fault_shown_)
            rcs_print("M6: toolchanger soft fault=%d, reason=%d\n", stat_.io.fault, stat_.io.reason);
        soft_fault_shown_ = true;
        stat_.io.status = RCS_DONE;
        io_failed = false;
    }
    if (stat_.motion.status != RCS_ERROR && !io_failed) return;
    if (io_failed && stat_.io.reason < 0) {
        char text[LINELEN];
        snprintf(text, sizeof text, io_error_.c_str(), stat_.io.reason);
        operator_error(text);
    }
    command_failed(); // also for who looks later
    failed_at(stat_.motion.status == RCS_ERROR && stat_.task.motionLine > 0 ? stat_.task.motionLine
                                                                            : stat_.task.currentLine);
    abort_task();
    io_.abort(EMC_ABORT_MOTION_OR_IO_RCS_ERROR);
    spindles_off_after_fault();
    clear_program();
    on_abort(EMC_ABORT_MOTION_OR_IO_RCS_ERROR);
    synch_later();
}

// A program that ended by an error has done all it was told before the error. Its spindles
// and coolant go off when nobody takes over for half a second, or with the next command.
void Task::watch_program_error() {
    if (!error_stop_due_ || stat_.task.interpState != EMC_TASK_INTERP_IDLE || !idle() || stat_.motion.traj.queue > 0) {
        error_stop_at_ = 0;
        return;
    }
    int64_t now = kerf_clock_now_ns();
    if (error_stop_at_ == 0) error_stop_at_ = now + 500 * MS;
    bool taken_over = command_ && command_serial_ != stat_.echo_serial_number;
    if (now < error_stop_at_ && !taken_over) return;
    error_stop_due_ = false;
    for (int s = 0; s < stat_.motion.traj.spindles; s++)
        if (stat_.motion.spindle[s].enabled) {
            motion_.spindle_off(s);
            canon_->spindle_is(s, 0);
        }
    if (stat_.io.coolant.mist) io_.mist(false);
    if (stat_.io.coolant.flood) io_.flood(false);
}

// A continuous jog ends with the program that started it, or when that one does not get on.
void Task::watch_jogs() {
    if (!jog_owners_.any()) return;
    const int64_t now = kerf_clock_now_ns();
    if (now < jogs_looked_at_ + 20 * MS) return;
    jogs_looked_at_ = now;
    for (const JogOwners::Orphan &o : jog_owners_.orphans(now)) {
        if (!stat_.motion.jogging_active) continue; // it was over
        const auto [number, joint] = o.jog;
        motion_.jog_stop(number, joint);
        operator_error((std::string("Jog of ") + (joint ? "joint " : "axis ") +
                        (joint ? std::to_string(number) : std::string(1, "XYZABCUVW"[number])) +
                        " stopped: the program that started it " + o.why)
                           .c_str());
    }
}

void Task::watch_control() {
    if (control_.taken() && control_.owner_ended()) control_.release();
}

bool Task::all_homed() const {
    const EMC_TRAJ_STAT &t = stat_.motion.traj;
    for (int j = 0; j < t.joints; j++)
        if (!stat_.motion.joint[j].homed) return false;
    return true;
}

bool Task::orders_left() const { return !list_.empty() || pending_.message; }

bool Task::idle() const { return !orders_left() && stat_.task.execState == EMC_TASK_EXEC_DONE; }

void Task::publish() {
    EMC_TASK_STAT &t = stat_.task;
    const EMC_TRAJ_STAT &traj = stat_.motion.traj;

    t.mode = traj.mode == EMC_TRAJ_MODE_COORD
                 ? requested_mode_ == EMC_TASK_MODE_AUTO ? EMC_TASK_MODE_AUTO : EMC_TASK_MODE_MDI
                 : EMC_TASK_MODE_MANUAL;
    t.state = stat_.io.aux.estop ? EMC_TASK_STATE_ESTOP
              : !traj.enabled    ? EMC_TASK_STATE_ESTOP_RESET
                                 : EMC_TASK_STATE_ON;
    bool on = t.state == EMC_TASK_STATE_ON;
    if (was_on_ && !on) {
        control_.release();
        abort_task();
        spindles_off_after_fault();
        io_.abort(EMC_ABORT_TASK_STATE_NOT_ON);
        on_abort(EMC_ABORT_TASK_STATE_NOT_ON);
    }
    was_on_ = on;

    if (traj.id > 0) t.motionLine = traj.id;
    if (debug_ & EMC_DEBUG_MOTION_TIME && traj.id != last_motion_id_) {
        int64_t now = kerf_clock_now_ns();
        if (last_motion_id_ != 0)
            rcs_print("Motion id %d took %f seconds.\n", last_motion_id_,
                      static_cast<double>(now - motion_id_since_) / 1e9);
        motion_id_since_ = now;
    }
    last_motion_id_ = traj.id;
    t.optional_stop_state = canon_->optional_stop;
    t.block_delete_state = canon_->block_delete;
    show_mdi_queue();

    bool busy = t.interpState != EMC_TASK_INTERP_IDLE;
    bool from_tag = busy && t.mode == EMC_TASK_MODE_AUTO &&
                    Interp::active_modes(t.activeGCodes, t.activeMCodes, t.activeSettings, traj.tag);
    if (from_tag) running_tag_ = traj.tag; // motion drops it when it stops by itself
    const bool moves = from_tag && traj.queue > 0 && traj.tag.fields[GM_FIELD_MAIN_LINE] > 0;
    main_line_ = moves ? traj.tag.fields[GM_FIELD_MAIN_LINE] : order_line_;
    if (moves) t.callLevel = traj.tag.fields[GM_FIELD_CALL_LEVEL];
    if (!from_tag) {
        interp_->active_g_codes(t.activeGCodes);
        interp_->active_m_codes(t.activeMCodes);
        interp_->active_settings(t.activeSettings);
    }
    // Group 6 of the codes: the units of what is executing, not of what was read.
    if (t.activeGCodes[5] == 200) t.programUnits = CANON_UNITS_INCHES;
    else if (t.activeGCodes[5] == 210) t.programUnits = CANON_UNITS_MM;
    if (busy && from_tag && traj.tag.filename[0]) copy_text(t.file, traj.tag.filename);
    else copy_text(t.file, program_.c_str());

    int serial = command_ ? command_serial_ : 0;
    NMLTYPE type = command_.type();
    stat_.echo_serial_number = t.echo_serial_number = serial;
    stat_.command_type = t.command_type = type;
    int status;
    const bool done = idle() && stat_.motion.status == RCS_DONE && stat_.io.status == RCS_DONE && mdi_queue_.empty() &&
                      !busy && restore_ != Restore::looking && !opening_;
    if (plan_error_ || refused_stranger_ || execute_error_ || t.execState == EMC_TASK_EXEC_ERROR ||
        stat_.motion.status == RCS_ERROR || stat_.io.status == RCS_ERROR)
        status = RCS_ERROR;
    else
        status = done ? RCS_DONE : RCS_EXEC;
    stat_.status = t.status = status;
    stat_.control_pid = control_.pid();
    copy_text(stat_.control_name, control_.name().c_str());
    stat_.control_state = control_error_ ? RCS_ERROR : done ? RCS_DONE : RCS_EXEC;
    status_channel_->write(stat_);
}

// ---- stopping ----

void Task::set_exec(int state) {
    if (stat_.task.execState == EMC_TASK_EXEC_WAITING_FOR_SYSTEM_CMD && state != EMC_TASK_EXEC_WAITING_FOR_SYSTEM_CMD)
        child_.interrupt();
    if (state != EMC_TASK_EXEC_WAITING_FOR_DELAY) stat_.task.delayLeft = 0;
    stat_.task.execState = state;
}

void Task::clear_program() {
    list_.clear();
    pending_ = {};
    set_exec(EMC_TASK_EXEC_DONE);
    stat_.task.interpState = EMC_TASK_INTERP_IDLE;
}

void Task::abort_task() {
    EMC_TASK_STAT &t = stat_.task;
    const bool program = requested_mode_ == EMC_TASK_MODE_AUTO && t.interpState != EMC_TASK_INTERP_IDLE;
    const state_tag_t tag = running_tag_;
    motion_.abort();
    jog_owners_.clear();
    if (!mdi_queue_.empty()) rcs_print("mdi_execute_abort: dropping %zu queued MDI commands\n", mdi_queue_.size());
    mdi_queue_.clear();
    mdi_continue_ = false;
    clear_program();
    t.task_paused = 0;
    t.motionLine = t.readLine = 0;
    t.command[0] = 0;
    t.callLevel = 0;
    stepping_ = step_given_ = false;
    start_line_ = 0;
    line_read_ = false;
    error_stop_due_ = false;
    forget_restore();
    synch_later();
    interp_->close();
    interp_->reset();
    if (program) { // back from where reading was to what the machine does
        canon_->spindle_is(-1, 0); // the S word of what is restored starts nothing
        canon_->keeps_speeds = true;
        interp_->restore_offsets(executed_offsets_.values, t.toolOffset);
        interp_->restore_from_tag(tag);
        interp_->restore_offsets(executed_offsets_.values,
                                 t.toolOffset); // the tag may be of a move before the last change
        canon_->keeps_speeds = false;
        read_offsets_ = executed_offsets_;
    } else {
        forget_offsets();
    }
    canon_->constant_rpm(); // as the interpreter, which takes G97 from the machine
}

// When the machine has come to rest the interpreter learns where it is; nothing is read or
// executed before.
void Task::synch_later() {
    list_.append(EMC_TASK_PLAN_SYNCH(), 0);
    wait_ = true;
}

// What a new start, RESUME and a task error do; an abort keeps the flag in the status.
void Task::stop_stepping() {
    stepping_ = step_given_ = false;
    stat_.motion.traj.single_stepping = false;
}

// With the machine off by a fault of a joint they may have to turn until the joints stand.
void Task::spindles_off_after_fault() {
    if (stat_.io.aux.estop || !fault_stop_.begin(motion_.stop_causes(), stat_.motion, kerf_clock_now_ns()))
        all_spindles_off();
}

void Task::watch_fault_stop() {
    if (!fault_stop_.waiting()) return;
    double most[EMCMOT_MAX_JOINTS];
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++) most[j] = motion_.joint[j].max_velocity;
    if (fault_stop_.over(stat_.motion, most, kerf_clock_now_ns())) all_spindles_off();
}

int Task::joint_on_switch() const {
    for (int j = 0; j < stat_.motion.traj.joints; j++)
        if (stat_.motion.joint[j].minHardLimit || stat_.motion.joint[j].maxHardLimit) return j;
    return -1;
}

int Task::override_limits(int joint) {
    const int j = joint_on_switch();
    if (joint < 0 || j < 0 || fault_stop_.retract() != FaultStop::Retract::NO) return motion_.override_limits(joint);
    operator_error(("Joint " + std::to_string(j) +
                    " stands on its limit switch, which this machine does not leave under power "
                    "([TASK]LIMIT_SWITCH_RETRACT = NO): move it by hand")
                       .c_str());
    return -1;
}

// Before the machine is turned on. False: refused by motion.
bool Task::leave_limit_switch() {
    const int j = joint_on_switch();
    if (j < 0 || fault_stop_.retract() != FaultStop::Retract::AUTO) return true;
    operator_text(
        ("Joint " + std::to_string(j) + " stands on its limit switch: limits are overridden until the first jog ends")
            .c_str());
    return motion_.override_limits(j) == 0;
}

void Task::all_spindles_off() {
    fault_stop_.end();
    for (int s = 0; s < stat_.motion.traj.spindles; s++) motion_.spindle_off(s);
    if (canon_) canon_->spindle_is(-1, 0); // no S word starts them again
    if (interp_) interp_->outputs_stopped();
}

// The interpreter learns where the machine is now, not where it was at the last cycle's end.
void Task::synch() {
    update_motion();
    interp_->synch();
    if (told_trouble_ == interp_->parameter_trouble()) return; // once, until it works again
    told_trouble_ = interp_->parameter_trouble();
    if (!told_trouble_.empty()) operator_error(told_trouble_.c_str());
}

// After each line: a change of offsets takes its place among the orders.
void Task::note_offsets() {
    double now[Interp::OFFSETS];
    interp_->get_offsets(now);
    if (std::memcmp(now, read_offsets_.values, sizeof now) == 0) return;
    std::memcpy(read_offsets_.values, now, sizeof now);
    list_.append(read_offsets_, interp_->line());
}

// After orders were dropped: the interpreter goes back to the offsets that are in force.
void Task::forget_offsets() {
    if (std::memcmp(read_offsets_.values, executed_offsets_.values, sizeof read_offsets_.values) == 0) return;
    interp_->restore_offsets(executed_offsets_.values, stat_.task.toolOffset);
    read_offsets_ = executed_offsets_;
}

void Task::on_abort(int reason, const char *text) {
    int r = interp_->on_abort(reason, text);
    note_offsets();
    if (r > INTERP_MIN_ERROR) operator_error(interp_->error_text(r));
}

// ---- messages to the operator ----

void Task::log_message(const NMLmsg &m, EmcMessageSource source) {
    if (!log_channel_) return;
    int at = ++log_.count % EMC_MESSAGE_LOG_LENGTH;
    const char *text = m._type == EMC_OPERATOR_TEXT_TYPE      ? static_cast<const EMC_OPERATOR_TEXT &>(m).text
                       : m._type == EMC_OPERATOR_DISPLAY_TYPE ? static_cast<const EMC_OPERATOR_DISPLAY &>(m).display
                                                              : static_cast<const EMC_OPERATOR_ERROR &>(m).error;
    log_.kind[at] = m._type;
    log_.source[at] = source;
    log_.command[at] = command_ ? command_serial_ : 0;
    log_.time[at] = static_cast<double>(kerf_clock_now_ns()) / 1e9;
    copy_text(log_.text[at], text);
    log_channel_->write(log_);
}

// Into the log, which every client reads, and into the queue, whose messages go to one reader
// each: at once, or when a reader has made room; task never waits for one.
int Task::operator_message(const NMLmsg &m, EmcMessageSource source) {
    log_message(m, source);
    if (messages_.size() >= MESSAGES_MOST) {
        rcs_print("operator message lost: nobody reads them\n");
        messages_.pop_front();
    }
    messages_.emplace_back(m);
    send_messages();
    return 0;
}

void Task::send_messages() {
    while (!messages_.empty()) {
        NMLmsg &m = *messages_.front();
        if (error_channel_->get_space_available() < 2 * m.size || error_channel_->write(m) < 0) return;
        messages_.pop_front();
    }
}

void Task::operator_error(const char *text) {
    printf("%s\n", text);
    fflush(stdout);
    EMC_OPERATOR_ERROR m;
    copy_text(m.error, text);
    operator_message(m);
}

void Task::operator_text(const char *text) {
    EMC_OPERATOR_TEXT m;
    copy_text(m.text, text);
    operator_message(m);
}

void Task::operator_display(const char *text) {
    EMC_OPERATOR_DISPLAY m;
    copy_text(m.display, text);
    operator_message(m);
}
