/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * check_program.cc - see check_program.hh.
 *
 * Method: the program runs on a canon that only remembers where the machine would be;
 *         after an error it goes on with the next line. Lines that were never reached are
 *         then read for their syntax alone.
 */
#include "check_program.hh"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include <unistd.h>

#include "arc.hh"
#include "stages.hh"

using namespace ngc;

namespace
{

class CheckCanon final : public Canon
{
  public:
    EmcPose position{}, tool_offset{}, g5x{}, g92{};
    double rotation = 0;
    CANON_UNITS units = CANON_UNITS_MM;
    CANON_PLANE plane = CANON_PLANE_XY;
    double machine_units = 1; // per mm
    int mask = 0x1ff;
    std::string parameters;
    std::vector<CANON_TOOL_TABLE> tools;
    int selected = 0;
    bool moved = false, chosen_units = false;
    std::function<void()> units_changed; ///< after a move in the other unit
    // Machine limits by axis, machine units.
    double low[AXES], high[AXES];
    int outside[AXES] = {}; // -1 below, 1 above
    bool have_limits = false;
    std::function<void(int axis, double value, bool below)> beyond;

    double GET_EXTERNAL_LENGTH_UNITS() override { return machine_units; }
    CANON_UNITS GET_EXTERNAL_LENGTH_UNIT_TYPE() override { return units; }
    EmcPose GET_EXTERNAL_POSITION() override { return position; }
    EmcPose GET_EXTERNAL_TOOL_LENGTH_OFFSET() override { return tool_offset; }
    int GET_EXTERNAL_AXIS_MASK() override { return mask; }
    std::string GET_EXTERNAL_PARAMETER_FILE_NAME() override { return parameters; }
    CANON_PLANE GET_EXTERNAL_PLANE() override { return plane; }
    double GET_EXTERNAL_FEED_RATE() override { return feed; }
    int GET_EXTERNAL_TOOL_TABLE_LAST() override { return int(tools.size()) - 1; }
    CANON_TOOL_TABLE GET_EXTERNAL_TOOL_TABLE(int idx) override
    {
        return size_t(idx) < tools.size() ? tools[size_t(idx)] : tooldata_entry_init();
    }
    bool USER_DEFINED_FUNCTION_EXISTS(int) override { return true; }
    bool hal_value(const char *, double *value) override // which pins there are, the machine knows when it runs
    {
        *value = 0;
        return true;
    }
    void SET_FEED_RATE(double rate) override { feed = rate; }
    void SET_G5X_OFFSET(int, const EmcPose &o) override { g5x = o; }
    void SET_G92_OFFSET(const EmcPose &o) override { g92 = o; }
    void SET_XY_ROTATION(double r) override { rotation = r; }
    void SELECT_PLANE(CANON_PLANE p) override { plane = p; }
    void USE_TOOL_LENGTH_OFFSET(const EmcPose &o) override { tool_offset = o; }
    void SELECT_TOOL(int toolno) override { selected = toolno; }
    void CHANGE_TOOL() override
    {
        if (tools.empty()) return;
        for (const CANON_TOOL_TABLE &t : tools)
            if (t.toolno == selected) {
                tools[0] = t;
                return;
            }
    }
    void USE_LENGTH_UNITS(CANON_UNITS u) override
    {
        if (running) chosen_units = true;
        if (u == units) return;
        if (running && moved) units_changed();
        const double factor = u == CANON_UNITS_INCHES ? 1 / MM_PER_INCH : MM_PER_INCH;
        for (EmcPose *p : {&position, &g5x, &g92, &tool_offset})
            for (int i = 0; i < AXES; ++i)
                if (is_linear(i)) axis(*p, i) *= factor;
        feed *= factor;
        units = u;
    }
    void STRAIGHT_TRAVERSE(int, const EmcPose &end) override { go(end); }
    void STRAIGHT_FEED(int, const EmcPose &end) override { go(end); }
    void STRAIGHT_PROBE(int, const EmcPose &end, unsigned char) override { go(end); }
    void ARC_FEED(int, double x1, double y1, double cx, double cy, int turn, double, const EmcPose &end) override
    {
        // The four extremes of the circle that the arc passes, then its end.
        const ArcPlane &p = arc_plane(plane);
        const Point2 from = in_plane(position, p), to{x1, y1}, centre{cx, cy};
        const double radius = hypot(from.x - cx, from.y - cy);
        const double start = atan2(from.y - cy, from.x - cx), sweep = arc_sweep(from, to, centre, turn);
        for (int quarter = -8; quarter <= 8; ++quarter) {
            const double angle = quarter * M_PI_2, along = (angle - start) / sweep;
            if (along <= 0 || along >= 1) continue;
            EmcPose extreme = position;
            axis(extreme, p.first) = cx + radius * cos(angle);
            axis(extreme, p.second) = cy + radius * sin(angle);
            check(extreme);
        }
        go(end);
    }
    void print_line(const char *) override {}
    void operator_error(const char *) override {}
    bool running = false;

  private:
    void go(const EmcPose &end)
    {
        moved = true;
        check(end);
        position = end;
    }
    void check(const EmcPose &p)
    {
        if (!have_limits) return;
        EmcPose m = p;
        for (int i = 0; i < AXES; ++i) axis(m, i) += axis(g92, i);
        rotate(&m.tran.x, &m.tran.y, rotation);
        const double scale = (units == CANON_UNITS_INCHES ? MM_PER_INCH : 1) * machine_units;
        for (int i = 0; i < AXES; ++i) {
            if (!(mask & (1 << i))) continue;
            const double v = (axis(m, i) + axis(g5x, i) + axis(tool_offset, i)) * (is_linear(i) ? scale : 1);
            // Said where the limit is passed, not again until the axis is back.
            const int side = v < low[i] - 1e-6 ? -1 : v > high[i] + 1e-6 ? 1 : 0;
            if (side != 0 && side != outside[i]) beyond(i, v, side < 0);
            outside[i] = side;
        }
    }
    double feed = 0;
};

/// One check under way.
struct Checker {
    const std::string &file;
    const CheckOptions &options;
    std::vector<Finding> findings;
    CheckCanon canon;
    Interp interp{canon};
    std::vector<bool> reached; // lines of the program, from 1
    std::set<std::pair<int, std::string>> known; // line and text: said once
    int program_end = 0;       // line of the M2 that was executed last
    bool feed_missing = false, units_mixed = false, has_sub = false, only_subs = true; // so far

    Checker(const std::string &f, const CheckOptions &o) : file(f), options(o) {}

    void add(Finding::Severity severity, const Fault &fault)
    {
        if (int(findings.size()) >= options.max_findings) return;
        if (!known.insert({fault.line, fault.file + fault.what}).second) return;
        findings.push_back({severity, fault});
    }
    void warn(const char *what, const char *fix = "")
    {
        const Setup &s = interp.setup();
        Fault f;
        f.file = interp.file();
        f.line = interp.sequence_number();
        f.text = s.raw;
        f.what = what;
        f.fix = fix;
        const size_t first = f.text.find_first_not_of(" \t");
        f.column = first == f.text.npos ? 0 : int(first) + 1;
        f.length = first == f.text.npos ? 0 : int(f.text.size() - first);
        add(Finding::WARNING, f);
    }

    void read_machine()
    {
        if (options.interp.ini_file.empty()) return;
        linuxcnc::IniFile ini;
        if (!ini.open(options.interp.ini_file)) return;
        const double per_mm = ini.findLinearUnits("LINEAR_UNITS", "TRAJ").value_or(1.0);
        canon.machine_units = per_mm;
        canon.units = per_mm < 0.5 ? CANON_UNITS_INCHES : CANON_UNITS_MM;
        const std::string coordinates = ini.findStringV("COORDINATES", "TRAJ", "XYZ");
        canon.mask = 0;
        for (int i = 0; i < AXES; ++i) {
            const char upper = char(AXIS_LETTERS[i] - 32);
            if (coordinates.find(upper) != coordinates.npos || coordinates.find(AXIS_LETTERS[i]) != coordinates.npos)
                canon.mask |= 1 << i;
            const std::string section = std::string("AXIS_") + upper;
            canon.low[i] = ini.findRealV("MIN_LIMIT", section, -1e99);
            canon.high[i] = ini.findRealV("MAX_LIMIT", section, 1e99);
        }
        canon.have_limits = true;
    }

    void read_tools()
    {
        std::string name = options.tool_file;
        if (name.empty() && !options.interp.ini_file.empty()) {
            linuxcnc::IniFile ini;
            if (ini.open(options.interp.ini_file)) name = ini.findStringV("TOOL_TABLE", "EMCIO", "");
            const size_t slash = options.interp.ini_file.rfind('/');
            if (!name.empty() && name[0] != '/' && slash != std::string::npos)
                name = options.interp.ini_file.substr(0, slash + 1) + name;
        }
        const bool own_store = !tool_mmap_is_attached();
        if (own_store) {
            char path[] = "/tmp/kerf-check.XXXXXX";
            const int fd = mkstemp(path);
            if (fd >= 0) ::close(fd);
            tool_mmap_set_fname(path);
            if (tool_mmap_creator(nullptr, 0) != 0) return;
            unlink(path);
        }
        if (!name.empty() && tooldata_load(name.c_str()) == 0) {
            canon.tools.resize(CANON_POCKETS_MAX, tooldata_entry_init());
            for (int i = 0; i < CANON_POCKETS_MAX; ++i) tooldata_get(&canon.tools[size_t(i)], i);
        } else {
            // Any tool will do: the common numbers exist.
            canon.tools.resize(CANON_POCKETS_MAX, tooldata_entry_init());
            for (int i = 1; i < CANON_POCKETS_MAX; ++i)
                canon.tools[size_t(i)].toolno = canon.tools[size_t(i)].pocketno = i;
        }
        if (own_store) tool_mmap_close();
    }

    void mark_line(int line)
    {
        if (line < 0) return;
        if (size_t(line) >= reached.size()) reached.resize(size_t(line) + 1024);
        reached[size_t(line)] = true;
    }

    // What a block that has been read looks like to an experienced eye.
    void look_at_block()
    {
        Setup &s = interp.setup();
        const Block &b = s.block;
        if (b.o_type != O_NONE || !s.skipping.empty()) return;
        const ArcPlane &p = arc_plane(s.plane);
        if (b.motion == G_0 && s.comp_on() && s.comp_radius > 0 && b.g_modes[GM_COMP] != G_40 &&
            (b.has_axis(p.first) || b.has_axis(p.second)))
            warn("G0 while cutter compensation is on", "the corner is cut at rapid speed; use G1, or G40 first");
        const int g0 = b.g_modes[GM_MODAL_0];
        if ((g0 == G_28_1 || g0 == G_30_1) && b.any_axis())
            warn("axis words on a line that stores a position",
                 "they move the machine; put them on a line of their own");
        if ((b.motion == G_2 || b.motion == G_3) && (b.present & IJK_WORDS) && !b.has('r') && s.plane < CANON_PLANE_UV)
            look_at_arc(s, b);
        if (b.motion >= G_1 && b.motion != G_80 && b.any_axis() && !canon.chosen_units && !canon.moved &&
            b.g_modes[GM_UNITS] == -1)
            warn("a feed move before any G20 or G21",
                 "the units depend on what ran before; begin the program with G20 or G21");
    }

    // No feed rate at all is said once; the check goes on with one, for what follows would fail in its wake.
    void look_at_feed()
    {
        Setup &s = interp.setup();
        const Block &b = s.block;
        const char *what = b.motion == G_1                             ? "Cannot do g1 with zero feed rate"
                           : b.motion == G_2 || b.motion == G_3        ? "Cannot make arc with zero feed rate"
                           : b.motion >= G_38_2 && b.motion <= G_38_5  ? "Cannot probe with zero feed rate"
                           : is_drill_cycle(b.motion)                  ? "Cannot feed with zero feed rate"
                                                                       : nullptr;
        const int g = b.g_modes[GM_FEED];
        const bool per_minute = g >= 0 ? g == G_94 : s.feed_mode == UNITS_PER_MINUTE;
        if (!what || !per_minute || b.o_type != O_NONE || !s.skipping.empty()) return;
        if (b.has('f') ? b['f'] != 0 : s.feed_rate != 0) return;
        if (!feed_missing) {
            warn(what, "set a feed rate with F on this line or before it");
            findings.back().severity = Finding::ERROR;
        }
        feed_missing = true;
        if (b.has('f')) s.block.set('f', 1);
        else s.feed_rate = 1;
    }

    void look_at_arc(Setup &s, const Block &b)
    {
        const ArcPlane &p = arc_plane(s.plane);
        EmcPose end;
        if (find_ends(s, b, &end) != INTERP_OK) return;
        const Point2 from = in_plane(s.current, p), to = in_plane(end, p);
        Point2 centre{b.value(p.first_word, 0), b.value(p.second_word, 0)};
        if (s.ijk_distance_mode == MODE_INCREMENTAL) centre = {from.x + centre.x, from.y + centre.y};
        const double r1 = hypot(from.x - centre.x, from.y - centre.y), r2 = hypot(to.x - centre.x, to.y - centre.y);
        const double mm = fabs(r1 - r2) * (s.units == CANON_UNITS_INCHES ? MM_PER_INCH : 1);
        if (mm <= options.arc_mismatch_mm || fabs(r1 - r2) > arc_tolerance(s)) return;
        char text[120];
        snprintf(text, sizeof text, "arc start and end radius differ by %.4f mm (%.4f and %.4f)", mm, r1, r2);
        warn(text, "within tolerance it becomes a spiral; write more decimals");
    }

    // The program, past its errors.
    void run()
    {
        int status = interp.open(file.c_str());
        if (status != INTERP_OK) {
            Fault f = interp.fault();
            f.file = file;
            f.line = f.column = 0;
            f.text.clear();
            add(Finding::ERROR, f);
            return;
        }
        canon.running = true;
        long executed = 0;
        int errors_at_end = 0;
        for (;;) {
            status = interp.read();
            const Setup &s = interp.setup();
            if (s.source == 0 && (s.skipping.empty() || s.block.o_type != O_NONE || status != INTERP_OK))
                mark_line(interp.sequence_number());
            if (++executed > options.max_lines) {
                warn("the program has not ended after many lines: an endless loop?");
                return;
            }
            if (status == INTERP_ENDFILE) return;
            if (status == INTERP_OK) {
                look_at_block();
                look_at_feed();
                if (s.block.o_type == O_SUB) has_sub = true;
                if (s.block.o_type == O_NONE && s.skipping.empty() && s.block.any_word) only_subs = false;
                status = interp.execute();
                if (status == INTERP_EXIT) {
                    program_end = interp.sequence_number();
                    return;
                }
            }
            if (status > INTERP_MIN_ERROR) {
                Fault f = interp.fault();
                if (f.what.find("File ended with") == 0) {
                    f.column = 0;
                    if (!only_subs || !has_sub) add(Finding::ERROR, f); // a file of subs needs no end
                    return;
                }
                add(Finding::ERROR, f);
                if (f.what.compare(0, 4, "EOF ") == 0 || f.what.compare(0, 13, "Failed to fin") == 0) {
                    if (++errors_at_end > 3) return;
                }
            }
        }
    }

    // Lines that never ran: their words must at least make sense.
    void read_the_rest()
    {
        LineSource source;
        if (!source.open(file)) return;
        Setup &s = interp.setup();
        s.syntax_only = true;
        s.source = -1;
        s.skipping.clear();
        s.defining.clear();
        std::string_view line;
        bool newline, after_end = false, in_sub = false;
        int first_dead = 0;
        std::string dead_text;
        while (source.next(line, newline)) {
            const int number = source.line_number;
            const bool done = size_t(number) < reached.size() && reached[size_t(number)];
            while (!line.empty() && strchr(" \t\r", line.back())) line.remove_suffix(1);
            s.block.phase = 0;
            s.sequence_number = number;
            if (take_line(s, line) != INTERP_OK) {
                report_syntax(number);
                continue;
            }
            if (s.text[0] == 0 || s.text[0] == '%' || s.text[0] == ';' || s.text[0] == '(') continue;
            const bool is_sub = s.text[0] == 'o' && strstr(s.text, "sub") != nullptr;
            const bool is_end = strstr(s.text, "endsub") != nullptr;
            if (is_sub && !is_end) in_sub = true;
            const bool dead = program_end > 0 && number > program_end && !in_sub && !done;
            if (is_end) in_sub = false;
            if (dead && s.text[0] != 'o' && !first_dead) {
                first_dead = number;
                dead_text = s.raw;
                after_end = true;
            }
            if (done) continue;
            s.block.clear();
            if (read_block(s) != INTERP_OK && lexical(s.error)) report_syntax(number);
        }
        if (after_end) {
            Fault f;
            f.file = file;
            f.line = first_dead;
            f.column = 1;
            f.length = int(dead_text.size());
            f.text = dead_text;
            f.what = "never executed: the program ends in line " + std::to_string(program_end);
            add(Finding::WARNING, f);
        }
        s.syntax_only = false;
    }

    // Messages that do not depend on what ran before the line.
    static bool lexical(const std::string &what)
    {
        static const char *const begins[] = {
            "Bad character", "bad number format", "Unknown ", "Unclosed", "Nested comment", "Multiple ", "Negative ",
            "Two g codes", "Two m codes", "Too many", "G-code out of range", "M-code greater", "No characters",
            "Left bracket", "Slash missing", "Expected ", "Equal sign", "Named parameter not", "Command too long",
            "Unexpected character", "Bad format", "Parameter is readonly", "Parameter number"};
        for (const char *b : begins)
            if (what.compare(0, strlen(b), b) == 0) return true;
        return false;
    }

    void report_syntax(int number)
    {
        Fault f = interp.fault();
        f.file = file;
        f.line = number;
        add(Finding::ERROR, f);
    }

    void check()
    {
        read_machine();
        read_tools();
        canon.parameters = options.parameter_file;
        canon.beyond = [this](int ax, double value, bool below) {
            char text[160];
            snprintf(text, sizeof text, "%c moves to %.4f, %s its limit %.4f (machine units)", AXIS_LETTERS[ax] - 32,
                     value, below ? "below" : "above", below ? canon.low[ax] : canon.high[ax]);
            warn(text);
        };
        interp.setup().parameters_read_only = true;
        const int status = interp.init(options.interp);
        if (status != INTERP_OK) {
            Fault f = interp.fault();
            if (f.what.empty()) f.what = "the interpreter cannot start with this INI";
            add(Finding::ERROR, f);
            return;
        }
        canon.units_changed = [this] {
            if (!units_mixed) warn("the program uses both G20 and G21", "sure? A part is usually written in one unit");
            units_mixed = true;
        };
        run();
        read_the_rest();
    }
};

bool is_utf8(const std::string &text)
{
    int more = 0;
    for (unsigned char c : text) {
        if (more > 0) {
            if ((c & 0xc0) != 0x80) return false;
            --more;
        } else if (c >= 0x80) {
            more = c >= 0xc2 && c < 0xe0 ? 1 : c >= 0xe0 && c < 0xf0 ? 2 : c >= 0xf0 && c < 0xf5 ? 3 : -1;
            if (more < 0) return false;
        }
    }
    return more == 0;
}

std::string json_text(const std::string &text)
{
    std::string out = "\"";
    const bool utf8 = is_utf8(text); // else the bytes are taken for Latin-1
    for (unsigned char c : text) {
        if (c == '"' || c == '\\') {
            out += '\\';
            out += char(c);
        } else if (c == '\n') {
            out += "\\n";
        } else if (c < 0x20 || c == 0x7f || (c >= 0x80 && !utf8)) {
            char buf[8];
            snprintf(buf, sizeof buf, "\\u%04x", c);
            out += buf;
        } else {
            out += char(c);
        }
    }
    return out + '"';
}

} // namespace

std::vector<Finding> check_program(const std::string &file, const CheckOptions &options)
{
    auto checker = std::make_unique<Checker>(file, options);
    checker->check();
    std::stable_sort(checker->findings.begin(), checker->findings.end(), [&](const Finding &a, const Finding &b) {
        const bool a_main = a.fault.file == file, b_main = b.fault.file == file;
        if (a_main != b_main) return a_main;
        if (a.fault.file != b.fault.file) return a.fault.file < b.fault.file;
        return a.fault.line < b.fault.line;
    });
    return std::move(checker->findings);
}

std::string findings_as_json(const std::vector<Finding> &findings)
{
    std::string out = "[";
    for (const Finding &f : findings) {
        out += out.size() > 1 ? ",\n " : "";
        out += "{\"severity\": " + json_text(f.severity == Finding::ERROR ? "error" : "warning");
        out += ", \"file\": " + json_text(f.fault.file) + ", \"line\": " + std::to_string(f.fault.line);
        out += ", \"column\": " + std::to_string(f.fault.column) + ", \"length\": " + std::to_string(f.fault.length);
        out += ", \"message\": " + json_text(f.fault.what) + ", \"fix\": " + json_text(f.fault.fix);
        out += ", \"text\": " + json_text(f.fault.text) + "}";
    }
    return out + "]\n";
}
