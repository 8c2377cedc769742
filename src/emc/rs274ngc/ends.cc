/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * ends.cc - where a move ends: distance modes, polar words, G53, wrapped axes, feed.
 *
 * Transformation (the one place that states it): absolute XY = R(rotation) * (current
 * + g92) + g5x + tool offset; other axes the same without the rotation.
 * Units:  program units, degrees
 * Thread: [task]
 * Source: G-code sheet, section 9
 */
#include "stages.hh"

namespace ngc
{
namespace
{

// G90 word of a wrapped rotary axis: the sign says the direction.
int wrapped_target(Setup &s, int ax, double word, double current, double *target)
{
    CHECK(word <= -360 || word >= 360, "Invalid absolute position %5.2f for wrapped rotary axis %c", word,
          AXIS_LETTERS[ax] - 32);
    double turns = floor(current / 360.0);
    double t = fabs(word) + 360.0 * turns;
    if (!std::signbit(word) && t < current) t += 360;
    if (std::signbit(word) && t > current) t -= 360;
    *target = t;
    return INTERP_OK;
}

int polar_end(Setup &s, const Block &b, EmcPose *end)
{
    const double x = s.current.tran.x, y = s.current.tran.y;
    double radius, angle; // angle in radians
    if (s.distance_mode == MODE_ABSOLUTE) {
        CHECK(!b.has('^') && x == 0 && y == 0, "Must specify angle in polar coordinate if at the origin");
        radius = b.has('@') ? b['@'] : hypot(x, y);
        angle = b.has('^') ? b['^'] * (M_PI / 180) : atan2(y, x);
    } else {
        CHECK(b.has('@') && x == 0 && y == 0,
              "Incremental motion with polar coordinates is indeterminate when at the origin");
        CHECK(x == 0 && y == 0, "G91 motion with polar coordinates is indeterminate when at the origin");
        radius = hypot(x, y) + (b.has('@') ? b['@'] : 0);
        angle = atan2(y, x) + (b.has('^') ? b['^'] * (M_PI / 180) : 0);
    }
    end->tran.x = radius * cos(angle);
    end->tran.y = radius * sin(angle);
    return INTERP_OK;
}

int machine_end(Setup &s, const Block &b, EmcPose *end)
{
    CHECK(b.present & POLAR_WORDS, "Cannot use polar coordinates with G53");
    *end = s.current;
    EmcPose target = absolute_position(s);
    for (int i = 0; i < AXES; ++i)
        if (b.has_axis(i)) axis(target, i) = b.axis_word(i);
    EmcPose there = from_absolute(s, target);
    // In a rotated system one word moves both X and Y.
    if (b.has('x') || b.has('y')) {
        end->tran.x = s.rotation != 0 || b.has('x') ? there.tran.x : s.current.tran.x;
        end->tran.y = s.rotation != 0 || b.has('y') ? there.tran.y : s.current.tran.y;
    }
    for (int i = AX_Z; i < AXES; ++i) {
        if (!b.has_axis(i)) continue;
        if (i < AX_A || i > AX_C || !s.wrapped[i - AX_A]) {
            axis(*end, i) = axis(there, i);
            continue;
        }
        const double offset = axis(s.g5x, i) + axis(s.g92, i) + axis(s.tool_offset, i);
        double absolute;
        TRY(wrapped_target(s, i, b.axis_word(i), axis(s.current, i) + offset, &absolute));
        axis(*end, i) = absolute - offset;
    }
    return INTERP_OK;
}

} // namespace

void rotate(double *x, double *y, double degrees)
{
    if (degrees == 0) return;
    const double t = degrees * (M_PI / 180), c = cos(t), n = sin(t);
    const double x0 = *x;
    *x = x0 * c - *y * n;
    *y = x0 * n + *y * c;
}

EmcPose absolute_position(const Setup &s)
{
    EmcPose p = s.current;
    for (int i = 0; i < AXES; ++i) axis(p, i) += axis(s.g92, i);
    rotate(&p.tran.x, &p.tran.y, s.rotation);
    for (int i = 0; i < AXES; ++i) axis(p, i) += axis(s.g5x, i) + axis(s.tool_offset, i);
    return p;
}

EmcPose from_absolute(const Setup &s, const EmcPose &absolute)
{
    EmcPose p = absolute;
    for (int i = 0; i < AXES; ++i) axis(p, i) -= axis(s.g5x, i) + axis(s.tool_offset, i);
    rotate(&p.tran.x, &p.tran.y, -s.rotation);
    for (int i = 0; i < AXES; ++i) axis(p, i) -= axis(s.g92, i);
    return p;
}

int find_ends(Setup &s, const Block &b, EmcPose *end)
{
    if (b.g_modes[GM_MODAL_0] == G_53) return machine_end(s, b, end);
    *end = s.current;
    // With compensation the words refer to the programmed contour.
    const bool on_contour = s.comp_on() && !s.comp_first_move;
    if (on_contour) {
        end->tran.x = s.program_x;
        end->tran.y = s.program_y;
        end->tran.z = s.program_z;
    }
    if (b.present & POLAR_WORDS) TRY(polar_end(s, b, end));
    if (!b.any_axis()) return INTERP_OK;
    if (s.distance_mode == MODE_INCREMENTAL) {
        for (int i = 0; i < AXES; ++i)
            if (b.has_axis(i)) axis(*end, i) += b.axis_word(i);
        return INTERP_OK;
    }
    for (int i = 0; i < AXES; ++i) {
        if (!b.has_axis(i)) continue;
        if (i >= AX_A && i <= AX_C && s.wrapped[i - AX_A])
            TRY(wrapped_target(s, i, b.axis_word(i), axis(s.current, i), &axis(*end, i)));
        else
            axis(*end, i) = b.axis_word(i);
    }
    return INTERP_OK;
}

double straight_length(const EmcPose &from, const EmcPose &to)
{
    double d[AXES];
    for (int i = 0; i < AXES; ++i) d[i] = axis(to, i) - axis(from, i);
    auto moves = [&](int i) { return fabs(d[i]) > TINY || fabs(d[i + 1]) > TINY || fabs(d[i + 2]) > TINY; };
    int first = moves(AX_X) ? AX_X : moves(AX_U) ? AX_U : AX_A;
    return sqrt(d[first] * d[first] + d[first + 1] * d[first + 1] + d[first + 2] * d[first + 2]);
}

void inverse_time_rate(Setup &s, double length)
{
    double rate = length == 0 ? 0.1 : length * s.block['f'];
    enqueue_feed_rate(s, rate);
    s.feed_rate = rate;
}

int check_feed(Setup &s, const char *zero_text, const char *no_f_text)
{
    if (s.feed_mode == INVERSE_TIME) {
        CHECK(!s.block.has('f'), "%s", no_f_text);
        return INTERP_OK;
    }
    CHECK(s.feed_rate == 0, "%s", zero_text);
    CHECK(s.feed_mode == UNITS_PER_REVOLUTION && s.speed[s.active_spindle] == 0,
          "Cannot feed with zero spindle speed in feed per rev mode");
    return INTERP_OK;
}

int check_indexers(Setup &s, const EmcPose &end, int g, int *indexer)
{
    *indexer = -1;
    for (int n = 0; n < 3; ++n) {
        int ax = AX_A + n;
        if (s.indexer_joint[n] < 0 || axis(end, ax) == axis(s.current, ax)) continue;
        const char letter = char(AXIS_LETTERS[ax] - 32);
        CHECK(g != G_0, "Indexing axis %c can only be moved with G0", letter);
        for (int i = 0; i < AXES; ++i)
            CHECK(i != ax && axis(end, i) != axis(s.current, i), "Indexing axis %c can only be moved alone", letter);
        *indexer = n;
    }
    return INTERP_OK;
}

void traverse(Setup &s, int line, const EmcPose &end)
{
    update_tag(s);
    s.canon.STRAIGHT_TRAVERSE(line, end);
    s.current = end;
}

void move_indexer(Setup &s, int line, int n, const EmcPose &end)
{
    exact_moves(s, true);
    s.canon.UNLOCK_ROTARY(line, s.indexer_joint[n]);
    traverse(s, line, end);
    s.canon.LOCK_ROTARY(line, s.indexer_joint[n]);
    exact_moves(s, false);
}

} // namespace ngc
