// SPDX-License-Identifier: GPL-2.0-or-later
//
// pi500_vfd.cc - pi500_vfd: PI500 drives (Powtran) on a serial line as HAL pins (libmodbus).
// Source: Modbus sheet, section 7.
#include <algorithm>
#include <cmath>

#include "line_drives.hh"

namespace pi500 {

namespace {

// Registers of the drive.
constexpr int SET_FREQUENCY = 0xF001, DIGITS = 0xF002, COMMAND = 0x2000, STATE = 0x3000, VALUES = 0x1000,
              FAULT = 0x8000;
constexpr int VALUE_COUNT = 8, FREQUENCY = 1, CURRENT = 4; ///< of VALUES
constexpr int RUN = 1, STOP = 6, RESET = 7;                ///< of COMMAND
constexpr int FORWARD = 1, BACKWARDS = 2, STOPPED = 3;     ///< of STATE

class Drive : public vfd::LineDrive {
public:
    using LineDrive::LineDrive;

    bool make() override {
        pins_ = static_cast<vfd::LinePins *>(hal_malloc(sizeof(vfd::LinePins)));
        return pins_ && make_common(*pins_);
    }

private:
    bool read_state() override {
        vfd::LinePins &p = *pins_;
        uint16_t set, digits, state, values[VALUE_COUNT], fault;
        if (!read(SET_FREQUENCY, 1, &set) || !read(DIGITS, 1, &digits) || !read(STATE, 1, &state) ||
            !read(VALUES, VALUE_COUNT, values) || !read(FAULT, 1, &fault))
            return false;
        *p.is_running = state == FORWARD || state == BACKWARDS;
        *p.is_ready = state == STOPPED;
        *p.is_alarm = fault != 0;
        *p.motor_current = values[CURRENT] / 100.0;
        set_ = set;
        scale_ = digits == 2 ? 100 : 10;
        frequency_ = values[FREQUENCY];
        return true;
    }

    /// In the drive's unit. There is no reverse.
    int wanted() const {
        double value = *pins_->commanded_frequency * scale_;
        return std::isfinite(value) ? static_cast<int>(std::lround(std::clamp(value, 0.0, 65535.0))) : 0;
    }

    bool prepare() override {
        int frequency = wanted();
        return set_ == frequency || write(SET_FREQUENCY, frequency);
    }

    bool write_run(bool run) override { return write(COMMAND, run ? RUN : STOP); }
    bool write_reset() override { return write(COMMAND, RESET); }
    bool is_at_speed() const override { return *pins_->is_running && wanted() > 0 && wanted() == frequency_; }

    vfd::LinePins *pins_ = nullptr;
    int set_ = 0, scale_ = 10, frequency_ = 0;
};

} // namespace

} // namespace pi500

int main(int argc, char **argv) { return vfd::run_line_program<pi500::Drive>(argc, argv, "pi500_vfd"); }
