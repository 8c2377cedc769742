/* SPDX-License-Identifier: GPL-2.0-or-later
 * Type 2 of switchable kinematics as a user writes it: all three axes count double, one joint carries a pin. */
#include "hal.h"
#include "switchkins.h"

static hal_float_t *scale;

int userkKinematicsSetup(const int comp_id, const char *coordinates, kparms *kp)
{
    (void)coordinates;
    (void)kp;
    hal_float_t **pin = hal_malloc(sizeof(*pin));
    if (!pin || hal_pin_float_new("mine.scale", HAL_IN, pin, comp_id) != 0)
        return -1;
    scale = *pin;
    *scale = 2.0;
    return 0;
}

int userkKinematicsForward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                           KINEMATICS_INVERSE_FLAGS *iflags)
{
    (void)fflags;
    (void)iflags;
    world->tran.x = joint[0] * 2.0;
    world->tran.y = joint[1] * 2.0;
    world->tran.z = joint[2] * *scale;
    return 0;
}

int userkKinematicsInverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                           KINEMATICS_FORWARD_FLAGS *fflags)
{
    (void)iflags;
    (void)fflags;
    joint[0] = world->tran.x / 2.0;
    joint[1] = world->tran.y / 2.0;
    joint[2] = world->tran.z / *scale;
    return 0;
}
