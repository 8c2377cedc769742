// SPDX-License-Identifier: GPL-2.0-or-later
//
// task_canon.cc - canonical calls to messages: frames, units, limits, straight moves,
// offsets, spindles, the rest. Arcs and splines: task_canon_curves.cc.
//
// Method: a straight move is limited by each axis that moves; the axis that needs the most
// time decides, so speed along the path = path length / that time. Sheet section 7.3.
#include "task_canon.hh"

#include <algorithm>
#include <cmath>

#include "task_text.hh"

namespace {

constexpr int X = 0, A = 3, B = 4, C = 5, U = 6, W = 8;
constexpr double TINY = 1e-8; // machine units: below it an axis does not move (CART_FUZZ)

std::array<double, 9> as_array(const EmcPose &p) {
    return {p.tran.x, p.tran.y, p.tran.z, p.a, p.b, p.c, p.u, p.v, p.w};
}

bool rotary(int axis) { return axis >= A && axis <= C; }

double distance(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); }

} // namespace

TaskCanon::TaskCanon(EMC_STAT &stat, InterpList &list, const AxisLimits &limits, const CanonSettings &settings)
    : stat_(&stat), list_(&list), limits_(limits), settings_(settings) {}

TaskCanon::~TaskCanon() {
    if (log_) fclose(log_);
    if (probe_log_) fclose(probe_log_);
}

void TaskCanon::take_state(const TaskCanon &other) {
    g5x_ = other.g5x_;
    g92_ = other.g92_;
    tool_offset_ = other.tool_offset_;
    end_ = other.end_;
    rotation_ = other.rotation_;
    g5x_index_ = other.g5x_index_;
    units_ = other.units_;
    plane_ = other.plane_;
    motion_mode_ = other.motion_mode_;
    motion_tolerance_ = other.motion_tolerance_;
    naivecam_tolerance_ = other.naivecam_tolerance_;
    linear_feed_ = other.linear_feed_;
    angular_feed_ = other.angular_feed_;
    feed_mode_ = other.feed_mode_;
    feed_spindle_ = other.feed_spindle_;
    sync_spindle_ = other.sync_spindle_;
    rotary_unlocked_ = other.rotary_unlocked_;
    spindle_ = other.spindle_;
    optional_stop = other.optional_stop;
    block_delete = other.block_delete;
    offsets_applied = other.offsets_applied;
    offsets = other.offsets;
    user_code_exists = other.user_code_exists;
    user_code_command = other.user_code_command;
    hal_lookup = other.hal_lookup;
    chain_.clear();
    looking_ahead_ = true;
}

void TaskCanon::attach(EMC_STAT &stat, InterpList &list) {
    stat.task.programUnits = stat_->task.programUnits;
    stat_ = &stat;
    list_ = &list;
    looking_ahead_ = false;
}

// ---- units ----

double TaskCanon::linear_scale() const { return stat_->motion.traj.linearUnits; }
double TaskCanon::angular_scale() const { return stat_->motion.traj.angularUnits; }

double TaskCanon::GET_EXTERNAL_LENGTH_UNITS() {
    if (linear_scale() == 0) {
        CANON_ERROR("external length units are zero");
        return 1;
    }
    return linear_scale();
}

double TaskCanon::GET_EXTERNAL_ANGLE_UNITS() {
    if (angular_scale() == 0) {
        CANON_ERROR("external angle units are zero");
        return 1;
    }
    return angular_scale();
}

static EmcPose scaled(const EmcPose &p, double length, double angle) {
    EmcPose r;
    r.tran.x = p.tran.x * length; r.tran.y = p.tran.y * length; r.tran.z = p.tran.z * length;
    r.a = p.a * angle; r.b = p.b * angle; r.c = p.c * angle;
    r.u = p.u * length; r.v = p.v * length; r.w = p.w * length;
    return r;
}

EmcPose TaskCanon::from_program(const EmcPose &p) const { return scaled(p, program_factor(), 1); }
EmcPose TaskCanon::to_program(const EmcPose &p) const { return scaled(p, 1 / program_factor(), 1); }
EmcPose TaskCanon::to_machine(const EmcPose &p) const { return scaled(p, linear_scale(), angular_scale()); }
EmcPose TaskCanon::machine_to_internal(const EmcPose &p) const {
    return scaled(p, linear_scale() ? 1 / linear_scale() : 1, angular_scale() ? 1 / angular_scale() : 1);
}

// ---- frames ----

void TaskCanon::rotate(double *x, double *y, double degrees) const {
    double t = degrees * M_PI / 180, c = std::cos(t), s = std::sin(t), rx = *x * c - *y * s;
    *y = *x * s + *y * c;
    *x = rx;
}

static void add(EmcPose *p, const EmcPose &q, double sign) {
    p->tran.x += sign * q.tran.x; p->tran.y += sign * q.tran.y; p->tran.z += sign * q.tran.z;
    p->a += sign * q.a; p->b += sign * q.b; p->c += sign * q.c;
    p->u += sign * q.u; p->v += sign * q.v; p->w += sign * q.w;
}

EmcPose TaskCanon::offset_pose(const EmcPose &internal) const {
    EmcPose p = internal;
    add(&p, g92_, 1);
    rotate(&p.tran.x, &p.tran.y, rotation_);
    add(&p, g5x_, 1);
    add(&p, tool_offset_, 1);
    return p;
}

EmcPose TaskCanon::to_absolute(const EmcPose &program) const { return offset_pose(from_program(program)); }

EmcPose TaskCanon::to_frame(const EmcPose &absolute) const {
    EmcPose p = absolute;
    add(&p, tool_offset_, -1);
    add(&p, g5x_, -1);
    rotate(&p.tran.x, &p.tran.y, -rotation_);
    add(&p, g92_, -1);
    return to_program(p);
}

// ---- limits ----

double TaskCanon::axis_limit(const std::array<double, 9> &v, int axis) const {
    double scale = rotary(axis) ? angular_scale() : linear_scale();
    return v[static_cast<size_t>(axis)] / (scale ? scale : 1);
}

std::array<double, 9> TaskCanon::deltas(const EmcPose &p, bool *cartesian, bool *angular) const {
    std::array<double, 9> to = as_array(p), from = as_array(end_), d{};
    *cartesian = *angular = false;
    for (int i = X; i <= W; i++) {
        size_t n = static_cast<size_t>(i);
        // B and C take the threshold of lengths, as documented.
        double fuzz = TINY / (i == A ? (angular_scale() ? angular_scale() : 1) : (linear_scale() ? linear_scale() : 1));
        d[n] = std::fabs(to[n] - from[n]);
        if (!(stat_->motion.traj.axis_mask & (1 << i)) || d[n] < fuzz) d[n] = 0;
        if (d[n] > 0) *(rotary(i) ? angular : cartesian) = true;
    }
    return d;
}

TaskCanon::Path TaskCanon::straight_limit(const EmcPose &p, const std::array<double, 9> &limit, bool cubic) const {
    Path r;
    std::array<double, 9> d = deltas(p, &r.cartesian, &r.angular);
    for (int i = X; i <= W; i++) {
        size_t n = static_cast<size_t>(i);
        if (d[n] > 0) r.t = std::max(r.t, cubic ? std::cbrt(d[n] / axis_limit(limit, i)) : d[n] / axis_limit(limit, i));
    }
    double length;
    if (!r.cartesian) length = distance(d[A], d[B], d[C]);
    else if (d[0] > 0 || d[1] > 0 || d[2] > 0) length = distance(d[0], d[1], d[2]);
    else length = distance(d[U], d[U + 1], d[W]);
    double t = cubic ? r.t * r.t * r.t : r.t;
    r.value = t > 0 ? length / t : 0;
    return r;
}

TaskCanon::Path TaskCanon::straight_velocity(const EmcPose &p) const {
    Path r = straight_limit(p, limits_.velocity, false);
    if (!r.cartesian && !r.angular) r.value = linear_feed_;
    return r;
}

TaskCanon::Path TaskCanon::straight_acceleration(const EmcPose &p) const {
    return straight_limit(p, limits_.acceleration, false);
}
TaskCanon::Path TaskCanon::straight_jerk(const EmcPose &p) const { return straight_limit(p, limits_.jerk, true); }

double TaskCanon::path_to_machine(const Path &p, double value) const {
    return value * (p.angular && !p.cartesian ? angular_scale() : linear_scale());
}

// ---- straight moves ----

bool TaskCanon::linkable(const EmcPose &p) const {
    if (motion_mode_ != CANON_CONTINUOUS || naivecam_tolerance_ == 0 || chain_.size() > 100) return false;
    const EmcPose &last = chain_.back().pose;
    if (last.a != p.a || last.b != p.b || last.c != p.c || last.u != p.u || last.v != p.v || last.w != p.w)
        return false;
    double mx = p.tran.x - end_.tran.x, my = p.tran.y - end_.tran.y, mz = p.tran.z - end_.tran.z;
    double mm = mx * mx + my * my + mz * mz;
    if (mm == 0) return false;
    for (const Point &q : chain_) {
        double qx = q.pose.tran.x - end_.tran.x, qy = q.pose.tran.y - end_.tran.y, qz = q.pose.tran.z - end_.tran.z;
        double t = std::clamp((mx * qx + my * qy + mz * qz) / mm, 0.0, 1.0);
        if (distance(qx - t * mx, qy - t * my, qz - t * mz) > naivecam_tolerance_) return false;
    }
    return true;
}

void TaskCanon::chain(int line, const EmcPose &p) {
    if (!chain_.empty() && !linkable(p)) flush();
    bool others_move =
        p.a != end_.a || p.b != end_.b || p.c != end_.c || p.u != end_.u || p.v != end_.v || p.w != end_.w;
    chain_.push_back({p, line, tag_});
    if (others_move) flush();
}

void TaskCanon::flush() {
    if (chain_.empty()) return;
    Point last = chain_.back();
    chain_.clear();
    straight_segment(last.line, last.pose, last.tag);
}

void TaskCanon::straight_segment(int line, const EmcPose &p, const state_tag_t &tag) {
    Path v = straight_velocity(p), a = straight_acceleration(p), j = straight_jerk(p);
    EMC_TRAJ_LINEAR_MOVE m;
    double feed = v.cartesian || !v.angular ? std::min(v.value, linear_feed_) : std::min(v.value, angular_feed_);
    m.type = EMC_MOTION_TYPE_FEED;
    m.end = to_machine(p);
    m.vel = path_to_machine(v, feed);
    m.ini_maxvel = path_to_machine(v, v.value);
    m.acc = path_to_machine(a, a.value);
    m.ini_maxjerk = path_to_machine(j, j.value);
    m.feed_mode = feed_mode_;
    m.indexer_jnum = -1;
    m.tag = tag;
    if ((m.vel != 0 && m.acc != 0) || spindle_[static_cast<size_t>(sync_spindle_)].synched) emit_at(m, line);
    end_ = p;
}

void TaskCanon::STRAIGHT_FEED(int line, const EmcPose &end) { chain(line, to_absolute(end)); }

void TaskCanon::sync_off_for_move() {
    if (feed_mode_ == 0) return;
    EMC_TRAJ_SET_SPINDLESYNC off;
    off.spindle = feed_spindle_;
    emit(off);
}

void TaskCanon::sync_on_after_move() {
    if (feed_mode_ == 0) return;
    EMC_TRAJ_SET_SPINDLESYNC on;
    on.spindle = feed_spindle_;
    on.feed_per_revolution = from_program_length(linear_feed_) * linear_scale();
    on.velocity_mode = true;
    emit(on);
}

void TaskCanon::STRAIGHT_TRAVERSE(int line, const EmcPose &end) {
    flush();
    traverse_to(line, to_absolute(end));
}

void TaskCanon::traverse_to(int line, const EmcPose &p) {
    Path v = straight_velocity(p), a = straight_acceleration(p), j = straight_jerk(p);
    EMC_TRAJ_LINEAR_MOVE m;
    m.type = rotary_unlocked_ >= 0 ? EMC_MOTION_TYPE_INDEXROTARY : EMC_MOTION_TYPE_TRAVERSE;
    m.end = to_machine(p);
    m.vel = m.ini_maxvel = path_to_machine(v, v.value);
    m.acc = path_to_machine(a, a.value);
    m.ini_maxjerk = path_to_machine(j, j.value);
    m.indexer_jnum = rotary_unlocked_;
    m.tag = tag_;
    if (m.vel != 0 && m.acc != 0) {
        sync_off_for_move();
        emit_at(m, line);
        sync_on_after_move();
    }
    end_ = p;
}

void TaskCanon::machine_move(const EmcPose &machine, double feed) {
    EmcPose p = machine_to_internal(machine);
    Path v = straight_velocity(p), a = straight_acceleration(p), j = straight_jerk(p);
    EMC_TRAJ_LINEAR_MOVE m;
    m.type = feed > 0 ? EMC_MOTION_TYPE_FEED : EMC_MOTION_TYPE_TRAVERSE;
    m.end = machine;
    m.ini_maxvel = path_to_machine(v, v.value);
    m.vel = feed > 0 ? std::min(feed, m.ini_maxvel) : m.ini_maxvel;
    m.acc = path_to_machine(a, a.value);
    m.ini_maxjerk = path_to_machine(j, j.value);
    m.indexer_jnum = -1;
    m.tag = tag_;
    if (m.vel != 0 && m.acc != 0) emit(m);
    end_ = p;
}

void TaskCanon::approach_above(const EmcPose &from, const EmcPose &end, double z) {
    end_ = machine_to_internal(from);
    EmcPose p = from;
    p.tran.z = z;
    machine_move(p, 0);
    p = end;
    p.tran.z = z;
    machine_move(p, 0);
}

void TaskCanon::approach_down(const EmcPose &end, double feed) { machine_move(end, feed); }

int TaskCanon::UNLOCK_ROTARY(int line, int joint) {
    EMC_TRAJ_LINEAR_MOVE m; // a move of no length that stops blending before the unlock
    m.type = EMC_MOTION_TYPE_TRAVERSE;
    m.end = to_machine(end_);
    m.vel = m.ini_maxvel = m.acc = 1;
    m.indexer_jnum = -1;
    sync_off_for_move();
    emit_at(m, line);
    sync_on_after_move();
    rotary_unlocked_ = joint;
    return 0;
}

int TaskCanon::LOCK_ROTARY(int, int) {
    rotary_unlocked_ = -1;
    return 0;
}

// FP-022: a tap runs along the plane's normal. Where its line names a place aside, the tool traverses there
// first, at the
// height it has, and back afterwards: for the interpreter the position stays the one before the line.
bool TaskCanon::beside_the_tap(const EmcPose &end, EmcPose *over) const {
    constexpr double ROUNDING = 1e-6; // mm
    double n[3] = {plane_ == CANON_PLANE_YZ ? 1.0 : 0.0, plane_ == CANON_PLANE_XZ ? 1.0 : 0.0,
                   plane_ == CANON_PLANE_XY ? 1.0 : 0.0};
    rotate(&n[0], &n[1], rotation_);
    PmCartesian to = end.tran, at = end_.tran;
    double depth = (to.x - at.x) * n[0] + (to.y - at.y) * n[1] + (to.z - at.z) * n[2];
    *over = end;
    over->tran = {to.x - depth * n[0], to.y - depth * n[1], to.z - depth * n[2]};
    return std::fabs(depth) > ROUNDING &&
           std::hypot(over->tran.x - at.x, over->tran.y - at.y, over->tran.z - at.z) > ROUNDING;
}

void TaskCanon::RIGID_TAP(int line, double x, double y, double z, double scale) {
    EmcPose p = {};
    p.tran.x = from_program_length(x);
    p.tran.y = from_program_length(y);
    p.tran.z = from_program_length(z);
    p = offset_pose(p);
    p.a = end_.a; p.b = end_.b; p.c = end_.c; p.u = end_.u; p.v = end_.v; p.w = end_.w;
    flush();
    EmcPose from = end_, over;
    bool aside = beside_the_tap(p, &over);
    EMC_TRAJ_SET_SPINDLESYNC off;
    off.spindle = sync_.spindle;
    if (aside) {
        emit(off);
        traverse_to(line, over);
        emit(sync_);
    }
    Path v = straight_velocity(p), a = straight_acceleration(p), j = straight_jerk(p);
    EMC_TRAJ_RIGID_TAP m;
    m.pos = to_machine(p);
    m.vel = m.ini_maxvel = path_to_machine(v, v.value);
    m.acc = path_to_machine(a, a.value);
    m.ini_maxjerk = path_to_machine(j, j.value);
    m.scale = scale;
    if (m.vel != 0 && m.acc != 0) emit_at(m, line);
    if (aside) {
        emit(off);
        traverse_to(line, from);
    }
}

void TaskCanon::STRAIGHT_PROBE(int line, const EmcPose &end, unsigned char type) {
    flush();
    EmcPose p = to_absolute(end);
    Path v = straight_velocity(p), a = straight_acceleration(p), j = straight_jerk(p);
    EMC_TRAJ_PROBE m;
    m.pos = to_machine(p);
    m.type = EMC_MOTION_TYPE_PROBING;
    m.ini_maxvel = path_to_machine(v, v.value);
    m.vel = path_to_machine(v, std::min(v.value, v.cartesian || !v.angular ? linear_feed_ : angular_feed_));
    m.acc = path_to_machine(a, a.value);
    m.ini_maxjerk = path_to_machine(j, j.value);
    m.probe_type = type;
    if (m.vel != 0 && m.acc != 0) emit_at(m, line);
    end_ = p;
}

void TaskCanon::TURN_PROBE_ON() { emit(EMC_TRAJ_CLEAR_PROBE_TRIPPED_FLAG()); }

// ---- state ----

void TaskCanon::INIT_CANON() {
    chain_.clear();
    rotation_ = 0;
    rotary_unlocked_ = -1;
    feed_mode_ = 0;
    sync_spindle_ = 0;
    g5x_ = g92_ = tool_offset_ = end_ = EmcPose{};
    plane_ = CANON_PLANE_XY;
    for (Spindle &s : spindle_) { s.speed = 0; s.synched = false; }
    optional_stop = block_delete = true;
    linear_feed_ = angular_feed_ = 0;
    double u = GET_EXTERNAL_LENGTH_UNITS();
    if (std::fabs(u - 1 / 25.4) < 1e-3) units_ = CANON_UNITS_INCHES;
    else {
        units_ = CANON_UNITS_MM;
        if (std::fabs(u - 1) >= 1e-3) CANON_ERROR("non-standard length units, setting interpreter to mm");
    }
    stat_->task.programUnits = units_;
    SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, units_ == CANON_UNITS_INCHES ? 0.001 : 0.0254, -1, -1);
    naivecam_tolerance_ = 0;
}

void TaskCanon::refresh_css() {
    if (keeps_speeds) return;
    for (int s = 0; s < EMCMOT_MAX_SPINDLES; s++) {
        if (spindle_[static_cast<size_t>(s)].css_maximum == 0) continue;
        EMC_SPINDLE_SPEED m;
        fill_speed(&m, s);
        emit(m);
    }
}

void TaskCanon::SET_G5X_OFFSET(int index, const EmcPose &offset) {
    flush();
    g5x_ = from_program(offset);
    g5x_index_ = index;
    refresh_css();
    EMC_TRAJ_SET_G5X m;
    m.g5x_index = index;
    m.origin = to_machine(g5x_);
    emit(m);
}

void TaskCanon::SET_G92_OFFSET(const EmcPose &offset) {
    flush();
    g92_ = from_program(offset);
    refresh_css();
    EMC_TRAJ_SET_G92 m;
    m.origin = to_machine(g92_);
    emit(m);
}

void TaskCanon::SET_XY_ROTATION(double degrees) {
    rotation_ = degrees;
    EMC_TRAJ_SET_ROTATION m;
    m.rotation = degrees;
    emit(m);
}

void TaskCanon::USE_TOOL_LENGTH_OFFSET(const EmcPose &offset) {
    flush();
    tool_offset_ = from_program(offset);
    refresh_css();
    EMC_TRAJ_SET_OFFSET m;
    m.offset = to_machine(tool_offset_);
    emit(m);
}

void TaskCanon::USE_LENGTH_UNITS(CANON_UNITS units) {
    units_ = units;
    stat_->task.programUnits = units;
}

void TaskCanon::CANON_UPDATE_END_POINT(const EmcPose &position) { end_ = from_program(position); }

void TaskCanon::SET_FEED_MODE(int spindle, int mode) {
    flush();
    feed_mode_ = mode;
    feed_spindle_ = spindle;
    if (mode == 0) STOP_SPEED_FEED_SYNCH();
}

void TaskCanon::SET_FEED_RATE(double rate) {
    if (feed_mode_ == 1) {
        if (rate != linear_feed_) flush();
        linear_feed_ = rate;
        EMC_TRAJ_SET_SPINDLESYNC m;
        m.spindle = feed_spindle_;
        m.feed_per_revolution = from_program_length(rate) * linear_scale();
        m.velocity_mode = true;
        emit(m);
        return;
    }
    double linear = from_program_length(rate) / 60, angular = rate / 60;
    if (linear != linear_feed_ || angular != angular_feed_) flush();
    linear_feed_ = linear;
    angular_feed_ = angular;
}

void TaskCanon::SET_MOTION_CONTROL_MODE(CANON_MOTION_MODE mode, double tolerance, int planner_type,
                                        double scurve_peak_scale) {
    flush();
    motion_mode_ = mode;
    motion_tolerance_ = from_program_length(tolerance);
    EMC_TRAJ_SET_TERM_COND m;
    m.cond = mode == CANON_CONTINUOUS   ? EMCMOT_TERM_COND_BLEND
             : mode == CANON_EXACT_PATH ? EMCMOT_TERM_COND_EXACT
                                        : EMCMOT_TERM_COND_STOP;
    if (mode == CANON_CONTINUOUS) m.tolerance = motion_tolerance_ * linear_scale();
    m.planner_type = planner_type;
    m.scurve_peak_scale = scurve_peak_scale;
    emit(m);
}

void TaskCanon::SET_NAIVECAM_TOLERANCE(double tolerance) { naivecam_tolerance_ = from_program_length(tolerance); }

void TaskCanon::START_SPEED_FEED_SYNCH(int spindle, double feed_per_revolution, bool velocity_mode) {
    flush();
    EMC_TRAJ_SET_SPINDLESYNC m;
    m.spindle = spindle;
    m.feed_per_revolution = from_program_length(feed_per_revolution) * linear_scale();
    m.velocity_mode = velocity_mode;
    sync_ = m;
    emit(m);
    sync_spindle_ = spindle >= 0 && spindle < EMCMOT_MAX_SPINDLES ? spindle : 0;
    spindle_[static_cast<size_t>(sync_spindle_)].synched = true;
}

void TaskCanon::STOP_SPEED_FEED_SYNCH() {
    int synched = sync_spindle_;
    START_SPEED_FEED_SYNCH(0, 0, false);
    spindle_[static_cast<size_t>(synched)].synched = false;
    spindle_[static_cast<size_t>(sync_spindle_)].synched = false;
}

void TaskCanon::DWELL(double seconds) {
    flush();
    EMC_TRAJ_DELAY m;
    m.delay = seconds;
    emit(m);
}

// ---- spindles ----

template <class T> void TaskCanon::fill_speed(T *m, int spindle) {
    Spindle &s = spindle_[static_cast<size_t>(spindle)];
    m->spindle = spindle;
    if (s.css_maximum != 0) {
        double u = linear_scale();
        double k =
            units_ == CANON_UNITS_INCHES ? 12 / (2 * M_PI) * s.speed * (25.4 * u) : 1000 / (2 * M_PI) * s.speed * u;
        s.css_factor = s.dir * k;
        m->speed = s.speed != 0 ? s.dir * s.css_maximum : 0; // a factor of 0 means constant speed
        m->factor = s.css_factor;
        m->xoffset = x_offset();
    } else {
        m->speed = s.dir * s.speed;
        s.css_factor = 0;
    }
}

void TaskCanon::SET_SPINDLE_MODE(int spindle, double css_max) {
    if (spindle >= 0 && spindle < EMCMOT_MAX_SPINDLES)
        spindle_[static_cast<size_t>(spindle)].css_maximum = std::fabs(css_max);
}

void TaskCanon::SET_SPINDLE_SPEED(int spindle, double speed) {
    flush();
    if (spindle < 0 || spindle >= EMCMOT_MAX_SPINDLES) return;
    spindle_[static_cast<size_t>(spindle)].speed = std::fabs(speed);
    if (keeps_speeds) return;
    EMC_SPINDLE_SPEED m;
    fill_speed(&m, spindle);
    emit(m);
}

void TaskCanon::start_spindle(int spindle, int dir, int wait) {
    flush();
    if (spindle < 0 || spindle >= EMCMOT_MAX_SPINDLES) return;
    spindle_[static_cast<size_t>(spindle)].dir = dir;
    EMC_SPINDLE_ON m;
    fill_speed(&m, spindle);
    m.wait_for_spindle_at_speed = wait;
    emit(m);
}

void TaskCanon::spindle_is(int spindle, int dir) {
    for (int s = 0; s < EMCMOT_MAX_SPINDLES; s++)
        if (spindle < 0 || spindle == s) spindle_[static_cast<size_t>(s)].dir = dir;
}

void TaskCanon::constant_rpm() {
    for (Spindle &s : spindle_) s.css_maximum = s.css_factor = 0;
}

void TaskCanon::STOP_SPINDLE_TURNING(int spindle, int wait_for_atspeed) {
    flush();
    if (spindle >= 0 && spindle < EMCMOT_MAX_SPINDLES) {
        spindle_[static_cast<size_t>(spindle)].dir = 0;
        spindle_[static_cast<size_t>(spindle)].css_factor = 0;
    }
    EMC_SPINDLE_OFF m;
    m.spindle = spindle;
    m.wait_for_spindle_at_speed = wait_for_atspeed;
    emit(m);
}

void TaskCanon::ORIENT_SPINDLE(int spindle, double degrees, int direction) {
    flush();
    EMC_SPINDLE_ORIENT m;
    m.spindle = spindle;
    m.orientation = degrees;
    m.mode = direction;
    emit(m);
}

void TaskCanon::WAIT_SPINDLE_ORIENT_COMPLETE(int spindle, double timeout_s) {
    flush();
    EMC_SPINDLE_WAIT_ORIENT_COMPLETE m;
    m.spindle = spindle;
    m.timeout = timeout_s;
    emit(m);
}

// ---- tools ----

void TaskCanon::SET_TOOL_TABLE_ENTRY(int idx, int toolno, const EmcPose &offset, double diameter, double frontangle,
                                     double backangle, int orientation) {
    flush();
    EMC_TOOL_SET_OFFSET m;
    m.pocket = idx;
    m.toolno = toolno;
    m.offset = offset;
    m.diameter = diameter;
    m.frontangle = frontangle;
    m.backangle = backangle;
    m.orientation = orientation;
    emit(m);
}

void TaskCanon::SELECT_TOOL(int toolno) {
    EMC_TOOL_PREPARE m;
    m.tool = toolno;
    emit(m);
}

void TaskCanon::CHANGE_TOOL() {
    flush();
    const std::vector<double> &pos = settings_.tool_change_position;
    if (pos.size() >= 3) {
        EmcPose machine = to_machine(end_);
        machine.tran.x = pos[0]; machine.tran.y = pos[1]; machine.tran.z = pos[2];
        if (pos.size() >= 6) { machine.a = pos[3]; machine.b = pos[4]; machine.c = pos[5]; }
        if (pos.size() >= 9) { machine.u = pos[6]; machine.v = pos[7]; machine.w = pos[8]; }
        EmcPose p = machine_to_internal(machine);
        Path v = straight_velocity(p), a = straight_acceleration(p), j = straight_jerk(p);
        EMC_TRAJ_LINEAR_MOVE m;
        m.type = EMC_MOTION_TYPE_TOOLCHANGE;
        m.end = machine;
        m.vel = m.ini_maxvel = path_to_machine(v, v.value);
        m.acc = path_to_machine(a, a.value);
        m.ini_maxjerk = path_to_machine(j, j.value);
        m.indexer_jnum = -1;
        m.tag = tag_;
        if (m.vel != 0 && m.acc != 0) {
            sync_off_for_move();
            emit(m);
            sync_on_after_move();
        }
        end_ = p;
    }
    emit(EMC_TOOL_LOAD());
}

void TaskCanon::CHANGE_TOOL_NUMBER(int idx) {
    flush(); // the interpreter waits for all before, and asks for the position then
    EMC_TOOL_SET_NUMBER m;
    m.tool = idx;
    emit(m);
}

void TaskCanon::RELOAD_TOOLDATA() { emit(EMC_TOOL_LOAD_TOOL_TABLE()); }

// ---- text ----

void TaskCanon::COMMENT(const char *text) {
    if (looking_ahead_) return;
    std::string s = text;
    if (s.compare(0, 9, "PROBEOPEN") == 0) {
        size_t at = s.find_first_not_of(" \t", 9);
        std::string name = at == std::string::npos ? "" : s.substr(at);
        if (probe_log_) fclose(probe_log_);
        probe_log_ = fopen(name.c_str(), "wt");
        last_probed_ = EmcPose{};
        if (!probe_log_) MESSAGE(("can't open probe file " + name).c_str());
    } else if (s.compare(0, 10, "PROBECLOSE") == 0) {
        if (probe_log_) fclose(probe_log_);
        probe_log_ = nullptr;
    } else if (s.compare(0, 3, "RPY") == 0) {
        double r, p, y;
        if (sscanf(text, "RPY %lf %lf %lf", &r, &p, &y) == 3) {
            // Unit quaternion of roll, pitch, yaw about fixed axes (radians).
            double cr = std::cos(r / 2), sr = std::sin(r / 2), cp = std::cos(p / 2), sp = std::sin(p / 2),
                   cy = std::cos(y / 2), sy = std::sin(y / 2);
            printf("rpy = %f %f %f, quat = %f %f %f %f\n", r, p, y, cr * cp * cy + sr * sp * sy,
                   sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy);
        }
    }
}

void TaskCanon::MESSAGE(const char *text) {
    flush();
    EMC_OPERATOR_DISPLAY m;
    copy_text(m.display, text);
    emit(m);
}

void TaskCanon::CANON_ERROR(const char *text) {
    flush();
    EMC_OPERATOR_ERROR m;
    copy_text(m.error, text);
    emit(m);
}

void TaskCanon::open_log(const char *name, const char *mode, const char *what) {
    if (looking_ahead_) return;
    if (log_) fclose(log_);
    log_ = fopen(name, mode);
    fprintf(stderr, "%s(%s) -> %p\n", what, name, static_cast<void *>(log_));
}

void TaskCanon::LOG(const char *text) {
    flush();
    if (looking_ahead_) return;
    if (log_) {
        fprintf(log_, "%s\n", text);
        fflush(log_);
    }
    fprintf(stderr, "LOG(%s)\n", text);
}

void TaskCanon::LOGCLOSE() {
    if (looking_ahead_) return;
    if (log_) fclose(log_);
    log_ = nullptr;
    fprintf(stderr, "LOGCLOSE()\n");
}

// ---- inputs, outputs, overrides ----

void TaskCanon::adaptive_feed(int on) {
    flush();
    EMC_MOTION_ADAPTIVE m;
    m.status = static_cast<unsigned char>(on);
    emit(m);
}

void TaskCanon::feed_override(int on) {
    flush();
    EMC_TRAJ_SET_FO_ENABLE m;
    m.mode = static_cast<unsigned char>(on);
    emit(m);
}

void TaskCanon::speed_override(int spindle, int on) {
    flush();
    EMC_TRAJ_SET_SO_ENABLE m;
    m.spindle = spindle;
    m.mode = static_cast<unsigned char>(on);
    emit(m);
}

void TaskCanon::feed_hold(int on) {
    flush();
    EMC_TRAJ_SET_FH_ENABLE m;
    m.mode = static_cast<unsigned char>(on);
    emit(m);
}

// The message has a byte for it: numbers beyond stay numbers that no output has.
static unsigned char output_number(int index) {
    return static_cast<unsigned char>(index < 0 || index > 255 ? 255 : index);
}

void TaskCanon::output_bit(int index, int value, int now) {
    flush();
    EMC_MOTION_SET_DOUT m;
    m.index = output_number(index);
    m.start = m.end = static_cast<unsigned char>(value);
    m.now = static_cast<unsigned char>(now);
    emit(m);
}

void TaskCanon::output_value(int index, double value, int now) {
    flush();
    EMC_MOTION_SET_AOUT m;
    m.index = output_number(index);
    m.start = m.end = value;
    m.now = static_cast<unsigned char>(now);
    emit(m);
}

int TaskCanon::WAIT(int index, CANON_INPUT input, CANON_WAIT wait, double timeout_s) {
    if (index < 0 || index >= (input == DIGITAL_INPUT ? EMCMOT_MAX_DIO : EMCMOT_MAX_AIO)) return -1;
    flush();
    EMC_AUX_INPUT_WAIT m;
    m.index = index;
    m.input_type = input;
    m.wait_type = wait;
    m.timeout = timeout_s;
    emit(m);
    return 0;
}

void TaskCanon::USER_DEFINED_FUNCTION(int num, double p, double q) {
    flush();
    EMC_SYSTEM_CMD m;
    copy_text(m.string, user_code_command(num, p, q).c_str());
    emit(m);
}

// ---- what the machine says ----

double TaskCanon::GET_EXTERNAL_FEED_RATE() {
    return feed_mode_ == 1 ? linear_feed_ : to_program_length(linear_feed_) * 60;
}

double TaskCanon::GET_EXTERNAL_TRAVERSE_RATE() {
    double u = linear_scale();
    return to_program_length(stat_->motion.traj.maxVelocity / (u ? u : 1)) * 60;
}

EmcPose TaskCanon::GET_EXTERNAL_POSITION() {
    chain_.clear();
    EmcPose p = stat_->motion.traj.position;
    if (offsets_applied) add(&p, offsets, -1);
    end_ = machine_to_internal(p);
    return to_frame(end_);
}

EmcPose TaskCanon::GET_EXTERNAL_PROBE_POSITION() {
    flush();
    EmcPose p = to_frame(machine_to_internal(stat_->motion.traj.probedPosition));
    if (probe_log_) {
        std::array<double, 9> now = as_array(p);
        if (now != as_array(last_probed_)) {
            fprintf(probe_log_, "%f %f %f %f %f %f %f %f %f\n", now[0], now[1], now[2], now[3], now[4], now[5], now[6],
                    now[7], now[8]);
            fflush(probe_log_);
            last_probed_ = p;
        }
    }
    return p;
}

bool TaskCanon::GET_EXTERNAL_QUEUE_EMPTY() {
    flush();
    return stat_->motion.traj.queue == 0;
}

CANON_DIRECTION TaskCanon::GET_EXTERNAL_SPINDLE(int spindle) {
    if (spindle < 0 || spindle >= EMCMOT_MAX_SPINDLES || stat_->motion.spindle[spindle].speed == 0)
        return CANON_STOPPED;
    return stat_->motion.spindle[spindle].speed > 0 ? CANON_CLOCKWISE : CANON_COUNTERCLOCKWISE;
}

int TaskCanon::GET_EXTERNAL_TOOL_SLOT() {
    int idx = tooldata_find_index_for_tool(stat_->io.tool.toolInSpindle);
    return idx < 0 ? 0 : idx;
}

CANON_TOOL_TABLE TaskCanon::GET_EXTERNAL_TOOL_TABLE(int idx) {
    CANON_TOOL_TABLE rec = tooldata_entry_init();
    if (looking_ahead_ && idx == 0) {
        idx = tooldata_find_index_for_tool(stat_->io.tool.toolInSpindle);
        if (idx == 0 && !tool_mmap_is_random_toolchanger()) return rec; // no tool
    }
    if (idx >= 0 && idx < CANON_POCKETS_MAX && tooldata_get(&rec, idx) != IDX_OK) rec = tooldata_entry_init();
    return rec;
}

int TaskCanon::GET_EXTERNAL_DIGITAL_INPUT(int index, int) {
    if (index < 0 || index >= EMCMOT_MAX_DIO || stat_->task.input_timeout) return -1;
    return stat_->motion.synch_di[index] != 0;
}

double TaskCanon::GET_EXTERNAL_ANALOG_INPUT(int index, double) {
    if (index < 0 || index >= EMCMOT_MAX_AIO) return -1;
    return stat_->motion.analog_input[index];
}
