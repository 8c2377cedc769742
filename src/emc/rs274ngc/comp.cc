/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * comp.cc - G40 G41 G42 G41.1 G42.1.
 *
 * Thread: [task]
 * Source: cutter compensation sheet, sections 1 and 8
 */
#include "comp_queue.hh"
#include "stages.hh"

namespace ngc
{

int comp_off(Setup &s)
{
    TRY(finish_comp(s));
    enqueue_comment(s, "interpreter: cutter radius compensation off");
    if (s.comp_on() && s.comp_radius > 0 && !s.comp_first_move) {
        // The machine stays at the compensated end; the program goes on from its own.
        s.current.tran.x = s.program_x;
        s.current.tran.y = s.program_y;
        s.current.tran.z = s.program_z;
        s.arc_not_allowed = true;
    }
    s.comp_side = COMP_OFF;
    s.comp_first_move = true;
    s.queue->start_known = false;
    return INTERP_OK;
}

int convert_comp(Setup &s, int g)
{
    if (g == G_40) return comp_off(s);
    const Block &b = s.block;
    CHECK(s.plane != CANON_PLANE_XY && s.plane != CANON_PLANE_XZ,
          "Cutter radius compensation allowed only in XY, XZ planes");
    CHECK(s.comp_on(), "Cannot turn cutter radius comp on when on");
    int side = g == G_41 || g == G_41_1 ? COMP_LEFT : COMP_RIGHT;
    double radius;
    int orientation = 0;
    if (g == G_41_1 || g == G_42_1) {
        CHECK(!b.has('d'), "G%d.1 with no D word", g / 10);
        radius = b['d'] / 2;
        CHECK(b.has('l') && s.plane != CANON_PLANE_XZ, "G%d.1 with L word, but plane is not G18", g / 10);
        if (b.has('l')) orientation = int(b['l']);
    } else {
        int idx = 0;
        if (b.has('d')) {
            const double d = b['d'], whole = trunc(d + 0.5);
            CHECK(fabs(whole - d) >= TOLERANCE_INT || d < 0, "G%d requires D word to be a whole number", g / 10);
            if (whole != 0 || s.random_toolchanger) {
                idx = whole > 2e9 ? -1 : tool_index(s, int(whole));
                CHECK(idx < 0, "Requested tool %.0f not found in the tool table", whole);
            }
        }
        const CANON_TOOL_TABLE &t = s.tools[size_t(idx)];
        radius = s.from_machine_length(t.diameter) / 2;
        orientation = t.orientation;
        CHECK(orientation != 0 && orientation != 9 && s.plane != CANON_PLANE_XZ,
              "G%d with lathe tool, but plane is not G18", g / 10);
    }
    if (radius < 0) {
        radius = -radius;
        side = side == COMP_LEFT ? COMP_RIGHT : COMP_LEFT;
    }
    enqueue_comment(s, side == COMP_LEFT ? "interpreter: cutter radius compensation on left"
                                         : "interpreter: cutter radius compensation on right");
    s.comp_side = side;
    s.comp_radius = radius;
    s.comp_orientation = orientation;
    s.comp_first_move = true;
    s.queue->start_known = false;
    s.program_x = s.current.tran.x;
    s.program_y = s.current.tran.y;
    s.program_z = s.current.tran.z;
    return INTERP_OK;
}

} // namespace ngc
