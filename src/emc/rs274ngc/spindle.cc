/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * spindle.cc - G96 G97, S, M3 M4 M5 M19.
 *
 * Thread: [task]
 * Source: M-codes sheet, sections 2 and 5
 */
#include "stages.hh"

namespace ngc
{

int convert_spindle_mode(Setup &s)
{
    const Block &b = s.block;
    int spindle = 0;
    if (b.has('$')) {
        spindle = int(b['$']);
        CHECK(spindle < 0 || spindle >= s.num_spindles, "Invalid spindle ($) number in Spindle Mode command");
    }
    s.active_spindle = spindle;
    if (b.g_modes[GM_SPINDLE_MODE] == G_97) {
        enqueue_spindle_mode(s, spindle, 0);
        s.spindle_mode[spindle] = CONSTANT_RPM;
    } else {
        enqueue_spindle_mode(s, spindle, b.has('d') ? fabs(b['d']) : 1e30);
        s.spindle_mode[spindle] = CONSTANT_SURFACE;
    }
    return INTERP_OK;
}

int convert_speed(Setup &s)
{
    const Block &b = s.block;
    int first = 0, last = 0;
    if (b.has('$')) {
        first = last = int(b['$']);
        if (first == -1) first = 0, last = s.num_spindles - 1;
        CHECK(first < 0 || last >= s.num_spindles, "Invalid spindle ($) number in Spindle speed command");
    }
    for (int i = first; i <= last; ++i) {
        enqueue_spindle_speed(s, i, b['s']);
        s.speed[i] = b['s'];
    }
    return INTERP_OK;
}

namespace
{

int orient(Setup &s)
{
    const Block &b = s.block;
    for (int i = 0; i < s.num_spindles; ++i) s.spindle_turning[i] = CANON_STOPPED;
    int spindle = 0;
    if (b.has('$')) {
        spindle = int(b['$']);
        CHECK(spindle < 0 || spindle >= s.num_spindles, "Spindle ($) number out of range in M19 Command");
    }
    if (b.has('r') || b.has('p'))
        enqueue_orient(s, spindle, b.value('r', 0) + s.orient_offset, saturated(rint(b.value('p', 0))));
    if (b.has('q')) {
        CHECK(b['q'] <= 0, "Q word with M19 requires a value > 0");
        enqueue_wait_orient(s, spindle, b['q']);
    }
    return INTERP_OK;
}

} // namespace

int convert_spindle_codes(Setup &s, int m)
{
    const Block &b = s.block;
    switch (m) {
    case 3: case 4: case 5: {
        int first = 0, last = m == 5 ? s.num_spindles - 1 : 0;
        if (b.has('$')) {
            const int spindle = int(b['$']);
            CHECK(spindle < -1 || spindle >= s.num_spindles,
                  "Spindle ($) number out of range in M%d Command\nnum_spindles =%i. $=%d\n", m, s.num_spindles,
                  spindle);
            first = spindle == -1 ? 0 : spindle;
            last = spindle == -1 ? s.num_spindles - 1 : spindle;
        }
        for (int i = first; i <= last; ++i) {
            if (m == 5) {
                enqueue_spindle_stop(s, i);
                s.spindle_turning[i] = CANON_STOPPED;
            } else {
                s.spindle_turning[i] = m == 3 ? CANON_CLOCKWISE : CANON_COUNTERCLOCKWISE;
                enqueue_spindle_start(s, i, s.spindle_turning[i]);
            }
        }
        return INTERP_OK;
    }
    case 19:
        return orient(s);
    case 70:
        return save_modes(s, false);
    case 71:
        s.frame().modes.valid = s.frame().modes.restore_on_return = false;
        return INTERP_OK;
    case 72:
        CHECK(!s.frame().modes.valid, "Cannot restore context from invalid stack frame - missing M70/M73?");
        return restore_modes(s, s.frame().modes);
    case 73:
        if (s.call_level == 0) fprintf(stderr, "warning: M73 at top level has no effect\n");
        return save_modes(s, true);
    }
    return INTERP_OK;
}

} // namespace ngc
