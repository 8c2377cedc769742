/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * active.cc - active codes and settings, and the tag that carries them with a move.
 *
 * Thread: [task]
 * Source: G-code sheet, section 8 "Active-code arrays"; motion sheet, section 16
 */
#include "stages.hh"

namespace ngc
{
namespace
{

int plane_g(CANON_PLANE plane)
{
    static const int code[] = {G_17, G_17, G_19, G_18, G_17_1, G_19_1, G_18_1};
    return plane >= 1 && plane <= 6 ? code[plane] : G_17;
}

bool offset_in_use(const Setup &s)
{
    for (int i = 0; i < AXES; ++i)
        if (axis(s.tool_offset, i) != 0) return true;
    return s.g43_with_zero_offset;
}

int system_g(int index) { return index < 7 ? 530 + 10 * index : 584 + index; }

} // namespace

void active_g(const Setup &s, int *g)
{
    g[0] = s.sequence_number;
    g[1] = s.motion_mode;
    g[2] = s.last_g0;
    g[3] = plane_g(s.plane);
    g[4] = s.comp_side == COMP_RIGHT ? G_42 : s.comp_side == COMP_LEFT ? G_41 : G_40;
    g[5] = s.units == CANON_UNITS_INCHES ? G_20 : G_21;
    g[6] = s.distance_mode == MODE_ABSOLUTE ? G_90 : G_91;
    g[7] = s.feed_mode == INVERSE_TIME ? G_93 : s.feed_mode == UNITS_PER_MINUTE ? G_94 : G_95;
    g[8] = system_g(s.origin_index);
    g[9] = offset_in_use(s) ? G_43 : G_49;
    g[10] = s.retract_mode == OLD_Z ? G_98 : G_99;
    g[11] = s.control_mode == CANON_CONTINUOUS ? G_64 : s.control_mode == CANON_EXACT_PATH ? G_61 : G_61_1;
    g[12] = -1;
    g[13] = s.spindle_mode[0] == CONSTANT_RPM ? G_97 : G_96;
    g[14] = s.ijk_distance_mode == MODE_ABSOLUTE ? G_90_1 : G_91_1;
    g[15] = s.lathe_diameter ? G_7 : G_8;
    g[16] = s.parameters[P_G92_APPLIED] != 0 && s.last_g0 == -1 ? G_92_3 : s.last_g92;
}

void active_m(const Setup &s, int *m)
{
    m[0] = s.sequence_number;
    m[1] = s.last_stop;
    m[2] = s.spindle_turning[0] == CANON_STOPPED ? 5 : s.spindle_turning[0] == CANON_CLOCKWISE ? 3 : 4;
    m[3] = s.last_toolchange;
    m[4] = s.mist ? 7 : s.flood ? -1 : 9;
    m[5] = s.flood ? 8 : -1;
    m[6] = s.feed_override ? (s.speed_override[0] ? 48 : 50) : (s.speed_override[0] ? 51 : 49);
    m[7] = s.adaptive_feed ? 52 : -1;
    m[8] = s.feed_hold ? 53 : -1;
    m[9] = -1;
}

void active_values(const Setup &s, double *v)
{
    v[0] = s.sequence_number;
    v[1] = s.feed_rate;
    v[2] = s.speed[0];
    v[3] = s.tolerance;
    v[4] = s.naivecam_tolerance;
}

void update_tag(Setup &s)
{
    if (!s.canon.wants_tags()) return;
    state_tag_t tag;
    fill_tag(s, &tag);
    s.canon.UPDATE_TAG(tag);
}

// Axes that the move brings to a machine coordinate.
static int machine_axes(const Setup &s)
{
    if (!s.stored_leg && s.block.g_modes[GM_MODAL_0] != G_53) return 0;
    int axes = 0;
    for (int i = 0; i < AXES; ++i) axes |= int(s.block.has_axis(i) || !s.block.any_axis()) << i;
    return axes;
}

int main_line(const Setup &s) { return s.call_level > 0 ? s.frames[0].line : s.sequence_number; }

void fill_tag(const Setup &s, state_tag_t *tag)
{
    int *f = tag->fields;
    f[GM_FIELD_LINE_NUMBER] = s.sequence_number;
    f[GM_FIELD_G_MODE_0] = s.last_g0;
    f[GM_FIELD_CUTTER_COMP] = s.comp_side == COMP_RIGHT ? G_42 : s.comp_side == COMP_LEFT ? G_41 : G_40;
    f[GM_FIELD_MOTION_MODE] = is_drill_cycle(s.block.motion) ? s.block.motion : s.motion_mode;
    f[GM_FIELD_PLANE] = plane_g(s.plane);
    f[GM_FIELD_M_MODES_4] = s.last_stop;
    f[GM_FIELD_ORIGIN] = system_g(s.origin_index);
    f[GM_FIELD_TOOLCHANGE] = s.last_toolchange;
    f[GM_FIELD_MACHINE_AXES] = machine_axes(s);
    f[GM_FIELD_CALL_LEVEL] = s.call_level;
    f[GM_FIELD_MAIN_LINE] = main_line(s);
    unsigned flags = 0;
    auto flag = [&](int bit, bool on) { flags |= unsigned(on) << bit; };
    flag(GM_FLAG_UNITS, s.units == CANON_UNITS_INCHES);
    flag(GM_FLAG_DISTANCE_MODE, s.distance_mode == MODE_ABSOLUTE);
    flag(GM_FLAG_TOOL_OFFSETS_ON, offset_in_use(s));
    flag(GM_FLAG_RETRACT_OLDZ, s.retract_mode == OLD_Z);
    flag(GM_FLAG_BLEND, s.control_mode == CANON_CONTINUOUS);
    flag(GM_FLAG_EXACT_STOP, s.control_mode == CANON_EXACT_STOP);
    flag(GM_FLAG_FEED_INVERSE_TIME, s.feed_mode == INVERSE_TIME);
    flag(GM_FLAG_FEED_UPM, s.feed_mode == UNITS_PER_MINUTE);
    flag(GM_FLAG_CSS_MODE, s.spindle_mode[0] == CONSTANT_SURFACE);
    flag(GM_FLAG_IJK_ABS, s.ijk_distance_mode == MODE_ABSOLUTE);
    flag(GM_FLAG_DIAMETER_MODE, s.lathe_diameter);
    flag(GM_FLAG_G92_IS_APPLIED, s.parameters[P_G92_APPLIED] != 0);
    flag(GM_FLAG_SPINDLE_ON, s.spindle_turning[0] != CANON_STOPPED);
    flag(GM_FLAG_SPINDLE_CW, s.spindle_turning[0] == CANON_CLOCKWISE);
    flag(GM_FLAG_MIST, s.mist);
    flag(GM_FLAG_FLOOD, s.flood);
    flag(GM_FLAG_FEED_OVERRIDE, s.feed_override);
    flag(GM_FLAG_SPEED_OVERRIDE, s.speed_override[0]);
    flag(GM_FLAG_ADAPTIVE_FEED, s.adaptive_feed);
    flag(GM_FLAG_FEED_HOLD, s.feed_hold);
    flag(GM_FLAG_RESTORABLE, s.call_level == 0 && s.remap_level == 0);
    flag(GM_FLAG_IN_REMAP, s.remap_level > 0);
    flag(GM_FLAG_IN_SUB, s.call_level > 0);
    flag(GM_FLAG_EXTERNAL_FILE, s.source > 0);
    flag(GM_FLAG_IS_CIRCLE, s.motion_mode == G_2 || s.motion_mode == G_3);
    tag->packed_flags = flags;
    float *v = tag->fields_float;
    v[GM_FIELD_FLOAT_LINE_NUMBER] = float(s.sequence_number);
    v[GM_FIELD_FLOAT_FEED] = float(s.feed_rate);
    v[GM_FIELD_FLOAT_SPEED] = float(s.speed[0]);
    v[GM_FIELD_FLOAT_PATH_TOLERANCE] = float(s.tolerance);
    v[GM_FIELD_FLOAT_NAIVE_CAM_TOLERANCE] = float(s.naivecam_tolerance);
    for (int i = GM_FIELD_FLOAT_ARC_RADIUS; i < GM_FIELD_FLOAT_MAX_FIELDS; ++i) v[i] = s.path_fields[i];
    const std::string &file = s.source >= 0 ? s.sources[size_t(s.source)]->path() : s.main_file;
    const size_t n = file.size() < sizeof tag->filename ? file.size() : sizeof tag->filename - 1;
    memcpy(tag->filename, file.data(), n);
    tag->filename[n] = 0;
}

bool modes_of_tag(const state_tag_t &tag, int *g, int *m, double *v)
{
    auto on = [&](int bit) { return state_tag_flag(&tag, bit) != 0; };
    const int *f = tag.fields;
    if (f[GM_FIELD_PLANE] == 0) return false; // never filled in
    g[0] = m[0] = f[GM_FIELD_LINE_NUMBER];
    g[1] = f[GM_FIELD_MOTION_MODE];
    g[2] = f[GM_FIELD_G_MODE_0];
    g[3] = f[GM_FIELD_PLANE];
    g[4] = f[GM_FIELD_CUTTER_COMP];
    g[5] = on(GM_FLAG_UNITS) ? G_20 : G_21;
    g[6] = on(GM_FLAG_DISTANCE_MODE) ? G_90 : G_91;
    g[7] = on(GM_FLAG_FEED_INVERSE_TIME) ? G_93 : on(GM_FLAG_FEED_UPM) ? G_94 : G_95;
    g[8] = f[GM_FIELD_ORIGIN];
    g[9] = on(GM_FLAG_TOOL_OFFSETS_ON) ? G_43 : G_49;
    g[10] = on(GM_FLAG_RETRACT_OLDZ) ? G_98 : G_99;
    g[11] = on(GM_FLAG_BLEND) ? G_64 : on(GM_FLAG_EXACT_STOP) ? G_61_1 : G_61;
    g[12] = -1;
    g[13] = on(GM_FLAG_CSS_MODE) ? G_96 : G_97;
    g[14] = on(GM_FLAG_IJK_ABS) ? G_90_1 : G_91_1;
    g[15] = on(GM_FLAG_DIAMETER_MODE) ? G_7 : G_8;
    g[16] = on(GM_FLAG_G92_IS_APPLIED) ? G_92_3 : G_92_2;
    m[1] = f[GM_FIELD_M_MODES_4];
    m[2] = !on(GM_FLAG_SPINDLE_ON) ? 5 : on(GM_FLAG_SPINDLE_CW) ? 3 : 4;
    m[3] = f[GM_FIELD_TOOLCHANGE];
    m[4] = on(GM_FLAG_MIST) ? 7 : on(GM_FLAG_FLOOD) ? -1 : 9;
    m[5] = on(GM_FLAG_FLOOD) ? 8 : -1;
    m[6] = on(GM_FLAG_FEED_OVERRIDE) ? (on(GM_FLAG_SPEED_OVERRIDE) ? 48 : 50)
                                     : (on(GM_FLAG_SPEED_OVERRIDE) ? 51 : 49);
    m[7] = on(GM_FLAG_ADAPTIVE_FEED) ? 52 : -1;
    m[8] = on(GM_FLAG_FEED_HOLD) ? 53 : -1;
    m[9] = -1;
    v[0] = tag.fields_float[GM_FIELD_FLOAT_LINE_NUMBER];
    v[1] = tag.fields_float[GM_FIELD_FLOAT_FEED];
    v[2] = tag.fields_float[GM_FIELD_FLOAT_SPEED];
    v[3] = tag.fields_float[GM_FIELD_FLOAT_PATH_TOLERANCE];
    v[4] = tag.fields_float[GM_FIELD_FLOAT_NAIVE_CAM_TOLERANCE];
    return true;
}

} // namespace ngc
