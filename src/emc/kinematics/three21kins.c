/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * three21kins.c - arm of the 3-2-1 kind, with offsets at base and shoulder; the kinematics are in arm6.c.
 *
 * In, out: kinematics.h; pins three21kins.A1 to .A3, .D1 to .D4, .D6   Thread: servo
 */
#include "arm6.h"

static struct arm6 geometry(const double *v)
{
    struct arm6 g = {.A1 = v[0], .A2 = v[1], .A3 = v[2], .D1 = v[3], .D = v[4] + v[5], .D4 = v[6], .D6 = v[7]};
    return g;
}

const struct arm6_module arm6_module = {
    .name = "three21kins",
    .lengths = {{"A1", 64.2}, {"A2", 305.0}, {"A3", 0.0}, {"D1", 169.77},
                {"D2", 0.0}, {"D3", -6.25}, {"D4", 223.63}, {"D6", 36.5}},
    .geometry = geometry,
};
