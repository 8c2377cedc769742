/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * fault.cc - where a mistake stands, and what would be right.
 *
 * In:     s.error, s.text, the place where reading stopped or the phase that failed
 * Out:    s.fault
 * Thread: [task]
 */
#include <algorithm>
#include <climits>

#include "remap.hh"
#include "stages.hh"

namespace ngc
{
namespace
{

// ---- place ------------------------------------------------------------------------

// Calls visit(letter, start, end) for each word of the canonical text, outside comments.
template <class Visit> void each_word(const char *t, Visit visit)
{
    int i = 0;
    if (t[i] == '/') ++i;
    while (t[i] && t[i] != ';') {
        if (t[i] == '(') {
            while (t[i] && t[i] != ')') ++i;
            if (t[i]) ++i;
            continue;
        }
        const int start = i++;
        int depth = 0;
        // A word reaches to the next letter outside brackets and names.
        while (t[i] && (depth > 0 || !((t[i] >= 'a' && t[i] <= 'z') || strchr("(;$@^", t[i]) ||
                                       (t[i] == '#' && t[i - 1] != t[start] && i > start + 1)))) {
            if (t[i] == '[' || t[i] == '<') ++depth;
            if (t[i] == ']' || t[i] == '>') --depth;
            ++i;
        }
        if (visit(t[start], start, i)) return;
    }
}

bool find_word(const Setup &s, char letter, double value, int *start, int *end)
{
    bool found = false;
    each_word(s.text, [&](char c, int from, int to) {
        if (c != letter) return false;
        if (value >= 0 && fabs(strtod(s.text + from + 1, nullptr) - value) > 0.01) return false;
        *start = from;
        *end = to;
        return found = true;
    });
    return found;
}

// The word whose effect failed.
bool place_of_phase(const Setup &s, int *start, int *end)
{
    const Block &b = s.block;
    auto g = [&](int group) { return b.g_modes[group] >= 0 && find_word(s, 'g', b.g_modes[group] / 10.0, start, end); };
    auto m = [&](int group) { return b.m_modes[group] >= 0 && find_word(s, 'm', b.m_modes[group], start, end); };
    switch (b.phase) {
    case PHASE_SPINDLE_MODE: return g(GM_SPINDLE_MODE);
    case PHASE_FEED_MODE: return g(GM_FEED);
    case PHASE_F: return find_word(s, 'f', -1, start, end);
    case PHASE_S: return find_word(s, 's', -1, start, end);
    case PHASE_T: return find_word(s, 't', -1, start, end);
    case PHASE_M5: return m(MM_IO);
    case PHASE_M6: return m(MM_TOOL);
    case PHASE_M7: return m(MM_SPINDLE);
    case PHASE_M8: return m(MM_COOLANT);
    case PHASE_M9: return m(MM_OVERRIDE);
    case PHASE_M10: return m(MM_USER);
    case PHASE_PLANE: return g(GM_PLANE);
    case PHASE_UNITS: return g(GM_UNITS);
    case PHASE_COMP:
        return (strstr(s.error.c_str(), "tool ") && find_word(s, 'd', -1, start, end)) || g(GM_COMP);
    case PHASE_TOOL_LENGTH:
        return (strstr(s.error.c_str(), "tool ") && find_word(s, 'h', -1, start, end)) || g(GM_TOOL_LENGTH);
    case PHASE_COORD_SYSTEM: return g(GM_COORD_SYSTEM);
    case PHASE_CONTROL: return g(GM_CONTROL);
    case PHASE_RETRACT: return g(GM_RETRACT);
    case PHASE_GROUP0: return g(GM_MODAL_0);
    case PHASE_G92: return g(GM_G92);
    case PHASE_STOP: return m(MM_STOP);
    case PHASE_MOTION:
        if (g(GM_MOTION)) return true;
        for (int i = 0; i < AXES; ++i)
            if (b.has_axis(i) && find_word(s, AXIS_LETTERS[i], -1, start, end)) return true;
        return false;
    }
    return false;
}

// ---- remedy -------------------------------------------------------------------------

// Edits between two words; two letters swapped count as one.
int distance(std::string_view a, std::string_view b)
{
    std::vector<int> older, old, row(b.size() + 1);
    for (size_t j = 0; j <= b.size(); ++j) row[j] = int(j);
    for (size_t i = 1; i <= a.size(); ++i) {
        older = old;
        old = row;
        row[0] = int(i);
        for (size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({old[j] + 1, row[j - 1] + 1, old[j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], older[j - 2] + 1);
        }
    }
    return row[b.size()];
}

template <class Names> std::string nearest(std::string_view wanted, const Names &names)
{
    std::string best;
    int least = INT_MAX;
    for (const std::string &n : names) {
        const int d = distance(wanted, n);
        if (d < least) least = d, best = n;
    }
    return least <= std::max(1, int(wanted.size()) / 3) ? best : std::string();
}

std::string parameter_fix(Setup &s)
{
    const size_t from = s.error.find('<'), to = s.error.rfind('>');
    if (from == std::string::npos || to == std::string::npos || to <= from) return {};
    const std::string wanted = s.error.substr(from + 1, to - from - 1);
    std::vector<std::string> names;
    for (const auto &e : s.frame().locals) names.push_back(e.name);
    for (const auto &e : s.globals) names.push_back(e.name);
    const std::string near = nearest(wanted, names);
    if (!near.empty()) return "did you mean #<" + near + ">?";
    return "give it a value before it is read: #<" + wanted + "> = ...";
}

std::string function_fix(const Setup &s)
{
    static const std::vector<std::string> names = {"abs", "acos", "asin", "atan", "cos", "exists", "exp",
                                                   "fix", "fup", "ln", "round", "sin", "sqrt", "tan"};
    const char *t = s.text + s.pos;
    size_t n = 0;
    while (t[n] >= 'a' && t[n] <= 'z') ++n;
    const std::string near = nearest(std::string_view(t, n), names);
    return near.empty() ? "functions: abs acos asin atan cos exists exp fix fup ln round sin sqrt tan"
                        : "did you mean " + near + "[...]?";
}

std::string oword_fix(const Setup &s)
{
    static const std::vector<std::string> names = {"sub", "endsub", "call", "do", "while", "repeat", "if", "elseif",
                                                   "else", "endif", "break", "continue", "endwhile", "endrepeat",
                                                   "return"};
    const char *t = s.text + s.word_start;
    size_t n = 0;
    while (t[n] >= 'a' && t[n] <= 'z') ++n;
    const std::string near = nearest(std::string_view(t, n), names);
    return near.empty() ? "commands: sub endsub call do while repeat if elseif else endif break continue return"
                        : "did you mean " + near + "?";
}

std::string character_fix(const Setup &s)
{
    const char c = s.text[s.word_start];
    if (strchr(AXIS_LETTERS, c) && c) return std::string("this machine has no ") + char(c - 32) + " axis";
    if (c == '-' || c == '+' || c == '*') return "put expressions in brackets: X[1-2]";
    if (c == 'o') return "an O word must be the first word of its line";
    if (c == 'n') return "a line number must be the first word of its line";
    if (c == '%') return "a % line is allowed only when the first line of the file is one";
    if (c == '/') return "block delete must be the first character of the line";
    if (c == ')') return "there is no comment to close";
    return {};
}

struct Remedy {
    const char *begins;
    const char *fix;
};

// By the beginning of the message.
const Remedy remedies[] = {
    {"Cannot do g1 with zero feed rate", "set a feed rate with F on this line or before it"},
    {"Cannot make arc with zero feed rate", "set a feed rate with F on this line or before it"},
    {"Cannot feed with zero feed rate", "set a feed rate with F on this line or before it"},
    {"Cannot probe with zero feed rate", "set a feed rate with F on this line or before it"},
    {"F word missing with inverse time", "with G93 every feed move needs its own F: moves a minute"},
    {"R i j k words all missing", "give the centre (I J, K I or J K by plane) or the radius R"},
    {"Mixed radius ijk", "give either R or the centre words, not both"},
    {"Arc radius too small", "R must be at least half the distance from start to end"},
    {"Radius to end of arc",
     "start and end must be equally far from the centre; I J K are relative to the start (G91.1) "
     "or absolute (G90.1)"},
    {"Zero-radius arc", "the centre is the start or the end point; check I J K"},
    {"Current point same as end point", "a full circle needs I J K in place of R"},
    {"Cannot use axis values without", "give a motion code: G0, G1, G2 or G3"},
    {"Unknown g code", "check the number; G codes with one decimal are written G5.1"},
    {"M-code greater than 199", "such codes exist only as remaps: give the machine's INI file ([RS274NGC]REMAP)"},
    {"G-code out of range", "G codes are 0 to 99.9 with at most one decimal"},
    {"Two g codes used", "put them on two lines"},
    {"Two m codes used", "put them on two lines"},
    {"Too many m codes", "at most four M codes fit on a line"},
    {"R clearance plane unspecified", "the first block of a cycle needs R"},
    {"R less than", "R must be above the bottom of the hole"},
    {"Dwell time missing", "G4 P<seconds>"},
    {"P value out of range (0-9)", "P is 1 to 9 for G54 to G59.3, or 0 for the active system"},
    {"Unclosed comment", "close it with )"},
    {"Nested comment", "comments cannot contain ( ; use [ ] or words"},
    {"Unclosed expression", "a ] is missing"},
    {"Command too long", "a line may have 252 characters"},
    {"File ended with no percent sign (%) or", "end the program with M2 or M30"},
    {"File ended with no percent sign", "a file that begins with a % line must end with one"},
    {"Parameter number out of range", "parameters are numbered 1 to 5601"},
    {"Parameter is readonly", "this parameter only reports; copy it to another one"},
    {"Attempt to divide by zero", "test the divisor before: o1 if [#1 NE 0]"},
    {"Length of cutter compensation entry", "make the first move after G41/G42 longer than the tool radius"},
    {"Radius of cutter compensation entry", "make the first move after G41/G42 longer than the tool radius"},
    {"Straight feed in concave corner",
     "the tool is too large for this inside corner; use a smaller one or a larger corner"},
    {"Straight traverse in concave corner",
     "the tool is too large for this inside corner; use a smaller one or a larger corner"},
    {"Arc move in concave corner",
     "the tool is too large for this inside corner; use a smaller one or a larger corner"},
    {"Tool radius not less than arc radius", "the tool is larger than this inside arc"},
    {"The move just after exiting", "make a straight move (G0 or G1) after G40"},
    {"Cannot turn cutter radius comp on when on", "end it with G40 first"},
    {"Must use g0 or g1 with g53", "write G53 G0 or G53 G1 on every line that needs it"},
    {"Cannot use g53 incremental", "use G90 with G53"},
    {"Need tool prepared", "select a tool with T first"},
    {"Equal sign missing", "write #1 = 5 or #<name> = 5"},
    {"Named parameter not terminated", "close the name with >"},
    {"Too many subroutine levels", "calls may be nested nine deep; is a sub calling itself without end?"},
    {"No characters found", "a number or expression is missing at the end of the line"},
    {"Invalid spindle", "spindles are numbered from 0"},
};

void add_fix(Setup &s)
{
    Fault &f = s.fault;
    if (!f.fix.empty()) return;
    const char *e = s.error.c_str();
    auto begins = [&](const char *text) { return strncmp(e, text, strlen(text)) == 0; };
    if (begins("Requested tool")) f.fix = "add the tool to the tool table, or change the number";
    else if (begins("Named parameter #<")) f.fix = parameter_fix(s);
    else if (begins("Unknown word")) f.fix = function_fix(s);
    else if (begins("Unknown control command")) f.fix = oword_fix(s);
    else if (begins("Bad character '") && e[15] != '\\') f.fix = character_fix(s);
    else
        for (const Remedy &r : remedies)
            if (begins(r.begins)) {
                f.fix = r.fix;
                break;
            }
}

} // namespace

void fill_fault_place(Setup &s)
{
    Fault &f = s.fault;
    f.file = s.source >= 0 ? s.sources[size_t(s.source)]->path() : std::string();
    f.line = s.sequence_number;
    f.text = s.raw;
    int start = s.word_start, end = s.pos;
    if (s.block.phase > 0) {
        start = 0;
        end = 0;
        if (!place_of_phase(s, &start, &end)) end = int(strlen(s.text));
    }
    f.column = raw_column(s, start);
    if (f.column > s.raw_length && s.raw_length > 0) f.column = s.raw_length;
    int after = end > start ? raw_column(s, end - 1) + 1 : f.column + 1;
    if (after > s.raw_length + 1) after = s.raw_length + 1;
    f.length = after > f.column ? after - f.column : 1;
    add_fix(s);
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
