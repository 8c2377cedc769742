// SPDX-License-Identifier: GPL-2.0-or-later
//
// pendant.cc - reports, layouts, steps and the display of the XHC-HB04 pendant.
#include "pendant.hh"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "inifile.hh"
#include "xhc_usb.hh"

namespace xhc {

namespace {

constexpr int REPORT_SIZE = 6, REPORT_ID = 4;
constexpr size_t MAX_BUTTONS = 32;

uint8_t step_code(int step) {
    constexpr int STEPS[] = {0, 1, 5, 10, 20, 30, 40, 50, 100, 500, 1000};
    for (size_t n = 0; n < sizeof STEPS / sizeof *STEPS; n++)
        if (STEPS[n] == step) return static_cast<uint8_t>(n);
    return 0;
}

} // namespace

int axis_of(Rotary r) {
    switch (r) {
    case Rotary::x: return 0;
    case Rotary::y: return 1;
    case Rotary::z: return 2;
    case Rotary::a: return 3;
    default: return NO_AXIS;
    }
}

bool parse(const uint8_t *data, int size, Report &report) {
    if (size < REPORT_SIZE || data[0] != REPORT_ID) return false;
    report.button = data[1];
    report.rotary = static_cast<Rotary>(data[3]);
    report.wheel = static_cast<int8_t>(data[4]);
    report.sleeping = std::all_of(data + 1, data + REPORT_SIZE, [](uint8_t b) { return b == 0; });
    return true;
}

bool read_layout(const std::string &path, std::vector<Button> &buttons) {
    linuxcnc::IniFile ini;
    if (!ini.open(path)) return false;
    for (const std::string &line : ini.findStringAll("BUTTON", "XHC-HB04")) {
        size_t colon = line.find(':');
        char *end = nullptr;
        long code = strtol(line.c_str(), &end, 16);
        std::string name = colon == std::string::npos ? "" : line.substr(colon + 1);
        name.erase(0, std::min(name.size(), name.find_first_not_of(" \t")));
        name.erase(name.find_last_not_of(" \t") + 1);
        if (name.empty() || end == line.c_str() || code < 1 || code > 255) {
            fprintf(stderr, "xhc-hb04: %s: BUTTON=%s: must be a hexadecimal code from 01 to FF, a colon and a name\n",
                    path.c_str(), line.c_str());
            return false;
        }
        if (buttons.size() == MAX_BUTTONS) {
            fprintf(stderr, "xhc-hb04: %s: more than %zu buttons\n", path.c_str(), MAX_BUTTONS);
            return false;
        }
        buttons.push_back({static_cast<int>(code), name});
    }
    if (buttons.empty()) fprintf(stderr, "xhc-hb04: %s: no BUTTON in [XHC-HB04]\n", path.c_str());
    return !buttons.empty();
}

std::vector<int> step_sequence(int number) {
    switch (number) {
    case 1: return {1, 10, 100, 1000};
    case 2: return {1, 5, 10, 20};
    case 3: return {1, 10, 100};
    case 4: return {1, 5, 10, 20, 50, 100};
    case 5: return {1, 10, 50, 100, 1000};
    default: return {};
    }
}

Image image(const Shown &shown) {
    Image bytes = {0xFE, 0xFD, 0x0C};
    for (size_t n = 0; n < 3; n++) {
        put_coordinate(&bytes[3 + 4 * n], shown.relative[n]);
        put_coordinate(&bytes[15 + 4 * n], shown.absolute[n]);
    }
    put_number(&bytes[27], shown.feed_override_percent);
    put_number(&bytes[29], shown.spindle_override_percent);
    put_number(&bytes[31], shown.feed);
    put_number(&bytes[33], shown.spindle);
    bytes[35] = step_code(shown.step);
    bytes[36] = shown.inch ? 0x80 : 0;
    return bytes;
}

} // namespace xhc
