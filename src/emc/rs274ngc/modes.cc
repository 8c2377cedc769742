/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * modes.cc - plane, units, distance, retract, lathe and path control modes.
 *
 * Thread: [task]
 * Source: G-codes sheet; units: G-code sheet, section 9
 */
#include <algorithm>

#include "stages.hh"

namespace ngc
{

int convert_plane(Setup &s, int g)
{
    CANON_PLANE plane;
    switch (g) {
    case G_17: plane = CANON_PLANE_XY; break;
    case G_18: plane = CANON_PLANE_XZ; break;
    case G_19: plane = CANON_PLANE_YZ; break;
    case G_17_1: plane = CANON_PLANE_UV; break;
    case G_18_1: plane = CANON_PLANE_UW; break;
    default: plane = CANON_PLANE_VW; break;
    }
    if (s.comp_on()) {
        CHECK(g == G_19, "Cutter radius compensation allowed only in XY, XZ planes");
        CHECK((g == G_17 || g == G_18) && plane != s.plane,
              "Cannot change planes with cutter radius compensation on");
    }
    s.canon.SELECT_PLANE(plane);
    s.plane = plane;
    return INTERP_OK;
}

int convert_units(Setup &s, int g)
{
    const CANON_UNITS units = g == G_20 ? CANON_UNITS_INCHES : CANON_UNITS_MM;
    s.canon.USE_LENGTH_UNITS(units);
    if (units == s.units) return INTERP_OK;
    const double factor = units == CANON_UNITS_INCHES ? 1 / MM_PER_INCH : MM_PER_INCH;
    for (int i = 0; i < AXES; ++i) {
        if (!is_linear(i)) continue;
        axis(s.current, i) *= factor;
        axis(s.g92, i) *= factor;
        axis(s.g5x, i) *= factor;
    }
    s.program_x *= factor;
    s.program_y *= factor;
    s.program_z *= factor;
    s.units = units;
    scale_comp(s, factor);
    s.tool_offset = s.canon.GET_EXTERNAL_TOOL_LENGTH_OFFSET();
    s.feed_rate = s.canon.GET_EXTERNAL_FEED_RATE();
    s.tolerance = s.canon.GET_EXTERNAL_MOTION_CONTROL_TOLERANCE();
    s.naivecam_tolerance = s.canon.GET_EXTERNAL_MOTION_CONTROL_NAIVECAM_TOLERANCE();
    return INTERP_OK;
}

int convert_lathe(Setup &s, int g)
{
    // X words (and the depths of G76) on the line that switches were read in the old mode.
    Block &b = s.block;
    const bool diameter = g == G_7;
    if (diameter == s.lathe_diameter) return INTERP_OK;
    const double factor = diameter ? 0.5 : 2.0;
    if (b.has('x')) b.set('x', b['x'] * factor);
    if (b.motion == G_76)
        for (char c : {'i', 'j', 'k'})
            if (b.has(c)) b.set(c, b[c] * factor);
    s.lathe_diameter = diameter;
    enqueue_comment(s, diameter ? "interpreter: Lathe diameter mode changed to diameter"
                                : "interpreter: Lathe diameter mode changed to radius");
    return INTERP_OK;
}

static void set_control_mode(Setup &s, CANON_MOTION_MODE mode, double tolerance)
{
    s.canon.SET_MOTION_CONTROL_MODE(mode, tolerance);
    s.control_mode = mode;
    s.tolerance = tolerance;
}

static void set_naivecam(Setup &s, double tolerance)
{
    s.canon.SET_NAIVECAM_TOLERANCE(tolerance);
    s.naivecam_tolerance = tolerance;
}

void exact_moves(Setup &s, bool on)
{
    if (s.control_mode == CANON_EXACT_PATH) return;
    s.canon.SET_MOTION_CONTROL_MODE(on ? CANON_EXACT_PATH : s.control_mode, on ? 0 : s.tolerance);
    if (!on) s.canon.SET_NAIVECAM_TOLERANCE(s.naivecam_tolerance);
}

int convert_control_mode(Setup &s, int g)
{
    CHECK(s.comp_on(), "Cannot change control mode with cutter radius compensation on");
    if (g == G_61) {
        set_control_mode(s, CANON_EXACT_PATH, 0);
        return INTERP_OK;
    }
    if (g == G_61_1) {
        set_control_mode(s, CANON_EXACT_STOP, 0);
        return INTERP_OK;
    }
    const Block &b = s.block;
    const double p = b.value('p', -1), q = b.value('q', -1);
    const double tolerance = p >= 0 ? p : s.g64_default_tolerance;
    int planner = -1;
    double scale = -1;
    if (b.has('r')) {
        planner = b['r'] > 0;
        if (planner) scale = std::min(std::max(b['r'], 0.1), 1.0);
    }
    s.canon.SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, tolerance, planner, scale);
    s.control_mode = CANON_CONTINUOUS;
    s.tolerance = tolerance;
    set_naivecam(s, q >= 0 ? q : p >= 0 ? p : s.g64_default_naive);
    return INTERP_OK;
}

int convert_distance(Setup &s, int g)
{
    const int mode = g == G_90 ? MODE_ABSOLUTE : MODE_INCREMENTAL;
    if (mode == s.distance_mode) return INTERP_OK;
    enqueue_comment(s, mode == MODE_ABSOLUTE ? "interpreter: distance mode changed to absolute"
                                             : "interpreter: distance mode changed to incremental");
    s.distance_mode = mode;
    return INTERP_OK;
}

int convert_ijk(Setup &s, int g)
{
    const int mode = g == G_90_1 ? MODE_ABSOLUTE : MODE_INCREMENTAL;
    if (mode == s.ijk_distance_mode) return INTERP_OK;
    enqueue_comment(s, mode == MODE_ABSOLUTE ? "interpreter: IJK distance mode changed to absolute"
                                             : "interpreter: IJK distance mode changed to incremental");
    s.ijk_distance_mode = mode;
    return INTERP_OK;
}

int convert_retract(Setup &s, int g)
{
    CHECK(s.comp_on(), "Cannot change retract mode with cutter radius compensation on");
    s.retract_mode = g == G_98 ? OLD_Z : R_PLANE;
    enqueue_comment(s,
                    g == G_98 ? "interpreter: retract mode set to old_z" : "interpreter: retract mode set to r_plane");
    return INTERP_OK;
}

} // namespace ngc
