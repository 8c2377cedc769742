/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * trsrn.c - pins, terms and both directions of six-axis mills with a nutating spindle (trsrn.h).
 *
 * Types: 0 identity, 1 tool centre point, 2 tool frame. Context: kins_setup [init], else [servo].
 */
#include "trsrn.h"
#include "ownswitch.h"

static struct {
    hal_real_t tool_offset_z, z_pivot, x_offset, y_offset, z_rot, pre_rot, nut_angle, primary, secondary;
    hal_real_t side_pivot; /* y-pivot or x-pivot */
    hal_real_t side_rot;   /* y-rot-axis or x-rot-axis */
    hal_sint_t dummy;
} *pins;

enum { IDENTITY, TCP, TOOL };

static struct trsrn trsrn_terms(double primary, double secondary, double table)
{
    struct trsrn f;
    double sv, cv, tc = hal_get_real(pins->pre_rot);
    f.Dx = hal_get_real(pins->x_offset);
    f.Dy = hal_get_real(pins->y_offset);
    f.Dt = hal_get_real(pins->tool_offset_z);
    f.Lz = hal_get_real(pins->z_pivot);
    f.L = hal_get_real(pins->side_pivot);
    f.E = f.Dt + f.Lz;
    f.R = hal_get_real(pins->side_rot) - (trsrn_mill.side == 'y' ? f.Dy : f.Dx) - f.L;
    f.Rz = hal_get_real(pins->z_rot) - f.Lz;
    sincos_deg(hal_get_real(pins->nut_angle), &sv, &cv);
    sincos_deg(primary, &f.sp, &f.cp);
    sincos_deg(secondary, &f.ss, &f.cs);
    sincos_deg(table, &f.sw, &f.cw);
    f.stc = sin(tc);
    f.ctc = cos(tc);
    f.K = cv * f.ss;
    f.M = sv * f.ss;
    f.r = f.cs + sv * sv * (1.0 - f.cs);
    f.s = f.cs + cv * cv * (1.0 - f.cs);
    f.t = sv * cv * (1.0 - f.cs);
    return f;
}

int kinematicsForward(const double *j, EmcPose *world, const KINEMATICS_FORWARD_FLAGS *fflags,
                      KINEMATICS_INVERSE_FLAGS *iflags)
{
    EmcPose p = {{j[0], j[1], j[2]}, j[3], j[4], j[5], 0, 0, 0};
    (void)fflags;
    (void)iflags;
    if (type_now == TCP) {
        struct trsrn f = trsrn_terms(j[5], j[trsrn_mill.nutating], j[trsrn_mill.table]);
        p.tran = trsrn_mill.tcp_forward(&f, j);
    } else if (type_now == TOOL) {
        struct trsrn f = trsrn_terms(hal_get_real(pins->primary), hal_get_real(pins->secondary), 0.0);
        p.tran = trsrn_mill.tool_forward(&f, j);
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
    j[5] = world->c;
    if (type_now == TCP) {
        struct trsrn f = trsrn_terms(j[5], j[trsrn_mill.nutating], j[trsrn_mill.table]);
        trsrn_mill.tcp_inverse(&f, &world->tran, j);
    } else if (type_now == TOOL) {
        struct trsrn f = trsrn_terms(hal_get_real(pins->primary), hal_get_real(pins->secondary), 0.0);
        trsrn_mill.tool_inverse(&f, &world->tran, j);
    } else {
        j[0] = world->tran.x;
        j[1] = world->tran.y;
        j[2] = world->tran.z;
    }
    return 0;
}

int kins_setup(int id)
{
    const char *prefix = trsrn_mill.prefix;
    char side = trsrn_mill.side;
    int r = 0;
    pins = hal_malloc(sizeof(*pins));
    if (!pins)
        return -1;
    r |= hal_pin_new_real(id, HAL_IN, &pins->tool_offset_z, 0, "%s.tool-offset-z", prefix);
    r |= hal_pin_new_real(id, HAL_IN, &pins->side_pivot, 0, "%s.%c-pivot", prefix, side);
    r |= hal_pin_new_real(id, HAL_IN, &pins->z_pivot, 0, "%s.z-pivot", prefix);
    r |= hal_pin_new_real(id, HAL_IN, &pins->x_offset, 0, "%s.x-offset", prefix);
    r |= hal_pin_new_real(id, HAL_IN, &pins->y_offset, 0, "%s.y-offset", prefix);
    r |= hal_pin_new_real(id, HAL_IN, &pins->side_rot, 0, "%s.%c-rot-axis", prefix, side);
    r |= hal_pin_new_real(id, HAL_IN, &pins->z_rot, 0, "%s.z-rot-axis", prefix);
    r |= hal_pin_new_real(id, HAL_IN, &pins->pre_rot, 0, "%s.pre-rot", prefix);
    r |= hal_pin_new_real(id, HAL_IN, &pins->nut_angle, 0, "%s.nut-angle", prefix);
    r |= hal_pin_new_real(id, HAL_IN, &pins->primary, 0, "%s.primary-angle", prefix);
    r |= hal_pin_new_real(id, HAL_IN, &pins->secondary, 0, "%s.secondary-angle", prefix);
    r |= hal_pin_new_si32(id, HAL_OUT, &pins->dummy, 0, "%s", trsrn_mill.dummy);
    return r < 0 ? -1 : ownswitch_pins(id, 3);
}
