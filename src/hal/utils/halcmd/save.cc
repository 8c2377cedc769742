/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * save.cc - the present state as commands that would make it again.
 *
 * Source: HAL tools reference, section 1.12.
 */
#include "commands.hh"
#include "format.hh"
#include "replace_file.hh"
#include "snapshot.hh"

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace halcmd
{

namespace
{

std::string save_comps()
{
    std::string t = "# components\n";
    auto comps = list_comps();
    for (auto c = comps.rbegin(); c != comps.rend(); ++c) {
        if (c->type != HAL_COMP_TYPE_REALTIME) continue;
        if (c->has_args) t += "loadrt " + c->name + " " + c->args + "\n";
        else t += "#loadrt " + c->name + "  (not loaded by loadrt, no args saved)\n";
    }
    return t;
}

std::string aliases_of(const char *kind, const std::vector<Item> &items)
{
    std::string t = strf("# %s aliases\n", kind);
    for (auto &i : items)
        if (!i.original.empty()) t += strf("alias %s %s %s\n", kind, i.original.c_str(), i.name.c_str());
    return t;
}

std::string save_aliases() { return aliases_of("pin", list_pins()) + aliases_of("param", list_params()); }

std::string newsig(const SignalItem &s) { return strf("newsig %s %s\n", s.name.c_str(), type_field(s.type).c_str()); }

std::string save_signals(bool only_unlinked)
{
    std::string t = "# signals\n";
    for (auto &s : list_signals())
        if (!only_unlinked || (!s.readers && !s.writers)) t += newsig(s);
    return t;
}

std::string save_links(bool arrows)
{
    std::string t = "# links\n";
    for (auto &p : list_pins())
        if (!p.signal.empty())
            t += strf("linkps %s %s %s\n", p.name.c_str(), arrows ? pin_arrow(p.dir) : "", p.signal.c_str());
    return t;
}

std::string save_nets(bool arrows)
{
    std::string t = "# nets\n";
    auto pins = list_pins();
    auto of = pins_by_signal(pins);
    for (auto &s : list_signals()) {
        t += newsig(s);
        for (auto *p : of[s.name])
            t += strf("linksp %s %s %s\n", s.name.c_str(), arrows ? signal_arrow(p->dir) : "", p->name.c_str());
    }
    return t;
}

/// `net SIGNAL OUT => IO <=> IO => IN IN`
std::string net_line(const std::string &signal, const std::vector<const Item *> &pins)
{
    std::string t = "net " + signal;
    bool source = false, arrow = false;
    for (auto *p : pins)
        if (p->dir == HAL_OUT) {
            t += " " + p->name;
            source = true;
        }
    bool first_io = true;
    for (auto *p : pins)
        if (p->dir == HAL_IO) {
            t += (!first_io ? " <=> " : source ? " => " : " ") + p->name;
            first_io = false;
        }
    source = source || !first_io;
    for (auto *p : pins)
        if (p->dir == HAL_IN) {
            t += (source && !arrow ? " => " : " ") + p->name;
            arrow = true;
        }
    return t + "\n";
}

std::string save_net_lines(bool arrows)
{
    std::string t = "# nets\n";
    auto pins = list_pins();
    for (auto &[signal, linked] : pins_by_signal(pins)) {
        if (arrows) {
            t += net_line(signal, linked);
            continue;
        }
        t += "net " + signal;
        for (auto *p : linked) t += " " + p->name;
        t += "\n";
    }
    return t;
}

std::string save_params()
{
    std::string t = "# parameter values\n";
    for (auto &p : list_params())
        if (p.dir == HAL_RW) t += strf("setp %s %s\n", p.name.c_str(), value_wide(p.type, p.value).c_str());
    return t;
}

std::string save_threads()
{
    std::string t = "# realtime thread/function links\n";
    for (auto &h : list_threads()) {
        for (auto &f : h.cyclic) t += strf("addf %s %s\n", f.c_str(), h.name.c_str());
        for (auto &f : h.init) t += strf("initf %s %s\n", f.c_str(), h.name.c_str());
    }
    return t;
}

std::string save_unconnected()
{
    std::string t = "# unconnected pin values\n";
    for (auto &p : list_pins())
        if (p.signal.empty() && p.dir != HAL_OUT)
            t += strf("setp %s %s\n", p.name.c_str(), value_wide(p.type, p.value).c_str());
    return t;
}

/// The text of a type of `save`; false for a word that is none.
bool save_text(const std::string &type, std::string &t)
{
    if (type == "all" || type == "allu")
        t = save_comps() + save_aliases() + save_signals(true) + save_net_lines(true) + save_params() +
            (type == "allu" ? save_unconnected() : "") + save_threads();
    else if (type == "comp") t = save_comps();
    else if (type == "alias") t = save_aliases();
    else if (type == "sig" || type == "signal") t = save_signals(false);
    else if (type == "sigu") t = save_signals(true);
    else if (type == "link" || type == "linka") t = save_links(type == "linka");
    else if (type == "net" || type == "neta") t = save_nets(type == "neta");
    else if (type == "netl") t = save_net_lines(false);
    else if (type == "netla" || type == "netal") t = save_net_lines(true);
    else if (type == "param" || type == "parameter") t = save_params();
    else if (type == "unconnectedinpins") t = save_unconnected();
    else if (type == "thread") t = save_threads();
    else return false;
    return true;
}

} // namespace

int do_save(Session &s, const Args &args)
{
    if (s.silent()) return 0;
    const std::string type = args.empty() ? "all" : args[0];
    std::string text;
    if (!save_text(type, text)) { // a file that is there stays
        s.error(strf("Unknown 'save' type '%s'", type.c_str()));
        return -EINVAL;
    }
    if (args.size() < 2) {
        s.console(text);
        return 0;
    }
    if (linuxcnc::replace_file(args[1], text, true)) return 0;
    const bool full = errno == ENOSPC || errno == EIO || errno == EFBIG || errno == EDQUOT;
    s.error(full ? strf("Can't write 'save' destination '%s': %s", args[1].c_str(), strerror(errno))
                 : strf("Can't open 'save' destination '%s'", args[1].c_str()));
    return full ? -EIO : -EINVAL;
}

} // namespace halcmd
