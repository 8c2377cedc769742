/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * preview_canon.cc - see preview_canon.hh.
 */
#include "preview_canon.hh"

#include <cmath>

namespace
{

double *axes(EmcPose &p) { return &p.tran.x; }

void scale_lengths(EmcPose &p, double factor)
{
    for (int i : {0, 1, 2, 6, 7, 8}) axes(p)[i] *= factor;
}

} // namespace

EmcPose PreviewCanon::to_inch(const EmcPose &p) const
{
    EmcPose r = p;
    if (units != CANON_UNITS_INCHES)
        for (int i : {0, 1, 2, 6, 7, 8}) axes(r)[i] /= 25.4;
    return r;
}

// The machine stays where it is; what is read back is that place in the new system.
template <class Change> void PreviewCanon::keep_place(Change change)
{
    auto frame = [this] {
        PreviewFrame f;
        f.g5x = point9(g5x);
        f.g92 = point9(g92);
        f.cosine = cos(rotation * (M_PI / 180));
        f.sine = sin(rotation * (M_PI / 180));
        const Point9 tool = point9(tool_offset);
        for (size_t i = 0; i < 9; ++i) f.g5x[i] += tool[i];
        return f;
    };
    const Point9 place = frame().to_machine(point9(position));
    change();
    const Point9 now = frame().from_machine(place);
    position = {{now[0], now[1], now[2]}, now[3], now[4], now[5], now[6], now[7], now[8]};
}

void PreviewCanon::SET_G5X_OFFSET(int index, const EmcPose &offset)
{
    keep_place([&] { g5x = offset; });
    on_g5x(index, to_inch(offset));
}

void PreviewCanon::SET_G92_OFFSET(const EmcPose &offset)
{
    keep_place([&] { g92 = offset; });
    on_g92(to_inch(offset));
}

void PreviewCanon::SET_XY_ROTATION(double degrees)
{
    keep_place([&] { rotation = degrees; });
    on_rotation(degrees);
}

void PreviewCanon::USE_LENGTH_UNITS(CANON_UNITS u)
{
    if (u == units) return;
    const double factor = u == CANON_UNITS_INCHES ? 1 / 25.4 : 25.4;
    scale_lengths(position, factor);
    scale_lengths(g5x, factor);
    scale_lengths(g92, factor);
    scale_lengths(tool_offset, factor);
    feed_rate *= factor;
    tolerance *= factor;
    naive_tolerance *= factor;
    units = u;
}

void PreviewCanon::SELECT_PLANE(CANON_PLANE p)
{
    plane = p;
    on_plane(p);
}

void PreviewCanon::SET_FEED_RATE(double rate)
{
    feed_rate = rate;
    on_feed_rate(to_inch(rate));
}

void PreviewCanon::USE_TOOL_LENGTH_OFFSET(const EmcPose &offset)
{
    keep_place([&] { tool_offset = offset; });
    on_tool_offset(last_line(), to_inch(offset));
}

void PreviewCanon::STRAIGHT_TRAVERSE(int line, const EmcPose &end)
{
    position = end;
    on_traverse(line, to_inch(end));
}

void PreviewCanon::STRAIGHT_FEED(int line, const EmcPose &end)
{
    position = end;
    on_feed(line, to_inch(end));
}

void PreviewCanon::STRAIGHT_PROBE(int line, const EmcPose &end, unsigned char)
{
    position = end;
    on_probe(line, to_inch(end));
}

void PreviewCanon::ARC_FEED(int line, double first_end, double second_end, double first_axis, double second_axis,
                            int rot, double axis_end_point, const EmcPose &end)
{
    position = end;
    const int first = plane == CANON_PLANE_XZ ? 2 : plane == CANON_PLANE_YZ ? 1 : 0;
    axes(position)[first] = first_end;
    axes(position)[(first + 1) % 3] = second_end;
    axes(position)[(first + 2) % 3] = axis_end_point;
    on_arc(line, to_inch(first_end), to_inch(second_end), to_inch(first_axis), to_inch(second_axis), rot,
           to_inch(axis_end_point), to_inch(position));
}

void PreviewCanon::RIGID_TAP(int line, double x, double y, double z, double)
{
    on_tap(line, to_inch(x), to_inch(y), to_inch(z));
}

void PreviewCanon::DWELL(double seconds) { on_dwell(last_line(), seconds); }

// ---- splines: a fixed number of straight pieces ------------------------------------------

namespace
{

// Rational B-spline with knots t (count + order of them); u inside the knot range.
// De Boor's recursion on homogeneous coordinates.
template <class At>
void spline_at(const std::vector<double> &t, unsigned order, size_t count, double u, At at, double *x, double *y) {
    const size_t degree = order - 1;
    size_t k = degree;
    while (k + 1 < count && t[k + 1] <= u) ++k;
    std::vector<std::array<double, 3>> d(order);
    for (size_t j = 0; j <= degree; ++j) d[j] = at(k - degree + j);
    for (size_t r = 1; r <= degree; ++r)
        for (size_t j = degree; j >= r; --j) {
            const size_t i = k - degree + j;
            const double span = t[i + order - r] - t[i];
            const double a = span > 0 ? (u - t[i]) / span : 0;
            for (int c = 0; c < 3; ++c) d[j][c] = (1 - a) * d[j - 1][c] + a * d[j][c];
        }
    *x = d[degree][0] / d[degree][2];
    *y = d[degree][1] / d[degree][2];
}

} // namespace

void PreviewCanon::spline_point(int line, double a, double b, CANON_PLANE p)
{
    EmcPose end = position;
    const int first = p == CANON_PLANE_YZ ? 1 : 0, second = p == CANON_PLANE_XY ? 1 : 2;
    axes(end)[first] = a;
    axes(end)[second] = b;
    STRAIGHT_FEED(line, end);
}

void PreviewCanon::NURBS_G5_FEED(int line, const std::vector<NURBS_CONTROL_POINT> &points, unsigned order,
                                 CANON_PLANE p)
{
    const size_t count = points.size();
    if (order < 1 || count < order) return;
    std::vector<double> t(count + order);
    const double top = double(count - order + 1);
    for (size_t i = 0; i < t.size(); ++i) t[i] = i < order ? 0 : i < count ? double(i - order + 1) : top;
    auto at = [&](size_t i) {
        const NURBS_CONTROL_POINT &c = points[i];
        return std::array<double, 3>{c.x * c.w, c.y * c.w, c.w};
    };
    const size_t pieces = count * 15;
    for (size_t i = 1; i <= pieces; ++i) {
        double x, y;
        spline_at(t, order, count, top * double(i) / double(pieces), at, &x, &y);
        spline_point(line, x, y, p);
    }
}

void PreviewCanon::NURBS_G6_FEED(int line, const std::vector<NURBS_G6_CONTROL_POINT> &points, unsigned order, double,
                                 int, CANON_PLANE p)
{
    if (points.size() < 2 * size_t(order) || order < 1) return;
    const size_t count = points.size() - order;
    std::vector<double> t(points.size());
    for (size_t i = 0; i < t.size(); ++i) t[i] = points[i].k;
    auto at = [&](size_t i) {
        const NURBS_G6_CONTROL_POINT &c = points[i];
        return std::array<double, 3>{c.x * c.r, c.y * c.r, c.r};
    };
    const double low = t[order - 1], high = t[count];
    if (!(high > low)) return;
    const size_t pieces = count * 15;
    spline_point(line, points[0].x, points[0].y, p);
    for (size_t i = 1; i <= pieces; ++i) {
        double x, y;
        spline_at(t, order, count, low + (high - low) * double(i) / double(pieces), at, &x, &y);
        spline_point(line, x, y, p);
    }
}
