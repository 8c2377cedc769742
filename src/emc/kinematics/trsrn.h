/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * trsrn.h - six-axis mills: a rotary table and a spindle that turns (C) and nutates.
 *
 * Included once by xyzacb_trsrn.c (table A, nutation B) and xyzbca_trsrn.c
 * (table B, nutation A). Lengths in machine units, angles in degrees but
 * pre-rot, which is in radians. Context: [servo].
 */
#ifndef KERF_TRSRN_H
#define KERF_TRSRN_H

#include "ownswitch.h"

static struct {
    hal_real_t tool_offset_z, z_pivot, x_offset, y_offset, z_rot, pre_rot, nut_angle, primary, secondary;
    hal_real_t side_pivot; /* y-pivot or x-pivot */
    hal_real_t side_rot;   /* y-rot-axis or x-rot-axis */
    hal_sint_t dummy;
} *pins;

enum { IDENTITY, TCP, TOOL };

/* Terms of the formulas; names as in docs/kinematics. */
struct trsrn {
    double Dx, Dy, Dt, Lz, L, E, R, Rz;  /* L, R: pivot and rotary axis on the table's side */
    double sp, cp, ss, cs, sw, cw;       /* primary (C), secondary (nutation), table */
    double stc, ctc;
    double K, M, r, s, t;
};

static struct trsrn trsrn_terms(double primary, double secondary, double table, int side_is_y)
{
    struct trsrn f;
    double sv, cv, tc = hal_get_real(pins->pre_rot);
    f.Dx = hal_get_real(pins->x_offset);
    f.Dy = hal_get_real(pins->y_offset);
    f.Dt = hal_get_real(pins->tool_offset_z);
    f.Lz = hal_get_real(pins->z_pivot);
    f.L = hal_get_real(pins->side_pivot);
    f.E = f.Dt + f.Lz;
    f.R = hal_get_real(pins->side_rot) - (side_is_y ? f.Dy : f.Dx) - f.L;
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

static int trsrn_pins(int id, const char *prefix, const char *dummy, char side)
{
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
    r |= hal_pin_new_si32(id, HAL_OUT, &pins->dummy, 0, "%s", dummy);
    return r < 0 ? -1 : ownswitch_pins(id, 3);
}

#endif
