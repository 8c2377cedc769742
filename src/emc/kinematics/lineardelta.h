/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * lineardelta.h - geometry of a linear delta, for the module and for Python.
 *
 * Lengths in machine units. Context: [any].
 */
#ifndef KERF_LINEARDELTA_H
#define KERF_LINEARDELTA_H

#include <math.h>

#define LINEARDELTA_R (198.25 - 33.0 - 35.0)
#define LINEARDELTA_L 269.0

struct lineardelta {
    double R; /* towers from the axis, less the effector's offset */
    double L; /* rods */
};

static inline void lineardelta_tower(const struct lineardelta *g, int i, double *x, double *y)
{
    *x = i == 0 ? 0.0 : i == 1 ? -g->R * sqrt(3.0) / 2.0 : g->R * sqrt(3.0) / 2.0;
    *y = i == 0 ? g->R : -g->R / 2.0;
}

/* xyz to three carriage heights. 0, or -1 out of reach. */
static inline int lineardelta_inverse(const struct lineardelta *g, const double *xyz, double *joint)
{
    double q[3];
    for (int i = 0; i < 3; i++) {
        double tx, ty, square;
        lineardelta_tower(g, i, &tx, &ty);
        square = g->L * g->L - (tx - xyz[0]) * (tx - xyz[0]) - (ty - xyz[1]) * (ty - xyz[1]);
        if (!(square >= 0.0))
            return -1;
        q[i] = xyz[2] + sqrt(square);
    }
    for (int i = 0; i < 3; i++)
        joint[i] = q[i];
    return 0;
}

/* Three carriage heights to xyz: the lower point at distance L from all. 0, or -1. */
static inline int lineardelta_forward(const struct lineardelta *g, const double *q, double *xyz)
{
    double Ax, Ay, Bx, By, Cx, Cy;
    lineardelta_tower(g, 0, &Ax, &Ay);
    lineardelta_tower(g, 1, &Bx, &By);
    lineardelta_tower(g, 2, &Cx, &Cy);
    double den = (By - Ay) * Cx - (Cy - Ay) * Bx;
    double w1 = Ay * Ay + q[0] * q[0], w2 = Bx * Bx + By * By + q[1] * q[1], w3 = Cx * Cx + Cy * Cy + q[2] * q[2];
    double a1 = (q[1] - q[0]) * (Cy - Ay) - (q[2] - q[0]) * (By - Ay);
    double b1 = -((w2 - w1) * (Cy - Ay) - (w3 - w1) * (By - Ay)) / 2.0;
    double a2 = -(q[1] - q[0]) * Cx + (q[2] - q[0]) * Bx;
    double b2 = ((w2 - w1) * Cx - (w3 - w1) * Bx) / 2.0;
    double a = a1 * a1 + a2 * a2 + den * den;
    double b = 2.0 * (a1 * b1 + a2 * (b2 - Ay * den) - q[0] * den * den);
    double c = (b2 - Ay * den) * (b2 - Ay * den) + b1 * b1 + den * den * (q[0] * q[0] - g->L * g->L);
    double disc = b * b - 4.0 * a * c;
    if (den == 0.0 || !(disc >= 0.0))
        return -1;
    xyz[2] = -0.5 * (b + sqrt(disc)) / a;
    xyz[0] = (a1 * xyz[2] + b1) / den;
    xyz[1] = (a2 * xyz[2] + b2) / den;
    return 0;
}

#endif
