/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * load.cc - commands that start and end programs and realtime modules.
 *
 * Realtime modules: the running rtapi_app is asked over its socket; only when there is none
 * is the program rtapi_app executed, which starts one. Programs: fork and exec. In virtual
 * time a program that is waited for runs in our place of the clock, others get their own.
 * Around each of these halcmd gives its component back, as documented, so that its place in
 * the list of components tells what was loaded after it.
 * Source: HAL tools reference, section 1.7 (loadrt to debug).
 */
#include "commands.hh"
#include "rtapi_client.hh"

#include "hal.h"
#include "kerf_clock.h"
#include "kerf_paths.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <set>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

namespace halcmd
{

namespace
{

struct Component {
    std::string name;
    hal_comp_type_t type = HAL_COMP_TYPE_UNKNOWN;
    int pid = 0;
    bool ready = false;
};

/// All components, the newest first.
std::vector<Component> components()
{
    std::vector<Component> all;
    hal_query_t q = {};
    hal_list_comp(
        &q,
        [](hal_query_t *q, void *arg) {
            static_cast<std::vector<Component> *>(arg)->push_back({q->name, q->comp.type, q->comp.pid, q->comp.ready});
            return 0;
        },
        &all);
    return all;
}

std::optional<Component> component(const std::string &name)
{
    hal_query_t q = {};
    if (hal_comp_by_name(name.c_str(), &q) != 0) return std::nullopt;
    return Component{name, q.comp.type, q.comp.pid, q.comp.ready};
}

bool ready(const std::string &name)
{
    auto c = component(name);
    return c && c->ready;
}

int64_t wall_ms()
{
    timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * 1000LL + now.tv_nsec / 1000000;
}

std::string rtapi_app_path() { return std::string(kerf_path(KERF_PATH_BIN)) + "/rtapi_app"; }

/// How a child relates to the clock.
enum class Clock {
    Ours,    ///< none of its own: time stands or goes as if we did the work
    Lent,    ///< runs in our place until it ends
    Reserved ///< gets a place of its own
};

/// What a program called NAME.py, of the PATH, may be installed as: NAME. "" for other names.
std::string without_py(const std::string &program)
{
    size_t stem = program.size() < 3 ? 0 : program.size() - 3;
    bool of_path = program.find('/') == program.npos;
    return of_path && stem > 0 && program.compare(stem, 3, ".py") == 0 ? program.substr(0, stem) : "";
}

/// Starts a program with words as its arguments. The pid or a negative errno. A failing exec
/// is told by the child, which then ends with status 1.
pid_t start_program(Session &s, const Args &words, Clock clock)
{
    std::vector<char *> argv;
    for (auto &w : words) argv.push_back(const_cast<char *>(w.c_str()));
    argv.push_back(nullptr);
    char slot[KERF_CLOCK_SLOT_LEN] = "";
    if (clock == Clock::Lent && kerf_clock_lend(slot, sizeof slot) != 0) slot[0] = 0;
    if (clock == Clock::Reserved &&
        kerf_clock_reserve(slot, sizeof slot, words[0].c_str(), KERF_CLOCK_PRIO_USER) != 0)
        slot[0] = 0;
    fflush(stdout);
    fflush(stderr);
    pid_t pid = fork();
    if (pid == 0) {
        signal(SIGPIPE, SIG_DFL);
        if (slot[0]) setenv(KERF_CLOCK_SLOT_ENV, slot, 1);
        else unsetenv(KERF_CLOCK_SLOT_ENV);
        execvp(argv[0], argv.data());
        int why = errno;
        if (std::string plain = without_py(words[0]); !plain.empty()) execvp(plain.c_str(), argv.data());
        s.error(strf("execv(%s): %s", argv[0], strerror(why)));
        fflush(stdout);
        _exit(1);
    }
    if (pid < 0) {
        int e = errno;
        s.error(strf("fork failed: %s", strerror(e)));
        if (slot[0] && clock == Clock::Reserved) kerf_clock_unreserve(slot);
        if (slot[0] && clock == Clock::Lent) kerf_clock_reclaim();
        return -e;
    }
    if (slot[0] && clock == Clock::Reserved) kerf_clock_reserved_for(slot, pid);
    return pid;
}

/// Tells the user that a wait is long, and which other component has appeared.
class WaitNotice
{
  public:
    explicit WaitNotice(const std::string &name) : name(name), start(wall_ms())
    {
        for (auto &c : components()) before.insert(c.name);
    }

    /// Call after each poll.
    void poll()
    {
        int64_t waited = wall_ms() - start;
        if (waited < 2000) return;
        if (!told) {
            fprintf(stderr, "Waiting for component '%s' to become ready.", name.c_str());
            told = true;
            last_dot = waited;
        }
        if (waited - last_dot >= 100) {
            fputc('.', stderr);
            last_dot = waited;
        }
        if (!other_told) {
            std::string other = appeared();
            if (!other.empty()) {
                fprintf(stderr,
                        "\nWhile waiting for '%s', component '%s' loaded.\n"
                        "Did you specify the correct name via 'loadusr -Wn'?",
                        name.c_str(), other.c_str());
                other_told = true;
            }
        }
        fflush(stderr);
    }

    /// A component that came up during the wait, "" if none.
    std::string appeared() const
    {
        for (auto &c : components())
            if (c.name != name && !before.count(c.name) && c.name.compare(0, 6, "halcmd") != 0) return c.name;
        return "";
    }

    double waited_s() const { return (wall_ms() - start) / 1000.0; }

    void finish() const
    {
        if (wall_ms() - start >= 1000) fputc('\n', stderr);
    }

  private:
    std::string name;
    int64_t start, last_dot = 0;
    std::set<std::string> before;
    bool told = false, other_told = false;
};

/// Seconds that -W waits at most; 0: for ever (the default).
double wait_limit_s()
{
    const char *text = getenv("HALCMD_WAIT_TIMEOUT");
    return text ? std::max(0.0, strtod(text, nullptr)) : 0;
}

/// Waits until the component is ready or the child has ended. 0 or -1 with its texts told.
int wait_ready(Session &s, pid_t pid, const std::string &program, const std::string &name)
{
    WaitNotice notice(name);
    const double limit_s = wait_limit_s();
    int status = 0;
    bool is_ready = false, ended = false, late = false;
    for (;;) {
        ended = waitpid(pid, &status, WNOHANG) != 0; // first: a child may become ready and end at once
        is_ready = ready(name);
        late = limit_s > 0 && notice.waited_s() >= limit_s;
        if (is_ready || ended || late || s.stop) break;
        kerf_clock_sleep_ns(10'000'000);
        notice.poll();
    }
    notice.finish();
    if (is_ready) {
        s.info(strf("Component '%s' ready\n", name.c_str()));
        return 0;
    }
    if (ended) {
        if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
            s.error(strf("waitpid failed %s %s", program.c_str(), name.c_str()));
        s.error(strf("%s exited without becoming ready", program.c_str()));
    } else if (late) {
        std::string other = notice.appeared();
        s.error(strf("component '%s' of %s did not become ready within %g s%s", name.c_str(), program.c_str(), limit_s,
                     other.empty() ? "; no other component appeared"
                                   : strf("; component '%s' appeared instead", other.c_str()).c_str()));
    } else {
        s.error(strf("interrupted while waiting for component '%s'", name.c_str()));
    }
    return -1;
}

std::string join(const Args &words, size_t first)
{
    std::string text;
    for (size_t i = first; i < words.size(); i++) text += (i > first ? " " : "") + words[i];
    return text;
}

/// rtapi_app's exit status for a request: over the socket, or by executing the program.
/// The component is given back meanwhile and taken again before the request is made.
int ask_rtapi_app(Session &s, const Args &request)
{
    s.detach();
    s.attach();
    int result;
    std::string text;
    switch (rtapi_request(request, result, text)) {
    case 0:
        if (!text.empty()) s.output(text + "\n");
        return result & 0xff;
    case -EPIPE:
        s.error(strf("the realtime host (rtapi_app) died of '%s': the kernel's log (dmesg) may name the module", join(request, 0).c_str()));
        return 255;
    }
    Args words = {rtapi_app_path()};
    words.insert(words.end(), request.begin(), request.end());
    pid_t pid = start_program(s, words, Clock::Ours);
    int status;
    if (pid < 0) return 255;
    while (waitpid(pid, &status, 0) < 0)
        if (errno != EINTR) return 255;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 255;
}

bool loading_locked(Session &s)
{
    if (!(hal_get_lock() & HAL_LOCK_LOAD)) return false;
    s.error("HAL is locked, loading of programs is not permitted");
    return true;
}

/// Keeps the arguments of a module for `save comp`.
void remember_arguments(const std::string &module, const std::string &text)
{
    auto *memory = static_cast<char *>(hal_malloc(static_cast<long>(text.size() + 1)));
    if (!memory) return;
    memcpy(memory, text.c_str(), text.size() + 1);
    hal_comp_insmod_args(module.c_str(), memory);
}

} // namespace

int do_loadrt(Session &s, const Args &args)
{
    const std::string &module = args[0], program = rtapi_app_path();
    bool loaded = false;
    if (!loading_locked(s)) {
        Args request = {"load"};
        request.insert(request.end(), args.begin(), args.end());
        int status = ask_rtapi_app(s, request);
        loaded = status == 0 && ready(module);
        if (status != 0) s.error(strf("waitpid failed %s %s", program.c_str(), module.c_str()));
        if (!loaded) s.error(strf("%s exited without becoming ready", program.c_str()));
    }
    if (!loaded) {
        s.error(strf("insmod for %s failed, returned -1", module.c_str()));
        return -1;
    }
    remember_arguments(module, join(args, 1));
    s.info(strf("Component '%s' ready\n", module.c_str()));
    s.info(strf("Program '%s' started\n", program.c_str()));
    s.info(strf("Realtime module '%s' loaded\n", module.c_str()));
    return 0;
}

namespace
{

struct UserFlags {
    bool wait_ready = false, wait_end = false, ignore_status = false;
    std::string name; ///< of the component; "" = from the program
    Args words;       ///< program and its arguments
};

bool parse_flags(const Args &args, UserFlags &flags)
{
    std::vector<char *> argv = {const_cast<char *>("loadusr")};
    for (auto &a : args) argv.push_back(const_cast<char *>(a.c_str()));
    argv.push_back(nullptr);
    int argc = static_cast<int>(argv.size()) - 1;
    optind = 0; // restarts the scan
    opterr = 1;
    for (int c; (c = getopt(argc, argv.data(), "+wWin:")) != -1;) {
        switch (c) {
        case 'w': flags.wait_end = true; break;
        case 'W': flags.wait_ready = true; break;
        case 'i': flags.ignore_status = true; break;
        case 'n': flags.name = optarg; break;
        default: return false;
        }
    }
    for (int i = optind; i < argc; i++) flags.words.emplace_back(argv[i]);
    return true;
}

/// The program's file name without its last extension.
std::string component_of(const std::string &program)
{
    std::string base = program.substr(program.rfind('/') + 1);
    size_t dot = base.rfind('.');
    return dot == base.npos ? base : base.substr(0, dot);
}

/// The file that execvp would run, "" if there is none.
std::string program_file(const std::string &program)
{
    if (program.find('/') != program.npos) return program;
    std::string path = getenv("PATH") ? getenv("PATH") : "/usr/bin:/bin", dir;
    for (char c : path + ":") {
        if (c != ':') {
            dir += c;
            continue;
        }
        std::string file = (dir.empty() ? "." : dir) + "/" + program;
        if (access(file.c_str(), X_OK) == 0) return file;
        dir.clear();
    }
    std::string plain = without_py(program);
    return plain.empty() ? "" : program_file(plain);
}

/// Whether a program started in the background is likely to take part in virtual time: it or
/// a script among its arguments names HAL or our packages. A place kept for one that does not
/// would hold time for nothing.
bool knows_clock(const Args &words)
{
    static const char *const marks[] = {"liblinuxcnchal", "linuxcnc", "kerf", "import hal", "hal."};
    for (size_t i = 0; i < words.size(); i++) {
        FILE *file = fopen((i ? words[i] : program_file(words[i])).c_str(), "re");
        if (!file) continue;
        std::string text(1 << 20, '\0');
        text.resize(fread(text.data(), 1, text.size(), file));
        fclose(file);
        for (const char *mark : marks)
            if (text.find(mark) != text.npos) return true;
    }
    return false;
}

/// `loadusr -w sleep N` in virtual time waits on the clock: the program sleep knows only the
/// wall's. False if it is not that.
bool sleep_in_virtual_time(const UserFlags &flags)
{
    const Args &words = flags.words;
    if (!kerf_clock_is_virtual() || !flags.wait_end || flags.wait_ready || words.size() != 2) return false;
    if (words[0] != "sleep") return false;
    char *end;
    double seconds = strtod(words[1].c_str(), &end);
    if (end == words[1].c_str() || !(seconds >= 0) || seconds > 1e6 || (*end && (*end != 's' || end[1]))) return false;
    kerf_clock_sleep_ns(static_cast<int64_t>(seconds * 1e9));
    return true;
}

int judge_end(Session &s, const UserFlags &flags, int status)
{
    const char *program = flags.words[0].c_str();
    if (!WIFEXITED(status)) {
        s.error(strf("program '%s' did not exit normally", program));
        return -1;
    }
    if (WEXITSTATUS(status) != 0 && !flags.ignore_status) {
        s.error(strf("program '%s' failed, returned %d", program, WEXITSTATUS(status)));
        return -1;
    }
    s.info(strf("Program '%s' finished\n", program));
    return 0;
}

} // namespace

int do_loadusr(Session &s, const Args &args)
{
    UserFlags flags;
    if (loading_locked(s)) return -EPERM;
    if (!parse_flags(args, flags) || flags.words.empty()) return -EINVAL;
    const std::string &program = flags.words[0];
    if (flags.name.empty()) flags.name = component_of(program);
    if (flags.wait_ready && component(flags.name)) {
        s.error(strf("component '%s' exists already, %s was not started", flags.name.c_str(), program.c_str()));
        return -EEXIST;
    }
    if (sleep_in_virtual_time(flags)) return judge_end(s, flags, 0);
    Clock clock = Clock::Ours;
    if (flags.wait_ready || (kerf_clock_is_virtual() && knows_clock(flags.words))) clock = Clock::Reserved;
    if (flags.wait_end && !flags.wait_ready) clock = Clock::Lent;
    s.detach();
    pid_t pid = start_program(s, flags.words, clock);
    s.attach();
    if (pid < 0) return -1;
    if (flags.wait_ready) {
        if (int r = wait_ready(s, pid, program, flags.name)) return r;
    }
    if (!flags.wait_end) {
        s.info(strf("Program '%s' started\n", program.c_str()));
        return 0;
    }
    int status;
    while (kerf_clock_waitpid(pid, &status, 0) < 0)
        if (errno != EINTR) {
            s.error(strf("waitpid failed: %s", strerror(errno)));
            return -1;
        }
    return judge_end(s, flags, status);
}

/* ---- Unloading ---- */

static int unload_module(Session &s, const std::string &name)
{
    int status = ask_rtapi_app(s, {"unload", name});
    if (status == 0) {
        s.info(strf("Realtime module '%s' unloaded\n", name.c_str()));
        return 0;
    }
    s.error(strf("exit value: %d", status));
    s.error("rmmod failed, returned -1");
    return -1;
}

static void end_program(const Component &c)
{
    if (c.type == HAL_COMP_TYPE_USER && c.pid > 0 && c.pid != getpid()) kill(c.pid, SIGTERM);
}

int do_unloadrt(Session &s, const Args &args)
{
    const std::string &name = args[0];
    if (name != "all") {
        auto c = component(name);
        if (!c) {
            s.error(strf("component '%s' is not loaded", name.c_str()));
            return -ENOENT;
        }
        if (c->type != HAL_COMP_TYPE_REALTIME) {
            s.error(strf("component '%s' is not a realtime module", name.c_str()));
            return -EINVAL;
        }
        int r = unload_module(s, name);
        if (r != 0) s.error(strf("unloadrt failed on '%s'", name.c_str()));
        return r;
    }
    int result = 0;
    for (auto &c : components())
        if (c.type == HAL_COMP_TYPE_REALTIME && c.name.compare(0, 2, HAL_PSEUDO_COMP_PREFIX) != 0)
            if (int r = unload_module(s, c.name)) result = r;
    return result;
}

int do_unloadusr(Session &, const Args &args)
{
    for (auto &c : components())
        if (args[0] == "all" || c.name == args[0]) end_program(c);
    return 0;
}

int do_unload(Session &s, const Args &args)
{
    if (args[0] == "all") {
        do_unloadusr(s, args);
        return do_unloadrt(s, args);
    }
    auto c = component(args[0]);
    if (!c) {
        s.error(strf("component '%s' is not loaded", args[0].c_str()));
        return -ENOENT;
    }
    return c->type == HAL_COMP_TYPE_REALTIME ? do_unloadrt(s, args) : do_unloadusr(s, args);
}

int do_waitusr(Session &s, const Args &args)
{
    const std::string &name = args[0];
    auto c = component(name);
    if (!c) {
        s.info(strf("component '%s' not found or already exited\n", name.c_str()));
        return 0;
    }
    if (c->type != HAL_COMP_TYPE_USER) {
        s.error(strf("'%s' is not a userspace component", name.c_str()));
        return -EINVAL;
    }
    s.info(strf("Waiting for component '%s'\n", name.c_str()));
    while ((c = component(name)) && !s.stop) {
        if (kill(c->pid, 0) != 0 && errno == ESRCH) {
            s.warning(strf("the program of component '%s' (process %d) has died", name.c_str(), c->pid));
            break;
        }
        kerf_clock_sleep_ns(200'000'000);
    }
    if (s.stop) return -EINTR;
    s.info(strf("Component '%s' finished\n", name.c_str()));
    return 0;
}

int do_debug(Session &s, const Args &args)
{
    int status = ask_rtapi_app(s, {"debug", args[0]});
    if (status == 0) return 0;
    s.error(strf("exit value: %d", status));
    return -1;
}

} // namespace halcmd
