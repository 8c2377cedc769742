/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * context.cc - M70 M72 M73 and the restore after an abort: modes saved and re-issued.
 *
 * Method: the differences to the saved codes are written as G-code lines and executed.
 * Thread: [task]
 * Source: M-codes sheet, sections 9 and 11
 */
#include "remap.hh"
#include "stages.hh"

namespace ngc
{
namespace
{

void append_code(std::string &line, char letter, int code)
{
    char buf[16];
    if (letter == 'G') {
        line += ' ';
        line += g_name(code, buf);
    } else {
        snprintf(buf, sizeof buf, " M%d", code);
        line += buf;
    }
}

struct Restore {
    std::string units;                // G20 or G21, empty when equal
    std::vector<std::string> lines;   // then these
};

// M codes whose saved value can be asked for again.
void m_codes_to_restore(const int *now, const int *then, std::vector<int> &codes)
{
    auto want = [&](int i, int none) {
        if (then[i] == now[i]) return;
        if (then[i] != -1) codes.push_back(then[i]);
        else if (none) fprintf(stderr, "warning: M code state %d cannot be restored\n", now[i]);
    };
    want(2, 0);
    if (then[4] != now[4] || then[5] != now[5]) {
        if (then[4] == 9) {
            codes.push_back(9);
        } else {
            if (then[4] != now[4] && then[4] != -1) codes.push_back(then[4]);
            if (then[5] != now[5] && then[5] != -1) codes.push_back(then[5]);
            if ((now[4] == 7 && then[4] == -1) || (now[5] == 8 && then[5] == -1))
                fprintf(stderr, "warning: coolant state cannot be restored\n");
        }
    }
    want(6, 0);
    want(7, 1);
    want(8, 1);
}

Restore plan(const Setup &s, const SavedModes &then, bool with_m)
{
    int g[ACTIVE_G_CODES], m[ACTIVE_M_CODES];
    active_g(s, g);
    active_m(s, m);
    Restore r;
    if (g[5] != then.g[5]) r.units = then.g[5] == G_20 ? "G20" : "G21";
    char buf[128];
    // M72 and M73 round, as documented.
    snprintf(buf, sizeof buf, with_m ? "F%.1f S%.0f" : "F%.9f S%.9f", then.settings[1], then.settings[2]);
    std::string line = buf;
    static const int order[] = {3, 4, 6, 7, 8, 9, 10, 11, 13, 14, 15, 16};
    for (int i : order) {
        if (i == 11) {
            if (then.g[11] != G_64 && then.g[11] != g[11]) append_code(line, 'G', then.g[11]);
            continue;
        }
        if (then.g[i] == g[i]) continue;
        if (then.g[i] == -1) {
            fprintf(stderr, "warning: G92 state cannot be restored\n");
            continue;
        }
        append_code(line, 'G', then.g[i]);
    }
    if (then.g[11] == G_64) {
        snprintf(buf, sizeof buf, " G64 P%f Q%f", then.settings[3], then.settings[4]);
        line += buf;
    }
    std::vector<int> codes;
    if (with_m) m_codes_to_restore(m, then.m, codes);
    if (!codes.empty()) append_code(line, 'M', codes.front());
    r.lines.push_back(line);
    for (size_t i = 1; i < codes.size(); ++i) {
        std::string own;
        append_code(own, 'M', codes[i]);
        r.lines.push_back(own.substr(1));
    }
    return r;
}

} // namespace

// Executes a line of ours in the middle of another block.
int execute_inner(Setup &s, const char *text)
{
    const Block outer = s.block;
    char raw[sizeof s.raw], canonical[sizeof s.text];
    memcpy(raw, s.raw, sizeof raw);
    memcpy(canonical, s.text, sizeof canonical);
    const int raw_length = s.raw_length;
    int status = take_line(s, text);
    if (status == INTERP_OK) status = read_block(s);
    if (status == INTERP_OK) status = execute_block(s);
    s.block = outer;
    memcpy(s.raw, raw, sizeof raw);
    memcpy(s.text, canonical, sizeof canonical);
    s.raw_length = raw_length;
    return status;
}

int save_modes(Setup &s, bool restore_on_return)
{
    SavedModes &saved = s.frame().modes;
    active_g(s, saved.g);
    active_m(s, saved.m);
    active_values(s, saved.settings);
    saved.valid = true;
    saved.restore_on_return = restore_on_return;
    return INTERP_OK;
}

int restore_modes(Setup &s, const SavedModes &from)
{
    const SavedModes then = from;
    const Restore r = plan(s, then, true);
    if (!r.units.empty() && execute_inner(s, r.units.c_str()) > INTERP_MIN_ERROR) {
        const std::string why = s.error;
        FAIL("M7x: restore_settings G20/G21 failed: '%s'", why.c_str());
    }
    for (const std::string &line : r.lines) {
        if (execute_inner(s, line.c_str()) > INTERP_MIN_ERROR) {
            const std::string why = s.error;
            FAIL("M7x: restore_settings failed executing: '%s': %s", line.c_str(), why.c_str());
        }
    }
    return INTERP_OK;
}

int restore_after_abort(Setup &s, const state_tag_t &tag)
{
    SavedModes then;
    if (!state_tag_flag(&tag, GM_FLAG_RESTORABLE) || !modes_of_tag(tag, then.g, then.m, then.settings))
        return INTERP_OK;
    then.g[4] = G_40;
    Restore r = plan(s, then, false);
    if (!r.units.empty()) r.lines.insert(r.lines.begin(), r.units);
    for (const std::string &line : r.lines) {
        if (execute_inner(s, line.c_str()) > INTERP_MIN_ERROR) {
            const std::string why = s.error;
            FAIL("Failed to restore interp state on abort '%s': %s", line.c_str(), why.c_str());
        }
    }
    return INTERP_OK;
}

} // namespace ngc
