/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * tooltext.hh - what reading and saving the tool table share: words of a line, problems.
 * [task]
 */
#ifndef KERF_TOOLTEXT_HH
#define KERF_TOOLTEXT_HH

#include <string>
#include <vector>

#include "tooldata.h"

namespace tooltext
{

/// Letters of the real values, in the order of a saved line.
extern const char FIELDS[];
/// The value behind a letter of FIELDS, nullptr for any other.
double *field_of(CANON_TOOL_TABLE &t, char letter);

struct Word {
    char letter;      ///< upper case
    std::string text; ///< as written, with the letter
    int column;       ///< of the letter, from 1
};

struct Line {
    std::vector<Word> words;   ///< before the comment; separated by blanks or tabs
    bool has_comment = false;
    std::string comment;       ///< behind the first semicolon, without the end of the line
    bool blank() const { return words.empty(); } ///< no tool on it
};
Line split(const std::string &line);

/// One word into the record; P counts too. False: unknown letter, or no number behind it.
bool take(const Word &word, CANON_TOOL_TABLE &t);

/// The lines of a file without their ends. False: it can not be opened (errno).
bool read_lines(const char *filename, std::vector<std::string> *lines);

void forget_problems();
/// A line for tooldata_problems() alone: standard error has been told in other words.
void report(const std::string &text);
/// "FILE:LINE:COLUMN: WHAT" (column 0: none) to standard error and to tooldata_problems().
void problem(const std::string &file, int line, int column, const std::string &what);

} // namespace tooltext

#endif
