/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * nurbs.cc - splines and NURBS: G5 G5.1 (G6 G6.1), G5.2 G5.3, G6.2.
 *
 * In:     the block's words; control points are collected over several blocks
 * Out:    NURBS_G5_FEED, NURBS_G6_FEED
 * Thread: [task]
 * Source: cycles sheet, sections 4 to 6
 */
#include "nurbs.hh"

#include "arc.hh"
#include "stages.hh"

namespace ngc
{
namespace
{

// Plane coordinates of control points: X,Y; Y,Z; X,Z.
struct SplinePlane {
    int first, second;
    char first_letter, second_letter;
};

bool spline_plane(CANON_PLANE plane, SplinePlane *p)
{
    switch (plane) {
    case CANON_PLANE_XY: *p = {AX_X, AX_Y, 'X', 'Y'}; return true;
    case CANON_PLANE_YZ: *p = {AX_Y, AX_Z, 'Y', 'Z'}; return true;
    case CANON_PLANE_XZ: *p = {AX_X, AX_Z, 'X', 'Z'}; return true;
    default: return false;
    }
}

NURBS_CONTROL_POINT point(const EmcPose &p, const SplinePlane &plane, double w)
{
    return {axis(p, plane.first), axis(p, plane.second), w};
}

void end_at(Setup &s, const EmcPose &end, const SplinePlane &plane)
{
    axis(s.current, plane.first) = axis(end, plane.first);
    axis(s.current, plane.second) = axis(end, plane.second);
}

} // namespace

int convert_spline(Setup &s, int g)
{
    const Block &b = s.block;
    CHECK(s.comp_on(), "Cannot convert spline with cutter radius compensation");
    if (s.feed_mode != UNITS_PER_REVOLUTION) // not checked there
        TRY(check_feed(s, "Cannot make arc with zero feed rate", "F word missing with inverse time arc move"));
    CHECK(b.has('a') || b.has('b') || b.has('c'), "Splines may not have motion in A, B, or C");
    SplinePlane plane;
    CHECK(!spline_plane(s.plane, &plane), "Cannot do an arc in planes G17.1, G18.1, or G19.1");
    EmcPose end;
    TRY(find_ends(s, b, &end));
    const NURBS_CONTROL_POINT start = point(s.current, plane, 1);
    const NURBS_CONTROL_POINT last = point(end, plane, 1);
    if (g == G_5_1 || g == G_6_1) {
        CHECK(!b.has('i') || !b.has('j'), "Must specify both I and J with G5.1 or G6.1");
        const NURBS_CONTROL_POINT middle = {start.x + b['i'], start.y + b['j'], 1};
        update_tag(s);
        s.canon.NURBS_G5_FEED(line_of(s), {start, middle, last}, 3, s.plane);
    } else {
        CHECK(b.has('i') != b.has('j'), "Must specify both I and J, or neither");
        CHECK(!b.has('p') || !b.has('q'), "Must specify both P and Q with G5");
        // Without I and J the curve goes on smoothly from the G5 before.
        const double i = b.has('i') ? b['i'] : -s.cycle_i, j = b.has('j') ? b['j'] : -s.cycle_j;
        const bool swapped = s.plane == CANON_PLANE_XZ; // P belongs to Z there
        const double p = swapped ? b['q'] : b['p'], q = swapped ? b['p'] : b['q'];
        update_tag(s);
        s.canon.NURBS_G5_FEED(line_of(s), {start, {start.x + i, start.y + j, 1}, {last.x + p, last.y + q, 1}, last}, 4,
                              s.plane);
        s.cycle_i = p;
        s.cycle_j = q;
    }
    end_at(s, end, plane);
    return INTERP_OK;
}

int convert_nurbs_point(Setup &s, int g)
{
    const Block &b = s.block;
    Nurbs &n = *s.nurbs;
    SplinePlane plane;
    CHECK(!spline_plane(s.plane, &plane), "one plane must be selected for nurbs: XY, YZ, ZX");
    if (s.motion_mode != G_5_2) {
        n.points.clear();
        n.order = 3;
    }
    const bool first = n.points.empty();
    const bool have_a = b.has_axis(plane.first), have_b = b.has_axis(plane.second);
    CHECK(have_a != have_b, "You must specify both %c and %c coordinates for Control Points", plane.first_letter,
          plane.second_letter);
    CHECK(!first && b.has('p') && !have_a, "Can specify P without %c and %c only for the first control point",
          plane.first_letter, plane.second_letter);
    CHECK(!first && b.value('p', -1) <= 0, "Must specify positive weight P for every Control Point");
    CHECK(s.feed_mode == UNITS_PER_MINUTE && s.feed_rate == 0, "Cannot make a NURBS with 0 feedrate");
    s.motion_mode = g;
    if (b.has('l') && b['l'] > 3) n.order = unsigned(b['l']);
    if (first) n.points.push_back(point(s.current, plane, b.has('p') && !have_a ? b['p'] : 1));
    if (have_a) {
        EmcPose end;
        TRY(find_ends(s, b, &end));
        n.points.push_back(point(end, plane, b.value('p', -1)));
    }
    return INTERP_OK;
}

int convert_nurbs_end(Setup &s)
{
    Nurbs &n = *s.nurbs;
    CHECK(s.motion_mode != G_5_2, "Cannot use G5.3 without G5.2 first");
    CHECK(n.points.size() < n.order, "You must specify a number of control points at least equal to the order L = %u",
          n.order);
    update_tag(s);
    s.canon.NURBS_G5_FEED(line_of(s), n.points, n.order, s.plane);
    SplinePlane plane;
    if (spline_plane(s.plane, &plane)) { // until here the machine was at the first point
        axis(s.current, plane.first) = n.points.back().x;
        axis(s.current, plane.second) = n.points.back().y;
    }
    n.points.clear();
    n.order = 3;
    s.motion_mode = -1;
    return INTERP_OK;
}

namespace
{

int whole_word(Setup &s, char letter, const char *text, int *value)
{
    const double v = s.block[letter];
    const double whole = rint(v);
    CHECK(fabs(v - whole) > 0.001 || fabs(v) > 1e6, "%s", text);
    *value = int(whole);
    return INTERP_OK;
}

void g6_forget(Nurbs &n)
{
    n.g6_points.clear();
    n.g6_order = 0;
    n.g6_option = 0;
    n.weight = 0;
    n.knot = -1;
    n.have_weight = false;
}

} // namespace

int convert_nurbs_g6(Setup &s, int g)
{
    const Block &b = s.block;
    Nurbs &n = *s.nurbs;
    SplinePlane plane;
    CHECK(!spline_plane(s.plane, &plane), "one plane must be selected for nurbs: XY, YZ, ZX");
    CHECK(s.feed_mode == UNITS_PER_MINUTE && s.feed_rate == 0, "Cannot make a nurbs with 0 feedrate");
    if (s.motion_mode != G_6_2) g6_forget(n);
    if (n.g6_points.empty() && n.g6_order == 0) {
        CHECK(!b.has('p'), "Program the nurbs order P in the first block of instruction");
        int order;
        TRY(whole_word(s, 'p', "nurbs order P number is not an integer", &order));
        CHECK(order < 1 || order > 20, "nurbs order P number is not an integer");
        CHECK(!b.has('q'), "Program the nurbs Q value (1,2,3) in the first block of nurbs instruction");
        int option;
        TRY(whole_word(s, 'q', "nurbs Q number is not an integer", &option));
        CHECK(option < 1 || option > 3, "nurbs Q value not in range 1 to 3");
        n.g6_order = unsigned(order);
        n.g6_option = option;
    }
    s.motion_mode = g;
    const bool have_a = b.has_axis(plane.first), have_b = b.has_axis(plane.second);
    CHECK(have_a != have_b, "You must specify both %c and %c coordinates for Control Points", plane.first_letter,
          plane.second_letter);
    if (!have_a && !b.has('k')) return INTERP_OK;
    if (b.has('r')) {
        n.weight = b['r'];
        n.have_weight = true;
    }
    if (b.has('k')) {
        int knot;
        TRY(whole_word(s, 'k', "nurbs K number is not an integer", &knot));
        n.knot = knot;
    }
    CHECK(!n.have_weight || n.weight <= 0, "Must specify positive nurbs weight R for every Control Point");
    CHECK(n.knot < 0, "Must specify nurbs K number for every Control Point");
    EmcPose end = s.current;
    if (have_a) {
        TRY(find_ends(s, b, &end));
        end_at(s, end, plane);
    }
    n.g6_points.push_back({axis(end, plane.first), axis(end, plane.second), n.weight, n.knot});
    // Complete when the last `order` knots are equal.
    const size_t count = n.g6_points.size(), order = n.g6_order;
    if (count <= order || n.g6_points[count - order].k != n.knot) return INTERP_OK;
    update_tag(s);
    s.canon.NURBS_G6_FEED(line_of(s), n.g6_points, unsigned(order), s.feed_rate, n.g6_option, s.plane);
    g6_forget(n);
    s.motion_mode = -1;
    return INTERP_OK;
}

void nurbs_forget(Setup &s)
{
    s.nurbs->points.clear();
    s.nurbs->order = 3;
    g6_forget(*s.nurbs);
}

} // namespace ngc
