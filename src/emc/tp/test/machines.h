/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * machines.h - kinematics for test programs, written anew: no code of the modules.
 */
#ifndef KERF_TP_TEST_MACHINES_H
#define KERF_TP_TEST_MACHINES_H

#include "bench.h"

struct machine {
    const char *name;
    int joints;
    int (*inverse)(const double p[AXES], double *q); /* other than 0: unreachable */
    int axes;   /* groups that move: 1 xyz, 2 abc */
    double box; /* |x|, |y|, |z| stay within, 0 = anywhere */
};

/* gantry, corexy, delta, five-axis, scara; NULL: no such machine. */
const struct machine *machine_named(const char *name);

#endif
