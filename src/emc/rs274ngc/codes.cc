/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * codes.cc - modal groups of all codes.
 *
 * Source: G-code sheet, section 8
 */
#include "codes.hh"

#include <cstdio>

namespace ngc
{
namespace
{

struct GroupTable {
    int8_t g[1000];
    int8_t m[200];

    constexpr GroupTable() : g(), m()
    {
        for (auto &v : g) v = -1;
        for (auto &v : m) v = -1;
        const int group0[] = {G_4, G_10, G_28, G_28_1, G_30, G_30_1, G_52, G_53, G_92, G_5_3, G_6_3};
        for (int c : group0) g[c] = GM_MODAL_0;
        const int motion[] = {G_0,    G_1,    G_2,    G_3,    G_5,    G_5_1,  G_5_2,  G_6,    G_6_1,  G_6_2,
                              G_33,   G_33_1, G_38_2, G_38_3, G_38_4, G_38_5, G_70,   G_71,   G_71_1, G_71_2,
                              G_72,   G_72_1, G_72_2, G_73,   G_74,   G_76,   G_80,   G_81,   G_82,   G_83,
                              G_84,   G_85,   G_86,   G_87,   G_88,   G_89};
        for (int c : motion) g[c] = GM_MOTION;
        const int plane[] = {G_17, G_18, G_19, G_17_1, G_18_1, G_19_1};
        for (int c : plane) g[c] = GM_PLANE;
        g[G_90] = g[G_91] = GM_DISTANCE;
        g[G_90_1] = g[G_91_1] = GM_IJK;
        g[G_93] = g[G_94] = g[G_95] = GM_FEED;
        g[G_20] = g[G_21] = GM_UNITS;
        g[G_40] = g[G_41] = g[G_41_1] = g[G_42] = g[G_42_1] = GM_COMP;
        g[G_43] = g[G_43_1] = g[G_43_2] = g[G_49] = GM_TOOL_LENGTH;
        g[G_98] = g[G_99] = GM_RETRACT;
        const int system[] = {G_54, G_55, G_56, G_57, G_58, G_59, G_59_1, G_59_2, G_59_3};
        for (int c : system) g[c] = GM_COORD_SYSTEM;
        g[G_61] = g[G_61_1] = g[G_64] = GM_CONTROL;
        g[G_96] = g[G_97] = GM_SPINDLE_MODE;
        g[G_7] = g[G_8] = GM_LATHE;
        g[G_92_1] = g[G_92_2] = g[G_92_3] = GM_G92;

        const int stop[] = {0, 1, 2, 30, 60, 99};
        for (int c : stop) m[c] = MM_STOP;
        for (int c = 62; c <= 68; ++c) m[c] = MM_IO;
        m[6] = m[61] = MM_TOOL;
        const int spindle[] = {3, 4, 5, 19, 70, 71, 72, 73};
        for (int c : spindle) m[c] = MM_SPINDLE;
        m[7] = m[8] = m[9] = MM_COOLANT;
        for (int c = 48; c <= 53; ++c) m[c] = MM_OVERRIDE;
        for (int c = 100; c <= 199; ++c) m[c] = MM_USER;
    }
};

constexpr GroupTable table;

} // namespace

int g_group(int code) { return code >= 0 && code < 1000 ? table.g[code] : -1; }
int m_group(int code) { return code >= 0 && code < 200 ? table.m[code] : -1; }

const char *g_name(int code, char (&buf)[16])
{
    if (code % 10)
        snprintf(buf, sizeof buf, "G%d.%d", code / 10, code % 10);
    else
        snprintf(buf, sizeof buf, "G%d", code / 10);
    return buf;
}

} // namespace ngc
