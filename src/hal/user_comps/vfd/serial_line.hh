// SPDX-License-Identifier: GPL-2.0-or-later
//
// serial_line.hh - what the programs for drives on a serial line have in common: the line, its
// options, and the making of pins. Source: Modbus sheet, sections 2 to 4.
#pragma once

#include <cctype>
#include <cstdlib>
#include <initializer_list>
#include <optional>
#include <string>

#include "hal.h"
#include "option_values.hh"

namespace vfd {

struct SerialLine {
    std::string device = "/dev/ttyS0";
    int rate = 19200, bits = 8, stop = 1;
    char parity = 'E';  ///< E, O or N
    int target = 1;     ///< address of the drive, 1 to 254
    bool debug = false; ///< prints the traffic
};

/// Takes the options b d p r s t (documented with the same letters by each program) into `line`.
/// False after a message on stderr: a wrong value. Nothing: another option.
inline std::optional<bool> line_option(const char *program, int option, const char *text,
                                       std::initializer_list<const char *> rates, SerialLine &line) {
    const char *chosen = nullptr;
    double number = 0;
    switch (option) {
    case 'b':
        chosen = one_of(program, "bits", text, {"5", "6", "7", "8"});
        if (chosen) line.bits = atoi(chosen);
        return chosen != nullptr;
    case 'd':
        line.device = text;
        return true;
    case 'p':
        chosen = one_of(program, "parity", text, {"even", "odd", "none"});
        if (chosen) line.parity = static_cast<char>(toupper(*chosen));
        return chosen != nullptr;
    case 'r':
        chosen = one_of(program, "rate", text, rates);
        if (chosen) line.rate = atoi(chosen);
        return chosen != nullptr;
    case 's':
        chosen = one_of(program, "stopbits", text, {"1", "2"});
        if (chosen) line.stop = atoi(chosen);
        return chosen != nullptr;
    case 't':
        if (!number_of(program, "target", text, 1, 254, number)) return false;
        line.target = static_cast<int>(number);
        return true;
    default:
        return std::nullopt;
    }
}

/// A HAL component whose pins live in one structure `Pins` of HAL memory.
template <class Pins> class PinnedComponent {
public:
    explicit PinnedComponent(std::string name) : name_(std::move(name)) {}

    /// Makes the component; `make_all(pins)` makes its pins. False: HAL has said why, nothing is left.
    template <class F> bool make(F make_all) {
        id_ = hal_init(name_.c_str());
        if (id_ < 0) return false;
        pins_ = static_cast<Pins *>(hal_malloc(sizeof(Pins)));
        if (pins_ && make_all(*pins_)) return true;
        hal_exit(id_);
        return false;
    }

    /// Pin `NAME.name` by one of HAL's makers (hal_pin_bit_newf and so on).
    template <class T, class F> bool pin(T *&at, hal_pin_dir_t dir, const char *name, F maker) const {
        return maker(dir, &at, id_, "%s.%s", name_.c_str(), name) == 0;
    }

    /// Parameter `NAME.name`, read and written by all.
    template <class T, class F> bool parameter(T &at, const char *name, F maker) const {
        return maker(HAL_RW, &at, id_, "%s.%s", name_.c_str(), name) == 0;
    }

    void ready() const { hal_ready(id_); }
    void exit() const { hal_exit(id_); }
    Pins *operator->() const { return pins_; }
    Pins &operator*() const { return *pins_; }

private:
    std::string name_;
    int id_ = -1;
    Pins *pins_ = nullptr;
};

} // namespace vfd
