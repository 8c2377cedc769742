/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * tools.cc - T, M6, M61, tool length offsets, tool data by G10.
 *
 * Units:  tool records in machine units
 * Thread: [task]
 * Source: M-codes sheet, section 3; G-codes sheet; tools sheet, sections 5 to 8
 */
#include <algorithm>

#include "stages.hh"

namespace ngc
{

int tool_index(const Setup &s, int toolno)
{
    if (toolno == -1) return -1;
    if (toolno == 0 && !s.random_toolchanger) return 0;
    for (int i = 1; i <= s.tools_last; ++i)
        if (s.tools[size_t(i)].toolno == toolno) return i;
    return s.tools[0].toolno == toolno ? 0 : -1;
}

void load_tool_table(Setup &s)
{
    const int end = std::min(s.canon.GET_EXTERNAL_TOOL_TABLE_LAST() + 1, int(CANON_POCKETS_MAX));
    for (int i = end; i <= s.tools_last; ++i) s.tools[size_t(i)] = tooldata_entry_init();
    s.tools_last = 0;
    for (int i = 0; i < end; ++i) {
        s.tools[size_t(i)] = s.canon.GET_EXTERNAL_TOOL_TABLE(i);
        if (s.tools[size_t(i)].toolno != -1) s.tools_last = i;
    }
    set_tool_parameters(s);
}

void set_tool_parameters(Setup &s)
{
    const CANON_TOOL_TABLE &t = s.tools[0];
    s.parameters[P_TOOL_NUMBER] = s.random_toolchanger ? t.toolno : std::max(t.toolno, 0);
    for (int i = 0; i < AXES; ++i) s.parameters[size_t(P_TOOL_OFFSET + i)] = axis(t.offset, i);
    s.parameters[P_TOOL_DIAMETER] = t.diameter;
    s.parameters[P_TOOL_FRONT_ANGLE] = t.frontangle;
    s.parameters[P_TOOL_BACK_ANGLE] = t.backangle;
    s.parameters[P_TOOL_ORIENTATION] = t.orientation;
}

namespace
{

int find_tool(Setup &s, int toolno, int *idx)
{
    *idx = tool_index(s, toolno);
    if (*idx >= 0) return INTERP_OK;
    FAIL("Requested tool %d not found in the tool table", toolno);
}

} // namespace

int convert_tool_select(Setup &s)
{
    const int toolno = int(s.block['t']);
    int idx;
    TRY(find_tool(s, toolno, &idx));
    s.selected_pocket = idx;
    s.selected_tool = toolno;
    s.canon.SELECT_TOOL(toolno);
    return INTERP_OK;
}

int convert_tool_change(Setup &s)
{
    CHECK(s.selected_pocket < 0, "Need tool prepared -Txx- for toolchange");
    CHECK(s.comp_on(), "Cannot change tools with cutter radius compensation on");
    if (!s.tool_change_with_spindle_on)
        for (int i = 0; i < s.num_spindles; ++i) {
            s.canon.STOP_SPINDLE_TURNING(i);
            s.spindle_turning[i] = CANON_STOPPED;
        }
    if (s.tool_change_quill_up) {
        EmcPose top = absolute_position(s);
        top.tran.z = 0;
        EmcPose end = s.current;
        end.tran.z = from_absolute(s, top).tran.z;
        s.canon.COMMENT("AXIS,hide");
        traverse(s, -1, end);
        s.canon.COMMENT("AXIS,show");
    }
    if (s.tool_change_at_g30) {
        EmcPose home{};
        for (int i = 0; i < AXES; ++i) axis(home, i) = s.from_machine(i, s.parameters[size_t(P_G30 + i)]);
        const EmcPose end = from_absolute(s, home);
        s.canon.COMMENT("AXIS,hide");
        for (int n = 0; n < 3; ++n) {
            const int ax = AX_A + n;
            if (s.indexer_joint[n] < 0 || axis(end, ax) == axis(s.current, ax)) continue;
            EmcPose alone = s.current;
            axis(alone, ax) = axis(end, ax);
            move_indexer(s, -1, n, alone);
        }
        traverse(s, -1, end);
        s.canon.COMMENT("AXIS,show");
    }
    s.canon.CHANGE_TOOL();
    s.current_pocket = s.selected_pocket;
    s.toolchange_flag = true;
    return INTERP_OK;
}

int convert_tool_number(Setup &s)
{
    const Block &b = s.block;
    const int toolno = b.has('q') ? saturated(rint(b['q'])) : -1;
    CHECK(toolno < 0, "Need non-negative Q-word to specify tool number with M61");
    int idx;
    TRY(find_tool(s, toolno, &idx));
    s.current_pocket = idx;
    s.toolchange_flag = true;
    s.canon.CHANGE_TOOL_NUMBER(idx);
    set_tool_parameters(s);
    return INTERP_OK;
}

namespace
{

void use_tool_offset(Setup &s, const EmcPose &offset)
{
    const EmcPose absolute = absolute_position(s);
    s.tool_offset = offset;
    s.current = from_absolute(s, absolute);
    s.canon.USE_TOOL_LENGTH_OFFSET(offset);
}

EmcPose tool_record_offset(const Setup &s, int idx)
{
    EmcPose p{};
    for (int i = 0; i < AXES; ++i) axis(p, i) = s.from_machine(i, axis(s.tools[size_t(idx)].offset, i));
    return p;
}

bool is_zero(const EmcPose &p)
{
    for (int i = 0; i < AXES; ++i)
        if (axis(p, i) != 0) return false;
    return true;
}

} // namespace

int convert_tool_length(Setup &s, int g)
{
    const Block &b = s.block;
    CHECK(s.comp_on(), "Cannot change tool offset with cutter radius compensation on");
    EmcPose offset{};
    s.g43_with_zero_offset = false;
    switch (g) {
    case G_49:
        break;
    case G_43: {
        int idx = s.toolchange_flag ? s.current_pocket : 0;
        if (b.has('h')) {
            TRY(find_tool(s, int(b['h']), &idx));
            if (s.random_toolchanger && idx == 0) idx = s.current_pocket;
        }
        offset = tool_record_offset(s, idx);
        s.g43_with_zero_offset = is_zero(offset);
        break;
    }
    case G_43_1:
        offset = s.tool_offset;
        for (int i = 0; i < AXES; ++i)
            if (b.has_axis(i)) axis(offset, i) = b.axis_word(i);
        break;
    case G_43_2: {
        CHECK(b.has('h') && b.any_axis(), "G43.2: Can not have both H and axis words");
        CHECK(!b.has('h') && !b.any_axis(), "G43.2: No axes specified and H word missing");
        EmcPose more{};
        if (b.has('h')) {
            int idx;
            TRY(find_tool(s, int(b['h']), &idx));
            more = tool_record_offset(s, idx);
        } else {
            for (int i = 0; i < AXES; ++i)
                if (b.has_axis(i)) axis(more, i) = b.axis_word(i);
        }
        for (int i = 0; i < AXES; ++i) axis(offset, i) = axis(s.tool_offset, i) + axis(more, i);
        break;
    }
    }
    use_tool_offset(s, offset);
    return INTERP_OK;
}

int retain_g43(Setup &s)
{
    int g[ACTIVE_G_CODES];
    active_g(s, g);
    if (g[9] != G_43 || s.selected_pocket < 0) return INTERP_OK;
    if (s.selected_pocket > 0) {
        const EmcPose offset = tool_record_offset(s, s.toolchange_flag ? s.current_pocket : 0);
        use_tool_offset(s, offset);
        s.g43_with_zero_offset = is_zero(offset);
    } else {
        use_tool_offset(s, EmcPose{});
    }
    return INTERP_OK;
}

namespace
{

// L10: so that the current position reads the given values with this tool in use.
// L11: the same in G59.3, without G92.
EmcPose offset_by_position(const Setup &s, const Block &b, const EmcPose &old, bool fixture)
{
    EmcPose origin = s.g5x, g92 = s.g92;
    double rotation = s.rotation;
    if (fixture) {
        const int base = P_G5X_BASE + 20 * 9;
        for (int i = 0; i < AXES; ++i) axis(origin, i) = s.from_machine(i, s.parameters[size_t(base + i)]);
        rotation = s.parameters[size_t(base + AXES)];
        g92 = EmcPose{};
    }
    EmcPose here = absolute_position(s); // of the controlled point, without tool
    EmcPose result = old;
    for (int i = 0; i < AXES; ++i) axis(here, i) -= axis(origin, i);
    rotate(&here.tran.x, &here.tran.y, -rotation);
    rotate(&result.tran.x, &result.tran.y, -rotation);
    for (int i = 0; i < AXES; ++i)
        if (b.has_axis(i)) axis(result, i) = axis(here, i) - axis(g92, i) - b.axis_word(i);
    rotate(&result.tran.x, &result.tran.y, rotation);
    return result;
}

} // namespace

int convert_tool_data(Setup &s)
{
    const Block &b = s.block;
    const int l = int(b['l']);
    if (l == 0) {
        const int loaded = s.tools[0].toolno;
        CHECK(loaded > 0, "G10 L0 not allowed with loaded tool <%d>\n", loaded);
        s.canon.RELOAD_TOOLDATA();
        s.toolchange_flag = true;
        return INTERP_OK;
    }
    const int toolno = saturated(floor(b['p'] + 0.5));
    int idx;
    TRY(find_tool(s, toolno, &idx));
    CHECK(!b.any_axis() && !(b.present & word_bits("rijq")), "G10 L1 without offsets has no effect");
    CANON_TOOL_TABLE &t = s.tools[size_t(idx)];
    EmcPose offset = tool_record_offset(s, idx);
    if (l == 1) {
        for (int i = 0; i < AXES; ++i)
            if (b.has_axis(i)) axis(offset, i) = b.axis_word(i);
    } else {
        offset = offset_by_position(s, b, offset, l == 11);
    }
    for (int i = 0; i < AXES; ++i) {
        const bool rotated = l != 1 && i <= AX_Y && (b.has('x') || b.has('y'));
        if (b.has_axis(i) || rotated) axis(t.offset, i) = s.to_machine(i, axis(offset, i));
    }
    if (b.has('r')) t.diameter = s.to_machine_length(b['r']) * 2;
    if (b.has('i')) t.frontangle = b['i'];
    if (b.has('j')) t.backangle = b['j'];
    if (b.has('q') && b['q'] != -1) {
        const double q = b['q'], whole = trunc(q + 0.5);
        CHECK(q < 0 || fabs(q - whole) > TOLERANCE_INT, "Q number in G10 is not an integer");
        CHECK(whole > 9, "Invalid tool orientation");
        t.orientation = int(whole);
    }
    s.canon.SET_TOOL_TABLE_ENTRY(idx, toolno, t.offset, t.diameter, t.frontangle, t.backangle, t.orientation);
    if (idx != 0 && idx == s.current_pocket && !s.random_toolchanger) {
        CANON_TOOL_TABLE &loaded = s.tools[0];
        const int pocket = loaded.pocketno;
        loaded = t;
        loaded.pocketno = pocket;
        s.canon.SET_TOOL_TABLE_ENTRY(0, toolno, t.offset, t.diameter, t.frontangle, t.backangle, t.orientation);
    }
    set_tool_parameters(s);
    return INTERP_OK;
}

} // namespace ngc
