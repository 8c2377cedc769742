/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * codes.hh - the tables of the language: G and M codes, their modal groups, words.
 *
 * Data:   constant; G codes are numbered code * 10 (G5.1 is 51), as in the status arrays
 * Source: G-code sheet, section 8
 */
#ifndef KERF_CODES_HH
#define KERF_CODES_HH

#include <cstdint>

namespace ngc
{

enum GGroup {
    GM_MODAL_0 = 0,
    GM_MOTION = 1,
    GM_PLANE = 2,
    GM_DISTANCE = 3,
    GM_IJK = 4,
    GM_FEED = 5,
    GM_UNITS = 6,
    GM_COMP = 7,
    GM_TOOL_LENGTH = 8,
    GM_RETRACT = 10,
    GM_COORD_SYSTEM = 12,
    GM_CONTROL = 13,
    GM_SPINDLE_MODE = 14,
    GM_LATHE = 15,
    GM_G92 = 16,
    GM_GROUPS = 17
};

enum MGroup {
    MM_STOP = 4,
    MM_IO = 5,
    MM_TOOL = 6,
    MM_SPINDLE = 7,
    MM_COOLANT = 8,
    MM_OVERRIDE = 9,
    MM_USER = 10,
    MM_GROUPS = 11
};

enum GCode {
    G_0 = 0, G_1 = 10, G_2 = 20, G_3 = 30, G_4 = 40,
    G_5 = 50, G_5_1 = 51, G_5_2 = 52, G_5_3 = 53, G_6 = 60, G_6_1 = 61, G_6_2 = 62, G_6_3 = 63,
    G_7 = 70, G_8 = 80, G_10 = 100, G_17 = 170, G_17_1 = 171, G_18 = 180, G_18_1 = 181, G_19 = 190, G_19_1 = 191,
    G_20 = 200, G_21 = 210, G_28 = 280, G_28_1 = 281, G_30 = 300, G_30_1 = 301, G_33 = 330, G_33_1 = 331,
    G_38_2 = 382, G_38_3 = 383, G_38_4 = 384, G_38_5 = 385,
    G_40 = 400, G_41 = 410, G_41_1 = 411, G_42 = 420, G_42_1 = 421, G_43 = 430, G_43_1 = 431, G_43_2 = 432, G_49 = 490,
    G_52 = 520, G_53 = 530, G_54 = 540, G_55 = 550, G_56 = 560, G_57 = 570, G_58 = 580, G_59 = 590,
    G_59_1 = 591, G_59_2 = 592, G_59_3 = 593, G_61 = 610, G_61_1 = 611, G_64 = 640,
    G_70 = 700, G_71 = 710, G_71_1 = 711, G_71_2 = 712, G_72 = 720, G_72_1 = 721, G_72_2 = 722,
    G_73 = 730, G_74 = 740, G_76 = 760, G_80 = 800, G_81 = 810, G_82 = 820, G_83 = 830, G_84 = 840,
    G_85 = 850, G_86 = 860, G_87 = 870, G_88 = 880, G_89 = 890,
    G_90 = 900, G_90_1 = 901, G_91 = 910, G_91_1 = 911, G_92 = 920, G_92_1 = 921, G_92_2 = 922, G_92_3 = 923,
    G_93 = 930, G_94 = 940, G_95 = 950, G_96 = 960, G_97 = 970, G_98 = 980, G_99 = 990
};

/// Modal group of a G code (times ten, 0..999), -1 when there is no such code.
int g_group(int code);
/// Modal group of an M code (0..199), -1 when there is none.
int m_group(int code);

/// Drilling and boring cycles that move: G73 G74 G81..G89.
constexpr bool is_drill_cycle(int g) { return g == G_73 || g == G_74 || (g >= G_81 && g <= G_89); }
constexpr bool is_g7x_rough(int g) { return (g >= G_71 && g <= G_71_2) || (g >= G_72 && g <= G_72_2); }
constexpr bool is_g7x(int g) { return g == G_70 || is_g7x_rough(g); }
/// A G or M code as text: "G5.1", "M3".
const char *g_name(int code, char (&buf)[16]);

// Words of a block by letter: a..z are 0..25.
enum : int { W_SPINDLE = 26 /* $ */, W_RADIUS = 27 /* @ */, W_ANGLE = 28 /* ^ */, WORDS = 29 };
constexpr int word_index(char c)
{
    return c == '$' ? W_SPINDLE : c == '@' ? W_RADIUS : c == '^' ? W_ANGLE : c - 'a';
}
constexpr uint32_t word_bit(char c) { return 1u << word_index(c); }
constexpr uint32_t word_bits(const char *letters)
{
    uint32_t bits = 0;
    for (; *letters; ++letters) bits |= word_bit(*letters);
    return bits;
}
constexpr uint32_t AXIS_WORDS = word_bits("xyzabcuvw");
constexpr uint32_t POLAR_WORDS = word_bits("@^");
constexpr uint32_t IJK_WORDS = word_bits("ijk");
/// Axes in the order of poses, masks and parameters.
constexpr char AXIS_LETTERS[] = "xyzabcuvw";
enum { AXES = 9 };

} // namespace ngc

#endif
