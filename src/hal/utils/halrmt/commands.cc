/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * commands.cc - halrmt's commands and sub-commands, from one table.
 */
#include "server.hh"

#include "../halcmd/commands.hh"
#include "../halcmd/format.hh"
#include "../halcmd/rtapi_client.hh"
#include "../halcmd/snapshot.hh"
#include "hal.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fnmatch.h>
#include <fstream>
#include <strings.h>
#include <sys/time.h>
#include <unistd.h>

using namespace halcmd;

namespace halrmt
{

namespace
{

enum class Access { None, Hello, Enable };

struct Context {
    Server &server;
    Connection &c;
    const Words &args; ///< after the sub-command
};

/// A sub-command. Functions return false after an `error:` line (NAK follows).
struct Sub {
    const char *name;
    bool (*get)(Context &);
    int get_args; ///< required
    bool (*set)(Context &);
    int set_args;
    Access access; ///< for set
    const char *help;
};

/* ---- Values and rows ---- */

const char *type5(hal_type_t type)
{
    switch (type) {
    case HAL_BIT: return "bool ";
    case HAL_FLOAT: return "real ";
    case HAL_S32: return "s32  ";
    case HAL_U32: return "u32  ";
    case HAL_S64: return "sint ";
    case HAL_U64: return "uint ";
    case HAL_PORT: return "port ";
    default: return "undef";
    }
}

const char *dir3(hal_pdir_t dir) { return dir == HAL_IN ? "IN " : dir == HAL_RO ? "RO" : dir_word(dir); }

std::string item_row(const char *word, const Item &i)
{
    return strf("%s %-30s %-11s %-12s(%3d) %s %s", word, i.name.c_str(), value_packed(i.type, i.value).c_str(),
                i.comp.c_str(), i.comp_id, type5(i.type), dir3(i.dir));
}

std::string value_row(const char *word, const std::string &name, hal_type_t type, const hal_query_value_u &v)
{
    return strf("%s %-30s %s", word, name.c_str(), value_packed(type, v).c_str());
}

/// Prints the rows that match: one item by its name, or with plural those of a pattern (any
/// case; all without one).
template <class Items, class Row>
bool rows(Context &x, const Items &items, bool plural, const char *header, const char *kind, Row row)
{
    if (x.c.header) x.c.say(header);
    bool found = false;
    for (auto &i : items) {
        bool fits = plural ? x.args.empty() || !fnmatch(x.args[0].c_str(), i.name.c_str(), FNM_CASEFOLD | FNM_NOESCAPE)
                           : x.args[0] == i.name;
        if (!fits) continue;
        found = true;
        row(i);
    }
    if (!found && !plural) x.c.error(strf("%s '%s' not found", kind, x.args[0].c_str()));
    return found || plural;
}

template <bool plural> bool get_comps(Context &x)
{
    return rows(x, list_comps(), plural, "COMP Name         Id  Type", "Component", [&](const CompItem &i) {
        x.c.say(strf("COMP %-12s %3d %s", i.name.c_str(), i.id, i.type == HAL_COMP_TYPE_USER ? "User" : "RT  "));
    });
}

template <bool plural> bool get_pins(Context &x)
{
    return rows(x, list_pins(), plural,
                "PIN Name                           Value       Component   ( id) Type  Dir", "Pin",
                [&](const Item &i) { x.c.say(item_row("PIN", i)); });
}

template <bool plural> bool get_pinvals(Context &x)
{
    return rows(x, list_pins(), plural, "PINVAL Name                           Value", "Pin",
                [&](const Item &i) { x.c.say(value_row("PINVAL", i.name, i.type, i.value)); });
}

template <bool plural> bool get_params(Context &x)
{
    return rows(x, list_params(), plural,
                "PARAM Name                           Value       Component   ( id) Type  Dir", "Param",
                [&](const Item &i) { x.c.say(item_row("PARAM", i)); });
}

template <bool plural> bool get_paramvals(Context &x)
{
    return rows(x, list_params(), plural, "PARAMVAL Name                           Value", "Param",
                [&](const Item &i) { x.c.say(value_row("PARAMVAL", i.name, i.type, i.value)); });
}

template <bool plural> bool get_signals(Context &x)
{
    return rows(x, list_signals(), plural, "SIGNAL Name                           Value       Type", "Signal",
                [&](const SignalItem &i) {
                    x.c.say(strf("SIGNAL %-30s %-11s %s", i.name.c_str(), value_packed(i.type, i.value).c_str(),
                                 type5(i.type)));
                });
}

template <bool plural> bool get_sigvals(Context &x)
{
    return rows(x, list_signals(), plural, "SIGNALVAL Name                           Value", "Signal",
                [&](const SignalItem &i) { x.c.say(value_row("SIGNALVAL", i.name, i.type, i.value)); });
}

template <bool plural> bool get_functs(Context &x)
{
    return rows(x, list_functs(), plural, "FUNCT Name             Component   ( id)   Users", "Function",
                [&](const FunctItem &i) {
                    x.c.say(strf("FUNCT %-16s %-12s(%3d) %3d", i.name.c_str(), i.comp.c_str(), i.comp_id, i.users));
                });
}

template <bool plural> bool get_threads(Context &x)
{
    return rows(x, list_threads(), plural, "THREAD Name             Period  time  tmax", "Thread",
                [&](const ThreadItem &i) {
                    x.c.say(strf("THREAD %-12s %11ld %ld %ld", i.name.c_str(), i.period, i.timed ? i.time : 0,
                                 i.timed ? i.tmax : 0));
                    int n = 0;
                    for (auto &f : i.cyclic) x.c.say(strf("THREADFUNCT %-16s %2d", f.c_str(), ++n));
                });
}

bool get_net(Context &x)
{
    hal_query_t q = {};
    q.name = x.args[0].c_str();
    if (hal_getref_s(&q) != 0) {
        x.c.error(strf("Signal '%s' not found", x.args[0].c_str()));
        return false;
    }
    const auto pins = list_pins();
    const auto of = pins_by_signal(pins);
    const auto linked = of.find(x.args[0]);
    if (linked == of.end()) return true;
    for (auto *p : linked->second)
        x.c.say(strf("%s %s %s", x.args[0].c_str(), pin_arrow(p->dir), p->name.c_str()));
    return true;
}

/* ---- Settings of the connection ---- */

const char *on_off(bool on) { return on ? "ON" : "OFF"; }

bool switch_word(Context &x, const std::string &word, bool &value)
{
    for (const char *w : {"on", "1", "true", "yes"})
        if (!strcasecmp(w, word.c_str())) return value = true, true;
    for (const char *w : {"off", "0", "false", "no"})
        if (!strcasecmp(w, word.c_str())) return value = false, true;
    x.c.error(strf("Invalid value '%s', expected on or off", word.c_str()));
    return false;
}

template <bool Connection::*field> bool set_switch(Context &x) { return switch_word(x, x.args[0], x.c.*field); }

bool get_echo(Context &x) { return x.c.say(strf("ECHO %s", on_off(x.c.echo))), true; }
bool get_header(Context &x) { return x.c.say(strf("HEADER %s", on_off(x.c.header))), true; }
bool get_verbose(Context &x) { return x.c.say(strf("VERBOSE %s", on_off(x.c.verbose))), true; }
bool get_expand(Context &x) { return x.c.say(strf("EXPAND %s", on_off(x.c.expand))), true; }
bool get_enable(Context &x) { return x.c.say(strf("ENABLE %s", on_off(x.c.enabled))), true; }
bool get_inifile(Context &x) { return x.c.say("INIFILE " + x.c.ini_file), true; }

bool get_timestamp(Context &x)
{
    x.c.say(strf("TIMESTAMP %s %s", on_off(x.c.timestamp), on_off(x.c.epoch)));
    return true;
}

bool set_timestamp(Context &x)
{
    bool on = false, epoch = x.c.epoch;
    if (!switch_word(x, x.args[0], on)) return false;
    if (x.args.size() > 1 && !switch_word(x, x.args[1], epoch)) return false;
    x.c.timestamp = on;
    x.c.epoch = epoch;
    return true;
}

bool get_time(Context &x)
{
    timeval now;
    gettimeofday(&now, nullptr);
    x.c.say(strf("TIME %lld.%06ld", static_cast<long long>(now.tv_sec), static_cast<long>(now.tv_usec)));
    return true;
}

bool set_enable(Context &x)
{
    if (!strcasecmp(x.args[0].c_str(), "off")) {
        x.c.enabled = false;
        return true;
    }
    if (x.args[0] != x.server.settings.enable_password) {
        x.c.error("Wrong password");
        return false;
    }
    x.c.enabled = true;
    return true;
}

bool set_inifile(Context &x)
{
    x.c.ini_file = x.args[0];
    return true;
}

std::optional<std::string> ini_value(const Connection &c, const std::string &section, const std::string &name)
{
    linuxcnc::IniFile ini;
    if (c.ini_file.empty() || !ini.open(c.ini_file)) return std::nullopt;
    return ini.findString(name, section);
}

bool get_ini(Context &x)
{
    const std::string &name = x.args[0], &section = x.args[1];
    auto value = ini_value(x.c, section, name);
    if (!value) {
        x.c.error(strf("INI file entry '[%s]%s' not found", section.c_str(), name.c_str()));
        return false;
    }
    x.c.say(strf("INI [%s]%s=%s", section.c_str(), name.c_str(), value->c_str()));
    return true;
}

/* ---- Locks ---- */

const struct {
    const char *word;
    int bits;
} lock_words[] = {{"load", HAL_LOCK_LOAD}, {"config", HAL_LOCK_CONFIG}, {"params", HAL_LOCK_PARAMS},
                  {"run", HAL_LOCK_RUN},   {"tune", HAL_LOCK_TUNE},     {"all", HAL_LOCK_ALL}};

bool get_lock(Context &x)
{
    int lock = hal_get_lock();
    std::string t = "LOCK";
    if (lock == HAL_LOCK_NONE) t += " none";
    else if (lock == HAL_LOCK_ALL) t += " all";
    else
        for (int i = 0; i < 4; i++)
            if (lock & lock_words[i].bits) t += std::string(" ") + lock_words[i].word;
    x.c.say(t);
    return true;
}

/// The bits that all words mean together; -1 after an error.
int lock_bits(Context &x)
{
    int bits = HAL_LOCK_NONE;
    for (auto &arg : x.args) {
        auto is = [&](const auto &w) { return !strcasecmp(w.word, arg.c_str()); };
        auto w = std::find_if(std::begin(lock_words), std::end(lock_words), is);
        if (w != std::end(lock_words)) {
            bits |= w->bits;
        } else if (strcasecmp(arg.c_str(), "none")) {
            x.c.error(strf("Invalid lock '%s'", arg.c_str()));
            return -1;
        }
    }
    return bits;
}

bool set_lock(Context &x)
{
    int bits = lock_bits(x);
    return bits >= 0 && hal_set_lock(bits ? hal_get_lock() | bits : HAL_LOCK_NONE) == 0;
}

bool set_unlock(Context &x)
{
    int bits = lock_bits(x);
    return bits >= 0 && hal_set_lock(hal_get_lock() & ~bits) == 0;
}

/* ---- Changes of HAL ---- */

/// Tells why a call of the library failed.
bool told(Context &x, const char *what, int r)
{
    if (r == 0) return true;
    x.c.error(strf("Cannot %s, error=%d", what, r));
    return false;
}

bool set_addf(Context &x)
{
    int position = -1;
    if (x.args.size() > 2) {
        char *end;
        long n = strtol(x.args[2].c_str(), &end, 10);
        if (*end || n < -1 || n > 100000) {
            x.c.error(strf("Invalid position '%s'", x.args[2].c_str()));
            return false;
        }
        position = static_cast<int>(n);
    }
    int r = hal_add_funct_to_thread(x.args[0].c_str(), x.args[1].c_str(), position);
    return told(x, strf("addf '%s' to '%s'", x.args[0].c_str(), x.args[1].c_str()).c_str(), r);
}

bool set_delf(Context &x)
{
    int r = hal_del_funct_from_thread(x.args[0].c_str(), x.args[1].c_str());
    return told(x, strf("delf '%s' from '%s'", x.args[0].c_str(), x.args[1].c_str()).c_str(), r);
}

bool set_newsig(Context &x)
{
    hal_type_t type = HAL_TYPE_UNSPECIFIED;
    for (const char *w : {"bit", "bool", "float", "real", "s32", "s64", "sint", "u32", "u64", "uint"})
        if (x.args[1] == w) type = type_of_word(w);
    if (type == HAL_TYPE_UNSPECIFIED) {
        x.c.error(strf("Invalid type '%s'", x.args[1].c_str()));
        return false;
    }
    return told(x, strf("newsig '%s'", x.args[0].c_str()).c_str(), hal_signal_new(x.args[0].c_str(), type));
}

bool set_delsig(Context &x)
{
    if (x.args[0] != "all")
        return told(x, strf("delsig '%s'", x.args[0].c_str()).c_str(), hal_signal_delete(x.args[0].c_str()));
    bool good = true;
    for (auto &s : list_signals())
        good = told(x, strf("delsig '%s'", s.name.c_str()).c_str(), hal_signal_delete(s.name.c_str())) && good;
    return good;
}

bool link(Context &x, const std::string &pin, const std::string &signal)
{
    int r = hal_link(pin.c_str(), signal.c_str());
    return told(x, strf("link '%s' to '%s'", pin.c_str(), signal.c_str()).c_str(), r);
}

bool unlink(Context &x, const std::string &pin)
{
    return told(x, strf("unlink '%s'", pin.c_str()).c_str(), hal_unlink(pin.c_str()));
}

bool set_linkps(Context &x) { return x.args.size() < 2 ? unlink(x, x.args[0]) : link(x, x.args[0], x.args[1]); }
bool set_linksp(Context &x) { return link(x, x.args[1], x.args[0]); }
bool set_unlinkp(Context &x) { return unlink(x, x.args[0]); }

/// Sends the texts of a command of halcmd to the client as errors.
class ClientChannels : public Channels
{
  public:
    explicit ClientChannels(Connection &c) : c(c) {}
    void error(const Place &, const std::string &text) override { c.error(text); }
    void warning(const Place &, const std::string &text) override { c.say("warning: " + text); }
    void info(const Place &, const std::string &) override {}
    void print(const Place &, const std::string &) override {}
    void output(const std::string &) override {}
    void console(const std::string &) override {}

  private:
    Connection &c;
};

bool halcmd_command(Context &x, int (*command)(Session &, const Args &), const Args &args)
{
    ClientChannels channels(x.c);
    Channels *before = x.server.session.channels;
    x.server.session.channels = &channels;
    int r = command(x.server.session, args);
    x.server.session.channels = before;
    return r == 0;
}

bool set_net(Context &x) { return halcmd_command(x, do_net, x.args); }
bool set_loadrt(Context &x) { return halcmd_command(x, do_loadrt, x.args); }
bool set_unload(Context &x) { return halcmd_command(x, do_unloadrt, {x.args[0]}); }
bool set_start(Context &x) { return told(x, "start", hal_start_threads()); }
bool set_stop(Context &x) { return told(x, "stop", hal_stop_threads()); }

bool set_setp(Context &x)
{
    hal_query_t q = {};
    q.name = x.args[0].c_str();
    int r = hal_set_p(
        &q,
        [](hal_query_t *q, void *arg) {
            return parse_value(q->pp.type, *static_cast<std::string *>(arg), q->pp.value);
        },
        const_cast<std::string *>(&x.args[1]));
    if (r != 0) x.c.error(strf("Cannot setp '%s' to '%s', error=%d", x.args[0].c_str(), x.args[1].c_str(), r));
    return r == 0;
}

bool set_sets(Context &x)
{
    hal_query_t q = {};
    q.name = x.args[0].c_str();
    int r = hal_set_s(
        &q,
        [](hal_query_t *q, void *arg) {
            return parse_value(q->sig.type, *static_cast<std::string *>(arg), q->sig.value);
        },
        const_cast<std::string *>(&x.args[1]));
    if (r != 0) x.c.error(strf("Cannot sets '%s' to '%s', error=%d", x.args[0].c_str(), x.args[1].c_str(), r));
    return r == 0;
}

/* ---- Programs ---- */

bool set_loadusr(Context &x)
{
    if (hal_get_lock() & HAL_LOCK_LOAD) {
        x.c.error("HAL is locked, loading of programs is not permitted");
        return false;
    }
    Job job = {&x.c, 0, false, false, false, "", ""};
    size_t i = 0;
    for (; i < x.args.size() && x.args[i].size() > 1 && x.args[i][0] == '-'; i++) {
        bool named = false;
        for (char f : x.args[i].substr(1)) {
            if (f == 'W') job.wait_ready = true;
            else if (f == 'w') job.wait_end = true;
            else if (f == 'i') job.ignore_status = true;
            else if (f == 'n') named = true;
            else {
                x.c.error(strf("Invalid option '%s'", x.args[i].c_str()));
                return false;
            }
        }
        if (named && i + 1 < x.args.size()) job.component = x.args[++i];
    }
    if (i >= x.args.size()) {
        x.c.error("No program given");
        return false;
    }
    Args words(x.args.begin() + i, x.args.end());
    job.program = words[0];
    if (job.component.empty()) {
        std::string base = words[0].substr(words[0].rfind('/') + 1);
        job.component = base.substr(0, base.rfind('.'));
    }
    std::vector<char *> argv;
    for (auto &w : words) argv.push_back(w.data());
    argv.push_back(nullptr);
    fflush(stdout);
    job.pid = fork();
    if (job.pid == 0) {
        signal(SIGPIPE, SIG_DFL);
        execvp(argv[0], argv.data());
        fprintf(stderr, "halrmt: execv(%s): %s\n", argv[0], strerror(errno));
        _exit(1);
    }
    if (job.pid < 0) return told(x, "start a program", -errno);
    if (!job.wait_ready && !job.wait_end) {
        job_done(x.c, true);
        job.owner = nullptr; // only to be reaped
    }
    x.server.jobs.push_back(job);
    return true;
}

/* ---- Save ---- */

std::string save_value(const Item &i)
{
    if (i.type == HAL_U32) return strf("0x%08llX", static_cast<unsigned long long>(i.value.u));
    return value_packed(i.type, i.value);
}

bool saved_text(const std::string &type, std::string &t)
{
    const bool all = type == "all";
    auto pins = list_pins();
    auto of = pins_by_signal(pins);
    bool known = all;
    auto section = [&](const char *name, bool also = false) {
        bool wanted = all || type == name || also;
        if (type == name || also) known = true;
        return wanted;
    };
    if (section("comp")) {
        t += "# components\n";
        for (auto &c : list_comps())
            if (c.has_args) t += "loadrt " + c.name + " " + c.args + "\n";
    }
    if (section("sig")) {
        t += "# signals\n";
        for (auto &s : list_signals()) t += strf("newsig %s %s\n", s.name.c_str(), type_word(s.type));
    }
    if (type == "link" || type == "linka") {
        known = true;
        t += "# links\n";
        for (auto &p : pins)
            if (!p.signal.empty())
                t += strf("linkps %s %s %s\n", p.name.c_str(), type == "linka" ? pin_arrow(p.dir) : "",
                          p.signal.c_str());
    }
    if (section("net", type == "neta")) {
        t += "# nets\n";
        for (auto &[signal, linked] : of) {
            t += "net " + signal;
            for (auto *p : linked)
                t += (type == "neta" ? strf(" %s ", signal_arrow(p->dir)) : std::string(" ")) + p->name;
            t += "\n";
        }
    }
    if (section("param")) {
        t += "# parameter values\n";
        for (auto &p : list_params()) t += strf("setp %s %s\n", p.name.c_str(), save_value(p).c_str());
    }
    if (section("thread")) {
        t += "# realtime thread/function links\n";
        for (auto &h : list_threads())
            for (auto &f : h.cyclic) t += strf("addf %s %s\n", f.c_str(), h.name.c_str());
    }
    return known;
}

bool set_save(Context &x)
{
    std::string text;
    if (!saved_text(x.args[0], text)) {
        x.c.error(strf("Invalid save type '%s'", x.args[0].c_str()));
        return false;
    }
    if (x.args.size() < 2) {
        x.c.output += text + "\r\n";
        return true;
    }
    std::ofstream file(x.args[1]);
    file << text;
    file.close();
    if (!file) x.c.error(strf("Cannot write file '%s'", x.args[1].c_str()));
    return static_cast<bool>(file);
}

/* ---- The table ---- */

const Sub subs[] = {
    {"ADDF", nullptr, 0, set_addf, 2, Access::Enable, "<funct> <thread> [position]"},
    {"COMP", get_comps<false>, 1, nullptr, 0, Access::None, "<component>"},
    {"COMPS", get_comps<true>, 0, nullptr, 0, Access::None, "[pattern]"},
    {"DELF", nullptr, 0, set_delf, 2, Access::Enable, "<funct> <thread>"},
    {"DELSIG", nullptr, 0, set_delsig, 1, Access::Enable, "<signal>|all"},
    {"ECHO", get_echo, 0, set_switch<&Connection::echo>, 1, Access::None, "{on|off}"},
    {"ENABLE", get_enable, 0, set_enable, 1, Access::Hello, "<password>|off"},
    {"EXPAND", get_expand, 0, set_switch<&Connection::expand>, 1, Access::Hello, "{on|off}"},
    {"FUNCT", get_functs<false>, 1, nullptr, 0, Access::None, "<function>"},
    {"FUNCTS", get_functs<true>, 0, nullptr, 0, Access::None, "[pattern]"},
    {"HEADER", get_header, 0, set_switch<&Connection::header>, 1, Access::None, "{on|off}"},
    {"INI", get_ini, 2, nullptr, 0, Access::None, "<variable> <section>"},
    {"INIFILE", get_inifile, 0, set_inifile, 1, Access::Hello, "<file>"},
    {"LINKPS", nullptr, 0, set_linkps, 1, Access::Enable, "<pin> [signal]"},
    {"LINKSP", nullptr, 0, set_linksp, 2, Access::Enable, "<signal> <pin>"},
    {"LOADRT", nullptr, 0, set_loadrt, 1, Access::Enable, "<module> [parameters]"},
    {"LOADUSR", nullptr, 0, set_loadusr, 1, Access::Enable, "[-W] [-w] [-i] [-n name] <program> [arguments]"},
    {"LOCK", get_lock, 0, set_lock, 1, Access::Enable, "{all|load|config|params|run|tune|none}..."},
    {"NET", get_net, 1, set_net, 2, Access::Hello, "<signal> <pin>..."},
    {"NEWSIG", nullptr, 0, set_newsig, 2, Access::Enable, "<signal> <type>"},
    {"PARAM", get_params<false>, 1, nullptr, 0, Access::None, "<parameter>"},
    {"PARAMS", get_params<true>, 0, nullptr, 0, Access::None, "[pattern]"},
    {"PARAMVAL", get_paramvals<false>, 1, nullptr, 0, Access::None, "<parameter>"},
    {"PARAMVALS", get_paramvals<true>, 0, nullptr, 0, Access::None, "[pattern]"},
    {"PIN", get_pins<false>, 1, nullptr, 0, Access::None, "<pin>"},
    {"PINS", get_pins<true>, 0, nullptr, 0, Access::None, "[pattern]"},
    {"PINVAL", get_pinvals<false>, 1, nullptr, 0, Access::None, "<pin>"},
    {"PINVALS", get_pinvals<true>, 0, nullptr, 0, Access::None, "[pattern]"},
    {"SAVE", nullptr, 0, set_save, 1, Access::Enable, "{all|comp|sig|link|linka|net|neta|param|thread} [file]"},
    {"SETP", nullptr, 0, set_setp, 2, Access::Enable, "<name> <value>"},
    {"SETS", nullptr, 0, set_sets, 2, Access::Enable, "<signal> <value>"},
    {"SIGNAL", get_signals<false>, 1, nullptr, 0, Access::None, "<signal>"},
    {"SIGNALS", get_signals<true>, 0, nullptr, 0, Access::None, "[pattern]"},
    {"SIGVAL", get_sigvals<false>, 1, nullptr, 0, Access::None, "<signal>"},
    {"SIGVALS", get_sigvals<true>, 0, nullptr, 0, Access::None, "[pattern]"},
    {"START", nullptr, 0, set_start, 0, Access::Enable, ""},
    {"STOP", nullptr, 0, set_stop, 0, Access::Enable, ""},
    {"THREAD", get_threads<false>, 1, nullptr, 0, Access::None, "<thread>"},
    {"THREADS", get_threads<true>, 0, nullptr, 0, Access::None, "[pattern]"},
    {"TIME", get_time, 0, nullptr, 0, Access::None, ""},
    {"TIMESTAMP", get_timestamp, 0, set_timestamp, 1, Access::None, "{on|off} [{on|off}]"},
    {"UNLINKP", nullptr, 0, set_unlinkp, 1, Access::Enable, "<pin>"},
    {"UNLOAD", nullptr, 0, set_unload, 1, Access::Enable, "<component>|all"},
    {"UNLOCK", nullptr, 0, set_unlock, 1, Access::Enable, "{all|load|config|params|run|tune|none}..."},
    {"VERBOSE", get_verbose, 0, set_switch<&Connection::verbose>, 1, Access::Hello, "{on|off}"},
};

std::string upper(std::string text)
{
    for (char &c : text) c = static_cast<char>(toupper(static_cast<unsigned char>(c)));
    return text;
}

const Sub *find_sub(const std::string &name, bool set)
{
    for (auto &s : subs)
        if (name == s.name && (set ? s.set : s.get)) return &s;
    return nullptr;
}

void get_or_set(Server &server, Connection &c, const Words &words, bool set)
{
    const char *verb = set ? "SET" : "GET";
    const std::string name = upper(words[1]);
    const Words args(words.begin() + 2, words.end());
    const Sub *sub = find_sub(name, set);
    if (!sub) {
        c.error(strf("Subcommand not found: %s %s", verb, name.c_str()));
        c.say(strf("%s NAK", verb));
        return;
    }
    const int need = set ? sub->set_args : sub->get_args;
    bool good = false;
    if (static_cast<int>(args.size()) < need)
        c.error(strf("Too few arguments to %s %s, have %zu, need %d or more", verb, name.c_str(), args.size(), need));
    else if (set && sub->access != Access::None && !c.linked)
        c.error(strf("A HELLO must be successfully negotiated for SET %s", name.c_str()));
    else if (set && sub->access == Access::Enable && !c.enabled)
        c.error(strf("Connection must be enabled for SET %s", name.c_str()));
    else {
        Context x = {server, c, args};
        good = set ? sub->set(x) : sub->get(x);
        if (good && set && sub->set == set_loadusr) return; // replied to by job_done
    }
    if (!good) c.say(strf("%s %s NAK", verb, name.c_str()));
    else if (c.verbose) c.say(strf("%s %s ACK", verb, name.c_str()));
}

void hello(Server &server, Connection &c, const Words &words)
{
    c.linked = c.enabled = false;
    if (words[1] != server.settings.connect_password) {
        c.say("HELLO NAK");
        return;
    }
    c.linked = true;
    c.client = words[2].substr(0, 80);
    linuxcnc::IniFile ini;
    std::string version = "1.1";
    if (!c.ini_file.empty() && ini.open(c.ini_file)) version = ini.findStringV("VERSION", "EMC", version);
    c.say(strf("HELLO ACK %s %s", server.settings.name.c_str(), version.c_str()));
    server.log(strf("client '%s' linked", c.client.c_str()));
}

/* What follows a sub-command: the table says it for SET where both exist; GET takes the first of it. */
std::string usage(const Sub &s, bool set)
{
    std::string text = s.help;
    if (!set && s.set) text.resize(s.get_args > 0 ? text.find(' ') : 0);
    return text.empty() ? text : " " + text;
}

void help(Connection &c, const Words &words)
{
    const std::string what = words.size() > 1 ? upper(words[1]) : "";
    if (what == "GET" || what == "SET") {
        const bool set = what == "SET";
        for (auto &s : subs)
            if (set ? s.set != nullptr : s.get != nullptr)
                c.say(strf("  %s %s%s", what.c_str(), s.name, usage(s, set).c_str()));
        return;
    }
    static const char *const lines[] = {"HELLO <password> <client name> [protocol version]",
                                        "GET <subcommand> [arguments]   (HELP GET lists them)",
                                        "SET <subcommand> [arguments]   (HELP SET lists them)",
                                        "QUIT       ends this connection",
                                        "SHUTDOWN   ends the server; needs SET ENABLE",
                                        "HELP [command]"};
    for (const char *line : lines)
        if (what.empty() || !strncmp(line, what.c_str(), what.size())) c.say(std::string("  ") + line);
}

/// Expands variables; a failure is told and leaves nothing at its place.
std::string expanded(Connection &c, const std::string &line)
{
    Lookup lookup;
    lookup.env = [&](const std::string &name) -> std::optional<std::string> {
        if (const char *value = getenv(name.c_str())) return value;
        c.error(strf("Environment variable '%s' not found", name.c_str()));
        return "";
    };
    lookup.ini = [&](const std::string &section, const std::string &name) -> std::optional<std::string> {
        if (auto value = ini_value(c, section, name)) return value;
        c.error(strf("Ini variable '[%s]%s' not found", section.c_str(), name.c_str()));
        return "";
    };
    std::string out, fault = substitute(line, lookup, out);
    if (!fault.empty()) c.error(fault);
    return out;
}

Words split(const std::string &line)
{
    Words words;
    std::string word;
    for (char ch : line + " ") {
        if (ch != ' ' && ch != '\t') word += ch;
        else if (!word.empty()) {
            words.push_back(word);
            word.clear();
        }
    }
    return words;
}

} // namespace

void job_done(Connection &c, bool good)
{
    if (!good) {
        c.error("Program failed or ended without becoming ready");
        c.say("SET LOADUSR NAK");
    } else if (c.verbose) {
        c.say("SET LOADUSR ACK");
    }
}

void execute(Server &server, Connection &c, std::string line)
{
    static const struct {
        const char *name;
        size_t words; ///< needed, the command's name included
    } commands[] = {{"HELLO", 3}, {"GET", 2}, {"SET", 2}, {"QUIT", 1}, {"SHUTDOWN", 1}, {"HELP", 1}};
    Words words = split(line);
    if (words.empty()) return;
    const std::string name = upper(words[0]);
    auto *command = std::find_if(std::begin(commands), std::end(commands), [&](auto &k) { return name == k.name; });
    if (command == std::end(commands)) {
        c.error(strf("Command '%s' not found", words[0].c_str()));
        return;
    }
    if (c.linked && c.echo && name != "HELLO") c.say(line);
    if (words.size() < command->words) {
        c.error(strf("Too few arguments for '%s' command", words[0].c_str()));
        return;
    }
    if (c.expand && name != "HELLO") {
        words = split(expanded(c, line));
        if (words.size() < command->words) {
            c.error(strf("Too few arguments for '%s' command", name.c_str()));
            return;
        }
    }
    if (name == "HELLO") hello(server, c, words);
    else if (name == "GET") get_or_set(server, c, words, false);
    else if (name == "SET") get_or_set(server, c, words, true);
    else if (name == "HELP") help(c, words);
    else if (name == "QUIT") {
        c.say("QUIT ACK");
        c.closing = true;
    } else if (c.enabled) {
        c.say("SHUTDOWN ACK");
        server.shutdown = true;
    } else {
        c.error("SHUTDOWN failed, not enabled");
        c.say("SHUTDOWN NAK");
    }
}

} // namespace halrmt
