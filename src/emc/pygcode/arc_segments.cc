/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * arc_segments.cc - arcs as straight pieces, and the frame they stand in.
 *
 * Source: preview sheet, section 5 "arc_to_segments"
 */
#include <algorithm>
#include <cmath>

#include "preview_canon.hh"

Point9 PreviewFrame::to_machine(const Point9 &p) const
{
    Point9 r;
    for (int i = 0; i < 9; ++i) r[size_t(i)] = p[size_t(i)] + g92[size_t(i)];
    const double x = r[0] * cosine - r[1] * sine;
    r[1] = r[0] * sine + r[1] * cosine;
    r[0] = x;
    for (size_t i = 0; i < 9; ++i) r[i] += g5x[i];
    return r;
}

Point9 PreviewFrame::from_machine(const Point9 &p) const
{
    Point9 r;
    for (size_t i = 0; i < 9; ++i) r[i] = p[i] - g5x[i];
    const double x = r[0] * cosine + r[1] * sine;
    r[1] = -r[0] * sine + r[1] * cosine;
    r[0] = x;
    for (size_t i = 0; i < 9; ++i) r[i] -= g92[i];
    return r;
}

void arc_segments(std::vector<Point9> &out, const PreviewFrame &frame, int plane, const Point9 &start_machine,
                  double x1, double y1, double cx, double cy, int rot, double z1, const Point9 &end_program,
                  int max_segments, double length_scale)
{
    size_t X = 1, Y = 2, Z = 0;
    if (plane == CANON_PLANE_XY) X = 0, Y = 1, Z = 2;
    else if (plane == CANON_PLANE_XZ) X = 2, Y = 0, Z = 1;
    const Point9 start = frame.from_machine(start_machine);
    Point9 end = end_program;
    end[X] = x1;
    end[Y] = y1;
    end[Z] = z1;
    const double theta1 = atan2(start[Y] - cy, start[X] - cx);
    double theta2 = atan2(y1 - cy, x1 - cx);
    const double radius = hypot(start[X] - cx, start[Y] - cy);
    if (hypot(start[X] - x1, start[Y] - y1) * length_scale < 1e-8) { // a circle, whatever the last digits of the angles are
        theta2 = theta1 + (rot < 0 ? -2 * M_PI : 2 * M_PI);
    } else if (rot < 0) {
        if (theta1 < theta2) theta2 -= 2 * M_PI;
    } else if (theta1 > theta2) {
        theta2 += 2 * M_PI;
    }
    if (rot < -1) theta2 += 2 * M_PI * (rot + 1);
    if (rot > 1) theta2 += 2 * M_PI * (rot - 1);
    const int steps = std::max(3, int(std::min(1e7, max_segments * fabs(theta1 - theta2) / M_PI)));
    out.reserve(out.size() + size_t(steps));
    const double step = (theta2 - theta1) / steps;
    // The direction is turned by a constant rotation; every 64 steps it is taken afresh.
    const double ct = cos(step), st = sin(step);
    double c = cos(theta1), n = sin(theta1);
    for (int i = 1; i < steps; ++i) {
        if (i % 64 == 0) {
            c = cos(theta1 + i * step);
            n = sin(theta1 + i * step);
        } else {
            const double turned = c * ct - n * st;
            n = c * st + n * ct;
            c = turned;
        }
        const double part = double(i) / steps;
        Point9 p;
        for (size_t k = 0; k < 9; ++k) p[k] = start[k] + part * (end[k] - start[k]);
        p[X] = cx + radius * c;
        p[Y] = cy + radius * n;
        out.push_back(frame.to_machine(p));
    }
    out.push_back(frame.to_machine(end));
}
