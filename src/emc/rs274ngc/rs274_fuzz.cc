/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * rs274_fuzz.cc - any bytes as a program: nothing may crash, hang or forget what it promised.
 *
 * In:     a program; a line "@NAME" begins the text of the sub file NAME.ngc. A first line
 *         "@mdi" gives the lines one by one as MDI, "@ini" runs on a machine with an INI
 *         file (wrapped and locked rotary axes, remaps by subs, peck clearances, Fanuc subs).
 *         With KERF_FUZZ_LINES=1 every input is MDI lines; the line "@ini" alone may precede.
 * Method: one interpreter is used for all inputs. Before each it takes over the state of one
 *         that was never used, which takes microseconds; files are in memory (/dev/shm),
 *         in a folder that becomes the working directory: give absolute paths.
 * Thread: main
 */
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "interp.hh"
#include "stages.hh"

namespace
{

[[noreturn]] void broken(const char *promise)
{
    fprintf(stderr, "broken promise: %s\n", promise);
    abort();
}

void promise(bool kept, const char *what)
{
    if (__builtin_expect(!kept, 0)) broken(what);
}

enum {
    MAX_LINES = 400,          // of one run; more is an endless loop, which the caller ends
    MAX_CALLS = 60 * 1000000, // of one run; no line may make more than Interp allows
    MAX_INPUT = 4096
};

/// A machine with nine axes that does at once what it is told.
class FuzzMachine : public Canon
{
  public:
    EmcPose position{}, probed{};
    CANON_UNITS units = CANON_UNITS_MM;
    CANON_PLANE plane = CANON_PLANE_XY;
    CANON_MOTION_MODE mode = CANON_CONTINUOUS;
    int slot = 0, selected = -1;
    bool metric = true, block_delete = false;
    long calls = 0;
    state_tag_t tag{};

    void reset(bool with_ini)
    {
        *this = FuzzMachine();
        metric = with_ini;
    }
    void STRAIGHT_TRAVERSE(int, const EmcPose &end) override { move(end); }
    void STRAIGHT_FEED(int, const EmcPose &end) override { move(end); }
    void ARC_FEED(int, double, double, double, double, int rotation, double, const EmcPose &end) override
    {
        promise(rotation != 0, "an arc turns");
        move(end);
    }
    void NURBS_G5_FEED(int, const std::vector<NURBS_CONTROL_POINT> &points, unsigned order, CANON_PLANE) override
    {
        promise(order >= 2 && points.size() >= order, "a spline has as many points as its order");
        ++calls;
    }
    void NURBS_G6_FEED(int, const std::vector<NURBS_G6_CONTROL_POINT> &points, unsigned, double, int q,
                       CANON_PLANE) override
    {
        promise(!points.empty() && q >= 1 && q <= 3, "a G6.2 curve has points and a known Q");
        ++calls;
    }
    void STRAIGHT_PROBE(int, const EmcPose &end, unsigned char) override
    {
        probed = end;
        move(end);
    }
    void RIGID_TAP(int, double, double, double, double scale) override
    {
        promise(scale >= 1, "the return speed multiplier of G33.1 is 1 or more");
        ++calls;
    }
    void USE_LENGTH_UNITS(CANON_UNITS u) override
    {
        promise(u == CANON_UNITS_MM || u == CANON_UNITS_INCHES, "known units");
        const double k = u == units ? 1 : u == CANON_UNITS_MM ? 25.4 : 1 / 25.4;
        for (EmcPose *p : {&position, &probed})
            for (double *v : {&p->tran.x, &p->tran.y, &p->tran.z, &p->u, &p->v, &p->w}) *v *= k;
        units = u;
    }
    void SET_G5X_OFFSET(int index, const EmcPose &) override { promise(index >= 1 && index <= 9, "G54 to G59.3"); }
    void SELECT_PLANE(CANON_PLANE p) override
    {
        promise(p >= CANON_PLANE_XY && p <= CANON_PLANE_UW, "known planes");
        plane = p;
    }
    void SET_FEED_RATE(double rate) override { promise(!(rate < 0), "a feed rate is not negative"); }
    void SET_SPINDLE_SPEED(int spindle, double speed) override
    {
        promise(spindle >= 0 && spindle < CANON_MAX_SPINDLES && !(speed < 0), "spindle numbers and speeds");
    }
    void STOP_SPINDLE_TURNING(int spindle, int) override
    {
        promise(spindle >= 0 && spindle < CANON_MAX_SPINDLES, "spindle numbers");
    }
    void SET_MOTION_CONTROL_MODE(CANON_MOTION_MODE m, double, int, double) override { mode = m; }
    void SET_TOOL_TABLE_ENTRY(int idx, int, const EmcPose &, double, double, double, int) override
    {
        promise(idx >= 0 && idx < CANON_POCKETS_MAX, "places of the tool data");
    }
    void SELECT_TOOL(int toolno) override { selected = toolno > 0 && toolno < 5 ? toolno : 0; }
    void CHANGE_TOOL() override { slot = selected < 0 ? 0 : selected; }
    void CHANGE_TOOL_NUMBER(int idx) override { slot = idx; }
    void COMMENT(const char *text) override { spell(text); }
    void MESSAGE(const char *text) override { spell(text); }
    void LOG(const char *text) override { spell(text); }
    void operator_error(const char *text) override { spell(text); }
    void print_line(const char *text) override { spell(text); }
    void UPDATE_TAG(const state_tag_t &t) override { tag = t; }
    bool wants_tags() const override { return metric; }
    int WAIT(int index, CANON_INPUT, CANON_WAIT wait, double) override
    {
        promise(wait >= WAIT_MODE_IMMEDIATE, "kinds of waiting");
        return index >= 0 && index < 4 ? 0 : -1;
    }
    bool USER_DEFINED_FUNCTION_EXISTS(int num) override { return num < 3; }
    void USER_DEFINED_FUNCTION(int num, double, double) override { promise(num >= 0 && num < 100, "user M codes"); }
    bool GET_BLOCK_DELETE() override { return block_delete; }
    CANON_UNITS GET_EXTERNAL_LENGTH_UNIT_TYPE() override { return units; }
    double GET_EXTERNAL_LENGTH_UNITS() override { return metric ? 1 : 1 / 25.4; }
    CANON_PLANE GET_EXTERNAL_PLANE() override { return plane; }
    CANON_MOTION_MODE GET_EXTERNAL_MOTION_CONTROL_MODE() override { return mode; }
    EmcPose GET_EXTERNAL_POSITION() override { return position; }
    EmcPose GET_EXTERNAL_PROBE_POSITION() override { return probed; }
    int GET_EXTERNAL_TOOL_SLOT() override { return slot; }
    int GET_EXTERNAL_SELECTED_TOOL_SLOT() override { return selected; }
    int GET_EXTERNAL_AXIS_MASK() override { return 0x1ff; }
    int GET_EXTERNAL_TOOL_TABLE_LAST() override { return 4; }
    CANON_TOOL_TABLE GET_EXTERNAL_TOOL_TABLE(int idx) override
    {
        CANON_TOOL_TABLE t = tooldata_entry_init();
        if (idx < 0 || idx > 4) return t;
        t.toolno = t.pocketno = idx;
        t.offset.tran.z = idx * 0.5;
        t.offset.tran.x = idx == 4 ? 0.25 : 0;
        t.diameter = idx * 0.4;
        t.orientation = idx == 3 ? 2 : 0;
        return t;
    }

  private:
    void move(const EmcPose &end)
    {
        position = end;
        if (++calls > MAX_CALLS) broken("a line makes a bounded number of moves");
    }
    static void spell(const char *text)
    {
        size_t n = 0;
        while (text[n]) ++n;
        promise(n < 4096, "texts end");
    }
};

/// An interpreter for all inputs, and one that stays as it was at the start.
class Pair
{
  public:
    explicit Pair(FuzzMachine &machine) : used(machine), fresh(machine) {}
    void init(const InterpOptions &options)
    {
        if (used.init(options) != INTERP_OK || fresh.init(options) != INTERP_OK) broken("init");
    }
    Interp &as_new()
    {
        used.reset();
        ngc::init_modes(used.setup());
        used.take_state(fresh);
        return used;
    }

  private:
    Interp used, fresh;
};

/// Everything that lives as long as the process.
struct Bench {
    FuzzMachine machine;
    Pair plain{machine}, configured{machine};
    std::string folder;
    std::vector<std::string> files;
    const bool lines_only = getenv("KERF_FUZZ_LINES");

    Bench()
    {
        const char *base = access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp";
        folder = std::string(base) + "/interp-fuzz-XXXXXX";
        if (!mkdtemp(folder.data()) || chdir(folder.c_str()) != 0) broken("a scratch folder");
        std::ofstream("fuzz.ini")
            << "[TRAJ]\nLINEAR_UNITS=mm\nSPINDLES=3\nCOORDINATES=XYZABCUVW\n"
               "[RS274NGC]\nOWORD_NARGS=1\nRETAIN_G43=1\nG73_PECK_CLEARANCE=0.3\n"
               "REMAP=M400 modalgroup=10 argspec=pq ngc=remapm\n"
               "REMAP=G88.1 modalgroup=1 argspec=XYzr ngc=remapg\nREMAP=M6 modalgroup=6 ngc=remapt\n"
               "REMAP=S ngc=remaps\nON_ABORT_COMMAND=O<remapm> call\n"
               "[AXIS_A]\nWRAPPED_ROTARY=1\n[AXIS_B]\nLOCKING_INDEXER_JOINT=4\n";
        write("remapm.ngc", "o<remapm> sub\n(print,#<p> #<n_args>)\nG1 X1 F9\no<remapm> endsub [3]\n");
        write("remapg.ngc", "o<remapg> sub\nG0 X#<x> Y#<y>\nG91\no<remapg> endsub\n");
        write("remapt.ngc", "o<remapt> sub\nM73\nG53 G0 Z1\nM6\nG43\no<remapt> endsub\n");
        write("remaps.ngc", "o<remaps> sub\nM3\no<remaps> endsub\n");
        machine.reset(false);
        plain.init(InterpOptions());
        machine.reset(true);
        InterpOptions with_ini;
        with_ini.ini_file = "fuzz.ini";
        configured.init(with_ini);
    }
    ~Bench()
    {
        std::error_code ignored;
        if (chdir("/") == 0) std::filesystem::remove_all(folder, ignored); // with what programs wrote
    }

    void write(const std::string &name, std::string_view text)
    {
        int fd = ::open(name.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
        if (fd < 0 || ::write(fd, text.data(), text.size()) != ssize_t(text.size())) broken("room for the sub files");
        ::close(fd);
    }
};

Bench &bench()
{
    static Bench b;
    return b;
}

/// What holds after every line, whatever it was.
void check_state(Interp &interp)
{
    promise(interp.call_level() >= 0 && interp.call_level() < ngc::MAX_CALL_LEVELS, "call levels are bounded");
    int g[ACTIVE_G_CODES], m[ACTIVE_M_CODES];
    double settings[ACTIVE_SETTINGS];
    interp.active_g_codes(g);
    interp.active_m_codes(m);
    interp.active_settings(settings);
    promise(g[3] >= 170 && g[3] <= 191 && g[8] >= 540 && g[8] <= 593, "modal codes are known codes");
    const Setup &s = interp.setup();
    promise(s.origin_index >= 1 && s.origin_index <= 9 && s.remap_level <= 10, "state stays in its ranges");
}

void check_fault(Interp &interp, int status)
{
    if (status <= INTERP_MIN_ERROR) return;
    const char *text = interp.error_text(status);
    promise(*text && strlen(text) < 255, "every error has a text of at most 254 characters");
    if (status != INTERP_ERROR) return;
    const Fault &f = interp.fault();
    promise(f.column >= 0 && f.column <= int(f.text.size()) + 1, "a fault points into its line");
    (void)f.report();
}

/// Lines in order; an error does not end them (as rs274 -n 0), but there is an end.
void run_program(Interp &interp, const char *name)
{
    int errors = 0;
    if (interp.open(name) != INTERP_OK) return;
    for (int lines = 0; lines < MAX_LINES && errors < 10; ++lines) {
        int status = interp.read();
        check_fault(interp, status);
        if (status == INTERP_OK) {
            status = interp.execute();
            check_fault(interp, status);
        }
        check_state(interp);
        if (status == INTERP_FILE_NOT_OPEN || status == INTERP_ENDFILE) break;
        if (status == INTERP_EXIT) break;
        if (status == INTERP_EXECUTE_FINISH) interp.synch();
        if (status > INTERP_MIN_ERROR) {
            ++errors;
            if (strstr(interp.error_text(status), "File ended")) break;
        }
    }
    interp.close();
}

void run_mdi(Interp &interp, std::string_view text)
{
    int n = 0;
    while (!text.empty() && n++ < 60) {
        const size_t end = text.find('\n');
        const std::string line(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        int status = interp.execute(line.c_str(), n);
        for (int slices = 0; slices < 40 && (status == INTERP_EXECUTE_FINISH || interp.mdi_waits()); ++slices) {
            if (status == INTERP_EXECUTE_FINISH) interp.synch();
            if (!interp.mdi_waits()) break;
            status = interp.execute(nullptr);
        }
        check_fault(interp, status);
        check_state(interp);
        if (interp.mdi_waits()) interp.reset(); // endless: the caller ends it
        promise(!interp.mdi_waits() && interp.call_level() == 0, "reset ends what MDI called");
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size > MAX_INPUT) return 0;
    Bench &b = bench();
    std::string_view text(reinterpret_cast<const char *>(data), size);
    bool mdi = b.lines_only, with_ini = false;
    for (;;) {
        if (text.substr(0, 5) == "@mdi\n") mdi = true;
        else if (text.substr(0, 5) == "@ini\n") with_ini = true;
        else break;
        text.remove_prefix(5);
    }
    for (const std::string &f : b.files) unlink(f.c_str());
    b.files.clear();
    for (size_t at = text.rfind("\n@"); at != std::string_view::npos && b.files.size() < 4; at = text.rfind("\n@")) {
        const size_t end = text.find('\n', at + 1);
        std::string name;
        for (char c : text.substr(at + 2, end == std::string_view::npos ? end : end - at - 2))
            if (name.size() < 20 && (isalnum(static_cast<unsigned char>(c)) || c == '_')) name += c;
        if (name.empty() || name.find("remap") == 0) name = "sub";
        b.write(name + ".ngc", end == std::string_view::npos ? std::string_view() : text.substr(end + 1));
        b.files.push_back(name + ".ngc");
        text = text.substr(0, at + 1);
    }
    b.machine.reset(with_ini);
    b.machine.block_delete = size % 2;
    Interp &interp = (with_ini ? b.configured : b.plain).as_new();
    if (mdi) {
        interp.set_mdi_slice(50);
        run_mdi(interp, text);
    } else {
        b.write("main.ngc", text);
        run_program(interp, "main.ngc");
    }
    interp.reset();
    return 0;
}
