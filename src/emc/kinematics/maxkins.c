/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * maxkins.c - mill with a tilting head (B) and a turning table (C).
 *
 * In, out: kinematics.h
 * Pins:    maxkins.pivot-length, maxkins.conventional-directions
 * Thread:  servo
 * Method:  r cos, r sin of the table point plus the swing of the tool about the pivot.
 *          Forward is the exact inverse of inverse (the peer's is not when C is turned
 *          and B, U or V are used, or U and B together: docs/compatibility.md).
 */
#include "kins_main.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Kinematics of a mill with tilting head and turning table");
MODULE_LICENSE("GPL");

static struct {
    hal_real_t pivot_length;
    hal_bool_t conventional_directions;
} *pins;

/* What the head adds to the joints at this B, U, V, W. */
static void head_offset(double b, double u, double v, double w, double *dx, double *dy, double *dz)
{
    double s, c, con = hal_get_bool(pins->conventional_directions) ? 1.0 : -1.0;
    double pivot = hal_get_real(pins->pivot_length), length = pivot + w;
    sincos_deg(b, &s, &c);
    *dx = con * length * s + u * c;
    *dy = v;
    *dz = length * c - con * u * s - pivot;
}

int kinematicsForward(const double *joint, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                      KINEMATICS_INVERSE_FLAGS *iflags)
{
    double s, c, dx, dy, dz, x, y;
    (void)fflags;
    (void)iflags;
    head_offset(joint[4], joint[6], joint[7], joint[8], &dx, &dy, &dz);
    x = joint[0] - dx;
    y = joint[1] - dy;
    sincos_deg(joint[5], &s, &c);
    world->tran.x = x * c - y * s;
    world->tran.y = x * s + y * c;
    world->tran.z = joint[2] - dz;
    rest_forward(joint, world);
    return 0;
}

int kinematicsInverse(const EmcPose *world, double *joint, const KINEMATICS_INVERSE_FLAGS *iflags,
                      KINEMATICS_FORWARD_FLAGS *fflags)
{
    double s, c, dx, dy, dz;
    (void)iflags;
    (void)fflags;
    head_offset(world->b, world->u, world->v, world->w, &dx, &dy, &dz);
    sincos_deg(-world->c, &s, &c);
    joint[0] = world->tran.x * c - world->tran.y * s + dx;
    joint[1] = world->tran.x * s + world->tran.y * c + dy;
    joint[2] = world->tran.z + dz;
    rest_inverse(world, joint);
    return 0;
}

KINS_NOT_SWITCHABLE

const char kins_name[] = "maxkins";

int kins_setup(int comp_id)
{
    pins = hal_malloc(sizeof(*pins));
    if (!pins ||
        hal_pin_new_real(comp_id, HAL_IO, &pins->pivot_length, 0.666, "maxkins.pivot-length") < 0 ||
        hal_pin_new_bool(comp_id, HAL_IN, &pins->conventional_directions, 0, "maxkins.conventional-directions") < 0)
        return -1;
    return 0;
}
