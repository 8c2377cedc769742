/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * inference.cc - which motion a block makes, and what its axis words belong to.
 *
 * In:     s.block, motion mode, plane
 * Out:    s.block.motion
 * Thread: [task]
 * Source: G-code sheet, section 7
 */
#include "remap.hh"
#include "stages.hh"

namespace ngc
{
namespace
{

// Motion codes that may stand without axis words.
bool may_lack_axes(const Setup &s, int g)
{
    switch (g) {
    case G_0: case G_1: case G_2: case G_3: case G_5_2: case G_6_2:
        return true;
    }
    return is_g7x(g) || (s.remaps && s.remaps->g(g));
}

// G52 counts axis words alone, G92 polar words too (to refuse them next).
bool lacks_axes(const Block &b, int group0)
{
    return !b.any_axis() && (group0 == G_52 || (group0 == G_92 && !(b.present & POLAR_WORDS)));
}

constexpr bool takes_axis_words(int group0)
{
    return group0 == G_10 || group0 == G_28 || group0 == G_30 || group0 == G_52 || group0 == G_92;
}

int check_polar(Setup &s, const Block &b)
{
    CHECK(s.plane != CANON_PLANE_XY, "Cannot use polar coordinate except in G17 plane");
    CHECK(b.has('x'), "Cannot specify both polar coordinate and X word");
    CHECK(b.has('y'), "Cannot specify both polar coordinate and Y word");
    CHECK((s.axis_mask & 3) != 3, "Cannot use polar coordinate on a machine lacking X or Y axes");
    return INTERP_OK;
}

} // namespace

int infer_motion(Setup &s)
{
    Block &b = s.block;
    const bool axes = b.any_axis();
    const bool polar = b.present & POLAR_WORDS;
    const int group0 = b.g_modes[GM_MODAL_0];
    const int code = b.g_modes[GM_MOTION];
    const bool taken = takes_axis_words(group0);

    if (polar) TRY(check_polar(s, b));

    if (code == G_80) {
        CHECK((axes || polar) && !taken, "Cannot use axis values with g80");
        CHECK(lacks_axes(b, group0), "All axes missing with g52 or g92");
        CHECK(polar && group0 == G_92, "Polar coordinates can only be used for motion");
        b.motion = code;
    } else if (code != -1) {
        CHECK(taken, "Cannot use two g codes that both use axis values");
        CHECK(!axes && !polar && !may_lack_axes(s, code), "All axes missing with motion code");
        b.motion = code;
    } else if (taken) {
        CHECK(lacks_axes(b, group0), "All axes missing with g52 or g92");
        CHECK(polar, "Polar coordinates can only be used for motion");
    } else if (axes || polar) {
        const int length_code = b.g_modes[GM_TOOL_LENGTH];
        CHECK((s.motion_mode == -1 || s.motion_mode == G_80) && length_code != G_43_1 && length_code != G_43_2,
              "Cannot use axis values without a g code that uses them");
        if (length_code != G_43_1) b.motion = s.motion_mode;
        CHECK(polar && b.motion == -1, "Polar coordinates can only be used for motion");
    } else if ((b.present & IJK_WORDS) && (s.motion_mode == G_2 || s.motion_mode == G_3)) {
        b.motion = s.motion_mode;
    }
    return INTERP_OK;
}

} // namespace ngc
