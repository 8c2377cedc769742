/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * complete.cc - see complete.hh. The table of commands says what each argument is.
 */
#include "complete.hh"
#include "commands.hh"
#include "format.hh"
#include "snapshot.hh"

#include "kerf_paths.h"

#include <algorithm>
#include <dirent.h>

namespace halcmd
{

namespace
{

using Words = std::vector<std::string>;

template <class Items, class Test> void names(Words &to, const Items &items, Test test)
{
    for (auto &i : items)
        if (test(i)) to.push_back(i.name);
}

const auto any = [](const auto &) { return true; };

void modules(Words &to)
{
    if (DIR *dir = opendir(kerf_path(KERF_PATH_RTLIB))) {
        while (dirent *e = readdir(dir)) {
            std::string name = e->d_name;
            if (name.size() > 3 && name.compare(name.size() - 3, 3, ".so") == 0)
                to.push_back(name.substr(0, name.size() - 3));
        }
        closedir(dir);
    }
}

Words show_types() { return {"all", "alias", "comp", "funct", "param", "pin", "sig", "thread"}; }

/// Patterns of show and list: names of the kind that was chosen.
void of_kind(Words &to, const std::string &kind)
{
    if (kind == "pin") names(to, list_pins(), any);
    else if (kind == "sig" || kind == "signal") names(to, list_signals(), any);
    else if (kind == "param" || kind == "parameter") names(to, list_params(), any);
    else if (kind == "comp") names(to, list_comps(), any);
    else if (kind == "funct" || kind == "function") names(to, list_functs(), any);
    else if (kind == "thread") names(to, list_threads(), any);
}

/// Pins that `net` or a link can take: not linked, of the type of the signal or of pins
/// that stand before, and no second output.
void fitting_pins(Words &to, const Words &before, const std::string &signal)
{
    hal_type_t type = HAL_TYPE_UNSPECIFIED;
    bool written = false, bidir = false;
    auto signals = list_signals();
    for (auto &s : signals)
        if (s.name == signal) {
            type = s.type;
            written = s.writers > 0;
            bidir = s.bidirs > 0;
        }
    auto pins = list_pins();
    for (auto &word : before)
        for (auto &p : pins)
            if (p.name == word) {
                if (type == HAL_TYPE_UNSPECIFIED) type = p.type;
                written |= p.dir == HAL_OUT;
                bidir |= p.dir == HAL_IO;
            }
    names(to, pins, [&](const Item &p) {
        if (!p.signal.empty() || (type != HAL_TYPE_UNSPECIFIED && type != p.type)) return false;
        if (p.dir == HAL_OUT && (written || bidir)) return false;
        if (p.dir == HAL_IO && written) return false;
        return std::find(before.begin(), before.end(), p.name) == before.end();
    });
}

void fitting_functs(Words &to)
{
    names(to, list_functs(), [](const FunctItem &f) { return f.users == 0 || f.reentrant; });
}

bool settable(const Item &i) { return i.dir == HAL_RW || (i.signal.empty() && (i.dir == HAL_IN || i.dir == HAL_IO)); }

Words offers(const Command &command, const Words &before, bool &want_files)
{
    const std::string name = command.name;
    const size_t index = before.size() - 1; // of the argument to be completed
    const int limit = command.required + command.optional;
    if (command.optional >= 0 && index >= static_cast<size_t>(limit) && !(command.flags & ARROWS)) return {};
    Words to;
    switch (command.args[std::min<size_t>(index, 2)]) {
    case Arg::None: break;
    case Arg::Command:
        for (auto &c : command_table()) to.push_back(c.name);
        break;
    case Arg::Pin:
        if (name == "net" || name == "linksp") fitting_pins(to, Words(before.begin() + 2, before.end()), before[1]);
        else if (name == "unlinkp") names(to, list_pins(), [](const Item &p) { return !p.signal.empty(); });
        else fitting_pins(to, {}, "");
        break;
    case Arg::Param: names(to, list_params(), any); break;
    case Arg::PinOrParam:
        if (name == "alias" || name == "unalias") {
            of_kind(to, before[1]);
        } else {
            bool set = name == "setp";
            auto fits = [&](const Item &i) { return !set || settable(i); };
            names(to, list_pins(), fits);
            names(to, list_params(), fits);
        }
        break;
    case Arg::Signal:
        if (name == "sets") names(to, list_signals(), [](const SignalItem &s) { return s.writers == 0; });
        else names(to, list_signals(), any);
        break;
    case Arg::DelsigName:
        names(to, list_signals(), any);
        to.push_back("all");
        break;
    case Arg::Funct:
        if (name == "addf") fitting_functs(to);
        else if (name == "delf") names(to, list_functs(), [](const FunctItem &f) { return f.users > 0; });
        else names(to, list_functs(), any);
        break;
    case Arg::Thread:
        for (auto &t : list_threads()) {
            if (name == "delf" && std::find(t.cyclic.begin(), t.cyclic.end(), before[1]) == t.cyclic.end()) continue;
            to.push_back(t.name);
        }
        break;
    case Arg::Comp:
    case Arg::RtComp:
    case Arg::UserComp: {
        Arg kind = command.args[0];
        names(to, list_comps(), [&](const CompItem &c) {
            if (c.name.compare(0, 2, HAL_PSEUDO_COMP_PREFIX) == 0) return false;
            bool user = c.type == HAL_COMP_TYPE_USER;
            return kind == Arg::Comp || user == (kind == Arg::UserComp);
        });
        if (name != "waitusr") to.push_back("all");
        break;
    }
    case Arg::Module: modules(to); break;
    case Arg::Program:
    case Arg::File: want_files = true; break;
    case Arg::Type: to = {"bit", "float", "s32", "u32", "s64", "u64", "port"}; break;
    case Arg::ShowType:
        to = show_types();
        to.push_back("--json");
        break;
    case Arg::ListType: to = {"comp", "funct", "param", "pin", "sig", "thread"}; break;
    case Arg::SaveType:
        to = {"all",  "allu", "comp",  "alias", "sig",    "sigu",             "link", "linka",
              "net",  "neta", "netl",  "netla", "param",  "unconnectedinpins", "thread"};
        break;
    case Arg::StatusType: to = {"all", "lock", "mem"}; break;
    case Arg::LockType: to = {"all", "tune", "none"}; break;
    case Arg::AliasKind: to = {"pin", "param"}; break;
    case Arg::Position: break;
    case Arg::Any:
        if (before.size() > 1) {
            if (before[1] == "--json" && before.size() == 2) to = show_types();
            else of_kind(to, before[1] == "--json" ? before[2] : before[1]);
        }
        break;
    }
    return to;
}

} // namespace

Words complete(const Words &before, const std::string &prefix, bool &want_files)
{
    want_files = false;
    Words to;
    if (before.empty()) {
        for (auto &c : command_table()) to.push_back(c.name);
        to.insert(to.end(), {"exit", "quit"});
    } else if (auto *command = find_command(before[0])) {
        Words words = before;
        if (command->flags & ARROWS)
            words.erase(std::remove_if(words.begin(), words.end(),
                                       [](const std::string &w) { return w == "=>" || w == "<=" || w == "<=>"; }),
                        words.end());
        to = offers(*command, words, want_files);
    }
    to.erase(std::remove_if(to.begin(), to.end(),
                            [&](const std::string &w) { return w.compare(0, prefix.size(), prefix) != 0; }),
             to.end());
    std::sort(to.begin(), to.end());
    to.erase(std::unique(to.begin(), to.end()), to.end());
    return to;
}

Words complete_line(const std::string &line, bool &want_files)
{
    Words words;
    std::string word;
    for (char c : line) {
        if (c != ' ' && c != '\t') {
            word += c;
            continue;
        }
        if (!word.empty()) words.push_back(word);
        word.clear();
    }
    return complete(words, word, want_files);
}

} // namespace halcmd
