/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * program.hh - a whole program as arrays: the tool path for drawing, measuring, picking.
 *
 * Units:  inches, degrees, inches a minute, seconds; machine coordinates of the
 *         controlled point (work offsets applied, tool offset not)
 * Source: preview sheet, sections 8 and 9
 */
#ifndef KERF_PROGRAM_HH
#define KERF_PROGRAM_HH

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "interp.hh"
#include "preview_canon.hh"

/// What a piece of the path is; the numbers are part of the Python interface.
enum class PathKind : uint8_t { TRAVERSE = 0, FEED = 1, ARC = 2, JUMP = 3, DWELL = 4, TOOL_CHANGE = 5 };

struct Box {
    std::array<double, 3> low{9e99, 9e99, 9e99}, high{-9e99, -9e99, -9e99};
    void add(double x, double y, double z);
    bool empty() const { return low[0] > high[0]; }
};

struct ProgramMark {
    int line;
    double x, y, z;
    int plane;     // 0 XY, 1 XZ, 2 YZ
    bool user_m;   // M1xx, else a dwell
};

/// What a program is read with.
struct ProgramOptions {
    std::string parameter_file, ini_file;
    std::string interpreter; // library, as of make_interpreter()
    std::vector<std::string> init_codes;
    std::vector<CANON_TOOL_TABLE> tools;
    int axis_mask = 0x1ff;
    double linear_units = 1, angular_units = 1; // machine units per mm, per degree
    int arc_division = 64;
    bool block_delete = false;
    Point9 start{}; // machine position, inches
    size_t max_vertices = 0; // beyond it, only every n-th piece is kept (0: no bound)
    bool keep_path = true;   // false: only lengths, times and extents are found out
    /// Joins HAL under this name and the process's number when the program looks at a pin; empty: never.
    std::string hal_component;
};

/// Vertices of nine axes; of each the first three, or as many as it takes to hold those that ever leave zero.
class PathPoints {
public:
    size_t size() const { return data_.size() / columns_; }
    bool empty() const { return data_.empty(); }
    size_t columns() const { return columns_; }
    const float *data() const { return data_.data(); }
    void push_back(const Point9 &p);
    void set(size_t i, const Point9 &p);
    void move(size_t to, size_t from) { std::copy_n(&data_[from * columns_], columns_, &data_[to * columns_]); }
    void resize(size_t n) { data_.resize(n * columns_); }
    void shrink_to_fit() { data_.shrink_to_fit(); }
    /// All vertices with nine columns; what was made for that stays as long as the path.
    const float *nine();

private:
    std::vector<float> with_columns(size_t columns) const;
    void make_room(const Point9 &p);
    std::vector<float> data_, wide_;
    size_t columns_ = 3;
};

/// The path of a program. Vertex n ends a piece that began at vertex n-1; a JUMP vertex
/// begins a new run.
struct ProgramPath {
    PathPoints points;
    std::vector<int32_t> lines;
    std::vector<uint8_t> kinds;
    std::vector<std::pair<uint32_t, int>> tool_changes; // vertex, tool number; the first MOST_CHANGES
    std::vector<ProgramMark> marks;                     // of a very long program every n-th
    std::vector<std::string> messages;
    Box extents, extents_notool;
    double rapid_length = 0, cutting_length = 0, dwell_time = 0;
    std::map<float, double> feed_lengths; // cutting length by feed rate
    size_t moves = 0;
    int result = 0, last_line = 0;
    std::string error;
    Fault fault;
    bool aborted = false;
    int thinned = 1; // every n-th piece of a run is kept
    std::optional<double> foam_z, foam_w; // (AXIS,XY_Z_POS,...), (AXIS,UV_Z_POS,...): inches
    int notify = 0;
    std::string notify_message;

    /// x, y, z and plane of each mark of a kind.
    std::vector<float> mark_places(bool user_m) const;
    void release_path(); ///< frees points, lines and kinds
    double cutting_time(double max_feed) const; ///< s; max_feed: in/min
};

/// Reads a program. progress(line) is asked about ten times a second; true stops.
void read_program(ProgramPath &path, const std::string &file, const ProgramOptions &options,
                  const std::function<bool(int)> &progress);

#endif
