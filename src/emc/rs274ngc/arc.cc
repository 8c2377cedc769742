/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * arc.cc - G2 and G3.
 *
 * In:     the block's words, current point
 * Out:    ARC_FEED
 * Thread: [task]
 * Source: G-codes sheet "G2 (CW) / G3 (CCW) arcs"
 */
#include "arc.hh"

#include <algorithm>

#include "stages.hh"

namespace ngc
{

const ArcPlane &arc_plane(CANON_PLANE plane)
{
    static const ArcPlane xy = {AX_X, AX_Y, AX_Z, 'i', 'j'};
    static const ArcPlane xz = {AX_Z, AX_X, AX_Y, 'k', 'i'};
    static const ArcPlane yz = {AX_Y, AX_Z, AX_X, 'j', 'k'};
    return plane == CANON_PLANE_XZ ? xz : plane == CANON_PLANE_YZ ? yz : xy;
}

double arc_tolerance(const Setup &s)
{
    return s.units == CANON_UNITS_INCHES ? s.center_arc_tolerance_inch : s.center_arc_tolerance_mm;
}

double arc_sweep(Point2 start, Point2 end, Point2 centre, int turn)
{
    const double a = atan2(start.y - centre.y, start.x - centre.x);
    const double b = atan2(end.y - centre.y, end.x - centre.x);
    double sweep = b - a;
    if (turn > 0) {
        if (sweep <= 0) sweep += 2 * M_PI;
        return sweep + 2 * M_PI * (turn - 1);
    }
    if (sweep >= 0) sweep -= 2 * M_PI;
    return sweep + 2 * M_PI * (turn + 1);
}

namespace
{

double radius_tolerance(const Setup &s) { return s.units == CANON_UNITS_INCHES ? 0.00005 : 0.00127; }

// R word: the centre left of the chord for G3 with R > 0 and G2 with R < 0, else right.
int centre_from_radius(Setup &s, int g, double radius, Point2 start, Point2 end, Point2 *centre)
{
    CHECK(start.x == end.x && start.y == end.y, "Current point same as end point of arc");
    const double length = fabs(radius);
    double half = hypot(end.x - start.x, end.y - start.y) / 2;
    CHECK(half - length > radius_tolerance(s), "Arc radius too small to reach end point");
    if (half / length > 1 - 1e-12) half = length;
    const bool left = (g == G_3) == (radius > 0);
    const double chord = atan2(end.y - start.y, end.x - start.x);
    const double normal = chord + (left ? M_PI_2 : -M_PI_2);
    const double height = length * cos(asin(half / length));
    centre->x = (start.x + end.x) / 2 + height * cos(normal);
    centre->y = (start.y + end.y) / 2 + height * sin(normal);
    return INTERP_OK;
}

int check_radii(Setup &s, const ArcPlane &plane, Point2 start, Point2 end, Point2 centre)
{
    const double r1 = hypot(centre.x - start.x, centre.y - start.y);
    const double r2 = hypot(centre.x - end.x, centre.y - end.y);
    const char a = char(AXIS_LETTERS[plane.first] - 32), b = char(AXIS_LETTERS[plane.second] - 32);
    const double tiny = radius_tolerance(s);
    CHECK(r1 < tiny || r2 < tiny,
          "Zero-radius arc: start=(%c%.4f,%c%.4f) center=(%c%.4f,%c%.4f) end=(%c%.4f,%c%.4f) r1=%.4f r2=%.4f", a,
          start.x, b, start.y, a, centre.x, b, centre.y, a, end.x, b, end.y, r1, r2);
    const double abs_err = fabs(r1 - r2), rel_err = abs_err / std::max(r1, r2), tolerance = arc_tolerance(s);
    CHECK(abs_err > 100 * tolerance || (rel_err > 0.001 && abs_err > tolerance),
          "Radius to end of arc differs from radius to start: start=(%c%.4f,%c%.4f) center=(%c%.4f,%c%.4f) "
          "end=(%c%.4f,%c%.4f) r1=%.4f r2=%.4f abs_err=%.4g rel_err=%.4f%%",
          a, start.x, b, start.y, a, centre.x, b, centre.y, a, end.x, b, end.y, r1, r2, abs_err, rel_err * 100);
    return INTERP_OK;
}

// Which words an arc has, before any geometry.
int check_arc_words(Setup &s, const ArcPlane &plane)
{
    const Block &b = s.block;
    const bool offsets = b.present & IJK_WORDS;
    CHECK(!offsets && !b.has('r'), "R i j k words all missing for arc");
    CHECK(offsets && b.has('r'), "Mixed radius ijk format for arc");
    TRY(check_feed(s, "Cannot make arc with zero feed rate", "F word missing with inverse time arc move"));
    if (offsets) {
        CHECK(plane.normal == AX_Z && b.has('k'), "K word given for arc in xy plane");
        CHECK(plane.normal == AX_X && b.has('i'), "I word given for arc in yz plane");
        CHECK(plane.normal == AX_Y && b.has('j'), "J word given for arc in xz plane");
        if (s.ijk_distance_mode == MODE_ABSOLUTE) {
            // In the order of the alphabet.
            const char low = std::min(plane.first_word, plane.second_word);
            const char high = std::max(plane.first_word, plane.second_word);
            CHECK(!b.has(low), "%c word missing in absolute center arc", low - 32);
            CHECK(!b.has(high), "%c word missing in absolute center arc", high - 32);
        }
        return INTERP_OK;
    }
    const bool polar = b.present & POLAR_WORDS;
    CHECK(!b.has_axis(plane.first) && !b.has_axis(plane.second) && !(polar && plane.normal == AX_Z),
          "%s words missing for arc in %s plane",
          plane.normal == AX_Z ? "X and y" : plane.normal == AX_X ? "Y and z" : "X and z",
          plane.normal == AX_Z ? "xy" : plane.normal == AX_X ? "yz" : "xz");
    return INTERP_OK;
}

} // namespace

int check_arc_radii(Setup &s, Point2 start, Point2 end, Point2 centre)
{
    return check_radii(s, arc_plane(s.plane), start, end, centre);
}

int read_arc(Setup &s, int g, const ArcPlane &plane, Point2 start, Point2 end, Arc *arc)
{
    const Block &b = s.block;
    if (b.has('r')) {
        TRY(centre_from_radius(s, g, b['r'], start, end, &arc->centre));
    } else {
        const double i = b.value(plane.first_word, 0), j = b.value(plane.second_word, 0);
        const bool absolute = s.ijk_distance_mode == MODE_ABSOLUTE;
        arc->centre = absolute ? Point2{i, j} : Point2{start.x + i, start.y + j};
        TRY(check_radii(s, plane, start, end, arc->centre));
    }
    const double turns = b.has('p') ? std::min(rint(b['p']), 1e6) : 1;
    arc->turn = g == G_3 ? int(turns) : -int(turns);
    return INTERP_OK;
}

void emit_arc(Setup &s, const ArcPlane &plane, const EmcPose &end, Point2 centre, int turn)
{
    if (s.canon.wants_tags()) {
        const Point2 start = in_plane(s.current, plane);
        EmcPose c{};
        axis(c, plane.first) = centre.x;
        axis(c, plane.second) = centre.y;
        axis(c, plane.normal) = axis(s.current, plane.normal);
        s.path_fields[GM_FIELD_FLOAT_ARC_RADIUS] = float(hypot(start.x - centre.x, start.y - centre.y));
        s.path_fields[GM_FIELD_FLOAT_ARC_CENTER_X] = float(c.tran.x);
        s.path_fields[GM_FIELD_FLOAT_ARC_CENTER_Y] = float(c.tran.y);
        s.path_fields[GM_FIELD_FLOAT_ARC_CENTER_Z] = float(c.tran.z);
        update_tag(s);
    }
    s.canon.ARC_FEED(line_of(s), axis(end, plane.first), axis(end, plane.second), centre.x, centre.y, turn,
                     axis(end, plane.normal), end);
}

int convert_arc(Setup &s, int g)
{
    CHECK(s.arc_not_allowed,
          "The move just after exiting cutter compensation mode must be straight, not an arc");
    CHECK(s.plane >= CANON_PLANE_UV, "Cannot do an arc in planes G17.1, G18.1, or G19.1");
    const ArcPlane &plane = arc_plane(s.plane);
    TRY(check_arc_words(s, plane));
    s.motion_mode = g;
    EmcPose end;
    TRY(find_ends(s, s.block, &end));
    int indexer;
    TRY(check_indexers(s, end, g, &indexer));
    if (s.comp_on() && s.comp_radius > 0) return comp_arc(s, g, end);

    const Point2 start = in_plane(s.current, plane), stop = in_plane(end, plane);
    Arc arc;
    TRY(read_arc(s, g, plane, start, stop, &arc));
    if (s.feed_mode == INVERSE_TIME) {
        const double radius = hypot(start.x - arc.centre.x, start.y - arc.centre.y);
        const double flat = radius * fabs(arc_sweep(start, stop, arc.centre, arc.turn));
        inverse_time_rate(s, hypot(flat, axis(end, plane.normal) - axis(s.current, plane.normal)));
    }
    emit_arc(s, plane, end, arc.centre, arc.turn);
    s.current = end;
    if (s.comp_on()) {
        s.program_x = end.tran.x;
        s.program_y = end.tran.y;
        s.program_z = end.tran.z;
    }
    return INTERP_OK;
}

} // namespace ngc
