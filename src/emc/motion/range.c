/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * range.c - may a move go where it is programmed to go?
 *
 * In:     points of the move, axis and joint limits, kinematics    Out: messages
 * Thread: servo; a move is looked at in at most MAX_PLACES + REFINED_PLACES + 2 places,
 *         an arc beside that in at most 4 * (6 + ARC_PLACES)
 */
#include <float.h>
#include <math.h>
#include "motion_priv.h"
#include "../tp/path.h"

#define POSITION_EPSILON 1e-12 /* units: rounding of sums of offsets */
#define UNCONFIGURED 1e-308    /* an axis whose limits are both below has none */
#define LINE_PLACES 12         /* of a line where joints bend, and of each turn of an arc */
#define MAX_PLACES 48
#define REFINED_PLACES 14      /* more of them where a joint comes near its limit */
#define REFINED_DEPTH 4
#define BULGE 1e-6             /* units: less is rounding */
#define ARC_PLACES 4           /* of a turn, beside the extremes of x, y and z */
#define SPIRAL_STEPS 6         /* of the search for an extreme of a spiral */

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

/* The angle near `angle` at which coordinate i of a helix or spiral turns round;
 * side: 1 at its greatest, -1 at its least.
 * There the slope by the angle is 0: amplitude ((spiral / A) cos - r sin) + helix / A, from where
 * a circle turns round. */
static double turning_angle(const struct path_prim *arc, int i, double angle, int side)
{
    double amplitude = hypot(arc->ex[i], arc->ey[i]), phi = 0.0;
    for (int n = 0; amplitude > 0.0 && n < SPIRAL_STEPS; n++) {
        double r = arc->radius + arc->spiral * fmax(0.0, fmin(angle + phi, arc->angle)) / arc->angle;
        double slope = (arc->spiral * cos(phi) + side * arc->helix[i] / amplitude) / arc->angle;
        phi = r > 0.0 ? asin(fmax(-1.0, fmin(slope / r, 1.0))) : 0.0;
    }
    return angle + phi;
}

/* The first turn and the last, which are the outermost of a helix or spiral. */
static int arc_bulges_in_range(struct motion *m, const struct path_prim *arc, int id)
{
    double turn = 2.0 * PM_PI, last = floor(arc->angle / turn);
    const double turns[] = {0.0, 1.0, last - 1.0, last, last + 1.0}; /* angles begin between -pi and pi */
    for (int n = 0; n < 6 + ARC_PLACES; n++) {
        int side = n < 3 ? 1 : -1, axis = n < 6 ? n % 3 : -1;
        double angle = axis < 0 ? turn * (n - 6 + 0.5) / ARC_PLACES
                                : atan2(side * arc->ey[axis], side * arc->ex[axis]);
        for (unsigned k = 0; k < sizeof turns / sizeof *turns; k++) {
            double at = angle + turns[k] * turn;
            if (k >= 2 && turns[k] < 2.0)
                continue; /* looked at already */
            if (axis >= 0)
                at = turning_angle(arc, axis, at, side);
            if (at > 0.0 && at < arc->angle && !arc_point_in_range(m, arc, at / arc->angle, id))
                return 0;
        }
    }
    return 1;
}

/* ---- the way between, where joints do not go straight ---- */

/* A move as a curve over t from 0 to 1. */
struct way {
    EmcPose from, to;
    const struct path_prim *arc; /* null: a line */
    int places;                  /* where it is looked at, before any refinement */
};

struct place {
    double t, q[EMCMOT_MAX_JOINTS];
    int reached; /* else out of the kinematics' reach, which the planner sees to */
};

static void pose_at(const struct way *w, double t, EmcPose *pose)
{
    double p[PATH_AXES];
    if (w->arc)
        path_at(w->arc, t * w->arc->len, p);
    for (int a = 0; a < EMCMOT_MAX_AXIS; a++) {
        double from = emcPoseGetAxis(&w->from, a);
        *emcPoseAxis(pose, a) = w->arc ? p[a] : from + t * (emcPoseGetAxis(&w->to, a) - from);
    }
}

/* The joints at t, sought from those of a place nearby. */
static void look(struct motion *m, const struct way *w, double t, const struct place *near, struct place *at)
{
    EmcPose pose;
    pose_at(w, t, &pose);
    *at = *near;
    at->t = t;
    at->reached = kinematics_inverse(m, &pose, at->q) == 0;
}

/* How far the joints are outside, all together. */
static double outside(const struct motion *m, const struct place *at)
{
    double sum = 0.0;
    for (int j = 0; at->reached && j < kin_joints(m); j++) {
        const emcmot_joint_t *jt = &m->joint[j];
        if (is_active(jt))
            sum += fmax(0.0, at->q[j] - jt->max_pos_limit) + fmax(0.0, jt->min_pos_limit - at->q[j]);
    }
    return sum;
}

static int is_outside(const struct motion *m, const struct place *at, double allowed)
{
    return outside(m, at) > allowed + BULGE;
}

/* May a joint leave its range between two places, where it strays from the chord by up to bend? */
static int may_leave(const struct motion *m, const struct place *a, const struct place *b,
                     const double *bend, double allowed)
{
    for (int j = 0; j < kin_joints(m); j++) {
        const emcmot_joint_t *jt = &m->joint[j];
        if (is_active(jt) && (fmax(a->q[j], b->q[j]) + bend[j] > jt->max_pos_limit + allowed ||
                              fmin(a->q[j], b->q[j]) - bend[j] < jt->min_pos_limit - allowed))
            return 1;
    }
    return 0;
}

/* Twice what a parabola through three places, the middle one halfway, strays from the chord of one half. */
static void find_bend(const struct motion *m, const struct place *a, const struct place *mid,
                      const struct place *b, double *bend)
{
    for (int j = 0; j < kin_joints(m); j++)
        bend[j] = fabs(a->q[j] - 2.0 * mid->q[j] + b->q[j]) / 4.0;
}

/* Halves an interval as long as it may leave; 0 when it does, at *bad. *left places may still be looked at. */
static int refine(struct motion *m, const struct way *w, const struct place *a,
                  const struct place *b, const double *bend, double allowed, int depth, int *left,
                  double *bad)
{
    struct place mid;
    double finer[EMCMOT_MAX_JOINTS];
    if (depth == 0 || *left == 0 || !a->reached || !b->reached || !may_leave(m, a, b, bend, allowed))
        return 1;
    --*left;
    look(m, w, 0.5 * (a->t + b->t), a, &mid);
    *bad = mid.t;
    if (is_outside(m, &mid, allowed))
        return 0;
    find_bend(m, a, &mid, b, finer);
    return refine(m, w, a, &mid, finer, allowed, depth - 1, left, bad) &&
           refine(m, w, &mid, b, finer, allowed, depth - 1, left, bad);
}

/* Are the joints inside all along? A way from outside back inside is one. 0: *bad is where not. */
static int way_stays_inside(struct motion *m, const struct way *w, double *bad)
{
    struct place at[3]; /* the last three */
    double bend[EMCMOT_MAX_JOINTS];
    int left = REFINED_PLACES;
    for (int j = 0; j < EMCMOT_MAX_JOINTS; j++)
        at[0].q[j] = m->joint[j].pos_cmd;
    look(m, w, 0.0, &at[0], &at[1]);
    if (!at[1].reached)
        return 1;
    double allowed = outside(m, &at[1]);
    for (int i = 1; i <= w->places; i++) {
        look(m, w, (double)i / w->places, &at[1], &at[2]);
        *bad = at[2].t;
        if (is_outside(m, &at[2], allowed))
            return 0;
        if (i > 1) {
            find_bend(m, &at[0], &at[1], &at[2], bend);
            if (!refine(m, w, &at[0], &at[1], bend, allowed, REFINED_DEPTH, &left, bad) ||
                !refine(m, w, &at[1], &at[2], bend, allowed, REFINED_DEPTH, &left, bad))
                return 0;
        }
        at[0] = at[1];
        at[1] = at[2];
    }
    return 1;
}

static int way_in_range(struct motion *m, const struct way *w, int id, const char *kind)
{
    double bad;
    EmcPose pose;
    if (m->kin_type == KINEMATICS_IDENTITY || way_stays_inside(m, w, &bad)) /* joints go straight as well */
        return 1;
    pose_at(w, bad, &pose);
    return in_range(m, &pose, id, kind);
}

static void find_start(struct motion *m, EmcPose *from)
{
    *from = m->queue_end;
    if (tpQueueDepth(&m->tp) == 0)
        tpGetPos(&m->tp, from);
}

int arc_in_range(struct motion *m, const emcmot_command_t *c)
{
    struct path_prim arc;
    struct way w = {.to = c->pos, .arc = &arc};
    double start[PATH_AXES], end[PATH_AXES];
    double center[3] = {c->center.x, c->center.y, c->center.z}, normal[3] = {c->normal.x, c->normal.y, c->normal.z};
    if (!in_range(m, &c->pos, c->id, "Circular"))
        return 0;
    find_start(m, &w.from);
    for (int a = 0; a < EMCMOT_MAX_AXIS; a++) {
        start[a] = emcPoseGetAxis(&w.from, a);
        end[a] = emcPoseGetAxis(&c->pos, a);
    }
    if (path_arc(&arc, start, end, center, normal, c->turn) != PATH_OK)
        return 1; /* the planner says what is wrong with it */
    w.places = (int)fmin(MAX_PLACES, LINE_PLACES * ceil(arc.angle / (2.0 * PM_PI)));
    return arc_bulges_in_range(m, &arc, c->id) && way_in_range(m, &w, c->id, "Circular");
}

int line_in_range(struct motion *m, const emcmot_command_t *c, const char *kind)
{
    struct way w = {.to = c->pos, .places = LINE_PLACES};
    if (!in_range(m, &c->pos, c->id, kind))
        return 0;
    find_start(m, &w.from);
    return way_in_range(m, &w, c->id, kind);
}
