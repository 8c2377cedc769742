/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * remap.hh - codes that the INI gives another meaning: [RS274NGC]REMAP.
 *
 * Source: remap sheet, sections 2 to 5; phases: section 4
 */
#ifndef KERF_REMAP_HH
#define KERF_REMAP_HH

#include <map>
#include <memory>
#include <string>

#include "setup.hh"

namespace ngc
{

/// Steps of a block, in order; a remapped code runs at the phase of its group.
enum Phase {
    PHASE_COMMENT = 1,
    PHASE_SPINDLE_MODE,
    PHASE_FEED_MODE,
    PHASE_F,
    PHASE_S,
    PHASE_T,
    PHASE_M5,
    PHASE_M6,
    PHASE_RETAIN_G43,
    PHASE_M7,
    PHASE_M8,
    PHASE_M9,
    PHASE_M10,
    PHASE_DWELL,
    PHASE_PLANE,
    PHASE_UNITS,
    PHASE_LATHE,
    PHASE_COMP,
    PHASE_TOOL_LENGTH,
    PHASE_COORD_SYSTEM,
    PHASE_CONTROL,
    PHASE_DISTANCE,
    PHASE_IJK,
    PHASE_RETRACT,
    PHASE_GROUP0,
    PHASE_G92,
    PHASE_MOTION,
    PHASE_STOP,
    PHASES
};

constexpr uint32_t phase_bit(int phase) { return 1u << phase; }

inline int phase_of_g_group(int group)
{
    static const uint8_t phases[GM_GROUPS] = {
        PHASE_GROUP0, PHASE_MOTION,      PHASE_PLANE,   PHASE_DISTANCE, PHASE_IJK, PHASE_FEED_MODE,
        PHASE_UNITS,  PHASE_COMP,        PHASE_TOOL_LENGTH, 0,          PHASE_RETRACT, 0,
        PHASE_COORD_SYSTEM, PHASE_CONTROL, PHASE_SPINDLE_MODE, PHASE_LATHE, PHASE_G92};
    return phases[group];
}

inline int phase_of_m_group(int group)
{
    switch (group) {
    case MM_STOP: return PHASE_STOP;
    case MM_IO: return PHASE_M5;
    case MM_TOOL: return PHASE_M6;
    case MM_SPINDLE: return PHASE_M7;
    case MM_COOLANT: return PHASE_M8;
    case MM_OVERRIDE: return PHASE_M9;
    default: return PHASE_M10;
    }
}

/// M codes that a REMAP line can take over; for others the built-in stays.
inline bool remappable_m(int m)
{
    switch (m) {
    case 0: case 1: case 6: case 7: case 8: case 9: case 60: case 61: case 62: case 63: case 64: case 65: case 66:
    case 67: case 68:
        return true;
    }
    return m >= 200 ? m <= 999 : m > 0 && m < 100 && m_group(m) < 0;
}

struct Remap {
    std::string name; ///< as written in the INI: "M400"
    std::string argspec;
    int modal_group = -1;
    std::string prolog, python, ngc, epilog; ///< empty: none
    int motion_code = -1;                    ///< G codes: times ten
    char letter = 0;                         ///< G M T S F
    int code = -1;                           ///< M: number; G: times ten
};

struct RemapTable {
    std::vector<std::unique_ptr<Remap>> all;
    std::map<int, const Remap *> by_g, by_m;
    const Remap *t = nullptr, *s = nullptr, *f = nullptr;

    const Remap *g(int code) const
    {
        auto i = by_g.find(code);
        return i == by_g.end() ? nullptr : i->second;
    }
    const Remap *m(int code) const
    {
        auto i = by_m.find(code);
        return i == by_m.end() ? nullptr : i->second;
    }
};

/// A block put aside while the handler of one of its codes runs.
struct RemapFrame {
    enum Stage : uint8_t { PROLOG, BODY, EPILOG, END };
    const Remap *remap;
    Block block;
    Stage stage = PROLOG;
    int call_level = 0; // of the handler
    int sequence_number = 0;
    char raw[256], text[264];
    int raw_length = 0;
    int64_t line_offset = 0;
    std::vector<std::pair<char, double>> words; // for Python handlers
};

/// The remap that takes this phase of s.block; nullptr: the built-in code runs.
const Remap *remap_of_phase(Setup &s, int phase);
/// Begins a handler; s.block is put aside until it has returned.
[[nodiscard]] int start_remap(Setup &s, const Remap &remap);
/// After the return from a remap's frame: takes the block up again.
[[nodiscard]] int finish_remap(Setup &s);
/// Goes on with the stages after a Python handler has ended. status: how it ended.
[[nodiscard]] int continue_remap(Setup &s, int status);
/// Drops blocks put aside.
void forget_remaps(Setup &s);

/// Reads the REMAP lines of the INI. INTERP_ERROR when one is wrong (messages are out).
[[nodiscard]] int load_remaps(Setup &s);
/// Runs text of a `;py,` comment at once.
[[nodiscard]] int run_python_line(Setup &s, const char *text);

} // namespace ngc

#endif
