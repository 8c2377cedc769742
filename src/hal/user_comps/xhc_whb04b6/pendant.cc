// SPDX-License-Identifier: GPL-2.0-or-later
//
// pendant.cc - reports and the display of the XHC-WHB04B-6 pendant.
#include "pendant.hh"

#include <algorithm>
#include <cmath>

#include "xhc_usb.hh"

namespace xhc {

namespace {

constexpr int REPORT_SIZE = 8, REPORT_ID = 4;
constexpr uint8_t AXIS_OFF = 0x06, FIRST_AXIS = 0x11;
constexpr uint8_t FLAG_RESET = 0x40, FLAG_RELATIVE = 0x80;

int index_of(uint8_t key) {
    for (size_t n = 0; n < KEYS.size(); n++)
        if (KEYS[n].key == key) return static_cast<int>(n);
    return NO_KEY;
}

/// Of two codes: Fn is the modifier of the other, otherwise the second one counts.
void take_keys(uint8_t first, uint8_t second, Report &report) {
    if (second == KEY_NONE || (second == KEY_FN && first != KEY_NONE)) std::swap(first, second);
    if (second == KEY_NONE) return;
    report.pressed.index = index_of(second);
    if (report.pressed.index == NO_KEY) report.unknown_key = second;
    else report.pressed.fn = first == KEY_FN && second != KEY_FN;
}

int feed_of(uint8_t code) {
    if (code == LEAD_TOO) return LEAD;
    for (size_t n = 0; n < FEEDS.size(); n++)
        if (FEEDS[n].code == code) return static_cast<int>(n);
    return NO_FEED;
}

/// The size of a number, as far as 16 bits can tell it.
unsigned whole(double value) {
    return std::isfinite(value) ? static_cast<unsigned>(std::lround(std::min(std::fabs(value), 65535.0))) : 0;
}

} // namespace

bool parse(const uint8_t *data, int size, Report &report) {
    if (size < REPORT_SIZE || data[0] != REPORT_ID) return false;
    report = Report{};
    report.empty = std::all_of(data + 2, data + 7, [](uint8_t b) { return b == 0; });
    take_keys(data[2], data[3], report);
    report.feed = feed_of(data[4]);
    if (report.feed == NO_FEED) report.unknown_feed = data[4];
    const uint8_t axis = data[5];
    if (axis >= FIRST_AXIS && axis < FIRST_AXIS + AXIS_COUNT) report.axis = axis - FIRST_AXIS;
    else if (axis != AXIS_OFF) report.unknown_axis = axis;
    report.wheel = static_cast<int8_t>(data[6]);
    return true;
}

Image image(const Shown &shown) {
    Image bytes = {0xFE, 0xFD, 0xFE};
    bytes[3] = static_cast<uint8_t>(static_cast<unsigned>(shown.wheel) | (shown.machine_off ? FLAG_RESET : 0U) |
                                    (shown.relative ? FLAG_RELATIVE : 0U));
    for (size_t n = 0; n < shown.position.size(); n++) put_coordinate(&bytes[4 + 4 * n], shown.position[n]);
    put16(&bytes[16], whole(shown.feed_override_percent));
    put16(&bytes[18], whole(shown.spindle));
    return bytes;
}

} // namespace xhc
