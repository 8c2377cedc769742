/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * switchkins_util.h - what the switchable modules of this folder have in common.
 */
#ifndef KERF_SWITCHKINS_UTIL_H
#define KERF_SWITCHKINS_UTIL_H

#include "switchkins.h"

/* [init] Fills the nine arguments of switchkinsSetup(); identityfirst in sparm exchanges types 0 and 1. */
void switchkins_usual_types(const kparms *kp, KS own_setup, KF own_forward, KI own_inverse, KS *ks0, KS *ks1,
                            KS *ks2, KF *kf0, KF *kf1, KF *kf2, KI *ki0, KI *ki1, KI *ki2);
/* [init] Joint of each axis letter from the mapping (-1 none); reports a missing required letter. */
int switchkins_joints_of_axes(const char *coordinates, const kparms *kp, int joint_of_axis[]);

#endif
