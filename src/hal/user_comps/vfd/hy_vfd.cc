// SPDX-License-Identifier: GPL-2.0-or-later
//
// hy_vfd.cc - hy_vfd: a Huanyang drive on a serial line as HAL pins. Source: Modbus sheet, section 3.
#include <getopt.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "hal.h"
#include "hardware_program.hh"
#include "hycomm.hh"
#include "option_values.hh"
#include "serial_line.hh"
#include "spindle_guard.hh"

namespace hy {

namespace {

constexpr int RUN_FORWARD = 0x01, RUN_REVERSE = 0x11, STOP = 0x08;
constexpr int MAX_FREQUENCY = 5, BASE_FREQUENCY = 4, LOWEST_FREQUENCY = 11, RATED_VOLTAGE = 141, RATED_CURRENT = 142,
              POLES = 143, RATED_SPEED = 144;
constexpr int LAST_PARAMETER = 182;
constexpr double RATED_AT_HZ = 50, CYCLE_S = 0.1, LOOK_S = 0.01;
constexpr int OK_AFTER = 10, STOP_TRIES = 5;
constexpr size_t MAX_REGISTERS = 10;
constexpr int STATUSES = 8;

struct Options {
    std::string name = "hy_vfd";
    vfd::SerialLine line;
    double max_hz = 0, min_hz = 0, base_hz = 0, volts = 0, amperes = 0, rpm = 0; ///< 0: as the drive has it
    int poles = 0;
    std::vector<std::pair<int, int>> registers;
    bool dump = false;
};

struct Pins {
    hal_bit_t *enable, *forward, *reverse, *on;
    hal_float_t *status[STATUSES]; ///< SetF OutF OutA Rott DCV ACV Cont Tmp
    hal_float_t *control, *answer;
    hal_bit_t *bits[8];
    hal_float_t *speed_command, *frequency_command, *max_freq, *base_freq, *lower_limit, *volts, *amperes, *rated_rev,
        *fb, *fb_rps, *tolerance;
    hal_u32_t *poles, *retval;
    hal_bit_t *ok, *at_speed;
    hal_s32_t *error_count;
};

enum { SET_F = 0, OUT_F = 1 };
constexpr const char *STATUS_NAMES[STATUSES] = {"SetF", "OutF", "OutA", "Rott", "DCV", "ACV", "Cont", "Tmp"};
constexpr double STATUS_SCALE[STATUSES] = {100, 100, 10, 1, 1, 1, 1, 1};
constexpr const char *BIT_NAMES[8] = {"CNST-run",     "CNST-jog",        "CNST-command-rf", "CNST-running",
                                      "CNST-jogging", "CNST-running-rf", "CNST-bracking",   "CNST-track-start"};
constexpr int BIT_MASKS[8] = {0x01, 0x02, 0x04, 0x08, 0x10, 0x20, 0x40, 0x80};

class Drive {
public:
    explicit Drive(const Options &options)
        : options_(options), drive_(options.name, options.line), pins_(options.name) {}

    int run() {
        if (!drive_.open() || !make_pins()) return -1;
        pins_.ready();
        while (!ending) {
            if (!*pins_->enable) {
                may_run();
                if (!stopped_) stopped_ = write_control(STOP); // it did not hear of it: again
                pause_s(LOOK_S);
                continue;
            }
            if (!set_up()) {
                if (!told_) fprintf(stderr, "%s: error reading setup from VFD, retrying\n", options_.name.c_str());
                told_ = true;
                pause_s(CYCLE_S);
                continue;
            }
            told_ = false;
            while (!ending && *pins_->enable) {
                cycle();
                pause_s(CYCLE_S);
            }
            rest();
        }
        pins_.exit();
        return 0;
    }

private:
    /// The command is to run, in one direction.
    bool may_run() {
        Pins &p = *pins_;
        bool wanted = *p.on && *p.forward != *p.reverse, enabled = *p.enable;
        return guard_.may_run(wanted, enabled);
    }

    /// Counts what went well and what did not.
    std::optional<int> told(std::optional<int> answer) {
        Pins &p = *pins_;
        guard_.answered(answer.has_value(), drive_.is_open());
        if (answer) {
            good_ = std::min(good_ + 1, OK_AFTER + 1);
            *p.retval = 0;
        } else {
            good_ = 0;
            *p.error_count = *p.error_count + 1;
            *p.retval = 1;
        }
        *p.ok = good_ > OK_AFTER;
        return answer;
    }

    /// Gives the drive what the options say, then asks what it has.
    bool setting(int number, double given, double scale, hal_float_t *pin) {
        if (given > 0 && !told(drive_.set_parameter(number, static_cast<int>(std::lround(given * scale)))))
            return false;
        auto value = told(drive_.parameter(number));
        if (value) *pin = *value / scale;
        return value.has_value();
    }

    bool set_up() {
        Pins &p = *pins_;
        const Options &o = options_;
        for (auto &[number, value] : o.registers)
            if (!told(drive_.set_parameter(number, value))) return false;
        if (!setting(MAX_FREQUENCY, o.max_hz, 100, p.max_freq) ||
            !setting(BASE_FREQUENCY, o.base_hz, 100, p.base_freq) ||
            !setting(LOWEST_FREQUENCY, o.min_hz, 100, p.lower_limit) || !setting(RATED_VOLTAGE, o.volts, 10, p.volts) ||
            !setting(RATED_CURRENT, o.amperes, 10, p.amperes))
            return false;
        if (o.poles > 0 && !told(drive_.set_parameter(POLES, o.poles))) return false;
        auto poles = told(drive_.parameter(POLES));
        if (!poles) return false;
        *p.poles = static_cast<uint32_t>(*poles);
        double max_hz = *p.max_freq;
        if (o.rpm > 0 && max_hz > 0 &&
            !told(drive_.set_parameter(RATED_SPEED, static_cast<int>(std::lround(o.rpm / max_hz * RATED_AT_HZ)))))
            return false;
        auto speed = told(drive_.parameter(RATED_SPEED));
        if (!speed) return false;
        *p.rated_rev = *speed / RATED_AT_HZ * max_hz;
        if (o.dump) dump();
        frequency_ = -1;
        return true;
    }

    void dump() {
        for (int n = 0; n <= LAST_PARAMETER && !ending; n++)
            if (auto value = drive_.parameter(n)) printf("PD%03d=%d\n", n, *value), fflush(stdout);
    }

    void cycle() {
        Pins &p = *pins_;
        bool run = may_run(), forward = run && *p.forward, reverse = run && !forward;
        bool good = run || write_control(STOP); // a stop does not wait; nothing starts at the speed of before
        if (!guard_.lost()) good = write_frequency(forward, reverse) && good;
        if (run && good) write_control(forward ? RUN_FORWARD : RUN_REVERSE);
        for (int n = 0; n < STATUSES && !guard_.lost(); n++)
            if (auto value = told(drive_.status(n))) *p.status[n] = *value / STATUS_SCALE[n];
        if (guard_.lost()) frequency_ = -1; // nothing is known; when it is back it stops first
        speed();
    }

    bool write_frequency(bool forward, bool reverse) {
        Pins &p = *pins_;
        double rated = *p.rated_rev, command = *p.speed_command;
        if (!std::isfinite(command)) command = 0;
        double around = forward ? 1 : reverse ? -1 : 0; // makes up for what is cut off
        double hz = rated > 0 ? std::fabs((command + around) * *p.max_freq / rated) : 0;
        double most = *p.max_freq, least = *p.lower_limit;
        int value = static_cast<int>(std::min(std::max(std::min(hz, most), least), 655.35) * 100);
        *p.frequency_command = value;
        if (value != frequency_) frequency_ = told(drive_.frequency(value)) ? value : -1;
        return frequency_ == value;
    }

    bool write_control(int control) {
        Pins &p = *pins_;
        *p.control = control;
        auto answer = told(drive_.control(control));
        if (!answer) return false;
        *p.answer = *answer;
        for (int n = 0; n < 8; n++) *p.bits[n] = (*answer & BIT_MASKS[n]) != 0;
        return true;
    }

    void speed() {
        Pins &p = *pins_;
        double command = std::fabs(*p.speed_command), max_hz = *p.max_freq;
        bool turns = *p.on && command > 0 && *p.status[SET_F] > 0 && max_hz > 0;
        double rpm = turns ? *p.status[OUT_F] / max_hz * *p.rated_rev : 0;
        *p.fb = rpm;
        *p.fb_rps = rpm / 60;
        *p.at_speed = turns && *p.ok && std::fabs(1 - rpm / command) < *p.tolerance;
    }

    /// Disabled, or at the end: the drive stops.
    void rest() {
        stopped_ = false;
        for (int tries = 0; tries < STOP_TRIES && !stopped_; tries++) stopped_ = write_control(STOP);
        if (!stopped_ && ending)
            fprintf(stderr, "%s: ERROR: the drive did not take the stop: its spindle may turn\n",
                    options_.name.c_str());
        *pins_->at_speed = false;
        *pins_->fb = 0;
        *pins_->fb_rps = 0;
    }

    bool make_pins() {
        if (!pins_.make([this](Pins &p) { return make_all(p); })) return false;
        *pins_->tolerance = 0.02;
        return true;
    }

    bool make_all(Pins &p) {
        for (int n = 0; n < STATUSES; n++)
            if (!pins_.pin(p.status[n], HAL_OUT, STATUS_NAMES[n], hal_pin_float_newf) ||
                !pins_.pin(p.bits[n], HAL_OUT, BIT_NAMES[n], hal_pin_bit_newf))
                return false;
        return pins_.floats({{&p.control, HAL_OUT, "CNTR"},
                             {&p.answer, HAL_OUT, "CNST"},
                             {&p.speed_command, HAL_IN, "speed-command"},
                             {&p.frequency_command, HAL_OUT, "frequency-command"},
                             {&p.max_freq, HAL_OUT, "max-freq"},
                             {&p.base_freq, HAL_OUT, "base-freq"},
                             {&p.lower_limit, HAL_OUT, "freq-lower-limit"},
                             {&p.volts, HAL_OUT, "rated-motor-voltage"},
                             {&p.amperes, HAL_OUT, "rated-motor-current"},
                             {&p.rated_rev, HAL_OUT, "rated-motor-rev"},
                             {&p.fb, HAL_OUT, "spindle-speed-fb"},
                             {&p.fb_rps, HAL_OUT, "spindle-speed-fb-rps"},
                             {&p.tolerance, HAL_IN, "spindle-at-speed-tolerance"}}) &&
               pins_.bits({{&p.enable, HAL_IN, "enable"},
                           {&p.forward, HAL_IN, "spindle-forward"},
                           {&p.reverse, HAL_IN, "spindle-reverse"},
                           {&p.on, HAL_IN, "spindle-on"},
                           {&p.ok, HAL_OUT, "hycomm-ok"},
                           {&p.at_speed, HAL_OUT, "spindle-at-speed"}}) &&
               pins_.pin(p.poles, HAL_OUT, "motor-poles", hal_pin_u32_newf) &&
               pins_.pin(p.retval, HAL_OUT, "retval", hal_pin_u32_newf) &&
               pins_.pin(p.error_count, HAL_OUT, "error-count", hal_pin_s32_newf);
    }

    const Options &options_;
    Hycomm drive_;
    vfd::Guard guard_{false};
    vfd::PinnedComponent<Pins> pins_;
    int good_ = 0, frequency_ = -1;
    bool told_ = false, stopped_ = true;
};

constexpr int REGISTER = 1000, DUMP = 1001;
constexpr option LONG[] = {{"bits", 1, nullptr, 'b'},
                           {"device", 1, nullptr, 'd'},
                           {"debug", 0, nullptr, 'g'},
                           {"name", 1, nullptr, 'n'},
                           {"parity", 1, nullptr, 'p'},
                           {"rate", 1, nullptr, 'r'},
                           {"stopbits", 1, nullptr, 's'},
                           {"target", 1, nullptr, 't'},
                           {"max-frequency", 1, nullptr, 'F'},
                           {"min-frequency", 1, nullptr, 'f'},
                           {"base-frequency", 1, nullptr, 'B'},
                           {"motor-voltage", 1, nullptr, 'V'},
                           {"motor-current", 1, nullptr, 'I'},
                           {"motor-speed", 1, nullptr, 'S'},
                           {"motor-poles", 1, nullptr, 'P'},
                           {"register", 1, nullptr, REGISTER},
                           {"regdump", 0, nullptr, DUMP},
                           {"help", 0, nullptr, 'h'},
                           {nullptr, 0, nullptr, 0}};

void usage() {
    printf("hy_vfd [-b BITS] [-d DEVICE] [-g] [-n NAME] [-p even|odd|none] [-r RATE] [-s STOPBITS] [-t TARGET]\n"
           "       [-F MAX_HZ] [-f MIN_HZ] [-B BASE_HZ] [-V MOTOR_VOLTS] [-I MOTOR_AMPERES] [-S RPM_AT_MAX_HZ] [-P "
           "POLES]\n"
           "       [--register PDnnn=VALUE] [--regdump]\n"
           "Defaults: 8 bits, /dev/ttyS0, hy_vfd, even, 19200, 1, 1; what is not given stays as the drive has it.\n");
}

bool a_register(const char *text, Options &o) {
    int number = 0, value = 0;
    char rest;
    if (sscanf(text, "PD%3d=%d%c", &number, &value, &rest) != 2 || number < 0 || number > LAST_PARAMETER || value < 0 ||
        value > 65535) {
        fprintf(stderr, "hy_vfd: register %s: must be like PD001=2\n", text);
        return false;
    }
    if (o.registers.size() == MAX_REGISTERS) {
        fprintf(stderr, "hy_vfd: more than %zu registers\n", MAX_REGISTERS);
        return false;
    }
    o.registers.emplace_back(number, value);
    return true;
}

/// False with the status to end with.
bool parse(int argc, char **argv, Options &o, int &status) {
    status = -1;
    for (int c; (c = getopt_long(argc, argv, "b:d:gn:p:r:s:t:F:f:B:V:I:S:P:h", LONG, nullptr)) != -1;) {
        auto taken = vfd::line_option("hy_vfd", c, optarg, {"1200", "2400", "4800", "9600", "19200", "38400"}, o.line);
        if (taken && !*taken) return false;
        if (taken) continue;
        double value = 0;
        switch (c) {
        case 'g': o.line.debug = true; break;
        case 'n': if (!name_of("hy_vfd", optarg, o.name)) return false; break;
        case 'F': if (!number_of("hy_vfd", "max-frequency", optarg, 0, 650, o.max_hz)) return false; break;
        case 'f': if (!number_of("hy_vfd", "min-frequency", optarg, 0, 650, o.min_hz)) return false; break;
        case 'B': if (!number_of("hy_vfd", "base-frequency", optarg, 0, 400, o.base_hz)) return false; break;
        case 'V': if (!number_of("hy_vfd", "motor-voltage", optarg, 0, 6500, o.volts)) return false; break;
        case 'I': if (!number_of("hy_vfd", "motor-current", optarg, 0, 6500, o.amperes)) return false; break;
        case 'S': if (!number_of("hy_vfd", "motor-speed", optarg, 0, 1e6, o.rpm)) return false; break;
        case 'P':
            if (!number_of("hy_vfd", "motor-poles", optarg, 0, 255, value)) return false;
            o.poles = static_cast<int>(value);
            break;
        case REGISTER: if (!a_register(optarg, o)) return false; break;
        case DUMP: o.dump = true; break;
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
    begin_hardware_program(options.name.c_str());
    return Drive(options).run();
}

} // namespace hy

int main(int argc, char **argv) { return hy::run_program(argc, argv); }
