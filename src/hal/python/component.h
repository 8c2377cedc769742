// SPDX-License-Identifier: GPL-2.0-or-later
//
// component.h - HAL components made by Python programs, and their pins.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>
#include "values.h"

namespace halpy {

// hal.error with the text of an errno.
[[noreturn]] void throw_hal_error(int negative_errno);
[[noreturn]] void throw_hal_error(const std::string &message);

// What a component and its items share. Items outlive it as closed ones.
struct CompState {
    int id = 0;
    std::string name;
    bool closed = false;
    pid_t pid = 0; // the process that made it
};

// A pin or parameter of this process.
class Item {
public:
    Item(std::shared_ptr<CompState> comp, std::string suffix, hal_type_t type, hal_pdir_t dir, bool is_pin, void *place)
        : comp_(std::move(comp)), suffix_(std::move(suffix)), type_(type), dir_(dir), is_pin_(is_pin), place_(place)
    {
    }
    py::object get() const;
    void set(py::handle value);
    const std::string &name() const { return suffix_; }
    int type() const { return type_; }
    int dir() const { return dir_; }
    bool is_pin() const { return is_pin_; }
    std::string repr() const;

    // Ports.
    py::object write(py::handle data);
    py::object read(py::handle count);
    py::object peek(py::handle count);
    bool peek_commit(py::handle count);
    void clear();
    unsigned size() const;
    unsigned readable() const;
    unsigned writable() const;

private:
    void *cell() const; // throws when the component is closed
    const hal_port_t *port(const char *op, int dir) const;
    unsigned count_argument(const char *op, py::handle count) const;
    py::object take(const char *op, py::handle count, bool keep);
    std::string what() const;

    std::shared_ptr<CompState> comp_;
    std::string suffix_;
    hal_type_t type_;
    hal_pdir_t dir_;
    bool is_pin_;
    void *place_; // pins: in HAL memory, holds where the value is; parameters: the value
};

class Component {
public:
    Component(const std::string &name, py::object prefix);
    ~Component();
    void exit();
    void ready();
    void unready();
    std::shared_ptr<Item> newpin(const std::string &suffix, int type, int dir);
    std::shared_ptr<Item> newparam(const std::string &suffix, int type, int dir);
    std::shared_ptr<Item> item(const std::string &suffix) const;
    std::shared_ptr<Item> typed_item(const std::string &suffix, bool pin) const;
    py::dict values() const;
    void setprefix(const std::string &prefix);
    std::string prefix() const;
    size_t size() const;
    std::string repr() const;
    int id() const; // throws when closed

    // Removes the components of this process; for the end of the interpreter.
    static void exit_all();

private:
    std::shared_ptr<Item> add(const std::string &suffix, int type, int dir, bool pin);

    std::shared_ptr<CompState> state_;
    std::string prefix_;
    std::map<std::string, std::shared_ptr<Item>> items_;
};

void bind_component(py::module_ &m);
void bind_stream(py::module_ &m);
void bind_query(py::module_ &m);
}
