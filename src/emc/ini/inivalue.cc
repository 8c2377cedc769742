// SPDX-License-Identifier: GPL-2.0-or-later
//
// inivalue.cc - prints values, variables and sections of an INI file (INI reference, section 3).
//
// Exit: 0 found; 1 usage or unreadable file; 2 not found; 3 not convertible or out of range.

#include "inifile.hh"

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <getopt.h>

using linuxcnc::IniFile;
using linuxcnc::IniVariable;

namespace
{

enum Exit { FOUND = 0, USAGE = 1, NOT_FOUND = 2, BAD_VALUE = 3 };
enum class BoolText { WORD, NUMBER, PYTHON };

struct Options {
    std::string var, sec, file;
    int num = 1;
    bool num_given = false, all = false, quiet = false, tilde = false;
    bool sections = false, variables = false, content = false, prefix = false;
    char type = 's';
    bool type_given = false;
    std::string min, max;
    BoolText bools = BoolText::WORD;
};

__attribute__((format(printf, 2, 3))) int fail(int status, const char *format, ...)
{
    fputs("error: ", stderr);
    va_list args;
    va_start(args, format);
    vfprintf(stderr, format, args);
    va_end(args);
    fputc('\n', stderr);
    return status;
}

void usage()
{
    puts("Usage: inivalue --var=VARIABLE [--sec=SECTION] [options] INIFILE\n"
         "       inivalue --sections|--variables [options] INIFILE\n"
         "  -V, --var=VARIABLE    variable to look up\n"
         "  -S, --sec=SECTION     section to look in (default: any)\n"
         "  -N, --num=N           N-th occurrence, from 1\n"
         "  -a, --all             all occurrences, a line each (with -N: from the N-th on)\n"
         "  -y, --type=TYPE       int, unsigned, real, string or boolean\n"
         "  -m, --minimum=V, -M, --maximum=V   range of int, unsigned and real (after -y)\n"
         "  -b, --boolnum         booleans as 1 and 0\n"
         "  -B, --boolpy          booleans as True and False\n"
         "  -T, --tildeexpand     '~/x' becomes '$HOME/x'\n"
         "  -q, --quiet           no message when nothing is found\n"
         "  -e, --sections        names of all sections\n"
         "  -o, --variables       names of all variables (of --sec)\n"
         "  -c, --content         with -o: NAME=VALUE, escaped\n"
         "  -p, --prefix          with -o: [SECTION]NAME\n"
         "  -h, --help            this text");
}

/// A value as it could stand in an INI file again.
std::string escaped(const std::string &value)
{
    static constexpr char controls[] = "\a\b\f\n\r\t\v", letters[] = "abfnrtv";
    std::string out;
    for (size_t i = 0; i < value.size(); i++) {
        char c = value[i];
        char hex[8];
        if (c == '\\') {
            out += "\\\\";
        } else if (c == ' ' && (i == 0 || i + 1 == value.size())) {
            out += "\\x20";
        } else if (const char *p = c ? std::char_traits<char>::find(controls, 7, c) : nullptr) {
            out += '\\';
            out += letters[p - controls];
        } else if ((unsigned char)c < 0x20 || c == 0x7F) {
            snprintf(hex, sizeof hex, "\\x%02x", (unsigned char)c);
            out += hex;
        } else {
            out += c;
        }
    }
    return out;
}

const char *bool_text(bool value, BoolText style)
{
    switch (style) {
    case BoolText::NUMBER: return value ? "1" : "0";
    case BoolText::PYTHON: return value ? "True" : "False";
    case BoolText::WORD: break;
    }
    return value ? "true" : "false";
}

struct TypeInfo {
    char letter;
    const char *name; // as in messages
};
constexpr TypeInfo types[] = {{'i', "integer"}, {'u', "unsigned"}, {'r', "real"}, {'s', "string"}, {'b', "boolean"}};

/// Limits in the caller's type; false when min > max or one is not a number.
template <class T, class F> bool limits(const Options &o, T &min, T &max, F convert)
{
    if (!o.min.empty()) {
        auto v = convert(o.min);
        if (!v) return false;
        min = *v;
    }
    if (!o.max.empty()) {
        auto v = convert(o.max);
        if (!v) return false;
        max = *v;
    }
    return min <= max;
}

int print_one(const IniFile &ini, const Options &o)
{
    auto text = ini.findString(o.num, o.var, o.sec);
    if (!text) {
        if (!o.quiet) fail(NOT_FOUND, "Cannot find instance %d of '[%s]%s'", o.num, o.sec.c_str(), o.var.c_str());
        return NOT_FOUND;
    }
    auto bad = [&](const char *type) {
        return fail(BAD_VALUE, "Invalid %s [%s]%s='%s' or out of range [%s,%s]", type, o.sec.c_str(), o.var.c_str(),
                    text->c_str(), o.min.c_str(), o.max.c_str());
    };
    switch (o.type) {
    case 'i': {
        int64_t min = INT64_MIN, max = INT64_MAX;
        auto v = limits(o, min, max, IniFile::convertSInt) ? ini.findSInt(o.num, o.var, o.sec, min, max) : std::nullopt;
        if (!v) return bad("integer");
        printf("%lld\n", (long long)*v);
        break;
    }
    case 'u': {
        uint64_t min = 0, max = UINT64_MAX;
        auto v = limits(o, min, max, IniFile::convertUInt) ? ini.findUInt(o.num, o.var, o.sec, min, max) : std::nullopt;
        if (!v) return bad("unsigned");
        printf("%llu\n", (unsigned long long)*v);
        break;
    }
    case 'r': {
        double max = std::numeric_limits<double>::max(), min = -max;
        auto v = limits(o, min, max, IniFile::convertReal) ? ini.findReal(o.num, o.var, o.sec, min, max) : std::nullopt;
        if (!v) return bad("real");
        printf("%.15e\n", *v);
        break;
    }
    case 'b': {
        auto v = ini.findBool(o.num, o.var, o.sec);
        if (!v) return BAD_VALUE;
        puts(bool_text(*v, o.bools));
        break;
    }
    default:
        if (o.tilde) {
            text = IniFile::tildeExpand(*text);
            if (!text) return fail(USAGE, "Tilde expansion failed: HOME is not set");
        }
        puts(text->c_str());
    }
    return FOUND;
}

int print_all(const IniFile &ini, const Options &o)
{
    std::vector<std::string> lines;
    char buf[64];
    switch (o.type) {
    case 'i': {
        int64_t min = INT64_MIN, max = INT64_MAX;
        if (!limits(o, min, max, IniFile::convertSInt))
            return fail(BAD_VALUE, "Invalid range [%s,%s]", o.min.c_str(), o.max.c_str());
        for (auto v : ini.findSIntAll(o.var, o.sec, min, max)) lines.push_back(std::to_string(v));
        break;
    }
    case 'u': {
        uint64_t min = 0, max = UINT64_MAX;
        if (!limits(o, min, max, IniFile::convertUInt))
            return fail(BAD_VALUE, "Invalid range [%s,%s]", o.min.c_str(), o.max.c_str());
        for (auto v : ini.findUIntAll(o.var, o.sec, min, max)) lines.push_back(std::to_string(v));
        break;
    }
    case 'r': {
        double max = std::numeric_limits<double>::max(), min = -max;
        if (!limits(o, min, max, IniFile::convertReal))
            return fail(BAD_VALUE, "Invalid range [%s,%s]", o.min.c_str(), o.max.c_str());
        for (auto v : ini.findRealAll(o.var, o.sec, min, max)) {
            snprintf(buf, sizeof buf, "%.15g", v);
            lines.push_back(buf);
        }
        break;
    }
    case 'b':
        for (bool v : ini.findBoolAll(o.var, o.sec)) lines.push_back(bool_text(v, BoolText::WORD));
        break;
    default:
        for (auto &v : ini.findStringAll(o.var, o.sec)) {
            auto text = o.tilde ? IniFile::tildeExpand(v) : v;
            if (!text) return fail(USAGE, "Tilde expansion failed: HOME is not set");
            lines.push_back(*text);
        }
    }
    size_t first = o.num > 1 ? size_t(o.num) - 1 : 0;
    if (o.num_given && first >= lines.size()) {
        if (!o.quiet) {
            if (lines.empty())
                fail(NOT_FOUND, "Cannot find any instance of '[%s]%s'", o.sec.c_str(), o.var.c_str());
            else
                fail(NOT_FOUND, "No instance %d or more of '[%s]%s'", o.num, o.sec.c_str(), o.var.c_str());
        }
        return NOT_FOUND;
    }
    for (size_t i = first; i < lines.size(); i++) puts(lines[i].c_str());
    return FOUND;
}

void print_variables(const IniFile &ini, const Options &o)
{
    for (const IniVariable &v : ini.findVariables(o.sec)) {
        std::string line = o.prefix ? "[" + v.section + "]" + v.name : v.name;
        if (o.content) line += "=" + escaped(v.value);
        puts(line.c_str());
    }
}

} // namespace

int main(int argc, char **argv)
{
    static const option longs[] = {
        {"var", 1, nullptr, 'V'},     {"sec", 1, nullptr, 'S'},        {"num", 1, nullptr, 'N'},
        {"all", 0, nullptr, 'a'},     {"type", 1, nullptr, 'y'},       {"minimum", 1, nullptr, 'm'},
        {"maximum", 1, nullptr, 'M'}, {"boolnum", 0, nullptr, 'b'},    {"boolpy", 0, nullptr, 'B'},
        {"quiet", 0, nullptr, 'q'},   {"tildeexpand", 0, nullptr, 'T'}, {"sections", 0, nullptr, 'e'},
        {"content", 0, nullptr, 'c'}, {"variables", 0, nullptr, 'o'},  {"prefix", 0, nullptr, 'p'},
        {"help", 0, nullptr, 'h'},    {nullptr, 0, nullptr, 0}};
    Options o;
    for (int c; (c = getopt_long(argc, argv, "V:S:N:ay:m:M:bBTqeocph", longs, nullptr)) != -1;) {
        switch (c) {
        case 'V': o.var = optarg; break;
        case 'S': o.sec = optarg; break;
        case 'N': {
            char *end;
            long n = strtol(optarg, &end, 0);
            if (end == optarg || *end || n < 1 || n > INT32_MAX)
                return fail(USAGE, "Invalid instance number '%s': expected an integer of 1 or more", optarg);
            o.num = int(n);
            o.num_given = true;
            break;
        }
        case 'a': o.all = true; break;
        case 'y': {
            char letter = char(*optarg | 0x20);
            o.type = 0;
            for (auto &t : types)
                if (t.letter == letter) o.type = letter;
            if (!o.type)
                return fail(USAGE, "Invalid type '%s': expected int, unsigned, real, string or boolean", optarg);
            o.type_given = true;
            break;
        }
        case 'm':
        case 'M':
            if (!o.type_given) return fail(USAGE, "--%s needs --type before it", c == 'm' ? "minimum" : "maximum");
            (c == 'm' ? o.min : o.max) = optarg;
            break;
        case 'b': o.bools = BoolText::NUMBER; break;
        case 'B':
            if (o.bools != BoolText::NUMBER) o.bools = BoolText::PYTHON;
            break;
        case 'T': o.tilde = true; break;
        case 'q': o.quiet = true; break;
        case 'e': o.sections = true; break;
        case 'o': o.variables = true; break;
        case 'c': o.content = true; break;
        case 'p': o.prefix = true; break;
        case 'h': usage(); return USAGE;
        default: return USAGE;
        }
    }
    if (optind >= argc) return fail(USAGE, "Missing ini-file");
    IniFile ini(argv[optind]);
    if (!ini) return USAGE;
    if (o.sections) {
        for (auto &s : ini.findSections()) puts(s.c_str());
        return FOUND;
    }
    if (o.variables) {
        print_variables(ini, o);
        return FOUND;
    }
    return o.all ? print_all(ini, o) : print_one(ini, o);
}
