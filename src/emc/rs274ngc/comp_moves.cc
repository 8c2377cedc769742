/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * comp_moves.cc - straight moves and arcs offset by the tool radius.
 *
 * Names as in the sheet: P the previous programmed point, C the current compensated
 * point, N the new programmed end, r the radius, all in the plane's first and second
 * axis; inside: the tool runs inside an arc. s.current holds C in these two axes.
 * Thread: [task]
 * Source: cutter compensation sheet, sections 4 to 6
 */
#include <algorithm>

#include "comp_queue.hh"
#include "stages.hh"

namespace ngc
{
namespace
{

constexpr double EPSILON = 0.05; // rad: corners flatter than this get no join

Point2 programmed(const Setup &s, const ArcPlane &plane)
{
    EmcPose p{};
    p.tran.x = s.program_x;
    p.tran.y = s.program_y;
    p.tran.z = s.program_z;
    return in_plane(p, plane);
}

Point2 at(Point2 from, double distance, double angle)
{
    return {from.x + distance * cos(angle), from.y + distance * sin(angle)};
}

double angle_to(Point2 from, Point2 to) { return atan2(to.y - from.y, to.x - from.x); }
double distance(Point2 a, Point2 b) { return hypot(b.x - a.x, b.y - a.y); }

EmcPose with_point(EmcPose pose, const ArcPlane &plane, Point2 p)
{
    axis(pose, plane.first) = p.x;
    axis(pose, plane.second) = p.y;
    return pose;
}

// After a move: C in the plane, all other axes at the programmed end.
void arrive(Setup &s, const ArcPlane &plane, const EmcPose &programmed_end, Point2 c)
{
    s.current = with_point(programmed_end, plane, c);
    s.program_x = programmed_end.tran.x;
    s.program_y = programmed_end.tran.y;
    s.program_z = programmed_end.tran.z;
}

bool tool_inside(int side, int turn) { return (side == COMP_LEFT && turn > 0) || (side == COMP_RIGHT && turn < 0); }

// The join around a convex corner at the programmed point P, at the height before the move.
EmcPose end_of_join(const Setup &s, const ArcPlane &plane, Point2 to, const EmcPose &end)
{
    EmcPose join = with_point(end, plane, to);
    axis(join, plane.normal) = axis(s.current, plane.normal);
    return join;
}

void enqueue_join(Setup &s, const ArcPlane &plane, Point2 p, Point2 to, const EmcPose &end)
{
    enqueue_arc(s, end_of_join(s, plane, to, end), p, s.comp_side == COMP_LEFT ? -1 : 1, 0);
}

// ---- straight moves -------------------------------------------------------------------

int straight_entry(Setup &s, int g, const ArcPlane &plane, const EmcPose &end)
{
    const Point2 from = in_plane(s.current, plane), n = in_plane(end, plane);
    const double r = s.comp_radius;
    CHECK(distance(from, n) <= r, "Length of cutter compensation entry move is not greater than the tool radius");
    const double alpha = angle_to(from, n);
    const Point2 e = at(n, r, alpha + (s.comp_side == COMP_LEFT ? M_PI_2 : -M_PI_2));
    if (g == G_1 && s.feed_mode == INVERSE_TIME) inverse_time_rate(s, straight_length(s.current, end));
    CHECK(g != G_0 && g != G_1, "Bug code not g0 or g1");
    enqueue_straight(s, g == G_0, with_point(end, plane, e), e.x - from.x, e.y - from.y);
    s.comp_first_move = false;
    arrive(s, plane, end, e);
    return INTERP_OK;
}

// Where the offset line meets the pending arc of radius rho.
int line_arc_corner(Setup &s, const QueuedCall &pending, Point2 p, double base, Point2 *corner)
{
    const double r = s.comp_radius;
    const bool ccw = pending.turn > 0, inside = tool_inside(s.comp_side, pending.turn);
    const Point2 c = in_plane(s.current, arc_plane(s.plane));
    const Point2 q = pending.centre;
    const double rho = distance(q, c);
    const double full = inside ? rho + r : rho - r;
    const double tau = base + (ccw ? M_PI_2 : -M_PI_2);
    const double d = full * cos(tau - angle_to(p, q));
    const double l = inside ? (d - r) / rho : (d + r) / rho;
    CHECK(!(fabs(l) <= 1), "Arc to straight motion makes a corner the compensated tool can't fit in without gouging");
    const bool minus = (inside && ccw) || (!inside && !ccw);
    *corner = at(q, rho, tau + M_PI + (minus ? -acos(l) : acos(l)));
    return INTERP_OK;
}

int straight_next(Setup &s, int g, const ArcPlane &plane, const EmcPose &end)
{
    const double r = s.comp_radius;
    const bool left = s.comp_side == COMP_LEFT;
    const Point2 p = programmed(s, plane), c = in_plane(s.current, plane), n = in_plane(end, plane);
    if (g == G_1 && s.feed_mode == INVERSE_TIME) {
        EmcPose from = s.current;
        from.tran.x = s.program_x;
        from.tran.y = s.program_y;
        from.tran.z = s.program_z;
        inverse_time_rate(s, straight_length(from, end));
    }
    if (p.x == n.x && p.y == n.y) {
        // Only other axes move; where the corner before them lies is still open.
        enqueue_straight(s, g == G_0, with_point(end, plane, c), 0, 0);
        arrive(s, plane, end, c);
        return INTERP_OK;
    }
    double theta = angle_to(p, c);
    double alpha = angle_to(p, n);
    double beta, gamma;
    if (left) {
        if (theta < alpha) theta += 2 * M_PI;
        beta = theta - alpha - M_PI_2;
        gamma = M_PI_2;
    } else {
        if (alpha < theta) alpha += 2 * M_PI;
        beta = alpha - theta - M_PI_2;
        gamma = -M_PI_2;
    }
    const Point2 e = at(n, r, alpha + gamma), m = at(p, r, alpha + gamma);
    QueuedCall *pending = s.queue->pending();
    const bool pending_arc = pending && pending->kind == QueuedCall::ARC;
    const bool outside_arc = pending_arc && !tool_inside(s.comp_side, pending->turn);

    if (beta < -EPSILON || beta > M_PI + EPSILON || (beta > M_PI - EPSILON && outside_arc)) { // concave
        Point2 corner;
        if (!pending_arc) {
            const double h = (beta + M_PI) / 2;
            CHECK(h == 0, "Zero degree inside corner is invalid for cutter compensation");
            corner = at(c, r / tan(h), theta + gamma);
        } else {
            TRY(line_arc_corner(s, *pending, p, alpha, &corner));
        }
        TRY(move_end_and_flush(s, corner));
    } else if (beta > EPSILON) { // convex
        CHECK(g != G_0 && g != G_1, "Bug code not g0 or g1");
        TRY(finish_comp(s));
        if (g == G_0)
            enqueue_straight(s, true, end_of_join(s, plane, m, end), m.x - c.x, m.y - c.y);
        else
            enqueue_join(s, plane, p, m, end);
        flush_comp(s);
    } else { // nearly straight on
        TRY(finish_comp(s));
    }
    enqueue_straight(s, g == G_0, with_point(end, plane, e), n.x - p.x, n.y - p.y);
    arrive(s, plane, end, e);
    return INTERP_OK;
}

// ---- arcs ------------------------------------------------------------------------------

double comp_arc_length(Point2 start, Point2 end, const Arc &arc, double height)
{
    const double flat = distance(start, arc.centre) * fabs(arc_sweep(start, end, arc.centre, arc.turn));
    return hypot(flat, height);
}

int arc_entry(Setup &s, int g, const ArcPlane &plane, const EmcPose &end)
{
    const double r = s.comp_radius;
    const Point2 from = in_plane(s.current, plane), n = in_plane(end, plane);
    CHECK(distance(from, n) <= r, "Radius of cutter compensation entry arc is not greater than the tool radius");
    Arc arc;
    TRY(read_arc(s, g, plane, from, n, &arc));
    const bool inside = tool_inside(s.comp_side, arc.turn);
    CHECK(inside && distance(from, arc.centre) <= r, "Tool radius not less than arc radius with comp");
    const double to_centre = angle_to(n, arc.centre);
    const Point2 e = at(n, r, inside ? to_centre : to_centre + M_PI);
    // The arc that leads in: from here to E, there tangent to the programmed arc.
    const double half = distance(from, e) / 2;
    const double e_centre = angle_to(e, arc.centre);
    const double a = angle_to(e, from) - e_centre;
    CHECK(fabs(cos(a)) < TOLERANCE_EQUAL, "Tool radius not less than arc radius with comp");
    const Point2 centre = at(e, half / cos(a), e_centre);
    CHECK(fabs(distance(centre, from) - distance(centre, e)) > arc_tolerance(s), "Bug in tool radius comp");
    if (s.comp_orientation != 0 && s.comp_orientation != 9)
        enqueue_straight(s, false, s.current, 0, 0);
    if (s.feed_mode == INVERSE_TIME)
        inverse_time_rate(s, comp_arc_length(from, n, arc, axis(end, plane.normal) - axis(s.current, plane.normal)));
    flush_comp(s);
    s.queue->start_known = false; // the arc's own sweep is not the programmed one's
    enqueue_arc(s, with_point(end, plane, e), centre, arc.turn, arc_sweep(from, n, arc.centre, arc.turn));
    s.comp_first_move = false;
    arrive(s, plane, end, e);
    return INTERP_OK;
}

int corner_before_arc(Setup &s, const ArcPlane &plane, const Arc &arc, double theta, double beta, double radius,
                      Point2 *corner)
{
    const double r = s.comp_radius;
    const bool ccw = arc.turn > 0, inside = tool_inside(s.comp_side, arc.turn);
    const QueuedCall *pending = s.queue->pending();
    if (!pending || pending->kind != QueuedCall::ARC) {
        const double y = radius * sin(beta - M_PI_2);
        const double d = inside ? radius - r : radius + r;
        const double l = inside ? (y + r) / d : (y - r) / d;
        CHECK(!(fabs(l) <= 1), "Arc move in concave corner cannot be reached by the tool without gouging");
        double angle;
        if (inside) angle = ccw ? theta + asin(l) : theta - asin(l);
        else angle = ccw ? theta + M_PI - asin(l) : theta + M_PI + asin(l);
        *corner = at(arc.centre, d, angle);
        return INTERP_OK;
    }
    const Point2 q = pending->centre, c = in_plane(s.current, plane);
    const bool before_inside = tool_inside(s.comp_side, pending->turn);
    const double rho = distance(q, c), d = inside ? radius - r : radius + r, cc = distance(q, arc.centre);
    CHECK(rho == 0 || cc == 0, "Arc to arc motion is invalid because the arcs have the same center");
    const double a = (rho * rho + cc * cc - d * d) / (2 * rho * cc);
    CHECK(!(fabs(a) <= 1), "Arc to arc motion makes a corner the compensated tool can't fit in without gouging");
    const bool plus = before_inside == ccw;
    *corner = at(q, rho, angle_to(q, arc.centre) + (plus ? acos(a) : -acos(a)));
    return INTERP_OK;
}

int arc_next(Setup &s, int g, const ArcPlane &plane, const EmcPose &end)
{
    const double r = s.comp_radius;
    const bool left = s.comp_side == COMP_LEFT;
    const Point2 p = programmed(s, plane), c = in_plane(s.current, plane), n = in_plane(end, plane);
    Arc arc;
    TRY(read_arc(s, g, plane, p, n, &arc));
    const bool inside = tool_inside(s.comp_side, arc.turn);
    const double radius = distance(arc.centre, n);
    CHECK(inside && radius <= r, "Tool radius not less than arc radius with comp");
    if (s.feed_mode == INVERSE_TIME) {
        EmcPose from{};
        from.tran.x = s.program_x;
        from.tran.y = s.program_y;
        from.tran.z = s.program_z;
        inverse_time_rate(s, comp_arc_length(p, n, arc, axis(end, plane.normal) - axis(from, plane.normal)));
    }
    const double theta = angle_to(p, c) + (left ? -M_PI_2 : M_PI_2); // incoming direction
    const double delta = angle_to(p, arc.centre);
    const double tangent = g == G_3 ? delta - M_PI_2 : delta + M_PI_2;
    double beta = left ? theta - tangent : tangent - theta;
    while (beta > 3 * M_PI_2) beta -= 2 * M_PI;
    while (beta <= -M_PI_2) beta += 2 * M_PI;
    const double to_centre = angle_to(n, arc.centre);
    const Point2 e = at(n, r, inside ? to_centre : to_centre + M_PI);
    const double sweep = arc_sweep(p, n, arc.centre, arc.turn);

    if (beta < -EPSILON || beta > M_PI + EPSILON || (fabs(beta - M_PI) < EPSILON && !inside)) { // concave
        Point2 corner;
        TRY(corner_before_arc(s, plane, arc, theta, beta, radius, &corner));
        TRY(move_end_and_flush(s, corner));
    } else if (beta > EPSILON) { // convex
        TRY(finish_comp(s));
        enqueue_join(s, plane, p, at(p, r, inside ? delta : delta + M_PI), end);
        flush_comp(s);
    } else { // tangent
        TRY(finish_comp(s));
    }
    enqueue_arc(s, with_point(end, plane, e), arc.centre, arc.turn, sweep);
    arrive(s, plane, end, e);
    return INTERP_OK;
}

} // namespace

int comp_straight(Setup &s, int g, const EmcPose &end)
{
    const ArcPlane &plane = arc_plane(s.plane);
    return s.comp_first_move ? straight_entry(s, g, plane, end) : straight_next(s, g, plane, end);
}

int comp_arc(Setup &s, int g, const EmcPose &end)
{
    const ArcPlane &plane = arc_plane(s.plane);
    return s.comp_first_move ? arc_entry(s, g, plane, end) : arc_next(s, g, plane, end);
}

} // namespace ngc
