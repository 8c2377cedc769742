// SPDX-License-Identifier: GPL-2.0-or-later
//
// hycomm.cc - frames of Huanyang drives on a serial line. Source: Modbus sheet, section 3.
#include "hycomm.hh"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace hy {

namespace {

constexpr int ANSWER_MS = 500, HEAD = 3, CHECK = 2, MAX_FRAME = 64;

uint16_t crc(const uint8_t *data, int size) {
    uint16_t value = 0xFFFF;
    for (int n = 0; n < size; n++) {
        value ^= data[n];
        for (int bit = 0; bit < 8; bit++) value = static_cast<uint16_t>(value & 1 ? value >> 1 ^ 0xA001 : value >> 1);
    }
    return value;
}

speed_t speed_of(int rate) {
    switch (rate) {
    case 1200: return B1200;
    case 2400: return B2400;
    case 4800: return B4800;
    case 9600: return B9600;
    case 19200: return B19200;
    default: return B38400;
    }
}

} // namespace

Hycomm::~Hycomm() { shut(); }

void Hycomm::shut() {
    if (port_ >= 0) close(port_);
    port_ = -1;
}

bool Hycomm::open() {
    port_ = ::open(line_.device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK);
    termios t = {};
    if (port_ < 0 || tcgetattr(port_, &t) != 0) return fail_to_open();
    cfmakeraw(&t);
    cfsetspeed(&t, speed_of(line_.rate));
    constexpr tcflag_t SIZES[] = {CS5, CS6, CS7, CS8};
    t.c_cflag =
        (t.c_cflag & ~static_cast<tcflag_t>(CSIZE | PARENB | PARODD | CSTOPB)) | SIZES[line_.bits - 5] | CLOCAL | CREAD;
    if (line_.parity != 'N') t.c_cflag |= PARENB;
    if (line_.parity == 'O') t.c_cflag |= PARODD;
    if (line_.stop == 2) t.c_cflag |= CSTOPB;
    return tcsetattr(port_, TCSANOW, &t) == 0 || fail_to_open();
}

bool Hycomm::fail_to_open() {
    std::string text = line_.device + ": " + strerror(errno);
    if (text != told_) fprintf(stderr, "%s: ERROR: %s\n", program_.c_str(), text.c_str());
    told_ = text;
    shut();
    return false;
}

void Hycomm::show(const char *direction, const uint8_t *data, int size) const {
    if (!line_.debug) return;
    printf("%s", direction);
    for (int n = 0; n < size; n++) printf(" %02X", static_cast<unsigned>(data[n]));
    printf("\n");
    fflush(stdout);
}

std::optional<int> Hycomm::fail(Function function, const char *what) {
    std::string text = "function " + std::to_string(static_cast<int>(function)) + ": " + what;
    if (text != told_) fprintf(stderr, "%s: ERROR %s\n", program_.c_str(), text.c_str()); // once, not in every cycle
    told_ = text;
    return std::nullopt;
}

bool Hycomm::receive(uint8_t *at, int count) {
    while (count > 0) {
        pollfd wait = {port_, POLLIN, 0};
        if (poll(&wait, 1, ANSWER_MS) != 1) return false;
        ssize_t got = read(port_, at, static_cast<size_t>(count));
        if (got <= 0) {
            shut(); // it is gone
            return false;
        }
        at += got;
        count -= static_cast<int>(got);
    }
    return true;
}

std::optional<int> Hycomm::ask(Function function, std::initializer_list<int> data) {
    uint8_t out[MAX_FRAME], in[MAX_FRAME];
    int size = 0;
    out[size++] = static_cast<uint8_t>(line_.target);
    out[size++] = static_cast<uint8_t>(function);
    out[size++] = static_cast<uint8_t>(data.size());
    for (int byte : data) out[size++] = static_cast<uint8_t>(byte);
    uint16_t check = crc(out, size);
    out[size++] = static_cast<uint8_t>(check & 0xFF);
    out[size++] = static_cast<uint8_t>(check >> 8);
    if (port_ < 0 && !open()) return std::nullopt;
    tcflush(port_, TCIFLUSH);
    if (write(port_, out, static_cast<size_t>(size)) != size) {
        shut();
        return fail(function, "cannot be sent");
    }
    show(">", out, size);
    if (!receive(in, HEAD)) return fail(function, "no answer");
    int length = in[2], total = HEAD + length + CHECK;
    if (length < 1 || total > MAX_FRAME) return fail(function, "answer of a wrong length");
    if (!receive(in + HEAD, length + CHECK)) return fail(function, "answer cut short");
    show("<", in, total);
    if (crc(in, total - CHECK) != (in[total - 2] | in[total - 1] << 8)) return fail(function, "CRC error");
    if (in[0] != out[0] || in[1] != out[1]) return fail(function, "answer of another device or to another question");
    told_.clear();
    auto word = [&](int n) {
        return total - CHECK >= n + 2 ? std::optional<int>(in[n] << 8 | in[n + 1]) : std::nullopt;
    };
    switch (function) {
    case Function::read_parameter:
    case Function::write_parameter:
        if (in[3] != out[3]) return fail(function, "answer for another parameter");
        return length == 2 ? std::optional<int>(in[4]) : word(4);
    case Function::control: return in[3];
    case Function::read_status: return word(4);
    default: return word(3);
    }
}

std::optional<int> Hycomm::parameter(int number) { return ask(Function::read_parameter, {number, 0, 0}); }
std::optional<int> Hycomm::set_parameter(int number, int value) {
    return ask(Function::write_parameter, {number, value >> 8 & 0xFF, value & 0xFF});
}
std::optional<int> Hycomm::control(int bits) { return ask(Function::control, {bits}); }
std::optional<int> Hycomm::status(int index) { return ask(Function::read_status, {index}); }
std::optional<int> Hycomm::frequency(int hz_hundredths) {
    return ask(Function::write_frequency, {hz_hundredths >> 8 & 0xFF, hz_hundredths & 0xFF});
}

} // namespace hy
