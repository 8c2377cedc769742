// SPDX-License-Identifier: GPL-2.0-or-later
//
// xhc_hb04.cc - xhc-hb04: a wireless pendant with wheel, buttons and display as HAL pins (libusb).
// Source: sheet of USB drivers, section 8. Without -H the events are printed.
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <set>

#include "hal.h"
#include "hardware_program.hh"
#include "pendant.hh"
#include "xhc_usb.hh"

namespace xhc {

namespace {

constexpr const char *NAME = "xhc-hb04";
constexpr double MAX_WAIT_SECS = 10, SEARCH_S = 1, AFTER_LOSS_S = 5, STILL_S = 0.25;

using Clock = std::chrono::steady_clock;

double since(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }

struct AxisPins {
    hal_float_t *pos_absolute, *pos_relative;
    hal_bit_t *zero, *goto_zero, *half, *enable, *plus, *minus;
};

struct Pins {
    AxisPins axis[4];
    hal_float_t *feed_value, *feed_override, *spindle_rps, *spindle_override;
    hal_bit_t *sleeping, *connected, *require_pendant, *stepsize_up, *stepsize_down, *inch_icon;
    hal_s32_t *stepsize, *counts, *counts_neg;
    hal_bit_t *enable_off, *enable_feed, *enable_spindle;
    hal_float_t *scale, *velocity, *max_velocity, *increment;
    hal_bit_t *button[32];
};

struct Options {
    std::string layout;
    bool hal = false, require = false;
    int sequence = 1;
};

class Program {
public:
    Program(const Options &options, Layout layout)
        : options_(options), layout_(std::move(layout)), buttons_(layout_.buttons),
          steps_(step_sequence(options.sequence)), usb_(NAME, layout_.product, layout_.vendor) {}

    int run() {
        if (options_.hal && !make_pins()) return 1;
        if (options_.hal && !options_.require) hal_ready(component_);
        int status = work();
        if (options_.hal) hal_exit(component_);
        return status;
    }

private:
    int work() {
        auto begin = Clock::now();
        bool ready = !options_.require, sought = false;
        while (!ending) {
            if (!usb_.open()) {
                if (options_.require && since(begin) > MAX_WAIT_SECS) {
                    fprintf(stderr, "xhc-hb04: MAX_WAIT_SECS exceeded, exiting\n");
                    return 1;
                }
                if (!sought) printf("xhc-hb04: waiting for the pendant\n"), fflush(stdout);
                sought = true;
                for (auto look = Clock::now(); !ending && since(look) < SEARCH_S;) {
                    select_step(); // the pins work without a pendant, too
                    pause_s(Usb::WAIT_MS * 1e-3);
                }
                continue;
            }
            sought = false;
            step_ = 0;
            if (options_.hal) {
                *pins_->connected = true;
                if (!ready) hal_ready(component_);
                ready = true;
            } else {
                printf("connected\n"), fflush(stdout);
            }
            serve();
            usb_.close();
            release();
            if (ending) break;
            fprintf(stderr, "xhc-hb04: the pendant is lost\n");
            if (options_.require) return 1;
            pause_s(AFTER_LOSS_S);
        }
        return 0;
    }

    void serve() {
        while (!ending) {
            Report report;
            uint8_t data[Usb::REPORT_MOST];
            int size;
            Usb::Got got = usb_.read(data, size);
            if (got == Usb::Got::lost) return;
            const bool reported = got == Usb::Got::report && parse(data, size, report);
            if (reported) {
                if (options_.hal) take(report);
                else print(report);
            }
            if (!options_.hal) continue;
            wheel(reported ? report.wheel : 0);
            select_step();
            if (const Image bytes = image(shown()); !usb_.show(bytes.data(), bytes.size())) return;
        }
    }

    static void print(const Report &r) {
        printf("button %02x rotary %02x wheel %d%s\n", static_cast<unsigned>(r.button), static_cast<unsigned>(r.rotary),
               r.wheel, r.sleeping ? " sleeping" : "");
        fflush(stdout);
    }

    /// Buttons and the rotary.
    void take(const Report &r) {
        Pins &p = *pins_;
        *p.sleeping = r.sleeping;
        if (!selection(layout_, r.rotary, selected_)) {
            selected_ = Rotary::off;
            if (unknown_rotary_.insert(r.rotary).second) tell_unknown("the rotary", "ROTARY", r.rotary);
        }
        if (r.button && !known(r.button) && unknown_buttons_.insert(r.button).second)
            tell_unknown("a button", "BUTTON", r.button);
        int selected = axis_of(selected_);
        for (size_t n = 0; n < buttons_.size(); n++) *p.button[n] = r.button == buttons_[n].code;
        for (int n = 0; n < 4; n++) {
            AxisPins &a = p.axis[n];
            *a.enable = n == selected;
            if (n != selected) *a.plus = *a.minus = false;
            if (a.zero) *a.zero = n == selected && pressed(r, "button-zero");
            if (a.goto_zero) *a.goto_zero = n == selected && pressed(r, "button-goto-zero");
            if (a.half) *a.half = n == selected && pressed(r, "button-half");
        }
        *p.enable_off = selected_ == Rotary::off;
        *p.enable_feed = selected_ == Rotary::feed;
        *p.enable_spindle = selected_ == Rotary::spindle;
    }

    static void tell_unknown(const char *what, const char *key, int code) {
        fprintf(stderr,
                "xhc-hb04: %s has the unknown code %02X: a line %s = %02X:NAME of the layout gives it a meaning\n",
                what, static_cast<unsigned>(code), key, static_cast<unsigned>(code));
    }

    bool known(int code) const {
        for (const Button &b : buttons_)
            if (b.code == code) return true;
        return buttons_.empty(); // without a layout none is expected
    }

    bool pressed(const Report &r, const char *name) const {
        for (const Button &b : buttons_)
            if (b.code == r.button && b.name == name) return true;
        return false;
    }

    bool has(const char *name) const {
        for (const Button &b : buttons_)
            if (b.name == name) return true;
        return false;
    }

    /// Counts, velocity and directions of the wheel, once a loop.
    void wheel(int delta) {
        Pins &p = *pins_;
        if (delta != 0) {
            turned_ = Clock::now();
            counts_ = counted(counts_, delta);
            *p.counts = counts_;
            *p.counts_neg = static_cast<int32_t>(-static_cast<uint32_t>(counts_));
            *p.increment = std::fabs(delta * *p.scale);
            *p.velocity = 0.95 * *p.velocity + 0.05 * *p.max_velocity * 60 * *p.scale;
            int selected = axis_of(selected_);
            if (selected != NO_AXIS) {
                *p.axis[selected].plus = delta > 0;
                *p.axis[selected].minus = delta < 0;
            }
        } else if (since(turned_) > STILL_S) {
            *p.velocity = 0;
            for (AxisPins &a : p.axis) *a.plus = *a.minus = false;
        } else {
            *p.velocity = 0.95 * *p.velocity;
        }
    }

    void select_step() {
        if (!options_.hal) return;
        Pins &p = *pins_;
        bool up = *p.stepsize_up && !was_up_, down = *p.stepsize_down && !was_down_;
        was_up_ = *p.stepsize_up;
        was_down_ = *p.stepsize_down;
        if (!(was_up_ && was_down_)) {
            if (up) step_ = (step_ + 1) % steps_.size();
            if (down) step_ = (step_ + steps_.size() - 1) % steps_.size();
        }
        *p.stepsize = steps_[step_];
        *p.scale = steps_[step_] * 0.001;
    }

    Shown shown() const {
        const Pins &p = *pins_;
        Shown s;
        for (size_t n = 0; n < 3; n++) {
            size_t from = n == 0 && selected_ == Rotary::a ? 3 : n;
            s.relative[n] = *p.axis[from].pos_relative;
            s.absolute[n] = *p.axis[from].pos_absolute;
        }
        s.feed_override_percent = *p.feed_override * 100;
        s.spindle_override_percent = *p.spindle_override * 100;
        s.feed = *p.feed_value * 60;
        s.spindle = *p.spindle_rps * 60;
        s.step = steps_[step_];
        s.inch = *p.inch_icon;
        return s;
    }

    /// Without a pendant nothing is pressed, selected or moving.
    void release() {
        if (!options_.hal) return;
        take(Report{});
        *pins_->enable_off = false;
        *pins_->sleeping = false;
        *pins_->connected = false;
        *pins_->velocity = 0;
        for (AxisPins &a : pins_->axis) *a.plus = *a.minus = false;
    }

    template <class T>
    bool pin(T *&at, hal_pin_dir_t dir, const std::string &name,
             int (*make)(hal_pin_dir_t, T **, int, const char *, ...)) {
        return make(dir, &at, component_, "xhc-hb04.%s", name.c_str()) == 0;
    }

    bool make_pins() {
        component_ = hal_init(NAME);
        if (component_ < 0) return false;
        pins_ = static_cast<Pins *>(hal_malloc(sizeof(Pins)));
        if (pins_ && pins_of_axes() && other_pins()) {
            *pins_->require_pendant = options_.require;
            select_step();
            return true;
        }
        hal_exit(component_);
        return false;
    }

    bool pins_of_axes() {
        for (int n = 0; n < 4; n++) {
            AxisPins &a = pins_->axis[n];
            const std::string letter(1, AXES[n]);
            bool good = pin(a.pos_absolute, HAL_IN, letter + ".pos-absolute", hal_pin_float_newf) &&
                        pin(a.pos_relative, HAL_IN, letter + ".pos-relative", hal_pin_float_newf) &&
                        pin(a.enable, HAL_OUT, "jog.enable-" + letter, hal_pin_bit_newf) &&
                        pin(a.plus, HAL_OUT, "jog.plus-" + letter, hal_pin_bit_newf) &&
                        pin(a.minus, HAL_OUT, "jog.minus-" + letter, hal_pin_bit_newf) &&
                        (!has("button-zero") || pin(a.zero, HAL_OUT, "button-zero-" + letter, hal_pin_bit_newf)) &&
                        (!has("button-goto-zero") ||
                         pin(a.goto_zero, HAL_OUT, "button-goto-zero-" + letter, hal_pin_bit_newf)) &&
                        (!has("button-half") || pin(a.half, HAL_OUT, "button-half-" + letter, hal_pin_bit_newf));
            if (!good) return false;
        }
        return true;
    }

    bool other_pins() {
        Pins &p = *pins_;
        for (size_t n = 0; n < buttons_.size(); n++)
            if (!pin(p.button[n], HAL_OUT, buttons_[n].name, hal_pin_bit_newf)) return false;
        return pin(p.feed_value, HAL_IN, "feed-value", hal_pin_float_newf) &&
               pin(p.feed_override, HAL_IN, "feed-override", hal_pin_float_newf) &&
               pin(p.spindle_rps, HAL_IN, "spindle-rps", hal_pin_float_newf) &&
               pin(p.spindle_override, HAL_IN, "spindle-override", hal_pin_float_newf) &&
               pin(p.sleeping, HAL_OUT, "sleeping", hal_pin_bit_newf) &&
               pin(p.connected, HAL_OUT, "connected", hal_pin_bit_newf) &&
               pin(p.require_pendant, HAL_OUT, "require_pendant", hal_pin_bit_newf) &&
               pin(p.stepsize_up, HAL_IN, "stepsize-up", hal_pin_bit_newf) &&
               pin(p.stepsize_down, HAL_IN, "stepsize-down", hal_pin_bit_newf) &&
               pin(p.inch_icon, HAL_IN, "inch-icon", hal_pin_bit_newf) &&
               pin(p.stepsize, HAL_OUT, "stepsize", hal_pin_s32_newf) &&
               pin(p.counts, HAL_OUT, "jog.counts", hal_pin_s32_newf) &&
               pin(p.counts_neg, HAL_OUT, "jog.counts-neg", hal_pin_s32_newf) &&
               pin(p.enable_off, HAL_OUT, "jog.enable-off", hal_pin_bit_newf) &&
               pin(p.enable_feed, HAL_OUT, "jog.enable-feed-override", hal_pin_bit_newf) &&
               pin(p.enable_spindle, HAL_OUT, "jog.enable-spindle-override", hal_pin_bit_newf) &&
               pin(p.scale, HAL_OUT, "jog.scale", hal_pin_float_newf) &&
               pin(p.velocity, HAL_OUT, "jog.velocity", hal_pin_float_newf) &&
               pin(p.max_velocity, HAL_IN, "jog.max-velocity", hal_pin_float_newf) &&
               pin(p.increment, HAL_OUT, "jog.increment", hal_pin_float_newf);
    }

    const Options &options_;
    const Layout layout_;
    const std::vector<Button> &buttons_;
    std::set<int> unknown_buttons_, unknown_rotary_; // codes that were told
    Rotary selected_ = Rotary::off;
    std::vector<int> steps_;
    size_t step_ = 0;
    bool was_up_ = false, was_down_ = false;
    int32_t counts_ = 0;
    Clock::time_point turned_{};
    Usb usb_;
    int component_ = -1;
    Pins *pins_ = nullptr;
};

void usage(FILE *out) {
    fprintf(out, "xhc-hb04 [-h] [-I LAYOUT] [-H] [-x] [-s SEQUENCE]\n"
                 "  -I file  layout of the buttons: section [XHC-HB04], lines BUTTON=CODE:NAME\n"
                 "  -H       HAL pins; without it events are printed\n"
                 "  -x       needs the pendant: not ready before it is found, ends when it is lost\n"
                 "  -s n     step sizes in 0.001 units: 1: 1,10,100,1000  2: 1,5,10,20  3: 1,10,100  4: "
                 "1,5,10,20,50,100  5: 1,10,50,100,1000\n");
}

} // namespace

int run_program(int argc, char **argv) {
    Options options;
    for (int c; (c = getopt(argc, argv, "hI:Hxs:")) != -1;) {
        switch (c) {
        case 'h': usage(stdout); return 0;
        case 'I': options.layout = optarg; break;
        case 'H': options.hal = true; break;
        case 'x': options.require = true; break;
        case 's': options.sequence = atoi(optarg); break;
        default: usage(stderr); return 1;
        }
    }
    if (optind < argc || step_sequence(options.sequence).empty()) {
        usage(stderr);
        return 1;
    }
    Layout layout;
    if (!options.layout.empty() && !read_layout(options.layout, layout)) return 1;
    begin_hardware_program(NAME);
    return Program(options, std::move(layout)).run();
}

} // namespace xhc

int main(int argc, char **argv) { return xhc::run_program(argc, argv); }
