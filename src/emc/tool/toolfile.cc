/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * toolfile.cc - the tool table file: reading, and writing without losing anything.
 *
 * In/Out: one tool a line, words separated by spaces, comment behind ;
 * Thread: [task]
 * Method: a save writes a new file, syncs and renames it; the old one stays as .bak.
 *         Lines without a tool (comments, blank lines, lines that were not understood)
 *         keep their places.
 * Source: canonical sheet, section 5; tools sheet, section 2
 */
#include "tooldata.h"

#include <cerrno>
#include <charconv>
#include <climits>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <sys/stat.h>
#include <unistd.h>

#include "tooldb.hh"

namespace
{

int next_idx = 1; // of a non-random table
std::string loading; // name of the file, for messages

// "D" and "X" to "W", "I", "J" by letter.
double *field_of(CANON_TOOL_TABLE &t, char letter)
{
    switch (letter) {
    case 'D': return &t.diameter;
    case 'X': return &t.offset.tran.x;
    case 'Y': return &t.offset.tran.y;
    case 'Z': return &t.offset.tran.z;
    case 'A': return &t.offset.a;
    case 'B': return &t.offset.b;
    case 'C': return &t.offset.c;
    case 'U': return &t.offset.u;
    case 'V': return &t.offset.v;
    case 'W': return &t.offset.w;
    case 'I': return &t.frontangle;
    case 'J': return &t.backangle;
    }
    return nullptr;
}
const char FIELDS[] = "DXYZABCUVWIJ";

// The beginning of the text as a number, whatever the locale; false when there is none.
bool leading_real(const char *text, double *value)
{
    while (*text == '\t' || *text == '\v' || *text == '\f') ++text;
    if (*text == '+') ++text;
    return std::from_chars(text, text + strlen(text), *value).ec == std::errc();
}

bool leading_int(const char *text, int *value)
{
    char *end;
    errno = 0;
    const long v = strtol(text, &end, 10);
    if (end == text) return false;
    *value = v > INT_MAX ? INT_MAX : v < INT_MIN ? INT_MIN : int(v);
    return true;
}

enum Kind { TOOL, COMMENT_LINE, REJECTED };

// One word into the record. False: unknown letter or no number.
bool take_word(char *word, CANON_TOOL_TABLE &t, bool random, bool &have_p)
{
    char letter = word[0];
    if (letter >= 'a' && letter <= 'z') letter = char(letter - 32);
    switch (letter) {
    case 'T': return leading_int(word + 1, &t.toolno);
    case 'Q': return leading_int(word + 1, &t.orientation);
    case 'P':
        if (!leading_int(word + 1, &t.pocketno)) return false;
        if (!random) ++next_idx;
        have_p = true;
        return true;
    }
    double *field = field_of(t, letter);
    double v;
    if (!field || !leading_real(word + 1, &v)) return false;
    *field = v;
    return true;
}

void reject(const char *line)
{
    printf("File: %s Unrecognized line skipped:\n    %s", loading.c_str(), line);
    if (!*line || line[strlen(line) - 1] != '\n') putchar('\n');
    fflush(stdout);
}

// Splits and stores a line. *idx: where it went.
Kind read_line(const char *line, int *idx, CANON_TOOL_TABLE *result)
{
    if (line[0] == ';') return COMMENT_LINE;
    const char *semicolon = strchr(line, ';');
    std::string data(line, semicolon ? size_t(semicolon - line) : strlen(line));
    if (data.size() <= 1) return COMMENT_LINE;
    while (!data.empty() && data.back() == '\n') data.pop_back();

    CANON_TOOL_TABLE t = tooldata_entry_init();
    t.pocketno = 0;
    const bool random = tool_mmap_is_random_toolchanger();
    const int first_idx = next_idx;
    bool have_p = false;
    char *save = nullptr;
    for (char *word = strtok_r(data.data(), " ", &save); word; word = strtok_r(nullptr, " ", &save))
        if (!take_word(word, t, random, have_p)) {
            reject(line);
            return REJECTED;
        }
    if (semicolon) {
        std::string comment = semicolon + 1;
        while (!comment.empty() && (comment.back() == '\n' || comment.back() == '\r')) comment.pop_back();
        if (comment.size() >= CANON_TOOL_COMMENT_SIZE) {
            comment.resize(CANON_TOOL_COMMENT_SIZE - 1);
            fprintf(stderr, "tooldata_read_entry():comment for toolno %d truncated to %d chars:\n   <%s>\n", t.toolno,
                    CANON_TOOL_COMMENT_SIZE - 1, comment.c_str());
        }
        memcpy(t.comment, comment.c_str(), comment.size() + 1);
    }
    if (random) {
        *idx = t.pocketno;
        if (*idx < 0 || *idx >= CANON_POCKETS_MAX) {
            printf("max pocket number is %d. skipping tool %d\n", CANON_POCKETS_MAX - 1, t.toolno);
            fflush(stdout);
            return REJECTED;
        }
        CANON_TOOL_TABLE old;
        if (tooldata_get(&old, *idx) == IDX_OK && old.toolno != -1)
            fprintf(stderr,
                    "WARNING: Attempt to assign multiple toolno.s to pocket %d\n"
                    "         Discarding: toolno=%d\n         Using:      toolno=%d\n",
                    *idx, old.toolno, t.toolno);
    } else {
        *idx = have_p ? first_idx : 0;
        if (*idx >= CANON_POCKETS_MAX) {
            printf("Out-of-range nonrandom_idx=%d. Skipping tool=%d\n", *idx, t.toolno);
            fflush(stdout);
            return REJECTED;
        }
    }
    *result = t;
    return TOOL;
}

void store_entry(const CANON_TOOL_TABLE &t, int idx)
{
    tooldata_put(t, idx);
    if (tool_mmap_is_random_toolchanger() || idx == 0) return;
    CANON_TOOL_TABLE spindle;
    if (tooldata_get(&spindle, 0) == IDX_OK && spindle.toolno != -1 && spindle.toolno == t.toolno) tooldata_put(t, 0);
}

// Lines as fgets with 256 bytes gives them: longer ones come in pieces.
std::vector<std::string> file_lines(FILE *f)
{
    std::vector<std::string> lines;
    char buf[CANON_TOOL_ENTRY_LEN];
    while (fgets(buf, sizeof buf, f)) lines.emplace_back(buf);
    return lines;
}

// The number behind the T of a line, -1 when it has none.
int line_toolno(const std::string &line)
{
    std::string data = line.substr(0, line.find(';'));
    char *save = nullptr;
    int number = -1;
    for (char *word = strtok_r(data.data(), " \n", &save); word; word = strtok_r(nullptr, " \n", &save))
        if (word[0] == 'T' || word[0] == 't') leading_int(word + 1, &number);
    return number;
}

bool is_tool_line(const std::string &line)
{
    if (line[0] == ';') return false;
    std::string data = line.substr(0, line.find(';'));
    char *save = nullptr;
    bool any = false;
    for (char *word = strtok_r(data.data(), " \n", &save); word; word = strtok_r(nullptr, " \n", &save)) {
        char letter = word[0];
        if (letter >= 'a' && letter <= 'z') letter = char(letter - 32);
        double real;
        int whole;
        if (letter == 'T' || letter == 'P' || letter == 'Q') {
            if (!leading_int(word + 1, &whole)) return false;
        } else if (!strchr(FIELDS, letter) || !leading_real(word + 1, &real)) {
            return false;
        }
        any = true;
    }
    return any;
}

} // namespace

void tooldata_add_init(int start_idx) { next_idx = start_idx; }

int tooldata_read_entry(const char *line)
{
    int idx = 0;
    CANON_TOOL_TABLE t;
    switch (read_line(line, &idx, &t)) {
    case COMMENT_LINE: return 0;
    case REJECTED: return -1;
    case TOOL: store_entry(t, idx);
    }
    return idx;
}

void tooldata_format_toolline(int idx, int ignore_zero_values, CANON_TOOL_TABLE t, char *buf)
{
    const int pocket = tool_mmap_is_random_toolchanger() ? idx : t.pocketno;
    size_t used = size_t(snprintf(buf, CANON_TOOL_ENTRY_LEN, "T%-3d P%-3d", t.toolno, pocket));
    auto add = [&](const char *text) {
        const size_t n = strlen(text);
        if (used + n + 2 > CANON_TOOL_ENTRY_LEN) return;
        memcpy(buf + used, text, n + 1);
        used += n;
    };
    char word[400];
    for (const char *letter = FIELDS; *letter; ++letter) {
        const double v = *field_of(t, *letter);
        if (v != 0) snprintf(word, sizeof word, " %c%+f", *letter, v);
        else if (!ignore_zero_values) snprintf(word, sizeof word, " %c0", *letter);
        else continue;
        for (char *c = word; *c; ++c)
            if (*c == ',') *c = '.';
        add(word);
    }
    if (t.orientation || !ignore_zero_values) {
        snprintf(word, sizeof word, " Q%d", t.orientation);
        add(word);
    }
    if (t.comment[0]) {
        add(" ;");
        add(t.comment);
    }
    buf[used] = '\n';
    buf[used + 1] = 0;
}

int tooldata_load(const char *filename)
{
    if (tooldb_active()) {
        tooldata_reset();
        tooldata_add_init(1);
        if (tooldata_db_getall() == 0) return 0;
        fprintf(stderr, "tooldata_load: Failed to load tooldata from database\n");
        tooldata_set_db(DB_NOTUSED);
        return -1;
    }
    if (!filename || !*filename) return -1;
    FILE *f = fopen(filename, "re");
    if (!f) {
        fprintf(stderr, "tooldata_load: Failed to open tool table file '%s': %s\n", filename, strerror(errno));
        return -1;
    }
    tooldata_reset();
    tooldata_add_init(1);
    loading = filename;
    for (const std::string &line : file_lines(f)) tooldata_read_entry(line.c_str());
    fclose(f);
    return 0;
}

int tooldata_save(const char *filename)
{
    if (tooldb_active()) return tooldb_save_spindle();
    if (!filename || !*filename) {
        fprintf(stderr, "tooldata_save(): No filename. Are you missing INI-entry [EMCIO]TOOL_TABLE?\n");
        return -1;
    }
    std::vector<std::string> old;
    struct stat st;
    mode_t mode = 0644;
    if (FILE *f = fopen(filename, "re")) {
        if (fstat(fileno(f), &st) == 0) mode = st.st_mode & 0777;
        old = file_lines(f);
        fclose(f);
    }
    // The new tool lines in index order, each under the place of the old line of its tool.
    struct Entry { int toolno; std::string line; bool written; };
    std::vector<Entry> entries;
    const int first = tool_mmap_is_random_toolchanger() ? 0 : 1;
    for (int idx = first; idx < CANON_POCKETS_MAX; ++idx) {
        CANON_TOOL_TABLE t;
        if (tooldata_get(&t, idx) != IDX_OK || t.toolno == -1) continue;
        char buf[CANON_TOOL_ENTRY_LEN + 8];
        tooldata_format_toolline(idx, 1, t, buf);
        entries.push_back({t.toolno, buf, false});
    }
    std::string text;
    size_t next = 0; // entries before it are written
    for (std::string line : old) {
        if (is_tool_line(line)) {
            // Tools keep index order: this place takes all entries up to the line's own.
            const int toolno = line_toolno(line);
            size_t match = next;
            while (match < entries.size() && entries[match].toolno != toolno) ++match;
            if (match == entries.size()) continue; // no longer in the table
            for (; next <= match; ++next) text += entries[next].line;
        } else {
            if (line.empty() || line.back() != '\n') line += '\n';
            text += line;
        }
    }
    for (; next < entries.size(); ++next) text += entries[next].line;

    const std::string fresh = std::string(filename) + ".new", backup = std::string(filename) + ".bak";
    FILE *f = fopen(fresh.c_str(), "we");
    if (!f) {
        fprintf(stderr, "tooldata_save(): Failed to open tool table file '%s': %s\n", fresh.c_str(), strerror(errno));
        return -1;
    }
    bool good = fwrite(text.data(), 1, text.size(), f) == text.size();
    good = fflush(f) == 0 && fdatasync(fileno(f)) == 0 && good;
    good = fchmod(fileno(f), mode) == 0 && good;
    good = fclose(f) == 0 && good;
    if (good) {
        unlink(backup.c_str());
        if (link(filename, backup.c_str()) != 0 && errno != ENOENT) perror("tooldata_save(): link");
        good = rename(fresh.c_str(), filename) == 0;
    }
    if (!good) {
        fprintf(stderr, "tooldata_save(): '%s': %s\n", filename, strerror(errno));
        unlink(fresh.c_str());
        return -1;
    }
    return 0;
}
