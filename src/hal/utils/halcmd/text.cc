/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * text.cc - see text.hh. Each stage reads its input once, from left to right.
 */
#include "text.hh"

#include <cctype>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>

namespace halcmd
{

std::string strf(const char *fmt, ...)
{
    char small[256];
    va_list args;
    va_start(args, fmt);
    int n = vsnprintf(small, sizeof small, fmt, args);
    va_end(args);
    if (n < 0) return "";
    if (static_cast<size_t>(n) < sizeof small) return std::string(small, n);
    std::string big(n + 1, '\0');
    va_start(args, fmt);
    vsnprintf(big.data(), big.size(), fmt, args);
    va_end(args);
    big.resize(n);
    return big;
}

static bool is_blank(char c) { return isspace(static_cast<unsigned char>(c)) != 0; }

static bool is_word(char c)
{
    return isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '_';
}

std::string strip_comment(std::string &line)
{
    char quote = 0;
    for (size_t i = 0; i < line.size(); i++) {
        char c = line[i];
        if (quote) {
            if (c == quote) quote = 0;
        } else if (c == '\'' || c == '"') {
            quote = c;
        } else if (c == '#') {
            line.resize(i);
            return "";
        }
    }
    return quote ? "unterminated quoted string" : "";
}

namespace
{

/// Reads the references of one line; `at` always points to the next character to read.
class Substitution
{
  public:
    Substitution(std::string_view line, const Lookup &lookup) : line(line), lookup(lookup) {}

    std::string run(std::string &out)
    {
        while (at < line.size() && fault.empty()) {
            char c = line[at];
            if (c == '$') {
                at++;
                environment(out);
            } else if (c == '[') {
                at++;
                ini(out);
            } else {
                out += c;
                at++;
            }
            if (out.size() > MAX_SUBSTITUTED && fault.empty()) fault = "Line too long.";
        }
        return fault;
    }

  private:
    std::string_view line;
    const Lookup &lookup;
    size_t at = 0;
    std::string fault;

    bool next_is(char c) const { return at < line.size() && line[at] == c; }

    std::string word()
    {
        size_t start = at;
        while (at < line.size() && is_word(line[at])) at++;
        return std::string(line.substr(start, at - start));
    }

    /// The text up to `close`, which is skipped. Without it: the rest of the line.
    std::string until(char close, bool &closed)
    {
        size_t end = line.find(close, at);
        closed = end != line.npos;
        std::string text(line.substr(at, closed ? end - at : line.npos));
        at = closed ? end + 1 : line.size();
        return text;
    }

    bool usable(const std::string &name)
    {
        if (name.empty()) fault = "Empty variable name.";
        else if (name.size() > MAX_VARIABLE) fault = "Variable name too long.";
        return fault.empty();
    }

    void environment(std::string &out)
    {
        std::string name;
        if (next_is('(')) {
            at++;
            bool closed;
            name = until(')', closed);
            if (!closed) {
                fault = "Missing close parenthesis.";
                return;
            }
        } else {
            name = word();
        }
        if (!usable(name)) return;
        if (auto value = lookup.env(name)) out += *value;
        else fault = strf("Environment variable '%s' not found.", name.c_str());
    }

    void ini(std::string &out)
    {
        bool closed;
        std::string section = until(']', closed);
        if (!closed) {
            fault = "Missing close square bracket.";
            return;
        }
        std::string name;
        if (next_is('(')) {
            at++;
            name = until(')', closed); // a missing ')' takes the rest of the line, as documented
        } else {
            name = word();
        }
        if (section.size() > MAX_VARIABLE) {
            fault = "Variable name too long.";
            return;
        }
        if (!usable(name)) return;
        if (auto value = lookup.ini(section, name)) out += *value;
        else fault = strf("Ini variable '[%s]%s' not found.", section.c_str(), name.c_str());
    }
};

} // namespace

std::string substitute(std::string_view line, const Lookup &lookup, std::string &out)
{
    out.clear();
    return Substitution(line, lookup).run(out);
}

std::string tokenize(std::string_view line, std::vector<std::string> &tokens, bool &dos)
{
    tokens.clear();
    dos = false;
    std::string token;
    bool in_token = false;
    char quote = 0;
    for (size_t i = 0; i < line.size(); i++) {
        char c = line[i];
        if (c == '\r') {
            if (i + 1 != line.size()) return "File contains embedded carriage returns.";
            dos = true;
        }
        if (!quote && is_blank(c)) {
            if (in_token) tokens.push_back(std::move(token));
            token.clear();
            in_token = false;
            if (tokens.size() >= MAX_TOKENS) return "too many tokens on line";
            continue;
        }
        if (quote) {
            if (c == quote) quote = 0;
        } else if (c == '\'' || c == '"') {
            quote = c;
        }
        token += c;
        in_token = true;
    }
    if (quote) return "unterminated quoted string";
    if (in_token) tokens.push_back(std::move(token));
    return tokens.size() > MAX_TOKENS ? "too many tokens on line" : "";
}

bool Joiner::add(std::string_view physical, std::string &line)
{
    bool more = !physical.empty() && physical.back() == '\\';
    if (more) physical.remove_suffix(1);
    if (!continued) joined.clear();
    joined += physical;
    if (joined.size() > MAX_JOINED) joined.resize(MAX_JOINED);
    continued = more;
    if (more) return false;
    line.swap(joined);
    joined.clear();
    return true;
}

std::string tilde_expand(const std::string &text)
{
    if (text.compare(0, 2, "~/") != 0) return text;
    const char *home = getenv("HOME");
    return home ? home + text.substr(1) : text;
}

} // namespace halcmd
