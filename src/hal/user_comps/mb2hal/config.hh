// SPDX-License-Identifier: GPL-2.0-or-later
//
// config.hh - the file of mb2hal: what is read from and written to which Modbus device.
#pragma once

#include <modbus.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "hal.h"

namespace mb2hal {

enum class Code {
    read_coils = 1,
    read_inputs = 2,
    read_holding = 3,
    read_input_registers = 4,
    write_coil = 5,
    write_register = 6,
    write_coils = 15,
    write_registers = 16
};

/// A serial line or a TCP peer; transactions of one link run one after the other.
struct Link {
    bool tcp = false;
    std::string ip;
    int port = 502;
    std::string device;
    int baud = 0, bits = 8, stop = 1;
    char parity = 'N';
    modbus_t *context = nullptr;
    bool connected = false;
};

/// Pins of one element; those that its kind does not have are null.
struct Element {
    std::string name;
    hal_bit_t **bit = nullptr, **bit_inverted = nullptr;
    hal_float_t **value = nullptr;
    hal_s32_t **integer = nullptr;
};

/// [TRANSACTION_nn]
struct Transaction {
    int number = 0;
    std::string name; ///< part of the pin names
    Code code = Code::read_coils;
    Link *link = nullptr;
    int slave = 0, first = 0;
    double rate_hz = 0;     ///< 0: as often as possible
    int response_ms = 500, byte_ms = 500, delay_ms = 0, debug = 1;
    std::vector<Element> elements;
    hal_u32_t **errors = nullptr;
    std::string told; ///< the fault that was told last
    std::chrono::steady_clock::time_point due{};
};

struct Config {
    std::string module = "mb2hal";
    int debug = 1;
    int version = 1000; ///< M * 1000 + m
    double slowdown_s = 0;
    std::vector<std::unique_ptr<Link>> links;
    std::vector<Transaction> transactions;

    bool names_kinds() const { return version >= 1001; } ///< pin names end with .bit, .float, .int
};

/// Prints `<module> <function> ERR: text` (level 1, stderr), OK (2), DEBUG (3), DEBUGMAX (4) up to `debug`.
void say(const Config &config, int level, int debug, const char *function, const std::string &text);

/// False, after messages on stderr, when the file cannot be used.
bool read_config(const std::string &path, Config &config);

} // namespace mb2hal
