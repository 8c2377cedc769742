/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * rs274_stages.cc - unit tests of the interpreter's stages, each by itself.
 *
 * Prints one line for each test; exit status 1 when one fails.
 */
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include <unistd.h>

#include "arc.hh"
#include "interp.hh"
#include "rs274_expect.hh"
#include "stages.hh"

using namespace ngc;

namespace
{

class NoMachine : public Canon
{
  public:
    void STRAIGHT_TRAVERSE(int, const EmcPose &) override {}
    void STRAIGHT_FEED(int, const EmcPose &) override {}
    void ARC_FEED(int, double, double, double, double, int, double, const EmcPose &) override {}
    double GET_EXTERNAL_LENGTH_UNITS() override { return 1; }
    EmcPose GET_EXTERNAL_POSITION() override { return EmcPose{}; }
    int GET_EXTERNAL_AXIS_MASK() override { return 0x1ff; }
};

struct Stage {
    NoMachine machine;
    Interp interp{machine};
    Setup &s;
    Stage() : s(interp.setup()) { EXPECT(interp.init(InterpOptions()) == INTERP_OK); }
};

// text.cc: raw line -> canonical text, columns kept
void text()
{
    Stage t;
    struct {
        const char *raw, *canonical;
    } lines[] = {
        {"g0x +0. 12 34y 7", "g0x+0.1234y7"},
        {" G1\tX1\r", "g1x1"},
        {"G1 (Keep THIS) X1 ; And This", "g1(Keep THIS)x1; And This"},
        {"X1 ; a ( b", "x1; a ( b"},
        {"#<A b> = 1", "#<ab>=1"},
        {"", ""},
    };
    for (const auto &l : lines) {
        EXPECT(take_line(t.s, l.raw) == INTERP_OK);
        if (std::string(t.s.text) != l.canonical) printf("'%s' became '%s'\n", l.raw, t.s.text), ++failures;
        EXPECT(std::string(t.s.raw) == l.raw);
    }
    EXPECT(take_line(t.s, "G1 X 1 Y2") == INTERP_OK && raw_column(t.s, 2) == 4 && raw_column(t.s, 4) == 8);
    for (const auto &[raw, what] : {std::pair{"(a (b))", "Nested comment found"},
                                    {"X1 (open", "Unclosed comment found"},
                                    {"G1\nX1", "Null missing after newline"}}) {
        EXPECT(take_line(t.s, raw) == INTERP_ERROR);
        EXPECT(t.s.error == what);
    }
    EXPECT(take_line(t.s, std::string(254, ' ')) == INTERP_OK && take_line(t.s, std::string(255, ' ')) == INTERP_ERROR);
}

// source.cc: lines, their numbers and offsets, whatever the window
void sources()
{
    const char *name = "lines.ngc";
    {
        std::ofstream f(name);
        for (int n = 1; n <= 60000; ++n) f << "N" << n << std::string(size_t(n % 50), ' ') << "\n";
        f << "last";
    }
    LineSource source;
    EXPECT(source.open(name));
    std::string_view line;
    bool newline;
    int64_t at[3] = {};
    for (int n = 1; n <= 60000; ++n) {
        if (n % 20000 == 1) at[n / 20000] = source.tell();
        if (!source.next(line, newline) || atoi(line.data() + 1) != n || !newline || source.line_number != n) {
            printf("line %d of the file is not line %d\n", n, source.line_number);
            ++failures;
            break;
        }
    }
    EXPECT(source.next(line, newline) && line == "last" && !newline);
    EXPECT(!source.next(line, newline));
    for (int n : {2, 0, 1}) { // back, beyond the window and into it
        source.seek(at[n]);
        EXPECT(source.next(line, newline) && atoi(line.data() + 1) == n * 20000 + 1);
    }
    EXPECT(!source.changed());
    std::ofstream(name, std::ios::app) << "\nmore\n";
    EXPECT(source.changed());
    EXPECT(!source.open(".") && !source.open("nowhere.ngc"));
    {
        std::ofstream f(name);
        f << std::string(700000, 'x') << "\nafter\n";
    }
    EXPECT(source.open(name) && source.next(line, newline) && line.size() <= 1024 && source.next(line, newline) &&
           line == "after");
    unlink(name);
}

// names.hh
void names()
{
    NameTable<int> table;
    for (int n = 0; n < 5000; ++n) table.at("name" + std::to_string(n)) = n;
    EXPECT(table.size() == 5000);
    int found = 0;
    for (int n = 0; n < 5000; ++n) {
        const int *v = table.find("name" + std::to_string(n));
        found += v && *v == n;
    }
    EXPECT(found == 5000 && !table.find("name") && !table.find("name5000"));
    table.clear();
    EXPECT(table.size() == 0 && !table.find("name1"));
    EXPECT(table.at("again") == 0);
}

// expressions.cc: text -> value
void expressions()
{
    Stage t;
    t.s.parameters[1] = 7;
    t.s.parameters[7] = 2.5;
    struct {
        const char *text;
        double value;
    } values[] = {
        {"1.5", 1.5},
        {"-.25", -.25},
        {"--3", 3},
        {"-+-3", 3},
        {"[1+2*3]", 7},
        {"[2**3**2]", 64},
        {"[-2**2]", 4},
        {"[10-2-3mod2]", 7},
        {"[-7mod3]", 2},
        {"[7mod-3]", 1},
        {"[1or0and0]", 0},
        {"[1eq1.0000005]", 1},
        {"[1lt1]", 0},
        {"#1", 7},
        {"##1", 2.5},
        {"[#1+2]", 9},
        {"#[3+4]", 2.5},
        {"-#1", -7},
        {"sin[30]", .5},
        {"-sin[30]", -.5},
        {"atan[-1]/[-1]", -135},
        {"round[-2.5]", -3},
        {"fix[-2.8]", -3},
        {"fup[-2.8]", -2},
        {"exists[#<nope>]", 0},
        {"exists[#5601]", 1},
        {"exists[#5602]", 0},
        {"exists[#<_x>]", 1},
        {"sqrt[2]", M_SQRT2},
        {"ln[exp[2]]", 2},
    };
    for (const auto &v : values) {
        double got = NAN;
        EXPECT(take_line(t.s, v.text) == INTERP_OK);
        if (read_real(t.s, &got) != INTERP_OK || fabs(got - v.value) > 1e-12)
            printf("%s = %.15g, not %.15g: %s\n", v.text, got, v.value, t.s.error.c_str()), ++failures;
        if (t.s.text[t.s.pos]) printf("%s: read up to '%s'\n", v.text, t.s.text + t.s.pos), ++failures;
    }
    struct {
        const char *text, *what;
    } faults[] = {
        {"", "No characters found in reading real value"},
        {"-", "No characters found in reading real value"},
        {"[1/0]", "Attempt to divide by zero"},
        {"[1", "Unclosed expression"},
        {"[1?2]", "Unknown operation"},
        {"[1moo2]", "Unknown operation name starting with m"},
        {"sin30", "Left bracket missing after unary operation name"},
        {"sqr[2]", "Unknown word starting with s"},
        {"zzz", "Unknown word where unary operation could be"},
        {"#0", "Parameter number out of range"},
        {"#1.5", "Non integer value for integer"},
        {"#<nope>", "Named parameter #<nope> not defined"},
        {"#<open", "Named parameter not terminated"},
        {"1.2.3", "bad number format (trailing characters) parsing '1.2.3'"},
        {".", "bad number format (conversion failed) parsing '.'"},
        {"asin[2]", "Argument to asin out of range"},
        {"[-8**.5]", "Attempt to raise negative to non integer power"},
        {"exp[1000]", "Calculation resulted in 'infinity'"},
        {"[1mod0]", "Calculation resulted in 'not a number'"},
    };
    for (const auto &f : faults) {
        double got;
        EXPECT(take_line(t.s, f.text) == INTERP_OK);
        if (read_real(t.s, &got) != INTERP_ERROR || t.s.error != f.what)
            printf("%s: '%s', not '%s'\n", f.text, t.s.error.c_str(), f.what), ++failures;
    }
}

// words.cc: text -> block, nothing has happened yet
void words()
{
    Stage t;
    EXPECT(t.interp.read("N10 G90 G1 X1 Y[1+1] F3 M3 S5 #1=4 #<a>=5 (hi)") == INTERP_OK);
    const Block &b = t.s.block;
    EXPECT(b['x'] == 1 && b['y'] == 2 && !b.has('z') && b['f'] == 3 && b['s'] == 5 && b.m_count == 1);
    EXPECT(b.settings == 1 && b.setting[0].index == 1 && b.setting[0].value == 4 && b.named_settings == 1);
    EXPECT(std::string(b.comment, size_t(b.comment_length)) == "hi");
    EXPECT(t.s.parameters[1] == 0 && t.s.feed_rate == 0); // read, not executed
    EXPECT(b.motion == 10);
    for (const auto &[line, what] : {std::pair{"X1 X2", "Multiple x words on one line"},
                                     {"G1 G0 X1", "Two g codes used from same modal group"},
                                     {"M3 M4", "Two m codes used from same modal group"},
                                     {"M3 M8 M48 M0 M62P1", "Too many m codes on line"},
                                     {"F-1", "Negative f word used"},
                                     {"G1.15", "G-code out of range"},
                                     {"T-1", "Negative tool id (tool not found)"},
                                     {"X1 N5", "Bad character 'n' used"},
                                     {"G5.05", "G-code out of range"}}) {
        EXPECT(t.interp.read(line) == INTERP_ERROR);
        if (t.s.error != what) printf("%s: '%s', not '%s'\n", line, t.s.error.c_str(), what), ++failures;
    }
}

// inference.cc, checks.cc: which motion a line makes, which words have a code to use them
void inference()
{
    Stage t;
    struct {
        const char *line;
        int motion; // -2: error
    } lines[] = {
        {"X1", -2},  {"G0 X1", 0},  {"G10 L2 P1 X1", -1}, {"G92 X1", -1}, {"G28 X1", -1},       {"G28.1", -1},
        {"G1", 10},  {"G2 I1", 20}, {"G80", 800},         {"G80 X1", -2}, {"G43.1 Z1", -1},     {"G10 L2 P1 G1 X1", -2},
        {"G33", -2}, {"G4 P1", -1}, {"P1", -2},           {"H1", -2},     {"G53 G2 X1 R1", -2}, {"G92", -2},
    };
    for (const auto &l : lines) {
        const int status = t.interp.read(l.line);
        if ((l.motion == -2) != (status == INTERP_ERROR) || (status == INTERP_OK && t.s.block.motion != l.motion))
            printf("%s: status %d motion %d %s\n", l.line, status, t.s.block.motion, t.s.error.c_str()), ++failures;
    }
    EXPECT(t.interp.execute("G1 X1 F1") == INTERP_OK && t.interp.read("Y2") == INTERP_OK && t.s.block.motion == 10);
    EXPECT(t.interp.read("G92 X3") == INTERP_OK && t.s.block.motion == -1);
}

// ends.cc: absolute positions there and back, under every offset
void positions()
{
    Stage t;
    srand(5);
    auto random = [] { return (rand() % 20001 - 10000) / 100.0; };
    for (int n = 0; n < 500; ++n) {
        for (int i = 0; i < AXES; ++i) {
            axis(t.s.current, i) = random();
            axis(t.s.g92, i) = random();
            axis(t.s.g5x, i) = random();
            axis(t.s.tool_offset, i) = random();
        }
        t.s.rotation = random();
        const EmcPose before = t.s.current, back = from_absolute(t.s, absolute_position(t.s));
        double worst = 0;
        for (int i = 0; i < AXES; ++i) worst = std::max(worst, fabs(axis(before, i) - axis(back, i)));
        EXPECT(worst < 1e-9);
    }
}

} // namespace

int main()
{
    return run_tests({
        {"text", text}, {"sources", sources}, {"names", names}, {"expressions", expressions},
        {"words", words}, {"inference and checks", inference}, {"positions", positions},
    });
}
