// SPDX-License-Identifier: GPL-2.0-or-later
//
// modbus_link.cc - see modbus_link.hh.
#include "modbus_link.hh"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>

namespace vfd {

namespace {

constexpr int SILENCES_OF_TCP = 2; ///< after so many in a row the connection is made anew

void set_time(modbus_t *link, int (*set)(modbus_t *, uint32_t, uint32_t), double seconds) {
    double whole = std::floor(seconds);
    set(link, static_cast<uint32_t>(whole), static_cast<uint32_t>((seconds - whole) * 1e6));
}

/// Not an answer that is wrong, but a connection that is not there any more.
bool is_gone(int reason) {
    constexpr int REASONS[] = {EBADF, ECONNRESET, EPIPE, ECONNREFUSED, ENOTCONN, EIO, ENXIO, ENODEV, EHOSTUNREACH};
    return std::find(std::begin(REASONS), std::end(REASONS), reason) != std::end(REASONS);
}

} // namespace

ModbusLink::~ModbusLink() {
    drop();
    if (listener_ >= 0) close(listener_);
    if (link_) modbus_free(link_);
}

std::string ModbusLink::place() const {
    if (!is_tcp()) return connection_.line.device;
    std::string port = std::to_string(connection_.port);
    return connection_.type == Connection::Type::tcp_client ? connection_.host + ":" + port : "port " + port;
}

bool ModbusLink::make() {
    const SerialLine &line = connection_.line;
    switch (connection_.type) {
    case Connection::Type::rtu:
        link_ = modbus_new_rtu(line.device.c_str(), line.rate, line.parity, line.bits, line.stop);
        break;
    case Connection::Type::tcp_client: link_ = modbus_new_tcp(connection_.host.c_str(), connection_.port); break;
    case Connection::Type::tcp_server: link_ = modbus_new_tcp(nullptr, connection_.port); break;
    }
    if (!link_) return false;
    modbus_set_debug(link_, debug_ || line.debug);
    set_time(link_, modbus_set_response_timeout, connection_.response_s);
    set_time(link_, modbus_set_byte_timeout, connection_.byte_s);
    return true;
}

/// What can only be set on an open device.
bool ModbusLink::set_up() {
    return (!connection_.serial_mode || modbus_rtu_set_serial_mode(link_, *connection_.serial_mode) == 0) &&
           (!connection_.rts || modbus_rtu_set_rts(link_, *connection_.rts) == 0);
}

bool ModbusLink::open() {
    if (!make()) return fail(place(), errno);
    if (connection_.type == Connection::Type::tcp_server) {
        listener_ = modbus_tcp_listen(link_, 1);
        if (listener_ < 0) return fail(place(), errno);
    }
    return connect() || is_tcp();
}

bool ModbusLink::connect() {
    if (connected_) return true;
    if (Clock::now() < due_) return false;
    due_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                              std::chrono::duration<double>(connection_.reconnect_s));
    if (connection_.type == Connection::Type::tcp_server) return accept();
    if (modbus_connect(link_) != 0) return fail(place(), errno);
    connected_ = true;
    if (is_tcp() || set_up()) {
        told_.erase(place());
        return true;
    }
    int reason = errno;
    drop();
    return fail(place(), reason);
}

bool ModbusLink::accept() {
    pollfd wait = {listener_, POLLIN, 0};
    due_ = {};
    if (poll(&wait, 1, 0) != 1) return fail(place(), ENOTCONN);
    connected_ = modbus_tcp_accept(link_, &listener_) >= 0;
    if (!connected_) return fail(place(), errno);
    told_.erase(place());
    return true;
}

void ModbusLink::drop() {
    if (connected_) modbus_close(link_);
    connected_ = false;
    silences_ = 0;
}

void ModbusLink::debug(bool on) {
    debug_ = on;
    if (link_) modbus_set_debug(link_, on);
}

bool ModbusLink::fail(const std::string &what, int reason) {
    int &told = told_[what];
    if (reason != told && reason != last_reason_)
        fprintf(stderr, "%s: ERROR: %s: %s\n", program_.c_str(), what.c_str(), modbus_strerror(reason));
    told = last_reason_ = reason;
    return false;
}

template <class F> bool ModbusLink::ask(int slave, const char *what, int address, F once) {
    if (!connect()) return false;
    char request[64];
    snprintf(request, sizeof request, "%s 0x%04x of slave %d", what, static_cast<unsigned>(address), slave);
    if (modbus_set_slave(link_, slave) != 0) return fail(request, errno);
    modbus_flush(link_); // what came late is no answer to this
    if (once()) {
        silences_ = last_reason_ = 0;
        told_.erase(request);
        return true;
    }
    int reason = errno;
    fail(request, reason);
    silences_ = reason == ETIMEDOUT ? silences_ + 1 : 0;
    if (is_gone(reason) || (is_tcp() && silences_ >= SILENCES_OF_TCP)) drop();
    return false;
}

bool ModbusLink::read(int slave, int address, int count, uint16_t *values) {
    return ask(slave, "reading register", address,
               [&] { return modbus_read_registers(link_, address, count, values) == count; });
}

bool ModbusLink::read_coils(int slave, int address, int count, uint8_t *values) {
    return ask(slave, "reading coil", address,
               [&] { return modbus_read_bits(link_, address, count, values) == count; });
}

bool ModbusLink::write(int slave, int address, int value) {
    return ask(slave, "writing register", address,
               [&] { return modbus_write_register(link_, address, static_cast<uint16_t>(value)) == 1; });
}

bool ModbusLink::write_coil(int slave, int address, bool value) {
    return ask(slave, "writing coil", address, [&] { return modbus_write_bit(link_, address, value) == 1; });
}

bool ModbusLink::write_multiple(int slave, int address, int value) {
    auto word = static_cast<uint16_t>(value);
    return ask(slave, "writing register", address,
               [&] { return modbus_write_registers(link_, address, 1, &word) == 1; });
}

} // namespace vfd
