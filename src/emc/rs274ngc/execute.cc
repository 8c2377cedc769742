/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * execute.cc - the steps of a block, in their order.
 *
 * In:     s.block, read and checked
 * Out:    canonical calls, new state
 * Thread: [task]
 * Source: G-code sheet, section 6; phases: remap sheet, section 4
 */
#include "remap.hh"
#include "stages.hh"

namespace ngc
{
namespace
{

int run_phase(Setup &s, int phase)
{
    const Block &b = s.block;
    switch (phase) {
    case PHASE_COMMENT:
        if (b.settings || b.named_settings) TRY(store_settings(s));
        if (b.comment) return execute_comment(s, std::string_view(b.comment, size_t(b.comment_length)));
        return INTERP_OK;
    case PHASE_SPINDLE_MODE: return convert_spindle_mode(s);
    case PHASE_FEED_MODE: return convert_feed_mode(s);
    case PHASE_F: return convert_feed_rate(s);
    case PHASE_S: return convert_speed(s);
    case PHASE_T: return convert_tool_select(s);
    case PHASE_M5: return convert_io(s, b.m_modes[MM_IO]);
    case PHASE_M6: return b.m_modes[MM_TOOL] == 6 ? convert_tool_change(s) : convert_tool_number(s);
    case PHASE_RETAIN_G43: return retain_g43(s);
    case PHASE_M7: return convert_spindle_codes(s, b.m_modes[MM_SPINDLE]);
    case PHASE_M8: return convert_coolant(s, b.m_modes[MM_COOLANT]);
    case PHASE_M9: return convert_override(s, b.m_modes[MM_OVERRIDE]);
    case PHASE_M10: return b.user_m >= 0 ? convert_user_m(s) : int(INTERP_OK);
    case PHASE_DWELL: enqueue_dwell(s, b['p']); return INTERP_OK;
    case PHASE_PLANE: return convert_plane(s, b.g_modes[GM_PLANE]);
    case PHASE_UNITS: return convert_units(s, b.g_modes[GM_UNITS]);
    case PHASE_LATHE: return convert_lathe(s, b.g_modes[GM_LATHE]);
    case PHASE_COMP: return convert_comp(s, b.g_modes[GM_COMP]);
    case PHASE_TOOL_LENGTH: return convert_tool_length(s, b.g_modes[GM_TOOL_LENGTH]);
    case PHASE_COORD_SYSTEM: return convert_coord_system(s, b.g_modes[GM_COORD_SYSTEM]);
    case PHASE_CONTROL: return convert_control_mode(s, b.g_modes[GM_CONTROL]);
    case PHASE_DISTANCE: return convert_distance(s, b.g_modes[GM_DISTANCE]);
    case PHASE_IJK: return convert_ijk(s, b.g_modes[GM_IJK]);
    case PHASE_RETRACT: return convert_retract(s, b.g_modes[GM_RETRACT]);
    case PHASE_GROUP0: return convert_group0(s, b.g_modes[GM_MODAL_0]);
    case PHASE_G92: return convert_g92(s, b.g_modes[GM_G92]);
    case PHASE_MOTION: return convert_motion(s, b.motion);
    case PHASE_STOP: return convert_stop(s, b.m_modes[MM_STOP]);
    }
    return INTERP_OK;
}

} // namespace

int execute_block(Setup &s)
{
    Block &b = s.block;
    if (s.logs(2, LOG_LINES)) s.log("%s", s.raw);
    if (b.o_type != O_NONE) return execute_oword(s);
    s.last_g0 = b.g_modes[GM_MODAL_0];
    s.last_g92 = b.g_modes[GM_G92];
    s.last_stop = b.m_modes[MM_STOP];
    s.last_toolchange = b.m_modes[MM_TOOL];
    if (s.retain_g43 && b.m_modes[MM_TOOL] == 6) b.phases |= phase_bit(PHASE_RETAIN_G43);
    uint32_t todo = b.phases & ~(phase_bit(b.phase + 1) - 1);
    while (todo) {
        const int phase = __builtin_ctz(todo);
        todo &= todo - 1;
        b.phase = phase;
        if (__builtin_expect(s.remaps != nullptr, 0)) {
            if (const Remap *remap = remap_of_phase(s, phase)) {
                TRY(start_remap(s, *remap));
                return INTERP_OK; // the block goes on when the handler has returned
            }
        }
        TRY(run_phase(s, phase));
    }
    if (__builtin_expect(s.probe_flag || s.input_flag || s.toolchange_flag, 0)) return INTERP_EXECUTE_FINISH;
    return INTERP_OK;
}

} // namespace ngc
