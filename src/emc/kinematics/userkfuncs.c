/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * userkfuncs.c - user kinematics of switchable modules (type 2): identity, as a template.
 *
 * In, out: kinematics.h; pins userk.fct and userk.ict count the calls.
 * Thread:  setup [init], the rest [servo]
 */
#include "hal.h"
#include "switchkins.h"

static struct {
    hal_sint_t forward_count, inverse_count;
} *pins;

int userkKinematicsSetup(const int comp_id, const char *coordinates, kparms *kp)
{
    (void)coordinates;
    (void)kp;
    pins = hal_malloc(sizeof(*pins));
    if (!pins || hal_pin_new_si32(comp_id, HAL_IO, &pins->forward_count, 0, "userk.fct") < 0 ||
        hal_pin_new_si32(comp_id, HAL_IO, &pins->inverse_count, 0, "userk.ict") < 0)
        return -1;
    return 0;
}

int userkKinematicsForward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                           KINEMATICS_INVERSE_FLAGS *iflags)
{
    hal_set_si32(pins->forward_count, hal_get_si32(pins->forward_count) + 1);
    return identityKinematicsForward(joint, world, fflags, iflags);
}

int userkKinematicsInverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                           KINEMATICS_FORWARD_FLAGS *fflags)
{
    hal_set_si32(pins->inverse_count, hal_get_si32(pins->inverse_count) + 1);
    return identityKinematicsInverse(world, joint, iflags, fflags);
}
