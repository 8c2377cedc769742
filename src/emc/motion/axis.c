/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * axis.c - axis planners of teleop mode.
 *
 * In:     jog targets, axis limits, joint limits
 * Out:    positions of nine axes with offsets
 * Thread: servo; up to 3 times 2 + 3 * 3 calls of kinematicsInverse per moving planner, and once BISECT + 4 for a jog
 *         that meets a joint's limit
 * Method: position and offset of an axis are two planners whose stopping points
 *         together stay within the axis' limits; the point where all axes would
 *         stop must also lie within the joints' limits.
 */
#include <math.h>
#include <string.h>
#include "motion_priv.h"

#define PLANNERS (2 * EMCMOT_MAX_AXIS) /* of position and of offset */
#define STOP_CYCLES 12      /* jerk T^3 of these: rounding of a stop to whole cycles */
#define STOP_ACC_PART 0.5   /* of acc T^2: the same without a limit of jerk */
#define TURN_ACC_PART 0.13  /* of acc T^2: so far between two cycles the parabola through a trapezoidal stop may lie */
#define EDGE 2.0            /* of the way to a stop: must be within reach, too */
#define AHEAD_CYCLES 3      /* of its way: so far beyond its stop a jog may still meet a limit */
#define BISECT 36           /* that way to parts of 1e-9 */
#define OWN_STEP 0.01       /* units, deg: tells which axes move a joint */
#define TELEOP_EPSILON 1e-9 /* units: rounding of forward and inverse kinematics */

void axis_init(struct motion *m)
{
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        struct axis *a = &m->axis[n];
        memset(a, 0, sizeof(*a));
        a->vel_limit = a->acc_limit = 1.0;
        a->locking_joint = -1;
        a->part.vel = a->part.acc = a->part.jerk = 1.0;
        a->jog_acc_scale = 1.0;
        a->joint_lo = -INFINITY;
        a->joint_hi = INFINITY;
    }
}

double axis_get_vel_limit(int axis)
{
    return axis >= 0 && axis < EMCMOT_MAX_AXIS ? motion_state_.axis[axis].vel_limit : 0.0;
}

double axis_get_acc_limit(int axis)
{
    return axis >= 0 && axis < EMCMOT_MAX_AXIS ? motion_state_.axis[axis].acc_limit : 0.0;
}

double axis_get_jerk_limit(int axis)
{
    if (axis < 0 || axis >= EMCMOT_MAX_AXIS)
        return 0.0;
    const struct axis *a = &motion_state_.axis[axis];
    double whole = a->acc_limit + a->ext_offset_acc_limit; /* the offset has the rest of the jerk */
    return a->ext_offset_vel_limit > 0.0 && whole > 0.0 ? a->jerk_limit * a->acc_limit / whole : a->jerk_limit;
}

void axes_sync_to(struct motion *m, const EmcPose *pose)
{
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        simple_tp_adopt(&m->axis[n].teleop_tp, emcPoseGetAxis(pose, n), 0.0, 0.0);
        m->axis[n].kb_ajog_active = m->axis[n].wheel_ajog_active = 0;
    }
}

void axes_abort(struct motion *m, int immediate)
{
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        struct axis *a = &m->axis[n];
        a->teleop_tp.enable = 0;
        if (immediate) {
            simple_tp_adopt(&a->teleop_tp, a->teleop_tp.curr_pos, 0.0, 0.0);
            a->kb_ajog_active = a->wheel_ajog_active = 0;
        }
    }
}

int axes_jogging(const struct motion *m)
{
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++)
        if (m->axis[n].kb_ajog_active || m->axis[n].wheel_ajog_active)
            return 1;
    return 0;
}

int axes_moving(const struct motion *m)
{
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++)
        if (m->axis[n].teleop_tp.active || m->axis[n].teleop_tp.curr_vel != 0.0)
            return 1;
    return 0;
}

/* ---- teleop mode ---- */

/* Limits of both planners of an axis; 0: it takes no offsets. */
static int teleop_limits(struct axis *a, const struct teleop_scale *scale)
{
    double whole = a->acc_limit + a->ext_offset_acc_limit;
    int offsets = eoffset_prepare(a);
    simple_tp_t *p = &a->teleop_tp, *e = &a->ext_offset_tp;
    p->max_vel = fmin(a->jog_vel, a->vel_limit) * scale->vel;
    p->max_acc = a->acc_limit * a->jog_acc_scale * scale->acc;
    p->max_jerk = (offsets ? a->jerk_limit * a->acc_limit / whole : a->jerk_limit) * scale->jerk;
    if (offsets) {
        e->max_vel *= scale->vel;
        e->max_acc *= scale->acc;
        e->max_jerk *= scale->jerk;
    }
    if (scale->crowded) {
        p->max_vel = fmin(p->max_vel, fabs(p->curr_vel));
        e->max_vel = fmin(e->max_vel, fabs(e->curr_vel));
    }
    return offsets;
}

static int axis_moves(const struct axis *a) { return a->teleop_tp.curr_vel != 0.0 || a->ext_offset_tp.curr_vel != 0.0; }

/* Speed that a planner has or cannot avoid any more. */
double axis_speed_ahead(const simple_tp_t *tp)
{
    double rising = fmax(0.0, tp->curr_vel < 0.0 ? -tp->curr_acc : tp->curr_acc);
    return fabs(tp->curr_vel) + (tp->max_jerk > SIMPLE_TP_MIN_JERK ? rising * rising / (1.6 * tp->max_jerk) : 0.0);
}

/* One step of axis n; the sum of position and offset can always stop within the limits. */
static void teleop_axis_step(struct motion *m, int n, const struct teleop_scale *scale)
{
    struct axis *a = &m->axis[n];
    simple_tp_t *p = &a->teleop_tp, *e = &a->ext_offset_tp;
    double T = m->traj_period, lo = fmax(a->min_pos_limit, a->joint_lo), hi = fmin(a->max_pos_limit, a->joint_hi);
    int offsets = teleop_limits(a, scale);
    a->part = *scale;
    if (axis_has_no_limits(a)) {
        axis_step_within(p, a->joint_lo, a->joint_hi, T);
        if (offsets)
            axis_step_within(e, -INFINITY, INFINITY, T);
        return;
    }
    struct axis_reach pr = axis_reach_of(p, T), er = axis_reach_of(e, T);
    /* never further out than where it is already bound to stop */
    axis_step_within(p, fmin(lo - er.lo, pr.lo), fmax(hi - er.hi, pr.hi), T);
    pr = axis_reach_of(p, T);
    if (offsets)
        axis_step_within(e, fmin(lo - pr.lo, er.lo), fmax(hi - pr.hi, er.hi), T);
    double sum = p->curr_pos + e->curr_pos;
    if (e->curr_pos != 0.0 && (sum >= hi - TELEOP_EPSILON || sum <= lo + TELEOP_EPSILON))
        m->eoffset_limited = 1;
}

/* The axis that alone moves, without an offset; -1: none or several. */
static int only_axis(const struct motion *m)
{
    int only = -1;
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        const struct axis *a = &m->axis[n];
        if (!axis_moves(a) && !(a->teleop_tp.enable && a->teleop_tp.active))
            continue;
        if (only >= 0 || a->ext_offset_tp.curr_vel != 0.0)
            return -1;
        only = n;
    }
    return only;
}

/* 1 when the planner of the axis that alone moves knows where a joint's limit is. */
static int limit_is_met(const struct motion *m)
{
    int n = m->status->motion_state == EMCMOT_MOTION_TELEOP ? only_axis(m) : -1;
    return n >= 0 && isfinite(m->axis[n].teleop_tp.curr_vel > 0.0 ? m->axis[n].joint_hi : m->axis[n].joint_lo);
}

/* 1 when any homed joint at q is farther outside its limits than it is now, by more than eps. (No joint may go out
 * for another one that comes in.) A stop is known to a part of a cycle's acceleration, with limited jerk to some cycles
 * of jerk: where the planner of the axis knows the joint's limit it sees to the rest,
 * elsewhere that much is kept free. */
int joints_go_outside(const struct motion *m, const double *q, double eps)
{
    double T = m->traj_period;
    int own = m->kin_type == KINEMATICS_IDENTITY || limit_is_met(m);
    for (int j = 0; j < kin_joints(m); j++) {
        const emcmot_joint_t *jt = &m->joint[j];
        if (!is_active(jt) || !get_homed(j))
            continue;
        if (!isfinite(q[j]))
            return 1;
        double slack = STOP_CYCLES * fmax(0.0, jt->jerk_limit) * T * T * T;
        if (!own)
            slack = -slack - STOP_ACC_PART * jt->acc_limit * T * T;
        double now = jt->coarse_pos, hi = jt->max_pos_limit + slack, lo = jt->min_pos_limit - slack;
        if (q[j] > fmax(now, hi) + eps || q[j] < fmin(now, lo) - eps)
            return 1;
    }
    return 0;
}

/* Where the axes are after t seconds of a stop; beyond > 1: so much farther than its end. */
static void on_way_to_stop(const struct motion *m, const simple_tp_t *tp, double t, double beyond, EmcPose *way)
{
    *way = m->status->carte_pos_cmd;
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        const simple_tp_t *p = &tp[2 * n], *e = p + 1;
        *emcPoseAxis(way, n) = p->curr_pos + e->curr_pos +
                               beyond * (simple_tp_stop_way(p, m->traj_period, t) +
                                         simple_tp_stop_way(e, m->traj_period, t));
    }
}

/* The times at which a planner on its way to a stop brakes otherwise or stands, ascending, by more than a cycle apart;
 * returns how many. Between two of them the axes' accelerations change steadily. */
static int stop_times(const simple_tp_t *tp, double T, double *times)
{
    int count = 0, kept = 0;
    for (int i = 0; i < PLANNERS; i++) {
        double phases[SIMPLE_TP_PHASES];
        simple_tp_stop_times(&tp[i], T, phases);
        for (int k = 0; k < SIMPLE_TP_PHASES; k++) {
            int at = count++;
            for (; at > 0 && times[at - 1] > phases[k]; at--)
                times[at] = times[at - 1];
            times[at] = phases[k];
        }
    }
    for (int i = 0; i < count; i++) /* of times close together the last */
        if (kept > 0 && times[i] - times[kept - 1] < 1.5 * T)
            times[kept - 1] = times[i];
        else if (times[i] > 0.0)
            times[kept++] = times[i];
    return kept;
}

/* Value of the cubic with the values q at 0, 1, 2, 3. */
static double cubic_at(const double q[4], double u)
{
    double d1 = q[1] - q[0], d2 = q[2] - q[1] - d1, d3 = q[3] - 3.0 * (q[2] - q[1]) - q[0];
    return q[0] + u * (d1 + 0.5 * (u - 1.0) * (d2 + (u - 2.0) * d3 / 3.0));
}

/* Lowest and highest value of that cubic between 0 and 3, where they lie inside: outmost[2]; else q[0]. */
static void turning_points(const double q[4], double outmost[2])
{
    double d1 = q[1] - q[0], d2 = q[2] - q[1] - d1, d3 = q[3] - 3.0 * (q[2] - q[1]) - q[0];
    double a = 0.5 * d3, b = d2 - d3, c = d1 - 0.5 * d2 + d3 / 3.0, root = b * b - 4.0 * a * c; /* of the slope */
    double h = -0.5 * (b + copysign(sqrt(fmax(0.0, root)), b)), at[2] = {c / h, h / a};
    for (int i = 0; i < 2; i++)
        outmost[i] = root > 0.0 && at[i] > 0.0 && at[i] < 3.0 ? cubic_at(q, at[i]) : q[0];
}

/* 1 when a joint turns round outside its limits between four places. (A turn of less than what a stop is rounded by
 * to whole cycles is none.) */
static int turns_outside(struct motion *m, double q[4][EMCMOT_MAX_JOINTS])
{
    double turns[2][EMCMOT_MAX_JOINTS], T = m->traj_period;
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++) {
        double places[4] = {q[0][j], q[1][j], q[2][j], q[3][j]}, outmost[2];
        double lo = fmin(q[0][j], q[3][j]), hi = fmax(q[0][j], q[3][j]),
               rounding = TURN_ACC_PART * m->joint[j].acc_limit * T * T;
        turning_points(places, outmost);
        for (int i = 0; i < 2; i++)
            turns[i][j] = outmost[i] > hi + rounding || outmost[i] < lo - rounding ? outmost[i] : q[3][j];
    }
    return joints_go_outside(m, turns[0], TELEOP_EPSILON) || joints_go_outside(m, turns[1], TELEOP_EPSILON);
}

/* 1 when a joint leaves its limits, or the pose its reach, while the planners come to rest. Axes stand at different
 * times, so that a joint which the slower one leads back may go out on the way: it turns between two of the times.
 * rest: the joints at the end. */
static __attribute__((noinline)) int stop_leaves(struct motion *m, const simple_tp_t *tp, double *rest)
{
    double q[4][EMCMOT_MAX_JOINTS], times[PLANNERS * SIMPLE_TP_PHASES], t = 0.0;
    int count = stop_times(tp, m->traj_period, times), met = limit_is_met(m);
    KINEMATICS_FORWARD_FLAGS fflags = m->fflags;
    EmcPose way;
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
        q[3][j] = m->joint[j].coarse_pos;
    on_way_to_stop(m, tp, 0.0, 1.0, &way);
    if (kinematicsInverse(&way, q[3], &m->iflags, &fflags) != 0 || joints_go_outside(m, q[3], TELEOP_EPSILON))
        return 1;
    for (int i = 0; i < count; i++) {
        memcpy(q[0], q[3], sizeof(q[0]));
        for (int k = 1; k <= 3; k++) {
            memcpy(q[k], q[k - 1], sizeof(q[k]));
            on_way_to_stop(m, tp, k == 3 ? times[i] : t + k * (times[i] - t) / 3.0, 1.0, &way);
            if (kinematicsInverse(&way, q[k], &m->iflags, &fflags) != 0 || joints_go_outside(m, q[k], TELEOP_EPSILON))
                return 1;
        }
        if (!met && turns_outside(m, q))
            return 1;
        t = times[i];
    }
    memcpy(rest, q[3], sizeof(q[3]));
    return 0;
}

/* 1 when the axes, stopped from now on (with other parts of their limits, if any), come to rest at a place the joints
 * can be at, over places they can be at, and not so near the edge of what can be reached that
 * they could not brake there. */
static int stop_is_reachable(struct motion *m, const struct teleop_scale *scale)
{
    simple_tp_t tp[PLANNERS];
    double q[EMCMOT_MAX_JOINTS];
    KINEMATICS_FORWARD_FLAGS fflags = m->fflags;
    EmcPose way;
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        struct axis a = m->axis[n];
        if (scale)
            teleop_limits(&a, scale);
        tp[2 * n] = a.teleop_tp;
        tp[2 * n + 1] = a.ext_offset_tp;
    }
    if (stop_leaves(m, tp, q))
        return 0;
    if (m->kin_type == KINEMATICS_IDENTITY)
        return 1;
    on_way_to_stop(m, tp, INFINITY, EDGE, &way);
    return kinematicsInverse(&way, q, &m->iflags, &fflags) == 0;
}

/* 1 when the acceleration of a planner ends in time: it gets no faster than its limit, and a brake
 * is released before the speed is zero. */
static int acceleration_can_end(const simple_tp_t *tp)
{
    double braking = fmax(0.0, tp->curr_vel < 0.0 ? tp->curr_acc : -tp->curr_acc);
    if (tp->max_jerk <= SIMPLE_TP_MIN_JERK)
        return 1;
    return axis_speed_ahead(tp) <= fmax(tp->max_vel, fabs(tp->curr_vel)) &&
           braking * braking <= 1.6 * tp->max_jerk * fabs(tp->curr_vel);
}

/* 1 when every moving axis can still stop where it could with its former part of acceleration
 * and jerk: within the limits of axes and joints, without getting too fast. */
static int parts_can_change(struct motion *m, const struct teleop_scale *scale)
{
    double T = m->traj_period;
    int lower = 0;
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        struct axis *a = &m->axis[n], with = *a;
        if (!axis_moves(a) || (scale->acc >= a->part.acc && scale->jerk >= a->part.jerk))
            continue;
        lower = 1;
        teleop_limits(&with, scale);
        if (!acceleration_can_end(&with.teleop_tp) || !acceleration_can_end(&with.ext_offset_tp))
            return 0;
        struct axis_reach p = axis_reach_of(&with.teleop_tp, T), e = axis_reach_of(&with.ext_offset_tp, T);
        if (!axis_has_no_limits(a) && (p.hi + e.hi > a->max_pos_limit || p.lo + e.lo < a->min_pos_limit))
            return 0;
    }
    return !lower || stop_is_reachable(m, scale);
}

/* 1 when the joints are within their limits with axis n at x. */
static int joints_inside_at(struct motion *m, int n, double x)
{
    double q[EMCMOT_MAX_JOINTS];
    EmcPose pose = m->status->carte_pos_cmd;
    KINEMATICS_FORWARD_FLAGS fflags = m->fflags;
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
        q[j] = m->joint[j].coarse_pos;
    *emcPoseAxis(&pose, n) = x + m->axis[n].ext_offset_tp.curr_pos;
    if (kinematicsInverse(&pose, q, &m->iflags, &fflags) != 0)
        return 0;
    for (int j = 0; j < kin_joints(m); j++) {
        const emcmot_joint_t *jt = &m->joint[j];
        if (is_active(jt) && get_homed(j) && !(q[j] <= jt->max_pos_limit && q[j] >= jt->min_pos_limit))
            return 0;
    }
    return 1;
}

/* 1 when no other axis moves the joints that axis n moves: the place where it meets their limit stays where it is. */
static int joints_are_its_own(struct motion *m, int n)
{
    double here[EMCMOT_MAX_JOINTS], q[2][EMCMOT_MAX_JOINTS];
    KINEMATICS_FORWARD_FLAGS fflags = m->fflags;
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
        here[j] = q[0][j] = q[1][j] = m->joint[j].coarse_pos;
    for (int other = 0; other < 2; other++) {
        EmcPose pose = m->status->carte_pos_cmd;
        for (int a = 0; a < EMCMOT_MAX_AXIS; a++)
            *emcPoseAxis(&pose, a) += (a != n) == other ? OWN_STEP : 0.0;
        if (kinematicsInverse(&pose, q[other], &m->iflags, &fflags) != 0)
            return 0;
    }
    for (int j = 0; j < kin_joints(m); j++)
        if (fabs(q[0][j] - here[j]) > TELEOP_EPSILON && fabs(q[1][j] - here[j]) > TELEOP_EPSILON)
            return 0;
    return 1;
}

/* A jog of one axis would stop beyond a joint's limit, or nearly: finds where it meets it. 0: nowhere near. */
static int find_joint_limit(struct motion *m)
{
    int n = only_axis(m);
    if (n < 0 || !joints_are_its_own(m, n))
        return 0;
    struct axis *a = &m->axis[n];
    const simple_tp_t *p = &a->teleop_tp;
    double T = m->traj_period, dir = p->curr_vel != 0.0 ? copysign(1.0, p->curr_vel)
                                                        : copysign(1.0, p->pos_cmd - p->curr_pos);
    double in = p->curr_pos + simple_tp_stop_distance(p, T);
    double out = in + dir * AHEAD_CYCLES * (fabs(p->curr_vel) + a->acc_limit * T) * T;
    if (isfinite(dir > 0.0 ? a->joint_hi : a->joint_lo) || !joints_inside_at(m, n, in) || joints_inside_at(m, n, out))
        return 0;
    for (int i = 0; i < BISECT; i++) {
        double mid = 0.5 * (in + out);
        if (joints_inside_at(m, n, mid))
            in = mid;
        else
            out = mid;
    }
    *(dir > 0.0 ? &a->joint_hi : &a->joint_lo) = in;
    return 1;
}

/* What was found holds for one jog. */
static void forget_joint_limits(struct motion *m)
{
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        struct axis *a = &m->axis[n];
        if (axis_moves(a))
            continue;
        a->joint_lo = -INFINITY;
        a->joint_hi = INFINITY;
    }
}

static void teleop_step(struct motion *m, const struct teleop_scale *scale, int keep)
{
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        struct axis *a = &m->axis[n];
        struct teleop_scale own = *scale;
        if (keep && axis_moves(a)) {
            own.acc = fmax(own.acc, a->part.acc);
            own.jerk = fmax(own.jerk, a->part.jerk);
        }
        if (keep)
            own.crowded = 1;
        teleop_axis_step(m, n, &own);
    }
}

void axis_teleop_step(struct motion *m, EmcPose *pose)
{
    struct teleop_scale scale;
    int jogging = 0, keep;
    double asked[EMCMOT_MAX_AXIS];
    m->eoffset_limited = 0;
    eoffsets_asked(m, asked);
    if (m->offsets_wait)
        eoffsets_hold(m);
    teleop_scale(m, &scale);
    keep = !parts_can_change(m, &scale);
    forget_joint_limits(m);
    memcpy(m->axis_was, m->axis, sizeof(m->axis));
    teleop_step(m, &scale, keep);
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++)
        jogging |= axis_moves(&m->axis[n]);
    int bad = jogging && !stop_is_reachable(m, NULL);
    if (bad) {
        memcpy(m->axis, m->axis_was, sizeof(m->axis));
        if (find_joint_limit(m)) {
            teleop_step(m, &scale, keep);
            bad = !stop_is_reachable(m, NULL);
            if (bad)
                memcpy(m->axis, m->axis_was, sizeof(m->axis));
        }
    }
    if (bad) {
        for (int n = 0; n < EMCMOT_MAX_AXIS; n++)
            m->axis[n].teleop_tp.enable = 0;
        eoffsets_hold(m);
        for (int n = 0; n < EMCMOT_MAX_AXIS; n++)
            asked[n] = NAN; /* no second try at the edge of what can be reached */
        teleop_step(m, &scale, keep);
    }
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        struct axis *a = &m->axis[n];
        if (!a->teleop_tp.active) {
            a->kb_ajog_active = a->wheel_ajog_active = 0;
            a->jog_acc_scale = 1.0;
        }
        *emcPoseAxis(pose, n) = a->teleop_tp.curr_pos + a->ext_offset_tp.curr_pos;
    }
    eoffsets_release(m, asked);
    hal_set_bool(m->pins->eoffset_limited, m->eoffset_limited);
}
