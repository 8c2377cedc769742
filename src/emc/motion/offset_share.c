/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * offset_share.c - the joints' limits between the path and the external offsets.
 *
 * In:     OFFSET_AV_RATIO of the axes (as their limits for offsets), kinematics, limits of the joints
 * Out:    limits of the joints for the planner of the path; parts (0..1] of the offset planners' limits
 * Thread: servo; at most PLACES * (7 + 18) + 2 * (STOP_PLACES + 10) calls of kinematicsInverse, none
 * while no offset moves
 * Method: a joint that offsets of an axis move keeps that axis' ratio of its limits for them; the
 *         path is planned within the rest, less a margin where the Jacobian depends on the place.
 *         While an offset moves, differences of the inverse kinematics give each joint's speed D
 *         and acceleration G for an axis' full speed and acceleration, the curvature term C of all
 *         offsets together, and the term X in which the offsets' speeds and the path's enter. With
 *         parts s and a: s D <= V / k, a G <= A / 2k, s (s C + X) <= A / 2 of the share of a joint
 *         that k axes' offsets move.
 */
#include <math.h>
#include "motion_priv.h"

#define PLACES 3
#define STOP_PLACES 4       /* looked at on the way to a stop of several offsets, which is no straight line */
#define AHEAD 1.5          /* of the way to a stop, from place to place: limits farther on are met in time */
#define CYCLES 3           /* the same, of the present speed */
#define STEP_S 0.005       /* s: of the differences along a motion */
#define STEP_UNITS 0.01    /* of the differences along an axis */
#define MOVES 1e-9         /* units: a joint that moves less for a step is not concerned */
#define PATH_MARGIN 0.92   /* of the path's limits where the Jacobian changes with the place */
#define HALF 0.5           /* of a share's acceleration for the motion through curved space */
#define JERK_PART 0.33     /* of a share's jerk for each of its terms */

static int axis_takes_offsets(const struct axis *a)
{
    return a->ext_offset_vel_limit > 0.0 && a->ext_offset_acc_limit > 0.0;
}

static int joints_at(struct motion *m, const EmcPose *pose, double *q)
{
    KINEMATICS_FORWARD_FLAGS fflags = m->fflags;
    KINEMATICS_INVERSE_FLAGS iflags = m->iflags;
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
        q[j] = m->joint[j].coarse_pos;
    return kinematicsInverse(pose, q, &iflags, &fflags);
}

/* ---- shares ---- */

/* Notes the joints that a step along axis n moves, from pose. */
static void find_from(struct motion *m, const EmcPose *pose, int n, int *moved_by)
{
    double q[EMCMOT_MAX_JOINTS], moved[EMCMOT_MAX_JOINTS];
    EmcPose at = *pose;
    *emcPoseAxis(&at, n) += STEP_UNITS;
    if (joints_at(m, pose, q) != 0 || joints_at(m, &at, moved) != 0)
        return;
    for (int j = 0; j < kin_joints(m); j++)
        if (fabs(moved[j] - q[j]) > MOVES)
            moved_by[j] |= 1 << n;
}

void offset_share_find(struct motion *m)
{
    static const double elsewhere[EMCMOT_MAX_AXIS] = {7, -4, 3, 11, -17, 23, 2, -3, 5}; /* units, deg: no symmetry */
    int moved_by[EMCMOT_MAX_JOINTS] = {0};
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        m->axis[n].offset_part = (struct teleop_scale){0.0, 0.0, 0.0, 0}; /* not known */
        if (!axis_takes_offsets(&m->axis[n]))
            continue;
        for (int sign = -1; sign <= 1; sign++) {
            EmcPose pose = m->status->carte_pos_cmd;
            for (int k = 0; k < EMCMOT_MAX_AXIS; k++)
                *emcPoseAxis(&pose, k) += sign * elsewhere[k];
            find_from(m, &pose, n, moved_by);
        }
    }
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++) {
        m->offset_share[j] = 0.0;
        m->offset_axes[j] = 0;
        for (int n = 0; n < EMCMOT_MAX_AXIS; n++)
            if (moved_by[j] & 1 << n) {
                const struct axis *a = &m->axis[n];
                m->offset_axes[j]++;
                m->offset_share[j] =
                    fmax(m->offset_share[j],
                         a->ext_offset_acc_limit / (a->acc_limit + a->ext_offset_acc_limit));
            }
    }
}

struct joint_limits offset_share_path(const struct motion *m, int j)
{
    struct joint_limits l = joint_motion_limits(&m->joint[j]);
    double part = 1.0 - m->offset_share[j];
    if (m->offset_share[j] <= 0.0)
        return l;
    if (m->kin_type != KINEMATICS_IDENTITY)
        part *= PATH_MARGIN;
    l.vel *= part;
    l.acc *= part;
    l.jerk *= part;
    return l;
}

/* ---- parts ---- */

struct moving {
    EmcPose at;                                            /* path and offset */
    double path[EMCMOT_MAX_AXIS],
        offset[EMCMOT_MAX_AXIS]; /* units/s: the path's speed; the offsets' full speed, 0 at rest */
    struct teleop_scale part[EMCMOT_MAX_AXIS];             /* wanted of each axis */
};

/* Joints after a seconds of the path's motion and b seconds of the offsets'. */
static int joints_after(struct motion *m, const struct moving *w, double a, double b, double *q)
{
    EmcPose pose = w->at;
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++)
        *emcPoseAxis(&pose, n) += a * w->path[n] + b * w->part[n].vel * w->offset[n];
    return joints_at(m, &pose, q);
}

static double part_of(double limit, double load) { return load > limit * (1.0 + 1e-9) ? limit / load : 1.0; }

/* The axes' own parts: of each joint's share an axis has as much as any other that moves it.
 * -1: an axis comes to the end
 * of the kinematics' reach, where joints move without bound for a step. */
static int straight_parts(struct motion *m, struct moving *w, const double *q)
{
    double ahead[EMCMOT_MAX_JOINTS], behind[EMCMOT_MAX_JOINTS];
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        const struct axis *a = &m->axis[n];
        struct teleop_scale *s = &w->part[n];
        EmcPose pose = w->at;
        if (w->offset[n] == 0.0)
            continue;
        double step = copysign(STEP_UNITS, w->offset[n]);
        *emcPoseAxis(&pose, n) += step;
        if (joints_at(m, &pose, ahead) != 0)
            return -1;
        *emcPoseAxis(&pose, n) -= 2.0 * step;
        int both = joints_at(m, &pose, behind) == 0;
        for (int j = 0; j < kin_joints(m); j++) {
            struct joint_limits lim = joint_motion_limits(&m->joint[j]);
            double moved = fmax(fabs(ahead[j] - q[j]), both ? fabs(behind[j] - q[j]) : 0.0);
            double slope = moved / STEP_UNITS, share = m->offset_share[j];
            if (moved <= MOVES)
                continue;
            share /= m->offset_axes[j] > 0 ? m->offset_axes[j] : 1;
            double bend = m->kin_type == KINEMATICS_IDENTITY ? 1.0 : HALF;
            s->vel = fmin(s->vel, part_of(share * lim.vel, slope * a->ext_offset_vel_limit));
            s->acc = fmin(s->acc, part_of(bend * share * lim.acc, slope * a->ext_offset_acc_limit));
            if (lim.jerk > 0.0)
                s->jerk = fmin(s->jerk, part_of((bend < 1.0 ? JERK_PART : 1.0) * share * lim.jerk,
                                                slope * a->jerk_limit * a->ext_offset_acc_limit /
                                                    (a->acc_limit + a->ext_offset_acc_limit)));
        }
    }
    return 0;
}

/* Largest s <= 1 with s (s curve + cross) <= limit. */
static double curved_part(double limit, double curve, double cross)
{
    if (curve + cross <= limit)
        return 1.0;
    return 2.0 * limit / (cross + sqrt(cross * cross + 4.0 * curve * limit));
}

/* Part of all speeds that the joints' accelerations by curvature allow; 1 where there is none. */
static double curved_speed(struct motion *m, const struct moving *w, const double *q)
{
    const double h = STEP_S;
    double up[EMCMOT_MAX_JOINTS], down[EMCMOT_MAX_JOINTS], c[4][EMCMOT_MAX_JOINTS], part = 1.0;
    if (joints_after(m, w, 0.0, h, up) != 0 || joints_after(m, w, 0.0, -h, down) != 0)
        return part;
    for (int i = 0; i < 4; i++)
        if (joints_after(m, w, i & 1 ? h : -h, i & 2 ? h : -h, c[i]) != 0)
            return part;
    for (int j = 0; j < kin_joints(m); j++) {
        double curve = fabs(up[j] - 2.0 * q[j] + down[j]) / (h * h);
        double cross = fabs(c[3][j] - c[2][j] - c[1][j] + c[0][j]) / (2.0 * h * h);
        double limit = HALF * m->offset_share[j] * joint_motion_limits(&m->joint[j]).acc;
        if (limit > 0.0)
            part = fmin(part, curved_part(limit, curve, cross));
    }
    return part;
}

/* 1: q is farther outside the limits of the joints than they are now. */
static int farther_out(const struct motion *m, const double *q)
{
    return joints_go_outside(m, q, MOVES);
}

/* 1: a step farther along an offset's way from there is out of the kinematics' reach. */
static int at_end_of_reach(struct motion *m, const EmcPose *there)
{
    double q[EMCMOT_MAX_JOINTS];
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        const simple_tp_t *e = &m->axis[n].ext_offset_tp;
        double way = e->curr_vel != 0.0 ? e->curr_vel : e->enable ? e->pos_cmd - e->curr_pos : 0.0;
        EmcPose at = *there;
        if (!axis_takes_offsets(&m->axis[n]) || fabs(way) < MOVES)
            continue;
        *emcPoseAxis(&at, n) += copysign(STEP_UNITS, way);
        if (joints_at(m, &at, q) != 0)
            return 1;
    }
    return 0;
}

int offset_share_leaves(struct motion *m, const EmcPose *pose)
{
    EmcPose at = *pose;
    double q[EMCMOT_MAX_JOINTS], times[SIMPLE_TP_PHASES], T = m->traj_period, time = 0.0;
    int places = m->kin_type == KINEMATICS_IDENTITY ? 1 : STOP_PLACES;
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        simple_tp_stop_times(&m->axis[n].ext_offset_tp, T, times);
        time = fmax(time, times[SIMPLE_TP_PHASES - 1]);
    }
    for (int i = places > 1 ? 0 : 1; i <= places; i++) { /* offsets that stop at different times go a bent way */
        at = *pose;
        for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
            const simple_tp_t *e = &m->axis[n].ext_offset_tp;
            *emcPoseAxis(&at, n) += e->curr_pos + simple_tp_stop_way(e, T, i * time / places);
        }
        if (joints_at(m, &at, q) != 0 || farther_out(m, q))
            return 1;
    }
    return places > 1 && at_end_of_reach(m, &at);
}

void offset_share_scale(struct motion *m, const EmcPose *path)
{
    struct moving w;
    double T = m->traj_period, q[EMCMOT_MAX_JOINTS], speed = 1.0;
    int any = 0;
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        const simple_tp_t *e = &m->axis[n].ext_offset_tp;
        int moves = axis_takes_offsets(&m->axis[n]) && (e->curr_vel != 0.0 || (e->enable && e->pos_cmd != e->curr_pos));
        w.path[n] = (emcPoseGetAxis(path, n) - emcPoseGetAxis(&m->path_was, n)) / T;
        w.offset[n] = !moves
                          ? 0.0
                          : copysign(m->axis[n].ext_offset_vel_limit,
                                     e->curr_vel != 0.0 ? e->curr_vel : e->pos_cmd - e->curr_pos);
        w.part[n] = (struct teleop_scale){1.0, 1.0, 1.0, 0};
        any |= moves;
    }
    for (int i = 0; any && i < PLACES; i++) {
        w.at = *path;
        for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
            const simple_tp_t *e = &m->axis[n].ext_offset_tp;
            *emcPoseAxis(&w.at, n) += e->curr_pos + i * (AHEAD * simple_tp_stop_distance(e, T) +
                                                         CYCLES * e->curr_vel * T);
        }
        if (joints_at(m, &w.at, q) != 0 || straight_parts(m, &w, q) != 0 ||
            (i > 0 && farther_out(m, q))) { /* stop before */
            speed = i > 0 ? 0.0 : speed;
            break;
        }
        if (m->kin_type != KINEMATICS_IDENTITY)
            speed = fmin(speed, curved_speed(m, &w, q));
    }
    for (int n = 0; n < EMCMOT_MAX_AXIS; n++) {
        struct axis *a = &m->axis[n];
        const simple_tp_t *e = &a->ext_offset_tp;
        double acc = a->offset_part.acc, jerk = a->offset_part.jerk;
        a->offset_part = w.part[n];
        a->offset_part.vel *= speed;
        if ((e->curr_vel != 0.0 || e->curr_acc != 0.0) && acc > 0.0) { /* a stop under way keeps its brake */
            a->offset_part.acc = acc;
            a->offset_part.jerk = jerk;
        }
    }
}
