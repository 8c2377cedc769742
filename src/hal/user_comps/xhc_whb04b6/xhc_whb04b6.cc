// SPDX-License-Identifier: GPL-2.0-or-later
//
// xhc_whb04b6.cc - xhc-whb04b-6: a wireless pendant for six axes with wheel, keys and display as HAL pins (libusb).
// Source: sheet of USB drivers, section 9. Without -H the events are printed.
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <string>

#include "hal.h"
#include "hardware_program.hh"
#include "pendant.hh"
#include "xhc_usb.hh"

namespace xhc {

namespace {

constexpr const char *NAME = "xhc-whb04b-6";
constexpr uint16_t PRODUCT = 0xEB93;
constexpr double SEARCH_S = 0.3, MAX_WAIT_S = 3;
constexpr double MODE_EDGE_S = 0.010, POLL_S = 0.005;
constexpr int MODE_POLLS = 60, PULSE_POLLS = 100;
constexpr double KEY_SCALE = 0.05, WHEEL_SCALE = 0.01; ///< of overrides, for each step of a key or the wheel
constexpr double OF_MAX_VELOCITY = 0.0001;             ///< jog scale for each percent while the wheel is continuous

constexpr double REST_S = 0.25;                        ///< the wheel stands

using Clock = std::chrono::steady_clock;

double since(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }

struct AxisPins {
    hal_s32_t *counts;
    hal_bit_t *enable, *velocity_mode, *select, *homed;
    hal_float_t *scale, *feedback, *relative;
};

struct Mode {
    hal_bit_t *request, *is;
};

struct OnOff {
    hal_bit_t *on, *off, *is_on;
};

struct Override {
    hal_float_t *scale, *value;
    hal_bit_t *increase, *decrease;
};

struct Pins {
    AxisPins axis[AXIS_COUNT];
    hal_bit_t *key[KEYS.size()], *key_with_fn[KEYS.size()];
    hal_bit_t *feed_selected[FEEDS.size()], *mpg_selected, *continuous_selected, *step_selected;
    hal_bit_t *sleeping, *connected;
    OnOff machine, flood, mist;
    Override feed_override, spindle_override;
    hal_float_t *max_velocity, *spindle_speed;
    hal_bit_t *spindle_is_on, *spindle_increase, *spindle_decrease, *spindle_start, *spindle_stop, *spindle_forward,
        *spindle_reverse;
    hal_bit_t *is_idle, *is_paused, *is_running, *resume, *pause, *run, *stop;
    Mode automatic, joint, manual, mdi, teleop;
};

struct Options {
    uint16_t product = PRODUCT;
    bool hal = false, limited_wait = false, large_steps = false;
    bool wheel_is_spindle = false, wheel_is_feed = false; ///< in the place Lead; while the wheel is MPG
    bool received = false, sent = false, requests = false, events = false, checksums = false, silent = false;
};

class Program {
public:
    explicit Program(const Options &options) : options_(options), usb_(NAME, options.product) {}

    int run() {
        if (options_.hal && !make_pins()) return 1;
        if (!options_.limited_wait) set_ready();
        int status = work();
        if (options_.hal) hal_exit(component_);
        return status;
    }

private:
    // ---- The pendant comes and goes ----

    int work() {
        const auto begin = Clock::now();
        bool told = options_.silent;
        while (!ending) {
            if (!usb_.open()) {
                if (!ready_ && since(begin) > MAX_WAIT_S) {
                    fprintf(stderr, "%s: no pendant (USB 10ce:%04x) within %g s\n", NAME, options_.product, MAX_WAIT_S);
                    return 1;
                }
                if (!told) printf("%s: waiting for the pendant\n", NAME), fflush(stdout);
                told = true;
                pause_s(SEARCH_S);
                continue;
            }
            told = options_.silent;
            set_ready();
            if (options_.hal) *pins_->connected = true;
            event("connected");
            serve();
            usb_.close();
            release();
            if (!ending) fprintf(stderr, "%s: the pendant is lost\n", NAME);
        }
        return 0;
    }

    void set_ready() {
        if (options_.hal && !ready_) hal_ready(component_);
        ready_ = true;
    }

    void serve() {
        while (!ending) {
            uint8_t data[Usb::REPORT_MOST];
            int size;
            Usb::Got got = usb_.read(data, size);
            if (got == Usb::Got::lost) return;
            Report report;
            if (got == Usb::Got::report && parse(data, size, report)) {
                if (options_.received) print_bytes("received", data, static_cast<size_t>(size));
                if (options_.checksums) printf("checksum %02x of random %02x\n", data[7], data[1]), fflush(stdout);
                if (drop_next_) drop_next_ = false;
                else take(report);
            }
            if (!options_.hal) continue;
            set_jog();
            if (since(nudged_at_) > REST_S) lower_nudged();
            const Image bytes = image(shown());
            if (options_.sent) print_bytes("sent", bytes.data(), bytes.size());
            if (!usb_.show(bytes.data(), bytes.size())) return;
        }
    }

    /// Without a pendant nothing is pressed, selected or moving.
    void release() {
        rest();
        feed(NO_FEED);
        drop_next_ = false;
        if (!options_.hal) return;
        *pins_->connected = *pins_->sleeping = false;
        set_jog();
    }

    /// Nothing is pressed and no axis selected.
    void rest() {
        press({});
        axis(NO_AXIS);
        if (!options_.hal) return;
        lower_nudged();
    }

    static void print_bytes(const char *what, const uint8_t *bytes, size_t size) {
        printf("%s", what);
        for (size_t n = 0; n < size; n++) printf(" %02x", bytes[n]);
        printf("\n"), fflush(stdout);
    }

    void event(const char *what, const std::string &which = "") const {
        if (options_.silent || (options_.hal && !options_.events)) return;
        printf("event %s%s%s\n", what, which.empty() ? "" : " ", which.c_str()), fflush(stdout);
    }

    /// Once for each code that stands in no table.
    void tell_unknown(const char *what, uint8_t code) {
        if (code && unknown_.insert({what, code}).second)
            fprintf(stderr, "%s: unknown %s %02x is without effect\n", NAME, what, code);
    }

    // ---- Reports ----

    void take(const Report &r) {
        if (options_.hal) *pins_->sleeping = r.empty;
        if (r.empty) {
            event("sleeps");
            drop_next_ = true;
            rest();
            feed(NO_FEED);
            return;
        }
        tell_unknown("key", r.unknown_key);
        tell_unknown("axis position", r.unknown_axis);
        tell_unknown("feed position", r.unknown_feed);
        // Clicks that come with another axis or step may have been meant for the one before.
        const bool same = r.axis == axis_ && r.feed == feed_;
        axis(r.axis);
        feed(r.feed);
        press(r.pressed);
        if (same && r.wheel) turn(r.wheel);
    }

    void axis(int selected) {
        if (selected == axis_) return;
        axis_ = selected;
        event("axis", selected == NO_AXIS ? "off" : std::string(1, AXES[selected]));
        if (selected != NO_AXIS) shown_group_ = selected / 3 * 3;
        if (!options_.hal) return;
        for (int n = 0; n < AXIS_COUNT; n++) *pins_->axis[n].select = *pins_->axis[n].enable = n == selected;
    }

    void feed(int selected) {
        if (selected == feed_) return;
        feed_ = selected;
        event("feed", selected == NO_FEED ? "off" : FEEDS[static_cast<size_t>(selected)].name);
        if (options_.hal)
            for (size_t n = 0; n < FEEDS.size(); n++) *pins_->feed_selected[n] = static_cast<int>(n) == selected;
        wheel(selected == LEAD ? Wheel::mpg : wheel_);
    }

    void wheel(Wheel mode) {
        wheel_ = mode;
        if (!options_.hal) return;
        *pins_->feed_override.scale = 0;
        *pins_->mpg_selected = mode == Wheel::mpg;
        *pins_->continuous_selected = mode == Wheel::continuous;
        *pins_->step_selected = mode == Wheel::step;
    }

    void press(const Pressed &now) {
        if (!(now != pressed_)) return;
        const Pressed before = pressed_;
        pressed_ = now;
        if (before.index != NO_KEY) key(before, false);
        if (now.index != NO_KEY) key(now, true);
    }

    void key(const Pressed &p, bool down) {
        const size_t n = static_cast<size_t>(p.index);
        const KeyNames &names = KEYS[n];
        event(down ? "pressed" : "released", p.fn ? names.with_fn : names.plain);
        if (names.key == KEY_CONTINUOUS && !p.fn && down) wheel(Wheel::continuous);
        if (names.key == KEY_STEP && !p.fn && down) wheel(Wheel::step);
        if (!options_.hal) return;
        if (p.fn) macro(names.key, down);
        else if (!plain(names.key, down)) return;
        *(p.fn ? pins_->key_with_fn : pins_->key)[n] = down;
    }

    /// What a key does beside its pin. False: the pin stays FALSE, since the mode that it needs is refused.
    bool plain(Key key, bool down) {
        Pins &p = *pins_;
        switch (key) {
        case KEY_RESET: toggle(p.machine, down); break;
        case KEY_STOP: *p.stop = down; break;
        case KEY_START_PAUSE: return !down || start_or_pause();
        case KEY_FEED_PLUS: step(p.feed_override, p.feed_override.increase, down); break;
        case KEY_FEED_MINUS: step(p.feed_override, p.feed_override.decrease, down); break;
        case KEY_SPINDLE_PLUS: step(p.spindle_override, p.spindle_override.increase, down); break;
        case KEY_SPINDLE_MINUS: step(p.spindle_override, p.spindle_override.decrease, down); break;
        case KEY_M_HOME: return !down || request(p.joint);
        case KEY_SAFE_Z:
        case KEY_W_HOME:
        case KEY_PROBE_Z: return !down || request(p.mdi);
        case KEY_S_ON_OFF: spindle(down); break;
        case KEY_MACRO_10:
            if (down) relative_ = !relative_;
            break;
        default: break;
        }
        return true;
    }

    void macro(Key key, bool down) {
        Pins &p = *pins_;
        switch (key) {
        case KEY_SPINDLE_PLUS: *p.spindle_increase = down && *p.spindle_is_on; break;
        case KEY_SPINDLE_MINUS: *p.spindle_decrease = down && *p.spindle_is_on; break;
        case KEY_S_ON_OFF:
            if (down) reverse_ = !reverse_;
            turn_spindle(down && *p.spindle_is_on);
            break;
        case KEY_CONTINUOUS: toggle(p.flood, down); break;
        case KEY_STEP: toggle(p.mist, down); break;
        default: break;
        }
    }

    // ---- What the keys and the wheel ask for ----

    /// While the key is held: the other state than the one that is.
    static void toggle(OnOff &what, bool down) {
        const bool is_on = *what.is_on;
        *what.on = down && !is_on;
        *what.off = down && is_on;
    }

    void step(Override &what, hal_bit_t *direction, bool down) {
        lower_nudged();
        if (down) *what.scale = KEY_SCALE;
        *direction = down;
    }

    void turn_spindle(bool on) {
        *pins_->spindle_forward = on && !reverse_;
        *pins_->spindle_reverse = on && reverse_;
        *pins_->spindle_increase = on;
    }

    void spindle(bool down) {
        const bool is_on = *pins_->spindle_is_on;
        *pins_->spindle_stop = down && is_on;
        *pins_->spindle_start = down && !is_on;
        turn_spindle(down && !is_on);
    }

    /// True in the mode; otherwise asks for it and waits.
    bool request(const Mode &mode) {
        if (*mode.is) return true;
        *mode.request = true;
        pause_s(MODE_EDGE_S);
        const bool reached = wait_for(MODE_POLLS, [&mode] { return bool(*mode.is); });
        *mode.request = false;
        pause_s(MODE_EDGE_S);
        if (!reached && !options_.silent)
            printf("hal   failed to wait for requested mode. waited %.0fms\n", MODE_POLLS * POLL_S * 1e3);
        else if (options_.requests) printf("hal   mode reached\n");
        fflush(stdout);
        return reached;
    }

    template <class Condition>
    static bool wait_for(int polls, Condition reached) {
        for (int n = 0; n < polls && !ending && !reached(); n++) pause_s(POLL_S);
        return reached();
    }

    template <class Condition>
    void pulse(hal_bit_t *pin, const char *name, Condition reached) {
        if (options_.requests) printf("hal   %s\n", name), fflush(stdout);
        *pin = true;
        wait_for(PULSE_POLLS, reached);
        *pin = false;
    }

    bool start_or_pause() {
        Pins &p = *pins_;
        if (!request(p.automatic)) return false;
        if (*p.is_paused) pulse(p.resume, "resume", [&p] { return !*p.is_paused; });
        else if (*p.is_running) pulse(p.pause, "pause", [&p] { return bool(*p.is_paused) || !*p.is_running; });
        else if (*p.is_idle) pulse(p.run, "run", [&p] { return !*p.is_idle; });
        return true;
    }

    /// A program is not stopped by the wheel. A joint that is homed moves with its axis, unless others are not homed.
    bool ready_to_jog() {
        Pins &p = *pins_;
        if (!*p.manual.is && (!*p.is_idle || !request(p.manual))) return false;
        unsigned homed = 0;
        for (int n = 0; n < AXIS_COUNT; n++) homed |= (*p.axis[n].homed ? 1U : 0U) << n;
        if (homed >> axis_ & 1 && homed != refused_teleop_) refused_teleop_ = request(p.teleop) ? 0 : homed;
        return true;
    }

    void turn(int clicks) {
        event("wheel", std::to_string(clicks));
        if (!options_.hal || !*pins_->machine.is_on) return;
        if (feed_ == LEAD) {
            if (options_.wheel_is_spindle) nudge(pins_->spindle_override, clicks);
        } else if (wheel_ == Wheel::mpg && options_.wheel_is_feed) {
            nudge(pins_->feed_override, clicks);
        } else if (axis_ != NO_AXIS && feed_ != NO_FEED && ready_to_jog()) {
            hal_s32_t *counts = pins_->axis[axis_].counts;
            *counts = counted(*counts, clicks);
        }
    }

    /// One move of the wheel raises the pin, the next one, or a rest, lowers it.
    void nudge(Override &what, int clicks) {
        hal_bit_t *now = clicks > 0 ? what.increase : what.decrease, *other = clicks > 0 ? what.decrease : what.increase;
        *what.scale = WHEEL_SCALE;
        *other = false;
        *now = !*now;
        nudged_ = &what;
        nudged_at_ = Clock::now();
    }

    void lower_nudged() {
        if (nudged_) *nudged_->increase = *nudged_->decrease = false;
        nudged_ = nullptr;
    }

    /// What a click of the wheel is worth. MPG and Lead move nothing.
    void set_jog() {
        double scale = 0;
        if (feed_ != NO_FEED && feed_ != LEAD) {
            const Feed &f = FEEDS[static_cast<size_t>(feed_)];
            if (wheel_ == Wheel::step) scale = options_.large_steps ? f.large_step : f.step;
            if (wheel_ == Wheel::continuous) scale = f.percent * OF_MAX_VELOCITY * *pins_->max_velocity;
            if (!std::isfinite(scale)) scale = 0;
        }
        for (AxisPins &a : pins_->axis) {
            *a.scale = scale;
            *a.velocity_mode = wheel_ == Wheel::continuous && feed_ != LEAD && feed_ != NO_FEED;
        }
    }

    Shown shown() const {
        const Pins &p = *pins_;
        Shown s;
        s.wheel = wheel_;
        s.machine_off = !*p.machine.is_on;
        s.relative = relative_;
        for (size_t n = 0; n < s.position.size(); n++) {
            const AxisPins &a = p.axis[static_cast<size_t>(shown_group_) + n];
            s.position[n] = relative_ ? *a.relative : *a.feedback;
        }
        s.feed_override_percent = *p.feed_override.value * 100;
        s.spindle =
            *p.spindle_increase || *p.spindle_decrease ? *p.spindle_speed : *p.spindle_override.value * 100;
        return s;
    }

    // ---- Pins ----

    bool make_pins() {
        component_ = hal_init(NAME);
        if (component_ < 0) return false;
        pins_ = static_cast<Pins *>(hal_malloc(sizeof(Pins)));
        if (pins_ && pins_of_keys() && pins_of_axes() && pins_of_feed() && pins_of_spindle() && pins_of_machine()) {
            wheel(wheel_);
            return true;
        }
        hal_exit(component_);
        return false;
    }

    template <class T>
    bool pin(T *&at, hal_pin_dir_t dir, const std::string &name,
             int (*make)(hal_pin_dir_t, T **, int, const char *, ...)) {
        return make(dir, &at, component_, "whb.%s", name.c_str()) == 0;
    }
    bool in(hal_bit_t *&at, const std::string &name) { return pin(at, HAL_IN, "halui." + name, hal_pin_bit_newf); }
    bool in(hal_float_t *&at, const std::string &name) {
        return pin(at, HAL_IN, "halui." + name, hal_pin_float_newf);
    }
    bool out(hal_bit_t *&at, const std::string &name) { return pin(at, HAL_OUT, "halui." + name, hal_pin_bit_newf); }
    bool out(hal_float_t *&at, const std::string &name) {
        return pin(at, HAL_OUT, "halui." + name, hal_pin_float_newf);
    }

    bool pins_of_keys() {
        for (size_t n = 0; n < KEYS.size(); n++) {
            const KeyNames &k = KEYS[n];
            if (!pin(pins_->key[n], HAL_OUT, std::string("button.") + k.plain, hal_pin_bit_newf)) return false;
            if (k.with_fn &&
                !pin(pins_->key_with_fn[n], HAL_OUT, std::string("button.") + k.with_fn, hal_pin_bit_newf))
                return false;
        }
        return pin(pins_->sleeping, HAL_OUT, "pendant.is-sleeping", hal_pin_bit_newf) &&
               pin(pins_->connected, HAL_OUT, "pendant.is-connected", hal_pin_bit_newf);
    }

    bool pins_of_axes() {
        for (int n = 0; n < AXIS_COUNT; n++) {
            AxisPins &a = pins_->axis[n];
            const std::string axis = std::string("axis.") + AXES[n];
            bool good = pin(a.counts, HAL_OUT, axis + ".jog-counts", hal_pin_s32_newf) &&
                        pin(a.enable, HAL_OUT, axis + ".jog-enable", hal_pin_bit_newf) &&
                        pin(a.velocity_mode, HAL_OUT, axis + ".jog-vel-mode", hal_pin_bit_newf) &&
                        pin(a.scale, HAL_OUT, axis + ".jog-scale", hal_pin_float_newf) &&
                        in(a.feedback, axis + ".pos-feedback") && in(a.relative, axis + ".pos-relative") &&
                        out(a.select, axis + ".select") && in(a.homed, std::string("joint.") + AXES[n] + ".is-homed");
            if (!good) return false;
        }
        return true;
    }

    bool pins_of_override(Override &o, const std::string &name) {
        return out(o.scale, name + ".scale") && in(o.value, name + ".value") && out(o.increase, name + ".increase") &&
               out(o.decrease, name + ".decrease");
    }

    bool pins_of_feed() {
        Pins &p = *pins_;
        for (size_t n = 0; n < FEEDS.size(); n++)
            if (!out(p.feed_selected[n], std::string("feed.selected-") + FEEDS[n].name)) return false;
        return out(p.mpg_selected, "feed.selected-mpg-feed") &&
               out(p.continuous_selected, "feed.selected-continuous") && out(p.step_selected, "feed.selected-step") &&
               pins_of_override(p.feed_override, "feed-override") && in(p.max_velocity, "max-velocity.value");
    }

    bool pins_of_spindle() {
        Pins &p = *pins_;
        return in(p.spindle_speed, "spindle-speed-cmd") && pins_of_override(p.spindle_override, "spindle-override") &&
               in(p.spindle_is_on, "spindle.is-on") && out(p.spindle_increase, "spindle.increase") &&
               out(p.spindle_decrease, "spindle.decrease") && out(p.spindle_start, "spindle.start") &&
               out(p.spindle_stop, "spindle.stop") && out(p.spindle_forward, "spindle.forward") &&
               out(p.spindle_reverse, "spindle.reverse");
    }

    bool pins_of_switch(OnOff &o, const std::string &name) {
        return in(o.is_on, name + ".is-on") && out(o.on, name + ".on") && out(o.off, name + ".off");
    }

    bool pins_of_mode(Mode &m, const std::string &name) {
        return in(m.is, "mode.is-" + name) && out(m.request, "mode." + name);
    }

    bool pins_of_machine() {
        Pins &p = *pins_;
        return pins_of_switch(p.machine, "machine") && pins_of_switch(p.flood, "flood") &&
               pins_of_switch(p.mist, "mist") && in(p.is_idle, "program.is-idle") &&
               in(p.is_paused, "program.is-paused") && in(p.is_running, "program.is-running") &&
               out(p.resume, "program.resume") && out(p.pause, "program.pause") && out(p.run, "program.run") &&
               out(p.stop, "program.stop") && pins_of_mode(p.automatic, "auto") && pins_of_mode(p.joint, "joint") &&
               pins_of_mode(p.manual, "manual") && pins_of_mode(p.mdi, "mdi") && pins_of_mode(p.teleop, "teleop");
    }

    const Options &options_;
    Usb usb_;
    int component_ = -1;
    Pins *pins_ = nullptr;
    bool ready_ = false;
    bool drop_next_ = false; ///< the report after the one with which the pendant went to sleep
    Pressed pressed_;
    Override *nudged_ = nullptr; ///< by the wheel, at that time
    Clock::time_point nudged_at_{};
    int axis_ = NO_AXIS, feed_ = NO_FEED;
    Wheel wheel_ = Wheel::mpg;
    int shown_group_ = 0;    ///< first of the three axes on the display
    bool relative_ = true;   ///< the display's positions
    bool reverse_ = false;   ///< direction of the spindle's next start
    unsigned refused_teleop_ = 0; ///< joints that were homed then, a bit each: asked again when others are
    std::set<std::pair<std::string, uint8_t>> unknown_;
};

void usage(FILE *out) {
    fputs("xhc-whb04b-6 [-h] [-H] [-s] [-f] [-B] [-t] [-u] [-U] [-p] [-e] [-a] [-c] [-n] [-P PRODUCT]\n"
          "  -H      HAL pins; without it events are printed\n"
          "  -s      in the position Lead the wheel changes the spindle override\n"
          "  -f      while the wheel is MPG it changes the feed override\n"
          "  -B      the steps of the positions 60% and 100% are 5 and 10 units, not 1\n"
          "  -t      not ready before the pendant is found; ends after 3 s without it\n"
          "  -u, -U  print what is received; and what is sent\n"
          "  -p, -e  print requests to HAL; events\n"
          "  -c      prints checksums\n"
          "  -a      prints all that\n"
          "  -n      prints errors alone\n"
          "  -P hex  USB product of the receiver (eb93)\n",
          out);
}

/// False when it is no USB product.
bool read_product(const char *text, uint16_t &product) {
    char *end;
    unsigned long value = strtoul(text, &end, 16);
    if (end == text || *end || value == 0 || value > 0xFFFF) {
        fprintf(stderr, "%s: -P %s: must be a hexadecimal number from 1 to ffff\n", NAME, text);
        return false;
    }
    product = static_cast<uint16_t>(value);
    return true;
}

} // namespace

int run_program(int argc, char **argv) {
    Options options;
    for (int c; (c = getopt(argc, argv, "hHsfBtuUpeacnP:")) != -1;) {
        switch (c) {
        case 'h': usage(stdout); return 0;
        case 'H': options.hal = true; break;
        case 's': options.wheel_is_spindle = true; break;
        case 'f': options.wheel_is_feed = true; break;
        case 'B': options.large_steps = true; break;
        case 't': options.limited_wait = true; break;
        case 'U': options.sent = true; [[fallthrough]];
        case 'u': options.received = true; break;
        case 'p': options.requests = true; break;
        case 'e': options.events = true; break;
        case 'c': options.checksums = true; break;
        case 'a': options.received = options.sent = options.requests = options.events = options.checksums = true; break;
        case 'n': options.silent = true; break;
        case 'P':
            if (!read_product(optarg, options.product)) return 1;
            break;
        default: usage(stderr); return 1;
        }
    }
    if (optind < argc) {
        usage(stderr);
        return 1;
    }
    begin_hardware_program(NAME);
    return Program(options).run();
}

} // namespace xhc

int main(int argc, char **argv) { return xhc::run_program(argc, argv); }
