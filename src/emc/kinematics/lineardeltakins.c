/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * lineardeltakins.c - three carriages on vertical towers.
 *
 * In, out: kinematics.h
 * Pins:    lineardeltakins.R, lineardeltakins.L
 * Thread:  servo
 * Method:  rods of length L from carriages on a circle of radius R; forward is the
 *          lower intersection of three spheres.
 */
#include "kins_main.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Kinematics of a linear delta robot");
MODULE_LICENSE("GPL");

#include "lineardelta.h"

static struct {
    hal_real_t R, L;
} *pins;

static struct lineardelta geometry(void)
{
    struct lineardelta g = {hal_get_real(pins->R), hal_get_real(pins->L)};
    return g;
}

int kinematicsForward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                      KINEMATICS_INVERSE_FLAGS *iflags)
{
    struct lineardelta g = geometry();
    (void)fflags;
    (void)iflags;
    if (lineardelta_forward(&g, joint, &world->tran.x) != 0)
        return -1;
    rest_forward(joint, world);
    return 0;
}

int kinematicsInverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                      KINEMATICS_FORWARD_FLAGS *fflags)
{
    struct lineardelta g = geometry();
    (void)iflags;
    (void)fflags;
    if (lineardelta_inverse(&g, &world->tran.x, joint) != 0)
        return -1;
    rest_inverse(world, joint);
    return 0;
}

KINS_NOT_SWITCHABLE

const char kins_name[] = "lineardeltakins";

int kins_setup(int comp_id)
{
    pins = hal_malloc(sizeof(*pins));
    if (!pins ||
        hal_pin_new_real(comp_id, HAL_IN, &pins->R, LINEARDELTA_R, "lineardeltakins.R") < 0 ||
        hal_pin_new_real(comp_id, HAL_IN, &pins->L, LINEARDELTA_L, "lineardeltakins.L") < 0)
        return -1;
    return 0;
}
