/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * stop.cc - M0 M1 M60, M2 M30, M99 in the main program.
 *
 * Thread: [task]
 * Source: M-codes sheet, section 4; canonical sheet, section 1.3
 */
#include "stages.hh"

namespace ngc
{
namespace
{

// After a program that began with % the rest of the file is read for its end.
void look_for_percent(Setup &s)
{
    if (!s.percent_flag || s.sources.empty() || s.mdi) return;
    LineSource &file = *s.sources[0];
    if (s.source != 0) file.seek(s.frames[0].offset);
    std::string_view line;
    bool newline;
    const int number = file.line_number;
    while (file.next(line, newline)) {
        size_t first = line.find_first_not_of(" \t\r");
        if (first != line.npos && line[first] == '%' && line.find_first_not_of(" \t\r", first + 1) == line.npos) {
            file.line_number = number;
            return;
        }
    }
    file.line_number = number;
    s.canon.COMMENT("interpreter: percent sign missing from end of file");
}

int program_end(Setup &s, int m)
{
    TRY(finish_comp(s));
    nurbs_forget(s);
    const EmcPose absolute = absolute_position(s);
    if (!s.disable_auto_g54) {
        s.origin_index = 1;
        s.parameters[P_COORD_SYSTEM] = 1;
        for (int i = 0; i < AXES; ++i)
            axis(s.g5x, i) = s.from_machine(i, s.parameters[size_t(P_G5X_BASE + 20 + i)]);
        s.rotation = s.parameters[P_G5X_BASE + 20 + AXES];
        s.current = from_absolute(s, absolute);
        s.canon.SET_G5X_OFFSET(1, s.g5x);
        s.canon.SET_XY_ROTATION(s.rotation);
    }
    if (s.plane != CANON_PLANE_XY) {
        s.canon.SELECT_PLANE(CANON_PLANE_XY);
        s.plane = CANON_PLANE_XY;
    }
    s.distance_mode = MODE_ABSOLUTE;
    s.feed_mode = UNITS_PER_MINUTE;
    s.canon.SET_FEED_MODE(0, 0);
    s.feed_rate = 0;
    s.canon.SET_FEED_RATE(0);
    if (!s.feed_override) {
        s.canon.ENABLE_FEED_OVERRIDE();
        s.feed_override = true;
    }
    s.comp_side = COMP_OFF;
    s.comp_first_move = true;
    s.cycle_il_flag = false;
    for (int i = 0; i < s.num_spindles; ++i) {
        s.speed_override[i] = true;
        s.canon.STOP_SPINDLE_TURNING(i);
        s.canon.SET_SPINDLE_MODE(i, 0);
        s.spindle_turning[i] = CANON_STOPPED;
        s.spindle_mode[i] = CONSTANT_RPM;
    }
    s.motion_mode = G_1;
    if (s.mist) {
        s.canon.MIST_OFF();
        s.mist = false;
    }
    if (s.flood) {
        s.canon.FLOOD_OFF();
        s.flood = false;
    }
    if (s.disable_g92_persistence) {
        for (int i = 0; i < AXES; ++i) {
            axis(s.current, i) += axis(s.g92, i);
            axis(s.g92, i) = 0;
            s.parameters[size_t(P_G92 + i)] = 0;
        }
        s.parameters[P_G92_APPLIED] = 0;
        s.canon.SET_G92_OFFSET(s.g92);
    }
    if (m == 30) s.canon.PALLET_SHUTTLE();
    s.canon.PROGRAM_END();
    look_for_percent(s);
    unwind(s);
    clear_labels(s);
    return INTERP_EXIT;
}

} // namespace

int convert_stop(Setup &s, int m)
{
    switch (m) {
    case 0:
        TRY(finish_comp(s));
        s.canon.PROGRAM_STOP();
        return INTERP_OK;
    case 1:
        TRY(finish_comp(s));
        s.canon.OPTIONAL_PROGRAM_STOP();
        return INTERP_OK;
    case 60:
        TRY(finish_comp(s));
        s.canon.PALLET_SHUTTLE();
        s.canon.PROGRAM_STOP();
        return INTERP_OK;
    case 99:
        if (s.loop_on_m99 && s.source == 0 && !s.mdi) {
            TRY(finish_comp(s));
            s.canon.FINISH();
            s.sources[0]->seek(0);
            s.sources[0]->line_number = 0;
            return INTERP_EXECUTE_FINISH;
        }
        return program_end(s, 2);
    default: // 2, 30
        return program_end(s, m);
    }
}

} // namespace ngc
