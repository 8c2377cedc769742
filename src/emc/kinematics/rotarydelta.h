/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * rotarydelta.h - geometry of a rotary delta, for the module and for Python.
 *
 * Lengths in machine units, joints in degrees: 0 = thigh horizontal outward,
 * positive = knee down; z is negative. Joint 0 swings in the YZ plane. Context: [any].
 */
#ifndef KERF_ROTARYDELTA_H
#define KERF_ROTARYDELTA_H

#include <math.h>

#define ROTARYDELTA_PFR 10.0
#define ROTARYDELTA_TL 10.0
#define ROTARYDELTA_SL 14.0
#define ROTARYDELTA_FR 6.0
#define ROTARYDELTA_DEG (180.0 / 3.14159265358979323846)

struct rotarydelta {
    double pfr; /* platform radius: hip axes from the centre */
    double tl;  /* thigh */
    double sl;  /* shin */
    double fr;  /* foot radius */
};

static inline int rotarydelta_forward(const struct rotarydelta *g, const double *joint, double *xyz)
{
    double r[3], y[3], x[3], z[3];
    for (int i = 0; i < 3; i++) {
        r[i] = g->pfr - g->fr + g->tl * cos(joint[i] / ROTARYDELTA_DEG);
        z[i] = -g->tl * sin(joint[i] / ROTARYDELTA_DEG);
    }
    x[0] = 0.0;
    y[0] = -r[0];
    y[1] = r[1] / 2.0;
    x[1] = sqrt(3.0) * y[1];
    y[2] = r[2] / 2.0;
    x[2] = -sqrt(3.0) * y[2];
    double den = x[2] * (y[1] - y[0]) - x[1] * (y[2] - y[0]);
    double w1 = y[0] * y[0] + z[0] * z[0];
    double w2 = x[1] * x[1] + y[1] * y[1] + z[1] * z[1], w3 = x[2] * x[2] + y[2] * y[2] + z[2] * z[2];
    double a1 = (z[1] - z[0]) * (y[2] - y[0]) - (z[2] - z[0]) * (y[1] - y[0]);
    double b1 = -((w2 - w1) * (y[2] - y[0]) - (w3 - w1) * (y[1] - y[0])) / 2.0;
    double a2 = -(z[1] - z[0]) * x[2] + (z[2] - z[0]) * x[1];
    double b2 = ((w2 - w1) * x[2] - (w3 - w1) * x[1]) / 2.0;
    double a = a1 * a1 + a2 * a2 + den * den;
    double b = 2.0 * (a1 * b1 + a2 * (b2 - y[0] * den) - z[0] * den * den);
    double c = (b2 - y[0] * den) * (b2 - y[0] * den) + b1 * b1 + den * den * (z[0] * z[0] - g->sl * g->sl);
    double disc = b * b - 4.0 * a * c;
    if (den == 0.0 || !(disc >= 0.0))
        return -1;
    xyz[2] = -0.5 * (b + sqrt(disc)) / a;
    xyz[0] = (a1 * xyz[2] + b1) / den;
    xyz[1] = (a2 * xyz[2] + b2) / den;
    return 0;
}

/* Angle of the thigh that swings in the YZ plane. */
static inline int rotarydelta_thigh(const struct rotarydelta *g, double x, double y, double z, double *deg)
{
    if (z == 0.0)
        return -1;
    double a = (x * x + (y - g->fr) * (y - g->fr) + z * z + g->tl * g->tl - g->sl * g->sl -
                g->pfr * g->pfr) /
               (2.0 * z);
    double b = (g->fr - g->pfr - y) / z;
    double d = g->tl * g->tl * (b * b + 1.0) - (a - b * g->pfr) * (a - b * g->pfr);
    if (!(d >= 0.0))
        return -1;
    double ky = (g->pfr + a * b + sqrt(d)) / (b * b + 1.0), kz = b * ky - a;
    *deg = atan2(kz, ky - g->pfr) * ROTARYDELTA_DEG;
    return 0;
}

static inline int rotarydelta_inverse(const struct rotarydelta *g, const double *xyz, double *joint)
{
    const double c = -0.5, s = sqrt(3.0) / 2.0; /* of 120 degrees */
    double x = xyz[0], y = xyz[1], z = xyz[2], q[3];
    if (rotarydelta_thigh(g, x, y, z, &q[0]) != 0 ||
        rotarydelta_thigh(g, x * c + y * s, y * c - x * s, z, &q[1]) != 0 ||
        rotarydelta_thigh(g, x * c - y * s, y * c + x * s, z, &q[2]) != 0)
        return -1;
    for (int i = 0; i < 3; i++)
        joint[i] = q[i];
    return 0;
}

#endif
