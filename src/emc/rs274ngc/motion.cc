/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * motion.cc - straight moves, probing, spindle-synchronised moves; which file does the rest.
 *
 * Thread: [task]
 * Source: G-codes sheet
 */
#include "stages.hh"

namespace ngc
{

int convert_motion(Setup &s, int g)
{
    switch (g) {
    case G_0: case G_1:
        s.cycle_il_flag = false;
        return convert_straight(s, g);
    case G_2: case G_3:
        s.cycle_il_flag = false;
        return convert_arc(s, g);
    case G_80:
        enqueue_comment(s, "interpreter: motion mode set to none");
        s.motion_mode = G_80;
        s.cycle_il_flag = false;
        return INTERP_OK;
    case G_38_2: case G_38_3: case G_38_4: case G_38_5:
        s.cycle_il_flag = false;
        return convert_probe(s, g);
    case G_33: case G_33_1:
        s.cycle_il_flag = false;
        return convert_spindle_synched(s, g);
    case G_76:
        s.cycle_il_flag = false;
        return convert_g76(s);
    case G_5: case G_5_1: case G_6: case G_6_1:
        s.cycle_il_flag = false;
        return convert_spline(s, g);
    case G_5_2:
        s.cycle_il_flag = false;
        return convert_nurbs_point(s, g);
    case G_6_2:
        s.cycle_il_flag = false;
        return convert_nurbs_g6(s, g);
    }
    if (is_g7x(g)) {
        s.cycle_il_flag = false;
        return convert_g7x(s, g);
    }
    if (is_drill_cycle(g)) return convert_cycle(s, g);
    FAIL("Bug unknown motion code");
}

int convert_straight(Setup &s, int g)
{
    s.arc_not_allowed = false;
    if (g == G_1) TRY(check_feed(s, "Cannot do g1 with zero feed rate", "F word missing with inverse time g1 move"));
    s.motion_mode = g;
    EmcPose end;
    TRY(find_ends(s, s.block, &end));
    int indexer;
    TRY(check_indexers(s, end, g, &indexer));

    if (__builtin_expect(s.comp_on() && s.comp_radius > 0, 0)) {
        CHECK(s.block.g_modes[GM_MODAL_0] == G_53, "Cannot use g53 with cutter radius comp");
        return comp_straight(s, g, end);
    }
    if (g == G_0) {
        if (__builtin_expect(indexer >= 0, 0))
            move_indexer(s, line_of(s), indexer, end);
        else
            traverse(s, line_of(s), end);
    } else {
        if (s.feed_mode == INVERSE_TIME) inverse_time_rate(s, straight_length(s.current, end));
        update_tag(s);
        s.canon.STRAIGHT_FEED(line_of(s), end);
        s.current = end;
    }
    if (s.comp_on()) {
        s.program_x = end.tran.x;
        s.program_y = end.tran.y;
        s.program_z = end.tran.z;
    }
    return INTERP_OK;
}

int convert_probe(Setup &s, int g)
{
    CHECK(s.comp_on(), "Cannot probe with cutter radius comp on");
    CHECK(s.feed_rate == 0, "Cannot probe with zero feed rate");
    CHECK(s.feed_mode == UNITS_PER_REVOLUTION, "Cannot probe with feed per rev mode");
    EmcPose end;
    TRY(find_ends(s, s.block, &end));
    bool same = true;
    for (int i = 0; i < AXES; ++i) same = same && axis(end, i) == axis(s.current, i);
    CHECK(same && (g == G_38_2 || g == G_38_4), "Start point too close to probe point");
    int indexer;
    TRY(check_indexers(s, end, g, &indexer));
    s.canon.TURN_PROBE_ON();
    update_tag(s);
    s.canon.STRAIGHT_PROBE(line_of(s), end, static_cast<unsigned char>(g - G_38_2));
    s.canon.TURN_PROBE_OFF();
    s.motion_mode = g;
    s.probe_flag = true;
    return INTERP_OK;
}

int convert_spindle_synched(Setup &s, int g)
{
    const Block &b = s.block;
    const char *name = g == G_33 ? "G33" : "G33.1";
    if (b.has('$')) {
        const int spindle = int(b['$']);
        CHECK(spindle < 0 || spindle >= s.num_spindles, "Invalid spindle ($) number in %s move", name);
        s.active_spindle = spindle;
    }
    s.motion_mode = g;
    CHECK(s.spindle_turning[s.active_spindle] == CANON_STOPPED, "Spindle not turning in %s", name);
    s.arc_not_allowed = false;
    EmcPose end;
    TRY(find_ends(s, b, &end));
    int indexer;
    TRY(check_indexers(s, end, g, &indexer));
    s.canon.START_SPEED_FEED_SYNCH(s.active_spindle, b['k'], false);
    if (g == G_33) {
        if (s.comp_on() && s.comp_radius > 0) {
            const int status = comp_straight(s, g, end);
            s.canon.STOP_SPEED_FEED_SYNCH();
            return status;
        }
        update_tag(s);
        s.canon.STRAIGHT_FEED(line_of(s), end);
        s.current = end;
    } else {
        const double scale = b.has('i') && b['i'] >= 1 ? b['i'] : 1.0;
        update_tag(s);
        s.canon.RIGID_TAP(line_of(s), end.tran.x, end.tran.y, end.tran.z, scale);
        // The tap comes back to where it started.
        for (int i = AX_A; i < AXES; ++i) axis(s.current, i) = axis(end, i);
    }
    s.canon.STOP_SPEED_FEED_SYNCH();
    return INTERP_OK;
}

} // namespace ngc
