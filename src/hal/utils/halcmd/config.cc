/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * config.cc - commands that change or read signals, links, values, threads and locks.
 *
 * The HAL library tells why it refuses (HAL: ERROR: ...); the line that names the failed
 * command comes from here. Source: HAL tools reference, section 1.7.
 */
#include "commands.hh"
#include "format.hh"

#include "hal.h"

#include <cerrno>
#include <climits>
#include <cstdlib>

namespace halcmd
{

static const char *or_null(const Args &args, size_t i) { return i < args.size() ? args[i].c_str() : nullptr; }

/* ---- Functions and threads ---- */

/// A position as people write it: the leading number, 0 if there is none.
static int position_of(const Args &args, size_t i)
{
    if (i >= args.size()) return -1;
    long n = strtol(args[i].c_str(), nullptr, 10);
    return n > INT_MAX ? INT_MAX : n < INT_MIN ? INT_MIN : static_cast<int>(n);
}

int do_addf(Session &s, const Args &args)
{
    int r = hal_add_funct_to_thread(args[0].c_str(), args[1].c_str(), position_of(args, 2));
    if (r == 0) s.info(strf("Function '%s' added to thread '%s'\n", args[0].c_str(), args[1].c_str()));
    else s.error("addf failed");
    return r;
}

int do_initf(Session &s, const Args &args)
{
    int r = hal_init_funct_to_thread(args[0].c_str(), args[1].c_str(), position_of(args, 2));
    if (r == 0)
        s.info(strf("Init function '%s' registered on thread '%s'\n", args[0].c_str(), args[1].c_str()));
    else if (r == -EALREADY)
        s.error(strf("initf: thread '%s' init cycle already executed; '%s' was NOT registered", args[1].c_str(),
                     args[0].c_str()));
    else
        s.error("initf failed");
    return r;
}

int do_delf(Session &s, const Args &args)
{
    int r = hal_del_funct_from_thread(or_null(args, 0), or_null(args, 1));
    if (r == 0) s.info(strf("Function '%s' removed from thread '%s'\n", args[0].c_str(), args[1].c_str()));
    else s.error("delf failed");
    return r;
}

int do_start(Session &s, const Args &)
{
    int r = hal_start_threads();
    if (r == 0) s.info("Realtime threads started\n");
    else s.error("start failed");
    return r;
}

int do_stop(Session &s, const Args &)
{
    int r = hal_stop_threads();
    if (r == 0) s.info("Realtime threads stopped\n");
    else s.error("stop failed");
    return r;
}

int do_setexact(Session &s, const Args &)
{
    hal_query_t q = {};
    bool threads = hal_list_thread(&q, [](hal_query_t *, void *) { return 1; }, nullptr) == 1;
    int r = threads ? -EBUSY : hal_enforce_exact_base_period();
    if (r != 0) {
        s.error("HAL_LIB: Cannot run 'setexact' after a thread has been created");
        return -EINVAL;
    }
    s.warning("HAL_LIB: HAL will pretend that the exact base period requested is possible.\n"
              "This mode is not suitable for running real hardware.");
    return 0;
}

/* ---- Names ---- */

static int set_alias(Session &s, const Args &args, const char *alias, const char *failure)
{
    const std::string &kind = args[0], &name = args[1];
    int r = -EINVAL;
    if (kind == "pin") r = hal_pin_alias(name.c_str(), alias);
    else if (kind == "param") r = hal_param_alias(name.c_str(), alias);
    else if (!alias) return -EINVAL; // documented: a wrong first word of unalias fails without a text
    if (r != 0) s.error(failure);
    else if (alias) s.info(strf("%s '%s' aliased to '%s'\n", kind.c_str(), name.c_str(), alias));
    else s.info(strf("%s '%s' unaliased\n", kind.c_str(), name.c_str()));
    return r;
}

int do_alias(Session &s, const Args &args) { return set_alias(s, args, args[2].c_str(), "alias failed"); }

int do_unalias(Session &s, const Args &args) { return set_alias(s, args, nullptr, "unalias failed"); }

/* ---- Signals and links ---- */

int do_newsig(Session &s, const Args &args)
{
    hal_type_t type = type_of_word(args[1]);
    if (type == HAL_TYPE_UNSPECIFIED) {
        s.error(strf("Unknown signal type '%s'", args[1].c_str()));
        return -EINVAL;
    }
    int r = hal_signal_new(args[0].c_str(), type);
    if (r != 0) s.error("newsig failed");
    return r;
}

static std::vector<std::string> signal_names()
{
    std::vector<std::string> names;
    hal_query_t q = {};
    hal_list_s(
        &q,
        [](hal_query_t *q, void *arg) {
            static_cast<std::vector<std::string> *>(arg)->push_back(q->name);
            return 0;
        },
        &names);
    return names;
}

static int delete_signal(Session &s, const std::string &name)
{
    int r = hal_signal_delete(name.c_str());
    if (r == 0) s.info(strf("Signal '%s' deleted'\n", name.c_str()));
    return r;
}

int do_delsig(Session &s, const Args &args)
{
    if (args[0] != "all") return delete_signal(s, args[0]);
    auto names = signal_names();
    if (names.empty()) {
        s.error("no signals found to be deleted");
        return -ENOENT;
    }
    int result = 0;
    for (auto &name : names)
        if (int r = delete_signal(s, name)) result = r;
    return result;
}

static int link_pin(Session &s, const std::string &pin, const std::string &signal)
{
    int r = hal_link(pin.c_str(), signal.c_str());
    if (r == 0) s.info(strf("Pin '%s' linked to signal '%s'\n", pin.c_str(), signal.c_str()));
    else s.error("link failed");
    return r;
}

int do_linkps(Session &s, const Args &args) { return link_pin(s, args[0], args[1]); }

int do_linksp(Session &s, const Args &args) { return link_pin(s, args[1], args[0]); }

int do_unlinkp(Session &s, const Args &args)
{
    int r = hal_unlink(args[0].c_str());
    if (r == 0) s.info(strf("Pin '%s' unlinked\n", args[0].c_str()));
    else s.error("unlink failed");
    return r;
}

namespace
{

/// What `net` knows of a signal while it looks at the pins of one line.
struct NetState {
    std::string signal;
    hal_type_t type = HAL_TYPE_UNSPECIFIED; ///< unspecified until the signal or a pin fixes it
    bool exists = false;
    std::string writer, bidir; ///< names of an OUT pin and of an I/O pin, if any

    explicit NetState(const std::string &name) : signal(name)
    {
        hal_query_t q = {};
        q.name = name.c_str();
        if (hal_getref_s(&q) != 0) return;
        exists = true;
        type = q.sig.type;
        hal_query_t pins = {};
        pins.name = name.c_str();
        hal_list_p_s(
            &pins,
            [](hal_query_t *q, void *arg) {
                auto *state = static_cast<NetState *>(arg);
                if (q->pp.dir == HAL_OUT) state->writer = q->name;
                if (q->pp.dir == HAL_IO && state->bidir.empty()) state->bidir = q->name;
                return 0;
            },
            this);
    }

    /// The reason why the pin cannot join, "" if it can; then counts it in.
    std::string add(const std::string &pin)
    {
        hal_query_t q = {};
        q.name = pin.c_str();
        q.qtype = HAL_QTYPE_PIN;
        if (hal_getref_p(&q) != 0) return strf("Pin '%s' does not exist", pin.c_str());
        const char *current = q.name; // its alias, if it has one
        if (q.pp.signal) {
            if (signal == q.pp.signal) return "";
            return strf("Pin '%s' was already linked to signal '%s'", current, q.pp.signal);
        }
        if (type == HAL_TYPE_UNSPECIFIED) type = q.pp.type;
        if (type != q.pp.type)
            return strf("Signal '%s' of type '%s' cannot add pin '%s' of type '%s'", signal.c_str(), type_word(type),
                        current, type_word(q.pp.type));
        const std::string &other = !writer.empty() || q.pp.dir != HAL_OUT ? writer : bidir;
        if (q.pp.dir != HAL_IN && !other.empty())
            return strf("Signal '%s' can not add %s pin '%s', it already has %s pin '%s'", signal.c_str(),
                        dir_word(q.pp.dir), current, &other == &writer ? "OUT" : "I/O", other.c_str());
        if (q.pp.dir == HAL_OUT) writer = current;
        if (q.pp.dir == HAL_IO) bidir = current;
        return "";
    }
};

} // namespace

int do_net(Session &s, const Args &args)
{
    const std::string &signal = args[0];
    NetState state(signal);
    for (size_t i = 1; i < args.size(); i++) {
        std::string fault = state.add(args[i]);
        if (fault.empty()) continue;
        s.error(fault);
        return -EINVAL;
    }
    if (args.size() == 1) {
        s.error("'net' requires at least one pin, none given");
        return -EINVAL;
    }
    if (!state.exists) {
        hal_query_t q = {};
        q.name = signal.c_str();
        if (hal_getref_p(&q) == 0) {
            s.error(strf("Signal name '%s' must not be the same as a pin.  Did you omit the signal name?",
                         signal.c_str()));
            return -ENOENT;
        }
        if (int r = hal_signal_new(signal.c_str(), state.type)) {
            s.error(strf("Failed to create signal '%s'", signal.c_str()));
            return r;
        }
    }
    for (size_t i = 1; i < args.size(); i++)
        if (int r = link_pin(s, args[i], signal)) return r;
    return 0;
}

/* ---- Values ---- */

/// Finds a pin or parameter. Tells and returns the error if there is none.
static int find_pp(Session &s, const std::string &name, hal_query_t &q)
{
    q = {};
    q.name = name.c_str();
    int r = hal_getref_p(&q);
    if (r != 0) s.error(strf("parameter or pin '%s': %s", name.c_str(), hal_strerror(r)));
    return r;
}

static const char *kind_word(const hal_query_t &q) { return q.qtype == HAL_QTYPE_PARAM ? "parameter" : "pin"; }

static int find_signal(Session &s, const std::string &name, hal_query_t &q)
{
    q = {};
    q.name = name.c_str();
    int r = hal_getref_s(&q);
    if (r != 0) s.error(strf("signal '%s': %s", name.c_str(), hal_strerror(r)));
    return r;
}

int do_setp(Session &s, const Args &args)
{
    hal_query_t q;
    if (int r = find_pp(s, args[0], q)) return r;
    const char *kind = kind_word(q);
    auto convert = [](hal_query_t *q, void *arg) {
        return parse_value(q->pp.type, *static_cast<const std::string *>(arg), q->pp.value);
    };
    q = {};
    q.name = args[0].c_str();
    int r = hal_set_p(&q, convert, const_cast<std::string *>(&args[1]));
    if (r != 0) s.error(strf("%s '%s': %s", kind, args[0].c_str(), hal_strerror(r)));
    return r;
}

int do_sets(Session &s, const Args &args)
{
    hal_query_t q = {};
    q.name = args[0].c_str();
    auto convert = [](hal_query_t *q, void *arg) {
        return parse_value(q->sig.type, *static_cast<const std::string *>(arg), q->sig.value);
    };
    int r = hal_set_s(&q, convert, const_cast<std::string *>(&args[1]));
    if (r != 0) s.error(strf("signal '%s': %s", args[0].c_str(), hal_strerror(r)));
    return r;
}

int do_getp(Session &s, const Args &args)
{
    hal_query_t q = {};
    q.name = args[0].c_str();
    if (int r = hal_get_p(&q, nullptr, nullptr)) {
        s.error(strf("parameter or pin '%s': %s", args[0].c_str(), hal_strerror(r)));
        return r;
    }
    s.output(value_packed(q.pp.type, q.pp.value) + "\n");
    return 0;
}

int do_gets(Session &s, const Args &args)
{
    hal_query_t q = {};
    q.name = args[0].c_str();
    if (int r = hal_get_s(&q, nullptr, nullptr)) {
        s.error(strf("signal '%s': %s", args[0].c_str(), hal_strerror(r)));
        return r;
    }
    s.output(value_packed(q.sig.type, q.sig.value) + "\n");
    return 0;
}

int do_ptype(Session &s, const Args &args)
{
    hal_query_t q;
    if (int r = find_pp(s, args[0], q)) return r;
    s.output(strf("%s\n", type_word(q.pp.type)));
    return 0;
}

int do_stype(Session &s, const Args &args)
{
    hal_query_t q;
    if (int r = find_signal(s, args[0], q)) return r;
    s.output(strf("%s\n", type_word(q.sig.type)));
    return 0;
}

/* ---- Locks ---- */

int do_lock(Session &s, const Args &args)
{
    std::string what = args.empty() ? "all" : args[0];
    if (what == "all") hal_set_lock(HAL_LOCK_ALL);
    else if (what == "tune") hal_set_lock(HAL_LOCK_TUNE);
    else if (what == "none") hal_set_lock(HAL_LOCK_NONE);
    s.info("Locking completed");
    return 0;
}

int do_unlock(Session &s, const Args &args)
{
    std::string what = args.empty() ? "all" : args[0];
    if (what == "all" || what == "none") hal_set_lock(HAL_LOCK_NONE);
    else if (what == "tune") hal_set_lock(hal_get_lock() & ~HAL_LOCK_TUNE);
    s.info("Unlocking completed");
    return 0;
}

/* ---- The session itself ---- */

int do_echo(Session &s, const Args &)
{
    s.echo = true;
    s.console("Echo on\n");
    return 0;
}

int do_unecho(Session &s, const Args &)
{
    s.echo = false;
    s.console("Echo off\n");
    return 0;
}

int do_print(Session &s, const Args &args)
{
    s.channels->print(s.place, (args.empty() ? "(null)" : args[0]) + "\n");
    return 0;
}

int do_source(Session &s, const Args &args) { return s.source(args[0]); }

} // namespace halcmd
