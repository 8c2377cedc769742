/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * contour.cc - see contour.hh.
 *
 * Thread: [task]; every loop is bounded by the number of elements and of offset steps
 * Source: G7x sheet, sections 2 and 3
 */
#include "contour.hh"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ngc
{
namespace
{

constexpr double SLACK = 1e-3;     // monotonic within this; shorter elements are dropped
constexpr double GAP = 0.01;       // wider gaps get an arc
constexpr double LEVEL_SLACK = 1e-6;
constexpr const char *PARALLEL = "Cannot intersect parallel lines";
const Plane I(0, 1);

double dot(Plane a, Plane b) { return a.real() * b.real() + a.imag() * b.imag(); }
double cross(Plane a, Plane b) { return a.real() * b.imag() - a.imag() * b.real(); }

Element shifted(const Element &e, double by)
{
    Element r = e;
    if (!e.is_arc()) {
        const double length = e.length();
        if (length == 0) return r;
        const Plane move = -I * (e.end - e.start) / length * by;
        r.start += move;
        r.end += move;
        return r;
    }
    const double change = e.kind == Element::CCW ? by : -by;
    for (Plane *p : {&r.start, &r.end}) {
        const double old = std::abs(*p - e.centre);
        if (old > 0) *p = e.centre + (*p - e.centre) * ((old + change) / old);
    }
    return r;
}

bool line_line(const Element &a, const Element &b, Plane *p)
{
    const Plane u = a.end - a.start, v = b.end - b.start;
    const double d = cross(u, v);
    if (d == 0) return false;
    *p = a.start + u * (cross(b.start - a.start, v) / d);
    return true;
}

// The point of the line nearest to `near` on the circle; where they miss, the nearest pass.
Plane line_arc(const Element &line, Plane centre, double radius, Plane near)
{
    const Plane u = (line.end - line.start) / line.length();
    const Plane foot = line.start + u * dot(centre - line.start, u);
    const double h2 = radius * radius - std::norm(foot - centre);
    if (h2 <= 0) return foot;
    const double h = sqrt(h2);
    const Plane p = foot + u * h, q = foot - u * h;
    return std::abs(p - near) < std::abs(q - near) ? p : q;
}

Plane arc_arc(const Element &a, const Element &b, Plane near)
{
    const Plane between = b.centre - a.centre;
    const double d = std::abs(between), r1 = a.radius(), r2 = b.radius();
    if (d == 0) return near;
    const Plane u = between / d;
    const double along = (d * d + r1 * r1 - r2 * r2) / (2 * d);
    const double h2 = r1 * r1 - along * along;
    const Plane foot = a.centre + u * along;
    if (h2 <= 0) return foot;
    const Plane side = u * I * sqrt(h2);
    const Plane p = foot + side, q = foot - side;
    return std::abs(p - near) < std::abs(q - near) ? p : q;
}

// Where two neighbours, extended, meet. False: parallel lines.
bool intersect(const Element &a, const Element &b, Plane *p)
{
    if (a.is_arc() && b.is_arc()) *p = arc_arc(a, b, b.start);
    else if (a.is_arc()) *p = line_arc(b, a.centre, a.radius(), b.start);
    else if (b.is_arc()) *p = line_arc(a, b.centre, b.radius(), b.start);
    else return line_line(a, b, p);
    return true;
}

} // namespace

Plane Image::to(Plane p) const
{
    if (turned) p = -I * p;
    if (mirror_im) p = std::conj(p);
    if (mirror_re) p = -std::conj(p);
    return p;
}

Plane Image::from(Plane p) const
{
    if (mirror_re) p = -std::conj(p);
    if (mirror_im) p = std::conj(p);
    if (turned) p = I * p;
    return p;
}

bool Contour::normalise(bool turned)
{
    image = Image();
    image.turned = turned;
    const Plane d = image.to(elements.front().end - elements.back().end);
    image.mirror_im = d.imag() > 0;
    image.mirror_re = d.real() < 0;
    for (Element &e : elements) {
        e.start = image.to(e.start);
        e.end = image.to(e.end);
        e.centre = image.to(e.centre);
        if (e.is_arc() && image.flips_arcs()) e.kind = e.kind == Element::CW ? Element::CCW : Element::CW;
    }
    if (!finish_corners()) return false;
    Element &lead = elements.front();
    if (lead.end.real() > lead.start.real()) lead.start.real(lead.end.real());
    return true;
}

// Fillets and chamfers become arcs and lines between their shortened neighbours.
bool Contour::finish_corners()
{
    for (size_t k = 1; k + 1 < elements.size(); ++k) {
        Element &corner = elements[k];
        if (!corner.is_corner()) continue;
        Element &before = elements[k - 1], &after = elements[k + 1];
        double f = corner.size;
        Element a = shifted(before, f), b = shifted(after, f);
        if (a.end.real() - b.start.real() > GAP) {
            f = -f;
            a = shifted(before, f);
            b = shifted(after, f);
        }
        if (a.end.real() - b.start.real() > GAP) {
            char text[80];
            const Plane at = image.from(corner.start);
            snprintf(text, sizeof text, "Corner finish failed at (%g,%g)", at.real(), at.imag());
            error = text;
            return false;
        }
        Plane centre;
        if (!intersect(a, b, &centre)) {
            error = PARALLEL;
            return false;
        }
        a.end = centre;
        b.start = centre;
        before.end = shifted(a, -f).end;
        after.start = shifted(b, -f).start;
        corner.start = before.end;
        corner.end = after.start;
        if (corner.kind == Element::CHAMFER) {
            corner.kind = Element::LINE;
        } else {
            corner.centre = centre;
            const bool above = corner.start.imag() > centre.imag() || corner.end.imag() > centre.imag();
            corner.kind = above ? Element::CCW : Element::CW;
        }
    }
    for (size_t k = elements.size(); k-- > 1;)
        if (elements[k].is_corner() || elements[k].length() < SLACK)
            elements.erase(elements.begin() + long(k));
    return true;
}

bool Contour::is_monotonic() const
{
    for (const Element &e : elements) {
        const double advance = e.end.real() - e.start.real();
        const double low = std::min(e.start.imag(), e.end.imag()), high = std::max(e.start.imag(), e.end.imag());
        switch (e.kind) {
        case Element::CCW:
            if (low < e.centre.imag() - SLACK || advance > -SLACK) return false;
            break;
        case Element::CW:
            if (high > e.centre.imag() + SLACK || advance > -SLACK) return false;
            break;
        default:
            if (advance > SLACK) return false;
        }
    }
    return true;
}

void Contour::displace(Plane by)
{
    const Plane d = image.to(by);
    for (size_t k = 0; k < elements.size(); ++k) {
        Element &e = elements[k];
        if (k > 0) e.start += d;
        e.end += d;
        e.centre += d;
    }
}

double Contour::smallest() const
{
    double size = 1e9;
    for (size_t k = 1; k < elements.size(); ++k) {
        const Element &e = elements[k];
        size = std::min(size, e.is_arc() ? std::min(e.length(), e.radius()) : e.length());
    }
    return size;
}

// Elements k and k+1 get a common point. False: they cannot.
bool Contour::join(size_t k)
{
    Element &a = elements[k], &b = elements[k + 1];
    if (std::abs(a.end - b.start) < 1e-12) return true;
    Plane p;
    if (!intersect(a, b, &p)) {
        if (std::abs(a.end - b.start) < SLACK) return true; // averaged at the end
        error = PARALLEL;
        return false;
    }
    a.end = b.start = p;
    return true;
}

bool Contour::offset_step(double step)
{
    const std::vector<Element> old(elements.begin() + 1, elements.end());
    std::vector<Element> fresh;
    std::vector<Plane> corner; // behind each element, before the step
    for (const Element &e : old) {
        Element moved = shifted(e, step);
        const bool turned_over = e.is_arc() && dot(moved.end - e.centre, e.end - e.centre) <= 0;
        if (turned_over || moved.length() < SLACK || (moved.is_arc() && moved.radius() < SLACK)) continue;
        fresh.push_back(moved);
        corner.push_back(e.end);
    }
    if (fresh.empty()) {
        error = "the offset leaves nothing of the contour";
        return false;
    }
    // Convex corners open: an arc about the corner closes the gap.
    std::vector<Element> filled;
    for (size_t k = 0; k < fresh.size(); ++k) {
        filled.push_back(fresh[k]);
        if (k + 1 == fresh.size() || fresh[k].end.real() - fresh[k + 1].start.real() <= GAP) continue;
        Element arc;
        arc.kind = step > 0 ? Element::CCW : Element::CW;
        arc.start = fresh[k].end;
        arc.end = fresh[k + 1].start;
        arc.centre = corner[k];
        filled.push_back(arc);
    }
    elements.resize(1);
    elements.insert(elements.end(), filled.begin(), filled.end());

    // Concave corners close; an element whose direction has turned is gone.
    for (size_t pass = 0; pass < filled.size() + 1; ++pass) {
        const std::vector<Element> before = elements;
        for (size_t k = 1; k + 1 < elements.size(); ++k)
            if (!join(k)) return false;
        size_t gone = 0;
        double least = 1e99;
        for (size_t k = 1; k < elements.size(); ++k) {
            const Plane now = elements[k].end - elements[k].start, then = before[k].end - before[k].start;
            const bool reversed = dot(now, then) < 0 || now.real() > SLACK;
            if (reversed && before[k].length() < least) {
                least = before[k].length();
                gone = k;
            }
        }
        if (gone == 0) return true;
        elements = before;
        elements.erase(elements.begin() + long(gone));
        if (elements.size() < 2) {
            error = "the offset leaves nothing of the contour";
            return false;
        }
    }
    return true;
}

bool Contour::offset(double delta)
{
    if (delta == 0 || elements.size() < 2) return true;
    const Element &lead = elements.front();
    const Plane far = elements.back().start - lead.start;
    if (std::abs(far) > 0 && ((lead.end - lead.start) / far).imag() < 0) delta = -delta;
    enum { MAX_STEPS = 100000 };
    double left = fabs(delta);
    for (int n = 0; left > 0; ++n) {
        if (n == MAX_STEPS) {
            error = "the offset is too large for the contour's small elements";
            return false;
        }
        const double step = std::min(left, std::max(smallest() / 2, SLACK / 2));
        if (!offset_step(std::copysign(step, delta))) return false;
        left -= step;
    }
    for (size_t k = 1; k + 1 < elements.size(); ++k) {
        const Plane middle = (elements[k].end + elements[k + 1].start) / 2.0;
        elements[k].end = elements[k + 1].start = middle;
    }
    elements.front().end = elements[1].start;
    return true;
}

bool meets_level(const Element &e, double x, Crossing which, Plane *point)
{
    if (!e.is_arc()) {
        const double rise = e.end.imag() - e.start.imag();
        if (fabs(rise) < LEVEL_SLACK) {
            if (fabs(x - e.start.imag()) > LEVEL_SLACK) return false;
            *point = which == Crossing::FIRST ? e.start : e.end;
            return true;
        }
        const double t = (x - e.start.imag()) / rise, slack = LEVEL_SLACK / fabs(rise);
        if (t < -slack || t > 1 + slack) return false;
        *point = Plane(e.start.real() + t * (e.end.real() - e.start.real()), x);
        return true;
    }
    const double radius = e.radius(), height = x - e.centre.imag();
    const double h2 = radius * radius - height * height;
    if (fabs(height) > radius + LEVEL_SLACK) return false;
    const double h = sqrt(std::max(h2, 0.0));
    const Plane right(e.centre.real() + h, x), left(e.centre.real() - h, x);
    // Travel is toward -Re; arcs stay on one side of their centre's height.
    const bool upper = e.kind == Element::CCW;
    if (upper ? height < -LEVEL_SLACK : height > LEVEL_SLACK) return false;
    auto on = [&](Plane p) {
        return p.real() <= e.start.real() + LEVEL_SLACK && p.real() >= e.end.real() - LEVEL_SLACK;
    };
    const Plane first = on(right) ? right : left, last = on(left) ? left : right;
    *point = which == Crossing::FIRST ? first : last;
    return on(*point);
}

} // namespace ngc
