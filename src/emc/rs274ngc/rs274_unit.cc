/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * rs274_unit.cc - what the interpreter promises to its C++ callers: unit tests.
 *
 * Prints one line for each test; exit status 1 when one fails.
 */
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <new>

#include <malloc.h>
#include <unistd.h>

#include "check_program.hh"
#include "interp.hh"
#include "rs274_expect.hh"
#include "stages.hh"

// Every allocation of this program and of the libraries it uses is counted.
static long allocations = 0;
void *operator new(size_t size)
{
    ++allocations;
    if (void *p = malloc(size ? size : 1)) return p;
    throw std::bad_alloc();
}
void operator delete(void *p) noexcept { free(p); }
void operator delete(void *p, size_t) noexcept { free(p); }

namespace
{

/// A machine that does at once what it is told and keeps a list.
class TestCanon : public Canon
{
  public:
    std::vector<std::string> calls;
    EmcPose position{};
    std::vector<state_tag_t> tags;
    state_tag_t tag{};
    std::string parameters;
    bool queue_empty = true;

    void STRAIGHT_TRAVERSE(int line, const EmcPose &end) override { move("traverse", line, end); }
    void STRAIGHT_FEED(int line, const EmcPose &end) override { move("feed", line, end); }
    void ARC_FEED(int line, double, double, double, double, int, double, const EmcPose &end) override
    {
        move("arc", line, end);
    }
    void STRAIGHT_PROBE(int line, const EmcPose &end, unsigned char) override { move("probe", line, end); }
    void UPDATE_TAG(const state_tag_t &t) override { tag = t; }
    bool wants_tags() const override { return true; }
    void MESSAGE(const char *text) override { calls.push_back(std::string("message ") + text); }
    void SET_AUX_OUTPUT_BIT(int i) override { calls.push_back("out " + std::to_string(i)); }
    void SET_MOTION_OUTPUT_BIT(int i) override { calls.push_back("mout " + std::to_string(i)); }
    void FINISH() override { calls.push_back("finish"); }
    void USE_LENGTH_UNITS(CANON_UNITS u) override { units = u; }
    double GET_EXTERNAL_LENGTH_UNITS() override { return 1; }
    CANON_UNITS GET_EXTERNAL_LENGTH_UNIT_TYPE() override { return units; }
    EmcPose GET_EXTERNAL_POSITION() override { return position; }
    bool GET_EXTERNAL_QUEUE_EMPTY() override { return queue_empty; }
    std::string GET_EXTERNAL_PARAMETER_FILE_NAME() override { return parameters; }
    bool USER_DEFINED_FUNCTION_EXISTS(int num) override { return num == 1; }

  private:
    CANON_UNITS units = CANON_UNITS_MM;
    void move(const char *name, int line, const EmcPose &end)
    {
        position = end;
        tags.push_back(tag);
        char text[100];
        snprintf(text, sizeof text, "%s %d %.3f %.3f %.3f", name, line, end.tran.x, end.tran.y, end.tran.z);
        calls.push_back(text);
    }
};

struct Machine {
    TestCanon canon;
    Interp interp{canon};
    Machine()
    {
        InterpOptions none;
        EXPECT(interp.init(none) == INTERP_OK);
    }
};

std::string write_file(const char *name, const std::string &text)
{
    std::ofstream f(name);
    f << text;
    return name;
}

int run_to_end(Interp &interp)
{
    for (;;) {
        int status = interp.read();
        if (status == INTERP_OK) status = interp.execute();
        if (status != INTERP_OK && status != INTERP_EXECUTE_FINISH) return status;
    }
}

void mdi_runs_whole_subs()
{
    Machine m;
    write_file("mdisub.ngc", "o<mdisub> sub\nG0 X#1\nG38.2 Z-1\nG0 X[#1+1]\no<mdisub> endsub [7]\n");
    EXPECT(m.interp.execute("F100") == INTERP_OK);
    int status = m.interp.execute("o<mdisub> call [4]");
    EXPECT(status == INTERP_EXECUTE_FINISH);
    EXPECT(m.interp.call_level() == 1);
    m.canon.queue_empty = true;
    status = m.interp.execute(nullptr);
    EXPECT(status == INTERP_OK && m.interp.call_level() == 0);
    EXPECT(m.canon.calls.size() == 5); // finish of F100, three moves, finish
    EXPECT(m.canon.calls.back() == "finish");
    double value = 0;
    EXPECT(m.interp.named_parameter("_value", &value) && value == 7);
    m.canon.calls.clear();
    EXPECT(m.interp.execute("m98 p33") == INTERP_ERROR); // nowhere
    write_file("44.ngc", "o44\n(msg,in)\nm99\n");
    EXPECT(m.interp.execute("m98 p44 l3") == INTERP_OK);
    EXPECT(m.canon.calls.size() == 4);
    unlink("mdisub.ngc");
    unlink("44.ngc");
}

void mdi_leaves_the_program_where_it_was()
{
    Machine m;
    write_file("prog.ngc", "G0 X1\nG0 X2\nG0 X3\nM2\n");
    EXPECT(m.interp.open("prog.ngc") == INTERP_OK);
    EXPECT(m.interp.read() == INTERP_OK && m.interp.execute() == INTERP_OK);
    EXPECT(m.interp.execute("G0 Y9") == INTERP_OK && m.interp.execute("G0 Y9") == INTERP_OK);
    EXPECT(m.interp.read() == INTERP_OK && m.interp.sequence_number() == 2 && m.interp.execute() == INTERP_OK);
    EXPECT(run_to_end(m.interp) == INTERP_EXIT);
    EXPECT(m.canon.position.tran.x == 3 && m.canon.position.tran.y == 9);
    unlink("prog.ngc");
}

void interpreters_share_nothing()
{
    Machine a, b;
    EXPECT(a.interp.execute("#1=5 #<_g>=6 G20 G91") == INTERP_OK);
    EXPECT(b.interp.execute("#1=7") == INTERP_OK);
    EXPECT(a.interp.parameter(1) == 5 && b.interp.parameter(1) == 7);
    double v;
    EXPECT(a.interp.named_parameter("_g", &v) && !b.interp.named_parameter("_g", &v));
    int g[ACTIVE_G_CODES];
    b.interp.active_g_codes(g);
    EXPECT(g[5] == 210 && g[6] == 900);
    a.interp.active_g_codes(g);
    EXPECT(g[5] == 200 && g[6] == 910);
}

void tags_carry_the_modal_state()
{
    Machine m;
    EXPECT(m.interp.execute("G21 G90 F123 S77 M3 G64 P.5 Q.25 G18 G1 X1 Z1", 42) == INTERP_OK);
    EXPECT(m.canon.tags.size() == 1);
    int g[ACTIVE_G_CODES], codes[ACTIVE_M_CODES];
    double v[ACTIVE_SETTINGS];
    EXPECT(Interp::active_modes(g, codes, v, m.canon.tags[0]));
    EXPECT(g[0] == 42 && g[1] == 10 && g[3] == 180 && g[5] == 210 && g[7] == 940 && g[11] == 640);
    EXPECT(codes[2] == 3 && v[1] == 123 && v[2] == 77 && v[3] == 0.5 && v[4] == 0.25);
    state_tag_t empty{};
    EXPECT(!Interp::active_modes(g, codes, v, empty));
    // What is in force later goes back to what the move had.
    EXPECT(m.interp.execute("G20 G91 F5 G61 G17") == INTERP_OK);
    EXPECT(m.interp.restore_from_tag(m.canon.tags[0]) == INTERP_OK);
    m.interp.active_g_codes(g);
    m.interp.active_settings(v);
    EXPECT(g[3] == 180 && g[5] == 210 && g[6] == 900 && g[11] == 640 && g[4] == 400);
    EXPECT(v[1] == 123 && v[3] == 0.5 && v[4] == 0.25);
}

void reading_waits_for_the_machine()
{
    Machine m;
    EXPECT(m.interp.execute("F10") == INTERP_OK);
    EXPECT(m.interp.read("G38.2 X5") == INTERP_OK);
    EXPECT(m.interp.execute() == INTERP_EXECUTE_FINISH);
    m.canon.queue_empty = false;
    EXPECT(m.interp.read("G0 X1") == INTERP_ERROR);
    EXPECT(std::string(m.interp.error_text(INTERP_ERROR)) == "Queue is not empty after probing");
    m.canon.queue_empty = true;
    EXPECT(m.interp.read("G0 X[#5061+1]") == INTERP_OK && m.interp.execute() == INTERP_OK);
    EXPECT(m.canon.position.tran.x == 6);
}

void faults_name_line_column_and_remedy()
{
    Machine m;
    write_file("fault.ngc", "G21\n  G1 F100 X[1 + #<lenght>] (x)\nM2\n");
    EXPECT(m.interp.execute("#<_length>=1") == INTERP_OK);
    EXPECT(m.interp.open("fault.ngc") == INTERP_OK);
    EXPECT(run_to_end(m.interp) == INTERP_ERROR);
    const Fault &f = m.interp.fault();
    EXPECT(f.file == "fault.ngc" && f.line == 2);
    EXPECT(f.column == 17 && f.length == 9);
    EXPECT(f.what == "Named parameter #<lenght> not defined");
    EXPECT(f.fix == "did you mean #<_length>?");
    EXPECT(f.report().find("\n                  ^~~~~~~~~\n") != std::string::npos);
    EXPECT(m.interp.execute("G0 X1 T77") == INTERP_ERROR);
    EXPECT(m.interp.fault().column == 7 && m.interp.fault().file.empty());
    unlink("fault.ngc");
}

void errors_leave_no_trace()
{
    Machine m;
    write_file("deep.ngc", "o<deep> sub\n#1=99\no<in> sub\no<in> endsub\no<deep> endsub\n");
    EXPECT(m.interp.execute("#1=3 G91") == INTERP_OK);
    EXPECT(m.interp.execute("o<deep> call [1]") == INTERP_ERROR);
    EXPECT(m.interp.call_level() == 0 && m.interp.parameter(1) == 3);
    EXPECT(m.interp.execute("G0 X1") == INTERP_OK);
    unlink("deep.ngc");
}

void a_snapshot_runs_as_it_was_opened() // FP-130
{
    for (bool snapshot : {false, true}) {
        TestCanon canon;
        Interp interp(canon);
        InterpOptions o;
        if (snapshot) o.copies = std::make_shared<ngc::ProgramCopies>();
        EXPECT(interp.init(o) == INTERP_OK);
        std::string text;
        for (int i = 0; i < 60000; ++i) text += "G0 X1\n";
        write_file("snap.ngc", text + "G0 X2\nM2\n");
        EXPECT(interp.open("snap.ngc") == INTERP_OK);
        EXPECT(interp.read() == INTERP_OK && interp.execute() == INTERP_OK);
        write_file("snap.ngc", text + "G0 X666\nM2\n"); // saved by an editor, in place
        EXPECT(!snapshot || o.copies->changed() == "snap.ngc");
        EXPECT(run_to_end(interp) == INTERP_EXIT);
        EXPECT((canon.position.tran.x == 2) == snapshot);
        interp.exit();
    }
    unlink("snap.ngc");
}

void called_files_stay_as_they_were_first_called() // FP-130
{
    for (const char *setting : {"KEEP", "FRESH"}) {
        const std::string ini = write_file(setting, std::string("[RS274NGC]\nCALLED_FILES = ") + setting + "\n");
        write_file("part.ngc", "o<part> sub\nG0 X1\no<part> endsub\n");
        write_file("caller.ngc", "o<part> call\nG0 X0\no<part> call\nM2\n");
        TestCanon canon;
        Interp interp(canon);
        InterpOptions o;
        o.ini_file = ini;
        o.copies = std::make_shared<ngc::ProgramCopies>();
        EXPECT(interp.init(o) == INTERP_OK);
        auto change = [](int x) {
            write_file("part.ngc", "o<part> sub\nG0 X" + std::to_string(x) + "\n(it is)\no<part> endsub\n");
        };
        EXPECT(interp.open("caller.ngc") == INTERP_OK);
        for (int line = 0; line < 5; ++line) EXPECT(interp.read() == INTERP_OK && interp.execute() == INTERP_OK);
        change(2);
        const bool keeps = *setting == 'K';
        EXPECT(o.copies->news() == (keeps ? std::vector<std::string>{"part.ngc"} : std::vector<std::string>{}));
        EXPECT(o.copies->news().empty()); // once
        EXPECT(run_to_end(interp) == INTERP_EXIT);
        EXPECT(canon.position.tran.x == (keeps ? 1 : 2));
        EXPECT(o.copies->changed() == (keeps ? "part.ngc" : ""));
        change(3);
        EXPECT(interp.execute("o<part> call") == INTERP_OK && canon.position.tran.x == 3); // by hand: as it is now
        interp.exit();
    }
    for (const char *name : {"KEEP", "FRESH", "part.ngc", "caller.ngc"}) unlink(name);
}

void programs_start_as_the_ini_file_says() // FP-104
{
    write_file("start.ngc", "(debug,%d#<_metric> #<_absolute> #<_plane>)\nG20 G91 G19\nG17\nM2\n");
    int n = 0;
    for (const char *code : {"G21 G90 G94", "", "G21 G999", "G38.2 X5 F1", "M2"}) {
        const std::string ini = "start" + std::to_string(n++) + ".ini";
        write_file(ini.c_str(), std::string("[RS274NGC]\nPROGRAM_START_CODE = ") + code + "\n");
        TestCanon canon;
        Interp interp(canon);
        InterpOptions o;
        o.ini_file = ini;
        EXPECT(interp.init(o) == INTERP_OK);
        for (int run = 0; run < 3; ++run) {
            EXPECT(interp.open("start.ngc") == INTERP_OK);
            if (run == 2) EXPECT(interp.execute("G20 G91") == INTERP_OK); // by hand, between open and start
            canon.calls.clear();
            const int end = run_to_end(interp);
            interp.close();
            if (n > 2) {
                EXPECT(end == INTERP_ERROR && strstr(interp.error_text(end), "[RS274NGC]PROGRAM_START_CODE '"));
                break;
            }
            EXPECT(end == INTERP_EXIT);
            EXPECT((canon.calls.front() == "message 1 1 170") == (n == 1 || run == 0));
        }
        interp.exit();
        unlink(ini.c_str());
    }
    unlink("start.ngc");
}

void outputs_keep_their_place() // FP-110
{
    Machine m;
    write_file("io.ngc", "F100\nG1 X1\nM64 P3\nG1 X2\nM62 P1\nG1 X3\nM2\n");
    EXPECT(m.interp.open("io.ngc") == INTERP_OK);
    EXPECT(run_to_end(m.interp) == INTERP_EXIT);
    const std::vector<std::string> want = {"feed 2 1.000 0.000 0.000", "out 3", "feed 4 2.000 0.000 0.000", "mout 1",
                                           "feed 6 3.000 0.000 0.000"};
    EXPECT(m.canon.calls == want);
    unlink("io.ngc");
}

// The text of a block that holds the same words, printed with all digits.
std::string print_block(const ngc::Block &b)
{
    std::string out;
    char buf[64];
    for (int g : b.g_modes)
        if (g >= 0) {
            char name[16];
            out += ngc::g_name(g, name);
        }
    for (int code : b.m_modes)
        if (code >= 0) out += "M" + std::to_string(code);
    for (char c = 'a'; c <= 'z'; ++c)
        if (b.has(c)) {
            snprintf(buf, sizeof buf, "%c%.17g", c, b[c]);
            if (!strchr(buf, 'e') || buf[0] == 'e') out += strchr(buf + 1, 'e') ? std::string(1, c) + "0" : buf;
        }
    return out;
}

void a_printed_block_reads_as_the_same_block()
{
    Machine m;
    EXPECT(m.interp.execute("F100 S100 M3") == INTERP_OK);
    srand(7);
    int equal = 0;
    for (int n = 0; n < 20000; ++n) {
        static const char *const heads[] = {"G1",         "G0",         "G1 G90 G21", "G91 G1",         "G2 I1.5",
                                            "G17 G3 R50", "M3 G1",      "M8 M3 G1",   "G43.1",          "G10 L2 P3",
                                            "G92",        "G4 P.25 G1", "G81 R5 Z1",  "G64 P.1 Q.2 G1", "G53 G0 G90"};
        std::string text = heads[size_t(rand()) % (sizeof heads / sizeof *heads)];
        for (char c : {'X', 'Y'}) {
            char word[64];
            snprintf(word, sizeof word, rand() % 3 ? " %c%.6f" : " %c[%.4f*2 + 1]", c, (rand() - RAND_MAX / 2) / 1e7);
            text += word;
        }
        Setup &s = m.interp.setup();
        if (m.interp.read(text.c_str()) != INTERP_OK) continue;
        const std::string first = print_block(s.block);
        EXPECT(m.interp.read(first.c_str()) == INTERP_OK);
        const std::string second = print_block(s.block);
        EXPECT(first == second);
        ++equal;
    }
    EXPECT(equal > 15000);
}

void checks_find_what_is_wrong_without_a_machine() // FP-104
{
    write_file("check.ngc", "G0 X1\nG1 X2 F100\nG20\nG1 X3\nG21\nX1 X2\nT5 M6\nM2\nG0 X5\n");
    CheckOptions o;
    o.tool_file = write_file("check.tbl", "T1 P1\n");
    const auto found = check_program("check.ngc", o);
    std::string all;
    for (const Finding &f : found)
        all += std::to_string(f.fault.line) + (f.severity == Finding::ERROR ? "E " : "W ") + f.fault.what + "\n";
    EXPECT(all == "3W the program uses both G20 and G21\n"
                  "6E Multiple x words on one line\n"
                  "7E Requested tool 5 not found in the tool table\n"
                  "9W never executed: the program ends in line 8\n");
    write_file("check.ngc", "G1 X2 F100\nM2\n");
    const auto units = check_program("check.ngc", CheckOptions());
    EXPECT(units.size() == 1 && units[0].fault.what == "a feed move before any G20 or G21");
    write_file("check.ini", "[TRAJ]\nLINEAR_UNITS=mm\nCOORDINATES=XYZ\n[AXIS_X]\nMIN_LIMIT=-10\nMAX_LIMIT=10\n"
                            "[AXIS_Y]\nMIN_LIMIT=-10\nMAX_LIMIT=10\n[AXIS_Z]\nMIN_LIMIT=-10\nMAX_LIMIT=10\n");
    write_file("check.ngc", "G21 F100\nG10 L2 P1 X2\nG0 X8\nG0 X8.1\nG0 X0 Y0\nG3 X0 Y0 I0 J6\nM2\n");
    o = CheckOptions();
    o.interp.ini_file = "check.ini";
    const auto limits = check_program("check.ngc", o);
    EXPECT(limits.size() == 2 && limits[0].fault.line == 4 && limits[1].fault.line == 6);
    for (const char *name : {"check.ngc", "check.tbl", "check.ini"}) unlink(name);
}

/// A machine that keeps nothing.
class IdleCanon : public Canon
{
  public:
    void STRAIGHT_TRAVERSE(int, const EmcPose &end) override { position = end; }
    void STRAIGHT_FEED(int, const EmcPose &end) override { position = end; }
    void ARC_FEED(int, double, double, double, double, int, double, const EmcPose &end) override { position = end; }
    double GET_EXTERNAL_LENGTH_UNITS() override { return 1; }
    EmcPose GET_EXTERNAL_POSITION() override { return position; }
    EmcPose position{};
};

// Ordinary lines, after the first of each kind, take no memory; so its size does not depend on
// the program's length.
void motion_lines_allocate_nothing()
{
    static const char *const kinds[] = {"G1 X1.5 Y2.25 Z-3 F100",
                                        "N120 G0 X0Y0Z5",
                                        "X2 Y[1+2*3] (with a comment)",
                                        "G2 X4 Y7 I1 J0.0",
                                        "G3 X0 Y0 R8 ; tail",
                                        "G1 X#1 A45 F[200/4]",
                                        "#1=[#1+1] #<named>=3",
                                        "G4 P.1",
                                        "G81 X1 Z-1 R2",
                                        "X2",
                                        "G80",
                                        "M8 S100",
                                        "/G1 X1",
                                        "G91 X#<named>",
                                        "G90",
                                        "G41.1 D1",
                                        "G1 X20 Y20",
                                        "G1 X30",
                                        "G40",
                                        "G0 X0 Y0",
                                        "o1 if [#1 gt 5]",
                                        "G1 X3",
                                        "o1 else",
                                        "G1 X4",
                                        "o1 endif"};
    std::string text = "G21 G17 G90 F100 S1 M3\n#<named>=1 #1=0\no9 while [#1 lt 400]\n";
    for (const char *k : kinds) text += std::string(k) + "\n";
    write_file("many.ngc", text + "o9 endwhile\nM2\n");
    IdleCanon canon;
    Interp interp(canon);
    EXPECT(interp.init(InterpOptions()) == INTERP_OK && interp.open("many.ngc") == INTERP_OK);
    const int warm = 2 + int(sizeof kinds / sizeof *kinds) * 20;
    long before = 0, taken = 0;
    size_t heap = 0;
    for (int n = 0;; ++n) {
        if (n == warm) {
            before = allocations;
            heap = mallinfo2().uordblks;
        }
        int status = interp.read();
        if (status == INTERP_OK) status = interp.execute();
        if (status == INTERP_EXIT) break;
        if (n >= warm && allocations != before) {
            if (taken == 0) printf("line %d allocates: %s\n", interp.line(), interp.command());
            taken += allocations - before;
            before = allocations;
        }
        if (status != INTERP_OK) {
            printf("%s\n", interp.fault().report().c_str());
            ++failures;
            break;
        }
    }
    EXPECT(taken == 0);
    EXPECT(mallinfo2().uordblks <= heap + 65536);
    unlink("many.ngc");
}

// An MDI sub without an end gives control back, and reset() ends it; the program goes on where it was.
void endless_subs_give_control_back()
{
    Machine m;
    write_file("endless.ngc", "o<endless> sub\no1 while [1]\nG0 X1\no1 endwhile\no<endless> endsub\n");
    write_file("main.ngc", "G0 X5\nG0 X6\nM2\n");
    EXPECT(m.interp.open("main.ngc") == INTERP_OK && m.interp.read() == INTERP_OK && m.interp.execute() == INTERP_OK);
    m.interp.set_mdi_slice(100);
    EXPECT(m.interp.execute("o<endless> call") == INTERP_OK && m.interp.mdi_waits() && m.interp.call_level() == 1);
    const size_t calls = m.canon.calls.size();
    EXPECT(m.interp.execute(nullptr) == INTERP_OK && m.interp.mdi_waits() && m.canon.calls.size() > calls + 20);
    m.interp.reset();
    EXPECT(!m.interp.mdi_waits() && m.interp.call_level() == 0);
    EXPECT(m.interp.execute("G0 X9") == INTERP_OK && !m.interp.mdi_waits());
    EXPECT(m.interp.read() == INTERP_OK && m.interp.execute() == INTERP_OK && m.canon.position.tran.x == 6);
    unlink("endless.ngc");
    unlink("main.ngc");
}

// One line cannot ask for moves without bound; recursion and numbers have limits with texts.
void what_a_line_asks_for_is_bounded()
{
    struct {
        const char *line, *text;
    } bounds[] = {
        {"G81 X1 Z-1 R1 L2000000000", "L word makes more than 1000000 moves"},
        {"G83 X1 Z-1 R1 Q.0000001", "Q word gives more than 100000 pecks"},
        {"G76 P1 Z-2 I-1 J.0000001 K1", "J of G76 gives more than 100000 passes"},
        {"G76 P1 Z-2 I-1 J.1 K1 H2000000000", "H of G76 gives more than 100000 passes"},
        {"o<deep> call", "Too many subroutine levels"},
        {"#5602=1", "Parameter number out of range"},
        {"#0=1", "Parameter number out of range"},
    };
    write_file("deep.ngc", "o<deep> sub\no<deep> call\no<deep> endsub\n");
    for (const auto &b : bounds) {
        IdleCanon canon;
        Interp interp(canon);
        EXPECT(interp.init(InterpOptions()) == INTERP_OK);
        EXPECT(interp.execute("G21 G90 F100 M3 S10") == INTERP_OK);
        EXPECT(interp.execute(b.line) == INTERP_ERROR);
        if (std::string(interp.error_text(INTERP_ERROR)) != b.text)
            printf("%s: %s\n", b.line, interp.error_text(INTERP_ERROR)), ++failures;
    }
    unlink("deep.ngc");
}

} // namespace

int main()
{
    return run_tests({
        {"mdi runs whole subs", mdi_runs_whole_subs},
        {"mdi leaves the program where it was", mdi_leaves_the_program_where_it_was},
        {"interpreters share nothing", interpreters_share_nothing},
        {"tags carry the modal state", tags_carry_the_modal_state},
        {"reading waits for the machine", reading_waits_for_the_machine},
        {"faults name line, column and remedy", faults_name_line_column_and_remedy},
        {"errors leave no trace", errors_leave_no_trace},
        {"FP-130 a snapshot runs as it was opened", a_snapshot_runs_as_it_was_opened},
        {"FP-130 called files stay as they were first called", called_files_stay_as_they_were_first_called},
        {"FP-104 programs start as the INI file says", programs_start_as_the_ini_file_says},
        {"FP-110 outputs keep their place", outputs_keep_their_place},
        {"a printed block reads as the same block", a_printed_block_reads_as_the_same_block},
        {"motion lines allocate nothing", motion_lines_allocate_nothing},
        {"endless subs give control back", endless_subs_give_control_back},
        {"what a line asks for is bounded", what_a_line_asks_for_is_bounded},
        {"FP-104 checks find what is wrong without a machine", checks_find_what_is_wrong_without_a_machine},
    });
}
