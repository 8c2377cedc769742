/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * json.cc - `show --json`: what `show` tells, as one JSON object for other programs.
 *
 * {"components": [...], "pins": [...], "signals": [...], "parameters": [...],
 *  "functions": [...], "threads": [...]}; a type after --json keeps one of the lists.
 * Numbers are JSON numbers; a float that JSON cannot hold (nan, inf) is a string.
 * Times and periods are in ns.
 */
#include "commands.hh"
#include "format.hh"
#include "snapshot.hh"

#include <cerrno>
#include <cmath>

namespace halcmd
{

namespace
{

std::string quoted(const std::string &text)
{
    std::string t = "\"";
    for (unsigned char c : text) {
        if (c == '"' || c == '\\') t += std::string("\\") + static_cast<char>(c);
        else if (c < 0x20 || c == 0x7f) t += strf("\\u%04x", c);
        else t += static_cast<char>(c);
    }
    return t + "\"";
}

std::string json_value(hal_type_t type, const hal_query_value_u &v)
{
    if (type == HAL_BIT) return v.b ? "true" : "false";
    if (type == HAL_FLOAT) return std::isfinite(v.r) ? strf("%.17g", v.r) : quoted(strf("%g", v.r));
    return value_packed(type, v);
}

std::string or_null(const std::string &text) { return text.empty() ? "null" : quoted(text); }

std::string list_of(const std::vector<std::string> &rows)
{
    std::string t = "[";
    for (size_t i = 0; i < rows.size(); i++) t += (i ? ",\n    " : "\n    ") + rows[i];
    return t + (rows.empty() ? "]" : "\n  ]");
}

std::string names_of(const std::vector<std::string> &names)
{
    std::string t = "[";
    for (size_t i = 0; i < names.size(); i++) t += (i ? ", " : "") + quoted(names[i]);
    return t + "]";
}

std::string comps(const Patterns &want)
{
    std::vector<std::string> rows;
    for (auto &c : list_comps())
        if (matches(want, c.name.c_str()))
            rows.push_back(
                strf("{\"name\": %s, \"id\": %d, \"type\": \"%s\", \"pid\": %s, \"ready\": %s, \"args\": %s}",
                     quoted(c.name).c_str(), c.id, c.type == HAL_COMP_TYPE_USER ? "user" : "realtime",
                     c.type == HAL_COMP_TYPE_USER ? strf("%d", c.pid).c_str() : "null", c.ready ? "true" : "false",
                     c.has_args ? quoted(c.args).c_str() : "null"));
    return list_of(rows);
}

std::string items(const std::vector<Item> &all, const Patterns &want, bool pins)
{
    std::vector<std::string> rows;
    for (auto &i : all) {
        if (!matches(want, i.name.c_str())) continue;
        std::string row =
            strf("{\"name\": %s, \"original\": %s, \"component\": %s, \"type\": \"%s\", \"dir\": \"%s\", \"value\": %s",
                 quoted(i.name).c_str(), or_null(i.original).c_str(), quoted(i.comp).c_str(), type_word(i.type),
                 dir_word(i.dir), json_value(i.type, i.value).c_str());
        if (pins) row += ", \"signal\": " + or_null(i.signal);
        rows.push_back(row + "}");
    }
    return list_of(rows);
}

std::string signals(const Patterns &want)
{
    auto pins = list_pins();
    auto of = pins_by_signal(pins);
    std::vector<std::string> rows;
    for (auto &s : list_signals()) {
        if (!matches(want, s.name.c_str())) continue;
        std::vector<std::string> writers, readers, bidirs;
        for (auto *p : of[s.name])
            (p->dir == HAL_OUT ? writers : p->dir == HAL_IN ? readers : bidirs).push_back(p->name);
        rows.push_back(strf("{\"name\": %s, \"type\": \"%s\", \"value\": %s, \"writer\": %s, \"readers\": %s, "
                            "\"bidirs\": %s}",
                            quoted(s.name).c_str(), type_word(s.type), json_value(s.type, s.value).c_str(),
                            writers.empty() ? "null" : quoted(writers[0]).c_str(), names_of(readers).c_str(),
                            names_of(bidirs).c_str()));
    }
    return list_of(rows);
}

std::string functs(const Patterns &want)
{
    std::vector<std::string> rows;
    for (auto &f : list_functs())
        if (matches(want, f.name.c_str()))
            rows.push_back(strf("{\"name\": %s, \"component\": %s, \"users\": %d, \"reentrant\": %s}",
                                quoted(f.name).c_str(), quoted(f.comp).c_str(), f.users,
                                f.reentrant ? "true" : "false"));
    return list_of(rows);
}

std::string threads(const Patterns &want)
{
    std::vector<std::string> rows;
    for (auto &t : list_threads())
        if (matches(want, t.name.c_str()))
            rows.push_back(strf("{\"name\": %s, \"period\": %ld, \"priority\": %d, \"time\": %s, \"tmax\": %s, "
                                "\"functions\": %s, \"init_functions\": %s}",
                                quoted(t.name).c_str(), t.period, t.priority,
                                t.timed ? strf("%ld", t.time).c_str() : "null",
                                t.timed ? strf("%ld", t.tmax).c_str() : "null", names_of(t.cyclic).c_str(),
                                names_of(t.init).c_str()));
    return list_of(rows);
}

} // namespace

int show_json(Session &s, const Args &args)
{
    const std::string what = args.empty() ? "all" : args[0];
    const Patterns want(args.size() > 1 ? args.begin() + 1 : args.end(), args.end());
    const bool all = what == "all";
    std::vector<std::string> lists;
    auto add = [&](bool wanted, const char *name, const std::string &list) {
        if (wanted) lists.push_back(strf("  \"%s\": ", name) + list);
    };
    add(all || what == "comp", "components", comps(want));
    add(all || what == "pin", "pins", items(list_pins(), want, true));
    add(all || what == "sig" || what == "signal", "signals", signals(want));
    add(all || what == "param" || what == "parameter", "parameters", items(list_params(), want, false));
    add(all || what == "funct" || what == "function", "functions", functs(want));
    add(all || what == "thread", "threads", threads(want));
    if (lists.empty()) {
        s.error(strf("Unknown 'show' type '%s'", what.c_str()));
        return -EINVAL;
    }
    std::string text = "{\n";
    for (size_t i = 0; i < lists.size(); i++) text += lists[i] + (i + 1 < lists.size() ? ",\n" : "\n");
    if (!s.silent()) s.output(text + "}\n");
    return 0;
}

} // namespace halcmd
