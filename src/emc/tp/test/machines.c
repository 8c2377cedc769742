/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * machines.c - see machines.h.
 */
#include "machines.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* X by joint 0, Y by joints 1 and 2, Z by 3. */
static int gantry(const double p[AXES], double *q)
{
    q[0] = p[0], q[1] = q[2] = p[1], q[3] = p[2];
    return 0;
}

static int corexy(const double p[AXES], double *q)
{
    q[0] = p[0] + p[1], q[1] = p[0] - p[1], q[2] = p[2];
    return 0;
}

/* Three vertical rails on a circle of radius 130, rods of 269. */
static int delta(const double p[AXES], double *q)
{
    for (int i = 0; i < 3; i++) {
        double t = i * 2 * M_PI / 3, x = 130 * cos(t) - p[0], y = 130 * sin(t) - p[1],
               h = 269.0 * 269.0 - x * x - y * y;
        if (h < 0) return -1;
        q[i] = p[2] + sqrt(h);
    }
    return 0;
}

/* Table that tilts (A) and turns (C); the pose is the tool's in the work piece. */
static int five_axis(const double p[AXES], double *q)
{
    double a = p[3] * M_PI / 180, c = p[5] * M_PI / 180, x = p[0] * cos(c) - p[1] * sin(c),
           y = p[0] * sin(c) + p[1] * cos(c);
    double z = p[2] + 20;
    q[0] = x, q[1] = y * cos(a) - z * sin(a), q[2] = y * sin(a) + z * cos(a) - 20, q[3] = p[3], q[4] = p[5];
    return 0;
}

/* Two links of 200 in the plane. */
static int scara(const double p[AXES], double *q)
{
    double x = p[0] + 230, y = p[1], k = (x * x + y * y - 80000) / 80000;
    if (fabs(k) > 1) return -1;
    double elbow = acos(k);
    q[0] = (atan2(y, x) - atan2(200 * sin(elbow), 200 + 200 * cos(elbow))) * 180 / M_PI;
    q[1] = elbow * 180 / M_PI;
    q[2] = p[2];
    return 0;
}

static const struct machine machines[] = {
    { "gantry", 4, gantry, 1, 0 },      { "corexy", 3, corexy, 1, 0 }, { "delta", 3, delta, 1, 70 },
    { "five-axis", 5, five_axis, 3, 150 }, { "scara", 3, scara, 1, 90 },
};

const struct machine *machine_named(const char *name)
{
    for (size_t i = 0; i < sizeof machines / sizeof *machines; i++)
        if (!strcmp(machines[i].name, name)) return &machines[i];
    return NULL;
}
