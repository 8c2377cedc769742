// SPDX-License-Identifier: GPL-2.0-or-later
//
// vfs11_vfd.cc - vfs11_vfd: a VF-S11 drive (Toshiba) on a serial line or a TCP connection as HAL pins (libmodbus).
// Source: Modbus sheet, section 6.
#include <cmath>

#include "ini_drive.hh"

namespace vfs11 {

namespace {

// Registers of the drive.
constexpr int COMMAND = 0xFA00, FREQUENCY = 0xFA01, UPPER_LIMIT = 0x0012, FREQUENCY_OUT = 0xFD00, STATUS = 0xFD01,
              TRIP_CODE = 0xFC90, ALARM_CODE = 0xFC91, ESTIMATED = 0xFE16, LOAD = 0xFE27, LOAD_CURRENT = 0xFE03,
              OUTPUT_VOLTAGE = 0xFE05, RATED_CURRENT = 0xFE70, RATED_VOLTAGE = 0xFE71, MODEL = 0xFB05, CPU_1 = 0xFE08,
              CPU_2 = 0xFE73, EEPROM = 0xFE09;

// Bits of COMMAND. Without the priorities the drive listens to its panel.
constexpr int PRIORITY = 0x8000 | 0x4000, FAULT_RESET = 0x2000, EMERGENCY_STOP = 0x1000, RUN = 0x0400,
              REVERSE = 0x0200, JOG = 0x0100, DC_BRAKE = 0x0080, PATTERN_2 = 0x0040, PANEL = 0;

// Bits of STATUS.
constexpr int E_STOPPED = 0x1000, ALARM = 0x0004, TRIPPED = 0x0002;

constexpr double CLEARED_S = 0.05; ///< a signal of HAL has its own value again after the program has cleared it

struct Pins : vfd::IniPins {
    hal_bit_t *pattern, *dc_brake, *err_reset, *estop, *forward, *reverse;
    hal_s32_t *alarm_code, *trip_code;
    hal_float_t *current_load, *output_current, *output_voltage;
};

class Drive : public vfd::IniDrive<Pins> {
public:
    using IniDrive::IniDrive;

private:
    bool more_pins(Pins &p) override {
        bool made = pins_.bits({{&p.pattern, HAL_IN, "acceleration-pattern"},
                                {&p.dc_brake, HAL_IN, "dc-brake"},
                                {&p.err_reset, HAL_IN, "err-reset"},
                                {&p.estop, HAL_IN, "estop"},
                                {&p.forward, HAL_IN, "spindle-fwd"},
                                {&p.reverse, HAL_IN, "spindle-rev"}}) &&
                    pins_.integers({{&p.alarm_code, HAL_OUT, "alarm-code"}, {&p.trip_code, HAL_OUT, "trip-code"}}) &&
                    pins_.floats({{&p.current_load, HAL_OUT, "current-load-percentage"},
                                  {&p.output_current, HAL_OUT, "output-current-percentage"},
                                  {&p.output_voltage, HAL_OUT, "output-voltage-percentage"}});
        if (made) *p.forward = true;
        return made;
    }

    bool begin() override { return read_limit(UPPER_LIMIT); }

    bool report() override {
        return tell("rated current", RATED_CURRENT, 0.1, " A") && tell("rated voltage", RATED_VOLTAGE, 0.1, " V") &&
               tell("model", MODEL, 1, "") && tell("version of CPU 1", CPU_1, 1, "") &&
               tell("version of CPU 2", CPU_2, 1, "") && tell("version of EEPROM", EEPROM, 1, "");
    }

    int frequency_register() const override { return FREQUENCY; }

    bool is_held() override {
        Pins &p = *pins_;
        if (!*p.dc_brake && !*p.estop) return false;
        *p.on = false;
        guard_.disarm(CLEARED_S);
        return true;
    }

    bool command(bool run) override {
        Pins &p = *pins_;
        *p.reverse = !*p.forward;
        bool reset = *p.err_reset, emergency = *p.estop && !run;
        int word = PRIORITY | (*p.forward ? 0 : REVERSE) | (*p.pattern ? PATTERN_2 : 0);
        if (run) word |= *p.jog_mode ? JOG : RUN;
        if (*p.dc_brake) word |= DC_BRAKE;
        if (reset) word |= FAULT_RESET;
        if (emergency) word |= EMERGENCY_STOP;
        if (!write(COMMAND, word)) return false;
        if (reset) *p.err_reset = false;
        if (emergency) *p.estop = false;
        return true;
    }

    bool rest() override { return write(COMMAND, PRIORITY) && write(COMMAND, PANEL); }

    bool look(bool slow) override {
        Pins &p = *pins_;
        if (!read(STATUS, p.status) || !read(FREQUENCY_OUT, p.frequency_out, 0.01)) return false;
        int status = *p.status;
        *p.is_e_stopped = (status & E_STOPPED) != 0;
        *p.is_stopped = *p.frequency_out == 0;
        if (status & (E_STOPPED | TRIPPED)) guard_.disarm(); // a reset does not start it
        bool good = code(status & ALARM, ALARM_CODE, p.alarm_code) && code(status & TRIPPED, TRIP_CODE, p.trip_code);
        double wanted = *p.frequency_command;
        *p.at_speed = *p.on && wanted > 0.01 && std::fabs(1 - *p.frequency_out / wanted) < p.tolerance;
        return good && (!slow || (read(ESTIMATED, p.rpm, p.nameplate_hz / 100) && read(LOAD, p.load, 1) &&
                                  read(LOAD_CURRENT, p.current_load, 0.01) &&
                                  read(OUTPUT_VOLTAGE, p.output_voltage, 0.01)));
    }

    bool code(int there, int address, hal_s32_t *pin) {
        if (there) return read(address, pin);
        *pin = 0;
        return true;
    }
};

bool read_settings(const vfd::IniOptions &options, vfd::IniSettings &s) {
    using Type = vfd::Connection::Type;
    vfd::IniSection ini(options);
    vfd::Connection &c = s.connection;
    if (!ini.good()) return false;
    ini.word<Type>("TYPE", {{"rtu", Type::rtu}, {"tcpserver", Type::tcp_server}, {"tcpclient", Type::tcp_client}},
                   c.type, true);
    ini.common(s);
    ini.number("PORT", 1, 65535, c.port);
    ini.text("TCPDEST", c.host);
    ini.word<std::optional<int>>("SERIAL_MODE", {{"rs232", MODBUS_RTU_RS232}, {"rs485", MODBUS_RTU_RS485}},
                                 c.serial_mode);
    ini.word<std::optional<int>>(
        "RTS_MODE", {{"up", MODBUS_RTU_RTS_UP}, {"down", MODBUS_RTU_RTS_DOWN}, {"none", MODBUS_RTU_RTS_NONE}}, c.rts);
    ini.number("RESPONSE_TIMEOUT", 0.001, 60.0, c.response_s);
    ini.number("BYTE_TIMEOUT", 0.001, 60.0, c.byte_s);
    return ini.good();
}

} // namespace

int run_program(int argc, char **argv) {
    vfd::IniOptions options = {"vfs11_vfd", "VFS11", ""};
    vfd::IniSettings settings;
    int status;
    if (!vfd::parse_ini_options(argc, argv, "Drive VF-S11 of Toshiba (Modbus).", options, status)) return status;
    return read_settings(options, settings) ? Drive(options, settings).run() : 1;
}

} // namespace vfs11

int main(int argc, char **argv) { return vfs11::run_program(argc, argv); }
