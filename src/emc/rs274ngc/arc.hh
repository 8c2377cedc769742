/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * arc.hh - arcs in a plane: from words to centre and turn.
 */
#ifndef KERF_ARC_HH
#define KERF_ARC_HH

#include "setup.hh"

namespace ngc
{

/// The axes of an arc plane: first, second, normal; and the letters of its centre words.
struct ArcPlane {
    int first, second, normal;
    char first_word, second_word; // offsets: i, j, k
};
/// Plane must be XY, YZ or XZ.
const ArcPlane &arc_plane(CANON_PLANE plane);

struct Point2 {
    double x, y;
};
inline Point2 in_plane(const EmcPose &p, const ArcPlane &plane)
{
    return {axis(p, plane.first), axis(p, plane.second)};
}

struct Arc {
    Point2 centre;
    int turn; // > 0 counterclockwise; |turn| - 1 additional full turns
};

/// Centre and turn of the block's arc from start to end (plane coordinates, program units).
[[nodiscard]] int read_arc(Setup &s, int g, const ArcPlane &plane, Point2 start, Point2 end, Arc *arc);
/// The tolerance checks of centre format.
[[nodiscard]] int check_arc_radii(Setup &s, Point2 start, Point2 end, Point2 centre);
/// Angle swept from start to end, radians, signed like turn; a full turn when they coincide.
double arc_sweep(Point2 start, Point2 end, Point2 centre, int turn);
/// Arc tolerance in program units.
double arc_tolerance(const Setup &s);
void emit_arc(Setup &s, const ArcPlane &plane, const EmcPose &end, Point2 centre, int turn);

} // namespace ngc

#endif
