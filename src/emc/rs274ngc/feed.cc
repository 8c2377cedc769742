/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * feed.cc - G93 G94 G95 and the F word.
 *
 * Thread: [task]
 * Source: M-codes sheet, section 1
 */
#include "stages.hh"

namespace ngc
{

int convert_feed_mode(Setup &s)
{
    const Block &b = s.block;
    int spindle = 0;
    if (b.has('$')) {
        spindle = int(b['$']);
        CHECK(spindle < 0 || spindle >= s.num_spindles, "Invalid spindle ($) number in Spindle Feed command");
    }
    s.active_spindle = spindle;
    switch (b.g_modes[GM_FEED]) {
    case G_93:
        enqueue_comment(s, "interpreter: feed mode set to inverse time");
        s.feed_mode = INVERSE_TIME;
        enqueue_feed_mode(s, 0, 0);
        return INTERP_OK;
    case G_94:
        enqueue_comment(s, "interpreter: feed mode set to units per minute");
        s.feed_mode = UNITS_PER_MINUTE;
        enqueue_feed_mode(s, 0, 0);
        break;
    case G_95:
        enqueue_comment(s, "interpreter: feed mode set to units per revolution");
        s.feed_mode = UNITS_PER_REVOLUTION;
        enqueue_feed_mode(s, spindle, 1);
        break;
    }
    s.feed_rate = 0;
    enqueue_feed_rate(s, 0);
    return INTERP_OK;
}

int convert_feed_rate(Setup &s)
{
    const double f = s.block['f'];
    s.last_f = f;
    if (s.feed_mode == INVERSE_TIME) return INTERP_OK; // belongs to the move
    enqueue_feed_rate(s, f);
    s.feed_rate = f;
    return INTERP_OK;
}

} // namespace ngc
