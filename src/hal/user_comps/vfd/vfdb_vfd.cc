// SPDX-License-Identifier: GPL-2.0-or-later
//
// vfdb_vfd.cc - vfdb_vfd: a VFD-B drive (Delta) on a serial line as HAL pins (libmodbus).
// Source: Modbus sheet, section 6.
#include <cmath>

#include "ini_drive.hh"

namespace vfdb {

namespace {

// Registers of the drive.
constexpr int COMMAND = 0x2000, FREQUENCY = 0x2001, UPPER_LIMIT = 0x0100, ERROR = 0x2100, STATUS = 0x2101,
              FREQUENCY_OUT = 0x2103, CURRENT = 0x2104, VOLTAGE = 0x2106, TORQUE = 0x210B, SPEED = 0x210C,
              MODEL = 0x0000, RATED_CURRENT = 0x0001, RATED_VOLTAGE = 0x0102, EEPROM = 0x0006;

// Values of COMMAND. PANEL changes nothing: it does not stop a spindle that turns.
constexpr int PANEL = 0, STOP = 1, RUN = 2, JOG = 3, FORWARD = 0x10, REVERSE = 0x20;

constexpr int E_STOPPED = 0x0021; ///< value of STATUS

struct Pins : vfd::IniPins {
    hal_s32_t *error_code;
    hal_float_t *rps, *current, *voltage;
};

class Drive : public vfd::IniDrive<Pins> {
public:
    using IniDrive::IniDrive;

private:
    bool more_pins(Pins &p) override {
        return pins_.integers({{&p.error_code, HAL_OUT, "error-code"}}) &&
               pins_.floats({{&p.rps, HAL_OUT, "motor-RPS"},
                             {&p.current, HAL_OUT, "output-current"},
                             {&p.voltage, HAL_OUT, "output-voltage"}});
    }

    bool begin() override { return read_limit(UPPER_LIMIT); }

    bool report() override {
        return tell("model", MODEL, 1, "") && tell("rated current", RATED_CURRENT, 0.1, " A") &&
               tell("rated voltage", RATED_VOLTAGE, 0.1, " V") && tell("version of EEPROM", EEPROM, 1, "");
    }

    int frequency_register() const override { return FREQUENCY; }

    bool command(bool run) override {
        int turn = !run ? STOP : *pins_->jog_mode ? JOG : RUN;
        return write(COMMAND, turn | (*pins_->speed_command < 0 ? REVERSE : FORWARD));
    }

    bool rest() override { return write(COMMAND, STOP) && write(COMMAND, PANEL); }

    bool look(bool slow) override {
        Pins &p = *pins_;
        if (!read(ERROR, p.error_code) || !read(STATUS, p.status) || !read(FREQUENCY_OUT, p.frequency_out, 0.01) ||
            !read(SPEED, p.rpm, 1))
            return false;
        *p.rps = *p.rpm / 60;
        *p.is_e_stopped = *p.status == E_STOPPED;
        *p.is_stopped = *p.frequency_out == 0;
        if (*p.error_code != 0 || *p.is_e_stopped) guard_.disarm(); // a reset on the panel does not start it
        double wanted = std::fabs(*p.speed_command);
        *p.at_speed = wanted > 0 ? std::fabs(*p.rpm / wanted - 1) <= p.tolerance : *p.rpm == 0;
        return !slow ||
               (read(TORQUE, p.load, 1) && read(CURRENT, p.current, 0.1) && read(VOLTAGE, p.voltage, 0.1));
    }
};

} // namespace

int run_program(int argc, char **argv) {
    vfd::IniOptions options = {"vfdb_vfd", "VFD-B", ""};
    vfd::IniSettings settings;
    int status;
    if (!vfd::parse_ini_options(argc, argv, "Drive VFD-B of Delta (Modbus).", options, status)) return status;
    vfd::IniSection ini(options);
    if (!ini.good()) return 1;
    ini.common(settings);
    settings.lowest_hz = settings.lowest_rpm = 1;
    settings.highest_rpm = 1e6;
    ini.number("MOTOR_HZ", settings.lowest_hz, 1000.0, settings.motor_hz);
    ini.number("MOTOR_RPM", settings.lowest_rpm, settings.highest_rpm, settings.motor_rpm);
    settings.rpm_limit = settings.motor_rpm;
    return ini.good() ? Drive(options, settings).run() : 1;
}

} // namespace vfdb

int main(int argc, char **argv) { return vfdb::run_program(argc, argv); }
