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
#include <utility>

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

/// Makes pins and parameters `PREFIX.name` of a component.
class PinMaker {
public:
    PinMaker(int component, std::string prefix) : id_(component), prefix_(std::move(prefix)) {}

    struct Bit { hal_bit_t **at; hal_pin_dir_t dir; const char *name; };
    struct Float { hal_float_t **at; hal_pin_dir_t dir; const char *name; };
    struct Integer { hal_s32_t **at; hal_pin_dir_t dir; const char *name; };

    /// A pin by one of HAL's makers (hal_pin_bit_newf and so on).
    template <class T, class F> bool pin(T *&at, hal_pin_dir_t dir, const char *name, F maker) const {
        return maker(dir, &at, id_, "%s.%s", prefix_.c_str(), name) == 0;
    }

    bool bits(std::initializer_list<Bit> pins) const { return all(pins, hal_pin_bit_newf); }
    bool floats(std::initializer_list<Float> pins) const { return all(pins, hal_pin_float_newf); }
    bool integers(std::initializer_list<Integer> pins) const { return all(pins, hal_pin_s32_newf); }

    /// A parameter, read and written by all.
    template <class T, class F> bool parameter(T &at, const char *name, F maker) const {
        return maker(HAL_RW, &at, id_, "%s.%s", prefix_.c_str(), name) == 0;
    }

protected:
    int id_;

private:
    template <class T, class F> bool all(std::initializer_list<T> pins, F maker) const {
        for (const T &p : pins)
            if (!pin(*p.at, p.dir, p.name, maker)) return false;
        return true;
    }

    std::string prefix_;
};

/// A HAL component whose pins live in one structure `Pins` of HAL memory.
template <class Pins> class PinnedComponent : public PinMaker {
public:
    explicit PinnedComponent(std::string name) : PinMaker(-1, name), name_(std::move(name)) {}

    /// Makes the component; `make_all(pins)` makes its pins. False: HAL has said why, nothing is left.
    template <class F> bool make(F make_all) {
        id_ = hal_init(name_.c_str());
        if (id_ < 0) return false;
        pins_ = static_cast<Pins *>(hal_malloc(sizeof(Pins)));
        if (pins_ && make_all(*pins_)) return true;
        hal_exit(id_);
        return false;
    }

    void ready() const { hal_ready(id_); }
    void exit() const { hal_exit(id_); }
    Pins *operator->() const { return pins_; }
    Pins &operator*() const { return *pins_; }

private:
    std::string name_;
    Pins *pins_ = nullptr;
};

} // namespace vfd
