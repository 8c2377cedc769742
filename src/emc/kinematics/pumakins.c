/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * pumakins.c - PUMA 560 and similar arms; the kinematics are in arm6.c.
 *
 * In, out: kinematics.h; pins pumakins.A2 .A3 .D3 .D4 .D6   Thread: servo
 */
#include "arm6.h"

static struct arm6 geometry(const double *v)
{
    struct arm6 g = {.A1 = 0.0, .A2 = v[0], .A3 = v[1], .D1 = 0.0, .D = v[2], .D4 = v[3], .D6 = v[4]};
    return g;
}

const struct arm6_module arm6_module = {
    .name = "pumakins",
    .lengths = {{"A2", 300.0}, {"A3", 50.0}, {"D3", 70.0}, {"D4", 400.0}, {"D6", 70.0}},
    .geometry = geometry,
};
