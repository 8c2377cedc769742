/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * fault.cc - where a mistake stands, and how it is shown.
 *
 * Thread: [task]
 */
#include "stages.hh"

namespace ngc
{

void fill_fault_place(Setup &s)
{
    Fault &f = s.fault;
    f.file = s.source >= 0 ? s.sources[size_t(s.source)]->path() : std::string();
    f.line = s.sequence_number;
    f.text = s.raw;
    f.column = raw_column(s, s.word_start);
    if (f.column > s.raw_length && s.raw_length > 0) f.column = s.raw_length;
    int end = s.pos > s.word_start ? raw_column(s, s.pos - 1) + 1 : f.column + 1;
    if (end > s.raw_length + 1) end = s.raw_length + 1;
    f.length = end > f.column ? end - f.column : 1;
}

} // namespace ngc

std::string Fault::report() const
{
    std::string out = file.empty() ? std::string("MDI") : file;
    out += ':' + std::to_string(line);
    if (column > 0) out += ':' + std::to_string(column);
    out += ": " + what + '\n';
    if (!text.empty()) {
        out += "  " + text + '\n';
        if (column > 0) {
            out += "  ";
            for (int i = 0; i < column - 1; ++i) out += i < int(text.size()) && text[size_t(i)] == '\t' ? '\t' : ' ';
            out += '^' + std::string(size_t(length > 1 ? length - 1 : 0), '~') + '\n';
        }
    }
    if (!fix.empty()) out += "  " + fix + '\n';
    return out;
}
