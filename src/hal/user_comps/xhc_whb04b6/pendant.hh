// SPDX-License-Identifier: GPL-2.0-or-later
//
// pendant.hh - what the XHC-WHB04B-6 pendant says and shows, apart from USB and HAL. Source: sheet of USB drivers,
// section 9.
#pragma once

#include <array>
#include <cstdint>

namespace xhc {

constexpr const char *AXES = "xyzabc";
constexpr int AXIS_COUNT = 6;
constexpr int NO_AXIS = -1;

/// Codes of the keys that do more than to be pins.
enum Key : uint8_t {
    KEY_NONE = 0,
    KEY_RESET = 0x01,
    KEY_STOP,
    KEY_START_PAUSE,
    KEY_FEED_PLUS,
    KEY_FEED_MINUS,
    KEY_SPINDLE_PLUS,
    KEY_SPINDLE_MINUS,
    KEY_M_HOME,
    KEY_SAFE_Z,
    KEY_W_HOME,
    KEY_S_ON_OFF,
    KEY_FN,
    KEY_PROBE_Z,
    KEY_CONTINUOUS,
    KEY_STEP,
    KEY_MACRO_10
};

/// A key, and what it is while Fn is held; nullptr: nothing.
struct KeyNames {
    Key key;
    const char *plain, *with_fn;
};
constexpr std::array<KeyNames, 16> KEYS = {{
    {KEY_RESET, "reset", "macro-11"},
    {KEY_STOP, "stop", "macro-12"},
    {KEY_START_PAUSE, "start-pause", "macro-13"},
    {KEY_FEED_PLUS, "feed-plus", "macro-1"},
    {KEY_FEED_MINUS, "feed-minus", "macro-2"},
    {KEY_SPINDLE_PLUS, "spindle-plus", "macro-3"},
    {KEY_SPINDLE_MINUS, "spindle-minus", "macro-4"},
    {KEY_M_HOME, "m-home", "macro-5"},
    {KEY_SAFE_Z, "safe-z", "macro-6"},
    {KEY_W_HOME, "w-home", "macro-7"},
    {KEY_S_ON_OFF, "s-on-off", "macro-8"},
    {KEY_FN, "fn", nullptr},
    {KEY_PROBE_Z, "probe-z", "macro-9"},
    {KEY_CONTINUOUS, "mode-continuous", "macro-15"},
    {KEY_STEP, "mode-step", "macro-16"},
    {KEY_MACRO_10, "macro-10", "macro-14"},
}};
constexpr int NO_KEY = -1;

/// What is pressed: an index of KEYS, and whether Fn is held with it.
struct Pressed {
    int index = NO_KEY;
    bool fn = false;
    bool operator!=(const Pressed &other) const { return index != other.index || fn != other.fn; }
};

/// A place of the feed rotary.
struct Feed {
    uint8_t code;
    const char *name;   ///< of the pin halui.feed.selected-
    double step;        ///< units for each click of the wheel
    double large_step;  ///< the same with option -B
    double percent;     ///< of the greatest velocity
};
constexpr std::array<Feed, 7> FEEDS = {{
    {0x0D, "2", 0.001, 0.001, 2},
    {0x0E, "5", 0.01, 0.01, 5},
    {0x0F, "10", 0.1, 0.1, 10},
    {0x10, "30", 1, 1, 30},
    {0x1A, "60", 1, 5, 60},
    {0x1B, "100", 1, 10, 100},
    {0x1C, "lead", 0, 0, 0},
}};
constexpr int NO_FEED = -1, LEAD = 6;
constexpr uint8_t LEAD_TOO = 0x9B;

/// One report of the pendant.
struct Report {
    Pressed pressed;
    uint8_t unknown_key = 0, unknown_axis = 0, unknown_feed = 0; ///< codes that stand in no table; 0: none
    int feed = NO_FEED;                                         ///< index of FEEDS
    int axis = NO_AXIS;
    int wheel = 0;                                              ///< clicks since the last report
    bool empty = false;                                         ///< the pendant goes to sleep
};

/// False when the bytes are no report.
bool parse(const uint8_t *data, int size, Report &report);

/// What the wheel does.
enum class Wheel { continuous = 0, step = 1, mpg = 2 };

/// What the display shows.
struct Shown {
    Wheel wheel = Wheel::mpg;
    bool machine_off = false, relative = false;
    std::array<double, 3> position{};
    double feed_override_percent = 0, spindle = 0; ///< spindle: override in percent, or speed
};

using Image = std::array<uint8_t, 21>;
/// The display's image.
Image image(const Shown &shown);

} // namespace xhc
