/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * emcpos.h - a position of all nine axes: lengths in machine units, angles in degrees.
 */
#ifndef KERF_EMCPOS_H
#define KERF_EMCPOS_H

#include "posemath.h"

typedef struct EmcPose {
    PmCartesian tran; /* x y z */
    double a, b, c;   /* degrees */
    double u, v, w;
} EmcPose;

/* Assigns zero to all nine axes of an lvalue. */
#define ZERO_EMC_POSE(pos) do { EmcPose zero_pose_ = {{0, 0, 0}, 0, 0, 0, 0, 0, 0}; (pos) = zero_pose_; } while (0)

#endif
