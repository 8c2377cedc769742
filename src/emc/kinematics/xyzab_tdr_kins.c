/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * xyzab_tdr_kins.c - mill with a rotary table on a tilting table (A tilts, B turns).
 *
 * In, out: kinematics.h; pins xyzab_tdr_kins.*; types 0 identity, 1 tool centre point
 * Thread:  servo
 * Method:  the work turns about the B axis, then about A; x-offset has no effect
 *          (it cancels, as in the peer).
 */
#include "kins_main.h"
#include "ownswitch.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Kinematics of a mill with a double rotary table, A and B");
MODULE_LICENSE("GPL");

static struct {
    hal_real_t tool_offset_z, x_offset, z_offset, x_rot, y_rot, z_rot;
    hal_sint_t dummy;
} *pins;

int kinematicsForward(const double *j, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                      KINEMATICS_INVERSE_FLAGS *iflags)
{
    EmcPose p = {{j[0], j[1], j[2]}, j[3], j[4], 0, 0, 0, 0};
    (void)fflags;
    (void)iflags;
    if (type_now == 1) {
        double sa, ca, sb, cb, dt = hal_get_real(pins->tool_offset_z), dz = hal_get_real(pins->z_offset);
        double X0 = hal_get_real(pins->x_rot), Y0 = hal_get_real(pins->y_rot), Z0 = hal_get_real(pins->z_rot);
        double x = j[0] - X0, y = j[1] - Y0, z = j[2] - Z0 - dt;
        sincos_deg(j[3], &sa, &ca);
        sincos_deg(j[4], &sb, &cb);
        p.tran.x = cb * x + sb * z + X0;
        p.tran.y = sa * sb * x + ca * y - cb * sa * z + sa * dz + Y0;
        p.tran.z = -ca * sb * x + sa * y + ca * cb * z - ca * dz + Z0 + dz + dt;
    }
    *world = p;
    return 0;
}

int kinematicsInverse(const EmcPose *world, double *j, const KINEMATICS_INVERSE_FLAGS *iflags,
                      KINEMATICS_FORWARD_FLAGS *fflags)
{
    (void)iflags;
    (void)fflags;
    j[3] = world->a;
    j[4] = world->b;
    if (type_now == 0) {
        j[0] = world->tran.x;
        j[1] = world->tran.y;
        j[2] = world->tran.z;
        return 0;
    }
    double sa, ca, sb, cb, dt = hal_get_real(pins->tool_offset_z), dz = hal_get_real(pins->z_offset);
    double X0 = hal_get_real(pins->x_rot), Y0 = hal_get_real(pins->y_rot), Z0 = hal_get_real(pins->z_rot);
    double x = world->tran.x - X0, y = world->tran.y - Y0, z = world->tran.z - Z0 - dz - dt;
    sincos_deg(world->a, &sa, &ca);
    sincos_deg(world->b, &sb, &cb);
    j[0] = cb * x + sa * sb * y - ca * sb * z - sb * dz + X0;
    j[1] = ca * y + sa * z + Y0;
    j[2] = sb * x - sa * cb * y + ca * cb * z + cb * dz + Z0 + dt;
    return 0;
}

const char kins_name[] = "xyzab_tdr_kins";

int kins_setup(int comp_id)
{
    int r = 0, id = comp_id;
    pins = hal_malloc(sizeof(*pins));
    if (!pins)
        return -1;
    r |= hal_pin_new_real(id, HAL_IN, &pins->tool_offset_z, 0, "xyzab_tdr_kins.tool-offset-z");
    r |= hal_pin_new_real(id, HAL_IN, &pins->x_offset, 0, "xyzab_tdr_kins.x-offset");
    r |= hal_pin_new_real(id, HAL_IN, &pins->z_offset, 0, "xyzab_tdr_kins.z-offset");
    r |= hal_pin_new_real(id, HAL_IN, &pins->x_rot, 0, "xyzab_tdr_kins.x-rot-point");
    r |= hal_pin_new_real(id, HAL_IN, &pins->y_rot, 0, "xyzab_tdr_kins.y-rot-point");
    r |= hal_pin_new_real(id, HAL_IN, &pins->z_rot, 0, "xyzab_tdr_kins.z-rot-point");
    r |= hal_pin_new_si32(id, HAL_OUT, &pins->dummy, 0, "xyzab-tdr-kins.0.dummy");
    return r < 0 ? -1 : ownswitch_pins(id, 2);
}
