/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * comments.cc - comments that do something, and the text they expand.
 *
 * In:     the text between the parentheses
 * Out:    canonical calls, output, or an error for (ABORT,...)
 * Thread: [task]
 * Source: G-code sheet, section 5
 */
#include <strings.h>

#include "python_link.hh"
#include "stages.hh"

namespace ngc
{
namespace
{

// Room for the longest line in which every "#1" grows to 29 characters.
enum { EXPANDED = 4096 };

struct Output {
    char text[EXPANDED];
    int length = 0;
    void put(char c)
    {
        if (length < EXPANDED - 1) text[length++] = c;
    }
    void put(const char *s)
    {
        while (*s) put(*s++);
    }
};

// %d, %f and %.Nf choose how the values that follow are written. Returns how many
// characters of `p` the token takes, 0 when it is none.
int format_token(const char *p, const char *end, int *decimals)
{
    if (end - p >= 2 && p[1] == 'd') return *decimals = 0, 2;
    if (end - p >= 2 && p[1] == 'f') return *decimals = 4, 2;
    if (end - p >= 4 && p[1] == '.' && p[2] >= '0' && p[2] <= '9' && p[3] == 'f') return *decimals = p[2] - '0', 4;
    return 0;
}

void put_value(Output &out, double value, int decimals)
{
    char buf[400];
    if (fabs(value) < 1e-6) value = 0;
    int length = snprintf(buf, sizeof buf, "%.*f", decimals, value);
    out.put(length >= 30 ? "######" : buf);
}

void expand(Setup &s, std::string_view text, Output &out)
{
    const char *p = text.data(), *end = p + text.size();
    int decimals = 6;
    while (p < end) {
        if (*p == '%') {
            int taken = format_token(p, end, &decimals);
            if (taken == 0) {
                if (p + 1 < end && p[1] == '.') ++p; // "%." without digit and f: the percent sign is lost
                out.put(*p);
                taken = 1;
            }
            p += taken;
        } else if (*p != '#') {
            out.put(*p++);
        } else if (p + 1 == end) {
            break;
        } else if (p[1] >= '0' && p[1] <= '9') {
            long index = 0;
            for (++p; p < end && *p >= '0' && *p <= '9'; ++p)
                if (index <= MAX_PARAMETER) index = index * 10 + (*p - '0');
            if (index > MAX_PARAMETER) out.put("######");
            else put_value(out, index == 0 ? 0 : parameter_now(s, int(index)), decimals);
        } else if (p[1] == '<') {
            std::string name;
            for (p += 2; p < end && *p != '>'; ++p) {
                if (*p == ' ' || *p == '\t') continue;
                name += *p >= 'A' && *p <= 'Z' && !s.no_downcase_oword ? char(*p + 32) : *p;
            }
            if (p == end) break;
            ++p;
            double value;
            if (named_value(s, name, &value)) put_value(out, value, decimals);
            else out.put("######");
        } else {
            out.put(*p++);
        }
    }
    out.text[out.length] = 0;
}

bool starts(std::string_view text, const char *keyword)
{
    size_t n = strlen(keyword);
    return text.size() >= n && strncasecmp(text.data(), keyword, n) == 0;
}

} // namespace

int execute_comment(Setup &s, std::string_view text)
{
    size_t skip = 0;
    while (skip < text.size() && (text[skip] == ' ' || text[skip] == '\t')) ++skip;
    text.remove_prefix(skip);

    if (starts(text, "MSG,")) {
        s.canon.MESSAGE(std::string(text.substr(4)).c_str());
    } else if (starts(text, "DEBUG,")) {
        Output out;
        expand(s, text.substr(6), out);
        if (s.parameters[P_DEBUG] > 0) s.canon.MESSAGE(out.text);
    } else if (starts(text, "PRINT,")) {
        Output out;
        expand(s, text.substr(6), out);
        s.canon.print_line(out.text);
    } else if (starts(text, "LOG,")) {
        Output out;
        expand(s, text.substr(4), out);
        s.canon.LOG(out.text);
    } else if (starts(text, "LOGOPEN,")) {
        s.canon.LOGOPEN(std::string(text.substr(8)).c_str());
    } else if (starts(text, "LOGAPPEND,")) {
        s.canon.LOGAPPEND(std::string(text.substr(10)).c_str());
    } else if (text.size() == 8 && starts(text, "LOGCLOSE")) {
        s.canon.LOGCLOSE();
    } else if (starts(text, "ABORT,")) {
        Output out;
        expand(s, text.substr(6), out);
        FAIL("%s", out.length ? out.text : "The program ends itself: (ABORT,) without a text");
    } else if (starts(text, "PY,") || starts(text, "PYRUN,")) {
        bool file = starts(text, "PYRUN,");
        std::string code(text.substr(file ? 6 : 3));
        CHECK(!s.python, "py_execute(%s): Python plugin not initialized", code.c_str());
        return s.python->run(s, code.c_str(), file);
    } else if (starts(text, "PYRELOAD")) {
        return s.python ? s.python->reload(s) : int(INTERP_OK);
    } else if (skip + text.size() > 0) {
        enqueue_comment(s, std::string(text).c_str());
    }
    return INTERP_OK;
}

} // namespace ngc
