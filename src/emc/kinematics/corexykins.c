/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * corexykins.c - two crossed belts move X and Y.
 *
 * In, out: kinematics.h
 * Thread:  servo
 * Method:  x = (J0 + J1) / 2, y = (J0 - J1) / 2; other joints are axes.
 */
#include "kins_main.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("CoreXY kinematics");
MODULE_LICENSE("GPL");

int kinematicsForward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                      KINEMATICS_INVERSE_FLAGS *iflags)
{
    (void)fflags;
    (void)iflags;
    world->tran.x = 0.5 * (joint[0] + joint[1]);
    world->tran.y = 0.5 * (joint[0] - joint[1]);
    world->tran.z = joint[2];
    rest_forward(joint, world);
    return 0;
}

int kinematicsInverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                      KINEMATICS_FORWARD_FLAGS *fflags)
{
    (void)iflags;
    (void)fflags;
    joint[0] = world->tran.x + world->tran.y;
    joint[1] = world->tran.x - world->tran.y;
    joint[2] = world->tran.z;
    rest_inverse(world, joint);
    return 0;
}

KINS_NOT_SWITCHABLE

const char kins_name[] = "corexykins";

int kins_setup(int comp_id)
{
    (void)comp_id;
    return 0;
}
