/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * parse.cc - the text of one canonical call.
 *
 * Line:   [number] [N field] NAME ( arguments ) [; comment]
 *         N field: "N....." or "N" with digits, filled up with blanks
 *         arguments: numbers and words between commas or blanks, or one text between quotes
 */
#include <charconv>
#include <cmath>
#include <cstring>
#include <iterator>

#include "canterp.hh"

namespace canterp
{
namespace
{

constexpr double MOST_INTEGER = 2147483647.0;

struct Word {
    char kind; // as in Call::arguments
    const char *name;
    int value;
};

const Word words[] = {
    {'U', "CANON_UNITS_INCHES", CANON_UNITS_INCHES}, {'U', "CANON_UNITS_MM", CANON_UNITS_MM},
    {'P', "CANON_PLANE_XY", CANON_PLANE_XY}, {'P', "CANON_PLANE_YZ", CANON_PLANE_YZ},
    {'P', "CANON_PLANE_XZ", CANON_PLANE_XZ}, {'P', "CANON_PLANE_UV", CANON_PLANE_UV},
    {'P', "CANON_PLANE_VW", CANON_PLANE_VW}, {'P', "CANON_PLANE_UW", CANON_PLANE_UW},
    {'P', "CANON_PLANE_UNKNOWN", CANON_PLANE_UV}, // as these three are printed
    {'M', "CANON_EXACT_STOP", CANON_EXACT_STOP}, {'M', "CANON_EXACT_PATH", CANON_EXACT_PATH},
    {'M', "CANON_CONTINUOUS", CANON_CONTINUOUS}, {'R', "CANON_WORKPIECE", CANON_WORKPIECE},
    {'R', "CANON_XYZ", CANON_XYZ}, {'S', "LEFT", CANON_SIDE_LEFT}, {'S', "RIGHT", CANON_SIDE_RIGHT},
    {'A', "CANON_AXIS_X", CANON_AXIS_X}, {'A', "CANON_AXIS_Y", CANON_AXIS_Y}, {'A', "CANON_AXIS_Z", CANON_AXIS_Z},
    {'A', "CANON_AXIS_A", CANON_AXIS_A}, {'A', "CANON_AXIS_B", CANON_AXIS_B}, {'A', "CANON_AXIS_C", CANON_AXIS_C},
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_name(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || is_digit(c) || c == '_' || c == '.'; }
bool is_blank(char c) { return c == ' ' || c == '\t'; }

class Reader
{
  public:
    Reader(std::string_view t, int s, Line *l, Mistake *m) : text(t), spindles(s), line(l), mistake(m) {}

    bool read()
    {
        blanks();
        if (at_end() || strchr(";#(", peek())) return line->field = at, true;
        prefix();
        const size_t start = at;
        while (!at_end() && is_name(peek())) ++at;
        std::string name(text.substr(start, at - start));
        std::string spindle;
        if (name.compare(0, 8, "SPINDLE.") == 0) { // SPINDLE.0.WAIT_ORIENT_COMPLETE
            const size_t dot = name.find('.', 8);
            if (dot != name.npos && name.substr(dot) == ".WAIT_ORIENT_COMPLETE") {
                spindle = name.substr(8, dot - 8);
                name = "WAIT_SPINDLE_ORIENT_COMPLETE";
            }
        }
        if (name.empty())
            return wrong(start, 1, "There is no canonical call on this line", "known calls: " + known_calls());
        const Call *call = find_call(name);
        if (!call)
            return wrong(start, at - start, "Unknown canonical call '" + name + "'" + nearest_call(name),
                         "known calls: " + known_calls());
        blanks();
        if (at_end() || peek() != '(') return wrong(at, 1, "'(' is missing behind " + name, form(*call));
        ++at;
        if (!spindle.empty()) tokens.push_back({start + 8, spindle});
        if (*call->arguments == 't' || *call->arguments == 'e') {
            if (!take_text(*call)) return false;
        } else if (!take_tokens(*call) || !fit(*call, start)) {
            return false;
        }
        blanks();
        if (!at_end() && peek() != ';')
            return wrong(at, text.size() - at, "Nothing may stand behind the call", form(*call));
        line->call = call;
        return true;
    }

  private:
    struct Token {
        size_t at;
        std::string text;
    };

    bool at_end() const { return at >= text.size(); }
    char peek() const { return text[at]; }
    void blanks()
    {
        while (!at_end() && is_blank(peek())) ++at;
    }
    bool wrong(size_t column, size_t length, const std::string &what, const std::string &fix)
    {
        *mistake = {column, length, what, fix};
        return false;
    }

    // The number of the line, and the N field.
    void prefix()
    {
        size_t p = at;
        while (p < text.size() && is_digit(text[p])) ++p;
        if (p > at && p < text.size() && is_blank(text[p])) {
            at = p;
            blanks();
        }
        line->field = at;
        if (at_end() || peek() != 'N') return;
        p = at + 1;
        if (text.compare(p, 5, ".....") == 0) {
            p += 5;
            line->field = p; // it stands for a line without a number
        } else {
            while (p < text.size() && is_digit(text[p])) ++p;
            if (p == at + 1 && p < text.size() && !is_blank(text[p])) return; // a name that begins with N
        }
        at = p;
        blanks();
        if (text.compare(at, 9, "saicanon ") == 0) at += 9;
    }

    static std::string form(const Call &call)
    {
        std::string out = "as in ";
        for (const char *a = call.arguments;; ++a) {
            out += std::string(call.name) + "(";
            for (bool first = true; *a && *a != '|'; ++a, first = false) {
                if (!first) out += ", ";
                switch (*a) {
                case 'n': out += "1.5"; break;
                case 't': out += "\"text\""; break;
                case 'e': out += "text"; break;
                case 'i': case 'z': case 'b': case 'g': out += "1"; break;
                case 's': out += "0"; break;
                default: out += word_list(*a, "|");
                }
            }
            out += ")";
            if (!*a) return out;
            out += " or ";
        }
    }

    static std::string word_list(char kind, const char *between)
    {
        std::string out;
        for (const Word &w : words)
            if (w.kind == kind) out += (out.empty() ? "" : between) + std::string(w.name);
        return out;
    }

    bool take_text(const Call &call)
    {
        const size_t close = text.rfind(')');
        if (close == text.npos || close < at)
            return wrong(text.size() ? text.size() - 1 : 0, 1, "')' is missing at the end", form(call));
        size_t first = at, end = close;
        if (*call.arguments == 't') {
            if (end < first + 2 || text[first] != '"' || text[end - 1] != '"')
                return wrong(first, end > first ? end - first : 1, "The text stands between quotes", form(call));
            ++first, --end;
        }
        line->arguments.text.assign(text.substr(first, end - first));
        at = close + 1;
        return true;
    }

    bool take_tokens(const Call &call)
    {
        for (;;) {
            blanks();
            if (!at_end() && peek() == ')') return ++at, true;
            if (!at_end() && !tokens.empty() && peek() == ',') {
                ++at;
                blanks();
            }
            const size_t start = at;
            while (!at_end() && !is_blank(peek()) && peek() != ',' && peek() != ')') ++at;
            if (at == start)
                return wrong(start, 1, at_end() ? "')' is missing at the end" : "A value is missing", form(call));
            const size_t sign = text.substr(start, at - start).find('='); // type=1
            const size_t value = sign == text.npos ? start : start + sign + 1;
            tokens.push_back({value, std::string(text.substr(value, at - value))});
        }
    }

    // The values as one of the ways to call it wants them.
    bool fit(const Call &call, size_t start)
    {
        for (const char *way = call.arguments;;) {
            const size_t count = strcspn(way, "|");
            if (count == tokens.size()) {
                for (size_t i = 0; i < count; ++i)
                    if (!value(call, way[i], tokens[i])) return false;
                return true;
            }
            if (!way[count]) break;
            way += count + 1;
        }
        return wrong(start, at - start,
                     std::string(call.name) + " has not " + std::to_string(tokens.size()) + " values", form(call));
    }

    bool value(const Call &call, char kind, const Token &token)
    {
        const std::string &t = token.text;
        for (const Word &w : words)
            if (w.kind == kind && t == w.name) return line->arguments.v.push_back(w.value), true;
        const auto bad = [&](const std::string &wanted) {
            return wrong(token.at, t.empty() ? 1 : t.size(), std::string(call.name) + ": '" + t + "' is not " + wanted,
                         form(call));
        };
        if (strchr("UPMRSA", kind)) return bad("one of " + word_list(kind, " "));
        double number = 0;
        const auto [end, status] = std::from_chars(t.data() + (t[0] == '+'), t.data() + t.size(), number);
        if (status != std::errc() || end != t.data() + t.size() || !std::isfinite(number)) return bad("a number");
        if (kind == 'n') return line->arguments.v.push_back(number), true;
        if (number != std::floor(number) || std::fabs(number) > MOST_INTEGER) return bad("an integer");
        if (kind == 'b' && number != 0 && number != 1) return bad("0 or 1");
        if (kind == 'g' && (number < 1 || number > 9)) return bad("a coordinate system from 1 (G54) to 9 (G59.3)");
        if (kind == 's' && (number < 0 || number >= spindles))
            return bad("a spindle of this machine, 0 to " + std::to_string(spindles - 1));
        if (kind == 'i' && number < 0) return bad("an integer from 0 on");
        return line->arguments.v.push_back(number), true;
    }

    std::string_view text;
    int spindles;
    Line *line;
    Mistake *mistake;
    size_t at = 0;
    std::vector<Token> tokens;
};

} // namespace

bool parse(std::string_view text, int spindles, Line *line, Mistake *mistake)
{
    line->call = nullptr;
    line->arguments.v.clear();
    line->arguments.text.clear();
    return Reader(text, spindles, line, mistake).read();
}

} // namespace canterp
