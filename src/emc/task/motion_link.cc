// SPDX-License-Identifier: GPL-2.0-or-later
//
// motion_link.cc - see motion_link.hh. Source: motion sheet, sections 3, 4 and 17.
#include "motion_link.hh"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include <unistd.h>

#include "rcs_print.hh"
#include "replace_file.hh"
#include "usrmotintf.h"

MotionLink::~MotionLink() {
    if (attached_) usrmotExit();
}

bool MotionLink::attach(const linuxcnc::IniFile &ini) {
    if (attached_) return true;
    int key = DEFAULT_SHMEM_KEY;
    double timeout = DEFAULT_EMCMOT_COMM_TIMEOUT;
    if (ini.isSet("SHMEM_KEY", "EMCMOT")) {
        if (auto k = ini.findUInt("SHMEM_KEY", "EMCMOT", 0, INT32_MAX)) key = static_cast<int>(*k);
        else rcs_print("USRMOT: ERROR: Invalid [EMCMOT]SHMEM_KEY\n");
    }
    if (ini.isSet("COMM_TIMEOUT", "EMCMOT")) {
        if (auto t = ini.findReal("COMM_TIMEOUT", "EMCMOT")) timeout = *t;
        else rcs_print("USRMOT: ERROR: Invalid [EMCMOT]COMM_TIMEOUT\n");
    }
    attached_ = usrmotInit("emc2_task", key, timeout) == 0;
    return attached_;
}

bool MotionLink::alive() {
    if (!attached_) return false;
    usrmotReadEmcmotStatus(status_);
    return status_->heartbeat > 0;
}

emcmot_command_t MotionLink::command(cmd_code_t code) const {
    emcmot_command_t c = {};
    c.command = code;
    c.id = id_;
    c.joint = c.axis = -1;
    return c;
}

emcmot_command_t MotionLink::joint_command(cmd_code_t code, int j) const {
    emcmot_command_t c = command(code);
    c.joint = j;
    return c;
}

emcmot_command_t MotionLink::axis_command(cmd_code_t code, int a) const {
    emcmot_command_t c = command(code);
    c.axis = a;
    return c;
}

int MotionLink::send(emcmot_command_t &c) { return usrmotWriteEmcmotCommand(&c); }

// A move, jog, homing or change of mode is acknowledged before the servo cycle that takes it up has published queue and
// in-position: until the next heartbeat motion counts as busy.
int MotionLink::send_move(emcmot_command_t &c) {
    int r = send(c);
    emcmot_status_t now;
    if (r == 0 && usrmotReadEmcmotStatus(&now) == 0) {
        settling_ = true;
        settle_from_ = now.heartbeat;
    }
    return r;
}

int MotionLink::send(cmd_code_t code) {
    emcmot_command_t c = command(code);
    return send(c);
}

// ---- configuration ----

static double positive(double v) { return v < 0 ? 0 : v; }
static bool is_joint(int j) { return j >= 0 && j < EMCMOT_MAX_JOINTS; }
static bool is_axis(int a) { return a >= 0 && a < EMCMOT_MAX_AXIS; }

int MotionLink::set_joints(int n) {
    if (n <= 0 || n > EMCMOT_MAX_JOINTS) {
        rcs_print("emcTrajSetJoints failing: joints=%d\n", n);
        return -1;
    }
    stat_.motion.traj.joints = n;
    emcmot_command_t c = joint_command(EMCMOT_SET_NUM_JOINTS, n);
    return send(c);
}

int MotionLink::set_spindles(int n) {
    if (n <= 0 || n > EMCMOT_MAX_SPINDLES) {
        rcs_print("emcTrajSetSpindles failing: spindles=%d\n", n);
        return -1;
    }
    stat_.motion.traj.spindles = n;
    emcmot_command_t c = command(EMCMOT_SET_NUM_SPINDLES);
    c.spindle = n;
    return send(c);
}

int MotionLink::set_velocity(double v, double ini_maxvel) {
    emcmot_command_t c = command(EMCMOT_SET_VEL);
    c.vel = positive(v);
    c.ini_maxvel = ini_maxvel;
    return send(c);
}

int MotionLink::set_max_velocity(double v) {
    emcmot_command_t c = command(EMCMOT_SET_VEL_LIMIT);
    c.vel = positive(v);
    return send(c);
}

int MotionLink::set_acceleration(double a) {
    emcmot_command_t c = command(EMCMOT_SET_ACC);
    c.acc = std::min(positive(a), max_traj_acceleration);
    return send(c);
}

int MotionLink::set_jerk(double j) {
    emcmot_command_t c = command(EMCMOT_SET_JERK);
    c.jerk = std::clamp(j, 0.0, 1e9);
    return send(c);
}

int MotionLink::set_planner_type(int type) {
    emcmot_command_t c = command(EMCMOT_SET_PLANNER_TYPE);
    c.planner_type = type == 1 ? 1 : 0;
    return send(c);
}

int MotionLink::set_scurve_peak_scale(double scale) {
    emcmot_command_t c = command(EMCMOT_SET_SCURVE_PEAK_SCALE);
    c.scurve_peak_scale = scale;
    return send(c);
}

int MotionLink::set_home(const EmcPose &home) {
    emcmot_command_t c = command(EMCMOT_SET_WORLD_HOME);
    c.pos = home;
    return send(c);
}

int MotionLink::set_max_feed_override(double scale) {
    emcmot_command_t c = command(EMCMOT_SET_MAX_FEED_OVERRIDE);
    c.maxFeedScale = scale;
    return send(c);
}

int MotionLink::set_probe_errors(bool jog, bool home, int feed, int rapid, double filter) {
    emcmot_command_t c = command(EMCMOT_SET_PROBE_ERR_INHIBIT);
    c.probe_jog_err_inhibit = jog;
    c.probe_home_err_inhibit = home;
    c.probe_feed_contact = feed;
    c.probe_rapid_contact = rapid;
    c.probe_filter = filter;
    return send(c);
}

int MotionLink::set_arc_blends(bool enable, bool fallback, int depth, int gap_cycles, double ramp_freq,
                               double kink_ratio) {
    emcmot_command_t c = command(EMCMOT_SETUP_ARC_BLENDS);
    c.arcBlendEnable = enable;
    c.arcBlendFallbackEnable = fallback;
    c.arcBlendOptDepth = depth;
    c.arcBlendGapCycles = gap_cycles;
    c.arcBlendRampFreq = ramp_freq;
    c.arcBlendTangentKinkRatio = kink_ratio;
    return send(c);
}

int MotionLink::set_joint_backlash(int j, double v) {
    if (!is_joint(j)) return 0;
    emcmot_command_t c = joint_command(EMCMOT_SET_JOINT_BACKLASH, j);
    c.backlash = v;
    return send(c);
}

int MotionLink::set_joint_min_limit(int j, double v) {
    if (!is_joint(j)) return 0;
    joint[j].min_limit = v;
    emcmot_command_t c = joint_command(EMCMOT_SET_JOINT_POSITION_LIMITS, j);
    c.minLimit = v;
    c.maxLimit = joint[j].max_limit;
    return send(c);
}

int MotionLink::set_joint_max_limit(int j, double v) {
    if (!is_joint(j)) return 0;
    joint[j].max_limit = v;
    emcmot_command_t c = joint_command(EMCMOT_SET_JOINT_POSITION_LIMITS, j);
    c.minLimit = joint[j].min_limit;
    c.maxLimit = v;
    return send(c);
}

int MotionLink::set_joint_ferror(int j, double v) {
    if (!is_joint(j)) return 0;
    emcmot_command_t c = joint_command(EMCMOT_SET_JOINT_MAX_FERROR, j);
    c.maxFerror = v;
    return send(c);
}

int MotionLink::set_joint_min_ferror(int j, double v) {
    if (!is_joint(j)) return 0;
    emcmot_command_t c = joint_command(EMCMOT_SET_JOINT_MIN_FERROR, j);
    c.minFerror = v;
    return send(c);
}

int MotionLink::set_joint_max_velocity(int j, double v) {
    if (!is_joint(j)) return 0;
    emcmot_command_t c = joint_command(EMCMOT_SET_JOINT_VEL_LIMIT, j);
    joint[j].max_velocity = c.vel = positive(v);
    return send(c);
}

int MotionLink::set_joint_max_acceleration(int j, double v) {
    if (!is_joint(j)) return 0;
    emcmot_command_t c = joint_command(EMCMOT_SET_JOINT_ACC_LIMIT, j);
    joint[j].max_acceleration = c.acc = positive(v);
    return send(c);
}

int MotionLink::set_joint_max_jerk(int j, double v) {
    if (!is_joint(j)) return 0;
    emcmot_command_t c = joint_command(EMCMOT_SET_JOINT_JERK_LIMIT, j);
    c.jerk = positive(v);
    return send(c);
}

int MotionLink::set_joint_motor_offset(int j, double v) {
    emcmot_command_t c = joint_command(EMCMOT_SET_JOINT_MOTOR_OFFSET, j);
    c.motor_offset = v;
    return send(c);
}

int MotionLink::set_homing_params(const EMC_JOINT_SET_HOMING_PARAMS &p) {
    if (!is_joint(p.joint)) return 0;
    emcmot_command_t c = joint_command(EMCMOT_SET_JOINT_HOMING_PARAMS, p.joint);
    c.home = p.home;
    c.offset = p.offset;
    c.home_final_vel = p.home_final_vel;
    c.search_vel = p.search_vel;
    c.latch_vel = p.latch_vel;
    c.home_sequence = p.home_sequence;
    c.volatile_home = p.volatile_home;
    if (p.use_index) c.flags |= HOME_USE_INDEX;
    if (p.encoder_does_not_reset) c.flags |= HOME_INDEX_NO_ENCODER_RESET;
    if (p.ignore_limits) c.flags |= HOME_IGNORE_LIMITS;
    if (p.is_shared) c.flags |= HOME_IS_SHARED;
    if (p.locking_indexer) c.flags |= HOME_UNLOCK_FIRST;
    if (p.absolute_encoder) {
        c.flags |= HOME_ABSOLUTE_ENCODER;
        if (p.absolute_encoder == 1) c.flags |= HOME_NO_REHOME;
        if (p.absolute_encoder == 2) c.flags |= HOME_NO_REHOME | HOME_NO_FINAL_MOVE;
    }
    return send(c);
}

int MotionLink::update_homing_params(int j, double home, double offset, int sequence) {
    if (!is_joint(j)) return 0;
    emcmot_command_t c = joint_command(EMCMOT_UPDATE_JOINT_HOMING_PARAMS, j);
    c.home = home;
    c.offset = offset;
    c.home_sequence = sequence;
    return send(c);
}

int MotionLink::activate_joint(int j) {
    emcmot_command_t c = joint_command(EMCMOT_JOINT_ACTIVATE, j);
    return send(c);
}

int MotionLink::load_comp(int j, const char *file, int type) { return is_joint(j) ? usrmotLoadComp(j, file, type) : 0; }

int MotionLink::set_axis_min_limit(int a, double v) {
    if (!is_axis(a)) return 0;
    axis[a].min_limit = v;
    emcmot_command_t c = axis_command(EMCMOT_SET_AXIS_POSITION_LIMITS, a);
    c.minLimit = v;
    c.maxLimit = axis[a].max_limit;
    return send(c);
}

int MotionLink::set_axis_max_limit(int a, double v) {
    if (!is_axis(a)) return 0;
    axis[a].max_limit = v;
    emcmot_command_t c = axis_command(EMCMOT_SET_AXIS_POSITION_LIMITS, a);
    c.minLimit = axis[a].min_limit;
    c.maxLimit = v;
    return send(c);
}

int MotionLink::set_axis_max_velocity(int a, double v, double ext_offset) {
    if (!is_axis(a)) return 0;
    emcmot_command_t c = axis_command(EMCMOT_SET_AXIS_VEL_LIMIT, a);
    axis[a].max_velocity = limits.velocity[static_cast<size_t>(a)] = c.vel = positive(v);
    c.ext_offset_vel = positive(ext_offset);
    return send(c);
}

int MotionLink::set_axis_max_acceleration(int a, double v, double ext_offset) {
    if (!is_axis(a)) return 0;
    emcmot_command_t c = axis_command(EMCMOT_SET_AXIS_ACC_LIMIT, a);
    limits.acceleration[static_cast<size_t>(a)] = c.acc = positive(v);
    c.ext_offset_acc = positive(ext_offset);
    return send(c);
}

int MotionLink::set_axis_max_jerk(int a, double v) {
    if (!is_axis(a)) return 0;
    emcmot_command_t c = axis_command(EMCMOT_SET_AXIS_JERK_LIMIT, a);
    limits.jerk[static_cast<size_t>(a)] = c.jerk = positive(v);
    return send(c);
}

int MotionLink::set_axis_locking_joint(int a, int j) {
    emcmot_command_t c = axis_command(EMCMOT_SET_AXIS_LOCKING_JOINT, a);
    c.joint = j;
    return send(c);
}

int MotionLink::set_spindle_params(int s, double max_forward, double min_forward, double max_reverse,
                                   double min_reverse, double home_search, double home, int sequence,
                                   double increment) {
    emcmot_command_t c = command(EMCMOT_SET_SPINDLE_PARAMS);
    c.spindle = s;
    c.maxLimit = max_forward;
    c.minLimit = max_reverse;
    c.min_pos_speed = min_forward;
    c.max_neg_speed = min_reverse;
    c.search_vel = home_search;
    c.home = home;
    c.home_sequence = sequence;
    c.offset = increment;
    return send(c);
}

// ---- machine ----

int MotionLink::abort() {
    int r = 0;
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++) {
        emcmot_command_t c = joint_command(EMCMOT_JOG_ABORT, j);
        r = std::min(r, send(c));
    }
    return std::min(r, send(EMCMOT_ABORT));
}

int MotionLink::set_mode(int traj_mode) {
    emcmot_command_t c = command(traj_mode == EMC_TRAJ_MODE_COORD    ? EMCMOT_COORD
                                 : traj_mode == EMC_TRAJ_MODE_TELEOP ? EMCMOT_TELEOP
                                                                     : EMCMOT_FREE);
    return send_move(c);
}

int MotionLink::home(int j) {
    if (j < -1 || j >= EMCMOT_MAX_JOINTS) return 0;
    emcmot_command_t c = joint_command(EMCMOT_JOINT_HOME, j);
    return send_move(c);
}

int MotionLink::unhome(int j) {
    if (j < -2 || j >= EMCMOT_MAX_JOINTS) return 0;
    emcmot_command_t c = joint_command(EMCMOT_JOINT_UNHOME, j);
    return send_move(c);
}

int MotionLink::jog_cont(int nr, double vel, int jjogmode) {
    if (jjogmode ? !is_joint(nr) : !is_axis(nr)) return 0;
    emcmot_command_t c = jjogmode ? joint_command(EMCMOT_JOG_CONT, nr) : axis_command(EMCMOT_JOG_CONT, nr);
    double most = jjogmode ? joint[nr].max_velocity : axis[nr].max_velocity;
    c.vel = std::clamp(vel, -most, most);
    return send_move(c);
}

int MotionLink::jog_incr(int nr, double incr, double vel, int jjogmode) {
    if (jjogmode ? !is_joint(nr) : !is_axis(nr)) return 0;
    emcmot_command_t c = jjogmode ? joint_command(EMCMOT_JOG_INCR, nr) : axis_command(EMCMOT_JOG_INCR, nr);
    double most = jjogmode ? joint[nr].max_velocity : axis[nr].max_velocity;
    c.vel = std::clamp(vel, -most, most);
    c.offset = incr;
    return send_move(c);
}

int MotionLink::jog_abs(int nr, double pos, double vel, int jjogmode) {
    if (jjogmode ? !is_joint(nr) : !is_axis(nr)) return 0;
    emcmot_command_t c = jjogmode ? joint_command(EMCMOT_JOG_ABS, nr) : axis_command(EMCMOT_JOG_ABS, nr);
    double most = jjogmode ? joint[nr].max_velocity : axis[nr].max_velocity;
    c.vel = std::clamp(vel, -most, most);
    c.offset = pos;
    return send_move(c);
}

int MotionLink::jog_stop(int nr, int jjogmode) {
    if (jjogmode ? !is_joint(nr) : !is_axis(nr)) return 0;
    emcmot_command_t c = jjogmode ? joint_command(EMCMOT_JOG_ABORT, nr) : axis_command(EMCMOT_JOG_ABORT, nr);
    return send_move(c);
}

int MotionLink::override_limits(int j) {
    emcmot_command_t c = joint_command(EMCMOT_OVERRIDE_LIMITS, j);
    return send(c);
}

int MotionLink::set_debug(unsigned mask) {
    emcmot_command_t c = command(EMCMOT_SET_DEBUG);
    c.debug = static_cast<int>(mask);
    return send(c);
}

int MotionLink::spindle_off(int spindle, int wait) {
    emcmot_command_t c = command(EMCMOT_SPINDLE_OFF);
    c.spindle = spindle;
    started(spindle, 0);
    last_wait_ = wait;
    c.wait_for_spindle_at_speed = static_cast<unsigned char>(wait);
    return send(c);
}

// ---- moves ----

template <class Move> static void fill_move(emcmot_command_t *c, const EmcPose &to, const Move &m) {
    c->pos = to;
    c->vel = m.vel;
    c->ini_maxvel = m.ini_maxvel;
    c->ini_maxjerk = m.ini_maxjerk;
    c->acc = m.acc;
    c->tag = m.tag;
}

int MotionLink::linear_move(const EMC_TRAJ_LINEAR_MOVE &m) {
    emcmot_command_t c = command(EMCMOT_SET_LINE);
    fill_move(&c, m.end, m);
    c.motion_type = m.type;
    c.turn = m.indexer_jnum;
    return send_move(c);
}

int MotionLink::circular_move(const EMC_TRAJ_CIRCULAR_MOVE &m) {
    emcmot_command_t c = command(EMCMOT_SET_CIRCLE);
    fill_move(&c, m.end, m);
    c.motion_type = m.type;
    c.center = m.center;
    c.normal = m.normal;
    c.turn = m.turn;
    return send_move(c);
}

int MotionLink::probe(const EMC_TRAJ_PROBE &m) {
    emcmot_command_t c = command(EMCMOT_PROBE);
    fill_move(&c, m.pos, m);
    c.motion_type = m.type;
    c.probe_type = m.probe_type;
    return send_move(c);
}

int MotionLink::rigid_tap(const EMC_TRAJ_RIGID_TAP &m) {
    emcmot_command_t c = command(EMCMOT_RIGID_TAP);
    fill_move(&c, m.pos, m);
    c.scale = m.scale;
    return send_move(c);
}

int MotionLink::set_term_cond(int cond, double tolerance) {
    emcmot_command_t c = command(EMCMOT_SET_TERM_COND);
    c.termCond = cond;
    c.tolerance = tolerance;
    return send(c);
}

int MotionLink::set_spindlesync(int spindle, double feed_per_revolution, bool velocity_mode) {
    emcmot_command_t c = command(EMCMOT_SET_SPINDLESYNC);
    c.spindle = spindle;
    c.spindlesync = feed_per_revolution;
    c.flags = velocity_mode;
    return send(c);
}

int MotionLink::set_offset(const EmcPose &p) {
    emcmot_command_t c = command(EMCMOT_SET_OFFSET);
    c.tool_offset = p;
    return send(c);
}

int MotionLink::scale(cmd_code_t code, double scale, int spindle) {
    emcmot_command_t c = command(code);
    c.scale = positive(scale);
    c.spindle = spindle;
    return send(c);
}

int MotionLink::enable_flag(cmd_code_t code, int on, int spindle) {
    emcmot_command_t c = command(code);
    c.mode = on != 0;
    c.flags = on != 0;
    c.spindle = spindle;
    return send(c);
}

int MotionLink::set_dout(int index, int start, int end, int now) {
    emcmot_command_t c = command(EMCMOT_SET_DOUT);
    c.out = static_cast<unsigned char>(index);
    c.start = static_cast<unsigned char>(start);
    c.end = static_cast<unsigned char>(end);
    c.now = static_cast<unsigned char>(now);
    return send(c);
}

int MotionLink::set_aout(int index, double start, double end, int now) {
    emcmot_command_t c = command(EMCMOT_SET_AOUT);
    c.out = static_cast<unsigned char>(index);
    c.minLimit = start;
    c.maxLimit = end;
    c.now = static_cast<unsigned char>(now);
    return send(c);
}

bool MotionLink::spindle_runs_at(int spindle, double speed, double factor) const {
    if (spindle < 0 || spindle >= EMCMOT_MAX_SPINDLES || speed == 0 || factor != 0) return false;
    const spindle_status_t &s = status_->spindle_status[spindle];
    return s.state && started_[spindle] && s.speed == speed && s.css_factor == 0 && !s.brake;
}

void MotionLink::started(int spindle, int on) {
    for (int s = 0; s < EMCMOT_MAX_SPINDLES; s++)
        if (spindle < 0 || spindle == s) started_[s] = on;
}

void MotionLink::keep_surface_speed(EMC_SPINDLE_ON *on) const {
    if (on->spindle < 0 || on->spindle >= EMCMOT_MAX_SPINDLES) return;
    const SpindleOrder &o = ordered_[on->spindle];
    if (o.factor == 0) return;
    const double sign = on->speed * o.speed < 0 ? -1 : 1;
    on->speed = sign * o.speed;
    on->factor = sign * o.factor;
    on->xoffset = o.xoffset;
}

int MotionLink::spindle_order(int spindle, double speed, double factor, double xoffset) {
    for (int s = 0; s < EMCMOT_MAX_SPINDLES; s++)
        if (spindle < 0 || spindle == s) ordered_[s] = {speed, factor, xoffset};
    emcmot_command_t c = command(EMCMOT_SPINDLE_ON);
    c.spindle = spindle;
    c.vel = speed;
    c.ini_maxvel = factor;
    c.acc = xoffset;
    c.state = spindle >= 0 && spindle < EMCMOT_MAX_SPINDLES ? started_[spindle] : started_[0];
    c.wait_for_spindle_at_speed = static_cast<unsigned char>(last_wait_);
    return send(c);
}

int MotionLink::spindle_on(int spindle, double speed, double factor, double xoffset, int wait) {
    started(spindle, 1);
    last_wait_ = wait;
    return spindle_order(spindle, speed, factor, xoffset);
}

int MotionLink::spindle_speed(int spindle, double speed, double factor, double xoffset) {
    return spindle_order(spindle, speed, factor, xoffset);
}

int MotionLink::spindle_command(cmd_code_t code, int spindle) {
    emcmot_command_t c = command(code);
    c.spindle = spindle;
    return send(c);
}

int MotionLink::spindle_orient(int spindle, double orientation, int mode) {
    emcmot_command_t c = command(EMCMOT_SPINDLE_ORIENT);
    c.spindle = spindle;
    started(spindle, 0);
    c.orientation = orientation;
    c.mode = static_cast<unsigned char>(mode);
    return send(c);
}

// ---- status ----

void MotionLink::update(std::string *error) {
    error->clear();
    const int r = usrmotReadEmcmotStatus(next_status_);
    if (r == 0) std::swap(status_, next_status_); // a copy torn by a fast writer is dropped: the next cycle reads again
    const emcmot_status_t &s = *status_;
    bool config_changed = r == 0 && s.config_num != config_num_;
    if (config_changed && usrmotReadEmcmotConfig(&config_) == 0) config_num_ = s.config_num;

    char text[EMCMOT_ERROR_LEN];
    if (usrmotReadEmcmotError(text) == 0) *error = text;

    EMC_MOTION_STAT &m = stat_.motion;
    EMC_TRAJ_STAT &t = m.traj;
    m.heartbeat = s.heartbeat;
    t.mode = s.motionFlag & EMCMOT_MOTION_TELEOP_BIT ? EMC_TRAJ_MODE_TELEOP
             : s.motionFlag & EMCMOT_MOTION_COORD_BIT ? EMC_TRAJ_MODE_COORD : EMC_TRAJ_MODE_FREE;
    t.enabled = (s.motionFlag & EMCMOT_MOTION_ENABLE_BIT) && t.joints > 0;
    t.inpos = s.motionFlag & EMCMOT_MOTION_INPOS_BIT;
    t.queue = s.depth;
    t.activeQueue = s.activeDepth;
    t.queueFull = s.queueFull;
    t.id = s.id;
    t.motion_type = s.motionType;
    t.paused = s.paused;
    t.scale = s.feed_scale;
    t.rapid_scale = s.rapid_scale;
    t.position = s.carte_pos_cmd;
    t.actualPosition = s.carte_pos_fb;
    t.velocity = s.vel;
    t.acceleration = s.acc;
    t.maxAcceleration = max_traj_acceleration;
    t.probedPosition = s.probedPos;
    t.probe_tripped = s.probeTripped;
    stop_causes_ = s.stop_causes;
    t.probing = s.probing;
    t.probeval = s.probeVal;
    t.distance_to_go = s.distance_to_go;
    t.dtg = s.dtg;
    t.current_vel = s.current_vel;
    stat_.override_effective = s.override_effective;
    stat_.override_cause = s.override_cause;
    t.tag = s.tag;
    unsigned char enables = t.mode == EMC_TRAJ_MODE_COORD ? s.enables_queued : s.enables_new;
    t.feed_override_enabled = enables & FS_ENABLED;
    t.adaptive_feed_enabled = enables & AF_ENABLED;
    t.feed_hold_enabled = enables & FH_ENABLED;
    if (settling_ && s.heartbeat - settle_from_ >= 2)
        settling_ = false; // the second one has seen all that the command changed
    // A probe move at rest is over in the next cycle, which tells what came of it.
    t.status = s.motionFlag & EMCMOT_MOTION_ERROR_BIT                ? RCS_ERROR
               : t.inpos && t.queue == 0 && !s.probing && !settling_ ? RCS_DONE
                                                                     : RCS_EXEC;
    if (config_changed) {
        t.maxVelocity = config_.limitVel;
        t.cycleTime = config_.trajCycleTime;
        t.kinematics_type = config_.kinType;
    }

    for (int n = 0; n < t.joints && n < EMCMOT_MAX_JOINTS; n++) {
        EMC_JOINT_STAT &j = m.joint[n];
        const emcmot_joint_status_t &from = s.joint_status[n];
        j.joint = n;
        j.output = from.pos_cmd;
        j.input = from.pos_fb;
        j.velocity = from.vel_cmd;
        j.ferrorCurrent = from.ferror;
        j.ferrorHighMark = from.ferror_high_mark;
        j.homing = from.homing;
        j.homed = from.homed;
        j.fault = (from.flag & EMCMOT_JOINT_FAULT_BIT) != 0;
        j.enabled = (from.flag & EMCMOT_JOINT_ENABLE_BIT) != 0;
        j.inpos = (from.flag & EMCMOT_JOINT_INPOS_BIT) != 0;
        j.minHardLimit = (from.flag & EMCMOT_JOINT_MIN_HARD_LIMIT_BIT) != 0;
        j.maxHardLimit = (from.flag & EMCMOT_JOINT_MAX_HARD_LIMIT_BIT) != 0;
        j.overrideLimits = s.overrideLimitMask != 0;
        bool failed = from.flag & EMCMOT_JOINT_ERROR_BIT;
        if (failed && !joint_error_shown_[n])
            rcs_print_error("Error on joint %d, command number %d\n", n, s.commandNumEcho);
        joint_error_shown_[n] = failed;
        j.status = failed ? RCS_ERROR : j.inpos ? RCS_DONE : RCS_EXEC;
        if (config_changed) {
            j.backlash = from.backlash;
            j.minPositionLimit = from.min_pos_limit;
            j.maxPositionLimit = from.max_pos_limit;
            j.minFerror = from.min_ferror;
            j.maxFerror = from.max_ferror;
        }
    }
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        if (!(t.axis_mask & (1 << n))) continue;
        m.axis[n].axis = n;
        m.axis[n].velocity = s.axis_status[n].teleop_vel_cmd;
        if (config_changed) {
            m.axis[n].minPositionLimit = s.axis_status[n].min_pos_limit;
            m.axis[n].maxPositionLimit = s.axis_status[n].max_pos_limit;
        }
    }
    for (int n = 0; n < t.spindles && n < EMCMOT_MAX_SPINDLES; n++) {
        EMC_SPINDLE_STAT &to = m.spindle[n];
        const spindle_status_t &from = s.spindle_status[n];
        to.spindle_override_enabled = enables & SS_ENABLED;
        to.speed = from.rpm;
        to.enabled = from.rpm != 0;
        to.direction = from.direction;
        to.brake = from.brake;
        to.spindle_scale = from.scale;
        to.orient_state = from.orient_state;
        to.orient_fault = from.orient_fault;
    }
    std::copy(std::begin(s.synch_di), std::end(s.synch_di), m.synch_di);
    std::copy(std::begin(s.synch_do), std::end(s.synch_do), m.synch_do);
    std::copy(std::begin(s.analog_input), std::end(s.analog_input), m.analog_input);
    std::copy(std::begin(s.analog_output), std::end(s.analog_output), m.analog_output);
    std::copy(std::begin(s.misc_error), std::end(s.misc_error), m.misc_error);
    m.numExtraJoints = s.numExtraJoints;
    m.jogging_active = s.jogging_active;

    bool exec = t.status == RCS_EXEC, failed = t.status == RCS_ERROR;
    for (int n = 0; n < t.joints && n < EMCMOT_MAX_JOINTS; n++) {
        if (m.joint[n].status == RCS_ERROR) failed = true;
        if (m.joint[n].status == RCS_EXEC) exec = true;
        if (m.joint[n].status != RCS_DONE) break;
    }
    m.status = failed ? RCS_ERROR : exec ? RCS_EXEC : RCS_DONE;
}

int MotionLink::load_positions(const std::string &file) {
    FILE *f = fopen(file.c_str(), "r");
    if (!f) return 0;
    double pos[EMCMOT_MAX_JOINTS];
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++) {
        if (fscanf(f, "%lf", &pos[j]) != 1 || !std::isfinite(pos[j])) {
            rcs_print("emcPositionLoad: failed to load joint %d position from %s, ignoring\n", j, file.c_str());
            fclose(f);
            return 0;
        }
    }
    fclose(f);
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
        if (set_joint_motor_offset(j, -pos[j]) != 0) return -1;
    return 0;
}

// The old ones stay for the eye, as .bak: they are not where the machine is.
int MotionLink::save_positions(const std::string &file) {
    std::string text;
    for (const emcmot_joint_status_t &j : status_->joint_status) {
        char number[60];
        snprintf(number, sizeof number, "%.17f\n", j.pos_fb);
        text += number;
    }
    return linuxcnc::replace_file(file, text, true) ? 0 : -1;
}
