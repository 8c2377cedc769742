/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * kins_common.h - small pieces that kinematics modules share. Context: [servo] unless said.
 */
#ifndef KERF_KINS_COMMON_H
#define KERF_KINS_COMMON_H

#include <math.h>
#include "emcmotcfg.h"
#include "emcpose.h"
#include "hal.h"
#include "kinematics.h"
#include "rtapi.h"

#ifdef __cplusplus
extern "C" {
#endif

/* sin and cos of an angle in degrees; exact at multiples of 90. */
static inline void sincos_deg(double deg, double *s, double *c)
{
    double turns = deg / 90.0;
    if (turns == floor(turns) && fabs(turns) < 1e9) {
        int quarter = (int)fmod(turns, 4.0);
        if (quarter < 0)
            quarter += 4;
        *s = quarter == 1 ? 1.0 : quarter == 3 ? -1.0 : 0.0;
        *c = quarter == 0 ? 1.0 : quarter == 2 ? -1.0 : 0.0;
        return;
    }
    *s = sin(deg * TO_RAD);
    *c = cos(deg * TO_RAD);
}

/* The angle (degrees) plus the whole turns that bring it nearest to a seed. */
static inline double nearest_turn(double deg, double seed)
{
    return isfinite(deg) && isfinite(seed) ? deg + 360.0 * round((seed - deg) / 360.0) : deg;
}

/* Joints 3 to 8 are a b c u v w. */
static inline void rest_forward(const double *joint, EmcPose *p)
{
    p->a = joint[3];
    p->b = joint[4];
    p->c = joint[5];
    p->u = joint[6];
    p->v = joint[7];
    p->w = joint[8];
}
static inline void rest_inverse(const EmcPose *p, double *joint)
{
    joint[3] = p->a;
    joint[4] = p->b;
    joint[5] = p->c;
    joint[6] = p->u;
    joint[7] = p->v;
    joint[8] = p->w;
}

/* Rotation matrix of roll a, pitch b, yaw c (degrees): Rz(c) Ry(b) Rx(a). */
static inline void rotation_abc(double a, double b, double c, PmRotationMatrix *m)
{
    double sa, ca, sb, cb, sc, cc;
    sincos_deg(a, &sa, &ca);
    sincos_deg(b, &sb, &cb);
    sincos_deg(c, &sc, &cc);
    m->x.x = cb * cc;
    m->x.y = cb * sc;
    m->x.z = -sb;
    m->y.x = sa * sb * cc - ca * sc;
    m->y.y = sa * sb * sc + ca * cc;
    m->y.z = sa * cb;
    m->z.x = ca * sb * cc + sa * sc;
    m->z.y = ca * sb * sc - sa * cc;
    m->z.z = ca * cb;
}

/* kins_solve.cc: x of A x = b, A n by n by rows, n <= 9. Returns 0, or -1 when A is
 * singular (reciprocal of the condition below 1e-10). No allocation. */
int kins_solve(int n, const double *a, const double *b, double *x);
/* Least-squares solution of a rows x cols system, rows, cols <= 9. Returns 0, -1. */
int kins_least_squares(int rows, int cols, const double *a, const double *b, double *x);

#ifdef __cplusplus
}
#endif
#endif
