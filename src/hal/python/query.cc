// SPDX-License-Identifier: GPL-2.0-or-later
//
// query.cc - looking at HAL from Python.
//
// Callbacks of HAL run with its lock held, so they only copy: Python objects are
// made afterwards, when other threads of the interpreter may run and use HAL.

#include "component.h"

#include <cerrno>
#include <cstring>
#include <optional>

namespace halpy {
namespace {

using OptText = std::optional<std::string>;

OptText opt(const char *s)
{
    return s ? OptText(s) : std::nullopt;
}

py::object text(const OptText &s)
{
    return s ? halpy::text(s->c_str()) : py::object(py::none());
}

struct PinParam {
    bool is_pin;
    std::string name;
    hal_type_t type;
    hal_query_value_u value;
    hal_pdir_t dir;
    OptText alias, signal, comp;
    int comp_id;
};

struct Signal {
    std::string name;
    hal_type_t type;
    hal_query_value_u value;
    int writers, readers, bidirs;
    OptText driver;
};

struct Comp {
    std::string name;
    int type, id, pid;
    bool ready;
    OptText insmod;
};

struct Funct {
    std::string name;
    OptText comp;
    int comp_id, users;
    bool reentrant;
};

struct ThreadFunct {
    std::string name;
    int index;
    bool is_init;
};

struct Thread {
    std::string name;
    OptText comp;
    int comp_id, priority;
    long period;
    std::vector<ThreadFunct> functs;
};

// ---- Copying, with the lock held ------------------------------------------------------

// Errors other than "not found" are programmer's or environment's.
void check(int result, const char *what)
{
    if (result < 0) throw std::runtime_error(std::string(what) + ": " + hal_strerror(result));
}

PinParam copy_pp(const hal_query_t *q)
{
    return {q->qtype == HAL_QTYPE_PIN, q->name,       q->pp.type,        q->pp.value,     q->pp.dir,
            opt(q->pp.alias),          opt(q->pp.signal), opt(q->pp.comp), q->pp.comp_id};
}

Signal copy_signal(const hal_query_t *q)
{
    return {q->name, q->sig.type, q->sig.value, q->sig.writers, q->sig.readers, q->sig.bidirs, std::nullopt};
}

Comp copy_comp(const hal_query_t *q)
{
    return {q->name, q->comp.type, q->comp.comp_id, q->comp.pid, q->comp.ready, opt(q->comp.insmod)};
}

template <class T, T (*copy)(const hal_query_t *)> int collect(hal_query_t *q, void *arg)
{
    static_cast<std::vector<T> *>(arg)->push_back(copy(q));
    return 0;
}

Funct copy_funct(const hal_query_t *q)
{
    return {q->name, opt(q->funct.comp), q->funct.comp_id, q->funct.users, q->funct.reentrant};
}

int collect_thread(hal_query_t *q, void *arg)
{
    auto all = static_cast<std::vector<Thread> *>(arg);
    if (q->qtype == HAL_QTYPE_THREAD)
        all->push_back({q->name, opt(q->thread.comp), q->thread.comp_id, q->thread.priority, q->thread.period, {}});
    else
        all->back().functs.push_back({q->thread.funct, q->thread.functidx, q->thread.is_init});
    return 0;
}

std::optional<PinParam> find_pp(const std::string &name, hal_qtype_t kind)
{
    hal_query_t q = {};
    std::vector<PinParam> found;
    q.name = name.c_str();
    q.qtype = kind;
    int result = hal_get_p(&q, collect<PinParam, copy_pp>, &found);
    if (result == -ENOENT) return std::nullopt;
    check(result, name.c_str());
    return found.at(0);
}

// The names of OUT pins by signal.
int collect_driver(hal_query_t *q, void *arg)
{
    if (q->pp.dir == HAL_OUT && q->pp.signal)
        (*static_cast<std::map<std::string, std::string> *>(arg))[q->pp.signal] = q->name;
    return 0;
}

std::optional<Signal> find_signal(const std::string &name)
{
    hal_query_t q = {};
    std::vector<Signal> found;
    q.name = name.c_str();
    int result = hal_get_s(&q, collect<Signal, copy_signal>, &found);
    if (result == -ENOENT) return std::nullopt;
    check(result, name.c_str());
    std::map<std::string, std::string> drivers;
    hal_query_t members = {};
    members.name = name.c_str();
    hal_list_p_s(&members, collect_driver, &drivers);
    if (!drivers.empty()) found[0].driver = drivers.begin()->second;
    return found[0];
}

std::vector<PinParam> list_pp(hal_qtype_t kind)
{
    hal_query_t q = {};
    std::vector<PinParam> all;
    q.qtype = kind;
    check(hal_list_p(&q, collect<PinParam, copy_pp>, &all), "query");
    return all;
}

std::vector<Signal> list_signals()
{
    hal_query_t q = {};
    std::vector<Signal> all;
    check(hal_list_s(&q, collect<Signal, copy_signal>, &all), "query");
    std::map<std::string, std::string> drivers;
    q = {};
    q.qtype = HAL_QTYPE_PIN;
    check(hal_list_p(&q, collect_driver, &drivers), "query");
    for (Signal &s : all) {
        auto found = drivers.find(s.name);
        if (found != drivers.end()) s.driver = found->second;
    }
    return all;
}

std::vector<Comp> list_comps()
{
    hal_query_t q = {};
    std::vector<Comp> all;
    check(hal_list_comp(&q, collect<Comp, copy_comp>, &all), "query");
    return all;
}

std::vector<Funct> list_functs()
{
    hal_query_t q = {};
    std::vector<Funct> all;
    check(hal_list_funct(&q, collect<Funct, copy_funct>, &all), "query");
    return all;
}

std::vector<Thread> list_threads()
{
    hal_query_t q = {};
    std::vector<Thread> all;
    q.qtype = HAL_QTYPE_THREAD_FUNCT;
    check(hal_list_thread(&q, collect_thread, &all), "query");
    return all;
}

// ---- Python objects ------------------------------------------------------------------------

py::dict dict_of(const PinParam &p)
{
    using namespace py::literals;
    py::dict d("haltype"_a = p.is_pin ? "pin" : "parameter", "name"_a = halpy::text(p.name.c_str()),
               "type"_a = static_cast<int>(p.type), "dir"_a = static_cast<int>(p.dir),
               "value"_a = to_python(p.value, p.type), "alias"_a = text(p.alias));
    if (p.is_pin) d["signal"] = text(p.signal);
    d["comp"] = text(p.comp);
    d["comp_id"] = p.comp_id;
    return d;
}

py::dict dict_of(const Signal &s)
{
    using namespace py::literals;
    return py::dict("haltype"_a = "signal", "name"_a = halpy::text(s.name.c_str()),
                    "type"_a = static_cast<int>(s.type), "value"_a = to_python(s.value, s.type),
                    "writers"_a = s.writers, "readers"_a = s.readers, "bidirs"_a = s.bidirs,
                    "driver"_a = text(s.driver));
}

py::dict dict_of(const Comp &c)
{
    using namespace py::literals;
    return py::dict("haltype"_a = "component", "name"_a = halpy::text(c.name.c_str()), "type"_a = c.type,
                    "id"_a = c.id, "pid"_a = c.pid, "ready"_a = c.ready, "insmod"_a = text(c.insmod));
}

py::dict dict_of(const Funct &f)
{
    using namespace py::literals;
    return py::dict("haltype"_a = "function", "name"_a = halpy::text(f.name.c_str()), "comp"_a = text(f.comp),
                    "comp_id"_a = f.comp_id, "users"_a = f.users, "reentrant"_a = f.reentrant);
}

py::dict dict_of(const Thread &t)
{
    using namespace py::literals;
    py::list functs;
    for (const ThreadFunct &f : t.functs)
        functs.append(py::dict("haltype"_a = "threadfunction", "name"_a = halpy::text(f.name.c_str()),
                               "index"_a = f.index, "is_init"_a = f.is_init));
    return py::dict("haltype"_a = "thread", "name"_a = halpy::text(t.name.c_str()), "comp"_a = text(t.comp),
                    "comp_id"_a = t.comp_id, "priority"_a = t.priority, "period"_a = t.period,
                    "functions"_a = functs);
}

template <class T> py::object dict_or_none(const std::optional<T> &item)
{
    return item ? py::object(dict_of(*item)) : py::object(py::none());
}

template <class T> py::list list_of(const std::vector<T> &items)
{
    py::list all;
    for (const T &item : items) all.append(dict_of(item));
    return all;
}

template <class T> std::optional<T> named(const std::vector<T> &items, const std::string &name)
{
    for (const T &item : items)
        if (item.name == name) return item;
    return std::nullopt;
}

std::optional<Comp> find_comp(py::handle key)
{
    hal_query_t q = {};
    int result = PyLong_Check(key.ptr()) ? hal_comp_by_id(py::cast<int>(key), &q)
                                         : hal_comp_by_name(py::cast<std::string>(key).c_str(), &q);
    if (result == -ENOENT || result == -EINVAL) return std::nullopt;
    check(result, "comp");
    return copy_comp(&q);
}

// ---- Values by name ---------------------------------------------------------------------------

py::object get_p(const std::string &name)
{
    auto p = find_pp(name, HAL_QTYPE_ANY);
    return p ? to_python(p->value, p->type) : py::object(py::none());
}

py::object get_s(const std::string &name)
{
    auto s = find_signal(name);
    return s ? to_python(s->value, s->type) : py::object(py::none());
}

py::object get_value(const std::string &name)
{
    py::object value = get_p(name);
    if (value.is_none()) value = get_s(name);
    if (value.is_none()) throw std::runtime_error("get_value: " + name + ": not found");
    return value;
}

[[noreturn]] void refuse(const char *op, const std::string &name, int result)
{
    throw std::runtime_error(std::string(op) + ": " + name + ": " + hal_strerror(result));
}

// Text of a hexadecimal number, as setp of halcmd takes it, becomes a number; anything else stays.
py::object without_hexadecimal(py::handle value, hal_type_t type)
{
    if (PyUnicode_Check(value.ptr()) && type != HAL_BIT) {
        auto word = py::cast<std::string>(value);
        if (word.find("0x") != word.npos || word.find("0X") != word.npos) {
            auto builtins = py::module_::import("builtins");
            if (type == HAL_FLOAT) return builtins.attr("float").attr("fromhex")(value);
            return builtins.attr("int")(value, 0);
        }
    }
    return py::reinterpret_borrow<py::object>(value);
}

// Where the conversion fails: the documented text, with the reason as the cause.
hal_query_value_u converted(const char *op, const std::string &name, py::handle value, hal_type_t type)
{
    try {
        return from_python(without_hexadecimal(value, type), type, "'" + name + "'");
    } catch (py::error_already_set &e) {
        std::string message = std::string(op) + ": " + name + ": " + hal_strerror(-EINVAL);
        py::raise_from(e, PyExc_RuntimeError, message.c_str());
        throw py::error_already_set();
    }
}

bool set_p(const std::string &name, py::handle value)
{
    hal_query_t q = {};
    q.name = name.c_str();
    int result = hal_getref_p(&q);
    if (result < 0) refuse("set_p", name, result);
    hal_query_value_u v = {};
    if (q.pp.type != HAL_PORT) v = converted("set_p", name, value, q.pp.type);
    hal_query_t set = {};
    set.name = name.c_str();
    set.pp.type = q.pp.type;
    set.pp.value = v;
    result = hal_set_p(&set, nullptr, nullptr);
    if (result < 0) refuse("set_p", name, result);
    return true;
}

bool set_s(const std::string &name, py::handle value)
{
    hal_query_t q = {};
    q.name = name.c_str();
    int result = hal_getref_s(&q);
    if (result < 0) refuse("set_s", name, result);
    hal_query_t set = {};
    set.name = name.c_str();
    set.sig.type = q.sig.type;
    set.sig.value = converted("set_s", name, value, q.sig.type == HAL_PORT ? HAL_U32 : q.sig.type);
    result = hal_set_s(&set, nullptr, nullptr);
    if (result < 0) refuse("set_s", name, result);
    return true;
}

bool pin_has_writer(const std::string &name)
{
    auto p = find_pp(name, HAL_QTYPE_PIN);
    if (!p) {
        PyErr_SetString(PyExc_NameError, ("Pin `" + name + "' does not exist").c_str());
        throw py::error_already_set();
    }
    if (!p->signal) return false;
    auto s = find_signal(*p->signal);
    return s && s->writers > 0;
}

bool new_sig(const std::string &name, int type)
{
    if (type < HAL_BIT || type >= HAL_TYPE_MAX) throw std::runtime_error("not a valid HAL signal type");
    return hal_signal_new(name.c_str(), static_cast<hal_type_t>(type)) != 0;
}

py::list info_pp(hal_qtype_t kind)
{
    using namespace py::literals;
    py::list all;
    for (const PinParam &p : list_pp(kind))
        all.append(py::dict("NAME"_a = halpy::text(p.name.c_str()), "VALUE"_a = to_python(p.value, p.type),
                            "DIRECTION"_a = static_cast<int>(p.dir), "TYPE"_a = static_cast<int>(p.type)));
    return all;
}

py::list info_signals()
{
    using namespace py::literals;
    py::list all;
    for (const Signal &s : list_signals())
        all.append(py::dict("NAME"_a = halpy::text(s.name.c_str()), "VALUE"_a = to_python(s.value, s.type),
                            "DRIVER"_a = text(s.driver), "TYPE"_a = static_cast<int>(s.type)));
    return all;
}

py::object signal_pins(const std::string &name)
{
    hal_query_t q = {};
    std::vector<PinParam> pins;
    q.name = name.c_str();
    int result = hal_list_p_s(&q, collect<PinParam, copy_pp>, &pins);
    if (result == -ENOENT) return py::none();
    check(result, name.c_str());
    return list_of(pins);
}

} // namespace

void bind_query(py::module_ &m)
{
    m.def("component_exists", [](const std::string &n) { return hal_comp_by_name(n.c_str(), nullptr) == 0; });
    m.def("component_is_ready", [](const std::string &n) {
        hal_query_t q = {};
        return hal_comp_by_name(n.c_str(), &q) == 0 && q.comp.ready;
    });
    m.def("pin_has_writer", &pin_has_writer, "Is the pin linked to a signal with an output?");
    m.def("new_sig", &new_sig, "Makes a signal. Returns True on failure.");
    m.def(
        "connect",
        [](const std::string &pin, const std::string &sig) { return hal_link(pin.c_str(), sig.c_str()) != 0; },
        "Links a pin to a signal. Returns True on failure.");
    m.def("disconnect", [](const std::string &pin) { return hal_unlink(pin.c_str()) != 0; },
          "Unlinks a pin. Returns True on failure.");
    m.def("set_p", &set_p, "Sets a pin or parameter by name; True or RuntimeError.");
    m.def("set_s", &set_s, "Sets a signal by name; True or RuntimeError. Ports: size of the buffer.");
    m.def("get_p", &get_p, "Value of a pin or parameter, or None.");
    m.def("get_s", &get_s, "Value of a signal, or None.");
    m.def("get_value", &get_value, "Value of a pin, parameter or signal; RuntimeError when there is none.");
    m.def("get_info_pins", [] { return info_pp(HAL_QTYPE_PIN); });
    m.def("get_info_params", [] { return info_pp(HAL_QTYPE_PARAM); });
    m.def("get_info_signals", &info_signals);

    m.def("_query_pin", [](const std::string &n) { return dict_or_none(find_pp(n, HAL_QTYPE_PIN)); });
    m.def("_query_param", [](const std::string &n) { return dict_or_none(find_pp(n, HAL_QTYPE_PARAM)); });
    m.def("_query_signal", [](const std::string &n) { return dict_or_none(find_signal(n)); });
    m.def("_query_comp", [](py::handle key) { return dict_or_none(find_comp(key)); });
    m.def("_query_funct", [](const std::string &n) { return dict_or_none(named(list_functs(), n)); });
    m.def("_query_thread", [](const std::string &n) { return dict_or_none(named(list_threads(), n)); });
    m.def("_query_signalpins", &signal_pins);
    m.def("_query_pins", [] { return list_of(list_pp(HAL_QTYPE_PIN)); });
    m.def("_query_params", [] { return list_of(list_pp(HAL_QTYPE_PARAM)); });
    m.def("_query_signals", [] { return list_of(list_signals()); });
    m.def("_query_comps", [] { return list_of(list_comps()); });
    m.def("_query_functs", [] { return list_of(list_functs()); });
    m.def("_query_threads", [] { return list_of(list_threads()); });
}

} // namespace halpy
