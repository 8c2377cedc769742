// SPDX-License-Identifier: GPL-2.0-or-later
// Drawing: a program's path made ready to be drawn. Any thread, but building is not shared.
//
// Vertices of nine axes become points in space ([DISPLAY]GEOMETRY, or one plane of a foam cutter).
// Levels of detail are lists of vertex numbers, each a subset of the one before: a vertex is left
// out where it lies within the level's tolerance of the straight piece between those kept, so a level
// is never further from the path than its tolerance. Lists are cut into chunks with boxes: what is outside the
// window is not drawn.
#ifndef KERF_PREVIEW_DRAWING_HH
#define KERF_PREVIEW_DRAWING_HH

#include "raster.hh"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace kerf {

/// How nine axes become a point in space.
struct Placement {
    std::string geometry = "XYZABCUVW";    // letters, '-' turns the next, '!': rotations respect the work offset
    std::array<double, 9> offset{};        // the work offset, inches and degrees
    std::string coordinates = "XYZABCUVW"; // letters that the machine has
    int plane = -1;                        // -1: space; 0: XY of a foam cutter, 1: its UV
    double plane_z = 0;                    // height of that plane, inches
};

class Places {
public:
    explicit Places(const Placement &placement);
    std::array<float, 3> operator()(const float *nine) const;
    /// True when a move of a rotary axis is a curve in space.
    bool turns() const { return turns_; }

private:
    Placement p_;
    std::vector<std::pair<char, double>> letters_;
    bool turns_ = false;
};

/// Numbers in a row: own ones, or a part of memory that somebody else keeps.
template <class T> class Row {
public:
    Row() = default;
    Row(std::vector<T> own) : own_(std::move(own)), data_(own_.data()), size_(own_.size()) {}
    Row(const T *data, size_t size) : data_(data), size_(size) {}
    Row(Row &&) = default; // a vector's numbers stay where they are when it moves
    Row &operator=(Row &&) = default;
    const T *data() const { return data_; }
    size_t size() const { return size_; }
    const T &operator[](size_t i) const { return data_[i]; }
    const T *begin() const { return data_; }
    const T *end() const { return data_ + size_; }

private:
    std::vector<T> own_;
    const T *data_ = nullptr;
    size_t size_ = 0;
};

struct Level {
    double tolerance = 0;              // inches
    Row<uint32_t> index;               // vertex numbers in order; empty where the tolerance is 0: all
    Row<std::array<float, 6>> boxes;   // least and greatest of each chunk
};

/// A file in memory, for reading; ends with the last that uses it.
class MappedFile {
public:
    explicit MappedFile(int fd); // throws std::runtime_error
    ~MappedFile();
    MappedFile(const MappedFile &) = delete;
    MappedFile &operator=(const MappedFile &) = delete;
    const char *data() const { return data_; }
    size_t size() const { return size_; }

private:
    const char *data_ = nullptr;
    size_t size_ = 0;
};

/// What to draw of one level: pieces of its list.
struct Choice {
    size_t level = 0;
    std::vector<int32_t> first, count; // within Level::index; a piece begins with the vertex it starts from
    size_t vertices = 0;               // sum of count
    bool exact = true;                 // the level's tolerance is below what was asked for
};

class Drawing {
public:
    static constexpr size_t CHUNK = 2048; // list entries

    /// points: count rows of the first `columns` of nine axes (inches, degrees); the others are zero.
    /// kinds: what ends at a vertex, JUMP (3) begins a run.
    Drawing(const float *points, const uint8_t *kinds, const int32_t *lines, size_t count, size_t columns,
            const Placement &placement);

    /// One that another process wrote; its numbers stay in the file. Throws std::runtime_error when it is not complete.
    explicit Drawing(std::unique_ptr<MappedFile> file);
    /// For the other constructor; the same build reads it. Throws std::runtime_error.
    void write(int fd) const;

    const Row<float> &xyz() const { return xyz_; }
    const Row<uint8_t> &kinds() const { return kinds_; }
    const Row<int32_t> &lines() const { return lines_; }
    const std::vector<Level> &levels() const { return levels_; }
    /// Least and greatest of what is drawn; false when nothing is.
    bool extents(std::array<double, 3> &low, std::array<double, 3> &high) const;

    /// The coarsest level that is exact to `pixels` in a window; a coarser one where it needs more than
    /// `budget` vertices (0: no bound), and where none is small enough, every n-th piece of the last.
    Choice choose(const Matrix &matrix, int width, int height, double pixels, size_t budget) const;
    /// Into a picture in memory, exact to `pixels`. palette: colours of kinds.
    void draw(Raster &raster, const std::vector<Rgba> &palette, const Matrix &matrix, double pixels) const;
    /// Pieces of a level's list, as choose() gives them. Throws std::out_of_range.
    void draw(Raster &raster, const std::vector<Rgba> &palette, const Matrix &matrix, size_t level,
              const std::vector<int32_t> &first, const std::vector<int32_t> &count) const;
    /// [first, last) vertices of each stretch that a source line draws; `first` is where it starts from.
    std::vector<std::pair<uint32_t, uint32_t>> spans(int32_t line) const;
    /// Source line nearest to a pixel within `radius`, or -1. shown: bit k for kind k.
    int32_t pick(const Matrix &matrix, int width, int height, double x, double y, double radius, unsigned shown) const;

private:
    /// Length of a level's list, and an entry of it; level 0 lists all vertices.
    size_t entries(const Level &l) const { return l.tolerance > 0 ? l.index.size() : kinds_.size(); }
    uint32_t vertex(const Level &l, size_t i) const { return l.tolerance > 0 ? l.index[i] : uint32_t(i); }
    void build_levels();
    void simplify(const Level &from, float reach, std::vector<uint32_t> &kept) const;
    void add_boxes(Level &level) const;
    std::unique_ptr<MappedFile> file_;
    Row<float> xyz_;
    Row<uint8_t> kinds_;
    Row<int32_t> lines_;
    std::vector<Level> levels_;
};

} // namespace kerf

#endif
