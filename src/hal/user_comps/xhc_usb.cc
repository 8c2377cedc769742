// SPDX-License-Identifier: GPL-2.0-or-later
//
// xhc_usb.cc - the receiver of XHC's pendants on USB, and fields of their display.
#include "xhc_usb.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace xhc {

namespace {

constexpr unsigned SEND_MS = 100;
constexpr uint8_t DEFAULT_ENDPOINT = 0x81;
constexpr uint8_t DISPLAY_REPORT = 6;

} // namespace

Usb::~Usb() {
    close();
    if (context_) libusb_exit(context_);
}

bool Usb::open() {
    if (!context_ && libusb_init(&context_) != 0) return false;
    handle_ = libusb_open_device_with_vid_pid(context_, vendor_, product_);
    if (!handle_) return false;
    libusb_set_auto_detach_kernel_driver(handle_, 1);
    int result = libusb_claim_interface(handle_, 0);
    if (result != 0) {
        if (!told_) fprintf(stderr, "%s: the pendant cannot be used: %s\n", program_, libusb_error_name(result));
        told_ = true;
        libusb_close(handle_);
        handle_ = nullptr;
        return false;
    }
    endpoint_ = endpoint();
    return true;
}

void Usb::close() {
    if (!handle_) return;
    libusb_release_interface(handle_, 0);
    libusb_close(handle_);
    handle_ = nullptr;
}

Usb::Got Usb::read(uint8_t (&data)[REPORT_MOST], int &size) {
    size = 0;
    int result = libusb_interrupt_transfer(handle_, endpoint_, data, sizeof data, &size, WAIT_MS);
    if (result == LIBUSB_ERROR_TIMEOUT || result == LIBUSB_ERROR_INTERRUPTED) return Got::nothing;
    return result == 0 ? Got::report : Got::lost;
}

bool Usb::show(const uint8_t *image, size_t size) {
    for (size_t at = 0; at < size; at += BLOCK_PAYLOAD) {
        std::array<uint8_t, 1 + BLOCK_PAYLOAD> block = {DISPLAY_REPORT};
        std::copy_n(image + at, std::min(BLOCK_PAYLOAD, size - at), block.begin() + 1);
        int sent = libusb_control_transfer(handle_, 0x21, 0x09, 0x0306, 0, block.data(), block.size(), SEND_MS);
        if (sent == LIBUSB_ERROR_NO_DEVICE || sent == LIBUSB_ERROR_IO) return false;
    }
    return true;
}

uint8_t Usb::endpoint() {
    libusb_config_descriptor *config = nullptr;
    uint8_t found = DEFAULT_ENDPOINT;
    if (libusb_get_active_config_descriptor(libusb_get_device(handle_), &config) != 0) return found;
    if (config->bNumInterfaces > 0 && config->interface[0].num_altsetting > 0) {
        const libusb_interface_descriptor &first = config->interface[0].altsetting[0];
        for (int n = 0; n < first.bNumEndpoints; n++)
            if (first.endpoint[n].bEndpointAddress & LIBUSB_ENDPOINT_IN) {
                found = first.endpoint[n].bEndpointAddress;
                break;
            }
    }
    libusb_free_config_descriptor(config);
    return found;
}

void put16(uint8_t *at, unsigned value) {
    at[0] = static_cast<uint8_t>(value & 0xFF);
    at[1] = static_cast<uint8_t>(value >> 8 & 0xFF);
}

void put_coordinate(uint8_t *at, double value) {
    double size = std::isfinite(value) ? std::min(std::fabs(value), 65535.0) : 0.0;
    unsigned whole = static_cast<unsigned>(size), part = static_cast<unsigned>(std::lround((size - whole) * 10000));
    if (part == 10000) {
        part = 0;
        whole++;
    }
    put16(at, whole);
    put16(at + 2, part | (value < 0 && (whole || part) ? 0x8000U : 0U));
}

void put_number(uint8_t *at, double value) {
    put16(at, static_cast<unsigned>(std::isfinite(value) ? std::lround(std::clamp(value, -32768.0, 32767.0)) : 0) &
                  0xFFFFU);
}

} // namespace xhc
