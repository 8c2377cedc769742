/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * program.cc - see program.hh.
 */
#include "program.hh"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "emc/rs274ngc/setup.hh"

namespace
{
constexpr size_t MOST_MARKS = 20000, MOST_CHANGES = 20000; // kept, also of a program without an end
} // namespace

void Box::add(double x, double y, double z)
{
    const double p[3] = {x, y, z};
    for (size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], p[i]);
        high[i] = std::max(high[i], p[i]);
    }
}

std::vector<float> PathPoints::with_columns(size_t columns) const
{
    std::vector<float> out(size() * columns);
    for (size_t i = 0; i < size(); ++i) std::copy_n(&data_[i * columns_], columns_, &out[i * columns]);
    return out;
}

const float *PathPoints::nine()
{
    if (columns_ == 9) return data_.data();
    if (wide_.empty()) wide_ = with_columns(9);
    return wide_.data();
}

void PathPoints::make_room(const Point9 &p)
{
    size_t needed = 9;
    while (needed > columns_ && float(p[needed - 1]) == 0) --needed;
    if (needed == columns_) return;
    data_ = with_columns(needed);
    columns_ = needed;
}

void PathPoints::push_back(const Point9 &p)
{
    make_room(p);
    for (size_t k = 0; k < columns_; ++k) data_.push_back(float(p[k]));
}

void PathPoints::set(size_t i, const Point9 &p)
{
    make_room(p);
    for (size_t k = 0; k < columns_; ++k) data_[i * columns_ + k] = float(p[k]);
}

std::vector<float> ProgramPath::mark_places(bool user_m) const
{
    std::vector<float> out;
    for (const ProgramMark &m : marks)
        if (m.user_m == user_m) out.insert(out.end(), {float(m.x), float(m.y), float(m.z), float(m.plane)});
    return out;
}

void ProgramPath::release_path()
{
    points = PathPoints();
    std::vector<int32_t>().swap(lines);
    std::vector<uint8_t>().swap(kinds);
}

double ProgramPath::cutting_time(double max_feed) const
{
    double minutes = 0;
    for (const auto &[feed, length] : feed_lengths) {
        const double rate = feed > 0 ? std::min(double(feed), max_feed) : max_feed;
        if (rate > 0) minutes += length / rate;
    }
    return minutes * 60;
}

namespace
{

class PathCanon final : public PreviewCanon
{
  public:
    PathCanon(ProgramPath &p, const ProgramOptions &o) : path(p), options(o), tools(o.tools), here(o.start) {}
    Interp *interp = nullptr;

    double GET_EXTERNAL_LENGTH_UNITS() override { return options.linear_units; }
    double GET_EXTERNAL_ANGLE_UNITS() override { return options.angular_units; }
    int GET_EXTERNAL_AXIS_MASK() override { return options.axis_mask; }
    bool GET_BLOCK_DELETE() override { return options.block_delete; }
    std::string GET_EXTERNAL_PARAMETER_FILE_NAME() override { return options.parameter_file; }
    int GET_EXTERNAL_TOOL_TABLE_LAST() override { return int(tools.size()) - 1; }
    CANON_TOOL_TABLE GET_EXTERNAL_TOOL_TABLE(int idx) override
    {
        return size_t(idx) < tools.size() ? tools[size_t(idx)] : tooldata_entry_init();
    }
    void SET_TOOL_TABLE_ENTRY(int idx, int toolno, const EmcPose &offset, double diameter, double frontangle,
                              double backangle, int orientation) override
    {
        if (idx < 0 || size_t(idx) >= tools.size()) return;
        CANON_TOOL_TABLE &t = tools[size_t(idx)];
        t.toolno = toolno;
        t.offset = offset;
        t.diameter = diameter;
        t.frontangle = frontangle;
        t.backangle = backangle;
        t.orientation = orientation;
    }
    void CHANGE_TOOL_NUMBER(int idx) override { load_tool(size_t(std::max(idx, 0))); }
    void print_line(const char *) override {}
    bool hal_value(const char *name, double *value) override
    {
        if (options.hal_component.empty()) return hal_number(name, value);
        return hal_number_joining(options.hal_component, name, value);
    }

    /// All that came before belongs to the preparation.
    void begin_program()
    {
        first_move = true;
    }

  protected:
    void on_g5x(int, const EmcPose &o) override { frame.g5x = point9(o); }
    void on_g92(const EmcPose &o) override { frame.g92 = point9(o); }
    void on_rotation(double degrees) override
    {
        frame.cosine = cos(degrees * (M_PI / 180));
        frame.sine = sin(degrees * (M_PI / 180));
    }
    void on_plane(int) override {}
    void on_feed_rate(double rate) override { feed = float(rate); }
    void on_tool_offset(int, const EmcPose &o) override
    {
        first_move = true;
        const Point9 fresh = point9(o);
        for (size_t i = 0; i < 9; ++i) here[i] += tool[i] - fresh[i];
        tool = fresh;
        need_jump = true;
    }
    void on_traverse(int line, const EmcPose &end) override
    {
        if (suppress > 0) return;
        const Point9 to = frame.to_machine(point9(end));
        if (first_move) {
            here = to;
            need_jump = true;
            return;
        }
        piece(line, to, PathKind::TRAVERSE);
    }
    void on_feed(int line, const EmcPose &end) override
    {
        if (suppress > 0) return;
        first_move = false;
        piece(line, frame.to_machine(point9(end)), PathKind::FEED);
    }
    void on_probe(int line, const EmcPose &end) override { on_feed(line, end); }
    void on_tap(int line, double x, double y, double z) override
    {
        if (suppress > 0) return;
        first_move = false;
        Point9 p = frame.from_machine(here);
        p[0] = x;
        p[1] = y;
        p[2] = z;
        const Point9 back = here;
        piece(line, frame.to_machine(p), PathKind::FEED);
        piece(line, back, PathKind::FEED);
    }
    void on_arc(int line, double x1, double y1, double cx, double cy, int rot, double z1, const EmcPose &end) override
    {
        if (suppress > 0) return;
        first_move = false;
        segments.clear();
        arc_segments(segments, frame, plane, here, x1, y1, cx, cy, rot, z1, point9(end), options.arc_division,
                     25.4);
        for (const Point9 &p : segments) piece(line, p, PathKind::ARC);
    }
    void on_dwell(int line, double seconds) override
    {
        if (suppress > 0) return;
        path.dwell_time += seconds;
        mark(line, false);
    }
    void on_user_m(int line, int, double, double) override
    {
        if (suppress > 0) return;
        mark(line, true);
    }
    void on_tool_change(int, int toolno) override
    {
        first_move = true;
        need_jump = true;
        const auto place =
            std::find_if(tools.begin(), tools.end(), [&](const CANON_TOOL_TABLE &t) {
                return &t != tools.data() && t.toolno == toolno;
            });
        load_tool(place == tools.end() ? 0 : size_t(place - tools.begin()));
        if (path.tool_changes.size() < MOST_CHANGES)
            path.tool_changes.emplace_back(uint32_t(path.points.size()), toolno);
    }
    void on_comment(const char *text) override
    {
        const char *rest = strncmp(text, "AXIS,", 5) == 0      ? text + 5
                           : strncmp(text, "PREVIEW,", 8) == 0 ? text + 8
                                                               : nullptr;
        if (!rest) return;
        const std::string command(rest, strcspn(rest, ","));
        if (command == "stop") stop = true;
        else if (command == "hide") ++suppress;
        else if (command == "show") --suppress;
        else if (command == "XY_Z_POS") foam_plane(path.foam_z, rest, 5 / 25.4);
        else if (command == "UV_Z_POS") foam_plane(path.foam_w, rest, 30);
        else if (command == "notify") {
            ++path.notify;
            const char *comma = strchr(rest, ',');
            path.notify_message = comma ? std::string(comma + 1, strcspn(comma + 1, ",")) : "";
            if (path.notify_message.empty()) path.notify_message = "(AXIS,notify):" + std::to_string(path.notify);
        }
    }
    void on_message(const char *text) override
    {
        if (path.messages.size() < 1000) path.messages.emplace_back(text);
    }
    int last_line() override { return interp ? interp->sequence_number() : 0; }

  public:
    bool stop = false; // (AXIS,stop)

  private:
    /// Index 0 is the spindle, as in the machine's own table.
    void load_tool(size_t idx)
    {
        if (idx >= tools.size()) return;
        if (interp && interp->setup().random_toolchanger) std::swap(tools[0], tools[idx]);
        else tools[0] = idx > 0 ? tools[idx] : tooldata_entry_init();
    }
    /// The height behind the comma, inches; without a number nothing changes.
    void foam_plane(std::optional<double> &plane, const char *rest, double unreadable)
    {
        const char *comma = strchr(rest, ',');
        if (!comma) return;
        char *end = nullptr;
        const double value = strtod(comma + 1, &end);
        const size_t blank = strspn(end, " \t");
        plane = end != comma + 1 && (end[blank] == 0 || end[blank] == ',') ? to_inch(value) : unreadable;
    }
    /// Keeps every second piece of each run from now on, and of what is there.
    void thin()
    {
        size_t to = 0;
        bool odd = false;
        for (size_t i = 0, next = 0; i < path.points.size(); ++i) {
            while (next < path.tool_changes.size() && path.tool_changes[next].first <= i)
                path.tool_changes[next++].first = uint32_t(to);
            const bool ends = i + 1 == path.points.size() || path.kinds[i + 1] != path.kinds[i];
            odd = !odd;
            if (path.kinds[i] != uint8_t(PathKind::JUMP) && !ends && odd) continue;
            path.points.move(to, i);
            path.lines[to] = path.lines[i];
            path.kinds[to++] = path.kinds[i];
        }
        path.points.resize(to);
        path.lines.resize(to);
        path.kinds.resize(to);
        path.thinned *= 2;
    }
    void vertex(int line, const Point9 &p, PathKind kind)
    {
        if (!options.keep_path) return;
        if (options.max_vertices && path.points.size() >= options.max_vertices) thin();
        // A piece that was left out is replaced by the next of its kind.
        if (path.thinned > 1 && kind != PathKind::JUMP && left_out && !path.points.empty() &&
            path.kinds.back() == uint8_t(kind)) {
            left_out = ++skipped % path.thinned != 0;
            path.points.set(path.points.size() - 1, p);
            path.lines.back() = line;
            return;
        }
        left_out = path.thinned > 1 && kind != PathKind::JUMP;
        path.points.push_back(p);
        path.lines.push_back(line);
        path.kinds.push_back(uint8_t(kind));
    }
    void extend(const Point9 &p)
    {
        path.extents.add(p[0] + tool[0], p[1] + tool[1], p[2] + tool[2]);
        path.extents_notool.add(p[0], p[1], p[2]);
    }
    /// The lines of a subroutine in a file of its own are told as the one that calls it.
    int shown_line(int line) const { return interp && interp->setup().source > 0 ? interp->main_line() : line; }
    void piece(int line, const Point9 &to, PathKind kind)
    {
        line = shown_line(line);
        if (need_jump) {
            vertex(line, here, PathKind::JUMP);
            extend(here);
            need_jump = false;
        }
        vertex(line, to, kind);
        extend(to);
        const double length = sqrt((to[0] - here[0]) * (to[0] - here[0]) + (to[1] - here[1]) * (to[1] - here[1]) +
                                   (to[2] - here[2]) * (to[2] - here[2]));
        if (kind == PathKind::TRAVERSE) {
            path.rapid_length += length;
        } else {
            path.cutting_length += length;
            if (!feed_length || feed_key != feed) {
                feed_length = &path.feed_lengths[feed];
                feed_key = feed;
            }
            *feed_length += length;
        }
        ++path.moves;
        here = to;
    }
    void mark(int line, bool user_m)
    {
        if (++marked % mark_step != 0) return;
        if (path.marks.size() >= MOST_MARKS) { // from now on half as many, and of what is there
            size_t to = 0;
            for (size_t i = 1; i < path.marks.size(); i += 2) path.marks[to++] = path.marks[i];
            path.marks.resize(to);
            mark_step *= 2;
        }
        const int p = plane == CANON_PLANE_XZ ? 1 : plane == CANON_PLANE_YZ ? 2 : 0;
        path.marks.push_back({shown_line(line), here[0], here[1], here[2], p, user_m});
    }

    ProgramPath &path;
    const ProgramOptions &options;
    std::vector<CANON_TOOL_TABLE> tools; // as the program changes them
    PreviewFrame frame;
    Point9 here;
    Point9 tool{};
    float feed = 60, feed_key = 0;
    double *feed_length = nullptr;
    bool first_move = true, need_jump = true, left_out = false; // need_jump: a run begins
    int skipped = 0;
    size_t marked = 0, mark_step = 1; // marks so far; every n-th is kept
    int suppress = 0;
    std::vector<Point9> segments;
};

double wall_seconds()
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC_COARSE, &t); // how long a person waits: wall time
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

} // namespace

void read_program(ProgramPath &path, const std::string &file, const ProgramOptions &options,
                  const std::function<bool(int)> &progress)
{
    PathCanon canon(path, options);
    const std::unique_ptr<Interp> made = make_interpreter(options.interpreter, canon, &path.error);
    if (!made) {
        path.result = INTERP_ERROR;
        path.fault.what = path.error;
        return;
    }
    Interp &interp = *made;
    canon.interp = made.get();
    InterpOptions io;
    io.ini_file = options.ini_file;
    int status = interp.init(io);
    if (status <= INTERP_MIN_ERROR) status = interp.open(file.c_str());
    for (size_t i = 0; i < options.init_codes.size() && status <= INTERP_MIN_ERROR; ++i)
        status = interp.execute(options.init_codes[i].c_str());
    if (!options.interpreter.empty() && interp.file_open()) status = INTERP_OK; // as task: they are of another language
    canon.begin_program();
    double asked = wall_seconds();
    int count = 0;
    bool ended = status > INTERP_MIN_ERROR;
    while (!ended) {
        status = interp.read();
        path.last_line = interp.sequence_number();
        if (status == INTERP_OK || status == INTERP_EXECUTE_FINISH) status = interp.execute();
        ended = status != INTERP_OK && status != INTERP_EXECUTE_FINISH;
        if (canon.stop) break;
        if ((++count & 0x3ff) == 0 && progress) {
            const double now = wall_seconds();
            if (now - asked < 0.1) continue;
            asked = now;
            if (progress(path.last_line)) {
                path.aborted = true;
                break;
            }
        }
    }
    path.result = status;
    if (status > INTERP_MIN_ERROR) {
        path.error = interp.error_text(status);
        path.fault = interp.fault();
        if (path.fault.line > 0) path.last_line = path.fault.line;
    }
    path.points.shrink_to_fit();
    path.lines.shrink_to_fit();
    path.kinds.shrink_to_fit();
}
