/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * tooltext.cc - see tooltext.hh.
 */
#include "tooltext.hh"

#include <cerrno>
#include <charconv>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace
{

std::string problems;

// The beginning of the text as a number, whatever the locale; false when there is none.
bool leading_real(const char *text, double *value)
{
    if (*text == '+') ++text;
    return std::from_chars(text, text + strlen(text), *value).ec == std::errc();
}

bool leading_int(const char *text, int *value)
{
    char *end;
    const long v = strtol(text, &end, 10);
    if (end == text) return false;
    *value = v > INT_MAX ? INT_MAX : v < INT_MIN ? INT_MIN : int(v);
    return true;
}

} // namespace

namespace tooltext
{

const char FIELDS[] = "DXYZABCUVWIJ";

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

Line split(const std::string &line)
{
    Line result;
    size_t end = line.find(';');
    if (end != line.npos) {
        result.has_comment = true;
        result.comment = line.substr(end + 1);
        while (!result.comment.empty() && (result.comment.back() == '\n' || result.comment.back() == '\r'))
            result.comment.pop_back();
    } else {
        end = line.size();
    }
    for (size_t i = 0; i < end;) {
        if (strchr(" \t\r\n", line[i])) {
            ++i;
            continue;
        }
        size_t stop = line.find_first_of(" \t\r\n", i);
        if (stop == line.npos || stop > end) stop = end;
        const char letter = line[i];
        result.words.push_back(
            {letter >= 'a' && letter <= 'z' ? char(letter - 32) : letter, line.substr(i, stop - i), int(i) + 1});
        i = stop;
    }
    return result;
}

bool take(const Word &word, CANON_TOOL_TABLE &t)
{
    const char *number = word.text.c_str() + 1;
    switch (word.letter) {
    case 'T': return leading_int(number, &t.toolno);
    case 'Q': return leading_int(number, &t.orientation);
    case 'P': return leading_int(number, &t.pocketno);
    }
    double *field = field_of(t, word.letter);
    double v;
    if (!field || !leading_real(number, &v)) return false;
    *field = v;
    return true;
}

bool read_lines(const char *filename, std::vector<std::string> *lines)
{
    errno = 0;
    std::ifstream in(filename, std::ios::binary);
    if (!in) return false;
    for (std::string line; std::getline(in, line);) lines->push_back(line);
    // The byte order mark of some editors.
    if (!lines->empty() && lines->front().compare(0, 3, "\xEF\xBB\xBF") == 0) lines->front().erase(0, 3);
    return !in.bad();
}

void forget_problems() { problems.clear(); }

void report(const std::string &text) { problems += text + "\n"; }

void problem(const std::string &file, int line, int column, const std::string &what)
{
    std::string text = file;
    if (line > 0) text += ":" + std::to_string(line);
    if (line > 0 && column > 0) text += ":" + std::to_string(column);
    text += ": " + what;
    fprintf(stderr, "%s\n", text.c_str());
    report(text);
}

} // namespace tooltext

const char *tooldata_problems(void) { return problems.c_str(); }
