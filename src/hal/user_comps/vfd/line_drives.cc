// SPDX-License-Identifier: GPL-2.0-or-later
//
// line_drives.cc - see line_drives.hh.
#include "line_drives.hh"

#include <getopt.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "hardware_program.hh"
#include "option_values.hh"

namespace vfd {

namespace {

constexpr auto AFTER_RESET = std::chrono::seconds(1);
constexpr auto RETRY = std::chrono::milliseconds(500); ///< a lost drive does not hold up the others
constexpr double NAP_S = 0.01, NO_DRIVE_S = 0.1;
constexpr int STOP_TRIES = 5;
constexpr unsigned long MAX_COUNT = 247;

constexpr option LONG[] = {{"baud", 1, nullptr, 'r'},     {"parity", 1, nullptr, 'p'}, {"databits", 1, nullptr, 'b'},
                           {"stopbits", 1, nullptr, 's'}, {"device", 1, nullptr, 'd'}, {nullptr, 0, nullptr, 0}};

std::vector<std::string> split(const std::string &text) {
    std::vector<std::string> parts;
    for (size_t at = 0; at <= text.size();) {
        size_t end = std::min(text.find(',', at), text.size());
        if (end > at) parts.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return parts;
}

/// count= and names= out of argv.
bool take_instances(int &argc, char **argv, const char *program, LineOptions &o) {
    unsigned long count = 0;
    int kept = 1;
    for (int n = 1; n < argc; n++) {
        if (strncmp(argv[n], "count=", 6) == 0) count = strtoul(argv[n] + 6, nullptr, 0);
        else if (strncmp(argv[n], "names=", 6) == 0) o.names = split(argv[n] + 6);
        else argv[kept++] = argv[n];
    }
    argc = kept;
    argv[argc] = nullptr;
    if ((count > 0 && !o.names.empty()) || count > MAX_COUNT) {
        fprintf(stderr, "%s: %s\n", program,
                count > MAX_COUNT ? "count= must not be above 247" : "count= and names= are mutually exclusive");
        return false;
    }
    if (!o.names.empty()) return true;
    std::string prefix = program;
    std::replace(prefix.begin(), prefix.end(), '_', '-');
    for (unsigned long n = 0; n < std::max(count, 1UL); n++) o.names.push_back(prefix + "." + std::to_string(n));
    return true;
}

} // namespace

bool parse_line_options(int argc, char **argv, const char *program, LineOptions &o) {
    if (!take_instances(argc, argv, program, o)) return false;
    for (int c; (c = getopt_long(argc, argv, "", LONG, nullptr)) != -1;) {
        double rate = 0;
        if (c == 'r') {
            if (!number_of(program, "baud", optarg, 110, 921600, rate)) return false;
            o.line.rate = static_cast<int>(rate);
        } else if (!line_option(program, c, optarg, {}, o.line).value_or(false)) {
            return false;
        }
    }
    if (optind < argc) fprintf(stderr, "%s: WARNING: not used:", program);
    for (int n = optind; n < argc; n++) fprintf(stderr, " %s%s", argv[n], n + 1 == argc ? "\n" : "");
    return true;
}

bool LineDrive::make_common(LinePins &p) {
    pins_ = &p;
    return maker_.floats({{&p.commanded_frequency, HAL_IN, "commanded-frequency"},
                          {&p.motor_current, HAL_OUT, "motor-current"},
                          {&p.heatsink_temp, HAL_OUT, "heatsink-temp"}}) &&
           maker_.bits({{&p.run, HAL_IN, "run"},
                        {&p.enable, HAL_IN, "enable"},
                        {&p.is_running, HAL_OUT, "is-running"},
                        {&p.is_at_speed, HAL_OUT, "is-at-speed"},
                        {&p.is_ready, HAL_OUT, "is-ready"},
                        {&p.is_alarm, HAL_OUT, "is-alarm"},
                        {&p.watchdog_out, HAL_OUT, "watchdog-out"}}) &&
           maker_.parameter(p.slave, "mbslaveaddr", hal_param_u32_newf);
}

void LineDrive::step() {
    LinePins &p = *pins_;
    if (p.slave != slave_) { // another drive, or none any more
        rest();
        slave_ = p.slave;
        guard_ = Guard();
        may_turn_ = true;
        due_ = {};
    }
    if (slave_ == 0 || Clock::now() < due_) return;
    if (look()) {
        *p.is_at_speed = is_at_speed();
        *p.watchdog_out = !*p.watchdog_out;
        return;
    }
    *p.is_at_speed = false;
    if (!guard_.lost()) return;
    may_turn_ = true;
    *p.is_ready = false;
    forget();
    due_ = Clock::now() + RETRY;
}

bool LineDrive::look() {
    LinePins &p = *pins_;
    bool wanted = *p.run, enabled = *p.enable;
    bool run = guard_.may_run(wanted, enabled);
    bool good = true;
    if (!run && may_turn_) { // a stop waits for nothing
        good = write_run(false);
        may_turn_ = !good;
        if (guard_.lost()) return false;
    }
    if (!read_state()) return false;
    if (*p.is_alarm) guard_.disarm();
    return act(run, enabled) && good;
}

bool LineDrive::act(bool run, bool enabled) {
    LinePins &p = *pins_;
    if (!enabled) {
        enabling_ = true;
        return *p.is_alarm || trip();
    }
    if (*p.is_alarm) {
        if (!enabling_) return true; // a fault stays until the machine is enabled anew
        if (!write_reset()) return false;
        enabling_ = false;
        due_ = Clock::now() + AFTER_RESET;
        return true;
    }
    if (!prepare()) return false;
    if (run == *p.is_running) {
        if (run) enabling_ = false;
        return true;
    }
    if (run) may_turn_ = true;
    return write_run(run);
}

bool LineDrive::rest() {
    for (int tries = 0; slave_ != 0 && tries < STOP_TRIES; tries++)
        if (write_run(false)) return true;
    return slave_ == 0;
}

int run_line(int component, const char *program, const LineDrives &drives) {
    begin_hardware_program(program);
    hal_ready(component);
    while (!ending) {
        bool any = false;
        for (auto &drive : drives) {
            drive->step();
            any = any || drive->slave() != 0;
        }
        pause_s(any ? NAP_S : NO_DRIVE_S);
    }
    for (auto &drive : drives)
        if (!drive->rest())
            fprintf(stderr, "%s: ERROR: slave %u did not take the stop: its spindle may turn\n", program,
                    drive->slave());
    hal_exit(component);
    return 0;
}

} // namespace vfd
