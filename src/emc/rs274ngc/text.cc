/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * text.cc - a line as written becomes canonical text.
 *
 * In:     one line, with or without newline
 * Out:    s.raw (as written), s.text (lower case, no blanks, comments verbatim)
 * Thread: [task]
 * Source: G-code sheet, section 2
 */
#include <algorithm>

#include "stages.hh"

namespace ngc
{
namespace
{

enum Kind : uint8_t { KEEP, DROP, OPEN, REST };

struct CharTable {
    uint8_t kind[256];
    char lower[256];
    constexpr CharTable() : kind(), lower()
    {
        for (int c = 0; c < 256; ++c) {
            kind[c] = KEEP;
            lower[c] = char(c >= 'A' && c <= 'Z' ? c + ('a' - 'A') : c);
        }
        kind[int(' ')] = kind[int('\t')] = kind[int('\r')] = DROP;
        kind[int('(')] = OPEN;
        kind[int(';')] = REST;
    }
};
constexpr CharTable chars;

} // namespace

int take_line(Setup &s, std::string_view line)
{
    line = line.substr(0, line.find('\0')); // nothing stands behind a NUL
    size_t raw_length = std::min(line.size(), sizeof s.raw - 1);
    memcpy(s.raw, line.data(), raw_length);
    s.raw[raw_length] = 0;
    s.raw_length = int(raw_length);
    s.pos = s.word_start = 0;
    s.text[0] = 0;
    CHECK(line.size() >= INTERP_LINELEN, "Command too long");

    char *out = s.text;
    const char *in = line.data(), *end = in + line.size();
    while (in < end) {
        unsigned char c = static_cast<unsigned char>(*in);
        switch (chars.kind[c]) {
        case KEEP:
            if (c == '\n') {
                if (in + 1 == end) {
                    ++in;
                    continue;
                }
                s.pos = int(out - s.text);
                *out = 0;
                FAIL("Null missing after newline");
            }
            *out++ = chars.lower[c];
            ++in;
            break;
        case DROP:
            ++in;
            break;
        case OPEN: {
            s.word_start = s.pos = int(out - s.text);
            do {
                *out++ = *in++;
                if (in < end && *in == '(') {
                    *out = 0;
                    FAIL("Nested comment found");
                }
            } while (in < end && *in != ')' && *in != '\n');
            if (in == end || *in != ')') {
                *out = 0;
                FAIL("Unclosed comment found");
            }
            *out++ = *in++;
            break;
        }
        case REST:
            while (in < end && *in != '\n') *out++ = *in++;
            break;
        }
    }
    *out = 0;
    s.pos = s.word_start = 0;
    return INTERP_OK;
}

int raw_column(const Setup &s, int text_pos)
{
    int at = 0; // place in the canonical text
    bool comment = false, rest = false;
    for (int i = 0; i < s.raw_length; ++i) {
        unsigned char c = static_cast<unsigned char>(s.raw[i]);
        bool kept = comment || rest || chars.kind[c] != DROP;
        if (kept && at == text_pos) return i + 1;
        if (!rest) {
            if (!comment && c == '(') comment = true;
            else if (comment && c == ')') comment = false;
            else if (!comment && c == ';') rest = true;
        }
        if (kept) ++at;
    }
    return s.raw_length + 1;
}

} // namespace ngc
