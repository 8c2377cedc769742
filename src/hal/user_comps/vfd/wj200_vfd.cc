// SPDX-License-Identifier: GPL-2.0-or-later
//
// wj200_vfd.cc - wj200_vfd: WJ200 drives (Hitachi) on a serial line as HAL pins (libmodbus).
// Source: Modbus sheet, section 7.
#include <algorithm>
#include <cmath>

#include "line_drives.hh"

namespace wj200 {

namespace {

// Coils to write.
constexpr int RUN = 0, DIRECTION = 1, TRIP = 2, RESET = 3;
// Coils to read: the first, how many, and which of them.
constexpr int STATE = 0x0E, STATES = 11, RUNNING = 0, BACKWARDS = 1, READY = 2, AT_SPEED = 5, ALARM = 9, STOPPED = 0x27;
// Registers. The set frequency is the second of two.
constexpr int SET_FREQUENCY = 1, SET_FREQUENCIES = 2, FREQUENCY = 0x1000, CURRENT = 0x1002, TEMPERATURE = 0x1018;
constexpr int ROTATES_BACKWARDS = 2;

struct Pins : vfd::LinePins {
    hal_bit_t *reverse, *motor_reverse, *is_stopped;
    hal_float_t *motor_frequency;
    // parameter
    hal_float_t frequency_scale; ///< rpm/Hz
};

class Drive : public vfd::LineDrive {
public:
    using LineDrive::LineDrive;

    bool make() override {
        pins_ = static_cast<Pins *>(hal_malloc(sizeof(Pins)));
        if (!pins_ || !make_common(*pins_)) return false;
        Pins &p = *pins_;
        bool made = maker_.bits({{&p.reverse, HAL_IN, "reverse"},
                                 {&p.motor_reverse, HAL_OUT, "motor-reverse"},
                                 {&p.is_stopped, HAL_OUT, "is-stopped"}}) &&
                    maker_.floats({{&p.motor_frequency, HAL_OUT, "motor-frequency"}}) &&
                    maker_.parameter(p.frequency_scale, "frequency-scale", hal_param_float_newf);
        p.frequency_scale = 1;
        return made;
    }

private:
    bool read_state() override {
        Pins &p = *pins_;
        uint8_t state[STATES], stopped;
        uint16_t set[SET_FREQUENCIES], motor[2], temperature, frequency[2];
        if (!read_coils(STATE, STATES, state) || !read_coils(STOPPED, 1, &stopped) ||
            !read(SET_FREQUENCY - 1, SET_FREQUENCIES, set) || !read(CURRENT, 2, motor) ||
            !read(TEMPERATURE, 1, &temperature) || !read(FREQUENCY, 2, frequency))
            return false;
        *p.is_running = state[RUNNING];
        *p.is_ready = state[READY];
        *p.is_alarm = state[ALARM];
        *p.is_stopped = stopped;
        *p.motor_current = motor[0] / 100.0;
        *p.motor_reverse = motor[1] == ROTATES_BACKWARDS;
        *p.heatsink_temp = temperature / 10.0;
        *p.motor_frequency = (static_cast<uint32_t>(frequency[0]) << 16 | frequency[1]) / 100.0;
        backwards_ = state[BACKWARDS];
        at_speed_ = state[AT_SPEED];
        set_ = set[1];
        return true;
    }

    /// 0.01 Hz
    int wanted() const {
        double value = std::fabs(*pins_->commanded_frequency / pins_->frequency_scale) * 100;
        return std::isfinite(value) ? static_cast<int>(std::lround(std::min(value, 65535.0))) : 0;
    }

    bool prepare() override {
        int frequency = wanted();
        bool reverse = *pins_->reverse;
        return (set_ == frequency || write_multiple(SET_FREQUENCY, frequency)) &&
               (backwards_ == reverse || write_coil(DIRECTION, reverse));
    }

    bool write_run(bool run) override { return write_coil(RUN, run); }
    bool write_reset() override { return write_coil(RESET, true); }
    bool trip() override { return write_coil(TRIP, true); }
    void forget() override { *pins_->is_stopped = false; }

    bool is_at_speed() const override {
        Pins &p = *pins_;
        if (*p.reverse != *p.motor_reverse || set_ != wanted()) return false;
        return set_ == 0 ? *p.is_stopped : at_speed_;
    }

    Pins *pins_ = nullptr;
    bool backwards_ = false, at_speed_ = false;
    int set_ = 0;
};

} // namespace

} // namespace wj200

int main(int argc, char **argv) { return vfd::run_line_program<wj200::Drive>(argc, argv, "wj200_vfd"); }
