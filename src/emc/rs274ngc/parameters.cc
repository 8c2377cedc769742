/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * parameters.cc - numbered parameters, and the settings of a block.
 *
 * In:     s.parameters, the machine state behind the numbers that mirror it
 * Out:    values
 * Thread: [task]
 * Source: G-code sheet, section 4
 */
#include "stages.hh"

namespace ngc
{

bool parameter_read_only(int index)
{
    return (index >= P_ABS_POSITION && index < P_ABS_POSITION + AXES) ||
           (index >= P_TOOL_NUMBER && index <= P_TOOL_ORIENTATION) ||
           (index >= P_POSITION && index < P_POSITION + AXES);
}

// Numbers below mirror the state; they are computed when asked for.
double parameter_now(const Setup &s, int index)
{
    if (index < P_ABS_POSITION) return s.parameters[size_t(index)];
    if (index >= P_POSITION && index < P_POSITION + AXES) return axis(s.current, index - P_POSITION);
    if (index < P_ABS_POSITION + AXES) return axis(absolute_position(s), index - P_ABS_POSITION);
    if (index >= P_TOOL_OFFSET_USED && index < P_TOOL_OFFSET_USED + AXES) {
        int i = index - P_TOOL_OFFSET_USED;
        return s.to_machine(i, axis(s.tool_offset, i));
    }
    if (index == P_TC_FAULT) return s.canon.GET_EXTERNAL_TC_FAULT();
    if (index == P_TC_REASON) return s.canon.GET_EXTERNAL_TC_REASON();
    return s.parameters[size_t(index)];
}

int parameter_value(Setup &s, int index, double *value)
{
    CHECK(index < 1 || index > MAX_PARAMETER, "Parameter number out of range");
    CHECK(index >= P_POSITION && index < P_POSITION + AXES && s.comp_on(),
          "Cannot read current position with cutter radius compensation on");
    *value = parameter_now(s, index);
    return INTERP_OK;
}

int store_settings(Setup &s)
{
    const Block &b = s.block;
    for (int i = 0; i < b.settings; ++i) s.parameters[size_t(b.setting[i].index)] = b.setting[i].value;
    for (int i = 0; i < b.named_settings; ++i) {
        std::string_view name = b.named_setting[i].name;
        NamedParameter *p = find_named(s, name);
        CHECK(!p, "Internal error: Could not assign #<%.*s>", int(name.size()), name.data());
        CHECK(p->read_only, "Cannot assign to read-only parameter #<%.*s>", int(name.size()), name.data());
        p->value = b.named_setting[i].value;
        if (s.logs(4, LOG_NAMED)) s.log("#<%.*s> = %g", int(name.size()), name.data(), p->value);
    }
    return INTERP_OK;
}

} // namespace ngc
