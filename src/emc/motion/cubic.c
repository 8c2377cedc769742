/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * cubic.c - cubic interpolation of one joint.   In, out: cubic.h   Thread: servo
 */
#include <math.h>
#include "cubic.h"

void cubic_init(cubic_t *ci, double segment_s, int rate)
{
    ci->segment_s = segment_s;
    ci->step_s = segment_s / rate;
    cubic_drain(ci);
}

void cubic_drain(cubic_t *ci)
{
    ci->filled = 0;
    ci->need_next = 1;
    ci->t = 0.0;
    ci->x[0] = ci->x[1] = ci->x[2] = ci->x[3] = 0.0;
    ci->a = ci->b = ci->c = ci->d = 0.0;
}

void cubic_add_point(cubic_t *ci, double point)
{
    double *x = ci->x, T = ci->segment_s;
    if (!ci->filled) {
        x[0] = x[1] = x[2] = x[3] = point;
        ci->filled = 1;
    } else {
        x[0] = x[1];
        x[1] = x[2];
        x[2] = x[3];
        x[3] = point;
    }
    double p0 = (x[0] + 4.0 * x[1] + x[2]) / 6.0, p1 = (x[1] + 4.0 * x[2] + x[3]) / 6.0;
    double v0 = (x[2] - x[0]) / (2.0 * T), v1 = (x[3] - x[1]) / (2.0 * T);
    ci->d = p0;
    ci->c = v0;
    ci->b = 3.0 * (p1 - p0) / (T * T) - (2.0 * v0 + v1) / T;
    ci->a = (v1 - v0) / (3.0 * T * T) - 2.0 * ci->b / (3.0 * T);
    ci->t = 0.0;
    ci->need_next = 0;
}

double cubic_interpolate(cubic_t *ci, double *vel, double *acc, double *jerk)
{
    double t = ci->t, a = ci->a, b = ci->b, c = ci->c, d = ci->d;
    if (vel)
        *vel = (3.0 * a * t + 2.0 * b) * t + c;
    if (acc)
        *acc = 6.0 * a * t + 2.0 * b;
    if (jerk)
        *jerk = 6.0 * a;
    ci->t = t + ci->step_s;
    ci->need_next = fabs(ci->segment_s - ci->t) < 0.5 * ci->step_s;
    return ((a * t + b) * t + c) * t + d;
}

int cubic_at_rest(const cubic_t *ci)
{
    return ci->x[0] == ci->x[1] && ci->x[1] == ci->x[2] && ci->x[2] == ci->x[3];
}
