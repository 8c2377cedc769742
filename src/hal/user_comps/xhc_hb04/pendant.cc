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
    report.rotary = data[3];
    report.wheel = static_cast<int8_t>(data[4]);
    report.sleeping = std::all_of(data + 1, data + REPORT_SIZE, [](uint8_t b) { return b == 0; });
    return true;
}

namespace {

constexpr struct {
    const char *name;
    Rotary rotary;
} SELECTIONS[] = {{"off", Rotary::off}, {"x", Rotary::x}, {"y", Rotary::y}, {"z", Rotary::z}, {"a", Rotary::a},
                  {"spindle-override", Rotary::spindle}, {"feed-override", Rotary::feed}};

/// CODE:NAME, the code in hexadecimal; false with a message.
bool code_and_name(const std::string &path, const char *key, const std::string &line, Button &b) {
    size_t colon = line.find(':');
    char *end = nullptr;
    long code = strtol(line.c_str(), &end, 16);
    b.name = colon == std::string::npos ? "" : line.substr(colon + 1);
    b.name.erase(0, std::min(b.name.size(), b.name.find_first_not_of(" \t")));
    b.name.erase(b.name.find_last_not_of(" \t") + 1);
    b.code = static_cast<int>(code);
    if (!b.name.empty() && end != line.c_str() && code >= 1 && code <= 255) return true;
    fprintf(stderr, "xhc-hb04: %s: %s=%s: must be a hexadecimal code from 01 to FF, a colon and a name\n", path.c_str(),
            key, line.c_str());
    return false;
}

} // namespace

bool read_layout(const std::string &path, Layout &layout) {
    linuxcnc::IniFile ini;
    if (!ini.open(path)) return false;
    Button b;
    for (const std::string &line : ini.findStringAll("BUTTON", "XHC-HB04")) {
        if (!code_and_name(path, "BUTTON", line, b)) return false;
        if (layout.buttons.size() == MAX_BUTTONS) {
            fprintf(stderr, "xhc-hb04: %s: more than %zu buttons\n", path.c_str(), MAX_BUTTONS);
            return false;
        }
        layout.buttons.push_back(b);
    }
    if (layout.buttons.empty()) {
        fprintf(stderr, "xhc-hb04: %s: no BUTTON in [XHC-HB04]\n", path.c_str());
        return false;
    }
    for (const std::string &line : ini.findStringAll("ROTARY", "XHC-HB04")) {
        if (!code_and_name(path, "ROTARY", line, b)) return false;
        auto named = [&](auto &one) { return one.name == b.name; };
        auto s = std::find_if(std::begin(SELECTIONS), std::end(SELECTIONS), named);
        if (s == std::end(SELECTIONS)) {
            fprintf(stderr, "xhc-hb04: %s: ROTARY=%s: the name must be off, x, y, z, a, spindle-override or "
                            "feed-override\n", path.c_str(), line.c_str());
            return false;
        }
        layout.rotary[b.code] = s->rotary;
    }
    const std::string device = ini.findStringV("DEVICE", "XHC-HB04", "");
    int used = 0;
    if (!device.empty() && (sscanf(device.c_str(), "%4hx:%4hx%n", &layout.vendor, &layout.product, &used) != 2 ||
                            static_cast<size_t>(used) != device.size())) {
        fprintf(stderr,
                "xhc-hb04: %s: DEVICE=%s: must be the numbers of the USB device, as lsusb shows them: 10ce:eb70\n",
                path.c_str(), device.c_str());
        return false;
    }
    return true;
}

bool selection(const Layout &layout, int code, Rotary &r) {
    if (auto it = layout.rotary.find(code); it != layout.rotary.end()) {
        r = it->second;
        return true;
    }
    for (auto &one : SELECTIONS)
        if (static_cast<int>(one.rotary) == code) {
            r = one.rotary;
            return true;
        }
    return false;
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
