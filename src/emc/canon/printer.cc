/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * printer.cc - see printer.hh.
 *
 * Method: lines are composed in one buffer without printf for the frequent ones;
 *         %.4f is done in integers with the rounding of printf.
 * Thread: [task]
 */
#include "printer.hh"

#include <cmath>
#include <cstdarg>
#include <cstring>

namespace
{

enum { BUFFER = 1 << 16, LINE_ROOM = 512 };

// The decimal digits of n; returns behind them.
char *put_integer(char *p, uint64_t n)
{
    char digits[20];
    int count = 0;
    do {
        digits[count++] = char('0' + n % 10);
        n /= 10;
    } while (n);
    while (count) *p++ = digits[--count];
    return p;
}

// As printf("%.4f"): rounds the exact value, ties to even. The product's rounding
// error is found with fma, so a near tie is decided on the true value.
char *put_fixed4(char *p, double v)
{
    const double a = fabs(v);
    if (!(a < 1e11)) return p + snprintf(p, LINE_ROOM - 64, "%.4f", v);
    const double scaled = a * 10000.0;
    const double error = fma(a, 10000.0, -scaled);
    const double whole = floor(scaled);
    const double rest = scaled - whole;
    uint64_t n = uint64_t(whole);
    if (rest > 0.5 || (rest == 0.5 && (error > 0 || (error == 0 && (n & 1))))) ++n;
    if (std::signbit(v)) *p++ = '-';
    p = put_integer(p, n / 10000);
    const unsigned fraction = unsigned(n % 10000);
    *p++ = '.';
    *p++ = char('0' + fraction / 1000);
    *p++ = char('0' + fraction / 100 % 10);
    *p++ = char('0' + fraction / 10 % 10);
    *p++ = char('0' + fraction % 10);
    return p;
}

char *put_text(char *p, const char *text)
{
    const size_t n = strlen(text);
    memcpy(p, text, n);
    return p + n;
}

char *put_list(char *p, const double *values, int count)
{
    for (int i = 0; i < count; ++i) {
        if (i) *p++ = ',', *p++ = ' ';
        p = put_fixed4(p, values[i]);
    }
    return p;
}

double *axes(EmcPose &p) { return &p.tran.x; }
const double *axes(const EmcPose &p) { return &p.tran.x; }

} // namespace

CanonPrinter::CanonPrinter() : buffer(BUFFER)
{
    for (auto &t : turning) t = CANON_STOPPED;
    for (auto &o : speed_override) o = true;
}

CanonPrinter::~CanonPrinter() { flush(); }

void CanonPrinter::set_output(FILE *f)
{
    flush();
    out = f;
}

void CanonPrinter::flush()
{
    if (used) fwrite(buffer.data(), 1, used, out);
    used = 0;
    fflush(out);
}

char *CanonPrinter::reserve(size_t size)
{
    if (used + size > buffer.size()) {
        fwrite(buffer.data(), 1, used, out);
        used = 0;
        if (size > buffer.size()) buffer.resize(size);
    }
    return buffer.data() + used;
}

/// A line under way: number and N field are written by begin().
struct CanonPrinter::Line {
    CanonPrinter &printer;
    char *p;
    Line(CanonPrinter &c, size_t room = LINE_ROOM) : printer(c), p(c.reserve(room)) { c.begin(*this); }
    ~Line()
    {
        *p++ = '\n';
        printer.used = size_t(p - printer.buffer.data());
        if (printer.direct) printer.flush();
    }
};

namespace
{

// "N" and the digits of the source line's number, or "N.....": seven characters at least.
char *put_n_field(char *p, const char *line)
{
    if (line) {
        while (*line == '\t' || *line == ' ' || *line == '/') ++line;
        if (*line == 'n' || *line == 'N') {
            *p++ = 'N';
            int digits = 0;
            for (++line; *line >= '0' && *line <= '9'; ++line, ++digits) *p++ = *line;
            for (; digits < 6; ++digits) *p++ = ' ';
            return p;
        }
    }
    memcpy(p, "N..... ", 7);
    return p + 7;
}

} // namespace

void CanonPrinter::begin(Line &l)
{
    const long n = ++number;
    for (long limit = 10000; limit > n && limit > 1; limit /= 10) *l.p++ = ' ';
    l.p = put_integer(l.p, uint64_t(n));
    *l.p++ = ' ';
    l.p = put_n_field(l.p, line_text);
}

void CanonPrinter::call(const char *text)
{
    Line l(*this);
    l.p = put_text(l.p, text);
}

void CanonPrinter::quoted(const char *name, const char *text)
{
    Line l(*this, LINE_ROOM + strlen(text));
    l.p = put_text(l.p, name);
    *l.p++ = '(', *l.p++ = '"';
    l.p = put_text(l.p, text);
    *l.p++ = '"', *l.p++ = ')';
}

void CanonPrinter::indexed(const char *name, int index) { formatted("%s(%d)", name, index); }

void CanonPrinter::formatted(const char *format, ...)
{
    char text[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    Line l(*this, sizeof text + LINE_ROOM);
    l.p = put_text(l.p, text);
}

void CanonPrinter::motion(const char *name, size_t length, const EmcPose &end)
{
    Line l(*this, 2048);
    memcpy(l.p, name, length);
    l.p = put_list(l.p + length, axes(end), 6);
    *l.p++ = ')';
}

void CanonPrinter::print_line(const char *text)
{
    const size_t n = strlen(text);
    char *p = reserve(n + 1);
    memcpy(p, text, n);
    p[n] = '\n';
    used += n + 1;
    if (direct) flush();
}

// ---- state ------------------------------------------------------------------------

void CanonPrinter::SET_XY_ROTATION(double degrees) { formatted("SET_XY_ROTATION(%.4f)", degrees); }

void CanonPrinter::SET_G5X_OFFSET(int index, const EmcPose &offset)
{
    const double *o = axes(offset);
    formatted("SET_G5X_OFFSET(%d, %.4f, %.4f, %.4f, %.4f, %.4f, %.4f)", index, o[0], o[1], o[2], o[3], o[4], o[5]);
    for (int i = 0; i < 6; ++i) axes(position)[i] += axes(g5x)[i] - o[i];
    g5x = offset;
}

void CanonPrinter::SET_G92_OFFSET(const EmcPose &offset)
{
    const double *o = axes(offset);
    formatted("SET_G92_OFFSET(%.4f, %.4f, %.4f, %.4f, %.4f, %.4f)", o[0], o[1], o[2], o[3], o[4], o[5]);
    for (int i = 0; i < 6; ++i) axes(position)[i] += axes(g92)[i] - o[i];
    g92 = offset;
}

void CanonPrinter::USE_LENGTH_UNITS(CANON_UNITS fresh)
{
    formatted("USE_LENGTH_UNITS(%s)", fresh == CANON_UNITS_INCHES ? "CANON_UNITS_INCHES"
                                      : fresh == CANON_UNITS_MM   ? "CANON_UNITS_MM"
                                                                  : "UNKNOWN");
    if (fresh == units || fresh == CANON_UNITS_CM) return;
    const double factor = fresh == CANON_UNITS_INCHES ? 1 / 25.4 : 25.4;
    for (int i = 0; i < 3; ++i) {
        axes(position)[i] *= factor;
        axes(g5x)[i] *= factor;
        axes(g92)[i] *= factor;
    }
    // The tool offset it remembers stays a bare number, as recorded of this model: a switch
    // of units with an offset in force changes its length here (never on a machine).
    units = fresh;
}

void CanonPrinter::SELECT_PLANE(CANON_PLANE fresh)
{
    formatted("SELECT_PLANE(CANON_PLANE_%s)", fresh == CANON_PLANE_XY   ? "XY"
                                              : fresh == CANON_PLANE_YZ ? "YZ"
                                              : fresh == CANON_PLANE_XZ ? "XZ"
                                                                        : "UNKNOWN");
    plane = fresh;
}

void CanonPrinter::SET_FEED_REFERENCE(CANON_FEED_REFERENCE reference)
{
    formatted("SET_FEED_REFERENCE(%s)", reference == CANON_WORKPIECE ? "CANON_WORKPIECE" : "CANON_XYZ");
}

void CanonPrinter::SET_FEED_MODE(int spindle, int mode) { formatted("SET_FEED_MODE(%d, %d)", spindle, mode); }

void CanonPrinter::SET_FEED_RATE(double rate)
{
    Line l(*this);
    l.p = put_text(l.p, "SET_FEED_RATE(");
    l.p = put_fixed4(l.p, rate);
    *l.p++ = ')';
    feed_rate = rate;
}

void CanonPrinter::SET_TRAVERSE_RATE(double rate) { formatted("SET_TRAVERSE_RATE(%.4f)", rate); }

void CanonPrinter::SET_MOTION_CONTROL_MODE(CANON_MOTION_MODE mode, double new_tolerance, int planner_type,
                                           double scurve_peak_scale)
{
    if (planner_type >= 0 || scurve_peak_scale >= 0)
        formatted("SET_PLANNER_MODE(type=%d, peak_scale=%f)", planner_type, scurve_peak_scale);
    if (mode == CANON_CONTINUOUS)
        formatted("SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, %f)", new_tolerance);
    else
        formatted("SET_MOTION_CONTROL_MODE(%s)", mode == CANON_EXACT_STOP   ? "CANON_EXACT_STOP"
                                                 : mode == CANON_EXACT_PATH ? "CANON_EXACT_PATH"
                                                                            : "UNKNOWN");
    control_mode = mode;
    tolerance = new_tolerance;
}

void CanonPrinter::SET_NAIVECAM_TOLERANCE(double fresh)
{
    formatted("SET_NAIVECAM_TOLERANCE(%.4f)", fresh);
    naive_tolerance = fresh;
}

void CanonPrinter::USE_TOOL_LENGTH_OFFSET(const EmcPose &offset)
{
    const double *o = axes(offset);
    formatted("USE_TOOL_LENGTH_OFFSET(%.4f %.4f %.4f, %.4f %.4f %.4f, %.4f %.4f %.4f)", o[0], o[1], o[2], o[3], o[4],
              o[5], o[6], o[7], o[8]);
    tool_offset = offset;
}

// ---- motion -----------------------------------------------------------------------

void CanonPrinter::STRAIGHT_TRAVERSE(int, const EmcPose &end)
{
    motion("STRAIGHT_TRAVERSE(", 18, end);
    memcpy(axes(position), axes(end), 6 * sizeof(double));
}

void CanonPrinter::STRAIGHT_FEED(int, const EmcPose &end)
{
    motion("STRAIGHT_FEED(", 14, end);
    memcpy(axes(position), axes(end), 6 * sizeof(double));
}

void CanonPrinter::ARC_FEED(int, double first_end, double second_end, double first_axis, double second_axis,
                            int rotation, double axis_end_point, const EmcPose &end)
{
    {
        Line l(*this, 4096);
        const double head[] = {first_end, second_end, first_axis, second_axis};
        const double tail[] = {axis_end_point, end.a, end.b, end.c};
        l.p = put_text(l.p, "ARC_FEED(");
        l.p = put_list(l.p, head, 4);
        *l.p++ = ',', *l.p++ = ' ';
        if (rotation < 0) *l.p++ = '-';
        l.p = put_integer(l.p, uint64_t(rotation < 0 ? -int64_t(rotation) : rotation));
        *l.p++ = ',', *l.p++ = ' ';
        l.p = put_list(l.p, tail, 4);
        *l.p++ = ')';
    }
    const int first = plane == CANON_PLANE_XZ ? 2 : plane == CANON_PLANE_YZ ? 1 : 0;
    axes(position)[first] = first_end;
    axes(position)[(first + 1) % 3] = second_end;
    axes(position)[(first + 2) % 3] = axis_end_point;
    position.a = end.a;
    position.b = end.b;
    position.c = end.c;
}

void CanonPrinter::NURBS_G5_FEED(int, const std::vector<NURBS_CONTROL_POINT> &points, unsigned, CANON_PLANE)
{
    formatted("NURBS_G5_FEED(%lu, ...)", static_cast<unsigned long>(points.size()));
    if (points.empty()) return;
    position.tran.x = points.back().x;
    position.tran.y = points.back().y;
}

void CanonPrinter::NURBS_G6_FEED(int, const std::vector<NURBS_G6_CONTROL_POINT> &points, unsigned, double, int,
                                 CANON_PLANE)
{
    // This line has no number, and does not count.
    char *p = reserve(LINE_ROOM), *start = p;
    p = put_n_field(p, line_text);
    p = put_text(p, "saicanon NURBS_G6_FEED_(");
    p = put_integer(p, points.size());
    p = put_text(p, ", ...)\n");
    used += size_t(p - start);
    if (direct) flush();
    if (points.empty()) return;
    position.tran.x = points.back().x;
    position.tran.y = points.back().y;
}

void CanonPrinter::RIGID_TAP(int, double x, double y, double z, double)
{
    formatted("RIGID_TAP(%.4f, %.4f, %.4f)", x, y, z);
}

void CanonPrinter::STRAIGHT_PROBE(int, const EmcPose &end, unsigned char)
{
    motion("STRAIGHT_PROBE(", 15, end);
    probe = end;
    double d[3], length = 0;
    for (int i = 0; i < 3; ++i) {
        d[i] = axes(position)[i] - axes(end)[i];
        length += d[i] * d[i];
    }
    length = sqrt(length);
    if (length == 0) return;
    const double back = units == CANON_UNITS_MM ? 0.254 : 0.01;
    for (int i = 0; i < 3; ++i) axes(position)[i] = axes(end)[i] + d[i] * back / length;
    position.a = end.a;
    position.b = end.b;
    position.c = end.c;
}

void CanonPrinter::DWELL(double seconds) { formatted("DWELL(%.4f)", seconds); }

void CanonPrinter::START_SPEED_FEED_SYNCH(int, double feed_per_revolution, bool velocity_mode)
{
    formatted("START_SPEED_FEED_SYNC(%f,%d)", feed_per_revolution, int(velocity_mode));
}

// ---- spindle ---------------------------------------------------------------------

void CanonPrinter::SET_SPINDLE_MODE(int spindle, double css_max)
{
    formatted("SET_SPINDLE_MODE(%d %.4f)", spindle, css_max);
}

void CanonPrinter::SET_SPINDLE_SPEED(int spindle, double fresh)
{
    formatted("SET_SPINDLE_SPEED(%i, %.4f)", spindle, fresh);
    speed[spindle] = fresh;
}

void CanonPrinter::START_SPINDLE_CLOCKWISE(int spindle, int)
{
    formatted("START_SPINDLE_CLOCKWISE(%i)", spindle);
    turning[spindle] = speed[spindle] == 0 ? CANON_STOPPED : CANON_CLOCKWISE;
}

void CanonPrinter::START_SPINDLE_COUNTERCLOCKWISE(int spindle, int)
{
    formatted("START_SPINDLE_COUNTERCLOCKWISE(%i)", spindle);
    turning[spindle] = speed[spindle] == 0 ? CANON_STOPPED : CANON_COUNTERCLOCKWISE;
}

void CanonPrinter::STOP_SPINDLE_TURNING(int spindle, int)
{
    formatted("STOP_SPINDLE_TURNING(%i)", spindle);
    turning[spindle] = CANON_STOPPED;
}

void CanonPrinter::ORIENT_SPINDLE(int spindle, double degrees, int direction)
{
    formatted("ORIENT_SPINDLE(%d, %.4f, %d)", spindle, degrees, direction);
}

void CanonPrinter::WAIT_SPINDLE_ORIENT_COMPLETE(int spindle, double timeout_s)
{
    formatted("SPINDLE.%i.WAIT_ORIENT_COMPLETE(%.4f)", spindle, timeout_s);
}

// ---- tools -----------------------------------------------------------------------

void CanonPrinter::SET_TOOL_TABLE_ENTRY(int idx, int toolno, const EmcPose &offset, double diameter,
                                        double frontangle, double backangle, int orientation)
{
    const double *o = axes(offset);
    formatted("SET_TOOL_TABLE_ENTRY(%d, %d, %.4f %.4f %.4f %.4f %.4f %.4f %.4f %.4f %.4f, %.4f, %.4f, %d)", idx,
              toolno, o[0], o[1], o[2], o[3], o[4], o[5], o[6], o[7], o[8], frontangle, backangle, orientation);
    CANON_TOOL_TABLE t;
    if (tooldata_get(&t, idx) != IDX_OK) return;
    t.toolno = toolno;
    t.offset = offset;
    t.diameter = diameter;
    t.frontangle = frontangle;
    t.backangle = backangle;
    t.orientation = orientation;
    tooldata_put(t, idx);
}

void CanonPrinter::SELECT_TOOL(int toolno)
{
    formatted("SELECT_TOOL(%d)", toolno);
    selected_tool = toolno;
}

void CanonPrinter::CHANGE_TOOL()
{
    call("CHANGE_TOOL()");
    active_slot = selected_tool;
    CANON_TOOL_TABLE t;
    if (tooldata_get(&t, selected_tool) == IDX_OK) tooldata_put(t, 0);
}

void CanonPrinter::CHANGE_TOOL_NUMBER(int idx)
{
    formatted("CHANGE_TOOL_NUMBER(%d)", idx);
    active_slot = idx;
}

CANON_TOOL_TABLE CanonPrinter::GET_EXTERNAL_TOOL_TABLE(int idx)
{
    CANON_TOOL_TABLE t;
    return tooldata_get(&t, idx) == IDX_OK ? t : tooldata_entry_init();
}

// ---- the rest ----------------------------------------------------------------------

namespace
{

const char *axis_name(CANON_AXIS axis)
{
    static const char *const names[] = {"CANON_AXIS_X", "CANON_AXIS_Y", "CANON_AXIS_Z",
                                        "CANON_AXIS_A", "CANON_AXIS_B", "CANON_AXIS_C"};
    return axis >= CANON_AXIS_X && axis <= CANON_AXIS_C ? names[axis - 1] : "UNKNOWN";
}

} // namespace

void CanonPrinter::CLAMP_AXIS(CANON_AXIS axis) { formatted("CLAMP_AXIS(%s)", axis_name(axis)); }
void CanonPrinter::UNCLAMP_AXIS(CANON_AXIS axis) { formatted("UNCLAMP_AXIS(%s)", axis_name(axis)); }
void CanonPrinter::CANON_ERROR(const char *text) { formatted("CANON_ERROR(%s)", text); }

void CanonPrinter::DISABLE_FEED_OVERRIDE()
{
    call("DISABLE_FEED_OVERRIDE()");
    feed_override = false;
}

void CanonPrinter::ENABLE_FEED_OVERRIDE()
{
    call("ENABLE_FEED_OVERRIDE()");
    feed_override = true;
}

void CanonPrinter::DISABLE_SPEED_OVERRIDE(int spindle)
{
    formatted("DISABLE_SPEED_OVERRIDE(%i)", spindle);
    speed_override[spindle] = false;
}

void CanonPrinter::ENABLE_SPEED_OVERRIDE(int spindle)
{
    formatted("ENABLE_SPEED_OVERRIDE(%i)", spindle);
    speed_override[spindle] = true;
}

void CanonPrinter::SET_MOTION_OUTPUT_VALUE(int index, double value)
{
    formatted("SET_MOTION_OUTPUT_VALUE(%d,%f)", index, value);
}

void CanonPrinter::SET_AUX_OUTPUT_VALUE(int index, double value)
{
    formatted("SET_AUX_OUTPUT_VALUE(%d,%f)", index, value);
}
