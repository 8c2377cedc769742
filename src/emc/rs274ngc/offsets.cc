/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * offsets.cc - coordinate systems: G54-G59.3, G10 L2 L20, G92 family, G52.
 *
 * Invariant: none of these moves the machine; the current point is re-expressed so
 *            that absolute_position() stays the same.
 * Thread: [task]
 * Source: G-codes sheet; G-code sheet, section 9
 */
#include "stages.hh"

namespace ngc
{
namespace
{

size_t system_parameter(int system, int ax) { return size_t(P_G5X_BASE + 20 * system + ax); }
size_t rotation_parameter(int system) { return size_t(P_G5X_BASE + 20 * system + AXES); }

EmcPose pose_from_parameters(const Setup &s, size_t first)
{
    EmcPose p{};
    for (int i = 0; i < AXES; ++i) axis(p, i) = s.from_machine(i, s.parameters[first + size_t(i)]);
    return p;
}

void store_g92(Setup &s)
{
    for (int i = 0; i < AXES; ++i) s.parameters[size_t(P_G92 + i)] = s.to_machine(i, axis(s.g92, i));
}

int check_wrapped_words(Setup &s, const Block &b)
{
    for (int n = 0; n < 3; ++n)
        if (s.wrapped[n] && b.has_axis(AX_A + n)) {
            const double word = b.axis_word(AX_A + n);
            CHECK(word <= -360 || word >= 360, "Invalid absolute position %5.2f for wrapped rotary axis %c", word,
                  'A' + n);
        }
    return INTERP_OK;
}

} // namespace

int convert_coord_system(Setup &s, int g)
{
    CHECK(s.comp_on(), "Cannot change coordinate systems with cutter radius compensation on");
    const int system = g <= G_59 ? (g - G_54) / 10 + 1 : g - G_59_1 + 7;
    if (system == s.origin_index) {
        enqueue_comment(s, "interpreter: continuing to use same coordinate system");
        return INTERP_OK;
    }
    const EmcPose absolute = absolute_position(s);
    s.origin_index = system;
    s.parameters[P_COORD_SYSTEM] = system;
    s.g5x = pose_from_parameters(s, system_parameter(system, 0));
    s.rotation = s.parameters[rotation_parameter(system)];
    s.g92 = s.parameters[P_G92_APPLIED] != 0 ? pose_from_parameters(s, P_G92) : EmcPose{};
    s.current = from_absolute(s, absolute);
    s.canon.SET_G5X_OFFSET(system, s.g5x);
    s.canon.SET_G92_OFFSET(s.g92);
    s.canon.SET_XY_ROTATION(s.rotation);
    return INTERP_OK;
}

int convert_offset_data(Setup &s)
{
    const Block &b = s.block;
    const bool l20 = b['l'] == 20;
    CHECK(l20 && b.has('r'), "R not allowed in G10 L20");
    CHECK(!l20 && (b.has('i') || b.has('j')), "I J words not allowed with G10 L2");
    int system = int(b['p'] + TOLERANCE_INT); // the check lets fractions above one half pass
    if (system == 0) system = s.origin_index;
    CHECK(system == s.origin_index && s.comp_on(),
          "Cannot change the active coordinate system with cutter radius compensation on");
    if (l20) TRY(check_wrapped_words(s, b));

    const EmcPose absolute = absolute_position(s);
    EmcPose origin = pose_from_parameters(s, system_parameter(system, 0));
    double rotation = s.parameters[rotation_parameter(system)];
    if (l20) {
        // The current point in that system, as its words would have to name it.
        EmcPose here = absolute;
        const EmcPose g92 = s.parameters[P_G92_APPLIED] != 0 ? pose_from_parameters(s, P_G92) : EmcPose{};
        for (int i = 0; i < AXES; ++i) axis(here, i) -= axis(origin, i) + axis(s.tool_offset, i);
        rotate(&here.tran.x, &here.tran.y, -rotation);
        for (int i = 0; i < AXES; ++i) axis(here, i) -= axis(g92, i);
        EmcPose shift{};
        for (int i = 0; i < AXES; ++i)
            if (b.has_axis(i)) axis(shift, i) = axis(here, i) - b.axis_word(i);
        rotate(&shift.tran.x, &shift.tran.y, rotation);
        for (int i = 0; i < AXES; ++i) axis(origin, i) += axis(shift, i);
    } else {
        if (b.has('r')) s.parameters[rotation_parameter(system)] = rotation = b['r'];
        for (int i = 0; i < AXES; ++i)
            if (b.has_axis(i)) axis(origin, i) = b.axis_word(i);
    }
    const bool xy_together = l20 && rotation != 0 && (b.has('x') || b.has('y'));
    for (int i = 0; i < AXES; ++i)
        if (b.has_axis(i) || (xy_together && i <= AX_Y))
            s.parameters[system_parameter(system, i)] = s.to_machine(i, axis(origin, i));

    if (system != s.origin_index) {
        enqueue_comment(s, "interpreter: setting coordinate system origin");
        return INTERP_OK;
    }
    s.g5x = origin;
    s.rotation = rotation;
    s.current = from_absolute(s, absolute);
    s.canon.SET_G5X_OFFSET(system, s.g5x);
    s.canon.SET_XY_ROTATION(s.rotation);
    return INTERP_OK;
}

int convert_g92(Setup &s, int g)
{
    const Block &b = s.block;
    if (s.comp_on()) {
        if (g != G_92 && g != G_52) return INTERP_OK; // the family's other codes are ignored then
        FAIL("Cannot change axis offsets with cutter radius comp");
    }
    if (g == G_92 || g == G_52) {
        TRY(check_wrapped_words(s, b));
        for (int i = 0; i < AXES; ++i) {
            if (!b.has_axis(i)) continue;
            const double before = axis(s.current, i) + axis(s.g92, i);
            if (g == G_92) {
                axis(s.current, i) = b.axis_word(i);
                axis(s.g92, i) = before - b.axis_word(i);
            } else {
                axis(s.g92, i) = b.axis_word(i);
                axis(s.current, i) = before - b.axis_word(i);
            }
        }
        s.parameters[P_G92_APPLIED] = 1;
        store_g92(s);
        s.canon.SET_G92_OFFSET(s.g92);
        return INTERP_OK;
    }
    const EmcPose fresh = g == G_92_3 ? pose_from_parameters(s, P_G92) : EmcPose{};
    for (int i = 0; i < AXES; ++i) axis(s.current, i) += axis(s.g92, i) - axis(fresh, i);
    s.g92 = fresh;
    s.parameters[P_G92_APPLIED] = g == G_92_3;
    if (g == G_92_1) store_g92(s);
    s.canon.SET_G92_OFFSET(s.g92);
    return INTERP_OK;
}

} // namespace ngc
