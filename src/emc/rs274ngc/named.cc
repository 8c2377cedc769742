/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * named.cc - named parameters: local, global, predefined, INI and HAL.
 *
 * In:     a name (lower case, no blanks)
 * Out:    its value in the scope of the line
 * Thread: [task]
 * Source: G-code sheet, section 4 "Named parameters"
 */
#include <cstdlib>

#include "python_link.hh"
#include "stages.hh"

namespace ngc
{
namespace
{

double plane_code(Setup &s)
{
    switch (s.plane) {
    case CANON_PLANE_XY: return 170;
    case CANON_PLANE_XZ: return 180;
    case CANON_PLANE_YZ: return 190;
    case CANON_PLANE_UV: return 171;
    case CANON_PLANE_UW: return 181;
    case CANON_PLANE_VW: return 191;
    }
    return 0;
}

double coord_system_code(Setup &s) { return s.origin_index < 7 ? 530 + 10 * s.origin_index : 584 + s.origin_index; }

double any_tool_offset(Setup &s)
{
    for (int i = 0; i < AXES; ++i)
        if (axis(s.tool_offset, i) != 0) return 1;
    return 0;
}

// The package version as two numbers: "2.10" and what follows it.
double version_part(bool minor)
{
    char *end;
    double major = strtod(KERF_VERSION, &end);
    return minor ? strtod(end, nullptr) : major;
}

double pocket_of(const Setup &s, int idx, bool selected)
{
    if (s.random_toolchanger) return idx;
    if (idx < 0 || idx >= CANON_POCKETS_MAX) return -1;
    int pocket = s.tools[size_t(idx)].pocketno;
    return selected && pocket == 0 ? -1 : pocket;
}

template <int I> double position_of(Setup &s) { return axis(s.current, I); }
template <int I> double absolute_of(Setup &s) { return axis(absolute_position(s), I); }

struct Predefined {
    const char *name;
    double (*value)(Setup &);
};

const Predefined predefined[] = {
    {"_vmajor", [](Setup &) { return version_part(false); }},
    {"_vminor", [](Setup &) { return version_part(true); }},
    {"_metric_machine", [](Setup &s) { return double(s.metric_machine); }},
    {"_line", [](Setup &s) { return double(s.sequence_number); }},
    {"_motion_mode", [](Setup &s) { return double(s.motion_mode); }},
    {"_plane", plane_code},
    {"_ccomp",
     [](Setup &s) { return s.comp_side == COMP_LEFT ? 410.0 : s.comp_side == COMP_RIGHT ? 420.0 : 400.0; }},
    {"_metric", [](Setup &s) { return double(s.units == CANON_UNITS_MM); }},
    {"_imperial", [](Setup &s) { return double(s.units == CANON_UNITS_INCHES); }},
    {"_absolute", [](Setup &s) { return double(s.distance_mode == MODE_ABSOLUTE); }},
    {"_incremental", [](Setup &s) { return double(s.distance_mode == MODE_INCREMENTAL); }},
    {"_inverse_time", [](Setup &s) { return double(s.feed_mode == INVERSE_TIME); }},
    {"_units_per_minute", [](Setup &s) { return double(s.feed_mode == UNITS_PER_MINUTE); }},
    {"_units_per_rev", [](Setup &s) { return double(s.feed_mode == UNITS_PER_REVOLUTION); }},
    {"_coord_system", coord_system_code},
    {"_tool_offset", any_tool_offset},
    {"_retract_r_plane", [](Setup &s) { return double(s.retract_mode == R_PLANE); }},
    {"_retract_old_z", [](Setup &s) { return double(s.retract_mode == OLD_Z); }},
    {"_spindle_rpm_mode", [](Setup &s) { return double(s.spindle_mode[0] == CONSTANT_RPM); }},
    {"_spindle_css_mode", [](Setup &s) { return double(s.spindle_mode[0] == CONSTANT_SURFACE); }},
    {"_ijk_absolute_mode", [](Setup &s) { return double(s.ijk_distance_mode == MODE_ABSOLUTE); }},
    {"_lathe_diameter_mode", [](Setup &s) { return double(s.lathe_diameter); }},
    {"_lathe_radius_mode", [](Setup &s) { return double(!s.lathe_diameter); }},
    {"_spindle_on", [](Setup &s) { return double(s.spindle_turning[0] != CANON_STOPPED); }},
    {"_spindle_cw", [](Setup &s) { return double(s.spindle_turning[0] == CANON_CLOCKWISE); }},
    {"_mist", [](Setup &s) { return double(s.mist); }},
    {"_flood", [](Setup &s) { return double(s.flood); }},
    {"_speed_override", [](Setup &s) { return double(s.speed_override[0]); }},
    {"_feed_override", [](Setup &s) { return double(s.feed_override); }},
    {"_adaptive_feed", [](Setup &s) { return double(s.adaptive_feed); }},
    {"_feed_hold", [](Setup &s) { return double(s.feed_hold); }},
    {"_feed", [](Setup &s) { return s.feed_rate; }},
    {"_rpm", [](Setup &s) { return fabs(s.speed[0]); }},
    {"_current_tool", [](Setup &s) { return s.parameters[P_TOOL_NUMBER]; }},
    {"_current_pocket", [](Setup &s) { return pocket_of(s, s.current_pocket, false); }},
    {"_selected_pocket", [](Setup &s) { return pocket_of(s, s.selected_pocket, true); }},
    {"_selected_tool", [](Setup &s) { return double(s.selected_tool); }},
    {"_x", position_of<AX_X>},       {"_y", position_of<AX_Y>},       {"_z", position_of<AX_Z>},
    {"_a", position_of<AX_A>},       {"_b", position_of<AX_B>},       {"_c", position_of<AX_C>},
    {"_u", position_of<AX_U>},       {"_v", position_of<AX_V>},       {"_w", position_of<AX_W>},
    {"_abs_x", absolute_of<AX_X>},   {"_abs_y", absolute_of<AX_Y>},   {"_abs_z", absolute_of<AX_Z>},
    {"_abs_a", absolute_of<AX_A>},   {"_abs_b", absolute_of<AX_B>},   {"_abs_c", absolute_of<AX_C>},
    {"_abs_u", absolute_of<AX_U>},   {"_abs_v", absolute_of<AX_V>},   {"_abs_w", absolute_of<AX_W>},
    {"_value", [](Setup &s) { return s.return_value; }},
    {"_value_returned", [](Setup &s) { return double(s.value_returned); }},
    {"_task", [](Setup &s) { return double(s.options.task); }},
    {"_call_level", [](Setup &s) { return double(s.call_level); }},
    {"_remap_level", [](Setup &s) { return double(s.remap_level); }},
};

std::string upper(std::string_view text)
{
    std::string out(text);
    for (char &c : out)
        if (c >= 'a' && c <= 'z') c = char(c - 32);
    return out;
}

// "_ini[section]name": read once, then a read-only global.
bool ini_value(Setup &s, std::string_view name, double *value)
{
    size_t close = name.find(']');
    if (close == name.npos || !s.have_ini) return false;
    std::string section = upper(name.substr(5, close - 5)), key = upper(name.substr(close + 1));
    auto text = s.ini.findString(key, section);
    if (!text) return false;
    auto number = linuxcnc::IniFile::convertReal(*text);
    if (!number) return false;
    NamedParameter &p = s.globals.at(name);
    p.value = *value = *number;
    p.read_only = true;
    return true;
}

bool hal_value(Setup &s, std::string_view name, double *value)
{
    if (name.empty() || name.back() != ']') return false;
    std::string item(name.substr(5, name.size() - 6));
    return s.canon.hal_value(item.c_str(), value);
}

NameTable<NamedParameter> &table_of(Setup &s, std::string_view name)
{
    return !name.empty() && name[0] == '_' ? s.globals : s.frame().locals;
}

} // namespace

void define_predefined(Setup &s)
{
    for (const Predefined &p : predefined) {
        NamedParameter &n = s.globals.at(p.name);
        n.computed = p.value;
        n.read_only = true;
    }
}

NamedParameter *find_named(Setup &s, std::string_view name) { return table_of(s, name).find(name); }

NamedParameter &make_named(Setup &s, std::string_view name) { return table_of(s, name).at(name); }

bool named_value(Setup &s, std::string_view name, double *value, bool *failed)
{
    if (const NamedParameter *p = find_named(s, name)) {
        if (p->computed) *value = p->computed(s);
        else if (p->python) {
            if (s.python->named_value(s, std::string(name), value) == INTERP_OK) return true;
            if (failed) *failed = true;
            return false;
        } else *value = p->value;
        return true;
    }
    if (name.size() > 5 && name[0] == '_') {
        if (s.ini_vars && name.substr(0, 5) == "_ini[") return ini_value(s, name, value);
        if (s.hal_pin_vars && name.substr(0, 5) == "_hal[") return hal_value(s, name, value);
    }
    return false;
}

} // namespace ngc
