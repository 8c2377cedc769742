// SPDX-License-Identifier: GPL-2.0-or-later
//
// inifile.cc - parser and queries of INI files. Grammar: INI reference, sections 1 and 2.

#include "inifile.hh"
#include "inifile.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <locale.h>
#include <mutex>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <unordered_map>

namespace linuxcnc
{

struct IniFile::Content {
    std::vector<IniVariable> variables;         // grouped by section, each in order of appearance
    std::vector<std::string> sections;          // in order of first appearance
    std::vector<size_t> file_order;             // indices into variables, as they stand in the file
    std::unordered_map<std::string, std::vector<size_t>> by_name;    // "SECTION]TAG", file order
    std::unordered_map<std::string, std::vector<size_t>> by_tag;     // any section, file order
    std::unordered_map<std::string, std::vector<size_t>> by_section; // file order
};

namespace
{

constexpr char BLANKS[] = " \t\v\f\r\n";
constexpr size_t MAX_INCLUDE_STACK = 16; // the main file counts as one

bool is_blank(char c)
{
    return c && strchr(BLANKS, c);
}
bool is_alpha(char c)
{
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
}
bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

std::string_view rtrim(std::string_view s)
{
    auto end = s.find_last_not_of(BLANKS);
    return end == s.npos ? std::string_view() : s.substr(0, end + 1);
}
std::string_view ltrim(std::string_view s)
{
    auto begin = s.find_first_not_of(BLANKS);
    return begin == s.npos ? std::string_view() : s.substr(begin);
}
std::string_view trimmed(std::string_view s)
{
    return ltrim(rtrim(s));
}

bool identifier_ok(std::string_view s)
{
    return !s.empty() && std::all_of(s.begin(), s.end(), [](char c) { return is_alpha(c) || is_digit(c); });
}

__attribute__((format(printf, 1, 2))) void report(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vfprintf(stderr, format, args);
    va_end(args);
    fputc('\n', stderr);
}

void append_utf8(std::string &out, uint32_t c)
{
    if (c < 0x80) {
        out += char(c);
    } else if (c < 0x800) {
        out += char(0xC0 | c >> 6);
        out += char(0x80 | (c & 0x3F));
    } else if (c < 0x10000) {
        out += char(0xE0 | c >> 12);
        out += char(0x80 | (c >> 6 & 0x3F));
        out += char(0x80 | (c & 0x3F));
    } else {
        out += char(0xF0 | c >> 18);
        out += char(0x80 | (c >> 12 & 0x3F));
        out += char(0x80 | (c >> 6 & 0x3F));
        out += char(0x80 | (c & 0x3F));
    }
}

/// Strict UTF-8: no overlong forms, no surrogates, nothing above 10FFFF (RFC 3629).
bool utf8_ok(std::string_view s)
{
    for (size_t i = 0; i < s.size();) {
        unsigned char c = s[i];
        int more = c < 0x80                ? 0
                   : c >= 0xC2 && c < 0xE0 ? 1
                   : c >= 0xE0 && c < 0xF0 ? 2
                   : c >= 0xF0 && c < 0xF5 ? 3
                                           : -1;
        if (more < 0 || i + more >= s.size() + (more == 0)) return false;
        uint32_t point = more == 0 ? c : c & (0x3F >> more);
        for (int k = 1; k <= more; k++) {
            if (i + k >= s.size() || (s[i + k] & 0xC0) != 0x80) return false;
            point = point << 6 | (s[i + k] & 0x3F);
        }
        if ((more == 2 && point < 0x800) || (more == 3 && (point < 0x10000 || point > 0x10FFFF)) ||
            (point >= 0xD800 && point < 0xE000))
            return false;
        i += 1 + more;
    }
    return true;
}

/// The four or eight hex digits after \u, \U or \x; nullopt when one is not a hex digit.
std::optional<uint32_t> hex_number(std::string_view digits)
{
    uint32_t value = 0;
    for (char c : digits) {
        int d = is_digit(c) ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
        if (d < 0) return std::nullopt;
        value = value << 4 | uint32_t(d);
    }
    return value;
}

class Parser
{
  public:
    explicit Parser(IniFile::Content &content) : out(content) {}
    bool parse_file(const std::string &path);

  private:
    bool error(const char *format, ...) __attribute__((format(printf, 2, 3)));
    void warning(const char *format, ...) __attribute__((format(printf, 2, 3)));
    bool line(std::string_view text);
    bool include(std::string_view rest);
    bool name_ok(const char *kind, const std::string &name);
    bool section(std::string_view text);
    bool variable(std::string_view text);
    bool unescape(std::string_view in, std::string &result);
    bool utf16_escape(std::string_view in, size_t &i, std::string &result);

    IniFile::Content &out;
    std::vector<std::string> stack; // paths of the files being read
    std::vector<int> lines;         // line number in each of them
    std::string current;            // section; empty before the first
};

bool Parser::error(const char *format, ...)
{
    fprintf(stderr, "%s:%d: error: ", stack.back().c_str(), lines.back());
    va_list args;
    va_start(args, format);
    vfprintf(stderr, format, args);
    va_end(args);
    fputc('\n', stderr);
    return false;
}

void Parser::warning(const char *format, ...)
{
    fprintf(stderr, "%s:%d: warning: ", stack.back().c_str(), lines.back());
    va_list args;
    va_start(args, format);
    vfprintf(stderr, format, args);
    va_end(args);
    fputc('\n', stderr);
}

std::optional<std::string> read_whole(const std::string &path)
{
    auto fail = [&](const char *what) {
        report("%s: error: %s ini-file (errno=%d (%s))", path.c_str(), what, errno, strerror(errno));
        return std::nullopt;
    };
    int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) return fail("Cannot open");
    struct stat st;
    if (fstat(fd, &st) < 0) {
        auto r = fail("Cannot stat");
        close(fd);
        return r;
    }
    std::string text(size_t(st.st_size), '\0');
    size_t have = 0;
    while (have < text.size()) {
        ssize_t n = read(fd, text.data() + have, text.size() - have);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) {
            auto r = fail("Cannot read");
            close(fd);
            return r;
        }
        if (n == 0) break;
        have += size_t(n);
    }
    char probe;
    if (S_ISDIR(st.st_mode) && read(fd, &probe, 1) < 0) {
        auto r = fail("Cannot read");
        close(fd);
        return r;
    }
    close(fd);
    if (have != text.size()) {
        report("%s: error: Cannot read complete ini-file. Data read (%zu) != file size (%zu)", path.c_str(), have,
               text.size());
        return std::nullopt;
    }
    if (text.compare(0, 3, "\xEF\xBB\xBF") == 0) text.erase(0, 3); // byte order mark of some editors
    return text;
}

bool Parser::parse_file(const std::string &path)
{
    auto text = read_whole(path);
    if (!text) return false;
    stack.push_back(path);
    lines.push_back(0);
    std::string joined;
    bool continued = false;
    for (size_t at = 0; at < text->size();) {
        size_t end = text->find('\n', at);
        bool last = end == text->npos;
        std::string_view physical(text->data() + at, (last ? text->size() : end) - at);
        at = last ? text->size() : end + 1;
        lines.back()++;
        physical = rtrim(physical);
        bool more = !physical.empty() && physical.back() == '\\';
        if (more) physical.remove_suffix(1);
        if (continued || more) {
            joined.append(physical);
            if (more) {
                if (at >= text->size()) return error("Last line has a continuation");
                continued = true;
                continue;
            }
            continued = false;
            std::string whole;
            whole.swap(joined);
            if (!line(rtrim(whole))) return false;
            continue;
        }
        if (!line(physical)) return false;
    }
    stack.pop_back();
    lines.pop_back();
    return true;
}

bool Parser::line(std::string_view text)
{
    if (text.substr(0, 8) == "#INCLUDE") return include(text.substr(8));
    std::string_view s = ltrim(text);
    if (s.empty() || s[0] == '#' || s[0] == ';') return true;
    return s[0] == '[' ? section(s) : variable(s);
}

bool Parser::include(std::string_view rest)
{
    if (rest.empty() || (rest[0] != ' ' && rest[0] != '\t')) return error("Missing filename after #INCLUDE");
    std::string name(trimmed(rest));
    if (name.empty()) return error("Missing filename after #INCLUDE");
    auto expanded = IniFile::tildeExpand(name);
    if (!expanded) return error("Failed to tilde-expand '%s'", name.c_str());
    name = *expanded;
    if (name[0] != '/') {
        auto slash = stack.back().rfind('/');
        if (slash != std::string::npos) name = stack.back().substr(0, slash + 1) + name;
    }
    if (std::find(stack.begin(), stack.end(), name) != stack.end())
        return error("Include file recursion on loading '%s'", name.c_str());
    if (stack.size() + 1 >= MAX_INCLUDE_STACK)
        return error("Maximum include depth (%zu) reached on loading '%s'", MAX_INCLUDE_STACK, name.c_str());
    const size_t depth = stack.size();
    if (parse_file(name)) return true;
    if (stack.size() == depth)
        report("%s:%d: error: it is included here", stack.back().c_str(), lines.back()); // never opened
    return false;
}

// Older configurations have names such as start-pause, 4th or home.x: they are taken, with a warning.
bool Parser::name_ok(const char *kind, const std::string &name)
{
    if (identifier_ok(name) && !is_digit(name[0])) return true;
    std::string plain = name;
    for (char &c : plain)
        if (c == '-' || c == '.') c = '_';
    if (!identifier_ok(plain)) return false;
    // Documented ones need no warning: sections of drivers, and the pendant's buttons.
    if (name == "XHC-HB04" || name == "VFD-B" || current == "XHC_HB04_BUTTONS") return true;
    warning("Unusual %s '%s': letters, digits and underscores, no digit first, are understood everywhere", kind,
            name.c_str());
    return true;
}

bool Parser::section(std::string_view text)
{
    auto close = text.find(']');
    if (close == text.npos) return error("Invalid section. Missing ']'");
    std::string name(trimmed(text.substr(1, close - 1)));
    if (name.empty()) return error("Invalid section. No content between '[' and ']'");
    if (!name_ok("section", name))
        return error("Invalid section '%s'. Identifier contains invalid character(s)", name.c_str());
    std::string_view rest = trimmed(text.substr(close + 1));
    if (!rest.empty() && rest[0] != '#' && rest[0] != ';') warning("Section header has trailing content, ignored");
    if (std::find(out.sections.begin(), out.sections.end(), name) != out.sections.end())
        warning("Section '%s' already exists. Merging...", name.c_str());
    else
        out.sections.push_back(name);
    current = name;
    return true;
}

bool Parser::variable(std::string_view text)
{
    auto equals = text.find('=');
    std::string name(trimmed(text.substr(0, equals)));
    if (equals == text.npos) return error("Invalid tag '%s'. Expected '=' after tag identifier", name.c_str());
    if (name.empty()) return error("Invalid tag. Missing identifier before '='");
    if (!name_ok("tag", name))
        return error("Invalid tag name '%s'. Identifier contains invalid character(s)", name.c_str());
    if (current.empty()) return error("Tag '%s' found without prior section definition", name.c_str());
    std::string value;
    if (!unescape(trimmed(text.substr(equals + 1)), value)) return false;
    out.variables.push_back({current, name, std::move(value), stack.back(), lines.back()});
    return true;
}

bool Parser::utf16_escape(std::string_view in, size_t &i, std::string &result)
{
    // in[i] is the first digit after \u.
    if (in.size() - i < 4) return error("Improper UTF-16 escape");
    std::string digits(in.substr(i, 4));
    auto high = hex_number(digits);
    if (!high) return error("Invalid hex value '%s' in UTF-16 escape", digits.c_str());
    if (*high == 0) return error("Embedded UTF-16 NUL character not supported");
    i += 4;
    uint32_t point = *high;
    if (point >= 0xDC00 && point < 0xE000) return error("Invalid high surrogate value u%s in UTF-16", digits.c_str());
    if (point >= 0xD800 && point < 0xDC00) {
        if (in.substr(i, 2) != "\\u" || in.size() - i < 6) return error("Missing low surrogate in UTF-16");
        digits = in.substr(i + 2, 4);
        auto low = hex_number(digits);
        if (!low) return error("Invalid hex '%s' in UTF-16 low surrogate escape", digits.c_str());
        if (*low < 0xDC00 || *low >= 0xE000) return error("Invalid low surrogate value u%s in UTF-16", digits.c_str());
        i += 6;
        point = 0x10000 + ((point - 0xD800) << 10) + (*low - 0xDC00);
    }
    append_utf8(result, point);
    return true;
}

bool Parser::unescape(std::string_view in, std::string &result)
{
    if (in.find('\0') != in.npos) return error("Embedded literal NUL character not supported");
    for (size_t i = 0; i < in.size();) {
        if (in[i] != '\\' || i + 1 >= in.size()) {
            result += in[i++];
            continue;
        }
        char c = in[i + 1];
        i += 2;
        static constexpr char letters[] = "abfnrtv\\", meant[] = "\a\b\f\n\r\t\v\\";
        if (const char *p = strchr(letters, c)) {
            result += meant[p - letters];
        } else if (c >= '0' && c <= '7') {
            unsigned value = unsigned(c - '0');
            int most = c <= '3' ? 3 : 2;
            for (int n = 1; n < most && i < in.size() && in[i] >= '0' && in[i] <= '7'; n++)
                value = value * 8 + unsigned(in[i++] - '0');
            if (value == 0) return error("Embedded octal NUL character not supported");
            result += char(value);
        } else if (c == 'x') {
            if (in.size() - i < 2) return error("Improper hex escape");
            std::string digits(in.substr(i, 2));
            auto value = hex_number(digits);
            if (!value) return error("Invalid hex '%s' in hex escape", digits.c_str());
            if (*value == 0) return error("Embedded hex NUL character not supported");
            result += char(*value);
            i += 2;
        } else if (c == 'u') {
            if (!utf16_escape(in, i, result)) return false;
        } else if (c == 'U') {
            if (in.size() - i < 8) return error("Improper UTF-32 escape");
            std::string digits(in.substr(i, 8));
            auto value = hex_number(digits);
            if (!value) return error("Invalid hex value '%s' in UTF-32 escape", digits.c_str());
            if (*value == 0) return error("Embedded UTF-32 NUL character not supported");
            if (*value > 0x10FFFF) return error("Invalid code point U%s in UTF-32 escape", digits.c_str());
            append_utf8(result, *value);
            i += 8;
        } else {
            warning("Improper escape of '%c', ignored", c);
            result += '\\';
            result += c;
        }
    }
    if (!utf8_ok(result)) return error("Value contains invalid UTF-8 sequence");
    return true;
}

/// Text for messages: the place and the name of a variable.
std::string place(const IniVariable &v)
{
    return v.file + ":" + std::to_string(v.line);
}

/// Warns when a converted number is followed by something other than a blank.
void check_trailing(const IniVariable &v, size_t used, const char *type)
{
    if (used < v.value.size() && !is_blank(v.value[used]))
        report("%s: warning: Trailing character(s) in %s conversion ([%s]%s='%s')", place(v).c_str(), type,
               v.section.c_str(), v.name.c_str(), v.value.c_str());
}

struct Magnitude {
    uint64_t value;
    bool negative;
    size_t used;
};

/// Optional sign and digits in base 10, or 16, 8, 2 after 0x, 0o, 0b. nullopt: no digit, or beyond 64 bits.
std::optional<Magnitude> magnitude(const std::string &text)
{
    size_t i = text.find_first_not_of(BLANKS);
    if (i == text.npos) return std::nullopt;
    Magnitude m{0, false, 0};
    if (text[i] == '+' || text[i] == '-') m.negative = text[i++] == '-';
    unsigned base = 10;
    if (i + 1 < text.size() && text[i] == '0') {
        switch (text[i + 1] | 0x20) {
        case 'x': base = 16; break;
        case 'o': base = 8; break;
        case 'b': base = 2; break;
        }
        if (base != 10) i += 2;
    }
    size_t first = i;
    for (; i < text.size(); i++) {
        char c = text[i];
        unsigned d = is_digit(c) ? unsigned(c - '0') : is_alpha(c) && c != '_' ? unsigned((c | 0x20) - 'a') + 10 : 99;
        if (d >= base) break;
        if (m.value > (UINT64_MAX - d) / base) return std::nullopt;
        m.value = m.value * base + d;
    }
    if (i == first) return std::nullopt;
    m.used = i;
    return m;
}

std::optional<int64_t> to_signed(const std::string &text, size_t *used)
{
    auto m = magnitude(text);
    if (!m || m->value > uint64_t(INT64_MAX) + (m->negative ? 1 : 0)) return std::nullopt;
    if (used) *used = m->used;
    return m->negative ? int64_t(-m->value) : int64_t(m->value);
}

std::optional<double> to_real(const std::string &text, size_t *used)
{
    static locale_t c_locale = newlocale(LC_NUMERIC_MASK, "C", locale_t(0));
    char *end;
    errno = 0;
    double value = strtod_l(text.c_str(), &end, c_locale);
    if (end == text.c_str() || errno == ERANGE) return std::nullopt;
    if (used) *used = size_t(end - text.c_str());
    return value;
}

template <class T> std::optional<T> in_range(std::optional<T> value, T min, T max)
{
    return value && *value >= min && *value <= max ? value : std::nullopt;
}

// Conversion of one variable, with messages.
std::optional<bool> bool_of(const IniVariable &v)
{
    auto value = IniFile::convertBool(v.value);
    if (!value)
        report("%s: error: Invalid boolean value [%s]%s='%s'", place(v).c_str(), v.section.c_str(), v.name.c_str(),
               v.value.c_str());
    return value;
}

std::optional<int64_t> signed_of(const IniVariable &v)
{
    size_t used;
    auto value = to_signed(v.value, &used);
    if (!value)
        report("%s: error: Invalid signed integer [%s]%s='%s'", place(v).c_str(), v.section.c_str(), v.name.c_str(),
               v.value.c_str());
    else
        check_trailing(v, used, "signed integer");
    return value;
}

std::optional<uint64_t> unsigned_of(const IniVariable &v)
{
    auto m = magnitude(v.value);
    if (!m) {
        report("%s: error: Invalid unsigned integer [%s]%s='%s'", place(v).c_str(), v.section.c_str(), v.name.c_str(),
               v.value.c_str());
        return std::nullopt;
    }
    if (m->negative)
        report("%s: warning: Unsigned integer conversion detected a leading minus sign (-)", place(v).c_str());
    check_trailing(v, m->used, "unsigned integer");
    return m->negative ? -m->value : m->value;
}

std::optional<double> real_of(const IniVariable &v)
{
    size_t used;
    auto value = to_real(v.value, &used);
    if (!value)
        report("%s: error: Invalid floating point [%s]%s='%s'", place(v).c_str(), v.section.c_str(), v.name.c_str(),
               v.value.c_str());
    else
        check_trailing(v, used, "floating point");
    return value;
}

/// All variables that a query with these names may meet, in file order.
const std::vector<size_t> *matches(const IniFile::Content &c, const std::string &tag, const std::string &section)
{
    if (tag.empty() && section.empty()) return &c.file_order;
    const auto &map = tag.empty() ? c.by_section : section.empty() ? c.by_tag : c.by_name;
    auto found = map.find(tag.empty() ? section : section.empty() ? tag : section + "]" + tag);
    return found == map.end() ? nullptr : &found->second;
}

template <class T, class F>
std::vector<T> all_of_type(const IniFile::Content *c, const std::string &tag, const std::string &section, F convert)
{
    std::vector<T> values;
    if (!c) return values;
    if (auto list = matches(*c, tag, section))
        for (size_t i : *list)
            if (auto value = convert(c->variables[i])) values.push_back(*value);
    return values;
}

} // namespace

bool IniFile::open(const std::string &name)
{
    static std::mutex lock;
    static std::unordered_map<std::string, std::shared_ptr<const Content>> loaded;
    std::lock_guard<std::mutex> guard(lock);
    path = name;
    auto &slot = loaded[name];
    if (!slot) {
        auto fresh = std::make_shared<Content>();
        if (!Parser(*fresh).parse_file(name)) {
            loaded.erase(name);
            content.reset();
            return false;
        }
        for (size_t i = 0; i < fresh->variables.size(); i++) {
            auto &v = fresh->variables[i];
            fresh->file_order.push_back(i);
            fresh->by_name[v.section + "]" + v.name].push_back(i);
            fresh->by_tag[v.name].push_back(i);
            fresh->by_section[v.section].push_back(i);
        }
        slot = fresh;
    }
    content = slot;
    return true;
}

const IniVariable *IniFile::find(int num, const std::string &tag, const std::string &section) const
{
    if (!content) return nullptr;
    if (num < 1) {
        if (section.empty()) return nullptr;
        num = 1;
    }
    auto list = matches(*content, tag, section);
    return list && size_t(num) <= list->size() ? &content->variables[(*list)[size_t(num) - 1]] : nullptr;
}

std::optional<std::string> IniFile::findString(int num, const std::string &tag, const std::string &section) const
{
    auto v = find(num, tag, section);
    return v ? std::optional(v->value) : std::nullopt;
}
std::optional<bool> IniFile::findBool(int num, const std::string &tag, const std::string &section) const
{
    auto v = find(num, tag, section);
    return v ? bool_of(*v) : std::nullopt;
}
std::optional<int64_t> IniFile::findSInt(int num, const std::string &tag, const std::string &section, int64_t min,
                                         int64_t max) const
{
    auto v = find(num, tag, section);
    return v ? in_range(signed_of(*v), min, max) : std::nullopt;
}
std::optional<uint64_t> IniFile::findUInt(int num, const std::string &tag, const std::string &section, uint64_t min,
                                          uint64_t max) const
{
    auto v = find(num, tag, section);
    return v ? in_range(unsigned_of(*v), min, max) : std::nullopt;
}
std::optional<double> IniFile::findReal(int num, const std::string &tag, const std::string &section, double min,
                                        double max) const
{
    auto v = find(num, tag, section);
    return v ? in_range(real_of(*v), min, max) : std::nullopt;
}
std::optional<int> IniFile::findInt(int num, const std::string &tag, const std::string &section, int min, int max) const
{
    auto value = findSInt(num, tag, section, min, max);
    return value ? std::optional(int(*value)) : std::nullopt;
}

std::vector<std::string> IniFile::findStringAll(const std::string &tag, const std::string &section) const
{
    return all_of_type<std::string>(content.get(), tag, section,
                                    [](const IniVariable &v) { return std::optional(v.value); });
}
std::vector<bool> IniFile::findBoolAll(const std::string &tag, const std::string &section) const
{
    return all_of_type<bool>(content.get(), tag, section, bool_of);
}
std::vector<int64_t> IniFile::findSIntAll(const std::string &tag, const std::string &section, int64_t min,
                                          int64_t max) const
{
    return all_of_type<int64_t>(content.get(), tag, section,
                                [=](const IniVariable &v) { return in_range(signed_of(v), min, max); });
}
std::vector<uint64_t> IniFile::findUIntAll(const std::string &tag, const std::string &section, uint64_t min,
                                           uint64_t max) const
{
    return all_of_type<uint64_t>(content.get(), tag, section,
                                 [=](const IniVariable &v) { return in_range(unsigned_of(v), min, max); });
}
std::vector<double> IniFile::findRealAll(const std::string &tag, const std::string &section, double min,
                                         double max) const
{
    return all_of_type<double>(content.get(), tag, section,
                               [=](const IniVariable &v) { return in_range(real_of(v), min, max); });
}

bool IniFile::hasSection(const std::string &section) const
{
    return content && std::find(content->sections.begin(), content->sections.end(), section) != content->sections.end();
}
std::optional<std::pair<std::string, int>> IniFile::lineOf(const std::string &tag, const std::string &section,
                                                           int num) const
{
    auto v = find(num, tag, section);
    return v ? std::optional(std::pair(v->file, v->line)) : std::nullopt;
}
std::vector<std::string> IniFile::findSections() const
{
    return content ? content->sections : std::vector<std::string>();
}
std::vector<IniVariable> IniFile::findVariables(const std::string &section) const
{
    std::vector<IniVariable> result;
    if (!content) return result;
    if (section.empty()) { // sections in order of first appearance
        for (auto &s : content->sections)
            if (auto list = matches(*content, "", s))
                for (size_t i : *list) result.push_back(content->variables[i]);
    } else if (auto list = matches(*content, "", section)) {
        for (size_t i : *list) result.push_back(content->variables[i]);
    }
    return result;
}

std::optional<double> IniFile::findLinearUnits(const std::string &tag, const std::string &section, int num) const
{
    auto text = findString(num, tag, section);
    return text ? mapLinearUnits(*text) : std::nullopt;
}
std::optional<double> IniFile::findAngularUnits(const std::string &tag, const std::string &section, int num) const
{
    auto text = findString(num, tag, section);
    return text ? mapAngularUnits(*text) : std::nullopt;
}
std::optional<int> IniFile::findJointType(const std::string &tag, const std::string &section, int num) const
{
    auto text = findString(num, tag, section);
    return text ? mapJointType(*text) : std::nullopt;
}

bool IniFile::equalNoCase(std::string_view a, std::string_view b)
{
    return a.size() == b.size() && strncasecmp(a.data(), b.data(), a.size()) == 0;
}
std::optional<bool> IniFile::convertBool(const std::string &text)
{
    for (auto word : {"TRUE", "YES", "ON", "1"})
        if (equalNoCase(text, word)) return true;
    for (auto word : {"FALSE", "NO", "OFF", "0"})
        if (equalNoCase(text, word)) return false;
    return std::nullopt;
}
std::optional<int64_t> IniFile::convertSInt(const std::string &text)
{
    return to_signed(text, nullptr);
}
std::optional<uint64_t> IniFile::convertUInt(const std::string &text)
{
    auto m = magnitude(text);
    return m ? std::optional(m->negative ? -m->value : m->value) : std::nullopt;
}
std::optional<double> IniFile::convertReal(const std::string &text)
{
    return to_real(text, nullptr);
}
std::optional<double> IniFile::mapLinearUnits(const std::string &text)
{
    for (auto word : {"mm", "metric"})
        if (equalNoCase(text, word)) return 1.0;
    for (auto word : {"in", "inch", "imperial"})
        if (equalNoCase(text, word)) return 1.0 / 25.4;
    return std::nullopt;
}
std::optional<double> IniFile::mapAngularUnits(const std::string &text)
{
    for (auto word : {"deg", "degree"})
        if (equalNoCase(text, word)) return 1.0;
    for (auto word : {"grad", "gon"})
        if (equalNoCase(text, word)) return 0.9;
    for (auto word : {"rad", "radian"})
        if (equalNoCase(text, word)) return M_PI / 180.0;
    return std::nullopt;
}
std::optional<int> IniFile::mapJointType(const std::string &text)
{
    if (equalNoCase(text, "LINEAR")) return 1;
    if (equalNoCase(text, "ANGULAR")) return 2;
    return std::nullopt;
}
std::optional<std::string> IniFile::tildeExpand(const std::string &name)
{
    if (name.compare(0, 2, "~/") != 0) return name;
    const char *home = getenv("HOME");
    return home && *home ? std::optional(home + name.substr(1)) : std::nullopt;
}
std::vector<std::string> IniFile::split(const std::string &delimiters, const std::string &text)
{
    std::vector<std::string> parts;
    for (size_t at = 0; (at = text.find_first_not_of(delimiters, at)) != text.npos;) {
        size_t end = text.find_first_of(delimiters, at);
        parts.push_back(text.substr(at, end - at));
        at = end == text.npos ? text.size() : end;
    }
    return parts;
}
std::string IniFile::trim(const std::string &text)
{
    return std::string(trimmed(text));
}

} // namespace linuxcnc

// ---- C interface ------------------------------------------------------------------------------

namespace
{
template <class T, class F> int find_c(const char *path, const char *tag, T *result, F find)
{
    if (!path || !tag || !result) return -EINVAL;
    linuxcnc::IniFile ini(path);
    if (!ini) return -EINVAL;
    auto value = find(ini);
    if (!value) return -ENOENT;
    *result = T(*value);
    return 0;
}
int copy_out(const std::string &text, char *buf, size_t size)
{
    if (text.size() >= size) return -ENOSPC;
    memcpy(buf, text.c_str(), text.size() + 1);
    return 0;
}
} // namespace

extern "C" {

int iniFindString(const char *path, const char *tag, const char *section, char *buf, size_t size)
{
    std::string text;
    if (!buf) return -EINVAL;
    int r = find_c(path, tag, &text, [&](auto &ini) { return ini.findString(1, tag, section ? section : ""); });
    return r ? r : copy_out(text, buf, size);
}
int iniFindBool(const char *path, const char *tag, const char *section, bool *result)
{
    return find_c(path, tag, result, [&](auto &ini) { return ini.findBool(1, tag, section ? section : ""); });
}
int iniFindSInt(const char *path, const char *tag, const char *section, rtapi_s64 *result)
{
    return find_c(path, tag, result, [&](auto &ini) { return ini.findSInt(1, tag, section ? section : ""); });
}
int iniFindUInt(const char *path, const char *tag, const char *section, rtapi_u64 *result)
{
    return find_c(path, tag, result, [&](auto &ini) { return ini.findUInt(1, tag, section ? section : ""); });
}
int iniFindDouble(const char *path, const char *tag, const char *section, double *result)
{
    return find_c(path, tag, result, [&](auto &ini) { return ini.findReal(1, tag, section ? section : ""); });
}
int iniFindInt(const char *path, const char *tag, const char *section, int *result)
{
    return find_c(path, tag, result, [&](auto &ini) { return ini.findSInt(1, tag, section ? section : ""); });
}
int TildeExpansion(const char *file, char *buf, size_t size)
{
    if (!file || !buf) return -EINVAL;
    auto path = linuxcnc::IniFile::tildeExpand(file);
    return path ? copy_out(*path, buf, size) : -ENOENT;
}
}
