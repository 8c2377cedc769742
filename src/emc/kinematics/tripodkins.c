/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * tripodkins.c - three struts from fixed points to one point.
 *
 * In, out: kinematics.h
 * Pins:    tripodkins.Bx, tripodkins.Cx, tripodkins.Cy
 * Thread:  servo
 * Method:  distances to A(0,0), B(Bx,0), C(Cx,Cy); trilateration.
 */
#include "kins_main.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Kinematics of a tripod");
MODULE_LICENSE("GPL");

static struct {
    hal_real_t Bx, Cx, Cy;
} *pins;

int kinematicsForward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                      KINEMATICS_INVERSE_FLAGS *iflags)
{
    double Bx = hal_get_real(pins->Bx), Cx = hal_get_real(pins->Cx), Cy = hal_get_real(pins->Cy);
    double P = pmSq(joint[0]), Q = pmSq(joint[1]) - pmSq(Bx), R = pmSq(joint[2]) - pmSq(Cx) - pmSq(Cy);
    double x, y, z2;
    (void)iflags;
    if (Bx == 0.0 || Cy == 0.0)
        return -1;
    x = (Q - P) / (-2.0 * Bx);
    y = (R - Q - (-2.0 * Cx + 2.0 * Bx) * x) / (-2.0 * Cy);
    z2 = P - x * x - y * y;
    if (!(z2 >= 0.0))
        return -1;
    world->tran.x = x;
    world->tran.y = y;
    world->tran.z = *fflags ? -sqrt(z2) : sqrt(z2);
    world->a = world->b = world->c = 0.0;
    return 0;
}

int kinematicsInverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                      KINEMATICS_FORWARD_FLAGS *fflags)
{
    double Bx = hal_get_real(pins->Bx), Cx = hal_get_real(pins->Cx), Cy = hal_get_real(pins->Cy);
    double x = world->tran.x, y = world->tran.y, z2 = pmSq(world->tran.z);
    (void)iflags;
    joint[0] = sqrt(x * x + y * y + z2);
    joint[1] = sqrt(pmSq(x - Bx) + y * y + z2);
    joint[2] = sqrt(pmSq(x - Cx) + pmSq(y - Cy) + z2);
    *fflags = world->tran.z < 0.0;
    return 0;
}

KINS_NOT_SWITCHABLE

const char kins_name[] = "tripodkins";

int kins_setup(int comp_id)
{
    pins = hal_malloc(sizeof(*pins));
    if (!pins ||
        hal_pin_new_real(comp_id, HAL_IO, &pins->Bx, 1.0, "tripodkins.Bx") < 0 ||
        hal_pin_new_real(comp_id, HAL_IO, &pins->Cx, 1.0, "tripodkins.Cx") < 0 ||
        hal_pin_new_real(comp_id, HAL_IO, &pins->Cy, 1.0, "tripodkins.Cy") < 0)
        return -1;
    return 0;
}
