/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * setup.hh - the state of one interpreter, and the functions of its stages.
 *
 * A line goes: text (source, canonical text) -> words (words.cc, expressions.cc) ->
 * block -> checks (inference.cc, checks.cc) -> effects (execute.cc and one file for
 * each group of codes). Every stage returns INTERP_OK, another result that ends the
 * line, or INTERP_ERROR with the fault filled in.
 *
 * Units:  positions and offsets in program units unless a name says machine
 * Thread: [task]
 */
#ifndef KERF_SETUP_HH
#define KERF_SETUP_HH

#include <array>
#include <bitset>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

#include "codes.hh"
#include "inifile.hh"
#include "interp.hh"
#include "names.hh"
#include "source.hh"

namespace ngc
{

// ---- poses by axis number ------------------------------------------------------
static_assert(sizeof(EmcPose) == AXES * sizeof(double), "a pose is nine doubles");
inline double &axis(EmcPose &p, int i) { return (&p.tran.x)[i]; }
inline double axis(const EmcPose &p, int i) { return (&p.tran.x)[i]; }
enum AxisNumber { AX_X, AX_Y, AX_Z, AX_A, AX_B, AX_C, AX_U, AX_V, AX_W };
constexpr bool is_linear(int i) { return i < 3 || i > 5; }

// ---- limits and tolerances of the language ---------------------------------------
enum {
    MAX_PARAMETER = 5601,
    SUB_ARGUMENTS = 30,
    MAX_CALL_LEVELS = 10, // level 0 is the main program
    MAX_SETTINGS = 64     // parameter settings on a line; 255 characters hold fewer
};
constexpr double TOLERANCE_INT = 0.0001;   // integers
constexpr double TOLERANCE_EQUAL = 1e-6;   // EQ, NE, LE, GE
constexpr double TINY = 1e-7;              // motion that counts for the feed distance
constexpr double MM_PER_INCH = 25.4;

// Numbered parameters with a meaning.
enum {
    P_ABS_POSITION = 5021,
    P_PROBE_X = 5061,
    P_PROBE_TRIPPED = 5070,
    P_TOOL_OFFSET_USED = 5081,
    P_G28 = 5161,
    P_G30 = 5181,
    P_G92_APPLIED = 5210,
    P_G92 = 5211,
    P_COORD_SYSTEM = 5220,
    P_G5X_BASE = 5201, // + 20 * system (1..9): X..W, then R
    P_INPUT = 5399,
    P_TOOL_NUMBER = 5400,
    P_TOOL_OFFSET = 5401,
    P_TOOL_DIAMETER = 5410,
    P_TOOL_FRONT_ANGLE = 5411,
    P_TOOL_BACK_ANGLE = 5412,
    P_TOOL_ORIENTATION = 5413,
    P_POSITION = 5420,
    P_DEBUG = 5599,
    P_TC_FAULT = 5600,
    P_TC_REASON = 5601
};

enum DistanceMode { MODE_ABSOLUTE = 0, MODE_INCREMENTAL = 1 };
enum RetractMode { R_PLANE = 0, OLD_Z = 1 };
enum FeedMode { UNITS_PER_MINUTE = 0, INVERSE_TIME = 1, UNITS_PER_REVOLUTION = 2 };
enum CompSide { COMP_OFF = 0, COMP_RIGHT = 1, COMP_LEFT = 2 };
enum SpindleMode { CONSTANT_RPM = 0, CONSTANT_SURFACE = 1 };

enum OWord : uint8_t {
    O_NONE = 0, O_SUB, O_ENDSUB, O_CALL, O_DO, O_WHILE, O_IF, O_ELSEIF, O_ELSE, O_ENDIF, O_BREAK, O_CONTINUE,
    O_ENDWHILE, O_REPEAT, O_ENDREPEAT, O_RETURN,
    O_PROGRAM, // bare label
    O_M98, O_M99
};

// Bits of [EMC]DEBUG that the interpreter's log answers to.
enum { LOG_LINES = 0x100, LOG_OWORD = 0x2000, LOG_REMAP = 0x4000, LOG_NAMED = 0x10000 };

enum CallType : uint8_t { CALL_NONE = 0, CALL_NGC = 1, CALL_M98 = 2, CALL_PYTHON = 3, CALL_REMAP = 4 };

struct Remap; // remap.hh

/// One line, read and evaluated; nothing of it has had an effect yet.
struct Block {
    uint32_t present = 0; // which words, by word_index()
    double num[WORDS];
    int16_t g_modes[GM_GROUPS]; // -1 none; code * 10
    int16_t m_modes[MM_GROUPS]; // -1 none
    int m_count = 0;
    int user_m = -1;
    int motion = -1; // motion to be made
    bool any_word = false;
    uint32_t phases = 0; // steps that have something to do, by Phase

    const char *comment = nullptr; // inside the line's text; not terminated
    int comment_length = 0;

    int settings = 0;
    struct { int index; double value; } setting[MAX_SETTINGS];
    int named_settings = 0;
    struct { std::string_view name; double value; } named_setting[MAX_SETTINGS];

    OWord o_type = O_NONE;
    std::string o_name;   // label; flow control: "sub#label"
    int params = 0;       // arguments of a call, or 1 value
    double param[SUB_ARGUMENTS];
    bool python_call = false;

    // A block with remapped codes is put aside and taken up again phase by phase.
    const Remap *executing = nullptr;
    int phase = 0;
    bool builtin_used = false;
    int line_number = 0;

    bool has(char c) const { return present & word_bit(c); }
    double operator[](char c) const { return num[word_index(c)]; }
    double value(char c, double dflt) const { return has(c) ? num[word_index(c)] : dflt; }
    bool any_axis() const { return present & AXIS_WORDS; }
    bool has_axis(int i) const { return has(AXIS_LETTERS[i]); }
    double axis_word(int i) const { return num[word_index(AXIS_LETTERS[i])]; }
    void set(char c, double v)
    {
        present |= word_bit(c);
        num[word_index(c)] = v;
    }
    void clear();
};

struct NamedParameter {
    double value = 0;
    double (*computed)(Setup &) = nullptr; // predefined: its value now
    bool read_only = false;
    bool python = false; // value of a namedparams function
};

struct SavedModes {
    bool valid = false, restore_on_return = false;
    int g[ACTIVE_G_CODES];
    int m[ACTIVE_M_CODES];
    double settings[ACTIVE_SETTINGS];
    double tolerance_q = 0;
};

/// One level of calls. Level 0 is the main program or MDI.
struct Frame {
    CallType type = CALL_NONE;
    std::string sub;           // name of the sub that runs here; "" at level 0
    int source = -1;           // where this level continues after a call: index into sources, -1 MDI
    int64_t offset = 0;
    int line = 0;
    double saved_arguments[SUB_ARGUMENTS + 1];
    NameTable<NamedParameter> locals;
    SavedModes modes;
    int m98_repeats = 0;       // calls still to be made by the M98 line that called from here
    int64_t m98_offset = -1;
    int m98_line = 0;
    std::string text;          // the calling line as written
};

struct Label {
    OWord type = O_NONE;
    int source = -1;
    int64_t offset = 0;      // of the line
    int64_t after = 0;       // behind the line
    int line = 0;            // number of the line
    long repeats = 0;        // still to be run, while a repeat is under way
    bool running = false;    // repeat: entered and not ended
    bool taken = false;      // if: a branch has been executed
    bool leaving = false;    // break seen, looking for the end
    bool continuing = false; // continue seen, looking for the end
};

// ---- cutter compensation's held back calls (comp_queue.cc) --------------------------
struct QueuedCall;
struct CompQueue;
struct Nurbs;      // nurbs.cc
struct PythonLink; // python_link.hh
struct RemapTable; // remap.hh
struct RemapFrame;

} // namespace ngc

/// Everything one interpreter knows.
struct Setup {
    explicit Setup(Canon &c);
    ~Setup();

    Canon &canon;
    InterpOptions options;
    linuxcnc::IniFile ini;
    bool have_ini = false;

    // ---- positions, program units ----
    EmcPose current{};  // in the active coordinate system
    EmcPose g92{};      // axis offsets as applied
    EmcPose g5x{};      // origin offset of the active system
    EmcPose tool_offset{};
    double rotation = 0; // degrees
    int origin_index = 1; // 1..9

    // ---- modal state ----
    int motion_mode = ngc::G_80;
    CANON_PLANE plane = CANON_PLANE_XY;
    CANON_UNITS units = CANON_UNITS_MM;
    int distance_mode = ngc::MODE_ABSOLUTE;
    int ijk_distance_mode = ngc::MODE_INCREMENTAL;
    int feed_mode = ngc::UNITS_PER_MINUTE;
    int retract_mode = ngc::R_PLANE;
    bool lathe_diameter = false;
    CANON_MOTION_MODE control_mode = CANON_CONTINUOUS;
    double tolerance = 0, naivecam_tolerance = 0;
    bool stored_leg = false; // G28, G30: on the way to the stored point
    double feed_rate = 0;
    double last_f = 0; // last F word seen (reported after M2 until the synch)
    double traverse_rate = 0;
    int active_spindle = 0;
    int num_spindles = 1;
    double speed[CANON_MAX_SPINDLES] = {};
    CANON_DIRECTION spindle_turning[CANON_MAX_SPINDLES];
    int spindle_mode[CANON_MAX_SPINDLES] = {};
    bool speed_override[CANON_MAX_SPINDLES];
    bool feed_override = true, adaptive_feed = false, feed_hold = true;
    bool flood = false, mist = false;
    bool g43_with_zero_offset = false;

    // ---- tools ----
    std::vector<CANON_TOOL_TABLE> tools; // 1001, copy of the machine's
    int tools_last = 0;
    int current_pocket = 0;   // index of the tool in the spindle
    int selected_pocket = -1; // index of the selected tool
    int selected_tool = 0;
    bool random_toolchanger = false;

    // ---- sticky values of cycles ----
    double cycle_r = 0, cycle_cc = 0, cycle_p = 0, cycle_q = 0, cycle_i = 0, cycle_j = 0, cycle_k = 0;
    int cycle_l = 1;
    double cycle_il = 0;       // initial level
    bool cycle_il_flag = false; // a series is under way

    // ---- cutter compensation ----
    int comp_side = ngc::COMP_OFF;
    double comp_radius = 0;
    int comp_orientation = 0;
    bool comp_first_move = true;
    bool arc_not_allowed = false;
    double program_x = 0, program_y = 0, program_z = 0; // last programmed point
    std::unique_ptr<ngc::CompQueue> queue;
    std::unique_ptr<ngc::Nurbs> nurbs;

    // ---- machine ----
    double machine_length_units = 1; // per mm
    double machine_angle_units = 1;  // per degree
    int axis_mask = 0x3f;
    bool wrapped[3] = {}; // A B C
    int indexer_joint[3] = {-1, -1, -1};

    // ---- settings of the INI ----
    double center_arc_tolerance_inch, center_arc_tolerance_mm;
    double g64_default_tolerance = 0, g64_default_naive = 0;
    double peck_g73 = 0.05, peck_g83 = 0.05;
    double orient_offset = 0;
    bool tool_change_at_g30 = false, tool_change_quill_up = false, tool_change_with_spindle_on = false;
    bool retain_g43 = false, oword_nargs = false, oword_warn_only = false, no_downcase_oword = false;
    bool ini_vars = true, hal_pin_vars = true;
    bool cycles_both_ways = false; // R below the bottom drills upward
    bool disable_fanuc_subs = false, disable_g92_persistence = false, disable_auto_g54 = false;
    std::string on_abort_command;
    std::string program_start_code; // executed before the first line of every program
    std::string program_prefix;
    std::vector<std::string> sub_path;
    std::string wizard_root;
    int metric_machine = -1; // value of #<_metric_machine>
    int log_level = 0;
    int debug_mask = 0;
    std::unique_ptr<FILE, int (*)(FILE *)> log_file{nullptr, fclose}; // [RS274NGC]LOG_FILE; null: stderr

    // ---- parameters ----
    std::vector<double> parameters; // [1..5601]
    std::string parameter_file;
    bool parameter_file_bad = false; // damaged: never overwritten
    std::string parameter_trouble;   // why the last save failed; empty: it did not
    std::string parameter_file_text; // as last written, with the file's time and inode
    struct timespec parameter_file_time = {};
    ino_t parameter_file_inode = 0;
    bool parameters_read_only = false; // nothing is written (checks)
    ngc::NameTable<ngc::NamedParameter> globals;
    double return_value = 0;
    bool value_returned = false;

    float path_fields[GM_FIELD_FLOAT_MAX_FIELDS] = {}; // arc and heading of the move under way

    // ---- text of the line ----
    char raw[256] = "";      // as in the file, without newline
    int raw_length = 0;
    char text[264] = "";     // canonical: lower case, no blanks outside comments
    int pos = 0;             // reading position in text
    int word_start = 0;      // of the word that is read
    int sequence_number = 0;
    ngc::Block block;
    bool percent_flag = false;
    bool loop_on_m99 = false;
    int last_g0 = -1, last_g92 = -1, last_stop = -1, last_toolchange = -1; // codes of the last block

    // ---- flow ----
    std::vector<std::unique_ptr<ngc::LineSource>> sources; // 0: the program
    int source = -1; // being read; -1: MDI only
    std::string main_file;
    bool main_open = false;
    bool at_start = false; // opened, nothing read yet
    int call_level = 0;
    ngc::Frame frames[ngc::MAX_CALL_LEVELS];
    ngc::NameTable<ngc::Label> labels;
    std::string skipping;     // label that ends skipping; empty: not skipping
    int skipping_line = 0;
    bool skipping_to_sub = false; // skipping: looking for the sub (or O program) that was called
    std::string defining;     // sub whose definition is skipped
    bool lazy_closed = false; // the program is closed, its subs are kept
    bool mdi = false;         // an MDI line runs
    int mdi_slice = 0;        // lines that it may run at a time, 0 all
    int mdi_source = -1, mdi_line = 0, mdi_number = 0; // where the program goes on after it
    int64_t mdi_offset = 0;
    int64_t line_offset = 0;  // of the line being read, and behind it
    int64_t after_offset = 0;

    // ---- waiting for the machine ----
    bool probe_flag = false, input_flag = false, toolchange_flag = false;
    int input_index = 0;
    bool input_digital = false;

    // ---- remaps ----
    std::unique_ptr<ngc::RemapTable> remaps;
    std::unique_ptr<ngc::PythonLink> python;
    std::vector<ngc::RemapFrame> remap_frames; // blocks put aside, outermost first
    int remap_level = 0;                       // how many

    bool g7x_reading = false; // inside a contour: A C U W are no axes
    bool g7x_words_allowed(char c) const { return g7x_reading && (c == 'a' || c == 'c' || c == 'u' || c == 'w'); }

    bool syntax_only = false; // nothing has run: names are not defined yet, values mean nothing

    // ---- error ----
    Fault fault;
    std::string error;
    std::array<const char *, 24> stack{};
    int stack_size = 0;

    // ---- helpers ----
    /// Records a fault of the current line and returns INTERP_ERROR.
    int fail(const char *where, const char *format, ...) __attribute__((format(printf, 3, 4)));
    /// Is something to be logged that [RS274NGC]LOG_LEVEL = level, or the bits `topics` of [EMC]DEBUG, ask for?
    bool logs(int level, int topics) const { return __builtin_expect(log_level >= level || (debug_mask & topics), 0); }
    /// One line of the log, with the place in the program in front.
    void log(const char *format, ...) const __attribute__((format(printf, 2, 3)));
    void trace(const char *where)
    {
        if (stack_size < int(stack.size())) stack[size_t(stack_size++)] = where;
    }
    ngc::Frame &frame() { return frames[call_level]; }
    bool comp_on() const { return comp_side != ngc::COMP_OFF; }
    double to_machine_length(double program) const
    {
        return (units == CANON_UNITS_INCHES ? program * ngc::MM_PER_INCH : program) * machine_length_units;
    }
    double from_machine_length(double machine) const
    {
        double mm = machine / machine_length_units;
        return units == CANON_UNITS_INCHES ? mm / ngc::MM_PER_INCH : mm;
    }
    double to_machine(int ax, double program) const
    {
        return ngc::is_linear(ax) ? to_machine_length(program) : program * machine_angle_units;
    }
    double from_machine(int ax, double machine) const
    {
        return ngc::is_linear(ax) ? from_machine_length(machine) : machine / machine_angle_units;
    }
};

// Inside functions that have the state as `s`.
#define FAIL(...) return s.fail(__func__, __VA_ARGS__)
#define CHECK(condition, ...) \
    do { \
        if (__builtin_expect(!!(condition), 0)) return s.fail(__func__, __VA_ARGS__); \
    } while (0)
#define TRY(call) \
    do { \
        int result_ = (call); \
        if (__builtin_expect(result_ != INTERP_OK, 0)) { \
            if (result_ > INTERP_MIN_ERROR) s.trace(__func__); \
            return result_; \
        } \
    } while (0)

#endif
