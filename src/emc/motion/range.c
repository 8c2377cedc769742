/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * range.c - may a move go where it is programmed to go?
 *
 * In:     points of the move, axis and joint limits, kinematics    Out: messages
 * Thread: servo; an arc is looked at in at most 2 * (6 + ARC_PLACES) + 1 points,
 *         a line in 2 * LINE_PLACES + 2
 */
#include <float.h>
#include <math.h>
#include "motion_priv.h"
#include "../tp/path.h"

#define POSITION_EPSILON 1e-12 /* units: rounding of sums of offsets */
#define UNCONFIGURED 1e-308    /* an axis whose limits are both below has none */
#define LINE_PLACES 12         /* of a line where joints bend */
#define BULGE 1e-6             /* units: less is rounding */
#define ARC_PLACES 4           /* of a turn, beside the extremes of x, y and z: for the joints */

int in_range(struct motion *m, const EmcPose *pos, int id, const char *kind)
{
    double joint[EMCMOT_MAX_JOINTS];
    int ok = 1;
    for (int a = 0; a < EMCMOT_MAX_AXIS; a++) {
        double p = emcPoseGetAxis(pos, a), lo = m->axis[a].min_pos_limit, hi = m->axis[a].max_pos_limit;
        if (fabs(p) < UNCONFIGURED && fabs(lo) < UNCONFIGURED && fabs(hi) < UNCONFIGURED)
            continue;
        if (!(p <= hi + POSITION_EPSILON)) {
            report_error("%s move on line %d would exceed %c's %s limit", kind, id, "XYZABCUVW"[a], "positive");
            ok = 0;
        }
        if (!(p >= lo - POSITION_EPSILON)) {
            report_error("%s move on line %d would exceed %c's %s limit", kind, id, "XYZABCUVW"[a], "negative");
            ok = 0;
        }
    }
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
        joint[j] = m->joint[j].pos_cmd;
    if (kinematics_inverse(m, pos, joint) != 0) {
        report_error("%s move on line %d fails kinematicsInverse", kind, id);
        return 0;
    }
    for (int j = 0; j < kin_joints(m); j++) {
        const emcmot_joint_t *jt = &m->joint[j];
        if (!is_active(jt))
            continue;
        if (!isfinite(joint[j])) {
            report_error("%s move on line %d gave non-finite joint location on joint %d", kind, id, j);
            ok = 0;
            continue;
        }
        /* one rounding unit of the limit: sums of offsets end there (FP-070) */
        if (joint[j] > jt->max_pos_limit + 4.0 * DBL_EPSILON * fabs(jt->max_pos_limit)) {
            report_error("%s move on line %d would exceed joint %d's positive limit max:[%f]", kind, id, j,
                         jt->max_pos_limit);
            ok = 0;
        }
        if (joint[j] < jt->min_pos_limit - 4.0 * DBL_EPSILON * fabs(jt->min_pos_limit)) {
            report_error("%s move on line %d would exceed joint %d's negative limit min:[%f]", kind, id, j,
                         jt->min_pos_limit);
            ok = 0;
        }
    }
    return ok;
}

/* Is the arc within the limits at t (0..1)? */
static int arc_point_in_range(struct motion *m, const struct path_prim *arc, double t, int id)
{
    double p[PATH_AXES];
    EmcPose pose;
    path_at(arc, t * arc->len, p);
    for (int a = 0; a < EMCMOT_MAX_AXIS; a++)
        *emcPoseAxis(&pose, a) = p[a];
    return in_range(m, &pose, id, "Circular");
}

/* The first turn and the last, which are the outermost of a helix or spiral. */
static int arc_bulges_in_range(struct motion *m, const struct path_prim *arc, int id)
{
    double turn = 2.0 * PM_PI, angle[2 * 3 + ARC_PLACES];
    int n = 0;
    for (int i = 0; i < 3; i++) {
        double at = atan2(arc->ey[i], arc->ex[i]);
        angle[n++] = at < 0.0 ? at + turn : at;
        angle[n++] = at + 0.5 * turn < turn ? at + 0.5 * turn : at - 0.5 * turn;
    }
    for (int i = 0; i < ARC_PLACES; i++)
        angle[n++] = turn * (i + 0.5) / ARC_PLACES;
    double last = turn * floor(arc->angle / turn);
    for (int i = 0; i < n; i++) {
        if (angle[i] < 0.0)
            angle[i] += turn;
        if (angle[i] < arc->angle && !arc_point_in_range(m, arc, angle[i] / arc->angle, id))
            return 0;
        double late = angle[i] + (angle[i] + last < arc->angle ? last : last - turn);
        if (late > turn && !arc_point_in_range(m, arc, late / arc->angle, id))
            return 0;
    }
    return 1;
}

int arc_in_range(struct motion *m, const emcmot_command_t *c)
{
    struct path_prim arc;
    EmcPose from = m->queue_end;
    double start[PATH_AXES], end[PATH_AXES];
    double center[3] = {c->center.x, c->center.y, c->center.z}, normal[3] = {c->normal.x, c->normal.y, c->normal.z};
    if (!in_range(m, &c->pos, c->id, "Circular"))
        return 0;
    if (tpQueueDepth(&m->tp) == 0)
        tpGetPos(&m->tp, &from);
    for (int a = 0; a < EMCMOT_MAX_AXIS; a++) {
        start[a] = emcPoseGetAxis(&from, a);
        end[a] = emcPoseGetAxis(&c->pos, a);
    }
    if (path_arc(&arc, start, end, center, normal, c->turn) != PATH_OK)
        return 1; /* the planner says what is wrong with it */
    return arc_bulges_in_range(m, &arc, c->id);
}

/* How far joints are outside their limits at a place; -1: out of reach, which the planner sees to. */
static double outside_at(struct motion *m, const EmcPose *pose)
{
    double q[EMCMOT_MAX_JOINTS];
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
        q[j] = m->joint[j].pos_cmd;
    return kinematics_inverse(m, pose, q) != 0 ? -1.0 : joints_outside(m, q);
}

int line_in_range(struct motion *m, const emcmot_command_t *c, const char *kind)
{
    EmcPose from = m->queue_end, at = c->pos;
    if (!in_range(m, &c->pos, c->id, kind))
        return 0;
    if (m->kin_type == KINEMATICS_IDENTITY) /* joints go straight as well */
        return 1;
    if (tpQueueDepth(&m->tp) == 0)
        tpGetPos(&m->tp, &from);
    double start = outside_at(m, &from);
    for (int i = 1; i < LINE_PLACES; i++) {
        for (int a = 0; a < EMCMOT_MAX_AXIS; a++)
            *emcPoseAxis(&at, a) = emcPoseGetAxis(&from, a) + (emcPoseGetAxis(&c->pos, a) - emcPoseGetAxis(&from, a)) * i / LINE_PLACES;
        /* a move from outside back inside is one */
        if (start >= 0.0 && outside_at(m, &at) > start + BULGE && !in_range(m, &at, c->id, kind))
            return 0;
    }
    return 1;
}
