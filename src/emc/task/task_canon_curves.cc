// SPDX-License-Identifier: GPL-2.0-or-later
//
// task_canon_curves.cc - arcs and splines of the canonical functions.
//
// Method: arcs: sheet section 7.6 (limits of the two axes of the plane, centripetal share
// sqrt(3)/2 of the acceleration). Splines: B-splines evaluated by Cox and de Boor's
// recursion, replaced by biarcs, sheet section 7.10.
#include <algorithm>
#include <cmath>

#include "task_canon.hh"

namespace {

struct V3 { double x, y, z; };

double dot(V3 a, V3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }


} // namespace

void TaskCanon::ARC_FEED(int line, double first_end, double second_end, double first_axis, double second_axis,
                         int rotation, double axis_end_point, const EmcPose &end) {
    if (plane_ == CANON_PLANE_UV || plane_ == CANON_PLANE_VW || plane_ == CANON_PLANE_UW) {
        CANON_ERROR("Can't set plane in UVW axes, assuming XY");
        plane_ = CANON_PLANE_XY;
    }
    if (plane_ == CANON_PLANE_XY && motion_mode_ == CANON_CONTINUOUS) {
        // Small enough to be two straight lines within the naive CAM tolerance?
        EmcPose from = to_frame(chain_.empty() ? end_ : chain_.back().pose);
        double t1 = std::atan2(from.tran.y - second_axis, from.tran.x - first_axis);
        double t2 = std::atan2(second_end - second_axis, first_end - first_axis);
        double r = std::hypot(from.tran.x - first_axis, from.tran.y - second_axis);
        double sweep = t2 - t1;
        if (rotation < 0) {
            if (sweep >= -1e-5) sweep -= 2 * M_PI;
            if (sweep >= -1e-5) sweep -= 2 * M_PI;
        } else if (sweep <= 1e-5) {
            sweep += 2 * M_PI;
            if (sweep <= 1e-5) sweep += 2 * M_PI;
        }
        double deviation = r * (1 - std::cos(std::fabs(sweep) / 2));
        if (from_program_length(deviation) < naivecam_tolerance_) {
            double t = t1 + sweep / 2;
            EmcPose middle = end, last = end;
            middle.tran.x = first_axis + r * std::cos(t);
            middle.tran.y = second_axis + r * std::sin(t);
            middle.tran.z = (from.tran.z + axis_end_point) / 2;
            last.tran.x = first_end;
            last.tran.y = second_end;
            last.tran.z = axis_end_point;
            chain(line, to_absolute(middle));
            chain(line, to_absolute(last));
            return;
        }
    }
    flush();
    arc(line, first_end, second_end, first_axis, second_axis, rotation, axis_end_point, end);
}

void TaskCanon::arc(int line, double first_end, double second_end, double first_axis, double second_axis, int rotation,
                    double axis_end, const EmcPose &end) {
    double c = std::cos(rotation_ * M_PI / 180), s = std::sin(rotation_ * M_PI / 180);
    const V3 rot_x{c, s, 0}, rot_y{0 - s, c, 0}, z{0, 0, 1}; // no -0
    V3 first, second, normal;
    int i1, i2, i3; // axes of the plane and its normal
    EmcPose target = end, middle = {};
    auto set = [&](EmcPose &p, double a, double b, double n) {
        switch (plane_) {
        case CANON_PLANE_YZ: p.tran.y = a; p.tran.z = b; p.tran.x = n; break;
        case CANON_PLANE_XZ: p.tran.z = a; p.tran.x = b; p.tran.y = n; break;
        default: p.tran.x = a; p.tran.y = b; p.tran.z = n; break;
        }
    };
    set(target, first_end, second_end, axis_end);
    set(middle, first_axis, second_axis, axis_end);
    switch (plane_) {
    case CANON_PLANE_YZ: first = rot_y; second = z; normal = rot_x; i1 = 1; i2 = 2; i3 = 0; break;
    case CANON_PLANE_XZ: first = z; second = rot_x; normal = rot_y; i1 = 2; i2 = 0; i3 = 1; break;
    default: first = rot_x; second = rot_y; normal = z; i1 = 0; i2 = 1; i3 = 2; break;
    }
    EmcPose to = to_absolute(target), center = to_absolute(middle);

    V3 cs{end_.tran.x - center.tran.x, end_.tran.y - center.tran.y, end_.tran.z - center.tran.z};
    V3 ce{to.tran.x - center.tran.x, to.tran.y - center.tran.y, to.tran.z - center.tran.z};
    double theta_start = std::atan2(dot(cs, second), dot(cs, first)),
           theta_end = std::atan2(dot(ce, second), dot(ce, first));
    double r_start = std::hypot(dot(cs, first), dot(cs, second)), r_end = std::hypot(dot(ce, first), dot(ce, second));
    if (rotation < 0 && theta_end + 1e-12 >= theta_start) theta_end -= 2 * M_PI;
    if (rotation >= 0 && theta_end - 1e-12 <= theta_start) theta_end += 2 * M_PI;
    int turns = rotation > 1 ? rotation - 1 : rotation < -1 ? rotation + 1 : 0;
    double angle = std::fabs(theta_end - theta_start + 2 * M_PI * turns);

    double spiral = r_end - r_start, dr = spiral / angle, r_min = std::min(r_start, r_end);
    double r_eff = std::sqrt(dr * dr + r_min * r_min);
    auto plane_limit = [&](const std::array<double, 9> &limit) {
        double m = std::min(axis_limit(limit, i1), axis_limit(limit, i2));
        if (rotation_ != 0 && plane_ != CANON_PLANE_XY && (stat_->motion.traj.axis_mask & (1 << i3)))
            m = std::min(m, axis_limit(limit, i3));
        return m;
    };
    double v_axes = plane_limit(limits_.velocity), a_axes = plane_limit(limits_.acceleration),
           j_axes = plane_limit(limits_.jerk);
    double v_planar = std::min(std::sqrt(a_axes * std::sqrt(3.0) / 2 * r_eff), v_axes);
    double spiral_length = std::hypot(r_min * angle, spiral);
    double axis_length = dot(ce, normal) - dot(cs, normal);
    double length = std::hypot(spiral_length, axis_length);
    double t_v = std::max(straight_velocity(to).t, v_planar > 0 ? spiral_length / v_planar : 0);
    double t_a = std::max(straight_acceleration(to).t, a_axes > 0 ? spiral_length / a_axes : 0);
    double v_max = t_v > 0 ? length / t_v : 0, a_max = t_a > 0 ? length / t_a : 0;
    double u = linear_scale(), vel = std::min(linear_feed_, v_max);

    if (rotation == 0) {
        EMC_TRAJ_LINEAR_MOVE m;
        m.type = EMC_MOTION_TYPE_ARC;
        m.end = to_machine(to);
        m.vel = vel * u;
        m.ini_maxvel = v_max * u;
        m.acc = a_max * u;
        m.ini_maxjerk = j_axes * u;
        m.feed_mode = feed_mode_;
        m.indexer_jnum = -1;
        m.tag = tag_;
        if (m.vel != 0 && m.acc != 0) emit_at(m, line);
    } else {
        EMC_TRAJ_CIRCULAR_MOVE m;
        m.type = EMC_MOTION_TYPE_ARC;
        m.end = to_machine(to);
        m.center.x = center.tran.x * u;
        m.center.y = center.tran.y * u;
        m.center.z = center.tran.z * u;
        m.normal.x = normal.x * u;
        m.normal.y = normal.y * u;
        m.normal.z = normal.z * u;
        m.turn = rotation > 0 ? rotation - 1 : rotation;
        m.vel = vel * u;
        m.ini_maxvel = v_max * u;
        m.acc = a_max * u;
        m.ini_maxjerk = j_axes * u;
        m.feed_mode = feed_mode_;
        m.tag = tag_;
        if (m.vel != 0 && m.acc != 0) emit_at(m, line);
    }
    end_ = to;
}

// ---- splines ----

TaskCanon::P2 TaskCanon::plane_position() const {
    EmcPose p = to_frame(chain_.empty() ? end_ : chain_.back().pose);
    switch (plane_) {
    case CANON_PLANE_YZ: return {p.tran.y, p.tran.z};
    case CANON_PLANE_XZ: return {p.tran.x, p.tran.z};
    default: return {p.tran.x, p.tran.y};
    }
}

void TaskCanon::spline_point(int line, double x, double y) {
    EmcPose p = to_frame(chain_.empty() ? end_ : chain_.back().pose);
    switch (plane_) {
    case CANON_PLANE_YZ: p.tran.y = x; p.tran.z = y; break;
    case CANON_PLANE_XZ: p.tran.x = x; p.tran.z = y; break;
    default: p.tran.x = x; p.tran.y = y; break;
    }
    STRAIGHT_FEED(line, p);
}

void TaskCanon::tangent_arc(int line, P2 from, P2 tangent, P2 to) {
    double dx = to.x - from.x, dy = to.y - from.y, den = 2 * (tangent.y * dx - tangent.x * dy);
    if (std::fabs(den) <= 1e-6) {
        spline_point(line, to.x, to.y);
        return;
    }
    double s = -(dx * dx + dy * dy) / den; // signed radius; the centre lies left of the tangent when > 0
    P2 center{from.x - s * tangent.y, from.y + s * tangent.x};
    int rotation = s > 0 ? 1 : -1;
    EmcPose end = to_frame(chain_.empty() ? end_ : chain_.back().pose);
    switch (plane_) {
    case CANON_PLANE_YZ: ARC_FEED(line, to.x, to.y, center.x, center.y, rotation, end.tran.x, end); break;
    case CANON_PLANE_XZ: ARC_FEED(line, to.y, to.x, center.y, center.x, -rotation, end.tran.y, end); break;
    default: ARC_FEED(line, to.x, to.y, center.x, center.y, rotation, end.tran.z, end); break;
    }
}

void TaskCanon::biarc(int line, P2 p0, P2 t0, P2 p4, P2 t4, double r) {
    P2 v{p0.x - p4.x, p0.y - p4.y};
    double c = v.x * v.x + v.y * v.y, b = 2 * (v.x * (r * t0.x + t4.x) + v.y * (r * t0.y + t4.y));
    double a = 2 * r * (t0.x * t4.x + t0.y * t4.y - 1), disc = b * b - 4 * a * c;
    if (disc < 0) return;
    double root = std::sqrt(disc), beta1 = (-b - root) / 2 / a, beta2 = (-b + root) / 2 / a;
    if (beta1 > 0 && beta2 > 0) return;
    double beta = std::max(beta1, beta2);
    if (!(std::fabs(beta) <= 1e8)) { // straight on, or nearly
        spline_point(line, p4.x, p4.y);
        return;
    }
    double alpha = beta * r;
    P2 p1{p0.x + alpha * t0.x, p0.y + alpha * t0.y}, p3{p4.x - beta * t4.x, p4.y - beta * t4.y};
    P2 p2{(p1.x * beta + p3.x * alpha) / (alpha + beta), (p1.y * beta + p3.y * alpha) / (alpha + beta)};
    P2 tangent{p3.x - p2.x, p3.y - p2.y};
    double n = std::hypot(tangent.x, tangent.y);
    tangent = {tangent.x / n, tangent.y / n};
    tangent_arc(line, p0, t0, p2);
    tangent_arc(line, p2, tangent, p4);
}

namespace {

struct Weighted { double x, y, w; };

// A rational B-spline of order k over any knot vector (points.size() + k knots).
class Spline {
public:
    Spline(std::vector<Weighted> points, std::vector<double> knots, unsigned k)
        : p_(std::move(points)), u_(std::move(knots)), k_(k) {}
    double low() const { return u_[k_ - 1]; }
    double high() const { return u_[p_.size()]; }

    // Cox and de Boor; the last span is closed on both ends so that the end point belongs to it.
    Weighted at(double u) const {
        size_t span = k_ - 1;
        while (span + 1 < p_.size() && u >= u_[span + 1]) span++;
        std::vector<Weighted> d(k_);
        for (size_t j = 0; j < k_; j++) {
            const Weighted &q = p_[span + 1 - k_ + j];
            d[j] = {q.x * q.w, q.y * q.w, q.w};
        }
        for (size_t r = 1; r < k_; r++)
            for (size_t j = k_ - 1; j >= r; j--) {
                size_t i = span + 1 - k_ + j;
                double width = u_[i + k_ - r] - u_[i], f = width > 0 ? (u - u_[i]) / width : 0;
                d[j] = {(1 - f) * d[j - 1].x + f * d[j].x, (1 - f) * d[j - 1].y + f * d[j].y,
                        (1 - f) * d[j - 1].w + f * d[j].w};
            }
        const Weighted &e = d[k_ - 1];
        return {e.x / e.w, e.y / e.w, e.w};
    }

    // Unit tangent by a central difference.
    Weighted tangent(double u) const {
        constexpr double du = 1e-5;
        Weighted a = at(std::max(low(), u - du)), b = at(std::min(high(), u + du));
        double x = b.x - a.x, y = b.y - a.y, n = std::hypot(x, y);
        return n > 0 ? Weighted{x / n, y / n, 0} : Weighted{1, 0, 0};
    }

    double speed(double u) const { // |dP/du|
        constexpr double du = 1e-5;
        double lo = std::max(low(), u - du), hi = std::min(high(), u + du);
        Weighted a = at(lo), b = at(hi);
        return std::hypot(b.x - a.x, b.y - a.y) / (hi - lo);
    }

    // Parameters at equal arc length: `steps` of them after low(), the last is high().
    std::vector<double> by_length(double step, double *length) const {
        std::vector<double> us, ss;
        double s = 0;
        us.push_back(low());
        ss.push_back(0);
        for (size_t i = k_ - 1; i < p_.size(); i++) {
            double a = u_[i], b = u_[i + 1];
            if (b <= a) continue;
            for (int n = 0; n < 8; n++) { // Simpson on eight parts of each span
                double x0 = a + (b - a) * n / 8, x1 = a + (b - a) * (n + 1) / 8;
                s += (x1 - x0) / 6 * (speed(x0) + 4 * speed((x0 + x1) / 2) + speed(x1));
                us.push_back(x1);
                ss.push_back(s);
            }
        }
        *length = s;
        std::vector<double> out;
        size_t j = 0;
        for (double t = step; t < s - 1e-9 && step > 0; t += step) {
            while (j + 2 < ss.size() && ss[j + 1] < t) j++;
            // Cubic Hermite of u over s, with du/ds = 1 / speed at both ends.
            double h = ss[j + 1] - ss[j], f = (t - ss[j]) / h, m0 = 1 / std::max(speed(us[j]), 1e-12),
                   m1 = 1 / std::max(speed(us[j + 1]), 1e-12);
            double f2 = f * f, f3 = f2 * f;
            out.push_back((2 * f3 - 3 * f2 + 1) * us[j] + (f3 - 2 * f2 + f) * h * m0 + (3 * f2 - 2 * f3) * us[j + 1] +
                          (f3 - f2) * h * m1);
        }
        out.push_back(high());
        return out;
    }
private:
    std::vector<Weighted> p_;
    std::vector<double> u_;
    size_t k_;
};

} // namespace

void TaskCanon::NURBS_G5_FEED(int line, const std::vector<NURBS_CONTROL_POINT> &points, unsigned order, CANON_PLANE) {
    if (points.size() < order || order < 2) return;
    size_t n = points.size() - 1, k = order;
    std::vector<double> knots;
    for (size_t i = 0; i <= n + k; i++)
        knots.push_back(i < k ? 0 : i <= n ? static_cast<double>(i - k + 1) : static_cast<double>(n - k + 2));
    std::vector<Weighted> p;
    for (const NURBS_CONTROL_POINT &q : points) p.push_back({q.x, q.y, q.w});
    Spline curve(p, knots, order);
    size_t steps = 4 * points.size();
    P2 p0{points[0].x, points[0].y};
    Weighted t = curve.tangent(0);
    P2 t0{t.x, t.y};
    for (size_t i = 1; i <= steps; i++) {
        double u = curve.high() * static_cast<double>(i) / static_cast<double>(steps);
        Weighted q = curve.at(u), w = curve.tangent(u);
        P2 p1{q.x, q.y}, t1{w.x, w.y};
        biarc(line, p0, t0, p1, t1, 1.0);
        p0 = p1;
        t0 = t1;
    }
}

void TaskCanon::NURBS_G6_FEED(int line, const std::vector<NURBS_G6_CONTROL_POINT> &points, unsigned order,
                              double feedrate, int q_option, CANON_PLANE) {
    if (points.size() < 2 * order || order < 2) return;
    size_t count = points.size() - order; // the last `order` entries only carry knots
    std::vector<Weighted> p;
    std::vector<double> knots;
    for (size_t i = 0; i < count; i++) p.push_back({points[i].x, points[i].y, points[i].r});
    for (const NURBS_G6_CONTROL_POINT &q : points) knots.push_back(q.k);
    Spline curve(p, knots, order);
    int option = q_option >= 1 && q_option <= 3 ? q_option : feedrate <= 300 ? 3 : 2;
    if (order < 3) option = 3;
    double f = feedrate >= 1500 ? feedrate / 10 : feedrate;
    double step = std::max(1, static_cast<int>(0.1 * 60 / (0.1 * f))) * (f * 0.1 / 60), length;
    std::vector<double> us;
    if (option == 1) {
        size_t div = (points.size() - order) * 15;
        for (size_t i = 1; i <= div; i++)
            us.push_back(curve.low() +
                         (curve.high() - curve.low()) * static_cast<double>(i) / static_cast<double>(div));
    } else {
        us = curve.by_length(step, &length);
    }
    Weighted q = curve.at(curve.low()), t = curve.tangent(curve.low());
    P2 p0{q.x, q.y}, t0{t.x, t.y};
    spline_point(line, p0.x, p0.y);
    for (double u : us) {
        q = curve.at(u);
        t = curve.tangent(u);
        P2 p1{q.x, q.y}, t1{t.x, t.y};
        if (option == 3) spline_point(line, p1.x, p1.y);
        else biarc(line, p0, t0, p1, t1, 1.0);
        p0 = p1;
        t0 = t1;
    }
    spline_point(line, p0.x, p0.y);
}
