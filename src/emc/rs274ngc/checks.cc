/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * checks.cc - words and codes of a block must fit together.
 *
 * In:     s.block with its motion
 * Out:    INTERP_OK, or the fault
 * Thread: [task]
 * Source: G-code sheet, section 6; G-codes sheet, "Words vs codes"; errors sheet, section 4
 */
#include <initializer_list>

#include "remap.hh"
#include "stages.hh"

namespace ngc
{
namespace
{

bool is_one_of(int code, std::initializer_list<int> codes)
{
    for (int c : codes)
        if (c == code) return true;
    return false;
}

int check_g10(Setup &s, const Block &b)
{
    const int l = b.has('l') ? int(b['l']) : -1;
    CHECK(!is_one_of(l, {0, 1, 2, 10, 11, 20}), "Line with G10 does not have L0, L1, L10, L11, L2, or L20");
    if (l == 0) return INTERP_OK;
    const double p = b.value('p', -1);
    const double whole = floor(p + 0.5);
    CHECK(p - whole > TOLERANCE_INT, "P value not an integer with G10");
    if (l == 2 || l == 20)
        CHECK(whole < 0 || whole > 9, "P value out of range (0-9) with G10 L%d", l);
    else
        CHECK(whole < 1, "P value out of range with G10 L%d", l);
    return INTERP_OK;
}

int check_group0(Setup &s, const Block &b)
{
    switch (b.g_modes[GM_MODAL_0]) {
    case G_4:
        CHECK(b.value('p', -1) == -1, "Dwell time missing with g4");
        CHECK(b.motion == G_2 || b.motion == G_3, "G4 not allowed with G2 or G3 because they both use P");
        break;
    case G_10:
        return check_g10(s, b);
    case G_5_3:
        CHECK(b.g_modes[GM_MOTION] != -1 && b.g_modes[GM_MOTION] != G_5_2,
              "Between G5.2 and G5.3 codes, only additional G5.2 codes are allowed.");
        break;
    case G_53:
        CHECK(b.motion != G_0 && b.motion != G_1, "Must use g0 or g1 with g53");
        CHECK(b.g_modes[GM_DISTANCE] == G_91 ||
                  (b.g_modes[GM_DISTANCE] != G_90 && s.distance_mode == MODE_INCREMENTAL),
              "Cannot use g53 incremental");
        break;
    }
    return INTERP_OK;
}

int check_turns(Setup &s, const Block &b)
{
    if (!b.has('p') || !is_one_of(b.motion, {G_2, G_3})) return INTERP_OK;
    const double whole = rint(b['p']);
    CHECK(fabs(b['p'] - whole) > 0.001, "P value not an integer with M19 G2 or G3");
    CHECK(whole < 1, "P value should be 1 or greater with G2 or G3");
    return INTERP_OK;
}

// The unused-word checks, in the order of the sheet.
int check_words(Setup &s, const Block &b)
{
    const int motion = b.motion;
    const int comp = b.g_modes[GM_COMP];
    const int g0 = b.g_modes[GM_MODAL_0];
    const int mode96 = b.g_modes[GM_SPINDLE_MODE];
    const int io = b.m_modes[MM_IO];
    const int over = b.m_modes[MM_OVERRIDE];
    const bool m19 = b.m_modes[MM_SPINDLE] == 19;
    const bool cycle = is_drill_cycle(motion);
    const bool comp_on = comp == G_41 || comp == G_41_1 || comp == G_42 || comp == G_42_1;
    const bool user = b.user_m >= 0;

    if (cycle) {
        CHECK(b.has('a'), "Cannot put an a in canned cycle");
        CHECK(b.has('b'), "Cannot put a b in canned cycle");
        CHECK(b.has('c'), "Cannot put a c in canned cycle");
    }
    if (b.has('d'))
        CHECK(!comp_on && !is_g7x(motion) && !is_one_of(motion, {G_73, G_83}) && mode96 != G_96,
              "D word with no G41, G41.1, G42, G42.1, G71, G71.1, G71.2 G73, G83 or G96 to use it");
    if (b.has('$'))
        CHECK(!b.has('s') && !is_one_of(b.m_modes[MM_SPINDLE], {3, 4, 5, 19}) && over != 51 &&
                  !is_one_of(motion, {G_33, G_33_1, G_76}) && b.g_modes[GM_FEED] != G_95 && mode96 == -1,
              "$ (spindle selection) word with no M3, M4, M5, M19, M51, G33, G33.1, G76, G95, G96 or G97 to use it");
    if (b.has('e'))
        CHECK(!is_one_of(motion, {G_70, G_76, G_33, G_33_1}) && !is_one_of(io, {66, 67, 68}),
              "E word with no G70, G76, M66, M67 or M68 to use it");
    if (b.has('h'))
        CHECK(b.g_modes[GM_TOOL_LENGTH] != G_43 && b.g_modes[GM_TOOL_LENGTH] != G_43_2 && motion != G_76,
              "H word with no G43 or G76 to use it");
    if (b.has('i'))
        CHECK(!is_one_of(motion, {G_2, G_3, G_5, G_5_1, G_6, G_6_1, G_33_1, G_76, G_87}) &&
                  !is_g7x_rough(motion) && g0 != G_10,
              "I word with no G2, G3, G5, G5.1, G6, G6.1, G10, G33.1, G76, or G87 to use it");
    if (b.has('j'))
        CHECK(!is_one_of(motion, {G_2, G_3, G_5, G_5_1, G_6, G_6_1, G_76, G_87}) && g0 != G_10,
              "J word with no G2, G3, G5, G5.1, G6, G6.1, G10, G76 or G87 to use it");
    if (b.has('k'))
        CHECK(!is_one_of(motion, {G_2, G_3, G_6_2, G_33, G_33_1, G_76, G_87}),
              "K word with no G2, G3, G6.2, G33, G33.1, G76, or G87 to use it");
    if (b.has('l'))
        CHECK(!is_one_of(motion, {G_5_2, G_6_2, G_73, G_76}) && !(motion >= G_81 && motion <= G_89) && !comp_on &&
                  g0 != G_10 && io != 66 && b.o_type != O_M98,
              "L word with no G10, cutter compensation, canned cycle, digital/analog input, M98 or NURBS code");
    if (b.has('p')) {
        CHECK(!is_one_of(motion, {G_2, G_3, G_5, G_5_2, G_6, G_6_2, G_70, G_74, G_76, G_82, G_84, G_86, G_88, G_89}) &&
                  g0 != G_4 && g0 != G_10 && b.g_modes[GM_CONTROL] != G_64 && !m19 &&
                  !is_one_of(over, {50, 51, 52, 53}) && !(io >= 62 && io <= 66) && b.o_type != O_M98 && !user,
              "P word with no G2 G3 G4 G10 G64 G5 G5.2 G6, G6.2, G76 G82 G86 G88 G89 or M50 M51 M52 M53 M62 M63 "
              "M64 M65 M66 M98 or user M code to use it");
        if (m19) {
            const double whole = rint(b['p']);
            CHECK(fabs(b['p'] - whole) > 0.001, "P value not an integer with M19 G2 or G3");
            CHECK(whole < 0 || whole > 2, "P value must be 0,1,or 2 with M19");
        }
        TRY(check_turns(s, b));
    }
    if (b.has('q') && b['q'] != -1)
        CHECK(!is_one_of(motion, {G_5, G_6, G_6_2, G_73, G_76, G_83}) && !is_g7x(motion) && g0 != G_10 &&
                  b.g_modes[GM_CONTROL] != G_64 && !m19 && !is_one_of(io, {66, 67, 68}) &&
                  b.m_modes[MM_TOOL] != 61 && !user,
              "Q word with no G5, G6, G10, G64, G73, G76, G83, M19, M66, M67, M68 or user M code that uses it");
    if (b.has('r')) {
        CHECK(!is_one_of(motion, {G_2, G_3, G_6_2, G_76}) && !cycle && !is_g7x_rough(motion) && comp != G_41_1 &&
                  comp != G_42_1 && b.g_modes[GM_CONTROL] != G_64 && g0 != G_10 && !m19,
              "R word with no g code that uses it");
        CHECK(m19 && (b['r'] < 0 || b['r'] > 360), "R value must be within 0..360 with M19");
        CHECK(m19 && b.g_modes[GM_CONTROL] == G_64,
              "R word is ambiguous on a line with both G64 and M19 - use separate lines");
    }
    CHECK(mode96 == G_96 && !b.has('s'), "S word missing with G96");
    if (motion == G_33 || motion == G_33_1) {
        CHECK(!b.has('k'), "K word missing with g33/g33.1");
        CHECK(b.has('f'), "F word used with a g33/g33.1");
    }
    if (motion == G_76) {
        CHECK(b.value('p', -1) == -1, "P word missing with G76");
        CHECK((b.present & IJK_WORDS) != IJK_WORDS, "I J or K words missing with G76");
    }
    return INTERP_OK;
}

} // namespace

int check_block(Setup &s)
{
    Block &b = s.block;
    TRY(check_group0(s, b));
    CHECK(b.m_count > 4, "Too many m codes on line");
    // Remapped codes define the meaning of their words themselves; an arc beside one still needs a turn.
    if (s.remaps) {
        for (int m : b.m_modes)
            if (m >= 0 && s.remaps->m(m)) return check_turns(s, b);
        if (b.motion >= 0 && s.remaps->g(b.motion)) return INTERP_OK;
    }
    // Most lines have nothing but axis words, F and a motion.
    constexpr uint32_t free_words = word_bits("xyzuvwfst");
    if (!(b.present & ~free_words) && b.motion <= G_3 && b.g_modes[GM_SPINDLE_MODE] != G_96) return INTERP_OK;
    return check_words(s, b);
}

} // namespace ngc
