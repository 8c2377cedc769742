/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * path.c - lines, arcs, helices, spirals and the rounding kernel. See path.h.
 */
#include "path.h"

#include <math.h>
#include <string.h>

#define TWO_PI 6.28318530717958647692

static double dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross3(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static const int group_first[3] = { PATH_X, PATH_U, PATH_A }; /* by enum path_metric */

double path_group_norm(const double v[PATH_AXES], enum path_metric group)
{
    const double *g = v + group_first[group];
    return sqrt(dot3(g, g));
}

double path_max_norm(const double v[PATH_AXES])
{
    double xyz = path_group_norm(v, PATH_XYZ);
    double abc = path_group_norm(v, PATH_ABC);
    double uvw = path_group_norm(v, PATH_UVW);
    return fmax(xyz, fmax(abc, uvw));
}

static int group_moves(const double d[PATH_AXES], enum path_metric group)
{
    const double *g = d + group_first[group];
    return fmax(fabs(g[0]), fmax(fabs(g[1]), fabs(g[2]))) >= PATH_TINY;
}

enum path_result path_line(struct path_prim *prim, const double start[PATH_AXES], const double end[PATH_AXES])
{
    double d[PATH_AXES], sum = 0;

    memset(prim, 0, sizeof *prim);
    for (int i = 0; i < PATH_AXES; i++) {
        d[i] = end[i] - start[i];
        sum += d[i] * d[i];
    }
    if (group_moves(d, PATH_XYZ)) prim->metric = PATH_XYZ;
    else if (group_moves(d, PATH_UVW)) prim->metric = PATH_UVW;
    else if (group_moves(d, PATH_ABC)) prim->metric = PATH_ABC;
    else return PATH_ZERO_LENGTH;
    prim->kind = PATH_LINE;
    prim->len = sqrt(sum);
    prim->feed_len = path_group_norm(d, prim->metric);
    memcpy(prim->start, start, sizeof prim->start);
    memcpy(prim->end, end, sizeof prim->end);
    for (int i = 0; i < PATH_AXES; i++) prim->u[i] = d[i] / prim->len;
    return PATH_OK;
}

enum path_result path_arc(struct path_prim *prim, const double start[PATH_AXES], const double end[PATH_AXES],
                          const double center[3], const double normal[3], int turn)
{
    double n[3], to_start[3], to_end[3], out[3], planar = 0, sum = 0;
    double norm = sqrt(dot3(normal, normal));

    memset(prim, 0, sizeof *prim);
    if (!(norm > 1e-12)) return PATH_BAD_NORMAL;
    for (int i = 0; i < 3; i++) n[i] = normal[i] / norm * (turn < 0 ? -1 : 1);
    if (turn < 0) turn = -1 - turn;

    for (int i = 0; i < 3; i++) to_start[i] = start[i] - center[i];
    double lift = dot3(to_start, n); /* the centre is moved into the plane of the start */
    for (int i = 0; i < 3; i++) {
        prim->center[i] = center[i] + n[i] * lift;
        to_start[i] = start[i] - prim->center[i];
        to_end[i] = end[i] - prim->center[i];
    }
    prim->radius = sqrt(dot3(to_start, to_start));
    if (!(prim->radius > PATH_MIN_RADIUS)) return PATH_BAD_RADIUS;
    double rise = dot3(to_end, n);
    for (int i = 0; i < 3; i++) {
        prim->helix[i] = n[i] * rise;
        out[i] = to_end[i] - prim->helix[i];
        planar += (out[i] - to_start[i]) * (out[i] - to_start[i]);
        prim->ex[i] = to_start[i] / prim->radius;
    }
    cross3(n, prim->ex, prim->ey);
    double end_radius = sqrt(dot3(out, out));
    if (!(end_radius > PATH_MIN_RADIUS)) return PATH_BAD_RADIUS;
    prim->spiral = end_radius - prim->radius;
    if (sqrt(planar) < PATH_TINY) {
        prim->angle = TWO_PI;
    } else {
        prim->angle = atan2(dot3(out, prim->ey), dot3(out, prim->ex));
        if (prim->angle <= 0) prim->angle += TWO_PI;
    }
    prim->angle += TWO_PI * turn;

    /* Length of the planar curve: exact for a circle, mean radius and drift for a spiral. */
    double mean = prim->radius + prim->spiral / 2;
    double arc = sqrt(mean * mean * prim->angle * prim->angle + prim->spiral * prim->spiral);
    double arc_len = sqrt(arc * arc + rise * rise);
    sum = arc_len * arc_len;
    for (int i = 3; i < PATH_AXES; i++) sum += (end[i] - start[i]) * (end[i] - start[i]);
    prim->kind = PATH_ARC;
    prim->metric = PATH_XYZ;
    prim->len = sqrt(sum);
    prim->feed_len = arc_len;
    if (arc_len < PATH_TINY) return PATH_ZERO_LENGTH;
    memcpy(prim->start, start, sizeof prim->start);
    memcpy(prim->end, end, sizeof prim->end);
    for (int i = 3; i < PATH_AXES; i++) prim->u[i] = (end[i] - start[i]) / prim->len;
    double rate = prim->angle / prim->len; /* |d2p/ds2| is about r rate^2 */
    prim->min_radius = 1 / (fmax(prim->radius, end_radius) * rate * rate);
    return PATH_OK;
}

void path_jet_at(const struct path_prim *prim, double s, struct path_jet *jet)
{
    if (s < 0) s = 0;
    if (s > prim->len) s = prim->len;
    for (int i = 0; i < PATH_AXES; i++) {
        jet->p[i] = prim->start[i] + prim->u[i] * s;
        jet->d1[i] = prim->u[i];
        jet->d2[i] = 0;
        jet->d3[i] = 0;
    }
    if (prim->kind == PATH_LINE) return;

    double t = s / prim->len;
    double w = prim->angle / prim->len;  /* d theta / ds */
    double rs = prim->spiral / prim->len; /* d r / ds */
    double r = prim->radius + prim->spiral * t;
    double c = cos(prim->angle * t), sn = sin(prim->angle * t);
    for (int i = 0; i < 3; i++) {
        double er = prim->ex[i] * c + prim->ey[i] * sn;
        double et = prim->ey[i] * c - prim->ex[i] * sn;
        jet->p[i] = prim->center[i] + r * er + prim->helix[i] * t;
        jet->d1[i] = rs * er + r * w * et + prim->helix[i] / prim->len;
        jet->d2[i] = 2 * rs * w * et - r * w * w * er;
        jet->d3[i] = -3 * rs * w * w * er - r * w * w * w * et;
    }
}

void path_at(const struct path_prim *prim, double s, double p[PATH_AXES])
{
    if (s <= 0) {
        memcpy(p, prim->start, sizeof prim->start);
        return;
    }
    if (s >= prim->len) {
        memcpy(p, prim->end, sizeof prim->end);
        return;
    }
    for (int i = 0; i < PATH_AXES; i++) p[i] = prim->start[i] + prim->u[i] * s;
    if (prim->kind == PATH_LINE) return;
    double t = s / prim->len, r = prim->radius + prim->spiral * t;
    double c = r * cos(prim->angle * t), sn = r * sin(prim->angle * t);
    for (int i = 0; i < 3; i++) p[i] = prim->center[i] + prim->ex[i] * c + prim->ey[i] * sn + prim->helix[i] * t;
}

/* E(y) = (1-y)^3 (3+y) / 16 of y = |x|: the second integral of 3/4 (1 - x^2). */
void path_round(double x, int side, double k[4])
{
    double y = fabs(x), m = 1 - y, sign = x > 0 || (x == 0 && side > 0) ? 1 : -1;

    if (m < 0) m = 0;
    k[0] = m * m * m * (3 + y) / 16;
    k[1] = -sign * m * m * (2 + y) / 4;
    k[2] = PATH_ROUND_CURVE * m * (1 + y);
    k[3] = m > 0 ? -1.5 * x : 0;
}

/* e'' is piecewise linear in y = |x|: -1/2 at 0, 9/56 at 3/4, 0 at 1. These make e, e' and e'' vanish at 1
 * with the least slope of curvature (37/42, 9/14) that corners at quarters of the width allow. */
void path_bend(double x, int side, double k[4])
{
    double y = fabs(x), m = 1 - y, sign = x > 0 || (x == 0 && side > 0) ? 1 : -1;

    if (m < 0) {
        k[0] = k[1] = k[2] = k[3] = 0;
    } else if (y < 0.75) {
        k[0] = sign * y * (3.0 / 28 + y * (-0.25 + y * (37.0 / 252)));
        k[1] = 3.0 / 28 + y * (-0.5 + y * (37.0 / 84));
        k[2] = sign * (-0.5 + y * (37.0 / 42));
        k[3] = 37.0 / 42;
    } else {
        k[0] = sign * (3.0 / 28) * m * m * m;
        k[1] = -(9.0 / 28) * m * m;
        k[2] = sign * (9.0 / 14) * m;
        k[3] = -9.0 / 14;
    }
}
