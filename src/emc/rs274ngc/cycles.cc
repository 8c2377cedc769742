/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * cycles.cc - drilling, boring and tapping cycles: G73 G74 G81-G89.
 *
 * Method: the axes are named by their part: aa and bb span the plane, cc is the drill
 *         axis; "down" is smaller cc, or greater with [RS274NGC]CYCLES_BOTH_WAYS = 1
 *         when R is below the bottom (back counterbores, angle heads).
 * Thread: [task]
 * Source: cycles sheet, section 1
 */
#include "stages.hh"

namespace ngc
{
namespace
{

struct CyclePlane {
    int aa, bb, cc;
    char aa_offset, bb_offset, middle; // words of G87
    const char *cc_missing;
    const char *cc_axis; // "G17 ... Z axis"
    const char *r_below;
    const char *name;    // of the plane in the texts about foreign axes
};

const CyclePlane &cycle_plane(CANON_PLANE plane)
{
    static const CyclePlane planes[] = {
        {AX_X, AX_Y, AX_Z, 'i', 'j', 'k', "Z value unspecified in xy plane canned cycle",
         "G17 canned cycle is not possible on a machine without Z axis", "R less than z in cycle in xy plane", "XY"},
        {AX_Y, AX_Z, AX_X, 'j', 'k', 'i', "X value unspecified in yz plane canned cycle",
         "G19 canned cycle is not possible on a machine without X axis", "R less than x in cycle in yz plane", "YZ"},
        {AX_Z, AX_X, AX_Y, 'k', 'i', 'j', "Y value unspecified in xz plane canned cycle",
         "G18 canned cycle is not possible on a machine without Y axis", "R less than y in cycle in xz plane", "XZ"},
        {AX_U, AX_V, AX_W, 'i', 'j', 'k', "W value unspecified in UV plane canned cycle",
         "G17.1 canned cycle is not possible on a machine without W axis", "R less than W in cycle in UV plane", "UV"},
        {AX_V, AX_W, AX_U, 'j', 'k', 'i', "U value unspecified in VW plane canned cycle",
         "G19.1 canned cycle is not possible on a machine without U axis", "R less than U in cycle in VW plane", "VW"},
        {AX_W, AX_U, AX_V, 'k', 'i', 'j', "V value unspecified in UW plane canned cycle",
         "G18.1 canned cycle is not possible on a machine without V axis", "R less than V in cycle in UW plane", "UW"},
    };
    return planes[plane - CANON_PLANE_XY];
}

/// One cycle under way: its levels and its moves.
struct Cycle {
    Setup &s;
    const CyclePlane &p;
    double aa, bb;
    double r, bottom, clear;
    double down = 1; // -1: the drill goes toward greater cc
    long moves = 0;

    bool above(double a, double b) const { return (a - b) * down > 0; }

    void move(bool feed, double a, double b, double c)
    {
        EmcPose end = s.current;
        axis(end, p.aa) = a;
        axis(end, p.bb) = b;
        axis(end, p.cc) = c;
        ++moves;
        if (!feed) {
            traverse(s, line_of(s), end);
            return;
        }
        update_tag(s);
        s.canon.STRAIGHT_FEED(line_of(s), end);
        s.current = end;
    }
    void rapid(double c) { move(false, aa, bb, c); }
    void feed(double c) { move(true, aa, bb, c); }
};

int drill(Cycle &c)
{
    c.feed(c.bottom);
    c.rapid(c.clear);
    return INTERP_OK;
}

int drill_dwell(Cycle &c)
{
    c.feed(c.bottom);
    c.s.canon.DWELL(c.s.cycle_p);
    c.rapid(c.clear);
    return INTERP_OK;
}

// What one line may ask for, even when Q is absurdly small against the depth.
enum { MAX_PECKS = 100000, MAX_MOVES = 1000000 };

int peck(Cycle &c, bool chip_break)
{
    Setup &s = c.s;
    const double q = s.cycle_q;
    CHECK(q <= 0, "Negative or zero q value used");
    const double gap = s.block.has('d') ? s.block['d'] : chip_break ? s.peck_g73 : s.peck_g83;
    CHECK(!(fabs(c.r - c.bottom) / q <= MAX_PECKS), "Q word gives more than %d pecks", MAX_PECKS);
    for (double depth = c.r - q * c.down; c.above(depth, c.bottom); depth -= q * c.down) {
        c.feed(depth);
        if (!chip_break) c.rapid(c.r);
        c.rapid(depth + gap * c.down);
    }
    c.feed(c.bottom);
    c.rapid(c.clear);
    return INTERP_OK;
}

void start_spindle(Setup &s, int spindle, CANON_DIRECTION direction)
{
    if (direction == CANON_CLOCKWISE) s.canon.START_SPINDLE_CLOCKWISE(spindle);
    else s.canon.START_SPINDLE_COUNTERCLOCKWISE(spindle);
}

// G84 right-hand, G74 left-hand tapping with a floating chuck.
int tap(Cycle &c, bool left)
{
    Setup &s = c.s;
    const char *name = left ? "G74" : "G84";
    CHECK(s.plane >= CANON_PLANE_UV, "%s for plane %s not implemented", name, c.p.name);
    const int spindle = s.active_spindle;
    const CANON_DIRECTION in = left ? CANON_COUNTERCLOCKWISE : CANON_CLOCKWISE;
    const CANON_DIRECTION out = left ? CANON_CLOCKWISE : CANON_COUNTERCLOCKWISE;
    CHECK(s.spindle_turning[spindle] == CANON_STOPPED, "Spindle not turning in %s", name);
    CHECK(s.spindle_turning[spindle] != in, "Spindle turning %s in %s", left ? "clockwise" : "counterclockwise",
          name);
    const bool feed_override = s.feed_override, speed_override = s.speed_override[spindle];
    // What the machine itself says: in a controller it lags behind the program.
    const bool feed_was_on = s.canon.GET_EXTERNAL_FEED_OVERRIDE_ENABLE();
    const bool speed_was_on = s.canon.GET_EXTERNAL_SPINDLE_OVERRIDE_ENABLE(spindle);
    s.canon.DISABLE_FEED_OVERRIDE();
    s.canon.DISABLE_SPEED_OVERRIDE(spindle);
    c.feed(c.bottom);
    s.canon.STOP_SPINDLE_TURNING(spindle);
    start_spindle(s, spindle, out);
    s.canon.DWELL(s.cycle_p);
    c.feed(c.clear);
    s.canon.STOP_SPINDLE_TURNING(spindle);
    start_spindle(s, spindle, in);
    if (feed_override) s.canon.ENABLE_FEED_OVERRIDE();
    else if (feed_was_on) s.canon.DISABLE_FEED_OVERRIDE();
    if (speed_override) s.canon.ENABLE_SPEED_OVERRIDE(spindle);
    else if (speed_was_on) s.canon.DISABLE_SPEED_OVERRIDE(spindle);
    return INTERP_OK;
}

int bore(Cycle &c)
{
    c.feed(c.bottom);
    c.feed(c.r);
    c.rapid(c.clear);
    return INTERP_OK;
}

int bore_stop(Cycle &c)
{
    Setup &s = c.s;
    const int spindle = s.active_spindle;
    const CANON_DIRECTION direction = s.spindle_turning[spindle];
    CHECK(direction == CANON_STOPPED, "Spindle not turning in g86");
    c.feed(c.bottom);
    s.canon.DWELL(s.cycle_p);
    s.canon.STOP_SPINDLE_TURNING(spindle);
    c.rapid(c.clear);
    start_spindle(s, spindle, direction);
    return INTERP_OK;
}

int back_bore(Cycle &c)
{
    Setup &s = c.s;
    const int spindle = s.active_spindle;
    const CANON_DIRECTION direction = s.spindle_turning[spindle];
    CHECK(direction == CANON_STOPPED, "Spindle not turning in g87");
    double offset[26] = {};
    offset['i' - 'a'] = s.cycle_i;
    offset['j' - 'a'] = s.cycle_j;
    offset['k' - 'a'] = s.cycle_k;
    const double aside_a = c.aa + offset[c.p.aa_offset - 'a'], aside_b = c.bb + offset[c.p.bb_offset - 'a'];
    double middle = offset[c.p.middle - 'a'];
    if (s.distance_mode == MODE_INCREMENTAL) middle += c.bottom;
    const int turn = direction == CANON_CLOCKWISE ? 2 : 3;
    c.move(false, aside_a, aside_b, c.r);
    s.canon.STOP_SPINDLE_TURNING(spindle);
    s.canon.ORIENT_SPINDLE(spindle, 0, turn);
    c.move(false, aside_a, aside_b, c.bottom);
    c.move(false, c.aa, c.bb, c.bottom);
    start_spindle(s, spindle, direction);
    c.feed(middle);
    c.feed(c.bottom);
    s.canon.STOP_SPINDLE_TURNING(spindle);
    s.canon.ORIENT_SPINDLE(spindle, 0, turn);
    c.move(false, aside_a, aside_b, c.bottom);
    c.move(false, aside_a, aside_b, c.clear);
    c.rapid(c.clear);
    start_spindle(s, spindle, direction);
    return INTERP_OK;
}

int bore_manual(Cycle &c)
{
    Setup &s = c.s;
    const int spindle = s.active_spindle;
    const CANON_DIRECTION direction = s.spindle_turning[spindle];
    CHECK(direction == CANON_STOPPED, "Spindle not turning in g88");
    c.feed(c.bottom);
    s.canon.DWELL(s.cycle_p);
    s.canon.STOP_SPINDLE_TURNING(spindle);
    s.canon.PROGRAM_STOP();
    start_spindle(s, spindle, direction);
    axis(s.current, c.p.cc) = c.clear; // the operator retracts
    return INTERP_OK;
}

int bore_dwell(Cycle &c)
{
    c.feed(c.bottom);
    c.s.canon.DWELL(c.s.cycle_p);
    c.feed(c.clear);
    return INTERP_OK;
}

int run_body(Cycle &c, int g)
{
    switch (g) {
    case G_73: return peck(c, true);
    case G_83: return peck(c, false);
    case G_74: return tap(c, true);
    case G_84: return tap(c, false);
    case G_81: return drill(c);
    case G_82: return drill_dwell(c);
    case G_85: return bore(c);
    case G_86: return bore_stop(c);
    case G_87: return back_bore(c);
    case G_88: return bore_manual(c);
    default: return bore_dwell(c);
    }
}

// A word of the line, else the sticky value, which only a series may use.
bool take_sticky(const Block &b, char word, bool first_use, double *sticky, bool minus_one_is_none = false)
{
    if (b.has(word) && !(minus_one_is_none && b[word] == -1)) {
        *sticky = b[word];
        return true;
    }
    return !first_use;
}

// P, Q, I, J, K: what the code needs on its first use; the spindle.
int take_words(Setup &s, int g, bool first_use)
{
    const Block &b = s.block;
    const bool have_p = take_sticky(b, 'p', first_use, &s.cycle_p, true);
    switch (g) {
    case G_82: case G_86: case G_88: case G_89:
        CHECK(!have_p, "Dwell time p word missing with g%d", g / 10);
        break;
    case G_73: case G_83:
        CHECK(!take_sticky(b, 'q', first_use, &s.cycle_q, true), "Q word missing with g%d", g / 10);
        break;
    case G_74: case G_84:
        if (b.has('$')) {
            const int spindle = int(b['$']);
            CHECK(spindle < 0 || spindle >= s.num_spindles, "Invalid %s in G74/G84 cycle",
                  s.plane == CANON_PLANE_XZ ? "E-number" : "spindle ($) number");
            s.active_spindle = spindle;
        }
        break;
    case G_87:
        CHECK(!take_sticky(b, 'i', first_use, &s.cycle_i), "I word missing with g87");
        CHECK(!take_sticky(b, 'j', first_use, &s.cycle_j), "J word missing with g87");
        CHECK(!take_sticky(b, 'k', first_use, &s.cycle_k), "K word missing with g87");
        break;
    }
    return INTERP_OK;
}

// Axis words of the other triple have no place in a cycle.
int check_foreign_axes(Setup &s, const CyclePlane &p)
{
    const Block &b = s.block;
    const bool xyz = p.cc <= AX_Z;
    static const char *const xyz_words[] = {"an X", "a Y", "a Z"}, *const uvw_words[] = {"a U", "a V", "a W"};
    for (int i = 0; i < 3; ++i)
        CHECK(b.has_axis(xyz ? AX_U + i : AX_X + i), "Cannot put %s in a canned cycle in the %s plane",
              (xyz ? uvw_words : xyz_words)[i], p.name);
    return INTERP_OK;
}

// Polar words give aa and bb in the XY plane.
int take_polar(Setup &s, double *aa, double *bb)
{
    EmcPose end;
    TRY(find_ends(s, s.block, &end));
    const bool incremental = s.distance_mode == MODE_INCREMENTAL;
    *aa = incremental ? end.tran.x - s.current.tran.x : end.tran.x;
    *bb = incremental ? end.tran.y - s.current.tran.y : end.tran.y;
    return INTERP_OK;
}

} // namespace

int convert_cycle(Setup &s, int g)
{
    Block &b = s.block;
    const CyclePlane &p = cycle_plane(s.plane);
    const bool first_use = s.motion_mode != g;
    CHECK(s.feed_rate == 0, "Cannot feed with zero feed rate");
    CHECK(s.feed_mode == INVERSE_TIME, "Cannot use inverse time feed with canned cycles");
    CHECK(s.comp_on(), "Cannot use canned cycles with cutter compensation on");
    CHECK(first_use && !b.has('r'), "R clearance plane unspecified in cycle");
    CHECK(b.has('l') && b['l'] == 0, "Cannot do zero repeats of cycle");
    s.cycle_r = b.value('r', s.cycle_r);
    s.cycle_l = b.has('l') ? int(b['l']) : 1;
    TRY(check_foreign_axes(s, p));
    CHECK(!(s.axis_mask & (1 << p.cc)), "%s", p.cc_axis);
    if (b.has_axis(p.cc)) s.cycle_cc = b.axis_word(p.cc);
    else CHECK(first_use, "%s", p.cc_missing);

    double aa_step = 0, bb_step = 0;
    const bool incremental = s.distance_mode == MODE_INCREMENTAL;
    double aa = axis(s.current, p.aa), bb = axis(s.current, p.bb);
    double level = s.cycle_il_flag ? s.cycle_il : axis(s.current, p.cc); // initial level
    double r = s.cycle_r, bottom = s.cycle_cc;
    if (incremental) {
        aa_step = b.has_axis(p.aa) ? b.axis_word(p.aa) : 0;
        bb_step = b.has_axis(p.bb) ? b.axis_word(p.bb) : 0;
        r += level;
        bottom += r;
    } else {
        if (b.has_axis(p.aa)) aa = b.axis_word(p.aa);
        if (b.has_axis(p.bb)) bb = b.axis_word(p.bb);
    }
    CHECK(r < bottom && !s.cycles_both_ways, "%s", p.r_below);
    if (!s.cycle_il_flag) {
        s.cycle_il = level;
        s.cycle_il_flag = true;
    }
    Cycle c{s, p, axis(s.current, p.aa), axis(s.current, p.bb), r, bottom, 0, r < bottom ? -1.0 : 1.0};
    if (c.above(r, level)) {
        c.rapid(r);
        level = r;
    }
    c.clear = s.retract_mode == R_PLANE ? r : level;

    exact_moves(s, true);
    if (b.present & POLAR_WORDS) TRY(take_polar(s, incremental ? &aa_step : &aa, incremental ? &bb_step : &bb));
    TRY(take_words(s, g, first_use));
    c.aa = aa;
    c.bb = bb;
    for (int repeat = 0; repeat < s.cycle_l; ++repeat) {
        c.aa += aa_step;
        c.bb += bb_step;
        const double height = axis(s.current, p.cc);
        if (repeat == 0 && c.above(height, r)) {
            c.rapid(height);
            c.rapid(r);
        } else {
            c.rapid(c.clear);
            if (c.above(c.clear, r)) c.rapid(r);
        }
        TRY(run_body(c, g));
        CHECK(c.moves > MAX_MOVES, "L word makes more than %d moves", MAX_MOVES);
    }
    axis(s.current, p.cc) = c.clear;
    s.motion_mode = g;
    exact_moves(s, false);
    return INTERP_OK;
}

} // namespace ngc
