/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * canterp.cc - see canterp.hh: files, lines, faults.
 */
#include "canterp.hh"

#include <algorithm>
#include <cerrno>

#include "stages.hh"

using namespace ngc;

int Canterp::init(const InterpOptions &options)
{
    Setup &s = setup();
    close_file();
    s.options = options;
    s.canon.INIT_CANON();
    s.machine_length_units = s.canon.GET_EXTERNAL_LENGTH_UNITS();
    s.machine_angle_units = s.canon.GET_EXTERNAL_ANGLE_UNITS();
    s.axis_mask = s.canon.GET_EXTERNAL_AXIS_MASK();
    s.parameter_file.clear();
    std::fill(s.parameters.begin(), s.parameters.end(), 0.0);
    s.num_spindles = CANON_MAX_SPINDLES;
    if (!options.ini_file.empty()) {
        if (!s.ini.open(options.ini_file)) return wrong({0, 0, "Unable to open inifile:" + options.ini_file, ""});
        s.num_spindles = s.ini.findIntV("SPINDLES", "TRAJ", 1, 1, CANON_MAX_SPINDLES);
    }
    init_modes(s);
    state = canterp::State();
    due = false;
    s.origin_index = 1;
    s.parameters[P_COORD_SYSTEM] = 1;
    s.g5x = s.g92 = EmcPose{};
    s.rotation = 0;
    if (options.task) {
        s.canon.SET_G5X_OFFSET(1, s.g5x);
        s.canon.SET_G92_OFFSET(s.g92);
        s.canon.SET_XY_ROTATION(0);
    }
    return synch();
}

void Canterp::close_file()
{
    Setup &s = setup();
    s.sources.clear();
    s.source = -1;
    s.main_open = false;
    text.clear();
    shown[0] = 0;
}

int Canterp::open(const char *filename)
{
    Setup &s = setup();
    s.sequence_number = 0;
    if (s.main_open) return wrong({0, 0, "A file is already open", ""});
    close_file();
    auto file = std::make_unique<LineSource>();
    if (!ngc::open_file(s, *file, filename))
        return wrong({0, 0, "Unable to open file <" + std::string(filename) + ">", strerror(errno)});
    s.sources.push_back(std::move(file));
    s.source = 0;
    s.main_open = true;
    s.main_file = filename;
    state = canterp::State();
    due = false;
    return INTERP_OK;
}

int Canterp::close()
{
    close_file();
    return INTERP_OK;
}

int Canterp::wrong(const canterp::Mistake &mistake)
{
    Setup &s = setup();
    const int status = s.fail("canterp", "%s", mistake.what.c_str());
    s.fault.text = text;
    s.fault.what = mistake.what;
    s.fault.fix = mistake.fix;
    s.fault.column = mistake.length ? int(mistake.column) + 1 : 0;
    s.fault.length = int(mistake.length);
    return status;
}

int Canterp::take(std::string_view fresh)
{
    Setup &s = setup();
    while (!fresh.empty() && (fresh.back() == '\r' || fresh.back() == ' ' || fresh.back() == '\t'))
        fresh.remove_suffix(1);
    text = fresh;
    s.block.clear();
    s.raw_length = int(fresh.copy(s.raw, sizeof s.raw - 1));
    s.raw[s.raw_length] = 0;
    canterp::Mistake mistake;
    const bool right = canterp::parse(text, s.num_spindles, &line, &mistake);
    shown[std::string_view(text).substr(right ? line.field : 0).copy(shown, sizeof shown - 1)] = 0;
    return right ? int(INTERP_OK) : wrong(mistake);
}

int Canterp::read()
{
    Setup &s = setup();
    line.call = nullptr;
    if (s.source < 0) {
        s.error = "File not open";
        return INTERP_FILE_NOT_OPEN;
    }
    LineSource &file = *s.sources[0];
    std::string_view fresh;
    bool newline;
    if (!file.next(fresh, newline)) {
        if (due) s.canon.FINISH();
        due = false;
        return INTERP_ENDFILE;
    }
    s.sequence_number = file.line_number;
    return take(fresh);
}

int Canterp::read(const char *mdi) { return take(mdi); }

int Canterp::run()
{
    Setup &s = setup();
    if (!line.call) return INTERP_OK;
    canterp::Mistake mistake;
    mistake.column = line.field;
    mistake.length = text.size() - std::min(text.size(), line.field);
    const int status = line.call->run(s, state, line.arguments, &mistake.what);
    if (status > INTERP_MIN_ERROR) return wrong(mistake);
    due = !line.call->trailing && status != INTERP_EXIT;
    return status;
}

int Canterp::execute()
{
    Setup &s = setup();
    const int status = run();
    if (status != INTERP_EXIT || s.source < 0) return status;
    // What rs274 prints of a program goes on a little behind its end.
    LineSource &file = *s.sources[0];
    const int ended = s.sequence_number;
    std::string_view fresh;
    bool newline;
    while (file.next(fresh, newline) && take(fresh) == INTERP_OK && (!line.call || line.call->trailing)) run();
    s.sequence_number = ended;
    return status;
}

// The calls that bring the modes of the move back that was under way. Offsets are task's.
int Canterp::restore_from_tag(const state_tag_t &tag)
{
    Setup &s = setup();
    int g[ACTIVE_G_CODES], m[ACTIVE_M_CODES];
    double settings[ACTIVE_SETTINGS];
    if (!active_modes(g, m, settings, tag)) return INTERP_OK;
    if (g[5] != (s.units == CANON_UNITS_INCHES ? G_20 : G_21) && convert_units(s, g[5]) > INTERP_MIN_ERROR)
        return INTERP_ERROR;
    if (convert_plane(s, g[3]) > INTERP_MIN_ERROR) return INTERP_ERROR;
    s.feed_mode = g[7] == G_95 ? UNITS_PER_REVOLUTION : UNITS_PER_MINUTE;
    s.canon.SET_FEED_MODE(0, g[7] == G_95);
    s.feed_rate = settings[1];
    s.canon.SET_FEED_RATE(s.feed_rate);
    s.control_mode = g[11] == G_64 ? CANON_CONTINUOUS : g[11] == G_61 ? CANON_EXACT_PATH : CANON_EXACT_STOP;
    s.tolerance = settings[3];
    s.naivecam_tolerance = settings[4];
    s.canon.SET_MOTION_CONTROL_MODE(s.control_mode, s.tolerance);
    s.canon.SET_NAIVECAM_TOLERANCE(s.naivecam_tolerance);
    state = canterp::State();
    return INTERP_OK;
}

extern "C" Interp *makeInterp(Canon &canon) { return new Canterp(canon); }
