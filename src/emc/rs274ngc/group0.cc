/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * group0.cc - G10, G28, G28.1, G30, G30.1, G52, G92: codes that hold for their line only.
 *
 * Thread: [task]
 * Source: G-codes sheet
 */
#include "stages.hh"

namespace ngc
{
namespace
{

double wrap_360(double angle)
{
    double a = fmod(angle, 360.0);
    return a < 0 ? a + 360.0 : a;
}

} // namespace

// Indexers move alone, before the others.
static void home_leg(Setup &s, const EmcPose &end)
{
    for (int n = 0; n < 3; ++n) {
        const int ax = AX_A + n;
        if (s.indexer_joint[n] < 0 || axis(end, ax) == axis(s.current, ax)) continue;
        EmcPose alone = s.current;
        axis(alone, ax) = axis(end, ax);
        move_indexer(s, line_of(s), n, alone);
    }
    traverse(s, line_of(s), end);
}

int convert_home(Setup &s, int g)
{
    const Block &b = s.block;
    CHECK(s.comp_on(), "Cannot use g28 or g30 with cutter radius comp");
    EmcPose end;
    TRY(find_ends(s, b, &end));
    home_leg(s, end);

    const int base = g == G_28 ? P_G28 : P_G30;
    EmcPose home{};
    for (int i = 0; i < AXES; ++i) axis(home, i) = s.from_machine(i, s.parameters[size_t(base + i)]);
    const EmcPose stored = from_absolute(s, home);
    end = s.current;
    if (b.any_axis()) {
        for (int i = 0; i < AXES; ++i)
            if (b.has_axis(i)) axis(end, i) = axis(stored, i);
    } else {
        end = stored;
    }
    // Wrapped axes go in the positive direction.
    for (int n = 0; n < 3; ++n) {
        const int ax = AX_A + n;
        if (!s.wrapped[n] || axis(end, ax) == axis(s.current, ax)) continue;
        axis(end, ax) = axis(s.current, ax) + wrap_360(axis(end, ax) - axis(s.current, ax));
    }
    s.stored_leg = true;
    home_leg(s, end);
    s.stored_leg = false;
    return INTERP_OK;
}

int store_home(Setup &s, int g)
{
    CHECK(s.comp_on(), "Cannot set reference point with cutter compensation in effect");
    const EmcPose absolute = absolute_position(s);
    const int base = g == G_28_1 ? P_G28 : P_G30;
    for (int i = 0; i < AXES; ++i) {
        double value = axis(absolute, i);
        if (i >= AX_A && i <= AX_C && s.wrapped[i - AX_A]) value = wrap_360(value);
        s.parameters[size_t(base + i)] = s.to_machine(i, value);
    }
    return INTERP_OK;
}

int convert_group0(Setup &s, int g)
{
    switch (g) {
    case G_10: {
        const double l = s.block['l'];
        return l == 2 || l == 20 ? convert_offset_data(s) : convert_tool_data(s);
    }
    case G_28: case G_30: return convert_home(s, g);
    case G_28_1: case G_30_1: return store_home(s, g);
    case G_52: case G_92: return convert_g92(s, g);
    case G_5_3: return convert_nurbs_end(s);
    case G_6_3: return s.block.motion == G_5_2 || s.block.motion == G_6_2
                           ? int(INTERP_OK)
                           : s.fail(__func__, "Bug bad g code modal group 0");
    }
    return INTERP_OK; // G4 has been done, G53 belongs to the motion
}

} // namespace ngc
