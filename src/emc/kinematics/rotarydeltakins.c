/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * rotarydeltakins.c - three swinging thighs carry a foot.
 *
 * In, out: kinematics.h
 * Pins:    rotarydeltakins.platformradius, .thighlength, .shinlength, .footradius
 * Thread:  servo
 * Method:  knees on three circles; forward is the lower intersection of three spheres.
 */
#include "kins_main.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Kinematics of a rotary delta robot");
MODULE_LICENSE("GPL");

#include "rotarydelta.h"

static struct {
    hal_real_t pfr, tl, sl, fr;
} *pins;

static struct rotarydelta geometry(void)
{
    struct rotarydelta g = {hal_get_real(pins->pfr), hal_get_real(pins->tl), hal_get_real(pins->sl),
                            hal_get_real(pins->fr)};
    return g;
}

int kinematicsForward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                      KINEMATICS_INVERSE_FLAGS *iflags)
{
    struct rotarydelta g = geometry();
    (void)fflags;
    (void)iflags;
    if (rotarydelta_forward(&g, joint, &world->tran.x) != 0)
        return -1;
    rest_forward(joint, world);
    return 0;
}

int kinematicsInverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                      KINEMATICS_FORWARD_FLAGS *fflags)
{
    struct rotarydelta g = geometry();
    (void)iflags;
    (void)fflags;
    if (rotarydelta_inverse(&g, &world->tran.x, joint) != 0)
        return -1;
    rest_inverse(world, joint);
    return 0;
}

KINS_NOT_SWITCHABLE

const char kins_name[] = "rotarydeltakins";

int kins_setup(int comp_id)
{
    pins = hal_malloc(sizeof(*pins));
    if (!pins ||
        hal_pin_new_real(comp_id, HAL_IN, &pins->pfr, ROTARYDELTA_PFR, "rotarydeltakins.platformradius") < 0 ||
        hal_pin_new_real(comp_id, HAL_IN, &pins->tl, ROTARYDELTA_TL, "rotarydeltakins.thighlength") < 0 ||
        hal_pin_new_real(comp_id, HAL_IN, &pins->sl, ROTARYDELTA_SL, "rotarydeltakins.shinlength") < 0 ||
        hal_pin_new_real(comp_id, HAL_IN, &pins->fr, ROTARYDELTA_FR, "rotarydeltakins.footradius") < 0)
        return -1;
    return 0;
}
