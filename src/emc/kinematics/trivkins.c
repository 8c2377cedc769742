/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * trivkins.c - each joint is one axis.
 *
 * In:     loadrt coordinates=XYZ... kinstype=1|b|f|i     Out: kinematics.h
 * Thread: servo
 */
#include "emcmotcfg.h"
#include "hal.h"
#include "kinematics.h"
#include "rtapi.h"
#include "rtapi_app.h"
#include "switchkins.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Trivial kinematics: joints are axes");
MODULE_LICENSE("GPL");

static char *coordinates = "XYZABCUVW";
RTAPI_MP_STRING(coordinates, "Existing Axes");
static char *kinstype = "1";
RTAPI_MP_STRING(kinstype, "Kinematics Type (Identity,Both,Forward,Inverse)");

static KINEMATICS_TYPE type = KINEMATICS_IDENTITY;
static int comp_id;

int kinematicsForward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                      KINEMATICS_INVERSE_FLAGS *iflags)
{
    return identityKinematicsForward(joint, world, fflags, iflags);
}

int kinematicsInverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                      KINEMATICS_FORWARD_FLAGS *fflags)
{
    return identityKinematicsInverse(world, joint, iflags, fflags);
}

KINEMATICS_TYPE kinematicsType(void) { return type; }

KINS_NOT_SWITCHABLE
EXPORT_SYMBOL(kinematicsType);
EXPORT_SYMBOL(kinematicsForward);
EXPORT_SYMBOL(kinematicsInverse);

int rtapi_app_main(void)
{
    kparms kp = {.kinsname = "trivkins", .max_joints = EMCMOT_MAX_JOINTS, .allow_duplicates = 1};
    switch (kinstype[0]) {
    case 'b': case 'B': type = KINEMATICS_BOTH; break;
    case 'f': case 'F': type = KINEMATICS_FORWARD_ONLY; break;
    case 'i': case 'I': type = KINEMATICS_INVERSE_ONLY; break;
    default: type = KINEMATICS_IDENTITY; break;
    }
    comp_id = hal_init("trivkins");
    if (comp_id < 0)
        return comp_id;
    if (identityKinematicsSetup(comp_id, coordinates, &kp) != 0) {
        hal_exit(comp_id);
        return -1;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void) { hal_exit(comp_id); }
