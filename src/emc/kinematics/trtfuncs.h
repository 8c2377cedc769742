/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * trtfuncs.h - mills with tilting and turning table: type 0 of xyzac-trt-kins and xyzbc-trt-kins.
 */
#ifndef KERF_TRTFUNCS_H
#define KERF_TRTFUNCS_H

#include "switchkins.h"

/* [init] Pins under kp->halprefix; tilt is the letter of the tilting axis, 'A' or 'B'. */
int trtKinematicsSetup(const int comp_id, const char *coordinates, kparms *kp, char tilt);
/* [servo] */
int trtKinematicsForward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                         KINEMATICS_INVERSE_FLAGS *iflags);
int trtKinematicsInverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                         KINEMATICS_FORWARD_FLAGS *fflags);

#endif
