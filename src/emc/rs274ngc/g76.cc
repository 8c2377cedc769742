/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * g76.cc - threading cycle.
 *
 * Thread: [task]
 * Source: cycles sheet, section 2
 */
#include <algorithm>

#include "stages.hh"

namespace ngc
{
namespace
{

struct Thread {
    Setup &s;
    double x0, z0;      // drive line, start
    double sign;        // +1 internal, -1 external
    double pitch, taper_pitch;
    double k, end_depth;
    double taper;       // length, signed
    bool entry, exit;
    double slope;       // tan of the compound angle, signed
    double target_z, i;

    void move(bool feed, double x, double z)
    {
        EmcPose end = s.current;
        end.tran.x = x;
        end.tran.z = z;
        if (!feed) {
            traverse(s, line_of(s), end);
            return;
        }
        update_tag(s);
        s.canon.STRAIGHT_FEED(line_of(s), end);
        s.current = end;
    }
    double x(double depth) const { return x0 + sign * depth; }

    void pass(double depth)
    {
        const double zoff = (depth - i) * slope;
        const double clear = x(depth - end_depth);
        const int spindle = s.active_spindle;
        move(false, clear, z0 - zoff);
        if (entry) {
            s.canon.DISABLE_FEED_OVERRIDE();
            s.canon.START_SPEED_FEED_SYNCH(spindle, taper_pitch, false);
            move(true, x(depth - k), z0 - zoff);
            move(true, x(depth), z0 - zoff - taper);
            s.canon.START_SPEED_FEED_SYNCH(spindle, pitch, false);
        } else {
            move(false, x(depth), z0 - zoff);
            s.canon.DISABLE_FEED_OVERRIDE();
            s.canon.START_SPEED_FEED_SYNCH(spindle, pitch, false);
        }
        if (exit) {
            move(true, x(depth), target_z - zoff + taper);
            s.canon.START_SPEED_FEED_SYNCH(spindle, taper_pitch, false);
            move(true, x(depth - k), target_z - zoff);
        } else {
            move(true, x(depth), target_z - zoff);
        }
        s.canon.STOP_SPEED_FEED_SYNCH();
        move(false, clear, target_z - zoff);
        if (s.feed_override) s.canon.ENABLE_FEED_OVERRIDE(); // as M48 to M50 left it
    }
};

enum { MAX_PASSES = 100000 };

} // namespace

int convert_g76(Setup &s)
{
    const Block &b = s.block;
    if (b.has('$')) {
        const int spindle = int(b['$']);
        CHECK(spindle < 0 || spindle >= s.num_spindles, "Invalid D-number in G76 cycle");
        s.active_spindle = spindle;
    }
    s.motion_mode = G_76;
    CHECK(s.spindle_turning[s.active_spindle] == CANON_STOPPED, "Chosen spindle (%i) not turning in G76",
          s.active_spindle);
    s.arc_not_allowed = false;
    EmcPose end;
    TRY(find_ends(s, b, &end));
    for (int i = AX_A; i < AXES; ++i)
        CHECK(axis(end, i) != axis(s.current, i), "Cannot move rotary axes with G76");
    CHECK(s.comp_on(), "Cannot use G76 threading cycle with cutter radius compensation on");
    const double scale = s.lathe_diameter ? 0.5 : 1.0;
    const double wi = b['i'] * scale, j = b['j'] * scale, k = b['k'] * scale;
    CHECK(wi == 0, "In G76, I must not be 0");
    CHECK(j <= 0, "In G76, J must be greater than 0");
    CHECK(k <= j, "In G76, K must be greater than J");

    Thread t{s, s.current.tran.x, s.current.tran.z, wi < 0 ? -1.0 : 1.0, b['p'], 0, k, 0, 0, false, false, 0, 0, 0};
    t.i = fabs(wi);
    t.end_depth = t.i + k;
    t.taper = b.value('e', 0);
    t.slope = tan(b.value('q', 0) * (M_PI / 180));
    if (end.tran.z > t.z0) {
        t.taper = -t.taper;
        t.slope = -t.slope;
    }
    const int flags = b.has('l') ? int(b['l']) : 0;
    const bool tapered = t.taper != 0; // L means nothing without E
    t.entry = tapered && flags & 1;
    t.exit = tapered && flags & 2;
    t.taper_pitch = tapered ? t.pitch * hypot(t.taper, k) / fabs(t.taper) : t.pitch;
    t.target_z = end.tran.z + k * t.slope;
    const double degression = b.has('r') && b['r'] >= 1 ? b['r'] : 1.0;
    const int spring = b.has('h') ? std::max(int(b['h']), 0) : 0;
    CHECK(!(pow(k / j, degression) <= MAX_PASSES), "J of G76 gives more than %d passes", MAX_PASSES);
    CHECK(spring > MAX_PASSES, "H of G76 gives more than %d passes", MAX_PASSES);

    double depth = t.i + j;
    for (int n = 1; depth < t.end_depth; depth = t.i + j * pow(++n, 1.0 / degression)) t.pass(depth);
    for (int n = 0; n <= spring; ++n) t.pass(t.end_depth);
    EmcPose last = s.current;
    last.tran.x = b.has('x') ? end.tran.x : t.x0;
    last.tran.y = end.tran.y;
    last.tran.z = end.tran.z;
    traverse(s, line_of(s), last);
    return INTERP_OK;
}

} // namespace ngc
