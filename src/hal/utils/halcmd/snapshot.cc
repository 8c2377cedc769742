/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * snapshot.cc - see snapshot.hh.
 */
#include "snapshot.hh"

namespace halcmd
{

static const char *or_empty(const char *text) { return text ? text : ""; }

static std::vector<Item> list_pp(hal_qtype_t kind)
{
    std::vector<Item> all;
    hal_query_t q = {};
    q.qtype = kind;
    hal_list_p(
        &q,
        [](hal_query_t *q, void *arg) {
            auto &pp = q->pp;
            static_cast<std::vector<Item> *>(arg)->push_back({q->name, or_empty(pp.alias), pp.type, pp.dir, pp.value,
                                                             or_empty(pp.signal), or_empty(pp.comp), pp.comp_id});
            return 0;
        },
        &all);
    return all;
}

std::vector<Item> list_pins() { return list_pp(HAL_QTYPE_PIN); }

std::vector<Item> list_params() { return list_pp(HAL_QTYPE_PARAM); }

std::vector<SignalItem> list_signals()
{
    std::vector<SignalItem> all;
    hal_query_t q = {};
    hal_list_s(
        &q,
        [](hal_query_t *q, void *arg) {
            auto &s = q->sig;
            static_cast<std::vector<SignalItem> *>(arg)->push_back(
                {q->name, s.type, s.value, s.writers, s.readers, s.bidirs});
            return 0;
        },
        &all);
    return all;
}

std::vector<CompItem> list_comps()
{
    std::vector<CompItem> all;
    hal_query_t q = {};
    hal_list_comp(
        &q,
        [](hal_query_t *q, void *arg) {
            auto &c = q->comp;
            static_cast<std::vector<CompItem> *>(arg)->push_back(
                {q->name, c.comp_id, c.type, c.pid, c.ready, c.insmod != nullptr, or_empty(c.insmod)});
            return 0;
        },
        &all);
    return all;
}

std::vector<FunctItem> list_functs()
{
    std::vector<FunctItem> all;
    hal_query_t q = {};
    hal_list_funct(
        &q,
        [](hal_query_t *q, void *arg) {
            auto &f = q->funct;
            static_cast<std::vector<FunctItem> *>(arg)->push_back(
                {q->name, or_empty(f.comp), f.comp_id, f.users, static_cast<unsigned long long>(f.funct),
                 static_cast<unsigned long long>(f.arg), f.reentrant});
            return 0;
        },
        &all);
    return all;
}

/// The value of an integer pin or parameter. False if there is none.
static bool read_long(const std::string &name, long &value)
{
    hal_query_t q = {};
    q.name = name.c_str();
    if (hal_get_p(&q, nullptr, nullptr) != 0) return false;
    value = static_cast<long>(q.pp.value.s);
    return true;
}

std::vector<ThreadItem> list_threads()
{
    std::vector<ThreadItem> all;
    hal_query_t q = {};
    q.qtype = HAL_QTYPE_THREAD_FUNCT;
    hal_list_thread(
        &q,
        [](hal_query_t *q, void *arg) {
            auto &all = *static_cast<std::vector<ThreadItem> *>(arg);
            auto &t = q->thread;
            if (q->qtype == HAL_QTYPE_THREAD)
                all.push_back({q->name, or_empty(t.comp), t.priority, t.period, {}, {}, false, 0, 0});
            else if (!all.empty() && t.funct)
                (t.is_init ? all.back().init : all.back().cyclic).push_back(t.funct);
            return 0;
        },
        &all);
    for (auto &t : all) t.timed = read_long(t.name + ".time", t.time) && read_long(t.name + ".tmax", t.tmax);
    return all;
}

PinsOfSignal pins_by_signal(const std::vector<Item> &pins)
{
    PinsOfSignal of;
    for (auto &p : pins)
        if (!p.signal.empty()) of[p.signal].push_back(&p);
    return of;
}

} // namespace halcmd
