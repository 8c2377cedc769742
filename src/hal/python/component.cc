// SPDX-License-Identifier: GPL-2.0-or-later
//
// component.cc - HAL components made by Python programs, and their pins.

#include "component.h"

#include "kerf_clock.h"

#include <cstdlib>
#include <cstring>
#include <set>
#include <unistd.h>

namespace halpy {

namespace {
std::set<CompState *> open_components;

void close_state(CompState &s)
{
    if (s.closed) return;
    s.closed = true;
    open_components.erase(&s);
    if (s.pid == getpid() && hal_is_init()) hal_exit(s.id); // a forked child leaves it to its parent
}

std::string full_name(const std::string &prefix, const std::string &suffix)
{
    return prefix + "." + suffix;
}
} // namespace

// ---- Items --------------------------------------------------------------------------

std::string Item::what() const
{
    return std::string(is_pin_ ? "pin '" : "parameter '") + comp_->name + "." + suffix_ + "'";
}

void *Item::cell() const
{
    if (comp_->closed) throw std::runtime_error("Invalid operation on closed HAL component");
    return is_pin_ ? __atomic_load_n(static_cast<void **>(place_), __ATOMIC_ACQUIRE) : place_;
}

py::object Item::get() const
{
    void *at = cell();
    if (type_ == HAL_PORT) return py::int_(size());
    return to_python(cell_get(at, type_), type_);
}

void Item::set(py::handle value)
{
    cell();
    if (type_ == HAL_PORT) throw_hal_error("Invalid pin type " + std::to_string(type_));
    hal_query_value_u v = from_python(value, type_, what());
    cell_set(cell(), type_, v); // looked up again: the conversion may have run any code
}

std::string Item::repr() const
{
    return std::string("<hal ") + (is_pin_ ? "pin" : "param") + " \"" + suffix_ + "\" " + type_word(type_) + "-" +
           dir_word(dir_) + ">";
}

const hal_port_t *Item::port(const char *op, int dir) const
{
    std::string head = std::string(op) + ": " + suffix_ + ": ";
    if (!is_pin_) throw std::runtime_error(head + "Not a pin");
    if (type_ != HAL_PORT) throw std::runtime_error(head + "Not a port");
    if (dir && dir != dir_) throw std::runtime_error(head + (dir == HAL_IN ? "Pin not input" : "Pin not output"));
    return static_cast<const hal_port_t *>(cell());
}

unsigned Item::count_argument(const char *op, py::handle count) const
{
    if (!PyLong_Check(count.ptr()))
        throw std::runtime_error(std::string(op) + ": " + suffix_ + ": Argument not an integer");
    long long n = PyLong_AsLongLong(count.ptr());
    if (PyErr_Occurred()) {
        PyErr_Clear();
        return 0;
    }
    return n > 0 && n <= HAL_PORT_SIZE_MAX ? static_cast<unsigned>(n) : 0;
}

py::object Item::write(py::handle data)
{
    const hal_port_t *p = port("write", HAL_OUT);
    char *bytes = nullptr;
    Py_ssize_t n = 0;
    if (PyUnicode_Check(data.ptr())) {
        bytes = const_cast<char *>(PyUnicode_AsUTF8AndSize(data.ptr(), &n));
        if (!bytes) throw py::error_already_set();
    } else if (PyBytes_Check(data.ptr())) {
        PyBytes_AsStringAndSize(data.ptr(), &bytes, &n);
    } else {
        throw std::runtime_error("write: " + suffix_ + ": Argument not a string or bytes object");
    }
    if (n < 1 || n > HAL_PORT_SIZE_MAX) return py::bool_(false);
    return py::bool_(hal_port_write(p, bytes, static_cast<unsigned>(n)));
}

py::object Item::take(const char *op, py::handle count, bool keep)
{
    const hal_port_t *p = port(op, HAL_IN);
    unsigned n = count_argument(op, count);
    if (n == 0) return py::bool_(false);
    std::string bytes(n, 0);
    bool ok = keep ? hal_port_peek(p, bytes.data(), n) : hal_port_read(p, bytes.data(), n);
    return ok ? py::object(py::bytes(bytes)) : py::object(py::bool_(false));
}

py::object Item::read(py::handle count) { return take("read", count, false); }
py::object Item::peek(py::handle count) { return take("peek", count, true); }

bool Item::peek_commit(py::handle count)
{
    const hal_port_t *p = port("peek_commit", HAL_IN);
    return hal_port_peek_commit(p, count_argument("peek_commit", count));
}

void Item::clear() { hal_port_clear(port("clear", HAL_IN)); }
unsigned Item::size() const { return hal_port_buffer_size(port("size", 0)); }
unsigned Item::readable() const { return hal_port_readable(port("readable", HAL_IN)); }
unsigned Item::writable() const { return hal_port_writable(port("writable", HAL_OUT)); }

// ---- Components ----------------------------------------------------------------------

Component::Component(const std::string &name, py::object prefix)
    : state_(std::make_shared<CompState>()), prefix_(prefix.is_none() ? name : py::cast<std::string>(prefix))
{
    int id = hal_init(name.c_str());
    if (id < 0) throw_hal_error(id);
    state_->id = id;
    state_->name = name;
    state_->pid = getpid();
    open_components.insert(state_.get());
}

Component::~Component()
{
    close_state(*state_);
}

void Component::exit_all()
{
    while (!open_components.empty()) close_state(**open_components.begin());
}

int Component::id() const
{
    if (state_->closed) throw std::runtime_error("Invalid operation on closed HAL component");
    return state_->id;
}

void Component::exit()
{
    id();
    items_.clear();
    close_state(*state_);
}

void Component::ready()
{
    int result = hal_ready(id());
    if (result < 0) throw_hal_error(result);
    // A script that keeps out of the simulated clock gives up the place that was reserved for it:
    // time would stand until somebody notices that it never joins.
    if (std::getenv(KERF_CLOCK_SLOT_ENV) && !kerf_clock_joined() &&
        kerf_clock_join(state_->name.c_str(), KERF_CLOCK_PRIO_USER) == 0) {
        kerf_clock_leave();
        unsetenv(KERF_CLOCK_SLOT_ENV);
    }
}

void Component::unready()
{
    int result = hal_unready(id());
    if (result < 0) throw_hal_error(result);
}

std::shared_ptr<Item> Component::add(const std::string &suffix, int type, int dir, bool pin)
{
    const char *word = pin ? "pin" : "param";
    int comp_id = id();
    if (items_.count(suffix))
        throw py::value_error(std::string("Duplicate ") + (pin ? "pin" : "parameter") + " name '" + suffix + "'");
    if (type < HAL_BIT || type >= HAL_TYPE_MAX || (!pin && type == HAL_PORT))
        throw_hal_error(std::string("Invalid ") + word + " type " + std::to_string(type));
    std::string name = full_name(prefix_, suffix);
    if (name.size() > HAL_NAME_LEN)
        throw_hal_error(std::string("Invalid ") + word + " name length \"" + name +
                        "\": max = " + std::to_string(HAL_NAME_LEN) + " characters");
    void *place = hal_malloc(sizeof(hal_data_u));
    if (!place) {
        PyErr_NoMemory();
        throw py::error_already_set();
    }
    auto t = static_cast<hal_type_t>(type);
    auto d = static_cast<hal_pdir_t>(dir);
    int result = pin ? hal_pin_new(name.c_str(), t, d, static_cast<void **>(place), comp_id)
                     : hal_param_new(name.c_str(), t, d, place, comp_id);
    if (result < 0) throw_hal_error(result);
    auto item = std::make_shared<Item>(state_, suffix, t, d, pin, place);
    items_[suffix] = item;
    return item;
}

std::shared_ptr<Item> Component::newpin(const std::string &suffix, int type, int dir)
{
    return add(suffix, type, dir, true);
}

std::shared_ptr<Item> Component::newparam(const std::string &suffix, int type, int dir)
{
    return add(suffix, type, dir, false);
}

std::shared_ptr<Item> Component::item(const std::string &suffix) const
{
    id();
    auto found = items_.find(suffix);
    if (found == items_.end()) throw py::attribute_error("Pin or param '" + suffix + "' does not exist");
    return found->second;
}

std::shared_ptr<Item> Component::typed_item(const std::string &suffix, bool pin) const
{
    auto found = item(suffix);
    if (found->is_pin() != pin)
        throw py::attribute_error(std::string(pin ? "Pin '" : "Param '") + suffix + "' does not exist");
    return found;
}

py::dict Component::values() const
{
    id();
    py::dict all;
    for (const auto &entry : items_) all[py::str(entry.first)] = entry.second->get();
    return all;
}

void Component::setprefix(const std::string &prefix)
{
    id();
    prefix_ = prefix;
}

std::string Component::prefix() const
{
    id();
    return prefix_;
}

size_t Component::size() const
{
    id();
    return items_.size();
}

std::string Component::repr() const
{
    if (state_->closed) return "<closed hal component " + state_->name + ">";
    return "<hal component " + state_->name + "(" + std::to_string(state_->id) + ") with " +
           std::to_string(items_.size()) + " pins and params>";
}

// ---- Binding ------------------------------------------------------------------------------

void bind_component(py::module_ &m)
{
    using namespace py::literals;
    py::class_<Item, std::shared_ptr<Item>>(m, "item", "A pin or parameter of a component of this process.")
        .def("get", &Item::get, "The value; of a linked pin that of the signal. Ports: size of the buffer.")
        .def("set", &Item::set, "value"_a)
        .def("get_type", &Item::type)
        .def("get_dir", &Item::dir)
        .def("get_name", &Item::name, "The name without the component's prefix.")
        .def("is_pin", &Item::is_pin)
        .def_property_readonly("name", &Item::name)
        .def_property_readonly("type", &Item::type)
        .def_property_readonly("dir", &Item::dir)
        .def_property("value", &Item::get, &Item::set)
        .def("write", &Item::write, "data"_a, "Output port: queues all of data (str or bytes) or nothing.")
        .def("read", &Item::read, "count"_a, "Input port: count bytes, or False when fewer are queued.")
        .def("peek", &Item::peek, "count"_a, "Like read; the bytes stay queued.")
        .def("peek_commit", &Item::peek_commit, "count"_a, "Removes bytes that peek gave.")
        .def("clear", &Item::clear, "Input port: removes what is queued.")
        .def("size", &Item::size, "Bytes of the buffer; it holds one less.")
        .def("readable", &Item::readable, "Bytes queued.")
        .def("writable", &Item::writable, "Bytes that fit.")
        .def("__repr__", &Item::repr);

    py::class_<Component, std::shared_ptr<Component>>(m, "component", "A HAL component of this process.")
        .def(py::init<const std::string &, py::object>(), "name"_a, "prefix"_a = py::none())
        .def("newpin", &Component::newpin, "suffix"_a, "type"_a, "dir"_a)
        .def("newparam", &Component::newparam, "suffix"_a, "type"_a, "dir"_a)
        .def("getpin", [](const Component &c, const std::string &n) { return c.typed_item(n, true); }, "suffix"_a)
        .def("getparam", [](const Component &c, const std::string &n) { return c.typed_item(n, false); }, "suffix"_a)
        .def("getitem", &Component::item, "suffix"_a)
        .def("getpins", &Component::values, "Values of all pins and parameters by suffix.")
        .def("ready", &Component::ready)
        .def("unready", &Component::unready)
        .def("exit", &Component::exit)
        .def("setprefix", &Component::setprefix, "prefix"_a)
        .def("getprefix", &Component::prefix)
        .def_property_readonly("id", &Component::id)
        .def("__getitem__", [](const Component &c, const std::string &n) { return c.item(n)->get(); })
        .def("__setitem__", [](Component &c, const std::string &n, py::handle v) { c.item(n)->set(v); })
        .def("__delitem__", [](Component &c, const std::string &n) {
            c.item(n);
            throw py::type_error("Pin or param '" + n + "' can not be deleted");
        })
        .def("__getattr__", [](const Component &c, const std::string &n) { return c.item(n)->get(); })
        .def("__setattr__", [](Component &c, const std::string &n, py::handle v) { c.item(n)->set(v); })
        .def("__delattr__", [](Component &c, const std::string &n) {
            c.item(n);
            throw py::type_error("Pin or param '" + n + "' can not be deleted");
        })
        .def("__len__", &Component::size)
        .def("__repr__", &Component::repr);
    m.def("_exit_all", &Component::exit_all);
}

} // namespace halpy
