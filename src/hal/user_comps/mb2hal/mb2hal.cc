// SPDX-License-Identifier: GPL-2.0-or-later
//
// mb2hal.cc - mb2hal config=FILE: HAL pins of Modbus devices, over serial lines and TCP (libmodbus).
// Source: Modbus sheet, section 1. One thread for each link; a pin is touched by one thread.
#include <algorithm>
#include <cerrno>
#include <climits>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <thread>

#include "config.hh"
#include "hardware_program.hh"

namespace mb2hal {

namespace {

constexpr int MAX_ELEMENTS = 100;
constexpr double NAP_S = 0.001;
constexpr double RETRY_S = 0.1; // between attempts to connect

bool reads_bits(Code c) { return c == Code::read_coils || c == Code::read_inputs; }
bool reads_registers(Code c) { return c == Code::read_holding || c == Code::read_input_registers; }
bool writes_bits(Code c) { return c == Code::write_coil || c == Code::write_coils; }
bool is_single(Code c) { return c == Code::write_coil || c == Code::write_register; }

// ---- pins ----

/// The pins of all transactions. hal_malloc() gives zeroed memory.
class Pins {
public:
    Pins(Config &config, int component) : config_(config), component_(component) {}

    bool make() {
        for (Transaction &t : config_.transactions) {
            std::string base = config_.module + "." + t.name;
            if (!pin(t.errors, HAL_OUT, base + ".num_errors", hal_pin_u32_newf)) return false;
            for (Element &e : t.elements)
                if (!element(t.code, e, base + "." + e.name)) return false;
        }
        return true;
    }

private:
    template <class T>
    bool pin(T **&at, hal_pin_dir_t dir, const std::string &name,
             int (*make)(hal_pin_dir_t, T **, int, const char *, ...)) {
        at = static_cast<T **>(hal_malloc(sizeof(T *)));
        return at && make(dir, at, component_, "%s", name.c_str()) == 0;
    }

    bool element(Code code, Element &e, const std::string &base) {
        bool new_names = config_.names_kinds();
        if (reads_bits(code)) {
            if (!new_names) return pin(e.bit, HAL_OUT, base, hal_pin_bit_newf);
            if (!pin(e.bit, HAL_OUT, base + ".bit", hal_pin_bit_newf) ||
                !pin(e.bit_inverted, HAL_OUT, base + ".bit-inv", hal_pin_bit_newf))
                return false;
            **e.bit_inverted = true;
            return true;
        }
        if (reads_registers(code))
            return pin(e.value, HAL_OUT, base + ".float", hal_pin_float_newf) &&
                   pin(e.integer, HAL_OUT, base + ".int", hal_pin_s32_newf);
        if (writes_bits(code)) return pin(e.bit, HAL_IN, new_names ? base + ".bit" : base, hal_pin_bit_newf);
        if (!new_names) return pin(e.value, HAL_IN, base, hal_pin_float_newf);
        return pin(e.value, HAL_IN, base + ".float", hal_pin_float_newf) &&
               pin(e.integer, HAL_IN, base + ".int", hal_pin_s32_newf);
    }

    Config &config_;
    int component_;
};

// ---- one transaction ----

/// The register for a float and an integer pin: their sum, at most 65535; negative numbers as 16 bits.
uint16_t register_of(const Element &e) {
    double value = std::isfinite(**e.value) ? **e.value : 0.0;
    long long sum =
        std::llround(std::trunc(std::clamp(value, static_cast<double>(INT_MIN), static_cast<double>(INT_MAX))));
    if (e.integer) sum += **e.integer;
    return static_cast<uint16_t>(std::min<long long>(sum, 65535));
}

bool run(modbus_t *link, Transaction &t) {
    int count = static_cast<int>(t.elements.size()), most = is_single(t.code) ? 1 : MAX_ELEMENTS;
    if (count > most) {
        errno = EMBMDATA;
        return false;
    }
    uint8_t bits[MAX_ELEMENTS];
    uint16_t words[MAX_ELEMENTS];
    for (size_t n = 0; n < t.elements.size(); n++) {
        const Element &e = t.elements[n];
        if (writes_bits(t.code)) bits[n] = **e.bit ? 1 : 0;
        else if (t.code == Code::write_register || t.code == Code::write_registers) words[n] = register_of(e);
    }
    int done = -1;
    switch (t.code) {
    case Code::read_coils: done = modbus_read_bits(link, t.first, count, bits); break;
    case Code::read_inputs: done = modbus_read_input_bits(link, t.first, count, bits); break;
    case Code::read_holding: done = modbus_read_registers(link, t.first, count, words); break;
    case Code::read_input_registers: done = modbus_read_input_registers(link, t.first, count, words); break;
    case Code::write_coil: done = modbus_write_bit(link, t.first, bits[0]); break;
    case Code::write_register: done = modbus_write_register(link, t.first, words[0]); break;
    case Code::write_coils: done = modbus_write_bits(link, t.first, count, bits); break;
    case Code::write_registers: done = modbus_write_registers(link, t.first, count, words); break;
    }
    if (done != count) return false;
    for (size_t n = 0; n < t.elements.size(); n++) {
        Element &e = t.elements[n];
        if (reads_bits(t.code)) {
            **e.bit = bits[n] != 0;
            if (e.bit_inverted) **e.bit_inverted = bits[n] == 0;
        } else if (reads_registers(t.code)) {
            **e.value = words[n];
            **e.integer = words[n];
        }
    }
    return true;
}

// ---- one link ----

using Clock = std::chrono::steady_clock;

Clock::duration duration(double seconds) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

class Worker {
public:
    Worker(Config &config, Link &link) : config_(config), link_(link) {
        for (Transaction &t : config.transactions)
            if (t.link == &link) mine_.push_back(&t);
    }

    void operator()() {
        while (!ending) {
            bool worked = false;
            for (Transaction *t : mine_) {
                if (ending) break;
                if (Clock::now() < t->due) continue;
                worked = true;
                step(*t);
            }
            if (!worked) pause_s(NAP_S);
        }
        drop();
    }

private:
    void step(Transaction &t) {
        if (!connect(t)) {
            **t.errors = **t.errors + 1;
            pause_s(RETRY_S);
            return;
        }
        modbus_set_slave(link_.context, t.slave);
        modbus_set_debug(link_.context, t.debug >= 3);
        set_timeouts(t);
        if (run(link_.context, t)) {
            **t.errors = 0;
            t.told.clear();
            say(config_, 2, t.debug, "link_loop_and_logic", t.name + " done");
        } else {
            failed(t);
        }
        if (t.rate_hz > 0) t.due = Clock::now() + duration(1 / t.rate_hz);
        if (!link_.tcp && t.delay_ms > 0) pause_s(t.delay_ms * 1e-3);
        if (config_.slowdown_s > 0) pause_s(config_.slowdown_s);
    }

    void failed(Transaction &t) {
        int reason = errno;
        **t.errors = **t.errors + 1;
        std::string problem = t.name + ": " + modbus_strerror(reason);
        if (problem != t.told) say(config_, 1, t.debug, "link_loop_and_logic", problem); // once, not each time
        t.told = problem;
        bool gone = reason == EBADF || reason == ECONNRESET || reason == EPIPE || reason == ECONNREFUSED ||
                    reason == ENOTCONN || reason == EIO || reason == ENXIO || modbus_get_socket(link_.context) < 0;
        if (gone) drop();
        else modbus_flush(link_.context);
        if (link_.tcp && reason == ETIMEDOUT) drop(); // a late answer must not be taken for the next one's
        pause_s(NAP_S);
    }

    void set_timeouts(const Transaction &t) {
        auto seconds = [](int ms) { return static_cast<uint32_t>(ms / 1000); };
        auto micros = [](int ms) { return static_cast<uint32_t>(ms % 1000 * 1000); };
        if (t.response_ms > 0)
            modbus_set_response_timeout(link_.context, seconds(t.response_ms), micros(t.response_ms));
        modbus_set_byte_timeout(link_.context, seconds(t.byte_ms), micros(t.byte_ms));
    }

    bool connect(const Transaction &t) {
        if (link_.connected) return true;
        if (!link_.context)
            link_.context =
                link_.tcp ? modbus_new_tcp(link_.ip.c_str(), link_.port)
                          : modbus_new_rtu(link_.device.c_str(), link_.baud, link_.parity, link_.bits, link_.stop);
        std::string where = link_.tcp ? link_.ip + ":" + std::to_string(link_.port) : link_.device;
        if (link_.context) {
            set_timeouts(t);
            link_.connected = modbus_connect(link_.context) == 0;
        }
        if (!link_.connected) {
            std::string problem = where + ": " + modbus_strerror(errno);
            if (problem != told_) say(config_, 1, t.debug, "get_tx_connection", problem);
            told_ = problem;
        } else {
            told_.clear();
            say(config_, 2, t.debug, "get_tx_connection", where + " connected");
        }
        return link_.connected;
    }

    void drop() {
        if (link_.context) {
            if (link_.connected) modbus_close(link_.context);
            modbus_free(link_.context);
        }
        link_.context = nullptr;
        link_.connected = false;
    }

    const Config &config_;
    Link &link_;
    std::vector<Transaction *> mine_;
    std::string told_;
};

} // namespace

int run_program(int argc, char **argv) {
    Config config;
    std::string argument = argc == 2 ? argv[1] : "";
    if (argument.compare(0, 7, "config=") != 0) {
        say(config, 1, 1, "parse_main_args",
            argc == 2 ? "must have config=FILE, not " + argument : "wrong number of args");
        return -1;
    }
    std::string path = argument.substr(7);
    if (path.size() >= 2 && path.front() == '"' && path.back() == '"') path = path.substr(1, path.size() - 2);
    if (!read_config(path, config)) return -1;
    signal(SIGPIPE, SIG_IGN);
    begin_hardware_program(config.module.c_str());
    int component = hal_init(config.module.c_str());
    if (component < 0) {
        say(config, 1, 1, "main", "hal_init failed: " + std::string(strerror(-component)));
        return -1;
    }
    if (!Pins(config, component).make()) {
        say(config, 1, 1, "main", "the pins can not be made: a name is used twice, or is too long");
        hal_exit(component);
        return -1;
    }
    hal_ready(component);
    std::vector<std::thread> threads;
    for (auto &link : config.links) threads.emplace_back(Worker(config, *link));
    for (auto &thread : threads) thread.join();
    hal_exit(component);
    return 0;
}

} // namespace mb2hal

int main(int argc, char **argv) { return mb2hal::run_program(argc, argv); }
