/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * toolfile.cc - the tool table file: reading, and writing without losing anything.
 *
 * In/Out: one tool a line, words separated by blanks, comment behind ;
 * Thread: [task]
 * Method: a save puts each tool's new line in the place of its old one. Every other line (comments,
 *         blank lines, lines that were not understood) stays where and as it is; of a tool's line
 *         the whole comment stays, and digits beyond the usual six while the value is the same.
 * Source: canonical sheet, section 5; tools sheet, section 2
 */
#include "tooldata.h"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "tooldb.hh"
#include "replace_file.hh"
#include "tooltext.hh"

using namespace tooltext;

namespace
{

int next_idx = 1;        // of a non-random table
std::string loading;     // name of the file, for messages
int line_number = 0;     // in it; 0: a line of the database

enum Kind { TOOL, NO_TOOL, REJECTED };

void complain(int column, const std::string &what) { problem(loading, line_number, column, what); }

// Splits and stores a line. *idx: where it goes.
Kind read_line(const std::string &line, int *idx, CANON_TOOL_TABLE *result)
{
    const Line parts = split(line);
    if (parts.blank()) return NO_TOOL;
    CANON_TOOL_TABLE t = tooldata_entry_init();
    t.pocketno = 0;
    const bool random = tool_mmap_is_random_toolchanger();
    const int first_idx = next_idx;
    bool have_t = false, have_p = false;
    for (const Word &word : parts.words) {
        if (take(word, t)) {
            have_t |= word.letter == 'T';
            have_p |= word.letter == 'P';
            if (word.letter == 'P' && !random) ++next_idx;
            continue;
        }
        printf("File: %s Unrecognized line skipped:\n    %s\n", loading.c_str(), line.c_str());
        fflush(stdout);
        const bool letter = strchr("TPQ", word.letter) || field_of(t, word.letter);
        complain(word.column, "the line is skipped: '" + word.text + "' " +
                                  (letter ? "has no number behind its letter"
                                          : "is no word of a tool table (letters T P D X Y Z A B C U V W I J Q)"));
        return REJECTED;
    }
    std::string comment = parts.comment;
    if (comment.size() >= CANON_TOOL_COMMENT_SIZE) {
        comment.resize(CANON_TOOL_COMMENT_SIZE - 1);
        fprintf(stderr, "tooldata_read_entry():comment for toolno %d truncated to %d chars:\n   <%s>\n", t.toolno,
                CANON_TOOL_COMMENT_SIZE - 1, comment.c_str());
    }
    memcpy(t.comment, comment.c_str(), comment.size() + 1);
    if (!have_t) complain(1, "no tool number (T)");
    if (random) {
        *idx = t.pocketno;
        if (*idx < 0 || *idx >= CANON_POCKETS_MAX) {
            printf("max pocket number is %d. skipping tool %d\n", CANON_POCKETS_MAX - 1, t.toolno);
            fflush(stdout);
            complain(0, "the line is skipped: pockets are 0 to " + std::to_string(CANON_POCKETS_MAX - 1));
            return REJECTED;
        }
        if (!have_p)
            complain(0, "no pocket number (P); tool " + std::to_string(t.toolno) + " is taken to be in the spindle");
        CANON_TOOL_TABLE old;
        if (tooldata_get(&old, *idx) == IDX_OK && old.toolno != -1) {
            fprintf(stderr,
                    "WARNING: Attempt to assign multiple toolno.s to pocket %d\n"
                    "         Discarding: toolno=%d\n         Using:      toolno=%d\n",
                    *idx, old.toolno, t.toolno);
            complain(0, "pocket " + std::to_string(*idx) + " has tool " + std::to_string(old.toolno) +
                            " already, which is left out");
        }
    } else {
        *idx = first_idx;
        if (!have_p) { // index 0 is the spindle
            complain(0, "the line is skipped: no pocket number (P)");
            return REJECTED;
        }
        if (*idx >= CANON_POCKETS_MAX) {
            printf("Out-of-range nonrandom_idx=%d. Skipping tool=%d\n", *idx, t.toolno);
            fflush(stdout);
            complain(0, "the line is skipped: a table has at most " + std::to_string(CANON_POCKETS_MAX - 1) + " tools");
            return REJECTED;
        }
    }
    *result = t;
    return TOOL;
}

void store_entry(const CANON_TOOL_TABLE &t, int idx)
{
    const bool random = tool_mmap_is_random_toolchanger();
    if (line_number > 0 && t.toolno != -1)
        for (int i = random ? 0 : 1; i <= tooldata_last_index_get(); ++i) {
            CANON_TOOL_TABLE other;
            if (i == idx || tooldata_get(&other, i) != IDX_OK || other.toolno != t.toolno) continue;
            complain(0, "tool " + std::to_string(t.toolno) + " stands above already, which is the one that is used");
            break;
        }
    tooldata_put(t, idx);
    if (random || idx == 0) return;
    CANON_TOOL_TABLE spindle;
    if (tooldata_get(&spindle, 0) == IDX_OK && spindle.toolno != -1 && spindle.toolno == t.toolno) tooldata_put(t, 0);
}

// " Z+1.500000"; with all its digits when `exact` and six do not do.
std::string value_word(char letter, double v, bool exact)
{
    char text[400];
    snprintf(text, sizeof text, " %c%+f", letter, v);
    for (char *c = text; *c; ++c)
        if (*c == ',') *c = '.';
    if (!exact) return text;
    double again = 0;
    const char *number = text + (text[2] == '+' ? 3 : 2);
    std::from_chars(number, text + strlen(text), again);
    if (again == v) return text;
    char digits[400];
    const std::to_chars_result r = std::to_chars(digits, digits + sizeof digits, v, std::chars_format::fixed);
    return std::string(" ") + letter + (v < 0 ? "" : "+") + std::string(digits, r.ptr);
}

// The line of a tool. before: the record of its old line, nullptr when there is none.
std::string tool_line(int idx, bool ignore_zero, CANON_TOOL_TABLE t, CANON_TOOL_TABLE *before,
                      const std::string &comment) {
    char head[64];
    snprintf(head, sizeof head, "T%-3d P%-3d", t.toolno, tool_mmap_is_random_toolchanger() ? idx : t.pocketno);
    std::string text = head;
    for (const char *letter = FIELDS; *letter; ++letter) {
        const double v = *field_of(t, *letter);
        if (v != 0) text += value_word(*letter, v, before && *field_of(*before, *letter) == v);
        else if (!ignore_zero) text += std::string(" ") + *letter + "0";
    }
    if (t.orientation || !ignore_zero) text += " Q" + std::to_string(t.orientation);
    if (!comment.empty()) text += " ;" + comment;
    return text;
}

// A line of the file as it is now, for a save.
struct OldLine {
    std::string text;
    bool tool = false; // all its words are understood
    CANON_TOOL_TABLE record;
    std::string comment;
};

OldLine old_line(const std::string &text)
{
    OldLine l;
    l.text = text;
    l.record = tooldata_entry_init();
    const Line parts = split(text);
    l.comment = parts.comment;
    l.tool = !parts.blank();
    for (const Word &w : parts.words) l.tool = l.tool && take(w, l.record);
    return l;
}

} // namespace

void tooldata_add_init(int start_idx) { next_idx = start_idx; }

int tooldata_read_entry(const char *line)
{
    std::string text = line;
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
    int idx = 0;
    CANON_TOOL_TABLE t;
    switch (read_line(text, &idx, &t)) {
    case NO_TOOL: return 0;
    case REJECTED: return -1;
    case TOOL: store_entry(t, idx);
    }
    return idx;
}

void tooldata_format_toolline(int idx, int ignore_zero_values, CANON_TOOL_TABLE t, char *buf)
{
    std::string text = tool_line(idx, ignore_zero_values, t, nullptr, t.comment);
    if (text.size() > CANON_TOOL_ENTRY_LEN - 2) text.resize(CANON_TOOL_ENTRY_LEN - 2);
    text += '\n';
    memcpy(buf, text.c_str(), text.size() + 1);
}

int tooldata_load(const char *filename)
{
    forget_problems();
    line_number = 0;
    if (tooldata_db_active()) {
        tooldata_reset();
        tooldata_add_init(1);
        loading = tooldb_program();
        if (tooldata_db_getall() == 0) return 0;
        fprintf(stderr, "tooldata_load: Failed to load tooldata from database\n");
        problem(loading, 0, 0, "gave no tools; the tool table file is used from now on");
        tooldata_set_db(DB_NOTUSED);
        return -1;
    }
    if (!filename || !*filename) return -1;
    std::vector<std::string> lines;
    if (!read_lines(filename, &lines)) {
        const std::string why = strerror(errno);
        fprintf(stderr, "tooldata_load: Failed to open tool table file '%s': %s\n", filename, why.c_str());
        report(std::string(filename) + ": the tool table can not be read: " + why);
        return -1;
    }
    tooldata_reset();
    tooldata_add_init(1);
    loading = filename;
    for (const std::string &line : lines) {
        ++line_number;
        tooldata_read_entry(line.c_str());
    }
    line_number = 0;
    return 0;
}

int tooldata_save(const char *filename)
{
    if (tooldata_db_active()) return tooldb_save_spindle();
    forget_problems();
    if (!filename || !*filename) {
        fprintf(stderr, "tooldata_save(): No filename. Are you missing INI-entry [EMCIO]TOOL_TABLE?\n");
        problem("[EMCIO]TOOL_TABLE", 0, 0, "is missing: the tools can not be saved");
        return -1;
    }
    std::vector<std::string> lines;
    if (!read_lines(filename, &lines) && errno != ENOENT) {
        problem(filename, 0, 0, std::string("can not be read: ") + strerror(errno));
        return -1;
    }
    // The tools in index order, each under the place of its old line.
    const bool random = tool_mmap_is_random_toolchanger();
    struct Entry { int idx; CANON_TOOL_TABLE tool; };
    std::vector<Entry> entries;
    for (int idx = random ? 0 : 1; idx <= tooldata_last_index_get(); ++idx) {
        CANON_TOOL_TABLE t;
        if (tooldata_get(&t, idx) == IDX_OK && t.toolno != -1) entries.push_back({idx, t});
    }
    std::vector<OldLine> old;
    for (const std::string &l : lines) old.push_back(old_line(l));
    std::string text;
    size_t next = 0; // entries before it are written
    auto write_next = [&](const OldLine *here) {
        const Entry &e = entries[next++];
        const OldLine *mine = here && here->record.toolno == e.tool.toolno ? here : nullptr;
        for (size_t i = 0; !mine && i < old.size(); ++i)
            if (old[i].tool && old[i].record.toolno == e.tool.toolno) mine = &old[i];
        const bool whole = mine && mine->comment.compare(0, CANON_TOOL_COMMENT_SIZE - 1, e.tool.comment) == 0;
        CANON_TOOL_TABLE before = mine ? mine->record : tooldata_entry_init();
        text += tool_line(e.idx, true, e.tool, mine ? &before : nullptr, whole ? mine->comment : e.tool.comment) + "\n";
    };
    for (const OldLine &line : old) {
        size_t match = entries.size();
        bool known = false;
        if (line.tool)
            for (size_t i = 0; i < entries.size() && match == entries.size(); ++i) {
                if (entries[i].tool.toolno != line.record.toolno) continue;
                known = true;
                if (i >= next) match = i;
            }
        if (match < entries.size()) { // tools keep index order: this place takes all up to the line's own
            while (next <= match) write_next(next == match ? &line : nullptr);
            continue;
        }
        if (known) continue; // it stands above already
        // A tool that was not taken into the table. In a random changer its pocket belongs to another one.
        text += line.tool && random ? ";" + line.text + "\n" : line.text + "\n";
    }
    while (next < entries.size()) write_next(nullptr);

    if (linuxcnc::replace_file(filename, text, true)) return 0;
    const std::string why = strerror(errno);
    fprintf(stderr, "tooldata_save(): '%s': %s\n", filename, why.c_str());
    problem(filename, 0, 0, "the tools can not be saved: " + why);
    return -1;
}
