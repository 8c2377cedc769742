/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * main.cc - the program halcmd: options, input, interactive editing.
 *
 * Exit status: 0, 1 when a command failed, 255 for a wrong call.
 * Source: HAL tools reference, sections 1.1 and 1.2.
 */
#include "commands.hh"
#include "complete.hh"
#include "session.hh"

#include "hal.h"
#include "inifile.hh"
#include "kerf_clock.h"
#include "rtapi.h"
#include "config.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <unistd.h>
#ifdef HAVE_READLINE
#include <readline/history.h>
#include <readline/readline.h>
#endif

using namespace halcmd;

static Session *running; ///< for signal handlers

static void on_signal(int)
{
    if (running->busy && !running->stop) { // a second signal does not wait for the command
        running->stop = 1;
        return;
    }
    running->leave();
    _exit(1);
}

static void catch_signals()
{
    struct sigaction act = {};
    act.sa_handler = on_signal;
    sigaction(SIGINT, &act, nullptr);
    sigaction(SIGTERM, &act, nullptr);
    signal(SIGPIPE, SIG_IGN);
}

/* ---- Completion for shells ---- */

static int print_completions()
{
    const char *line = getenv("COMP_LINE"), *point = getenv("COMP_POINT");
    if (!line) return 0;
    std::string text(line);
    if (point) text.resize(std::min(text.size(), static_cast<size_t>(std::max(0, atoi(point)))));
    // The first word is the program; words that begin with - are its options.
    size_t at = text.find_first_of(" \t");
    text = at == text.npos ? "" : text.substr(at);
    for (;;) {
        size_t word = text.find_first_not_of(" \t");
        size_t end = word == text.npos ? word : text.find_first_of(" \t", word);
        if (word == text.npos || text[word] != '-' || end == text.npos) break;
        text = text.substr(end);
    }
    rtapi_set_msg_level(RTAPI_MSG_NONE);
    bool mapped = hal_lib_init() == 0, files;
    for (auto &word : complete_line(text, files)) puts(word.c_str());
    if (mapped) hal_lib_exit();
    return 0;
}

/* ---- Interactive input ---- */

#ifdef HAVE_READLINE
static const int HISTORY_LINES = 1000;
static std::vector<std::string> candidates;
static size_t next_candidate;

static char *generate(const char *, int state)
{
    if (!state) next_candidate = 0;
    return next_candidate < candidates.size() ? strdup(candidates[next_candidate++].c_str()) : nullptr;
}

static char **attempt(const char *, int start, int end)
{
    bool files = false;
    candidates = complete_line(std::string(rl_line_buffer, end), files);
    (void)start;
    rl_attempted_completion_over = !files;
    return candidates.empty() ? nullptr : rl_completion_matches("", generate);
}

static std::string history_path()
{
    const char *home = getenv("HOME");
    return home ? std::string(home) + "/.halcmd_history" : "";
}

/// Reads lines with editing, history and completion until the end of input.
static void run_readline(Session &s)
{
    rl_readline_name = "halcmd";
    rl_completer_word_break_characters = const_cast<char *>(" \t");
    rl_attempted_completion_function = attempt;
    const std::string file = history_path();
    using_history();
    stifle_history(HISTORY_LINES);  // also of a session that lasts for weeks
    if (!file.empty()) read_history(file.c_str());
    Joiner joiner;
    std::string line;
    while (!s.stop && !s.quit_seen) {
        kerf_clock_suspend();
        char *text = readline(joiner.pending() ? "halcmd+: " : "halcmd: ");
        kerf_clock_resume();
        if (!text) break;
        s.place.line++;
        std::string physical(text, strnlen(text, MAX_PHYSICAL - 1));
        if (*text) add_history(text);
        free(text);
        if (!joiner.add(physical, line)) continue;
        if (s.run_line(line) != 0) s.failures++;
        fflush(stdout);
    }
    if (!file.empty()) write_history(file.c_str());
}
#endif

/// Reads a terminal without editing (script mode, or built without readline).
static void run_prompted(Session &s)
{
    Joiner joiner;
    std::string physical, line;
    bool cut;
    while (!s.stop && !s.quit_seen) {
        fputs(s.script ? "%%\n" : joiner.pending() ? "halcmd+: " : "halcmd: ", stdout);
        fflush(stdout);
        kerf_clock_suspend();
        bool more = read_physical(stdin, physical, s.place.line, cut);
        kerf_clock_resume();
        if (!more) break;
        if (!joiner.add(physical, line)) continue;
        if (s.run_line(line) != 0) s.failures++;
        fflush(stdout);
    }
}

static void run_terminal(Session &s)
{
#ifdef HAVE_READLINE
    if (!s.script) {
        run_readline(s);
        return;
    }
#endif
    run_prompted(s);
}

/* ---- Options ---- */

namespace
{
struct Options {
    bool from_file = false, help = false, completion = false, release = false;
    std::string ini;
    bool bad = false;
};
} // namespace

static Options parse_options(Session &s, int argc, char **argv)
{
    Options o;
    for (int c; (c = getopt(argc, argv, "+RCfi:kqQsvVhe")) != -1;) {
        switch (c) {
        case 'R': o.release = true; return o;
        case 'C': o.completion = true; return o;
        case 'h': o.help = true; return o;
        case 'f': o.from_file = true; break;
        case 'i':
            if (o.ini.empty()) o.ini = optarg;
            break;
        case 'k': s.keep_going = true; break;
        case 'q': s.level = Level::Err; break;
        case 'Q': s.level = Level::None; break;
        case 'v': s.level = Level::Info; break;
        case 'V': s.level = Level::All; break;
        case 's': s.script = true; break;
        case 'e': s.echo = true; break;
        default: o.bad = true; return o;
        }
    }
    return o;
}

/// Executes what the options and words ask for; HAL is attached. The exit status.
static int execute(Session &s, const Options &o, int argc, char **argv, FILE *file)
{
    if (!o.from_file) {
        if (s.run(Args(argv + optind, argv + argc)) != 0) s.failures++;
    } else if (file == stdin && isatty(STDIN_FILENO)) {
        run_terminal(s);
    } else {
        s.run_stream(file);
    }
    fflush(stdout);
    if (s.stop) s.failures++;
    return s.failures ? 1 : 0;
}

int main(int argc, char **argv)
{
    Session s;
    TerminalChannels channels(s.level);
    s.channels = &channels;
    if (argc < 2) {
        fputs(general_help(false).c_str(), stdout);
        return 0;
    }
    Options o = parse_options(s, argc, argv);
    if (o.bad) return 255;
    if (o.completion) return print_completions();
    if (o.help) {
        if (optind < argc) do_help(s, {argv[optind]});
        else fputs(general_help(true).c_str(), stdout);
        return 0;
    }
    if (o.release) {
        if (hal_mutex_force_release() == 0) return 0;
        puts("HALCMD: Release Mutex failed!");
        return 1;
    }
    if (!o.ini.empty() && !o.from_file) {
        fputs("-i may only be used together with -f\n", stderr);
        return 1;
    }
    linuxcnc::IniFile ini;
    if (!o.ini.empty()) {
        if (!ini.open(o.ini)) return 255;
        s.ini = &ini;
    }
    FILE *file = nullptr;
    if (o.from_file) {
        file = stdin;
        s.place = {"<stdin>", 0};
        if (optind < argc) {
            s.place.file = argv[optind];
            if (!(file = fopen(argv[optind], "re"))) {
                fprintf(stderr, "Could not open command file '%s'\n", argv[optind]);
                return 255;
            }
        }
    }
    rtapi_set_msg_level(static_cast<int>(s.level));
    kerf_clock_join("halcmd", KERF_CLOCK_PRIO_USER);
    running = &s;
    catch_signals();
    if (int r = s.attach()) {
        fprintf(stderr, "halcmd: hal_init() failed: %d\nNOTE: 'rtapi' kernel module must be loaded\n", r);
        return 1;
    }
    int status = execute(s, o, argc, argv, file);
    s.leave();
    kerf_clock_leave();
    return status;
}
