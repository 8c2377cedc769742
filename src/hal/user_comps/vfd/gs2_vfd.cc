// SPDX-License-Identifier: GPL-2.0-or-later
//
// gs2_vfd.cc - gs2_vfd: a GS2 drive (AutomationDirect) on a serial line as HAL pins (libmodbus).
// Source: Modbus sheet, section 2.
#include <getopt.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "hal.h"
#include "hardware_program.hh"
#include "modbus_link.hh"
#include "option_values.hh"
#include "spindle_guard.hh"

namespace gs2 {

namespace {

// Registers of the drive.
constexpr int STATUS = 0x2100, STATUS_COUNT = 13;
constexpr int SPEED = 0x091A, RUN = 0x091B, DIRECTION = 0x091C, FAULT_RESET = 0x091E;
constexpr int ACCEL = 0x0101, STOP_METHOD = 0x0100, DECEL = 0x0102, STALL_PREVENTION = 0x0605;
constexpr double COAST_DECEL_S = 20.0;

struct Options {
    std::string name = "gs2_vfd";
    vfd::SerialLine line = {"/dev/ttyS0", 38400, 8, 1, 'O', 1, false};
    double accel_s = 10, decel_s = 0;
    bool verbose = false, resistor = false, disabled = false;
};

struct Pins {
    hal_s32_t *status_1, *status_2, *firmware;
    hal_float_t *frequency_command, *frequency_out, *current, *dc_volts, *out_volts, *rpm, *scale_frequency,
        *power_factor, *load;
    hal_bit_t *at_speed, *is_stopped, *initialized, *on, *fwd, *rev, *err_reset, *enable;
    hal_float_t *speed_command;
    // parameters
    hal_s32_t error_count, retval, ack_delay;
    hal_float_t loop_time, tolerance, nameplate_hz, nameplate_rpm;
};

class Drive {
public:
    explicit Drive(const Options &options)
        : options_(options), link_(options.name, connection(options)), pins_(options.name) {}

    int run() {
        if (!link_.open() || !make_pins()) return -1;
        pins_.ready();
        while (!ending) {
            step();
            double loop_s = pins_->loop_time;
            pause_s(loop_s > 0.001 ? std::min(loop_s, 2.0) : 0.001);
        }
        // nothing turns on after the program
        bool stopped = !*pins_->initialized;
        for (int tries = 0; tries < 5 && !stopped; tries++) stopped = write(RUN, 0);
        if (!stopped)
            fprintf(stderr, "%s: ERROR: the drive did not take the stop: its spindle may turn\n",
                    options_.name.c_str());
        pins_.exit();
        return 0;
    }

private:
    static vfd::Connection connection(const Options &options) {
        vfd::Connection connection;
        connection.line = options.line;
        return connection;
    }

    bool write(int address, int value) { return answered(link_.write(options_.line.target, address, value)); }

    bool answered(bool good) {
        guard_.answered(good, link_.connected());
        if (guard_.lost()) {
            run_ = direction_ = reset_ = -1; // when it is back it stops first
            *pins_->at_speed = *pins_->is_stopped = false;
        }
        return good;
    }

    void step() {
        Pins &p = *pins_;
        bool wanted = *p.on, enabled = *p.enable;
        bool run = guard_.may_run(wanted, enabled);
        if (!enabled) {
            if (*p.initialized) {
                *p.on = false;
                command(false);
                if (run_ == 0) *p.initialized = false; // else the drive did not hear of it: again
            }
            return;
        }
        if (!*p.initialized) {
            if (!configure()) return;
            *p.initialized = true;
            run_ = direction_ = reset_ = -1;
        }
        if (guard_.lost() && !write(RUN, 0)) {
            p.error_count++;
            p.retval = -1;
            return;
        }
        read();
        command(run && !guard_.lost());
    }

    bool configure() {
        bool coast = options_.decel_s <= 0;
        struct {
            int address, value;
        } settings[] = {{ACCEL, static_cast<int>(std::lround(options_.accel_s * 10))},
                        {STOP_METHOD, coast ? 1 : 0},
                        {DECEL, static_cast<int>(std::lround((coast ? COAST_DECEL_S : options_.decel_s) * 10))},
                        {STALL_PREVENTION, options_.resistor ? 1 : 0}};
        for (auto &s : settings) {
            if (!write(s.address, s.value)) {
                pins_->error_count++;
                return false;
            }
            if (options_.verbose)
                printf("%s: register 0x%04x = %d\n", options_.name.c_str(), static_cast<unsigned>(s.address), s.value),
                    fflush(stdout);
        }
        return true;
    }

    void read() {
        Pins &p = *pins_;
        uint16_t r[STATUS_COUNT];
        if (!answered(link_.read(options_.line.target, STATUS, STATUS_COUNT, r))) {
            p.retval = -1;
            p.error_count++;
            *p.at_speed = false;
            return;
        }
        p.retval = 0;
        *p.status_1 = r[0];
        *p.status_2 = r[1];
        *p.frequency_command = r[2] / 10.0;
        *p.frequency_out = r[3] / 10.0;
        *p.current = r[4] / 10.0;
        *p.dc_volts = r[5] / 10.0;
        *p.out_volts = r[6] / 10.0;
        *p.rpm = r[7];
        *p.scale_frequency = (static_cast<uint32_t>(r[9]) << 16 | r[8]) / 10.0;
        *p.power_factor = r[10];
        *p.load = r[11] / 10.0;
        *p.firmware = r[12];
        *p.is_stopped = r[3] == 0;
        if (!*p.on) {
            *p.at_speed = false;
            since_start_ = 0;
        } else if (since_start_ < p.ack_delay) {
            since_start_++; // the drive has not taken the command yet
            *p.at_speed = false;
        } else {
            *p.at_speed = r[2] == r[3];
        }
    }

    void command(bool run) {
        Pins &p = *pins_;
        if (p.nameplate_hz < 10) p.nameplate_hz = 60;
        if (p.nameplate_rpm < 600 || p.nameplate_rpm > 5000) p.nameplate_rpm = 1800;
        double hz_tenths = std::fabs(*p.speed_command * p.nameplate_hz / p.nameplate_rpm * 10);
        if (!run) change(RUN, 0, run_); // a stop does not wait
        bool speed = write(SPEED, std::isfinite(hz_tenths) ? static_cast<int>(std::min(hz_tenths, 65535.0)) : 0);
        *p.rev = !*p.fwd && *p.on;
        change(DIRECTION, *p.fwd ? 0 : 1, direction_);
        if (run && speed && direction_ >= 0) change(RUN, 1, run_); // nothing starts as it was before
        change(FAULT_RESET, *p.err_reset ? 1 : 0, reset_);
    }

    /// Writes what is new. What the drive did not take is tried again.
    void change(int address, int value, int &known) {
        if (value != known) known = write(address, value) ? value : -1;
    }

    bool make_pins() {
        if (!pins_.make([this](Pins &p) { return make_all(p); })) return false;
        Pins &p = *pins_;
        p.loop_time = 0.1;
        p.tolerance = 0.01;
        p.nameplate_hz = 60;
        p.nameplate_rpm = 1730;
        p.ack_delay = 2;
        *p.fwd = true;
        *p.enable = !options_.disabled;
        return true;
    }

    bool make_all(Pins &p) {
        return pins_.floats({{&p.frequency_command, HAL_OUT, "frequency-command"},
                             {&p.frequency_out, HAL_OUT, "frequency-out"},
                             {&p.current, HAL_OUT, "output-current"},
                             {&p.dc_volts, HAL_OUT, "DC-bus-volts"},
                             {&p.out_volts, HAL_OUT, "output-voltage"},
                             {&p.rpm, HAL_OUT, "motor-RPM"},
                             {&p.scale_frequency, HAL_OUT, "scale-frequency"},
                             {&p.power_factor, HAL_OUT, "power-factor"},
                             {&p.load, HAL_OUT, "load-percentage"},
                             {&p.speed_command, HAL_IN, "speed-command"}}) &&
               pins_.bits({{&p.at_speed, HAL_OUT, "at-speed"},
                           {&p.is_stopped, HAL_OUT, "is-stopped"},
                           {&p.initialized, HAL_OUT, "initialized"},
                           {&p.on, HAL_IN, "spindle-on"},
                           {&p.fwd, HAL_IN, "spindle-fwd"},
                           {&p.rev, HAL_IN, "spindle-rev"},
                           {&p.err_reset, HAL_IN, "err-reset"},
                           {&p.enable, HAL_IN, "enable"}}) &&
               pins_.integers({{&p.status_1, HAL_OUT, "status-1"},
                               {&p.status_2, HAL_OUT, "status-2"},
                               {&p.firmware, HAL_OUT, "firmware-revision"}}) &&
               pins_.parameter(p.error_count, "error-count", hal_param_s32_newf) &&
               pins_.parameter(p.retval, "retval", hal_param_s32_newf) &&
               pins_.parameter(p.ack_delay, "ack-delay", hal_param_s32_newf) &&
               pins_.parameter(p.loop_time, "loop-time", hal_param_float_newf) &&
               pins_.parameter(p.tolerance, "tolerance", hal_param_float_newf) &&
               pins_.parameter(p.nameplate_hz, "nameplate-HZ", hal_param_float_newf) &&
               pins_.parameter(p.nameplate_rpm, "nameplate-RPM", hal_param_float_newf);
    }

    const Options &options_;
    vfd::ModbusLink link_;
    vfd::Guard guard_{false};
    int run_ = -1, direction_ = -1, reset_ = -1, since_start_ = 0;
    vfd::PinnedComponent<Pins> pins_;
};

constexpr auto RATES = {"110", "300", "600", "1200", "2400", "4800", "9600", "19200", "38400", "57600", "115200"};
constexpr option LONG[] = {
    {"bits", 1, nullptr, 'b'},          {"device", 1, nullptr, 'd'},        {"verbose", 0, nullptr, 'v'},
    {"debug", 0, nullptr, 'g'},         {"name", 1, nullptr, 'n'},          {"parity", 1, nullptr, 'p'},
    {"rate", 1, nullptr, 'r'},          {"stopbits", 1, nullptr, 's'},      {"target", 1, nullptr, 't'},
    {"accel-seconds", 1, nullptr, 'A'}, {"decel-seconds", 1, nullptr, 'D'}, {"braking-resistor", 0, nullptr, 'R'},
    {"disable", 0, nullptr, 'X'},       {"help", 0, nullptr, 'h'},          {nullptr, 0, nullptr, 0}};

void usage() {
    printf("gs2_vfd [-b BITS] [-d DEVICE] [-v] [-g] [-n NAME] [-p even|odd|none] [-r RATE] [-s STOPBITS] [-t TARGET]\n"
           "        [-A ACCEL_SECONDS] [-D DECEL_SECONDS] [-R] [-X]\n"
           "Defaults: 8 bits, /dev/ttyS0, gs2_vfd, odd, 38400, 1, 1, 10.0, 0.0 (coast).\n"
           "-v shows what is configured, -g the traffic; -R: there is a braking resistor; -X: begins disabled.\n");
}

/// Status to end with, or none to go on.
bool parse(int argc, char **argv, Options &o, int &status) {
    status = -1;
    for (int c; (c = getopt_long(argc, argv, "b:d:vgn:p:r:s:t:A:D:RXh", LONG, nullptr)) != -1;) {
        auto taken = vfd::line_option("gs2_vfd", c, optarg, RATES, o.line);
        if (taken && !*taken) return false;
        if (taken) continue;
        switch (c) {
        case 'v': o.verbose = true; break;
        case 'g': o.line.debug = true; break;
        case 'n': if (!name_of("gs2_vfd", optarg, o.name)) return false; break;
        case 'A': if (!number_of("gs2_vfd", "accel-seconds", optarg, 0, 6553, o.accel_s)) return false; break;
        case 'D': if (!number_of("gs2_vfd", "decel-seconds", optarg, 0, 6553, o.decel_s)) return false; break;
        case 'R': o.resistor = true; break;
        case 'X': o.disabled = true; break;
        case 'h': usage(); status = 0; return false;
        default: return false;
        }
    }
    return true;
}

} // namespace

int run_program(int argc, char **argv) {
    Options options;
    int status;
    if (!parse(argc, argv, options, status)) return status;
    printf("%s: device='%s', baud=%d, parity='%c', bits=%d, stopbits=%d, address=%d, enabled=%d\n",
           options.name.c_str(), options.line.device.c_str(), options.line.rate, options.line.parity, options.line.bits,
           options.line.stop, options.line.target, !options.disabled);
    fflush(stdout);
    begin_hardware_program(options.name.c_str());
    return Drive(options).run();
}

} // namespace gs2

int main(int argc, char **argv) { return gs2::run_program(argc, argv); }
