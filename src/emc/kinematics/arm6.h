/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * arm6.h - six-joint arms with a spherical wrist: PUMA and its kin.
 *
 * Lengths in machine units, joints in degrees. Context: [servo].
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

int arm6_forward(const struct arm6 *g, const double *joint, EmcPose *world, KINEMATICS_INVERSE_FLAGS *iflags);
/* Returns 0; -1 out of reach, joint unchanged. Joints are those nearest to the present ones (whole turns). */
int arm6_inverse(const struct arm6 *g, const EmcPose *world, double *joint, KINEMATICS_INVERSE_FLAGS iflags,
                 KINEMATICS_FORWARD_FLAGS *fflags);

#endif
