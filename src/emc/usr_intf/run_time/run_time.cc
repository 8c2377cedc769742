// SPDX-License-Identifier: GPL-2.0-or-later
//
// run_time.cc - see run_time.hh.
#include "run_time.hh"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <deque>

#include "tp.h"

namespace {

const char AXES[] = "XYZABCUVW";
constexpr double STALLED_S = 60;     // a planner that gets no further, e.g. behind a spindle that stands
constexpr int SETTLE_CYCLES = 3;     // of servo, from the planner's rest to "in position"

// What the planner asks of motion; its callbacks have no context.
struct Paper {
    emcmot_status_t status{};
    emcmot_config_t config{};
    AxisLimits limits;
    int joints = 0;
    int axis_of[EMCMOT_MAX_JOINTS]{};
    double joint_v[EMCMOT_MAX_JOINTS]{}, joint_a[EMCMOT_MAX_JOINTS]{}, joint_j[EMCMOT_MAX_JOINTS]{};
    double joint_command[EMCMOT_MAX_JOINTS]{};
};
Paper *paper;

double axis_place(const EmcPose &p, int axis) {
    const double all[] = {p.tran.x, p.tran.y, p.tran.z, p.a, p.b, p.c, p.u, p.v, p.w};
    return all[axis];
}

void no_digital(int, char) {}
void no_analog(int, double) {}
void no_unlock(int, int) {}
int unlocked(int) { return 1; }
double axis_velocity(int a) { return paper->limits.velocity[static_cast<size_t>(a)]; }
double axis_acceleration(int a) { return paper->limits.acceleration[static_cast<size_t>(a)]; }
double axis_jerk(int a) { return paper->limits.jerk[static_cast<size_t>(a)]; }
int joints() { return paper->joints; }
void joint_commands(double *q) { std::copy_n(paper->joint_command, EMCMOT_MAX_JOINTS, q); }
int inverse(const EmcPose *pose, double *q) {
    for (int n = 0; n < paper->joints; n++) q[n] = axis_place(*pose, paper->axis_of[n]);
    return 0;
}
void joint_limits(int n, double *v, double *a, double *j) {
    *v = paper->joint_v[n];
    *a = paper->joint_a[n];
    *j = paper->joint_j[n];
}
const tp_machine MACHINE = {joints, inverse, joint_commands, joint_limits, axis_jerk};

// Joints of a machine whose joints are its axes. Of other kinematics only the axes' limits count.
void read_joints(const linuxcnc::IniFile &ini, Paper &p) {
    const std::string kinematics = ini.findStringV("KINEMATICS", "KINS", "trivkins");
    if (kinematics.compare(0, 8, "trivkins") != 0) return;
    const size_t at = kinematics.find("coordinates=");
    std::string letters = at == std::string::npos ? AXES : kinematics.substr(at + 12);
    letters = letters.substr(0, letters.find_first_of(" \t"));
    const int count = std::clamp(ini.findIntV("JOINTS", "KINS", 0), 0, EMCMOT_MAX_JOINTS);
    for (char c : letters) {
        const char *letter = std::strchr(AXES, std::toupper(static_cast<unsigned char>(c)));
        if (!letter || !*letter || p.joints >= count) continue;
        const int n = p.joints++;
        const std::string section = "JOINT_" + std::to_string(n);
        p.axis_of[n] = static_cast<int>(letter - AXES);
        const double share =
            ini.findRealV("BACKLASH", section, 0) != 0 || ini.findString("COMP_FILE", section) ? 0.9 : 1;
        p.joint_v[n] = ini.findRealV("MAX_VELOCITY", section, 1);
        p.joint_a[n] = share * ini.findRealV("MAX_ACCELERATION", section, 1);
        p.joint_j[n] = share * ini.findRealV("MAX_JERK", section, 0);
    }
}

} // namespace

AxisLimits axis_limits(const linuxcnc::IniFile &ini) {
    AxisLimits limits;
    for (size_t a = 0; AXES[a]; a++) {
        const std::string section = std::string("AXIS_") + AXES[a];
        const double share = 1 - std::clamp(ini.findRealV("OFFSET_AV_RATIO", section, 0), 0.0, 0.9);
        limits.velocity[a] = share * std::max(0.0, ini.findRealV("MAX_VELOCITY", section, 1));
        limits.acceleration[a] = share * std::max(0.0, ini.findRealV("MAX_ACCELERATION", section, 1));
        limits.jerk[a] = std::max(0.0, ini.findRealV("MAX_JERK", section, 0));
    }
    return limits;
}

struct RunTime::Planner : Paper {
    TP_STRUCT tp{};
    double dt = 0.001;
    double at_speed_s[EMCMOT_MAX_SPINDLES] = {}; // when each spindle has run up
    // Moves on their way: number and line; the planner's id of a move is its number.
    std::deque<std::pair<long, int>> under_way;
    ~Planner() { std::free(tp.impl); }
};

RunTime::RunTime(const EMC_STAT &stat, const linuxcnc::IniFile &ini, const Rates &rates)
    : planner_(std::make_unique<Planner>()), rates_(rates) {
    Planner &p = *planner_;
    paper = &p;
    p.limits = axis_limits(ini);
    read_joints(ini, p);
    p.dt = static_cast<double>(ini.findIntV("SERVO_PERIOD", "EMCMOT", 1000000)) * 1e-9;
    task_cycle_ = ini.findRealV("CYCLE_TIME", "TASK", 0.001);
    spindles_ = std::clamp(stat.motion.traj.spindles, 1, EMCMOT_MAX_SPINDLES);
    p.config.numSpindles = spindles_;
    p.config.maxFeedScale = ini.findRealV("MAX_FEED_OVERRIDE", "DISPLAY", 1.0);
    emcmot_status_t &s = p.status;
    s.jerk = ini.findRealV("MAX_LINEAR_JERK", "TRAJ", 1e9);
    s.planner_type = ini.findIntV("PLANNER_TYPE", "TRAJ", 0) == 1 && s.jerk >= 1;
    pending_type_ = s.planner_type;
    s.scurve_peak_scale = ini.findRealV("SCURVE_PEAK_SCALE", "TRAJ", 1.0);
    s.enables_new = s.enables_queued = FS_ENABLED | SS_ENABLED;
    s.net_feed_scale = 1;
    for (int n = 0; n < spindles_; n++) {
        s.spindle_status[n].at_speed = 1;
        spindle(n, stat.motion.spindle[n].speed, 0, 0);
    }
    tpMotFunctions(no_digital, no_analog, no_unlock, unlocked, axis_velocity, axis_acceleration);
    tpMotMachine(&MACHINE);
    tpMotData(&p.status, &p.config);
    if (tpCreate(&p.tp, DEFAULT_TC_QUEUE_SIZE, 0) != 0) failed_ = "no memory for the planner";
    tpSetCycleTime(&p.tp, p.dt);
    tpSetPos(&p.tp, &stat.motion.traj.position);
    tpSetVlimit(&p.tp, std::min(rates.max_velocity, ini.findRealV("MAX_LINEAR_VELOCITY", "TRAJ", 1e99)));
    inverse(&stat.motion.traj.position, p.joint_command);
}

RunTime::~RunTime() { paper = nullptr; }

void RunTime::restart() {
    for (double &s : planner_->at_speed_s) s = 0;
    seconds_ = 0;
    waits_ = {};
    number_ = shown_ = 0;
    planner_->under_way.clear();
}

void RunTime::spindle(int which, double speed, double factor, double xoffset) {
    for (int n = 0; n < spindles_; n++) {
        if (which >= 0 && which != n) continue;
        spindle_status_t &s = planner_->status.spindle_status[n];
        if (speed != 0 && speed != s.speed) waits_.spindle_starts++;
        planner_->at_speed_s[n] =
            std::max(seconds_, planner_->at_speed_s[n]) + std::fabs(speed - s.speed) * rates_.s_per_rpm;
        s.speed = speed;
        s.state = speed != 0;
        s.rests = 0;
        s.css_factor = factor;
        s.xoffset = xoffset;
        s.direction = speed > 0 ? 1 : speed < 0 ? -1 : 0;
    }
}

// One servo cycle: overrides and spindles as motion has them, then the planner.
void RunTime::cycle() {
    Planner &p = *planner_;
    emcmot_status_t &s = p.status;
    const bool rapid = tpGetMotionType(&p.tp) == EMC_MOTION_TYPE_TRAVERSE;
    s.net_feed_scale = s.enables_queued & FS_ENABLED ? (rapid ? rates_.rapid : rates_.feed) : 1;
    EmcPose place;
    tpGetPos(&p.tp, &place);
    for (int n = 0; n < spindles_; n++) {
        spindle_status_t &sp = s.spindle_status[n];
        double rpm = sp.speed * (s.enables_queued & SS_ENABLED ? rates_.spindle : 1);
        if (sp.css_factor != 0) {
            const double radius = std::fabs(sp.xoffset - place.tran.x), most = std::fabs(sp.speed);
            rpm = std::clamp(radius > 0 ? sp.css_factor / radius : sp.speed, -most, most);
        }
        sp.spindleSpeedIn = rpm / 60;
        sp.at_speed = seconds_ >= p.at_speed_s[n];
        const double before = sp.spindleRevs;
        sp.spindleRevs += sp.spindleSpeedIn * p.dt;
        if (sp.spindle_index_enable && std::floor(sp.spindleRevs) != std::floor(before)) {
            sp.spindleRevs -= std::floor(sp.spindleRevs);
            sp.spindle_index_enable = 0;
        }
    }
    if (tpIsDone(&p.tp)) s.planner_type = pending_type_;
    s.motionFlag &= ~EMCMOT_MOTION_ERROR_BIT;
    tpRunCycle(&p.tp, static_cast<long>(p.dt * 1e9));
    seconds_ += p.dt;
    if (s.motionFlag & EMCMOT_MOTION_ERROR_BIT) failed_ = "the planner refuses a move";
    tpGetPos(&p.tp, &place);
    inverse(&place, p.joint_command);
    const long now = tpGetExecId(&p.tp);
    while (!p.under_way.empty() && p.under_way.front().first <= now) {
        const auto [number, line] = p.under_way.front();
        p.under_way.pop_front();
        if (on_move) on_move(line, number, seconds_);
    }
}

void RunTime::drain() {
    Planner &p = *planner_;
    double since = seconds_, left = -1;
    while (failed_.empty() && !tpIsDone(&p.tp)) {
        cycle();
        const double now = p.status.distance_to_go;
        if (now != left) since = seconds_;
        left = now;
        if (seconds_ - since > STALLED_S) failed_ = "a move waits for a spindle that does not turn";
    }
}

// What task waits for: motion at rest and in position, then its next cycle.
void RunTime::stop_and_wait(double seconds) {
    const bool moved = !tpIsDone(&planner_->tp);
    drain();
    seconds_ += seconds + (moved ? SETTLE_CYCLES * planner_->dt + task_cycle_ : 0);
}

// Whether a move waits for the spindles, as motion decides it.
int RunTime::take_at_speed(int type) {
    int &next = planner_->status.atspeed_next_feed;
    const int waits =
        type == EMC_MOTION_TYPE_FEED || type == EMC_MOTION_TYPE_ARC || type == EMC_MOTION_TYPE_PROBING ? next : 0;
    next = waits ? 0 : next;
    return waits;
}

void RunTime::move(int line, const NMLmsg &m) {
    Planner &p = *planner_;
    double since = seconds_;
    while (failed_.empty() && tcqFull(&p.tp.queue)) {
        cycle();
        if (seconds_ - since > 24 * 3600.0) failed_ = "a move takes more than a day";
    }
    if (!failed_.empty()) return;
    const long number = ++number_;
    tpSetId(&p.tp, static_cast<int>(number));
    const unsigned char enables = p.status.enables_new;
    int r = 0;
    if (m._type == EMC_TRAJ_LINEAR_MOVE_TYPE) {
        const auto &l = as<EMC_TRAJ_LINEAR_MOVE>(m);
        r = tpAddLine(&p.tp, l.end, l.type, l.vel, l.ini_maxvel, l.acc, l.ini_maxjerk, enables,
                      static_cast<char>(take_at_speed(l.type)), -1, l.tag);
    } else if (m._type == EMC_TRAJ_CIRCULAR_MOVE_TYPE) {
        const auto &c = as<EMC_TRAJ_CIRCULAR_MOVE>(m);
        r = tpAddCircle(&p.tp, c.end, c.center, c.normal, c.turn, c.type, c.vel, c.ini_maxvel, c.acc, c.ini_maxjerk,
                        enables, static_cast<char>(take_at_speed(c.type)), c.tag);
    } else if (m._type == EMC_TRAJ_PROBE_TYPE) {
        const auto &l = as<EMC_TRAJ_PROBE>(m);
        r = tpAddLine(&p.tp, l.pos, l.type, l.vel, l.ini_maxvel, l.acc, l.ini_maxjerk, enables,
                      static_cast<char>(take_at_speed(l.type)), -1, l.tag);
    } else {
        const auto &t = as<EMC_TRAJ_RIGID_TAP>(m);
        r = tpAddRigidTap(&p.tp, t.pos, t.vel, t.ini_maxvel, t.acc, t.ini_maxjerk, enables, t.scale, t.tag);
    }
    if (r < 0) failed_ = "the planner refuses the move of line " + std::to_string(line);
    else if (r == 0) p.under_way.emplace_back(number, line);
}

void RunTime::take(const InterpList::Entry *order) {
    if (!failed_.empty()) return;
    if (!order) return stop_and_wait(0);
    const NMLmsg &m = *order->message;
    Planner &p = *planner_;
    emcmot_status_t &s = p.status;
    auto flag = [&](unsigned char bit, int on) {
        s.enables_new = static_cast<unsigned char>(on ? s.enables_new | bit : s.enables_new & ~bit);
    };
    auto coolant = [&](int &is, int wanted) {
        if (is != wanted) stop_and_wait(0);
        is = wanted;
    };
    switch (m._type) {
    case EMC_TRAJ_LINEAR_MOVE_TYPE:
    case EMC_TRAJ_CIRCULAR_MOVE_TYPE: return move(order->line, m);
    case EMC_TRAJ_PROBE_TYPE:
    case EMC_TRAJ_RIGID_TAP_TYPE:
        stop_and_wait(0);
        move(order->line, m);
        return stop_and_wait(0);
    case EMC_TRAJ_SET_VELOCITY_TYPE:
        tpSetVmax(&p.tp, as<EMC_TRAJ_SET_VELOCITY>(m).velocity, as<EMC_TRAJ_SET_VELOCITY>(m).ini_maxvel);
        return;
    case EMC_TRAJ_SET_TERM_COND_TYPE:
        {
            const auto &c = as<EMC_TRAJ_SET_TERM_COND>(m);
            tpSetTermCond(&p.tp, c.cond, c.tolerance);
            if (c.planner_type >= 0) pending_type_ = c.planner_type > 0 && s.jerk >= 1;
            if (tpIsDone(&p.tp)) s.planner_type = pending_type_;
            return;
        }
    case EMC_TRAJ_SET_SPINDLESYNC_TYPE:
        {
            const auto &c = as<EMC_TRAJ_SET_SPINDLESYNC>(m);
            tpSetSpindleSync(&p.tp, c.spindle, c.feed_per_revolution, c.velocity_mode);
            return;
        }
    case EMC_TRAJ_SET_FO_ENABLE_TYPE: return flag(FS_ENABLED, as<EMC_TRAJ_SET_FO_ENABLE>(m).mode);
    case EMC_TRAJ_SET_SO_ENABLE_TYPE: return flag(SS_ENABLED, as<EMC_TRAJ_SET_SO_ENABLE>(m).mode);
    case EMC_TRAJ_DELAY_TYPE: return stop_and_wait(as<EMC_TRAJ_DELAY>(m).delay);
    case EMC_TOOL_LOAD_TYPE: waits_.tool_changes++; return stop_and_wait(rates_.tool_change_s);
    case EMC_SYSTEM_CMD_TYPE: waits_.user_codes++; return stop_and_wait(rates_.user_code_s);
    case EMC_AUX_INPUT_WAIT_TYPE:
        if (as<EMC_AUX_INPUT_WAIT>(m).wait_type != WAIT_MODE_IMMEDIATE) waits_.inputs++;
        return stop_and_wait(0);
    case EMC_TASK_PLAN_PAUSE_TYPE:
    case EMC_TASK_PLAN_OPTIONAL_STOP_TYPE: waits_.stops++; return stop_and_wait(0);
    case EMC_COOLANT_MIST_ON_TYPE: return coolant(mist_, 1);
    case EMC_COOLANT_MIST_OFF_TYPE: return coolant(mist_, 0);
    case EMC_COOLANT_FLOOD_ON_TYPE: return coolant(flood_, 1);
    case EMC_COOLANT_FLOOD_OFF_TYPE: return coolant(flood_, 0);
    case EMC_SPINDLE_ON_TYPE:
        {
            const auto &o = as<EMC_SPINDLE_ON>(m);
            const int n = std::clamp(o.spindle, 0, spindles_ - 1);
            if (o.factor != 0 || s.spindle_status[n].speed != o.speed) stop_and_wait(0);
            s.atspeed_next_feed = last_wait_ = o.wait_for_spindle_at_speed;
            return spindle(o.spindle, o.speed, o.factor, o.xoffset);
        }
    case EMC_SPINDLE_SPEED_TYPE:
        {
            const auto &o = as<EMC_SPINDLE_SPEED>(m);
            const int n = std::clamp(o.spindle, 0, spindles_ - 1);
            if (o.factor != 0 || s.spindle_status[n].speed != o.speed) stop_and_wait(0);
            s.atspeed_next_feed = last_wait_;
            return spindle(o.spindle, o.speed, o.factor, o.xoffset);
        }
    case EMC_SPINDLE_OFF_TYPE:
        stop_and_wait(0);
        s.atspeed_next_feed = last_wait_; // as task tells motion
        return spindle(as<EMC_SPINDLE_OFF>(m).spindle, 0, 0, 0);
    case EMC_MOTION_SET_AOUT_TYPE:
        if (as<EMC_MOTION_SET_AOUT>(m).now) stop_and_wait(0);
        return;
    case EMC_MOTION_SET_DOUT_TYPE:
        if (as<EMC_MOTION_SET_DOUT>(m).now) stop_and_wait(0);
        return;
    case EMC_TRAJ_SET_ACCELERATION_TYPE:
    case EMC_TRAJ_SET_FH_ENABLE_TYPE:
    case EMC_TOOL_PREPARE_TYPE:
    case EMC_TOOL_SET_NUMBER_TYPE: return;
    default: return stop_and_wait(0); // all else waits until motion rests
    }
}
