/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * remap.cc - the handlers that run in place of remapped codes.
 *
 * In:     a block at the phase of a remapped code
 * Out:    a call: prolog, body (sub or Python function), epilog; then the block goes on
 * Thread: [task]
 * Source: remap sheet, sections 3 to 6
 */
#include "remap.hh"

#include <algorithm>

#include "python_link.hh"
#include "stages.hh"

namespace ngc
{
namespace
{

enum { MAX_REMAP_LEVELS = 10 };

// M group of a phase, -1 when it belongs to none.
int m_group_of_phase(int phase)
{
    for (int group = MM_STOP; group < MM_GROUPS; ++group)
        if (phase_of_m_group(group) == phase) return group;
    return -1;
}

const Remap *candidate(const Setup &s, int phase)
{
    const Block &b = s.block;
    const RemapTable &table = *s.remaps;
    switch (phase) {
    case PHASE_F: return b.has('f') && s.feed_mode != INVERSE_TIME ? table.f : nullptr;
    case PHASE_S: return b.has('s') ? table.s : nullptr;
    case PHASE_T: return b.has('t') ? table.t : nullptr;
    case PHASE_MOTION: return b.motion >= 0 && g_group(b.motion) < 0 ? table.g(b.motion) : nullptr;
    }
    const int group = m_group_of_phase(phase);
    if (group < 0 || b.m_modes[group] < 0) return nullptr;
    const Remap *remap = table.m(b.m_modes[group]);
    return remap && remappable_m(remap->code) ? remap : nullptr;
}

// The code has a meaning of its own, which its handler may use.
bool has_builtin(const Remap &r) {
    return r.letter == 'T' || r.letter == 'S' || r.letter == 'F' || (r.letter == 'M' && m_group(r.code) >= 0);
}

bool stops(const Remap &r) { return r.letter == 'M' && (r.code == 0 || r.code == 1 || r.code == 60); }

bool has_python(const Remap &r) { return !r.prolog.empty() || !r.python.empty() || !r.epilog.empty(); }

char lower(char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; }

// The words that the handler gets, by the argspec.
int collect_words(Setup &s, const Remap &r, RemapFrame &f)
{
    const Block &b = f.block;
    std::string missing, conditions;
    bool line_number = false, feed = false, speed = false;
    for (char c : r.argspec) {
        switch (c) {
        case '@': continue;
        case '>':
            feed = true;
            if (s.feed_rate <= 0) conditions += "F>0,";
            continue;
        case '^':
            speed = true;
            if (s.speed[0] <= 0) conditions += "S>0,";
            continue;
        case 'N': case 'n': line_number = true; continue;
        case 'G': case 'g': case 'M': case 'm': continue;
        }
        const char letter = lower(c);
        if (b.has(letter)) {
            f.words.emplace_back(letter, b[letter]);
        } else if (c >= 'A' && c <= 'Z') {
            missing += missing.empty() ? " missing: " : ",";
            missing += c;
        }
    }
    CHECK(!missing.empty() || !conditions.empty(), "user-defined %s:%s%s", r.name.c_str(), missing.c_str(),
          conditions.c_str());
    if (line_number) f.words.emplace_back('n', double(f.sequence_number));
    if (feed) f.words.emplace_back('f', s.feed_rate);
    if (speed) f.words.emplace_back('s', s.speed[0]);
    return INTERP_OK;
}

int run_stages(Setup &s)
{
    for (;;) {
        RemapFrame &f = s.remap_frames.back();
        const Remap &r = *f.remap;
        const RemapFrame::Stage stage = f.stage;
        f.stage = RemapFrame::Stage(stage + 1);
        switch (stage) {
        case RemapFrame::PROLOG:
            if (!r.prolog.empty()) TRY(s.python->call_remap(s, r.prolog, f));
            break;
        case RemapFrame::BODY:
            if (!r.python.empty()) {
                TRY(s.python->call_remap(s, r.python, f));
                break;
            }
            s.sequence_number = 0;
            return seek_sub(s, r.ngc); // finish_remap() goes on
        case RemapFrame::EPILOG:
            if (!r.epilog.empty() && r.python.empty()) TRY(s.python->call_remap(s, r.epilog, f));
            break;
        case RemapFrame::END: {
            const bool restore = s.frame().modes.valid && s.frame().modes.restore_on_return;
            const SavedModes modes = s.frame().modes;
            leave_frame(s);
            s.block = f.block;
            memcpy(s.raw, f.raw, sizeof s.raw);
            memcpy(s.text, f.text, sizeof s.text);
            s.raw_length = f.raw_length;
            s.sequence_number = f.sequence_number;
            s.line_offset = f.line_offset;
            s.remap_frames.pop_back();
            s.remap_level = int(s.remap_frames.size());
            if (restore) TRY(restore_modes(s, modes));
            return execute_block(s);
        }
        }
    }
}

} // namespace

const Remap *remap_of_phase(Setup &s, int phase)
{
    const Remap *remap = candidate(s, phase);
    if (!remap || !has_builtin(*remap)) return remap;
    // Inside its own handler the code has its ordinary meaning.
    for (RemapFrame &f : s.remap_frames)
        if (f.remap == remap || (stops(*f.remap) && stops(*remap))) {
            f.block.builtin_used = true;
            return nullptr;
        }
    return remap;
}

int start_remap(Setup &s, const Remap &remap)
{
    CHECK(s.remap_level + 1 >= MAX_REMAP_LEVELS, "maximum nesting of remapped blocks exceeded");
    CHECK(has_python(remap) && !s.python, "%s (remapped) uses Python functions, but the Python plugin is not available",
          remap.name.c_str());
    RemapFrame f;
    f.remap = &remap;
    f.block = s.block;
    f.block.executing = &remap;
    f.block.builtin_used = false;
    f.sequence_number = s.sequence_number;
    memcpy(f.raw, s.raw, sizeof f.raw);
    memcpy(f.text, s.text, sizeof f.text);
    f.raw_length = s.raw_length;
    f.line_offset = s.line_offset;
    TRY(collect_words(s, remap, f));

    if (s.logs(1, LOG_REMAP)) s.log("%s is remapped", remap.name.c_str());
    const bool positional = remap.argspec.find('@') != std::string::npos;
    CHECK(positional && has_python(remap), "add parameters: can't add '%c' to args",
          f.words.empty() ? '@' : f.words.front().first);
    s.block.params = 0;
    if (positional)
        for (const auto &w : f.words)
            if (s.block.params < SUB_ARGUMENTS) s.block.param[s.block.params++] = rint(w.second * 10000) / 10000;
    const std::string &name = remap.python.empty() ? remap.ngc : remap.python;
    TRY(enter_sub(s, CALL_REMAP, name));
    if (!positional)
        for (const auto &w : f.words) s.frame().locals.at(std::string_view(&w.first, 1)).value = w.second;
    f.call_level = s.call_level;
    s.remap_frames.push_back(std::move(f));
    s.remap_level = int(s.remap_frames.size());
    s.raw_length = snprintf(s.raw, sizeof s.raw, "O <%s> call ", name.c_str());
    return run_stages(s);
}

int continue_remap(Setup &s, int status)
{
    if (status != INTERP_OK) return status;
    return run_stages(s);
}

int finish_remap(Setup &s) { return run_stages(s); }

void forget_remaps(Setup &s)
{
    s.remap_frames.clear();
    s.remap_level = 0;
    if (s.python) s.python->forget_waiting();
}

int run_python_line(Setup &s, const char *text)
{
    CHECK(!s.python, "py_execute(%s): Python plugin not initialized", text);
    return s.python->run(s, text, false);
}

} // namespace ngc
