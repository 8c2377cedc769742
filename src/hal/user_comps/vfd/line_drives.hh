// SPDX-License-Identifier: GPL-2.0-or-later
//
// line_drives.hh - drive programs with one instance of pins for each drive on a serial line (wj200_vfd, pi500_vfd):
// command line, pins and life that they share. Source: Modbus sheet, section 7.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "hal.h"
#include "modbus_link.hh"
#include "spindle_guard.hh"

namespace vfd {

struct LinePins {
    hal_float_t *commanded_frequency, *motor_current, *heatsink_temp;
    hal_bit_t *run, *enable, *is_running, *is_at_speed, *is_ready, *is_alarm, *watchdog_out;
    // parameter
    hal_u32_t slave;
};

/// A drive on the line. Invariants: (1) what it hears first, at the start and after it was lost, is the stop; (2) a
/// fault is reset once for each time that `enable` comes, never by itself.
class LineDrive {
public:
    LineDrive(ModbusLink &link, PinMaker maker) : maker_(std::move(maker)), link_(link) {}
    virtual ~LineDrive() = default;

    /// Pins and parameters. False: HAL has said why.
    virtual bool make() = 0;
    /// One look.
    void step();
    /// At the end: stops. False: the drive did not take it.
    bool rest();
    unsigned slave() const { return slave_; }

protected:
    bool make_common(LinePins &pins);
    /// Reads all that there is to read; sets the pins is_running, is_ready, is_alarm and its own.
    virtual bool read_state() = 0;
    /// Frequency and direction, where the drive has others. True: the drive has what is asked for.
    virtual bool prepare() = 0;
    virtual bool write_run(bool run) = 0;
    virtual bool write_reset() = 0;
    /// Disabled, without a fault.
    virtual bool trip() { return true; }
    virtual bool is_at_speed() const = 0;
    /// The drive does not answer: nothing is known.
    virtual void forget() {}

    bool read(int address, int count, uint16_t *values) {
        return answered(link_.read(number(), address, count, values));
    }
    bool read_coils(int address, int count, uint8_t *values) {
        return answered(link_.read_coils(number(), address, count, values));
    }
    bool write(int address, int value) { return answered(link_.write(number(), address, value)); }
    bool write_coil(int address, bool value) { return answered(link_.write_coil(number(), address, value)); }
    bool write_multiple(int address, int value) { return answered(link_.write_multiple(number(), address, value)); }

    PinMaker maker_;

private:
    using Clock = std::chrono::steady_clock;

    int number() const { return static_cast<int>(slave_); }
    bool answered(bool good) {
        guard_.answered(good, link_.connected());
        return good;
    }
    bool look();
    bool act(bool run, bool enabled);

    ModbusLink &link_;
    LinePins *pins_ = nullptr;
    Guard guard_;
    unsigned slave_ = 0;
    bool may_turn_ = true;   ///< the drive has not taken a stop since it was told to run, or was lost
    bool enabling_ = false;  ///< has been disabled: a fault is reset when it is enabled
    Clock::time_point due_;
};

struct LineOptions {
    std::vector<std::string> names; ///< prefixes of pins
    SerialLine line = {"/dev/ttyS0", 9600, 8, 1, 'N', 1, false};
};

/// count= names= --baud --parity --databits --stopbits --device. False after a message on stderr.
bool parse_line_options(int argc, char **argv, const char *program, LineOptions &options);

using LineDrives = std::vector<std::unique_ptr<LineDrive>>;

/// The life of the program; takes the component out of HAL.
int run_line(int component, const char *program, const LineDrives &drives);

/// All of the program; `Drive` is derived from LineDrive.
template <class Drive> int run_line_program(int argc, char **argv, const char *program) {
    LineOptions options;
    if (!parse_line_options(argc, argv, program, options)) return 1;
    Connection connection;
    connection.line = options.line;
    ModbusLink link(program, connection);
    if (!link.open()) return 1;
    int component = hal_init(program);
    if (component < 0) return 1;
    LineDrives drives;
    for (const std::string &name : options.names) {
        drives.push_back(std::make_unique<Drive>(link, PinMaker(component, name)));
        if (drives.back()->make()) continue;
        hal_exit(component);
        return 1;
    }
    return run_line(component, program, drives);
}

} // namespace vfd
