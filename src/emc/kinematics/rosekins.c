/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * rosekins.c - rose engine: X and Y as radius and turned spindle.
 *
 * In, out: kinematics.h
 * Pins:    rosekins.revolutions, rosekins.theta_degrees, rosekins.bigtheta_degrees
 * Thread:  servo
 * Method:  polar coordinates; whole turns follow from the joint command of the cycle
 *          before, so that asking for a far point does not lose count.
 */
#include "kins_main.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Kinematics of a rose engine");
MODULE_LICENSE("GPL");

static struct {
    hal_real_t revolutions, theta_degrees, bigtheta_degrees;
} *pins;

int kinematicsForward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                      KINEMATICS_INVERSE_FLAGS *iflags)
{
    double s, c;
    EmcPose none = {{0, 0, 0}, 0, 0, 0, 0, 0, 0};
    (void)fflags;
    (void)iflags;
    sincos_deg(joint[2], &s, &c);
    *world = none;
    world->tran.x = joint[0] * c;
    world->tran.y = joint[0] * s;
    world->tran.z = joint[1];
    return 0;
}

int kinematicsInverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                      KINEMATICS_FORWARD_FLAGS *fflags)
{
    double theta = atan2(world->tran.y, world->tran.x) * TO_DEG;
    double big = world->tran.x == 0.0 && world->tran.y == 0.0 ? joint[2] : nearest_turn(theta, joint[2]);
    (void)iflags;
    (void)fflags;
    joint[0] = hypot(world->tran.x, world->tran.y);
    joint[1] = world->tran.z;
    joint[2] = big;
    for (int j = 3; j < 9; j++)
        joint[j] = 0.0;
    hal_set_real(pins->theta_degrees, theta);
    hal_set_real(pins->bigtheta_degrees, big);
    hal_set_real(pins->revolutions, round((big - theta) / 360.0));
    return 0;
}

KINS_NOT_SWITCHABLE

const char kins_name[] = "rosekins";

int kins_setup(int comp_id)
{
    pins = hal_malloc(sizeof(*pins));
    if (!pins ||
        hal_pin_new_real(comp_id, HAL_OUT, &pins->revolutions, 0, "rosekins.revolutions") < 0 ||
        hal_pin_new_real(comp_id, HAL_OUT, &pins->theta_degrees, 0, "rosekins.theta_degrees") < 0 ||
        hal_pin_new_real(comp_id, HAL_OUT, &pins->bigtheta_degrees, 0, "rosekins.bigtheta_degrees") < 0)
        return -1;
    return 0;
}
