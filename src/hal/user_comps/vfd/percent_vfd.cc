// SPDX-License-Identifier: GPL-2.0-or-later
//
// percent_vfd.cc - hy_gt_vfd (Huanyang GT) and svd-ps_vfd (Soyan SVD-PS): drives that take their speed in
// hundredths of a percent (libmodbus). The name of the program chooses. Source: Modbus sheet, section 4.
#include <errno.h>
#include <getopt.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include "hal.h"
#include "hardware_program.hh"
#include "modbus_link.hh"
#include "option_values.hh"
#include "spindle_guard.hh"

namespace percent {

namespace {

constexpr int FORWARD = 1, STOP = 5, FULL = 10000, TRIES = 6, NO_REGISTER = -1;
constexpr size_t MAX_VALUES = 12;

struct Value { const char *pin; int address; double scale; };

/// One kind of drive.
struct Kind {
    const char *name;
    int rate, stop, run, frequency;
    int response_us;
    int gap_bytes;  ///< silence before each transaction, in bytes of 10 bits
    int fault;      ///< register of pin fault-info, or NO_REGISTER
    Value values[MAX_VALUES];
};

constexpr Kind KINDS[] = {{"hy_gt_vfd",
                           38400,
                           1,
                           0x1000,
                           0x2000,
                           16000,
                           8,
                           0x5000,
                           {{"freq-fb", 0x3000, 0.01},
                            {"dc-bus-voltage", 0x3002, 0.1},
                            {"output-voltage", 0x3003, 1},
                            {"output-current", 0x3004, 1},
                            {"speed-fb", 0x3005, 1},
                            {"output-power", 0x3006, 1},
                            {"input-terminal", 0x300a, 1},
                            {"output-terminal", 0x300b, 1},
                            {"AI1", 0x300c, 1},
                            {"AI2", 0x300d, 1},
                            {"HDI-frequency", 0x3010, 1},
                            {"external-counter", 0x3014, 1}}},
                          {"svd-ps_vfd",
                           9600,
                           2,
                           0x2000,
                           0x1000,
                           30000,
                           5,
                           NO_REGISTER,
                           {{"freq-fb", 0x1001, 0.01},
                            {"dc-bus-voltage", 0x1002, 0.1},
                            {"output-voltage", 0x1003, 1},
                            {"output-current", 0x1004, 1},
                            {"speed-fb", 0x1005, 1},
                            {"output-power", 0x1006, 1},
                            {"input-terminal", 0x1009, 1},
                            {"AI1", 0x100a, 0.001},
                            {"AI2", 0x100b, 0.001},
                            {},
                            {},
                            {}}}};

struct Options {
    vfd::SerialLine line = {"/dev/ttyS0", 0, 8, 0, 'N', 1, false};
    double max_speed = 0, max_hz = 0, min_hz = 0;
};

struct Pins {
    hal_float_t *values[MAX_VALUES], *fault, *period, *speed_cmd, *freq_cmd;
    hal_u32_t *fault_code, *errors;
    hal_bit_t *at_speed, *on;
};

class Drive {
public:
    Drive(const Kind &kind, const Options &options)
        : kind_(kind), line_(options.line), options_(options), link_(kind.name, connection(kind, options)),
          pins_(kind.name) {}

    int run() {
        if (!link_.open() || !make_pins()) return 1;
        pins_.ready();
        while (!ending) {
            double period = *pins_->period;
            pause_s(period > 0.001 ? std::min(period, 2.0) : 0.001);
            if (!ending) step();
        }
        if (!write(kind_.run, STOP))
            fprintf(stderr, "%s: ERROR: the drive did not take the stop: its spindle may turn\n", kind_.name);
        pins_.exit();
        return 0;
    }

private:
    static vfd::Connection connection(const Kind &kind, const Options &options) {
        vfd::Connection connection;
        connection.line = options.line;
        connection.response_s = kind.response_us * 1e-6;
        return connection;
    }

    /// Up to six tries with the silence that the drive needs before each.
    template <class F> bool transact(F once) {
        for (int n = 0; n < TRIES; n++) {
            sleep_us(kind_.gap_bytes * 10 * 1000000LL / line_.rate);
            bool good = once();
            guard_.answered(good, link_.connected());
            if (good) return true;
            *pins_->errors = *pins_->errors + 1;
            if (!link_.connected()) return false;
            sleep_us(kind_.response_us); // a late answer is not the next one's
        }
        return false;
    }

    static void sleep_us(long long us) { std::this_thread::sleep_for(std::chrono::microseconds(us)); }

    bool read(int address, uint16_t &value) {
        return transact([&] { return link_.read(line_.target, address, 1, &value); });
    }

    bool write(int address, int value) {
        return transact([&] { return link_.write(line_.target, address, value); });
    }

    void step() {
        Pins &p = *pins_;
        bool run = guard_.may_run(*p.on, true);
        if (!(run ? start() : stop()) && guard_.lost()) {
            *p.at_speed = false;
            return; // when it is back it stops first
        }
        for (size_t n = 0; n < MAX_VALUES && kind_.values[n].pin; n++) {
            uint16_t value;
            if (!read(kind_.values[n].address, value)) {
                *p.at_speed = false;
                return; // the drive does not answer: the commands come first again
            }
            *p.values[n] = value * kind_.values[n].scale;
        }
        uint16_t fault;
        if (kind_.fault != NO_REGISTER && read(kind_.fault, fault)) {
            *p.fault = fault;
            *p.fault_code = fault;
        }
        double command = *p.speed_cmd, speed = *p.values[4];
        *p.at_speed = run && command > 0 && std::fabs(command - speed) / command < 0.02;
    }

    bool start() {
        Pins &p = *pins_;
        double part = *p.speed_cmd / options_.max_speed;
        part = std::isfinite(part) ? std::min(std::max(part, 0.0), 1.0) : 0.0;
        *p.freq_cmd = part * options_.max_hz;
        return write(kind_.frequency, static_cast<int>(std::lround(part * FULL))) && write(kind_.run, FORWARD);
    }

    bool stop() {
        *pins_->freq_cmd = 0;
        return write(kind_.run, STOP);
    }

    bool make_pins() {
        if (!pins_.make([this](Pins &p) { return make_all(p); })) return false;
        *pins_->period = 0.1;
        return true;
    }

    bool make_all(Pins &p) {
        for (size_t n = 0; n < MAX_VALUES && kind_.values[n].pin; n++)
            if (!pins_.pin(p.values[n], HAL_OUT, kind_.values[n].pin, hal_pin_float_newf)) return false;
        if (kind_.fault != NO_REGISTER && (!pins_.pin(p.fault, HAL_OUT, "fault-info", hal_pin_float_newf) ||
                                           !pins_.pin(p.fault_code, HAL_OUT, "fault-info-code", hal_pin_u32_newf)))
            return false;
        return pins_.pin(p.period, HAL_IN, "period-seconds", hal_pin_float_newf) &&
               pins_.pin(p.speed_cmd, HAL_IN, "speed-cmd", hal_pin_float_newf) &&
               pins_.pin(p.freq_cmd, HAL_OUT, "freq-cmd", hal_pin_float_newf) &&
               pins_.pin(p.at_speed, HAL_OUT, "at-speed", hal_pin_bit_newf) &&
               pins_.pin(p.on, HAL_IN, "spindle-on", hal_pin_bit_newf) &&
               pins_.pin(p.errors, HAL_OUT, "modbus-errors", hal_pin_u32_newf);
    }

    const Kind &kind_;
    const vfd::SerialLine &line_;
    const Options &options_;
    vfd::ModbusLink link_;
    vfd::Guard guard_;
    vfd::PinnedComponent<Pins> pins_;
};

constexpr option LONG[] = {
    {"motor-max-speed", 1, nullptr, 'S'}, {"max-frequency", 1, nullptr, 'F'}, {"min-frequency", 1, nullptr, 'f'},
    {"device", 1, nullptr, 'd'},          {"rate", 1, nullptr, 'r'},          {"bits", 1, nullptr, 'b'},
    {"parity", 1, nullptr, 'p'},          {"stopbits", 1, nullptr, 's'},      {"target", 1, nullptr, 't'},
    {"verbose", 0, nullptr, 'v'},         {"help", 0, nullptr, 'h'},          {nullptr, 0, nullptr, 0}};

void usage(const Kind &kind) {
    printf("%s -S MOTOR_MAX_RPM -F MAX_HZ -f MIN_HZ [-d DEVICE] [-r RATE] [-b BITS] [-p even|odd|none] [-s STOPBITS] "
           "[-t TARGET] [-v]\n"
           "Defaults: /dev/ttyS0, %d, 8 bits, none, %d, 1.\n",
           kind.name, kind.rate, kind.stop);
}

/// False with the status to end with.
bool parse(const Kind &kind, int argc, char **argv, Options &o, int &status) {
    status = 1;
    o.line.rate = kind.rate;
    o.line.stop = kind.stop;
    for (int c; (c = getopt_long(argc, argv, "S:F:f:d:r:b:p:s:t:vh", LONG, nullptr)) != -1;) {
        auto taken = vfd::line_option(kind.name, c, optarg, {"1200", "2400", "4800", "9600", "19200", "38400"}, o.line);
        if (taken && !*taken) return false;
        if (taken) continue;
        switch (c) {
        case 'S': if (!number_of(kind.name, "motor-max-speed", optarg, 1, 1e6, o.max_speed)) return false; break;
        case 'F': if (!number_of(kind.name, "max-frequency", optarg, 0.01, 10000, o.max_hz)) return false; break;
        case 'f': if (!number_of(kind.name, "min-frequency", optarg, 0.01, 10000, o.min_hz)) return false; break;
        case 'v': o.line.debug = true; break;
        case 'h': usage(kind); status = 0; return false;
        default: return false;
        }
    }
    if (o.max_speed > 0 && o.max_hz > 0 && o.min_hz > 0 && o.min_hz <= o.max_hz) return true;
    fprintf(stderr, "%s: needs --motor-max-speed, --max-frequency and --min-frequency, the last not above the second\n",
            kind.name);
    return false;
}

} // namespace

int run_program(int argc, char **argv) {
    const Kind &kind = std::string(program_invocation_short_name) == KINDS[1].name ? KINDS[1] : KINDS[0];
    Options options;
    int status;
    if (!parse(kind, argc, argv, options, status)) return status;
    begin_hardware_program(kind.name);
    return Drive(kind, options).run();
}

} // namespace percent

int main(int argc, char **argv) { return percent::run_program(argc, argv); }
