/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * rotatekins.c - X and Y stand on a table turned by C.
 *
 * In, out: kinematics.h
 * Thread:  servo
 * Method:  rotation of (x, y) by joint 5.
 */
#include "kins_main.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Kinematics of a rotating table");
MODULE_LICENSE("GPL");

int kinematicsForward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                      KINEMATICS_INVERSE_FLAGS *iflags)
{
    double s, c;
    (void)fflags;
    (void)iflags;
    sincos_deg(-joint[5], &s, &c);
    world->tran.x = joint[0] * c - joint[1] * s;
    world->tran.y = joint[0] * s + joint[1] * c;
    world->tran.z = joint[2];
    rest_forward(joint, world);
    return 0;
}

int kinematicsInverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                      KINEMATICS_FORWARD_FLAGS *fflags)
{
    double s, c;
    (void)iflags;
    (void)fflags;
    sincos_deg(world->c, &s, &c);
    joint[0] = world->tran.x * c - world->tran.y * s;
    joint[1] = world->tran.x * s + world->tran.y * c;
    joint[2] = world->tran.z;
    rest_inverse(world, joint);
    return 0;
}

KINS_NOT_SWITCHABLE

const char kins_name[] = "rotatekins";

int kins_setup(int comp_id)
{
    (void)comp_id;
    return 0;
}
