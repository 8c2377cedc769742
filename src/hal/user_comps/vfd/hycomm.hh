// SPDX-License-Identifier: GPL-2.0-or-later
//
// hycomm.hh - the protocol of Huanyang drives: frames like Modbus RTU with functions of their own.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "serial_line.hh"

namespace hy {

enum class Function : uint8_t {
    read_parameter = 1,
    write_parameter = 2,
    control = 3,
    read_status = 4,
    write_frequency = 5
};

class Hycomm {
public:
    Hycomm(std::string program, const vfd::SerialLine &line) : program_(std::move(program)), line_(line) {}
    ~Hycomm();

    /// False, with a message on stderr. A line that is gone is opened anew by the requests that come later.
    bool open();
    bool is_open() const { return port_ >= 0; }

    // Each asks once and waits at most 0.5 s for the answer and for every gap in it. Nothing, with a message,
    // on failure.
    std::optional<int> parameter(int number);
    std::optional<int> set_parameter(int number, int value);
    std::optional<int> control(int bits);
    std::optional<int> status(int index);
    std::optional<int> frequency(int hz_hundredths);

private:
    std::optional<int> ask(Function function, std::initializer_list<int> data);
    bool receive(uint8_t *at, int count);
    bool fail_to_open();
    void shut();
    std::optional<int> fail(Function function, const char *what);
    void show(const char *direction, const uint8_t *data, int size) const;

    std::string program_, told_;
    vfd::SerialLine line_;
    int port_ = -1;
};

} // namespace hy
