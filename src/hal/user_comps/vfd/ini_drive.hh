// SPDX-License-Identifier: GPL-2.0-or-later
//
// ini_drive.hh - the life of a drive that an INI section describes (vfs11_vfd, vfdb_vfd), and the pins and
// parameters that all such drives have. Source: Modbus sheet, section 6.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>

#include "hal.h"
#include "hardware_program.hh"
#include "ini_section.hh"
#include "modbus_link.hh"
#include "spindle_guard.hh"

namespace vfd {

struct IniPins {
    hal_bit_t *enable, *jog_mode, *on, *max_speed, *at_speed, *is_e_stopped, *is_stopped, *modbus_ok;
    hal_float_t *speed_command, *frequency_command, *frequency_out, *load, *max_rpm, *rpm, *frequency_limit;
    hal_s32_t *status, *error_count;
    // parameters
    hal_float_t loop_time, nameplate_hz, nameplate_rpm, rpm_limit, tolerance;
};

inline std::atomic<bool> toggle_debug{false}, toggle_modbus_debug{false};

/// `Pins` is derived from IniPins.
template <class Pins> class IniDrive {
public:
    IniDrive(const IniOptions &options, const IniSettings &settings)
        : pins_(options.name), options_(options), settings_(settings), link_(options.name, settings.connection),
          debug_(options.debug || settings.debug), modbus_debug_(options.modbus_debug || settings.modbus_debug) {}
    virtual ~IniDrive() = default;

    int run() {
        begin_hardware_program(options_.name.c_str());
        signal(SIGUSR1, [](int) { toggle_debug = true; });
        signal(SIGUSR2, [](int) { toggle_modbus_debug = true; });
        link_.debug(modbus_debug_);
        if (!link_.open() || !pins_.make([this](Pins &p) { return make_all(p); })) return 1;
        pins_.ready();
        while (!ending) {
            step();
            double loop_s = pins_->loop_time;
            bool busy = *pins_->max_speed && !guard_.lost(); // a drive that is lost is not asked without a pause
            if (!busy) pause_s(loop_s > SHORTEST_S ? std::min(loop_s, LONGEST_S) : SHORTEST_S);
        }
        rested_ = false;
        for (int tries = 0; tries < STOP_TRIES && !rested_; tries++) rested_ = rest();
        if (!rested_)
            fprintf(stderr, "%s: ERROR: the drive did not take the stop: its spindle may turn\n",
                    options_.name.c_str());
        pins_.exit();
        return 0;
    }

protected:
    /// Pins and parameters of this kind of drive.
    virtual bool more_pins(Pins &p) = 0;
    /// Once with every connection: what does not change. False: no answer.
    virtual bool begin() = 0;
    /// Something of this kind of drive keeps the spindle from turning.
    virtual bool is_held() { return false; }
    virtual bool command(bool run) = 0;
    virtual int frequency_register() const = 0; ///< 0.01 Hz
    /// Stops, and gives the drive back to its panel. True when both were taken.
    virtual bool rest() = 0;
    /// Reads; `slow`: what changes slowly, too.
    virtual bool look(bool slow) = 0;
    /// Tells what the drive says of itself (-r).
    virtual bool report() = 0;

    bool read(int address, uint16_t &value) {
        return answered(link_.read(settings_.connection.line.target, address, 1, &value));
    }
    /// Reads a register into a pin.
    bool read(int address, hal_float_t *pin, double scale) {
        uint16_t value;
        if (!read(address, value)) return false;
        *pin = value * scale;
        return true;
    }
    bool read(int address, hal_s32_t *pin) {
        uint16_t value;
        if (!read(address, value)) return false;
        *pin = value;
        return true;
    }
    bool write(int address, int value) {
        return answered(link_.write(settings_.connection.line.target, address, value));
    }
    bool tell(const char *what, int address, double scale, const char *unit) {
        uint16_t value;
        if (!read(address, value)) return false;
        printf("%s: %s %g%s\n", options_.name.c_str(), what, value * scale, unit);
        fflush(stdout);
        return true;
    }
    /// The highest frequency of the drive.
    bool read_limit(int address) {
        Pins &p = *pins_;
        if (!read(address, p.frequency_limit, 0.01)) return false;
        *p.max_rpm = *p.frequency_limit * p.nameplate_rpm / p.nameplate_hz;
        return true;
    }

    PinnedComponent<Pins> pins_;
    Guard guard_;

private:
    static constexpr double SHORTEST_S = 0.001, LONGEST_S = 2;
    static constexpr int STOP_TRIES = 5;

    bool answered(bool good) {
        Pins &p = *pins_;
        if (!good) *p.error_count = *p.error_count + 1;
        guard_.answered(good, link_.connected());
        *p.modbus_ok = guard_.ok();
        if (guard_.lost()) { // nothing is known: it may turn
            *p.at_speed = *p.is_stopped = false;
            rested_ = begun_ = false;
        }
        return good;
    }

    void step() {
        Pins &p = *pins_;
        switch_debug();
        if (!(p.nameplate_hz >= settings_.lowest_hz)) p.nameplate_hz = settings_.motor_hz;
        if (!(p.nameplate_rpm >= settings_.lowest_rpm && p.nameplate_rpm <= settings_.highest_rpm))
            p.nameplate_rpm = settings_.motor_rpm;
        bool wanted = *p.on, enabled = *p.enable;
        bool was_lost = guard_.lost(), good;
        if (enabled) {
            rested_ = false;
            bool run = guard_.may_run(wanted, enabled) && !is_held();
            int hz = hz_hundredths();
            // a stop does not wait; nothing starts at the speed of before
            good = run ? write(frequency_register(), hz) && command(run)
                       : command(run) && write(frequency_register(), hz);
            show(run);
        } else {
            guard_.may_run(wanted, enabled);
            good = rested_ || (rested_ = rest());
        }
        if (was_lost && !good) return; // not one time-out after the other: a drive that is back has to stop at once
        if (!begun_) begun_ = begin();
        if (options_.report && !reported_) reported_ = report();
        good = look(!*p.max_speed || poll_++ % settings_.poll_cycles == 0);
        if (!good || !enabled) *p.at_speed = false;
    }

    int hz_hundredths() {
        Pins &p = *pins_;
        double rpm = std::fabs(*p.speed_command), limit = p.rpm_limit;
        double most = (limit >= 0 ? std::min(rpm, limit) : 0) * p.nameplate_hz / p.nameplate_rpm * 100;
        int value = std::isfinite(rpm) && std::isfinite(most) ? static_cast<int>(std::min(most, 65535.0)) : 0;
        *p.frequency_command = value / 100.0;
        return value;
    }

    void switch_debug() {
        if (toggle_debug.exchange(false)) debug_ = !debug_;
        if (toggle_modbus_debug.exchange(false)) link_.debug(modbus_debug_ = !modbus_debug_);
    }

    void show(bool run) {
        if (debug_ && run != shown_)
            fprintf(stderr, "%s: %s, %g Hz\n", options_.name.c_str(), run ? "runs" : "stops",
                    static_cast<double>(*pins_->frequency_command));
        shown_ = run;
    }

    bool make_all(Pins &p) {
        if (!pins_.bits({{&p.enable, HAL_IN, "enable"},
                         {&p.jog_mode, HAL_IN, "jog-mode"},
                         {&p.on, HAL_IN, "spindle-on"},
                         {&p.max_speed, HAL_IN, "max-speed"},
                         {&p.at_speed, HAL_OUT, "at-speed"},
                         {&p.is_e_stopped, HAL_OUT, "is-e-stopped"},
                         {&p.is_stopped, HAL_OUT, "is-stopped"},
                         {&p.modbus_ok, HAL_OUT, "modbus-ok"}}) ||
            !pins_.floats({{&p.speed_command, HAL_IN, "speed-command"},
                           {&p.frequency_command, HAL_OUT, "frequency-command"},
                           {&p.frequency_out, HAL_OUT, "frequency-out"},
                           {&p.load, HAL_OUT, "inverter-load-percentage"},
                           {&p.max_rpm, HAL_OUT, "max-rpm"},
                           {&p.rpm, HAL_OUT, "motor-RPM"},
                           {&p.frequency_limit, HAL_OUT, "frequency-limit"}}) ||
            !pins_.integers({{&p.status, HAL_OUT, "status"}, {&p.error_count, HAL_OUT, "error-count"}}) ||
            !pins_.parameter(p.loop_time, "loop-time", hal_param_float_newf) ||
            !pins_.parameter(p.nameplate_hz, "nameplate-HZ", hal_param_float_newf) ||
            !pins_.parameter(p.nameplate_rpm, "nameplate-RPM", hal_param_float_newf) ||
            !pins_.parameter(p.rpm_limit, "rpm-limit", hal_param_float_newf) ||
            !pins_.parameter(p.tolerance, "tolerance", hal_param_float_newf) || !more_pins(p))
            return false;
        p.loop_time = 0.1;
        p.nameplate_hz = settings_.motor_hz;
        p.nameplate_rpm = settings_.motor_rpm;
        p.rpm_limit = settings_.rpm_limit;
        p.tolerance = 0.01;
        return true;
    }

    const IniOptions &options_;
    const IniSettings &settings_;
    ModbusLink link_;
    bool debug_, modbus_debug_, rested_ = false, begun_ = false, shown_ = false, reported_ = false;
    int poll_ = 0;
};

} // namespace vfd
