// SPDX-License-Identifier: GPL-2.0-or-later
//
// kerf_time.cc - `kerf-time -ini FILE [options] PROGRAM`: how long a program will run on the machine
// that runs now, from where it stands. Nothing moves, no file is written.
//
// In:     the machine's status and tools; the INI file's limits; a program
// Out:    stdout: `LINE NUMBER SECONDS` when a move begins (at most every STEP_S seconds of the machine, and every
//         SHARE of the time so far), last `end SECONDS`, `stopped SECONDS REASON` or `endless SECONDS REASON`.
//         Exit status 0; 1 when nothing is known
// Thread: [task]; a process of its own, so that a program without an end can be stopped
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "client.hh"
#include "dry_run.hh"
#include "emc_args.hh"
#include "emc/canon/hal_number.hh"
#include "rtapi.h"
#include "run_time.hh"

namespace {

constexpr double STEP_S = 0.2;
constexpr double SHARE = 1e-4;      // of the time so far: an endless program has few lines, too
constexpr int LINES = 100;          // read at a time

const char USAGE[] =
    "usage: kerf-time -ini FILE [-f FEED] [-r RAPID] [-s SPINDLE] [-v MAX_VELOCITY] [-t TOOL_CHANGE_S]\n"
    "       [-a S_PER_RPM] [-u USER_CODE_S] [-c CPU_SECONDS] [-i CODE]... [-b 0|1] [-p PID] PROGRAM\n"
    "Prints how long PROGRAM will run on the running machine. FEED, RAPID, SPINDLE: overrides, 1 = 100 %.\n"
    "-i: a line that is executed before and does not count. \n"
    "-a: what a spindle takes to change its speed. -b: lines with '/' are left out (1, default) or not.\n"
    "-p: ends with the process PID that started it.\n";

struct Options {
    std::string ini, program;
    Rates rates;
    std::vector<std::string> init;
    double cpu_s = 300;
    bool block_delete = true;
    double parent = 0;
};

bool number(const char *text, double least, double *value) {
    char *end;
    *value = strtod(text, &end);
    return end != text && *end == 0 && *value >= least && *value < 1e100;
}

bool parse(int argc, char **argv, Options *o) {
    for (int i = 1; i < argc; i++) {
        const std::string word = argv[i];
        if (word[0] != '-') {
            if (!o->program.empty()) return false;
            o->program = word;
            continue;
        }
        if (++i >= argc) return false;
        double block = 1;
        if (word == "-ini") o->ini = argv[i];
        else if (word == "-i") o->init.emplace_back(argv[i]);
        else if (word == "-f" && number(argv[i], 0.001, &o->rates.feed)) continue;
        else if (word == "-r" && number(argv[i], 0.001, &o->rates.rapid)) continue;
        else if (word == "-s" && number(argv[i], 0.001, &o->rates.spindle)) continue;
        else if (word == "-v" && number(argv[i], 1e-9, &o->rates.max_velocity)) continue;
        else if (word == "-t" && number(argv[i], 0, &o->rates.tool_change_s)) continue;
        else if (word == "-a" && number(argv[i], 0, &o->rates.s_per_rpm)) continue;
        else if (word == "-u" && number(argv[i], 0, &o->rates.user_code_s)) continue;
        else if (word == "-c" && number(argv[i], 0, &o->cpu_s)) continue;
        else if (word == "-p" && number(argv[i], 1, &o->parent)) continue;
        else if (word == "-b" && number(argv[i], 0, &block)) o->block_delete = block != 0;
        else return false;
    }
    return !o->ini.empty() && !o->program.empty();
}

double cpu_seconds() {
    timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void wire(TaskCanon &canon) {
    canon.user_code_exists = [](int) { return true; };
    canon.user_code_command = [](int n, double, double) { return "M" + std::to_string(100 + n); };
    canon.hal_lookup = [](const char *name, double *value) { return hal_number_joining("time", name, value); };
}

// What the lines before the program leave, as the planner and the interpreter of the program start with it.
bool prepare(Interp &interp, TaskCanon &canon, InterpList &list, RunTime &time, const Options &o,
             const InterpOptions &how) {
    interp.keep_parameters(false);
    int r = interp.init(how);
    for (size_t i = 0; i < o.init.size() && r <= INTERP_MIN_ERROR; i++) r = interp.execute(o.init[i].c_str());
    if (r > INTERP_MIN_ERROR) {
        fprintf(stderr, "kerf-time: %s\n", interp.error_text(r));
        return false;
    }
    canon.FINISH();
    while (!list.empty()) {
        const InterpList::Entry order = list.take();
        time.take(&order);
    }
    time.drain();
    time.restart();
    return true;
}

int run(const Options &o, const linuxcnc::IniFile &ini, const EMC_STAT &now) {
    RunTime time(now, ini, o.rates);
    const AxisLimits limits = axis_limits(ini);
    CanonSettings settings;
    settings.parameter_file = ini.findStringV("PARAMETER_FILE", "RS274NGC", "");
    InterpOptions how;
    how.ini_file = o.ini;
    EMC_STAT stat = now;
    InterpList list;
    TaskCanon canon(stat, list, limits, settings);
    canon.block_delete = o.block_delete;
    wire(canon);
    const std::string language = ini.findStringV("INTERPRETER", "TASK", "");
    std::string why;
    const std::unique_ptr<Interp> interp = make_interpreter(language, canon, &why);
    if (!interp) {
        fprintf(stderr, "kerf-time: %s\n", why.c_str());
        return 1;
    }
    if (!prepare(*interp, canon, list, time, o, how)) return 1;

    DryRun dry(stat, limits, settings);
    dry.watch = [&time](const InterpList::Entry *order) { time.take(order); };
    std::unique_ptr<Interp> own = make_interpreter(language, dry.canon(), &why);
    own->keep_parameters(false);
    if (own->init(how) > INTERP_MIN_ERROR || !dry.begin(std::move(own), canon, *interp, o.program, INT_MAX)) {
        fprintf(stderr, "kerf-time: %s\n", dry.error().c_str());
        return 1;
    }
    double shown = -STEP_S;
    time.on_move = [&shown](int line, long number, double seconds) {
        if (seconds - shown < std::max(STEP_S, SHARE * seconds)) return;
        shown = seconds;
        printf("%d %ld %.3f\n", line, number, seconds);
    };
    DryRun::Result result = DryRun::Result::more;
    bool endless = false;
    while (result == DryRun::Result::more && why.empty()) {
        result = dry.step(LINES);
        why = time.failed();
        if (why.empty() && cpu_seconds() > o.cpu_s) {
            why = "it takes too long to find out";
            endless = true;
        }
    }
    time.drain();
    if (why.empty()) why = time.failed();
    if (why.empty() && result == DryRun::Result::failed) why = dry.error();
    const Waits &w = time.waits();
    printf("waits %d %d %d %d %d\n", w.tool_changes, w.spindle_starts, w.user_codes, w.inputs, w.stops);
    if (why.empty()) printf("end %.3f\n", time.seconds());
    else printf("%s %.3f %s\n", endless ? "endless" : "stopped", time.seconds(), why.c_str());
    return 0;
}

} // namespace

int main(int argc, char **argv) {
    Options o;
    if (!parse(argc, argv, &o)) {
        fputs(USAGE, stderr);
        return 2;
    }
    if (o.parent > 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (getppid() != static_cast<pid_t>(o.parent)) return 1; // it is gone already
    }
    linuxcnc::IniFile ini;
    if (!ini.open(o.ini)) return 1;
    EmcArgs args(argc, argv); // NML settings of the INI file
    setenv("INI_FILE_NAME", o.ini.c_str(), 1);
    EmcClient client;
    EMC_STAT now;
    // A machine that just starts has no status yet. Wall time: this process is no part of the machine's.
    bool known = client.valid() && client.refresh(&now);
    for (int tries = 0; client.valid() && !known && tries < 40; tries++) {
        const timespec nap{0, 50'000'000};
        nanosleep(&nap, nullptr);
        known = client.refresh(&now);
    }
    if (!known) {
        fputs("kerf-time: no machine runs\n", stderr);
        return 1;
    }
    // The machine may run: on paper it rests where it is, with an empty queue.
    now.motion.traj.queue = now.motion.traj.activeQueue = 0;
    now.motion.traj.queueFull = false;
    now.io.tool.pocketPrepped = -1;
    rtapi_set_msg_level(RTAPI_MSG_NONE);
    tool_mmap_user();
    return run(o, ini, now);
}
