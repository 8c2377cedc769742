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
/* [init] Fills the nine arguments of switchkinsSetup(); identityfirst in sparm exchanges types 0 and 1. */
void switchkins_usual_types(const kparms *kp, KS own_setup, KF own_forward, KI own_inverse, KS *ks0, KS *ks1,
                            KS *ks2, KF *kf0, KF *kf1, KF *kf2, KI *ki0, KI *ki1, KI *ki2);
/* [init] Joint of each axis letter from the mapping (-1 none); reports a missing required letter. */
int switchkins_joints_of_axes(const char *coordinates, const kparms *kp, int joint_of_axis[]);

#endif
