/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * arm6.h - six-joint arms with a spherical wrist: PUMA and its kin.
 *
 * arm6.c holds the kinematics and the module; pumakins.c and three21kins.c say which
 * lengths their arm has. Lengths in machine units, joints in degrees. Context: [servo].
 */
#ifndef KERF_ARM6_H
#define KERF_ARM6_H

#include "kinematics.h"

struct arm6 {
    double A1, A2, A3, D1, D, D4, D6; /* D: offset of the shoulder across the arm */
};

/* iflags */
#define ARM6_SHOULDER_RIGHT 1u
#define ARM6_ELBOW_DOWN 2u
#define ARM6_WRIST_FLIP 4u
#define ARM6_SINGULAR 8u
/* fflags */
#define ARM6_REACH 1u

#define ARM6_LENGTHS 8 /* at most */

/* Supplied by the module: its name and the lengths that are pins of it. */
struct arm6_module {
    char *name;
    struct {
        const char *name;
        double initial;
    } lengths[ARM6_LENGTHS]; /* up to the first without name */
    struct arm6 (*geometry)(const double *lengths);
};
extern const struct arm6_module arm6_module;

#endif
