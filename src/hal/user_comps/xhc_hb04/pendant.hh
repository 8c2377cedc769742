// SPDX-License-Identifier: GPL-2.0-or-later
//
// pendant.hh - what the XHC-HB04 pendant says and shows, apart from USB and HAL. Source: sheet of USB drivers,
// section 8.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "xhc_usb.hh"

namespace xhc {

enum class Rotary { off = 0, x = 0x11, y = 0x12, z = 0x13, a = 0x18, spindle = 0x14, feed = 0x15 };

constexpr const char *AXES = "xyza";
constexpr int NO_AXIS = -1;

/// Axis (0 to 3) that the rotary selects, or NO_AXIS.
int axis_of(Rotary r);

/// One report of the pendant: codes as they came.
struct Report {
    int button = 0; ///< code, 0 none
    int rotary = 0; ///< code: selection()
    int wheel = 0;  ///< steps since the last report
    bool sleeping = false;
};

/// False when the bytes are no report.
bool parse(const uint8_t *data, int size, Report &report);

/// A button of the layout file.
struct Button {
    int code;
    std::string name;
};

/// What a file says of a pendant: its buttons and, of one with other numbers or codes than the XHC-HB04, those.
struct Layout {
    uint16_t vendor = XHC_VENDOR, product = 0xEB70;
    std::vector<Button> buttons;
    std::map<int, Rotary> rotary; ///< code to what it selects; the usual codes need no entry
};

/// False, with a message on stderr.
bool read_layout(const std::string &path, Layout &layout);

/// What the rotary's code selects; false for a code that is not known.
bool selection(const Layout &layout, int code, Rotary &r);

/// Step sizes in thousandths of a unit. Empty for a number that is none.
std::vector<int> step_sequence(int number);

/// What the display shows.
struct Shown {
    std::array<double, 3> relative{}, absolute{};                                            ///< X (or A), Y, Z
    double feed_override_percent = 0, spindle_override_percent = 0, feed = 0, spindle = 0;   ///< feed a minute, rpm
    int step = 0;
    bool inch = false;
};

using Image = std::array<uint8_t, 42>;
/// The display's image.
Image image(const Shown &shown);

} // namespace xhc
