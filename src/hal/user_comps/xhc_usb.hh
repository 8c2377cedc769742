// SPDX-License-Identifier: GPL-2.0-or-later
//
// xhc_usb.hh - what the pendants of the maker XHC have in common: their receiver on USB (libusb) and the display's
// image. Source: sheet of USB drivers, sections 8 and 9.
#pragma once

#include <libusb.h>

#include <cstddef>
#include <cstdint>

namespace xhc {

/// Steps of a count that goes round, as HAL's 32 bits do.
inline int32_t counted(int32_t counts, int steps) {
    return static_cast<int32_t>(static_cast<uint32_t>(counts) + static_cast<uint32_t>(steps));
}

constexpr uint16_t XHC_VENDOR = 0x10CE;

/// The receiver of a pendant, while it is open.
class Usb {
public:
    /// program: begins the messages.
    Usb(const char *program, uint16_t product, uint16_t vendor = XHC_VENDOR)
        : program_(program), product_(product), vendor_(vendor) {}
    Usb(const Usb &) = delete;
    Usb &operator=(const Usb &) = delete;
    ~Usb();

    /// False without a device, or without the right to use it (told once).
    bool open();
    void close();

    enum class Got { nothing, report, lost };
    static constexpr unsigned WAIT_MS = 30;
    static constexpr int REPORT_MOST = 64;
    /// A report; waits up to WAIT_MS.
    Got read(uint8_t (&data)[REPORT_MOST], int &size);

    static constexpr size_t BLOCK_PAYLOAD = 7;
    /// Sends an image of whole blocks to the display. False when the device is lost.
    bool show(const uint8_t *image, size_t size);

private:
    uint8_t endpoint();

    const char *program_;
    uint16_t product_, vendor_;
    libusb_context *context_ = nullptr;
    libusb_device_handle *handle_ = nullptr;
    uint8_t endpoint_ = 0;
    bool told_ = false;
};

/// Fields of an image: lowest byte first.
void put16(uint8_t *at, unsigned value);
/// Whole part, then ten-thousandths with the sign in the highest bit: four bytes.
void put_coordinate(uint8_t *at, double value);
/// The nearest whole number of 16 bits with a sign; 0 for what is no number.
void put_number(uint8_t *at, double value);

} // namespace xhc
