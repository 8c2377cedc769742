/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * limits.c - see limits.h; derivation in docs/planner.md.
 */
#include "limits.h"

#include <math.h>
#include <string.h>

#define STEP 0.25       /* units, deg: longest step of the difference formulas */
#define STEP_BEND 0.1   /* longest step as a share of the radius of curvature */
#define EDGE_TRIES 4    /* steps tried near the edge of what can be reached, ... */
#define EDGE_STEP 0.125 /* each so much of the one before */
#define JUMP 90.0       /* a joint that moves so much between two points has changed its solution */
#define SAME_PLACE 1e-3 /* joints of a path that begins where they are */
#define SAME 1e-7       /* of a joint's travel: agreement that makes a map linear */

static const double probe_at[][PATH_AXES] = {
    /* directions of all axes, far enough apart that turns and arms show */
    { 7, -4, 3, 11, -17, 23, 2, -3, 5 },
    { -5, 9, -6, -31, 13, 37, -4, 1, -2 },
    { 3, 2, 8, 47, 29, -41, 1, 6, -3 },
};

static double tighter(double a, double b)
{
    if (a <= 0) return b;
    return b > 0 && b < a ? b : a;
}

static void tighten(struct limits *lim, int axis, double scale, const struct limits_row *by)
{
    lim->v[axis] = tighter(lim->v[axis], by->v / scale);
    lim->a[axis] = tighter(lim->a[axis], by->a / scale);
    lim->j[axis] = tighter(lim->j[axis], by->j / scale);
}

/* The one axis that moves a joint of a linear map; -1: several. */
static int sole_axis(const double m[PATH_AXES])
{
    int axis = -1;
    for (int i = 0; i < PATH_AXES; i++) {
        if (m[i] == 0) continue;
        if (axis >= 0) return -1;
        axis = i;
    }
    return axis;
}

void limits_read(struct limits *lim, int jerk_on, double jerk)
{
    lim->jerk_on = jerk_on;
    if (!lim->source) return;
    for (int i = 0; i < PATH_AXES; i++) {
        double limit[3];
        lim->source->axis_limits(i, limit);
        lim->v[i] = limit[0], lim->a[i] = limit[1], lim->j[i] = tighter(limit[2], jerk);
        if (limit[2] <= 0) lim->j[i] = 0;
    }
    if (lim->kins == LIMITS_NONE) return;
    int used = 0;
    for (int n = 0; n < lim->joints; n++) {
        struct limits_row *row = &lim->row[n];
        double limit[3];
        lim->source->joint_limits(n, limit);
        row->v = limit[0], row->a = limit[1], row->j = limit[2];
        if (lim->kins == LIMITS_LINEAR) {
            int axis = sole_axis(row->m);
            if (axis >= 0) tighten(lim, axis, fabs(row->m[axis]), row);
            else used = n + 1;
        } else {
            used = n + 1;
        }
    }
    lim->rows = used;
}

static int solve(struct limits *lim, const double p[PATH_AXES], double q[LIMITS_JOINTS])
{
    if (lim->source->inverse(p, q) != 0) return -1;
    for (int n = 0; n < lim->joints; n++)
        if (!isfinite(q[n])) return -1;
    return 0;
}

void limits_probe(struct limits *lim, const double p[PATH_AXES])
{
    double here[LIMITS_JOINTS], q[LIMITS_JOINTS], at[PATH_AXES];

    lim->kins = LIMITS_NONE;
    lim->joints = lim->rows = 0;
    if (!lim->source || !lim->source->inverse) return;
    lim->joints = lim->source->joints();
    if (lim->joints > LIMITS_JOINTS) lim->joints = LIMITS_JOINTS;
    if (lim->joints <= 0) return;
    lim->source->seed(lim->seed);
    memcpy(here, lim->seed, sizeof here);
    if (solve(lim, p, here) != 0) return; /* no joints to speak of: motmod reports it when it goes there */
    memcpy(lim->seed, here, sizeof lim->seed);
    lim->kins = LIMITS_SAMPLED;
    for (int i = 0; i < PATH_AXES; i++) {
        memcpy(at, p, sizeof at);
        memcpy(q, here, sizeof q);
        at[i] += 1;
        if (solve(lim, at, q) != 0) return;
        for (int n = 0; n < lim->joints; n++) {
            double m = q[n] - here[n];
            lim->row[n].m[i] = fabs(m) < 1e-9 ? 0 : fabs(fabs(m) - 1) < 1e-9 ? round(m) : m;
        }
    }
    for (unsigned t = 0; t < sizeof probe_at / sizeof *probe_at; t++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            for (int i = 0; i < PATH_AXES; i++) at[i] = p[i] + sign * probe_at[t][i];
            memcpy(q, here, sizeof q);
            if (solve(lim, at, q) != 0) return;
            for (int n = 0; n < lim->joints; n++) {
                double want = here[n], size = 1;
                for (int i = 0; i < PATH_AXES; i++) {
                    want += sign * lim->row[n].m[i] * probe_at[t][i];
                    size += fabs(lim->row[n].m[i] * probe_at[t][i]);
                }
                if (fabs(q[n] - want) > SAME * size) return;
            }
        }
    }
    lim->kins = LIMITS_LINEAR;
}

/* Joints at the place of jet and at one and two steps h before and after it; side 1, -1: at four steps after or before
 * it. 0, -1: one is not reached, -2: nor is the middle one. */
static int sample_points(struct limits *lim, const struct path_jet *jet, double h, int side,
                         double q[LIMITS_POINTS][LIMITS_JOINTS])
{
    double p[PATH_AXES];

    for (int k = 0; k < LIMITS_POINTS; k++) {
        static const int order[LIMITS_POINTS] = { 2, 1, 3, 0, 4 }; /* the middle seeds the others */
        int at = order[k];
        double x = h * (at - 2 + 2 * side);
        for (int i = 0; i < PATH_AXES; i++)
            p[i] = jet->p[i] + x * (jet->d1[i] + x * (jet->d2[i] / 2 + x * jet->d3[i] / 6));
        memcpy(q[at], k ? q[2] : lim->seed, sizeof q[at]);
        if (solve(lim, p, q[at]) != 0) return k ? -1 : -2;
    }
    for (int k = 1; k < LIMITS_POINTS; k++)
        for (int n = 0; n < lim->joints; n++)
            if (fabs(q[k][n] - q[k - 1][n]) > JUMP) return -1;
    for (int n = 0; side && n < lim->joints; n++)
        if (fabs(q[2 - 2 * side][n] - lim->seed[n]) > (side > 0 ? SAME_PLACE : JUMP)) return -1;
    return 0;
}

int limits_sample(struct limits *lim, const struct path_jet *jet, struct limits_jet *out)
{
    double q[LIMITS_POINTS][LIMITS_JOINTS], d2 = 0, d3 = 0, h = STEP;
    int found = -1;

    for (int i = 0; i < PATH_AXES; i++) {
        d2 += jet->d2[i] * jet->d2[i];
        d3 += jet->d3[i] * jet->d3[i];
    }
    if (d2 > 0) h = fmin(h, STEP_BEND / sqrt(d2));
    if (d3 > 0) h = fmin(h, STEP_BEND / sqrt(sqrt(d3)));
    for (int n = 0; n < EDGE_TRIES && found == -1; n++, h *= found ? EDGE_STEP : 1)
        found = sample_points(lim, jet, h, 0, q);
    /* A path may begin or end in a singular place, where joints turn over: its own side is all there is. */
    for (int side = 1; side >= -1 && found == -1; side -= 2)
        found = sample_points(lim, jet, h, side, q);
    if (found) return -1;
    for (int n = 0; n < lim->joints; n++) {
        double a = q[0][n], b = q[1][n], c = q[2][n], d = q[3][n], e = q[4][n];
        out->d1[n] = (a - 8 * b + 8 * d - e) / (12 * h);
        out->d2[n] = (-a + 16 * b - 30 * c + 16 * d - e) / (12 * h * h);
        out->d3[n] = (-a + 2 * b - 2 * d + e) / (2 * h * h * h);
    }
    memcpy(lim->seed, q[2], sizeof lim->seed);
    return 0;
}
