/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * interp.cc - the interpreter as an object: life, reading, executing, asking.
 *
 * Thread: [task]
 * Source: G-code sheet, sections 1, 2 and 10
 */
#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstdlib>

#include "comp_queue.hh"
#include "nurbs.hh"
#include "python_link.hh"
#include "remap.hh"
#include "stages.hh"

using namespace ngc;

Setup::Setup(Canon &c)
    : canon(c), tools(CANON_POCKETS_MAX, tooldata_entry_init()), queue(std::make_unique<CompQueue>()),
      nurbs(std::make_unique<Nurbs>()), parameters(MAX_PARAMETER + 1, 0.0)
{
    for (auto &t : spindle_turning) t = CANON_STOPPED;
    for (auto &o : speed_override) o = true;
    block.clear();
}

Setup::~Setup() = default;

int Setup::fail(const char *where, const char *format, ...)
{
    char text[256];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    text[254] = 0;
    error = text;
    fault.fix.clear();
    stack_size = 0;
    trace(where);
    fault.what = text;
    fill_fault_place(*this);
    return INTERP_ERROR;
}

void Setup::log(const char *format, ...) const
{
    FILE *out = log_file ? log_file.get() : stderr;
    fprintf(out, "%s:%d: ", source >= 0 ? sources[size_t(source)]->path().c_str() : "MDI", sequence_number);
    va_list args;
    va_start(args, format);
    vfprintf(out, format, args);
    va_end(args);
    fputc('\n', out);
    fflush(out);
}

Interp::Interp(Canon &canon) : s(std::make_unique<Setup>(canon)) {}
Interp::~Interp() = default;

InterpOptions InterpOptions::from_environment()
{
    InterpOptions o;
    if (const char *ini = getenv("INI_FILE_NAME")) o.ini_file = ini;
    return o;
}

// ---- life ------------------------------------------------------------------------

namespace
{

double arc_tolerance_setting(const linuxcnc::IniFile &ini, const char *key, double low, double dflt)
{
    auto value = ini.findReal(key, "RS274NGC");
    if (!value) return dflt;
    if (*value < low || *value > dflt) {
        fprintf(stderr, "invalid [RS274NGC]%s in INI file\n", key);
        return dflt;
    }
    return *value;
}

std::vector<std::string> path_list(const std::string &text)
{
    std::vector<std::string> dirs;
    for (const std::string &part : linuxcnc::IniFile::split(":", text)) {
        const std::string dir = expand_path(linuxcnc::IniFile::trim(part));
        if (!dir.empty() && dirs.size() < 10) dirs.push_back(dir);
    }
    return dirs;
}

int read_ini(Setup &s)
{
    const bool inch = s.canon.GET_EXTERNAL_LENGTH_UNIT_TYPE() == CANON_UNITS_INCHES;
    s.peck_g73 = s.peck_g83 = inch ? 0.05 : 1.0;
    s.center_arc_tolerance_inch = 2 * 0.001 * M_SQRT2;
    s.center_arc_tolerance_mm = 2 * 0.01 * M_SQRT2;
    s.have_ini = false;
    s.ini_vars = s.hal_pin_vars = false;
    s.metric_machine = -1;
    if (s.options.ini_file.empty()) return INTERP_OK;
    CHECK(!s.ini.open(s.options.ini_file), "Unable to open inifile:%s:", s.options.ini_file.c_str());
    s.have_ini = true;
    const linuxcnc::IniFile &ini = s.ini;
    const char *const R = "RS274NGC";
    s.tool_change_at_g30 = ini.findBoolV("TOOL_CHANGE_AT_G30", "EMCIO", false);
    s.tool_change_quill_up = ini.findBoolV("TOOL_CHANGE_QUILL_UP", "EMCIO", false);
    s.tool_change_with_spindle_on = ini.findBoolV("TOOL_CHANGE_WITH_SPINDLE_ON", "EMCIO", false);
    s.random_toolchanger = ini.findBoolV("RANDOM_TOOLCHANGER", "EMCIO", false);
    s.ini_vars = ini.findBoolV("INI_VARS", R, true);
    s.hal_pin_vars = ini.findBoolV("HAL_PIN_VARS", R, true);
    s.retain_g43 = ini.findBoolV("RETAIN_G43", R, false);
    s.oword_nargs = ini.findBoolV("OWORD_NARGS", R, false);
    s.no_downcase_oword = ini.findBoolV("NO_DOWNCASE_OWORD", R, false);
    s.oword_warn_only = ini.findBoolV("OWORD_WARNONLY", R, false);
    s.disable_g92_persistence = ini.findBoolV("DISABLE_G92_PERSISTENCE", R, false);
    s.disable_auto_g54 = ini.findBoolV("DISABLE_AUTO_G54", R, false);
    s.cycles_both_ways = ini.findBoolV("CYCLES_BOTH_WAYS", R, false);
    s.disable_fanuc_subs = ini.findBoolV("DISABLE_FANUC_STYLE_SUB", R, false);
    s.g64_default_tolerance = ini.findRealV("G64_DEFAULT_TOLERANCE", R, 0);
    s.g64_default_naive = ini.findRealV("G64_DEFAULT_NAIVETOLERANCE", R, 0);
    const auto units = ini.findString("LINEAR_UNITS", "TRAJ");
    s.metric_machine = !units ? -1 : *units == "inch" ? 0 : 1;
    if (units) s.peck_g73 = s.peck_g83 = s.metric_machine ? 1.0 : 0.05; // a preview begins in inches on every machine
    s.peck_g73 = ini.findRealV("G73_PECK_CLEARANCE", R, s.peck_g73);
    s.peck_g83 = ini.findRealV("G83_PECK_CLEARANCE", R, s.peck_g83);
    s.orient_offset = ini.findRealV("ORIENT_OFFSET", R, 0);
    s.center_arc_tolerance_inch =
        arc_tolerance_setting(ini, "CENTER_ARC_RADIUS_TOLERANCE_INCH", 0.00004, s.center_arc_tolerance_inch);
    s.center_arc_tolerance_mm =
        arc_tolerance_setting(ini, "CENTER_ARC_RADIUS_TOLERANCE_MM", 0.001, s.center_arc_tolerance_mm);
    s.on_abort_command = ini.findStringV("ON_ABORT_COMMAND", R, "");
    s.program_start_code = ini.findStringV("PROGRAM_START_CODE", R, "");
    s.program_prefix = expand_path(ini.findStringV("PROGRAM_PREFIX", "DISPLAY", ""));
    s.sub_path = path_list(ini.findStringV("SUBROUTINE_PATH", R, ""));
    if (s.options.copies)
        s.options.copies->keep_called = strcasecmp(ini.findStringV("CALLED_FILES", R, "KEEP").c_str(), "FRESH") != 0;
    s.wizard_root = expand_path(ini.findStringV("WIZARD_ROOT", "WIZARD", ""));
    s.num_spindles = ini.findIntV("SPINDLES", "TRAJ", 1, 1, CANON_MAX_SPINDLES);
    s.log_level = ini.findIntV("LOG_LEVEL", R, 0);
    s.debug_mask = int(ini.findSIntV("DEBUG", "EMC", 0));
    s.log_file.reset();
    if (auto name = ini.findString("LOG_FILE", R); name && !name->empty()) {
        const std::string path = expand_path(*name);
        s.log_file.reset(fopen(path.c_str(), "ae"));
        if (!s.log_file) fprintf(stderr, "[RS274NGC]LOG_FILE: can't write '%s': %s\n", path.c_str(), strerror(errno));
    }
    for (int n = 0; n < 3; ++n) {
        const std::string section = std::string("AXIS_") + char('A' + n);
        s.wrapped[n] = ini.findBoolV("WRAPPED_ROTARY", section, false);
        s.indexer_joint[n] = ini.findIntV("LOCKING_INDEXER_JOINT", section, -1);
    }
    return INTERP_OK;
}

EmcPose pose_at(const Setup &s, int first)
{
    EmcPose p{};
    for (int i = 0; i < AXES; ++i) axis(p, i) = s.from_machine(i, s.parameters[size_t(first + i)]);
    return p;
}

void init_offsets(Setup &s)
{
    double index = s.parameters[P_COORD_SYSTEM];
    s.origin_index = index > 0.5 && index < 9.5 ? int(index + 0.5) : 1;
    s.parameters[P_COORD_SYSTEM] = s.origin_index;
    if (s.disable_g92_persistence)
        for (int i = P_G92_APPLIED; i < P_G92 + AXES; ++i) s.parameters[size_t(i)] = 0;
    s.g5x = pose_at(s, P_G5X_BASE + 20 * s.origin_index);
    s.rotation = s.parameters[size_t(P_G5X_BASE + 20 * s.origin_index + AXES)];
    s.g92 = s.parameters[P_G92_APPLIED] != 0 ? pose_at(s, P_G92) : EmcPose{};
    s.canon.SET_G5X_OFFSET(s.origin_index, s.g5x);
    s.canon.SET_G92_OFFSET(s.g92);
    s.canon.SET_XY_ROTATION(s.rotation);
}

// Re-reads what the machine knows.
void take_machine_state(Setup &s)
{
    Canon &c = s.canon;
    s.control_mode = c.GET_EXTERNAL_MOTION_CONTROL_MODE();
    s.tolerance = c.GET_EXTERNAL_MOTION_CONTROL_TOLERANCE();
    s.naivecam_tolerance = c.GET_EXTERNAL_MOTION_CONTROL_NAIVECAM_TOLERANCE();
    s.current_pocket = c.GET_EXTERNAL_TOOL_SLOT();
    s.selected_pocket = c.GET_EXTERNAL_SELECTED_TOOL_SLOT();
    s.feed_rate = c.GET_EXTERNAL_FEED_RATE();
    s.flood = c.GET_EXTERNAL_FLOOD();
    s.mist = c.GET_EXTERNAL_MIST();
    s.units = c.GET_EXTERNAL_LENGTH_UNIT_TYPE();
    s.plane = c.GET_EXTERNAL_PLANE();
    s.traverse_rate = c.GET_EXTERNAL_TRAVERSE_RATE();
    s.feed_override = c.GET_EXTERNAL_FEED_OVERRIDE_ENABLE();
    s.adaptive_feed = c.GET_EXTERNAL_ADAPTIVE_FEED_ENABLE();
    s.feed_hold = c.GET_EXTERNAL_FEED_HOLD_ENABLE();
    for (int i = 0; i < s.num_spindles; ++i) {
        s.speed[i] = c.GET_EXTERNAL_SPEED(i);
        s.spindle_turning[i] = c.GET_EXTERNAL_SPINDLE(i);
        s.speed_override[i] = c.GET_EXTERNAL_SPINDLE_OVERRIDE_ENABLE(i);
        s.spindle_mode[i] = CONSTANT_RPM;
    }
    s.current = c.GET_EXTERNAL_POSITION();
    load_tool_table(s);
}

} // namespace

void ngc::init_modes(Setup &s)
{
    s.motion_mode = G_80;
    s.distance_mode = MODE_ABSOLUTE;
    s.ijk_distance_mode = MODE_INCREMENTAL;
    s.feed_mode = UNITS_PER_MINUTE;
    s.lathe_diameter = false;
    s.active_spindle = 0;
    s.comp_side = COMP_OFF;
    s.comp_first_move = true;
    s.arc_not_allowed = false;
    s.cycle_il_flag = false;
    s.tool_offset = EmcPose{};
    s.g43_with_zero_offset = false;
    s.selected_tool = 0;
    s.probe_flag = s.input_flag = s.toolchange_flag = false;
    s.last_g0 = s.last_g92 = s.last_stop = s.last_toolchange = -1;
    s.sequence_number = 0;
    s.percent_flag = false;
    s.g7x_reading = false;
    s.block.clear();
    drop_comp(s);
    nurbs_forget(s);
}

int Interp::init(const InterpOptions &options)
{
    Setup &s = *this->s;
    s.options = options;
    s.raw[0] = s.text[0] = 0;
    s.raw_length = 0;
    unwind(s);
    clear_labels(s);
    s.canon.INIT_CANON();
    s.machine_length_units = s.canon.GET_EXTERNAL_LENGTH_UNITS();
    s.machine_angle_units = s.canon.GET_EXTERNAL_ANGLE_UNITS();
    s.axis_mask = s.canon.GET_EXTERNAL_AXIS_MASK();
    TRY(read_ini(s));
    s.parameter_file = s.canon.GET_EXTERNAL_PARAMETER_FILE_NAME();
    s.units = s.canon.GET_EXTERNAL_LENGTH_UNIT_TYPE();
    s.canon.USE_LENGTH_UNITS(s.units);
    TRY(load_parameters(s));
    s.parameters[P_DEBUG] = 1.0;
    if (s.globals.size() == 0) define_predefined(s);
    init_modes(s);
    init_offsets(s);
    s.canon.SET_FEED_REFERENCE(CANON_XYZ);
    TRY(load_python(s, this));
    TRY(load_remaps(s));
    TRY(synch());
    if (s.python) TRY(s.python->first_init(s));
    return INTERP_OK;
}

int ngc::run_inner(Setup &s, const char *text)
{
    // What is being executed now stays as it is; the line may call subs, which run to their end.
    const Block outer = s.block;
    char raw[sizeof s.raw], canonical[sizeof s.text];
    memcpy(raw, s.raw, sizeof raw);
    memcpy(canonical, s.text, sizeof canonical);
    const int raw_length = s.raw_length, number = s.sequence_number, level = s.call_level;
    const int pos = s.pos, word_start = s.word_start;
    const int64_t line_offset = s.line_offset, after_offset = s.after_offset;
    std::string skipping;
    std::swap(skipping, s.skipping);
    int status = take_line(s, text);
    if (status == INTERP_OK) status = read_block(s);
    if (status == INTERP_OK) status = execute_block(s);
    while (status == INTERP_OK && (s.call_level > level || !s.skipping.empty()) && s.source >= 0) {
        status = read_next_block(s);
        if (status == INTERP_OK) status = execute_block(s);
    }
    if (status > INTERP_MIN_ERROR)
        while (s.call_level > level) leave_frame(s);
    if (s.call_level == level) {
        s.block = outer;
        memcpy(s.raw, raw, sizeof raw);
        memcpy(s.text, canonical, sizeof canonical);
        s.raw_length = raw_length;
        s.pos = pos;
        s.word_start = word_start;
        s.sequence_number = number;
        s.line_offset = line_offset;
        s.after_offset = after_offset;
        std::swap(skipping, s.skipping);
    }
    return status;
}

int Interp::synch()
{
    Setup &s = *this->s;
    take_machine_state(s);
    // A file that cannot be written is no reason to stop; whoever runs the machine is told.
    const Fault fault = s.fault;
    const std::string error = s.error;
    errno = 0;
    s.parameter_trouble.clear();
    if (save_parameters(s) != INTERP_OK) {
        s.parameter_trouble = s.parameter_file + ": parameters and offsets can not be saved: " +
                              (errno ? strerror(errno) : s.error.c_str());
        s.fault = fault;
        s.error = error;
    }
    return INTERP_OK;
}

const std::string &Interp::parameter_trouble() const { return s->parameter_trouble; }

// The program is where reading goes on.
static void end_mdi(Setup &s)
{
    s.mdi = false;
    clear_labels(s);
    s.skipping.clear();
    s.defining.clear();
    s.source = s.mdi_source;
    if (s.source >= 0 && size_t(s.source) < s.sources.size()) {
        s.sources[size_t(s.source)]->seek(s.mdi_offset);
        s.sources[size_t(s.source)]->line_number = s.mdi_line;
    }
}

int Interp::reset()
{
    Setup &s = *this->s;
    unwind(s);
    drop_comp(s);
    if (s.mdi) end_mdi(s);
    s.raw[0] = s.text[0] = 0;
    s.raw_length = 0;
    s.canon.ON_RESET();
    return INTERP_OK;
}

int Interp::exit()
{
    Setup &s = *this->s;
    reset();
    if (save_parameters(s) != INTERP_OK) return INTERP_OK;
    if (s.python) s.python->at_exit(s);
    return INTERP_OK;
}

// ---- files ------------------------------------------------------------------------

namespace
{

// The first line with text decides whether % lines delimit the program.
int look_for_percent_line(Setup &s)
{
    LineSource &file = *s.sources[0];
    std::string_view line;
    bool newline;
    for (;;) {
        CHECK(!file.next(line, newline), "File ended with no percent sign (%%)");
        const size_t first = line.find_first_not_of(" \t\r\n\v\f");
        if (first == line.npos) continue;
        s.percent_flag = line[first] == '%' && line.find_first_not_of(" \t\r\n\v\f", first + 1) == line.npos;
        break;
    }
    if (!s.percent_flag) {
        file.seek(0);
        file.line_number = 0;
    }
    s.sequence_number = file.line_number;
    return INTERP_OK;
}

void close_files(Setup &s)
{
    clear_labels(s);
    s.sources.clear();
    s.source = -1;
    s.main_open = false;
}

// The flow of a program ends with an error, all of it.
int failed(Setup &s, int status)
{
    unwind(s);
    clear_labels(s);
    drop_comp(s);
    return status;
}

} // namespace

int Interp::open(const char *filename)
{
    Setup &s = *this->s;
    if (s.main_open && s.lazy_closed) {
        close_files(s);
        s.lazy_closed = false;
    }
    s.raw[0] = s.text[0] = 0;
    s.raw_length = 0;
    s.sequence_number = 0;
    CHECK(s.main_open, "A file is already open");
    CHECK(strlen(filename) > INTERP_LINELEN - 1, "File name too long");
    auto file = std::make_unique<LineSource>();
    if (!open_file(s, *file, filename)) {
        const char *why = strerror(errno);
        const int status = s.fail(__func__, "Unable to open file <%s>", filename);
        s.fault.fix = why;
        return status;
    }
    unwind(s);
    close_files(s);
    s.sources.push_back(std::move(file));
    s.source = 0;
    s.main_open = true;
    s.main_file = filename;
    nurbs_forget(s);
    const int status = look_for_percent_line(s);
    if (status == INTERP_OK) s.canon.ON_RESET();
    else close_files(s);
    s.at_start = s.main_open;
    return status;
}

int Interp::close()
{
    Setup &s = *this->s;
    if (s.have_ini) { // subs of the program stay callable until the next one is opened
        s.lazy_closed = s.main_open;
        return INTERP_OK;
    }
    unwind(s);
    close_files(s);
    return reset();
}

// ---- reading ------------------------------------------------------------------------

namespace
{

// What the machine had to finish before this line could be read.
int take_results(Setup &s)
{
    if (s.probe_flag) {
        CHECK(!s.canon.GET_EXTERNAL_QUEUE_EMPTY(), "Queue is not empty after probing");
        s.probe_flag = false;
        s.current = s.canon.GET_EXTERNAL_POSITION();
        const EmcPose p = s.canon.GET_EXTERNAL_PROBE_POSITION();
        for (int i = 0; i < AXES; ++i) {
            double v = axis(p, i);
            if (i >= AX_A && i <= AX_C && s.wrapped[i - AX_A]) {
                v = fmod(v, 360.0);
                if (v < 0) v += 360.0;
            }
            s.parameters[size_t(P_PROBE_X + i)] = v;
        }
        s.parameters[P_PROBE_TRIPPED] = s.canon.GET_EXTERNAL_PROBE_TRIPPED_VALUE() ? 1 : 0;
    }
    if (s.toolchange_flag) {
        CHECK(!s.canon.GET_EXTERNAL_QUEUE_EMPTY(), "Queue is not empty after tool change");
        s.toolchange_flag = false;
        s.current = s.canon.GET_EXTERNAL_POSITION();
        load_tool_table(s);
    }
    if (s.input_flag) {
        CHECK(!s.canon.GET_EXTERNAL_QUEUE_EMPTY(), "Queue is not empty after external input");
        s.input_flag = false;
        double &result = s.parameters[P_INPUT];
        result = s.input_digital ? s.canon.GET_EXTERNAL_DIGITAL_INPUT(s.input_index, int(result))
                                 : s.canon.GET_EXTERNAL_ANALOG_INPUT(s.input_index, result);
    }
    return INTERP_OK;
}

int end_of_file(Setup &s)
{
    const std::string file = s.sources[size_t(s.source)]->path();
    if (!s.skipping.empty()) {
        const int status = s.fail(__func__, "EOF in file:%s seeking o-word: o<%s> from line: %d", file.c_str(),
                                  s.skipping.c_str(), s.skipping_line);
        s.fault.line = s.skipping_line; // where the search began
        s.fault.column = 0;
        s.fault.text.clear();
        s.fault.fix = s.skipping_to_sub ? "define the sub in this file, or put it into " + s.skipping +
                                              ".ngc in the program's folder or [RS274NGC]SUBROUTINE_PATH"
                                        : "the line that ends this block is missing";
        return status;
    }
    CHECK(s.percent_flag && s.source == 0, "File ended with no percent sign (%%)");
    FAIL("File ended with no percent sign (%%) or program end (M2)");
}

// The next line of the file being read into s.raw and s.text.
int next_line(Setup &s, bool *have)
{
    *have = false;
    s.block.phase = 0;
    LineSource &file = *s.sources[size_t(s.source)];
    std::string_view line;
    bool newline;
    s.line_offset = file.tell();
    if (!file.next(line, newline)) return end_of_file(s);
    s.after_offset = file.tell();
    s.sequence_number = file.line_number;
    const bool too_long = line.size() + newline >= INTERP_LINELEN - 1;
    while (!line.empty() && (line.back() == ' ' || line.back() == '\r' || line.back() == '\t' ||
                             line.back() == '\v' || line.back() == '\f'))
        line.remove_suffix(1);
    if (__builtin_expect(too_long, 0)) {
        const int status = take_line(s, line.substr(0, INTERP_LINELEN - 1));
        (void)status;
        s.pos = s.word_start = 0;
        FAIL("Command too long");
    }
    if (__builtin_expect(!line.empty() && line.back() == '%', 0) && line.find_first_not_of(" \t") == line.size() - 1) {
        const bool sub_head = s.source > 0 && s.skipping_to_sub; // a sub file's own first %
        if (sub_head) return INTERP_OK;
        if (s.percent_flag && s.source == 0) {
            CHECK(s.skipping_to_sub, "Failed to find sub 'O%s' before EOF", s.skipping.c_str());
            TRY(take_line(s, line));
            s.canon.FINISH();
            return INTERP_ENDFILE;
        }
    }
    TRY(take_line(s, line));
    *have = true;
    return INTERP_OK;
}

// A Python handler waits to go on; what it called has ended.
bool handler_waits(const Setup &s) { return s.python && s.python->waiting_level() == s.call_level; }

int resume_handler(Setup &s)
{
    bool oword = false;
    const int status = s.python->resume(s, &oword);
    return oword ? finish_python_sub(s, status) : continue_remap(s, status);
}

} // namespace

int ngc::read_next_block(Setup &s)
{
    bool have;
    TRY(next_line(s, &have));
    if (!have || (s.text[0] == '/' && s.canon.GET_BLOCK_DELETE())) {
        s.block.clear();
        return INTERP_OK;
    }
    return read_block(s);
}

// Every run of a program begins with the modes that the INI file names.
static int begin_program(Setup &s)
{
    s.at_start = false;
    if (s.program_start_code.empty()) return INTERP_OK;
    const int status = run_inner(s, s.program_start_code.c_str());
    if (status == INTERP_OK) return status;
    const std::string why = status > INTERP_MIN_ERROR ? s.error : "it must not end a program or wait for the machine";
    return s.fail(__func__, "[RS274NGC]PROGRAM_START_CODE '%s': %s", s.program_start_code.c_str(), why.c_str());
}

int Interp::read()
{
    Setup &s = *this->s;
    if (__builtin_expect(s.source < 0 && !handler_waits(s), 0)) {
        s.error = "File not open";
        return INTERP_FILE_NOT_OPEN;
    }
    int status = INTERP_OK;
    if (__builtin_expect(s.probe_flag || s.toolchange_flag || s.input_flag, 0)) status = take_results(s);
    if (__builtin_expect(s.at_start, 0) && status == INTERP_OK) status = begin_program(s);
    if (status == INTERP_OK && !handler_waits(s)) status = read_next_block(s);
    if (__builtin_expect(status > INTERP_MIN_ERROR, 0)) {
        s.trace(__func__);
        return failed(s, status);
    }
    return status;
}

int Interp::read(const char *line)
{
    Setup &s = *this->s;
    int status = take_results(s);
    if (status == INTERP_OK) {
        status = take_line(s, line);
        s.line_offset = s.after_offset = 0;
    }
    if (status == INTERP_OK) {
        if (s.text[0] == '/' && s.canon.GET_BLOCK_DELETE()) {
            s.block.clear();
            return INTERP_OK;
        }
        status = read_block(s);
    }
    if (status > INTERP_MIN_ERROR) {
        s.trace(__func__);
        return failed(s, status);
    }
    return status;
}

int Interp::execute()
{
    Setup &s = *this->s;
    const int status = __builtin_expect(handler_waits(s), 0) ? resume_handler(s) : execute_block(s);
    if (__builtin_expect(status > INTERP_MIN_ERROR, 0)) {
        s.trace(__func__);
        return failed(s, status);
    }
    return status;
}

// An MDI line runs at level 0 without a file; what it calls has files of its own.
int Interp::execute(const char *line)
{
    Setup &s = *this->s;
    int status = INTERP_OK;
    if (line) {
        if (!s.mdi) {
            s.mdi = true;
            s.mdi_source = s.source;
            if (s.source >= 0) {
                s.mdi_offset = s.sources[size_t(s.source)]->tell();
                s.mdi_line = s.sources[size_t(s.source)]->line_number;
            }
            s.source = -1;
        }
        s.sequence_number = s.mdi_number;
        status = read(line);
        if (status == INTERP_OK) status = execute();
    }
    int lines = 0;
    while (status == INTERP_OK && (s.call_level > 0 || !s.skipping.empty()) &&
           (s.source >= 0 || handler_waits(s))) {
        if (s.mdi_slice > 0 && ++lines > s.mdi_slice) return INTERP_OK;
        status = read();
        if (status == INTERP_OK) status = execute();
    }
    if (status == INTERP_OK && (s.call_level > 0 || !s.skipping.empty())) {
        // Nothing left to read that could end it.
        unwind(s);
    }
    if (status == INTERP_EXECUTE_FINISH && s.call_level > 0) return status;
    // The line is done, or has failed.
    end_mdi(s);
    if (status == INTERP_OK || status == INTERP_EXECUTE_FINISH) s.canon.FINISH();
    return status;
}

int Interp::execute(const char *line, int sequence_number)
{
    s->mdi_number = sequence_number;
    const int status = execute(line);
    s->mdi_number = 0;
    return status;
}

void Interp::set_mdi_slice(int lines) { s->mdi_slice = lines; }
bool Interp::mdi_waits() const { return s->mdi; }

void Interp::set_loop_on_main_m99(bool on) { s->loop_on_m99 = on; }

int Interp::on_abort(int reason, const char *message)
{
    Setup &s = *this->s;
    (void)message;
    reset();
    clear_labels(s);
    s.probe_flag = s.input_flag = s.toolchange_flag = false;
    if (s.on_abort_command.empty()) return -1;
    char text[INTERP_LINELEN];
    snprintf(text, sizeof text, "%s [%d]", s.on_abort_command.c_str(), reason);
    const int slice = s.mdi_slice;
    s.mdi_slice = 0;
    const int status = execute(text);
    s.mdi_slice = slice;
    return status;
}

int Interp::restore_from_tag(const state_tag_t &tag) { return restore_after_abort(*s, tag); }

void Interp::get_offsets(double *values) const
{
    for (int i = 0; i < OFFSETS; ++i) values[i] = s->parameters[size_t(OFFSETS_FIRST + i)];
}

void Interp::restore_offsets(const double *values, const EmcPose &tool_offset)
{
    for (int i = 0; i < OFFSETS; ++i) s->parameters[size_t(OFFSETS_FIRST + i)] = values[i];
    init_offsets(*s);
    for (int i = 0; i < AXES; ++i) axis(s->tool_offset, i) = s->from_machine(i, axis(tool_offset, i));
    s->canon.USE_TOOL_LENGTH_OFFSET(s->tool_offset);
}

void Interp::take_state(const Interp &other)
{
    Setup &to = *s;
    const Setup &from = *other.s;
    to.current = from.current;
    to.g92 = from.g92;
    to.g5x = from.g5x;
    to.tool_offset = from.tool_offset;
    to.rotation = from.rotation;
    to.origin_index = from.origin_index;
    to.motion_mode = from.motion_mode;
    to.plane = from.plane;
    to.units = from.units;
    to.distance_mode = from.distance_mode;
    to.ijk_distance_mode = from.ijk_distance_mode;
    to.feed_mode = from.feed_mode;
    to.retract_mode = from.retract_mode;
    to.lathe_diameter = from.lathe_diameter;
    to.control_mode = from.control_mode;
    to.tolerance = from.tolerance;
    to.naivecam_tolerance = from.naivecam_tolerance;
    to.feed_rate = from.feed_rate;
    to.last_f = from.last_f;
    to.traverse_rate = from.traverse_rate;
    to.active_spindle = from.active_spindle;
    to.num_spindles = from.num_spindles;
    to.feed_override = from.feed_override;
    to.adaptive_feed = from.adaptive_feed;
    to.feed_hold = from.feed_hold;
    to.flood = from.flood;
    to.mist = from.mist;
    to.g43_with_zero_offset = from.g43_with_zero_offset;
    for (int i = 0; i <= std::max(to.tools_last, from.tools_last); ++i) to.tools[size_t(i)] = from.tools[size_t(i)];
    to.tools_last = from.tools_last;
    to.current_pocket = from.current_pocket;
    to.selected_pocket = from.selected_pocket;
    to.selected_tool = from.selected_tool;
    to.cycle_r = from.cycle_r;
    to.cycle_cc = from.cycle_cc;
    to.cycle_p = from.cycle_p;
    to.cycle_q = from.cycle_q;
    to.cycle_i = from.cycle_i;
    to.cycle_j = from.cycle_j;
    to.cycle_k = from.cycle_k;
    to.cycle_l = from.cycle_l;
    to.cycle_il = from.cycle_il;
    to.cycle_il_flag = from.cycle_il_flag;
    to.program_x = from.program_x;
    to.program_y = from.program_y;
    to.program_z = from.program_z;
    to.parameters = from.parameters;
    to.parameter_file = from.parameter_file;
    to.parameter_file_bad = from.parameter_file_bad;
    to.parameter_file_text = from.parameter_file_text;
    to.parameter_file_time = from.parameter_file_time;
    to.parameter_file_inode = from.parameter_file_inode;
    to.globals = from.globals;
    to.return_value = from.return_value;
    to.value_returned = from.value_returned;
    to.loop_on_m99 = from.loop_on_m99;
    to.last_g0 = from.last_g0;
    to.last_g92 = from.last_g92;
    to.last_stop = from.last_stop;
    to.last_toolchange = from.last_toolchange;
    for (int i = 0; i < CANON_MAX_SPINDLES; ++i) {
        to.speed[i] = from.speed[i];
        to.spindle_turning[i] = from.spindle_turning[i];
        to.spindle_mode[i] = from.spindle_mode[i];
        to.speed_override[i] = from.speed_override[i];
    }
    to.frames[0].modes = from.frames[0].modes;
    to.frames[0].locals = from.frames[0].locals;
}

void Interp::keep_parameters(bool on) { s->parameters_read_only = !on; }

void Interp::spindle_switched(int spindle, CANON_DIRECTION turning)
{
    for (int i = 0; i < s->num_spindles; ++i)
        if (spindle < 0 || spindle == i) s->spindle_turning[i] = turning;
}

void Interp::coolant_switched(bool mist, bool flood)
{
    s->mist = mist;
    s->flood = flood;
}

void Interp::outputs_stopped()
{
    for (int level = 0; level <= s->call_level; ++level) {
        int *m = s->frames[level].modes.m;
        m[2] = 5;
        m[4] = 9;
        m[5] = -1;
    }
}

// ---- asking ------------------------------------------------------------------------

void Interp::active_g_codes(int *codes) const { active_g(*s, codes); }
void Interp::active_m_codes(int *codes) const { active_m(*s, codes); }
void Interp::active_settings(double *values) const { active_values(*s, values); }
bool Interp::active_modes(int *g, int *m, double *settings, const state_tag_t &tag)
{
    return modes_of_tag(tag, g, m, settings);
}
void Interp::fill_tag(state_tag_t *tag) const { ngc::fill_tag(*s, tag); }

int Interp::line() const { return s->sequence_number; }
int Interp::sequence_number() const { return s->sequence_number; }
int Interp::main_line() const { return ngc::main_line(*s); }
int Interp::call_level() const { return s->call_level; }
int Interp::remap_level() const { return s->remap_level; }
const char *Interp::command() const { return s->raw; }
const char *Interp::file() const
{
    return s->source >= 0 ? s->sources[size_t(s->source)]->path().c_str() : s->main_file.c_str();
}
const char *Interp::main_file() const { return s->main_file.c_str(); }
size_t Interp::line_length() const { return size_t(s->raw_length); }
int Interp::file_open() const { return s->main_open && !s->lazy_closed; }
const char *Interp::file_name(char *buf, size_t size) const
{
    snprintf(buf, size, "%s", file());
    return buf;
}

const char *Interp::error_text(int code) const
{
    if (code == INTERP_FILE_NOT_OPEN) return "File not open";
    return code == INTERP_ERROR ? s->error.c_str() : "";
}
void Interp::set_error_text(const char *text)
{
    s->error = text;
    s->fault.what = text;
}
const Fault &Interp::fault() const { return s->fault; }
const char *Interp::stack_name(int index) const
{
    return index >= 0 && index < s->stack_size ? s->stack[size_t(index)] : "";
}

double Interp::parameter(int number) const
{
    return number >= 1 && number <= MAX_PARAMETER ? parameter_now(*s, number) : 0;
}
bool Interp::set_parameter(int number, double value)
{
    if (number < 1 || number > MAX_PARAMETER || parameter_read_only(number)) return false;
    s->parameters[size_t(number)] = value;
    return true;
}
bool Interp::named_parameter(const char *name, double *value) { return named_value(*s, name, value); }
void Interp::set_log_level(int level) { s->log_level = level; }
std::string Interp::parameter_file() const { return s->parameter_file; }
