/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * teleop_scale.c - how fast axes may be jogged so that every joint keeps its limits.
 *
 * In:     axis planners, kinematics, limits of the joints
 * Out:    parts (0..1] of the axes' speed, acceleration and jerk
 * Thread: servo; at most PLACES * (7 + 18) calls of kinematicsInverse, none at rest
 * Method: on the way to where the axes would stop, differences of the inverse kinematics
 *         give each joint's speed D, curvature term C and acceleration G for the axes'
 *         full speed and acceleration. With parts s (speed) and a (acceleration):
 *         s D <= V and s^2 C + a G <= A. The jerk is shared among its three terms. Lower
 *         limits farther ahead are met in time, as the way looked at is the stopping
 *         distance. While axes that are still too fast for s brake, no other gets faster.
 */
#include <math.h>
#include "motion_priv.h"

#define PLACES 3
#define AHEAD 3.0         /* of the way to a stop is looked at */
#define STEP_S 0.005      /* of the differences: at 1 mm/s 5 um, far above the solvers' precision */
#define CURVED_SHARE 0.4  /* of a joint's acceleration that the curvature term may take */
#define CURVED_MARGIN 0.9 /* of the limits where the Jacobian changes: it is looked at in places only */
#define JERK_SHARE 0.3    /* of a joint's jerk for each of its terms where the Jacobian changes */
#define STRAIGHT 1e-4     /* curvature term, in parts of the acceleration, that counts as none */

struct load {
    double speed, acc, jerk; /* of one joint at the axes' full speed, acceleration, jerk: largest on the way */
    double curve, twist;     /* second and third derivative at full speed */
    double now;              /* speed that the axes' present speeds and one cycle more can add up to */
};

struct wanted {
    double vel, acc, jerk; /* of one axis: position and offset together, unscaled */
    double dir;            /* of the motion, -1 or 1 */
    double ahead;          /* signed distance looked at, units */
    double now;            /* present speed, units/s, >= 0: what it becomes before it can fall */
};

static double direction(const simple_tp_t *tp)
{
    double d = tp->curr_vel != 0.0 ? tp->curr_vel : tp->pos_cmd - tp->curr_pos;
    return d < 0.0 ? -1.0 : 1.0;
}

static double way_ahead(const simple_tp_t *tp, double T)
{
    return AHEAD * simple_tp_stop_distance(tp, T) + 6.0 * tp->curr_vel * T;
}

/* What the axes want to do; 0: nothing moves. */
static int wanted_motion(const struct motion *m, struct wanted w[EMCMOT_MAX_AXIS])
{
    double T = m->traj_period;
    int any = 0;
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        const struct axis *a = &m->axis[n];
        const simple_tp_t *p = &a->teleop_tp, *e = &a->ext_offset_tp;
        struct wanted none = {0.0, 0.0, 0.0, 1.0, 0.0, 0.0};
        w[n] = none;
        if (p->curr_vel != 0.0 || (p->enable && p->pos_cmd != p->curr_pos)) {
            w[n].vel = fmin(a->jog_vel, a->vel_limit);
            w[n].acc = a->acc_limit;
            w[n].dir = direction(p);
            w[n].ahead = way_ahead(p, T);
            w[n].now = axis_speed_ahead(p);
        }
        if (a->ext_offset_vel_limit > 0.0 && (e->curr_vel != 0.0 || (e->enable && e->pos_cmd != e->curr_pos))) {
            if (w[n].vel == 0.0)
                w[n].dir = direction(e);
            w[n].vel += a->ext_offset_vel_limit;
            w[n].acc += a->ext_offset_acc_limit;
            w[n].ahead += way_ahead(e, T);
            w[n].now += axis_speed_ahead(e);
        }
        w[n].jerk = w[n].vel > 0.0 ? a->jerk_limit : 0.0;
        any |= w[n].vel > 0.0;
    }
    return any;
}

static void pose_at(const struct motion *m, const struct wanted *w, double part, EmcPose *pose)
{
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++)
        *emcPoseAxis(pose, n) =
            m->axis[n].teleop_tp.curr_pos + m->axis[n].ext_offset_tp.curr_pos + part * w[n].ahead;
}

/* Joint positions of a pose moved by seconds * full speed, of all axes or of one. q: seed, then result. */
static int joints_of(struct motion *m, const EmcPose *from, const struct wanted *w, int only, double seconds, double *q)
{
    EmcPose pose = *from;
    KINEMATICS_FORWARD_FLAGS fflags = m->fflags;
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++)
        if (only < 0 || only == n)
            *emcPoseAxis(&pose, n) += w[n].dir * w[n].vel * seconds;
    return kinematicsInverse(&pose, q, &m->iflags, &fflags);
}

/* Adds what the joints have to do at one place; q: seed, then the joints there. Returns 0, or not. */
static __attribute__((noinline)) int load_at(struct motion *m, const struct wanted *w, double part,
                                             double *q, struct load *load)
{
    const double h = STEP_S;
    double ahead[EMCMOT_MAX_JOINTS], ahead2[EMCMOT_MAX_JOINTS], behind[EMCMOT_MAX_JOINTS], moved[EMCMOT_MAX_JOINTS];
    double speed[EMCMOT_MAX_JOINTS] = {0}, acc[EMCMOT_MAX_JOINTS] = {0}, jerk[EMCMOT_MAX_JOINTS] = {0};
    double now[EMCMOT_MAX_JOINTS] = {0};
    EmcPose pose;
    int joints = kin_joints(m), derived;
    pose_at(m, w, part, &pose);
    if (joints_of(m, &pose, w, -1, 0.0, q) != 0)
        return -1;
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
        ahead[j] = ahead2[j] = behind[j] = q[j];
    derived = joints_of(m, &pose, w, -1, h, ahead) == 0 && joints_of(m, &pose, w, -1, 2.0 * h, ahead2) == 0 &&
              joints_of(m, &pose, w, -1, -h, behind) == 0;
    if (!derived) { /* at the edge of what can be reached: looking back */
        for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
            ahead[j] = ahead2[j] = behind[j] = q[j];
        derived = joints_of(m, &pose, w, -1, -h, ahead) == 0 && joints_of(m, &pose, w, -1, -2.0 * h, ahead2) == 0 &&
                  joints_of(m, &pose, w, -1, h / 16.0, behind) == 0;
        for (int j = 0; derived && j < joints; j++)
            behind[j] = q[j] + 16.0 * (behind[j] - q[j]);
    }
    if (!derived)
        return -1;
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        if (w[n].vel <= 0.0)
            continue;
        for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
            moved[j] = q[j];
        if (joints_of(m, &pose, w, n, h, moved) != 0 && joints_of(m, &pose, w, n, -h, moved) != 0)
            return -1;
        for (int j = 0; j < joints; j++) {
            double rate = fabs(moved[j] - q[j]) / h;
            speed[j] += rate;
            acc[j] += rate * w[n].acc / w[n].vel;
            jerk[j] += rate * w[n].jerk / w[n].vel;
            now[j] += rate * w[n].now / w[n].vel;
        }
    }
    for (int j = 0; j < joints; j++) {
        load[j].speed = fmax(load[j].speed, speed[j]);
        load[j].acc = fmax(load[j].acc, acc[j]);
        load[j].jerk = fmax(load[j].jerk, jerk[j]);
        load[j].now = fmax(load[j].now, now[j]);
        load[j].curve = fmax(load[j].curve, fabs(ahead[j] - 2.0 * q[j] + behind[j]) / (h * h));
        load[j].twist = fmax(load[j].twist, fabs(ahead2[j] - 3.0 * (ahead[j] - q[j]) - behind[j]) / (h * h * h));
    }
    return 0;
}

static double part_of(double limit, double load) { return load > limit * (1.0 + 1e-9) ? limit / load : 1.0; }
static int is_curved(const struct load *l, const struct joint_limits *lim) { return l->curve > STRAIGHT * lim->acc; }

/* Parts for one joint; *s holds those of the joints before. */
static void speed_for(const struct joint_limits *lim, const struct load *l, struct teleop_scale *s)
{
    double margin = is_curved(l, lim) ? CURVED_MARGIN : 1.0;
    s->vel = fmin(s->vel, part_of(margin * lim->vel, l->speed));
    if (!is_curved(l, lim))
        return;
    s->vel = fmin(s->vel, sqrt(part_of(CURVED_SHARE * lim->acc, l->curve)));
    if (lim->jerk > 0.0)
        s->vel = fmin(s->vel, cbrt(part_of(JERK_SHARE * lim->jerk, l->twist)));
}

static void rest_for(const struct joint_limits *lim, const struct load *l, double acc_of_speed, struct teleop_scale *s)
{
    if (!is_curved(l, lim)) {
        s->acc = fmin(s->acc, part_of(lim->acc, l->acc));
        if (lim->jerk > 0.0)
            s->jerk = fmin(s->jerk, part_of(lim->jerk, l->jerk));
        return;
    }
    s->acc = fmin(s->acc, part_of(CURVED_MARGIN * lim->acc - s->vel * s->vel * l->curve, l->acc));
    if (lim->jerk > 0.0) {
        s->acc = fmin(s->acc, part_of(JERK_SHARE * lim->jerk, 3.0 * l->curve * s->vel * acc_of_speed));
        s->jerk = fmin(s->jerk, part_of(JERK_SHARE * lim->jerk, l->jerk));
    }
}

/* At the very edge of what can be reached nothing is known: the parts of the cycle before. */
static void parts_of_before(const struct motion *m, const struct wanted *w, struct teleop_scale *s)
{
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        const struct teleop_scale *was = &m->axis[n].part;
        if (w[n].vel <= 0.0)
            continue;
        s->vel = fmin(s->vel, was->vel);
        s->acc = fmin(s->acc, was->acc);
        s->jerk = fmin(s->jerk, was->jerk);
    }
}

void teleop_scale(struct motion *m, struct teleop_scale *scale)
{
    struct wanted w[EMCMOT_MAX_AXIS];
    struct load load[EMCMOT_MAX_JOINTS] = {{0}};
    struct joint_limits lim[EMCMOT_MAX_JOINTS];
    struct teleop_scale s = {1.0, 1.0, 1.0, 0};
    double q[EMCMOT_MAX_JOINTS], acc_of_speed = 0.0;
    int joints = kin_joints(m), too_fast = 0, edge = 0;
    *scale = s;
    if (!wanted_motion(m, w))
        return;
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
        q[j] = m->joint[j].coarse_pos;
    for (int i = 0; i < PLACES; i++)
        if (load_at(m, w, (double)i / (PLACES - 1), q, load) != 0) {
            edge = 1;
            if (i == 0)
                parts_of_before(m, w, &s);
            break;
        }
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++)
        if (w[n].vel > 0.0)
            acc_of_speed = fmax(acc_of_speed, w[n].acc / w[n].vel);
    for (int j = 0; j < joints; j++) {
        lim[j] = joint_motion_limits(&m->joint[j]);
        speed_for(&lim[j], &load[j], &s);
    }
    for (int j = 0; j < joints; j++)
        rest_for(&lim[j], &load[j], acc_of_speed, &s);
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++)
        too_fast |= w[n].now > s.vel * w[n].vel * (1.0 + 1e-9);
    for (int j = 0; too_fast && j < joints; j++)
        if (load[j].now + s.acc * load[j].acc * m->traj_period > lim[j].vel)
            s.crowded = 1;
    s.crowded |= edge; /* nothing gets faster towards what cannot be reached */
    *scale = s;
}
