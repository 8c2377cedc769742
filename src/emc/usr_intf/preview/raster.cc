// SPDX-License-Identifier: GPL-2.0-or-later
#include "raster.hh"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace kerf {

namespace {

constexpr int MAX_SIZE = 16384;     // pixels
constexpr double NEAR_W = 1e-6;     // a point behind the eye has w below this

struct Clip {
    double x, y, w;
};

Clip project(const Matrix &m, const float *p)
{
    double x = p[0], y = p[1], z = p[2];
    return {m[0] * x + m[1] * y + m[2] * z + m[3], m[4] * x + m[5] * y + m[6] * z + m[7],
            m[12] * x + m[13] * y + m[14] * z + m[15]};
}

/// Cuts a piece at the plane of the eye. False: nothing of it is in front.
bool clip_near(Clip &a, Clip &b)
{
    if (a.w < NEAR_W && b.w < NEAR_W) return false;
    if (a.w >= NEAR_W && b.w >= NEAR_W) return true;
    double t = (NEAR_W - a.w) / (b.w - a.w);
    Clip c{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), NEAR_W};
    (a.w < NEAR_W ? a : b) = c;
    return true;
}

/// One edge of the window: keeps the part where p*t <= q (Liang and Barsky, 1984).
bool clip_edge(double p, double q, double &t0, double &t1)
{
    if (p == 0.0) return q >= 0.0;
    double t = q / p;
    if (p < 0.0) {
        if (t > t1) return false;
        t0 = std::max(t0, t);
    } else {
        if (t < t0) return false;
        t1 = std::min(t1, t);
    }
    return true;
}

/// Colour of the piece that ends at vertex i.
Rgba colour_of(const Path &path, const std::vector<Rgba> &palette, size_t entry)
{
    const size_t i = path.vertex(entry);
    if (path.rgba) {
        const uint8_t *c = path.rgba + i * path.stride * sizeof(float);
        return {c[0], c[1], c[2], c[3]};
    }
    size_t kind = path.kinds ? path.kinds[i] : 0;
    return kind < palette.size() ? palette[kind] : Rgba{0, 0, 0, 0};
}

bool same(Rgba a, Rgba b) { return a.r == b.r && a.g == b.g && a.b == b.b && a.a == b.a; }

/// Square of the distance of a point from a piece.
double distance2(double px, double py, double x0, double y0, double x1, double y1)
{
    double dx = x1 - x0, dy = y1 - y0, length2 = dx * dx + dy * dy;
    double t = length2 > 0 ? std::clamp(((px - x0) * dx + (py - y0) * dy) / length2, 0.0, 1.0) : 0.0;
    double ex = x0 + t * dx - px, ey = y0 + t * dy - py;
    return ex * ex + ey * ey;
}

struct Window {
    double cx, cy;
    Window(int width, int height) : cx(width / 2.0), cy(height / 2.0) {}
    double x(const Clip &c) const { return cx + cx * c.x / c.w; }
    double y(const Clip &c) const { return cy - cy * c.y / c.w; }
};

} // namespace

Raster::Raster(int width, int height) : w_(width), h_(height)
{
    if (width < 1 || height < 1 || width > MAX_SIZE || height > MAX_SIZE)
        throw std::invalid_argument("Raster: width and height must be 1 to " + std::to_string(MAX_SIZE) + " pixels");
    rgb_.resize(size_t(3) * w_ * h_);
}

void Raster::clear(Rgba c)
{
    for (size_t i = 0; i < rgb_.size(); i += 3) {
        rgb_[i] = c.r;
        rgb_[i + 1] = c.g;
        rgb_[i + 2] = c.b;
    }
}

void Raster::blend(int x, int y, Rgba c)
{
    uint8_t *p = &rgb_[3 * (size_t(y) * w_ + x)];
    if (c.a == 255) {
        p[0] = c.r;
        p[1] = c.g;
        p[2] = c.b;
        return;
    }
    p[0] = uint8_t(p[0] + (c.r - p[0]) * c.a / 255);
    p[1] = uint8_t(p[1] + (c.g - p[1]) * c.a / 255);
    p[2] = uint8_t(p[2] + (c.b - p[2]) * c.a / 255);
}

void Raster::line(double x0, double y0, double x1, double y1, Rgba colour, int line_width)
{
    double dx = x1 - x0, dy = y1 - y0, t0 = 0.0, t1 = 1.0;
    if (!clip_edge(-dx, x0, t0, t1) || !clip_edge(dx, w_ - 0.001 - x0, t0, t1) || !clip_edge(-dy, y0, t0, t1) ||
        !clip_edge(dy, h_ - 0.001 - y0, t0, t1))
        return;
    double ax = x0 + t0 * dx, ay = y0 + t0 * dy, bx = x0 + t1 * dx, by = y0 + t1 * dy;
    bool steep = std::fabs(by - ay) > std::fabs(bx - ax);
    int steps = int(std::max(std::fabs(bx - ax), std::fabs(by - ay))) + 1;
    if (line_width == 1) return thin_line(ax, ay, bx, by, steps, colour);
    double sx = (bx - ax) / steps, sy = (by - ay) / steps;
    int before = (line_width - 1) / 2;
    for (int i = 0; i <= steps; i++) {
        int x = int(ax + i * sx), y = int(ay + i * sy);
        for (int k = -before; k < line_width - before; k++) {
            int u = steep ? x + k : x, v = steep ? y : y + k;
            if (u >= 0 && v >= 0 && u < w_ && v < h_) blend(u, v, colour);
        }
    }
}

// The ends are within the picture. Sixteen bits of a pixel's fraction: exact enough for MAX_SIZE steps.
void Raster::thin_line(double x0, double y0, double x1, double y1, int steps, Rgba colour)
{
    constexpr double ONE = 65536;
    int64_t x = int64_t(x0 * ONE), y = int64_t(y0 * ONE);
    const int64_t sx = int64_t((x1 - x0) * ONE) / steps, sy = int64_t((y1 - y0) * ONE) / steps;
    if (colour.a == 255) {
        for (int i = 0; i <= steps; i++, x += sx, y += sy) blend(int(x >> 16), int(y >> 16), colour);
        return;
    }
    for (int i = 0; i <= steps; i++, x += sx, y += sy) { // each pixel of a chain once
        const int u = int(x >> 16), v = int(y >> 16);
        if (u == last_x_ && v == last_y_) continue;
        last_x_ = u;
        last_y_ = v;
        blend(u, v, colour);
    }
}

void Raster::draw(const Path &path, const std::vector<Rgba> &palette, const Matrix &matrix, size_t first, size_t last,
                  int line_width) {
    last = std::min(last, path.count);
    if (first >= last) return;
    Window window(w_, h_);
    last_x_ = last_y_ = -1;
    Clip from = project(matrix, path.xyz + path.vertex(first) * path.stride);
    for (size_t i = first + 1; i < last; i++) {
        Clip to = project(matrix, path.xyz + path.vertex(i) * path.stride);
        Rgba colour = colour_of(path, palette, i);
        Clip a = from, b = to;
        if (colour.a == 0 || !clip_near(a, b)) {
            from = to;
            continue;
        }
        double x0 = window.x(a), y0 = window.y(a), x1 = window.x(b), y1 = window.y(b);
        // A piece within one pixel is left to the next that leaves it.
        if (int(x0) == int(x1) && int(y0) == int(y1) && i + 1 < last && same(colour, colour_of(path, palette, i + 1)))
            continue;
        line(x0, y0, x1, y1, colour, line_width);
        from = to;
    }
}

long Raster::pick(const Path &path, const std::vector<Rgba> &palette, const Matrix &matrix, int width, int height,
                  double px, double py, double radius) {
    if (path.count < 2) return -1;
    Window window(width, height);
    long best = -1;
    double best2 = radius * radius;
    Clip from = project(matrix, path.xyz);
    for (size_t i = 1; i < path.count; i++) {
        Clip to = project(matrix, path.xyz + i * path.stride);
        Clip a = from, b = to;
        from = to;
        if (colour_of(path, palette, i).a == 0 || !clip_near(a, b)) continue;
        double d2 = distance2(px, py, window.x(a), window.y(a), window.x(b), window.y(b));
        if (d2 <= best2) {
            best2 = d2;
            best = long(i);
        }
    }
    return best;
}

std::string Raster::ppm() const
{
    std::string out = "P6\n" + std::to_string(w_) + " " + std::to_string(h_) + "\n255\n";
    out.append(reinterpret_cast<const char *>(rgb_.data()), rgb_.size());
    return out;
}

Rgba Raster::pixel(int x, int y) const
{
    if (x < 0 || y < 0 || x >= w_ || y >= h_) throw std::out_of_range("Raster: no such pixel");
    const uint8_t *p = &rgb_[3 * (size_t(y) * w_ + x)];
    return {p[0], p[1], p[2], 255};
}

} // namespace kerf
