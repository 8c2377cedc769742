/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * calls.cc - the calls that canterp knows, and what each one does.
 *
 * Method: a call goes to the canon and leaves its mark in Setup, where active codes, the tags of
 *         moves and the offsets of the status come from.
 */
#include <algorithm>
#include <iterator>

#include "canterp.hh"
#include "stages.hh"

using namespace ngc;

namespace canterp
{
namespace
{

// Six values leave U, V and W as they are in `rest`; nine give all.
EmcPose pose(const Arguments &a, size_t first, const EmcPose &rest)
{
    EmcPose p = rest;
    for (size_t i = first; i < a.v.size() && i < first + AXES; ++i) axis(p, int(i - first)) = a.v[i];
    return p;
}

void keep(Setup &s, int first, const EmcPose &p)
{
    for (int i = 0; i < AXES; ++i) s.parameters[size_t(first + i)] = s.to_machine(i, axis(p, i));
}

// Offsets change: the machine stays where it is.
template <class Change> void shift(Setup &s, Change change)
{
    const EmcPose absolute = absolute_position(s);
    change();
    s.current = from_absolute(s, absolute);
}

bool dead_slow(const Setup &s, const State &state, const EmcPose &end, std::string *what)
{
    if (s.feed_rate > 0 || state.synched || memcmp(&end, &s.current, sizeof end) == 0) return false;
    *what = "A feed move with feed rate zero: SET_FEED_RATE is missing";
    return true;
}

int straight_feed(Setup &s, State &state, const Arguments &a, std::string *what)
{
    const EmcPose end = pose(a, 0, s.current);
    if (dead_slow(s, state, end, what)) return INTERP_ERROR;
    s.motion_mode = G_1;
    update_tag(s);
    s.canon.STRAIGHT_FEED(s.sequence_number, end);
    s.current = end;
    return INTERP_OK;
}

int straight_traverse(Setup &s, State &, const Arguments &a, std::string *)
{
    const EmcPose end = pose(a, 0, s.current);
    s.motion_mode = G_0;
    update_tag(s);
    s.canon.STRAIGHT_TRAVERSE(s.sequence_number, end);
    s.current = end;
    return INTERP_OK;
}

int arc_feed(Setup &s, State &state, const Arguments &a, std::string *what)
{
    if (s.plane != CANON_PLANE_XY && s.plane != CANON_PLANE_YZ && s.plane != CANON_PLANE_XZ) {
        *what = "ARC_FEED needs the plane XY, YZ or XZ: SELECT_PLANE";
        return INTERP_ERROR;
    }
    const int first = s.plane == CANON_PLANE_XZ ? 2 : s.plane == CANON_PLANE_YZ ? 1 : 0;
    EmcPose end = s.current;
    axis(end, first) = a.v[0];
    axis(end, (first + 1) % 3) = a.v[1];
    axis(end, (first + 2) % 3) = a.v[5];
    for (size_t i = 6; i < a.v.size(); ++i) axis(end, int(i) - 3) = a.v[i];
    const int rotation = a.integer(4);
    if (s.feed_rate <= 0 && !state.synched) {
        *what = "An arc with feed rate zero: SET_FEED_RATE is missing";
        return INTERP_ERROR;
    }
    s.motion_mode = rotation < 0 ? G_2 : G_3;
    update_tag(s);
    s.canon.ARC_FEED(s.sequence_number, a.v[0], a.v[1], a.v[2], a.v[3], rotation, a.v[5], end);
    s.current = end;
    return INTERP_OK;
}

// The type is no part of what rs274 prints: without one it is that of G38.2.
int straight_probe(Setup &s, State &state, const Arguments &a, std::string *what)
{
    const size_t n = a.v.size();
    const int type = n == 7 || n == 10 ? a.integer(n - 1) : 0;
    Arguments target = a;
    if (n == 7 || n == 10) target.v.pop_back();
    if (type > 3) {
        *what = "The type of a probe is 0 to 3";
        return INTERP_ERROR;
    }
    const EmcPose end = pose(target, 0, s.current);
    if (dead_slow(s, state, end, what)) return INTERP_ERROR;
    s.motion_mode = G_38_2 + type;
    update_tag(s);
    s.canon.STRAIGHT_PROBE(s.sequence_number, end, static_cast<unsigned char>(type));
    s.current = end;
    return INTERP_EXECUTE_FINISH; // it stops anywhere
}

int rigid_tap(Setup &s, State &, const Arguments &a, std::string *)
{
    s.motion_mode = G_33_1;
    update_tag(s);
    s.canon.RIGID_TAP(s.sequence_number, a.v[0], a.v[1], a.v[2], a.v.size() > 3 ? a.v[3] : 1.0);
    return INTERP_OK;
}

int spline(Setup &, State &, const Arguments &, std::string *what)
{
    *what = "The text of a spline does not hold its points: it can't be run";
    return INTERP_ERROR;
}

int set_g5x(Setup &s, State &, const Arguments &a, std::string *)
{
    shift(s, [&] {
        s.origin_index = a.integer(0);
        s.g5x = pose(a, 1, EmcPose{});
        s.parameters[P_COORD_SYSTEM] = s.origin_index;
        keep(s, P_G5X_BASE + 20 * s.origin_index, s.g5x);
        s.canon.SET_G5X_OFFSET(s.origin_index, s.g5x);
    });
    return INTERP_OK;
}

int set_g92(Setup &s, State &, const Arguments &a, std::string *)
{
    shift(s, [&] {
        s.g92 = pose(a, 0, EmcPose{});
        s.parameters[P_G92_APPLIED] = std::any_of(a.v.begin(), a.v.end(), [](double v) { return v != 0; });
        keep(s, P_G92, s.g92);
        s.canon.SET_G92_OFFSET(s.g92);
    });
    return INTERP_OK;
}

int set_rotation(Setup &s, State &, const Arguments &a, std::string *)
{
    shift(s, [&] {
        s.rotation = a.v[0];
        s.parameters[size_t(P_G5X_BASE + 20 * s.origin_index + AXES)] = s.rotation;
        s.canon.SET_XY_ROTATION(s.rotation);
    });
    return INTERP_OK;
}

int use_tool_offset(Setup &s, State &, const Arguments &a, std::string *)
{
    shift(s, [&] {
        s.tool_offset = pose(a, 0, EmcPose{});
        s.canon.USE_TOOL_LENGTH_OFFSET(s.tool_offset);
    });
    return INTERP_OK;
}

int use_units(Setup &s, State &, const Arguments &a, std::string *)
{
    const CANON_UNITS units = CANON_UNITS(a.integer(0));
    if (units == s.units) return s.canon.USE_LENGTH_UNITS(units), INTERP_OK;
    return convert_units(s, units == CANON_UNITS_INCHES ? G_20 : G_21);
}

int set_control_mode(Setup &s, State &state, const Arguments &a, std::string *)
{
    s.control_mode = CANON_MOTION_MODE(a.integer(0));
    s.tolerance = a.v.size() > 1 ? a.v[1] : 0;
    s.canon.SET_MOTION_CONTROL_MODE(s.control_mode, s.tolerance, state.planner_type, state.peak_scale);
    state.planner_type = -1;
    state.peak_scale = -1;
    return INTERP_OK;
}

int set_synch(Setup &s, State &state, const Arguments &a, std::string *)
{
    const size_t first = a.v.size() - 2;
    state.synched = true;
    s.canon.START_SPEED_FEED_SYNCH(first ? a.integer(0) : 0, a.v[first], a.v[first + 1] != 0);
    return INTERP_OK;
}

int set_feed_mode(Setup &s, State &state, const Arguments &a, std::string *)
{
    s.feed_mode = a.v[1] != 0 ? UNITS_PER_REVOLUTION : UNITS_PER_MINUTE;
    state.synched = false;
    s.canon.SET_FEED_MODE(a.integer(0), a.integer(1));
    return INTERP_OK;
}

int start_spindle(Setup &s, const Arguments &a, CANON_DIRECTION direction)
{
    const int spindle = a.integer(0), wait = a.v.size() > 1 ? a.integer(1) : 1;
    if (direction == CANON_CLOCKWISE) s.canon.START_SPINDLE_CLOCKWISE(spindle, wait);
    else if (direction == CANON_COUNTERCLOCKWISE) s.canon.START_SPINDLE_COUNTERCLOCKWISE(spindle, wait);
    else s.canon.STOP_SPINDLE_TURNING(spindle, wait);
    s.spindle_turning[spindle] = direction;
    return INTERP_OK;
}

// The diameter is no part of what rs274 prints: without one it stays as it is.
int set_tool(Setup &s, State &, const Arguments &a, std::string *)
{
    const size_t n = a.v.size();
    const int idx = a.integer(0);
    const double diameter = n == 15 ? a.v[11] : s.canon.GET_EXTERNAL_TOOL_TABLE(idx).diameter;
    s.canon.SET_TOOL_TABLE_ENTRY(idx, a.integer(1), pose(a, 2, EmcPose{}), diameter, a.v[n - 3], a.v[n - 2],
                                 a.integer(n - 1));
    return INTERP_OK;
}

int wait_input(Setup &s, State &, const Arguments &a, std::string *what)
{
    if (a.v[1] > 1 || a.v[2] > WAIT_MODE_LOW) {
        *what = "WAIT(index, 1 digital or 0 analog, 0 to 4, seconds)";
        return INTERP_ERROR;
    }
    if (s.canon.WAIT(a.integer(0), CANON_INPUT(a.integer(1)), CANON_WAIT(a.integer(2)), a.v[3]) == 0)
        return INTERP_EXECUTE_FINISH;
    *what = "There is no such input";
    return INTERP_ERROR;
}

int user_code(Setup &s, State &, const Arguments &a, std::string *what)
{
    if (a.v[0] >= USER_DEFINED_FUNCTION_NUM || !s.canon.USER_DEFINED_FUNCTION_EXISTS(a.integer(0))) {
        *what = "There is no user program of that number: M100 is 0";
        return INTERP_ERROR;
    }
    s.canon.USER_DEFINED_FUNCTION(a.integer(0), a.v[1], a.v[2]);
    return INTERP_OK;
}

#define RUN(...) [](Setup &s, State &state, const Arguments &a, std::string *) -> int { \
        (void)s, (void)state, (void)a; \
        __VA_ARGS__; \
        return INTERP_OK; \
    }
#define PLAIN(name) {#name, "", RUN(s.canon.name())}
#define NUMBER(name) {#name, "n", RUN(s.canon.name(a.v[0]))}
#define INDEX(name) {#name, "i", RUN(s.canon.name(a.integer(0)))}
#define TEXT(name) {#name, "t", RUN(s.canon.name(a.text.c_str()))}

const Call calls[] = {
    {"ARC_FEED", "nnnnznnnn|nnnnznnnnnnn", arc_feed},
    {"CANON_ERROR", "e", RUN(s.canon.CANON_ERROR(a.text.c_str()))},
    {"CHANGE_TOOL", "", [](Setup &s, State &, const Arguments &, std::string *) -> int {
         s.canon.CHANGE_TOOL();
         s.last_toolchange = 6;
         return INTERP_EXECUTE_FINISH; // it may have moved
     }},
    INDEX(CHANGE_TOOL_NUMBER),
    {"CLAMP_AXIS", "A", RUN(s.canon.CLAMP_AXIS(CANON_AXIS(a.integer(0))))},
    INDEX(CLEAR_AUX_OUTPUT_BIT),
    INDEX(CLEAR_MOTION_OUTPUT_BIT),
    {"COMMENT", "t", RUN(s.canon.COMMENT(a.text.c_str())), true},
    {"DISABLE_ADAPTIVE_FEED", "", RUN(s.adaptive_feed = false; s.canon.DISABLE_ADAPTIVE_FEED())},
    {"DISABLE_FEED_HOLD", "", RUN(s.feed_hold = false; s.canon.DISABLE_FEED_HOLD())},
    {"DISABLE_FEED_OVERRIDE", "", RUN(s.feed_override = false; s.canon.DISABLE_FEED_OVERRIDE())},
    {"DISABLE_SPEED_OVERRIDE", "s",
     RUN(s.speed_override[a.integer(0)] = false; s.canon.DISABLE_SPEED_OVERRIDE(a.integer(0)))},
    NUMBER(DWELL),
    {"ENABLE_ADAPTIVE_FEED", "", RUN(s.adaptive_feed = true; s.canon.ENABLE_ADAPTIVE_FEED())},
    {"ENABLE_FEED_HOLD", "", RUN(s.feed_hold = true; s.canon.ENABLE_FEED_HOLD())},
    {"ENABLE_FEED_OVERRIDE", "", RUN(s.feed_override = true; s.canon.ENABLE_FEED_OVERRIDE())},
    {"ENABLE_SPEED_OVERRIDE", "s",
     RUN(s.speed_override[a.integer(0)] = true; s.canon.ENABLE_SPEED_OVERRIDE(a.integer(0)))},
    {"FINISH", "", RUN(s.canon.FINISH()), true},
    {"FLOOD_OFF", "", RUN(s.flood = false; s.canon.FLOOD_OFF())},
    {"FLOOD_ON", "", RUN(s.flood = true; s.canon.FLOOD_ON())},
    {"LOCK_ROTARY", "i", RUN(s.canon.LOCK_ROTARY(s.sequence_number, a.integer(0)))},
    PLAIN(LOCK_SPINDLE_Z),
    TEXT(LOG),
    TEXT(LOGAPPEND),
    PLAIN(LOGCLOSE),
    TEXT(LOGOPEN),
    TEXT(MESSAGE),
    {"MIST_OFF", "", RUN(s.mist = false; s.canon.MIST_OFF())},
    {"MIST_ON", "", RUN(s.mist = true; s.canon.MIST_ON())},
    {"NURBS_G5_FEED", "e", spline},
    {"NURBS_G6_FEED_", "e", spline},
    {"ON_RESET", "", RUN(s.canon.ON_RESET()), true},
    PLAIN(OPTIONAL_PROGRAM_STOP),
    {"ORIENT_SPINDLE", "sni", RUN(s.canon.ORIENT_SPINDLE(a.integer(0), a.v[1], a.integer(2)))},
    PLAIN(PALLET_SHUTTLE),
    {"PROGRAM_END", "", [](Setup &s, State &state, const Arguments &, std::string *) -> int {
         s.canon.PROGRAM_END();
         state = State();
         return INTERP_EXIT;
     }},
    PLAIN(PROGRAM_STOP),
    PLAIN(RELOAD_TOOLDATA),
    {"RIGID_TAP", "nnn|nnnn", rigid_tap},
    {"SELECT_PLANE", "P", RUN(s.plane = CANON_PLANE(a.integer(0)); s.canon.SELECT_PLANE(s.plane))},
    {"SELECT_TOOL", "z", RUN(s.selected_tool = a.integer(0); s.canon.SELECT_TOOL(a.integer(0)))},
    INDEX(SET_AUX_OUTPUT_BIT),
    {"SET_AUX_OUTPUT_VALUE", "in", RUN(s.canon.SET_AUX_OUTPUT_VALUE(a.integer(0), a.v[1]))},
    {"SET_CUTTER_RADIUS_COMPENSATION", "n", RUN()}, // compensation is done before there are calls
    {"SET_FEED_MODE", "sb", set_feed_mode},
    {"SET_FEED_RATE", "n", RUN(s.feed_rate = a.v[0]; s.canon.SET_FEED_RATE(a.v[0]))},
    {"SET_FEED_REFERENCE", "R", RUN(s.canon.SET_FEED_REFERENCE(CANON_FEED_REFERENCE(a.integer(0))))},
    {"SET_G5X_OFFSET", "gnnnnnn|gnnnnnnnnn", set_g5x},
    {"SET_G92_OFFSET", "nnnnnn|nnnnnnnnn", set_g92},
    {"SET_MOTION_CONTROL_MODE", "M|Mn", set_control_mode},
    INDEX(SET_MOTION_OUTPUT_BIT),
    {"SET_MOTION_OUTPUT_VALUE", "in", RUN(s.canon.SET_MOTION_OUTPUT_VALUE(a.integer(0), a.v[1]))},
    {"SET_NAIVECAM_TOLERANCE", "n", RUN(s.naivecam_tolerance = a.v[0]; s.canon.SET_NAIVECAM_TOLERANCE(a.v[0]))},
    {"SET_PLANNER_MODE", "zn", RUN(state.planner_type = a.integer(0); state.peak_scale = a.v[1])},
    {"SET_SPINDLE_MODE", "sn",
     RUN(s.spindle_mode[a.integer(0)] = a.v[1] != 0 ? CONSTANT_SURFACE : CONSTANT_RPM;
         s.canon.SET_SPINDLE_MODE(a.integer(0), a.v[1]))},
    {"SET_SPINDLE_SPEED", "sn", RUN(s.speed[a.integer(0)] = a.v[1]; s.canon.SET_SPINDLE_SPEED(a.integer(0), a.v[1]))},
    {"SET_TOOL_TABLE_ENTRY", "iznnnnnnnnnnni|iznnnnnnnnnnnni", set_tool},
    NUMBER(SET_TRAVERSE_RATE),
    {"SET_XY_ROTATION", "n", set_rotation},
    PLAIN(SPINDLE_RETRACT),
    PLAIN(SPINDLE_RETRACT_TRAVERSE),
    {"START_CUTTER_RADIUS_COMPENSATION", "S", RUN()},
    {"START_SPEED_FEED_SYNC", "nb|snb", set_synch},
    {"START_SPEED_FEED_SYNCH", "nb|snb", set_synch},
    {"START_SPINDLE_CLOCKWISE", "s|sb",
     [](Setup &s, State &, const Arguments &a, std::string *) { return start_spindle(s, a, CANON_CLOCKWISE); }},
    {"START_SPINDLE_COUNTERCLOCKWISE", "s|sb",
     [](Setup &s, State &, const Arguments &a, std::string *) { return start_spindle(s, a, CANON_COUNTERCLOCKWISE); }},
    {"STOP_CUTTER_RADIUS_COMPENSATION", "", RUN()},
    {"STOP_SPEED_FEED_SYNCH", "", RUN(state.synched = false; s.canon.STOP_SPEED_FEED_SYNCH())},
    {"STOP_SPINDLE_TURNING", "s|sb",
     [](Setup &s, State &, const Arguments &a, std::string *) { return start_spindle(s, a, CANON_STOPPED); }},
    {"STRAIGHT_FEED", "nnnnnn|nnnnnnnnn", straight_feed},
    {"STRAIGHT_PROBE", "nnnnnn|nnnnnni|nnnnnnnnn|nnnnnnnnni", straight_probe},
    {"STRAIGHT_TRAVERSE", "nnnnnn|nnnnnnnnn", straight_traverse},
    PLAIN(TURN_PROBE_OFF),
    PLAIN(TURN_PROBE_ON),
    {"UNCLAMP_AXIS", "A", RUN(s.canon.UNCLAMP_AXIS(CANON_AXIS(a.integer(0))))},
    {"UNLOCK_ROTARY", "i", RUN(s.canon.UNLOCK_ROTARY(s.sequence_number, a.integer(0)))},
    {"USER_DEFINED_FUNCTION", "inn", user_code},
    {"USE_LENGTH_UNITS", "U", use_units},
    PLAIN(USE_NO_SPINDLE_FORCE),
    PLAIN(USE_SPINDLE_FORCE),
    {"USE_TOOL_LENGTH_OFFSET", "nnnnnnnnn", use_tool_offset},
    {"WAIT", "iiin", wait_input},
    {"WAIT_SPINDLE_ORIENT_COMPLETE", "sn", RUN(s.canon.WAIT_SPINDLE_ORIENT_COMPLETE(a.integer(0), a.v[1]))},
};

// How many letters must be put in, taken out or changed.
size_t distance(std::string_view from, std::string_view to)
{
    std::vector<size_t> row(to.size() + 1);
    for (size_t j = 0; j <= to.size(); ++j) row[j] = j;
    for (size_t i = 1; i <= from.size(); ++i) {
        size_t corner = row[0];
        row[0] = i;
        for (size_t j = 1; j <= to.size(); ++j) {
            const size_t above = row[j];
            row[j] = std::min({above + 1, row[j - 1] + 1, corner + (from[i - 1] != to[j - 1])});
            corner = above;
        }
    }
    return row[to.size()];
}

} // namespace

const Call *find_call(std::string_view name)
{
    const auto at = std::lower_bound(std::begin(calls), std::end(calls), name,
                                     [](const Call &c, std::string_view n) { return c.name < n; });
    return at != std::end(calls) && name == at->name ? at : nullptr;
}

std::string known_calls()
{
    std::string all;
    for (const Call &c : calls) all += (all.empty() ? "" : " ") + std::string(c.name);
    return all;
}

std::string nearest_call(std::string_view name)
{
    const auto nearer = [&](const Call &a, const Call &b) { return distance(a.name, name) < distance(b.name, name); };
    const std::string nearest = std::min_element(std::begin(calls), std::end(calls), nearer)->name;
    return distance(nearest, name) * 3 <= nearest.size() ? "; the nearest one is " + nearest : "";
}

} // namespace canterp
