/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * show.cc - show, list and status: what HAL holds, as text.
 *
 * Other programs read these tables by column, so widths matter.
 * Source: HAL tools reference, sections 1.9 to 1.11.
 */
#include "commands.hh"
#include "format.hh"
#include "snapshot.hh"

#include <cerrno>
#include <strings.h>

namespace halcmd
{

namespace
{

/// What a `show` was asked for.
struct Request {
    bool script = false;
    hal_type_t type = HAL_TYPE_UNSPECIFIED; ///< keep this type only
    Patterns patterns;

    bool wants(const Item &item) const
    {
        return (type == HAL_TYPE_UNSPECIFIED || type == item.type) && matches(patterns, item.name.c_str());
    }
};

constexpr int NAME = HAL_NAME_LEN; ///< width of a column of names

std::string show_comps(const Request &want)
{
    std::string t;
    if (!want.script) t += strf("Loaded HAL Components:\nID      Type  %-*s PID   State\n", NAME, "Name");
    for (auto &c : list_comps()) {
        if (!matches(want.patterns, c.name.c_str())) continue;
        bool user = c.type == HAL_COMP_TYPE_USER;
        std::string pid = user ? strf("%5d", c.pid) : strf("%5s", "");
        t += strf(" %5d  %-4s  %-*s %s %s\n", c.id, user ? "User" : "RT", NAME, c.name.c_str(), pid.c_str(),
                  c.ready ? "ready" : "initializing");
    }
    return t + "\n";
}

/// The columns that pins and parameters share.
std::string item_row(const Request &want, const Item &i)
{
    if (want.script)
        return strf("%s %s %s %s %s", i.comp.c_str(), type_field(i.type).c_str(), dir_word(i.dir),
                    value_packed(i.type, i.value).c_str(), i.name.c_str());
    return strf(" %5d  %5s %-3s  %s  %s", i.comp_id, type_field(i.type).c_str(), dir_word(i.dir),
                value_wide(i.type, i.value).c_str(), i.name.c_str());
}

std::string show_pins(const Request &want)
{
    std::string t;
    if (!want.script) t += "Component Pins:\nOwner   Type  Dir                 Value  Name\n";
    for (auto &p : list_pins()) {
        if (!want.wants(p)) continue;
        t += item_row(want, p);
        if (!p.signal.empty()) t += strf(" %s %s", pin_arrow(p.dir), p.signal.c_str());
        t += "\n";
    }
    return t + "\n";
}

std::string show_params(const Request &want)
{
    std::string t;
    if (!want.script) t += "Parameters:\nOwner   Type  Dir                 Value  Name\n";
    for (auto &p : list_params())
        if (want.wants(p)) t += item_row(want, p) + "\n";
    return t + "\n";
}

std::string show_aliases(const Request &want, const char *title, const std::vector<Item> &items)
{
    std::string t;
    if (!want.script) t += strf("%s Aliases:\n %-*s  %s\n", title, NAME, "Alias", "Original Name");
    for (auto &i : items) {
        if (i.original.empty()) continue;
        if (!matches(want.patterns, i.name.c_str()) && !matches(want.patterns, i.original.c_str())) continue;
        t += strf(" %-*s  %s\n", want.script ? 0 : NAME, i.name.c_str(), i.original.c_str());
    }
    return t + "\n";
}

std::string show_pin_aliases(const Request &want) { return show_aliases(want, "Pin", list_pins()); }

std::string show_param_aliases(const Request &want) { return show_aliases(want, "Parameter", list_params()); }

std::string show_signals(const Request &want)
{
    std::string t;
    auto pins = list_pins();
    auto of = pins_by_signal(pins);
    if (!want.script) t += "Signals:\nType                  Value  Name     (linked to)\n";
    for (auto &s : list_signals()) {
        if (want.type != HAL_TYPE_UNSPECIFIED && want.type != s.type) continue;
        if (!matches(want.patterns, s.name.c_str())) continue;
        t += strf("%s  %s  %s", type_field(s.type).c_str(),
                  (want.script ? value_packed(s.type, s.value) : value_wide(s.type, s.value)).c_str(), s.name.c_str());
        for (auto *p : of[s.name])
            t += want.script ? strf(" %s %s", signal_arrow(p->dir), p->name.c_str())
                             : strf("\n%32s %s %s", "", signal_arrow(p->dir), p->name.c_str());
        t += "\n";
    }
    return t + "\n";
}

std::string show_functs(const Request &want)
{
    std::string t;
    if (!want.script) t += "Exported Functions:\nOwner   CodeAddr      Arg           FP   Users   Name\n";
    for (auto &f : list_functs()) {
        if (!matches(want.patterns, f.name.c_str())) continue;
        if (want.script)
            t += strf("%s %08llx %08llx %s %3d %s\n", f.comp.c_str(), f.code, f.arg, "YES", f.users, f.name.c_str());
        else
            t += strf(" %05d  %08llx  %08llx  %-3s  %5d   %s\n", f.comp_id, f.code, f.arg, "YES", f.users,
                      f.name.c_str());
    }
    return t + "\n";
}

std::string show_threads(const Request &want, Session &s)
{
    std::string t;
    if (!want.script)
        t += "Realtime Threads:\n     Period  FP     Name               (     Time, Max-Time )\n";
    for (auto &h : list_threads()) {
        if (!matches(want.patterns, h.name.c_str())) continue;
        if (!h.timed) {
            s.error("unexpected: cannot find time/tmax pin for a thread");
            continue;
        }
        t += want.script ? strf("%ld %s %s %8ld %ld\n", h.period, "YES", h.name.c_str(), h.time, h.tmax)
                         : strf("%11ld  %-3s  %20s ( %8ld, %8ld )\n", h.period, "YES", h.name.c_str(), h.time, h.tmax);
        for (auto *list : {&h.cyclic, &h.init})
            for (size_t i = 0; i < list->size(); i++)
                t += want.script ? strf(" %s\n", (*list)[i].c_str())
                                 : strf("%17s%2zu %s\n", "", i + 1, (*list)[i].c_str());
    }
    return t + "\n";
}

/// The type of a `-t` option, unspecified for a word that is none.
hal_type_t filter_type(const std::string &word)
{
    if (word == "signed") return HAL_S32;
    if (word == "unsigned") return HAL_U32;
    for (char c : word)
        if (c >= 'A' && c <= 'Z') return HAL_TYPE_UNSPECIFIED;
    return type_of_word(word);
}

/// Takes `-tTYPE` or `-t TYPE` from the first of the words after the section's name.
Request request_of(const Session &s, const Args &args, bool typed)
{
    Request want;
    want.script = s.script;
    size_t first = 1;
    if (typed && args.size() > 1 && args[1].compare(0, 2, "-t") == 0) {
        first = 2;
        std::string word = args[1].substr(2);
        if (word.empty() && args.size() > 2) word = args[first++];
        want.type = filter_type(word);
    }
    want.patterns.assign(args.size() > first ? args.begin() + first : args.end(), args.end());
    return want;
}

} // namespace

int do_show(Session &s, const Args &args)
{
    if (!args.empty() && args[0] == "--json") return show_json(s, Args(args.begin() + 1, args.end()));
    const std::string what = args.empty() ? "all" : args[0];
    const bool typed = what == "pin" || what == "sig" || what == "signal" || what == "param" || what == "parameter";
    const Request want = request_of(s, args, typed);
    std::string text;
    if (what == "all")
        text = show_comps(want) + show_pins(want) + show_pin_aliases(want) + show_signals(want) + show_params(want) +
               show_param_aliases(want) + show_functs(want) + show_threads(want, s);
    else if (what == "comp") text = show_comps(want);
    else if (what == "pin") text = show_pins(want);
    else if (what == "sig" || what == "signal") text = show_signals(want);
    else if (what == "param" || what == "parameter") text = show_params(want);
    else if (what == "funct" || what == "function") text = show_functs(want);
    else if (what == "thread") text = show_threads(want, s);
    else if (what == "alias") text = show_pin_aliases(want) + show_param_aliases(want);
    else {
        if (s.silent()) return 0;
        s.error(strf("Unknown 'show' type '%s'", what.c_str()));
        return -EINVAL;
    }
    if (!s.silent()) s.output(text);
    return 0;
}

int do_list(Session &s, const Args &args)
{
    if (s.silent()) return 0;
    const std::string &what = args[0];
    const Patterns patterns(args.begin() + 1, args.end());
    std::string text;
    auto add = [&](const auto &items) {
        for (auto &i : items)
            if (matches(patterns, i.name.c_str())) text += i.name + " ";
    };
    if (what == "comp") add(list_comps());
    else if (what == "pin") add(list_pins());
    else if (what == "sig" || what == "signal") add(list_signals());
    else if (what == "param" || what == "parameter") add(list_params());
    else if (what == "funct" || what == "function") add(list_functs());
    else if (what == "thread") add(list_threads());
    else {
        s.error(strf("Unknown 'list' type '%s'", what.c_str()));
        return -EINVAL;
    }
    s.output(text + "\n");
    return 0;
}

static std::string status_lock()
{
    unsigned lock = hal_get_lock();
    std::string t = strf("HAL locking status:\n  current lock value %u (%02x)\n", lock, lock);
    if (lock == HAL_LOCK_NONE) t += "  HAL_LOCK_NONE - nothing is locked\n";
    if (lock & HAL_LOCK_LOAD) t += "  HAL_LOCK_LOAD    - loading of new components is locked\n";
    if (lock & HAL_LOCK_CONFIG) t += "  HAL_LOCK_CONFIG  - link and addf is locked\n";
    if (lock & HAL_LOCK_PARAMS) t += "  HAL_LOCK_PARAMS  - setting params is locked\n";
    if (lock & HAL_LOCK_RUN) t += "  HAL_LOCK_RUN     - running/stopping HAL is locked\n";
    return t;
}

static std::string status_mem()
{
    hal_statistics_t m = {};
    hal_statistics(&m);
    std::string t = "HAL memory status\n";
    t += strf("  used/total shared memory:   %ld/%ld\n", m.mem_total - m.mem_free, m.mem_total);
    t += strf("  active/recycled components: %d/%d\n", m.ncomps, m.ncomps_free);
    t += strf("  active/recycled pins:       %d/%d\n", m.npins, m.npins_free);
    t += strf("  active/recycled parameters: %d/%d\n", m.nparams, m.nparams_free);
    t += strf("  active/recycled aliases:    %d/%d\n", m.naliases, m.naliases_free);
    t += strf("  active/recycled signals:    %d/%d\n", m.nsignals, m.nsignals_free);
    t += strf("  active/recycled functions:  %d/%d\n", m.nfuncts, m.nfuncts_free);
    t += strf("  active/recycled threads:    %d/%d\n", m.nthreads, m.nthreads_free);
    return t;
}

int do_status(Session &s, const Args &args)
{
    if (s.silent()) return 0;
    const std::string what = args.empty() ? "all" : args[0];
    if (what == "lock") s.output(status_lock());
    else if (what == "mem") s.output(status_mem());
    else if (what == "all") s.output(status_lock() + status_mem());
    else {
        s.error(strf("Unknown 'status' type '%s'", what.c_str()));
        return -EINVAL;
    }
    return 0;
}

} // namespace halcmd
