/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * xyzac-trt-kins.c - mill with tilting (A) and turning (C) table; the kinematics are in trtfuncs.c.
 *
 * Thread: init
 */
#include "rtapi.h"
#include "switchkins.h"
#include "switchkins_util.h"
#include "trtfuncs.h"

static int setup(const int comp_id, const char *coordinates, kparms *kp)
{
    return trtKinematicsSetup(comp_id, coordinates, kp, 'A');
}

int switchkinsSetup(kparms *kp, KS *ks0, KS *ks1, KS *ks2, KF *kf0, KF *kf1, KF *kf2, KI *ki0, KI *ki1, KI *ki2)
{
    kp->kinsname = kp->halprefix = "xyzac-trt-kins";
    kp->required_coordinates = "xyzac";
    kp->max_joints = 9;
    kp->allow_duplicates = 1;
    switchkins_usual_types(kp, setup, trtKinematicsForward, trtKinematicsInverse, ks0, ks1, ks2, kf0, kf1, kf2, ki0,
                           ki1, ki2);
    return 0;
}
