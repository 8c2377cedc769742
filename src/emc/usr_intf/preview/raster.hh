// SPDX-License-Identifier: GPL-2.0-or-later
// Raster: draws tool paths into a picture in memory. Any thread but one at a time; no display needed.
//
// Lines are drawn in the order given (no depth). Pieces that end in the pixel in which they begin
// are skipped, so the cost of a picture is bounded by its vertices (a projection each) and pixels.
#ifndef KERF_PREVIEW_RASTER_HH
#define KERF_PREVIEW_RASTER_HH

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace kerf {

struct Rgba {
    uint8_t r, g, b, a;
};

/// Row-major 4x4: clip = matrix * (x, y, z, 1). Visible: -w <= x, y, z <= w; y points up.
using Matrix = std::array<double, 16>;

/// A tool path as runs of vertices. Vertex n ends the piece that begins at n-1; kinds[n] picks its
/// colour in a palette; alpha 0 draws nothing. `stride`: floats from one vertex to the next (>= 3).
/// With `rgba` each vertex has its own colour instead, four bytes with the same stride. With `index`
/// the path is the `count` vertices that it lists.
struct Path {
    const float *xyz = nullptr;
    const uint8_t *kinds = nullptr;
    size_t count = 0;
    size_t stride = 3;
    const uint8_t *rgba = nullptr;
    const uint32_t *index = nullptr;
    size_t vertex(size_t i) const { return index ? index[i] : i; }
};

class Raster {
public:
    /// Throws std::invalid_argument unless 1 <= width, height <= 16384 (pixels).
    Raster(int width, int height);
    int width() const { return w_; }
    int height() const { return h_; }

    void clear(Rgba colour);
    /// Vertices first to last (exclusive); width in pixels (1 or more).
    void draw(const Path &path, const std::vector<Rgba> &palette, const Matrix &matrix, size_t first, size_t last,
              int line_width = 1);
    /// Vertex that ends the piece nearest to a pixel within `radius` pixels, or -1.
    static long pick(const Path &path, const std::vector<Rgba> &palette, const Matrix &matrix, int width, int height,
                     double px, double py, double radius);
    /// The picture as a binary PPM file ("P6").
    std::string ppm() const;
    Rgba pixel(int x, int y) const;

private:
    void line(double x0, double y0, double x1, double y1, Rgba colour, int line_width);
    void thin_line(double x0, double y0, double x1, double y1, int steps, Rgba colour);
    void blend(int x, int y, Rgba colour);
    int w_, h_;
    std::vector<uint8_t> rgb_;
    int last_x_ = -1, last_y_ = -1; // pixel of a translucent chain that was drawn last
};

} // namespace kerf

#endif
