// SPDX-License-Identifier: GPL-2.0-or-later
//
// modbus_link.hh - drives on a serial line or a TCP connection (libmodbus): requests, and the return of a lost
// connection.
#pragma once

#include <modbus.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "serial_line.hh"

namespace vfd {

/// How drives are reached.
struct Connection {
    enum class Type { rtu, tcp_server, tcp_client };
    Type type = Type::rtu;
    SerialLine line;
    std::optional<int> serial_mode, rts; ///< of libmodbus; nothing: as the device has it
    std::string host = "127.0.0.1";      ///< of tcp_client
    int port = 1502;
    double response_s = 0.5, byte_s = 0.5, reconnect_s = 1;
};

class ModbusLink {
public:
    ModbusLink(std::string program, Connection connection)
        : program_(std::move(program)), connection_(std::move(connection)) {}
    ~ModbusLink();
    ModbusLink(const ModbusLink &) = delete;
    ModbusLink &operator=(const ModbusLink &) = delete;

    /// The first time. False, with a message on stderr, when that can never work: a serial device that cannot be
    /// opened or set up, a port that cannot be listened on. A TCP connection may come later.
    bool open();

    bool connected() const { return connected_; }
    /// Shows the traffic.
    void debug(bool on);

    // Each asks once. False on failure, with a message when it is a new one; a connection that is gone is tried
    // anew by the requests that come `reconnect_s` later.
    bool read(int slave, int address, int count, uint16_t *values);
    bool read_coils(int slave, int address, int count, uint8_t *values);
    bool write(int slave, int address, int value);
    bool write_coil(int slave, int address, bool value);
    /// Function 16 for one register: some drives know no other.
    bool write_multiple(int slave, int address, int value);

private:
    using Clock = std::chrono::steady_clock;

    template <class F> bool ask(int slave, const char *what, int address, F once);
    bool make();
    bool set_up();
    bool connect();
    bool accept();
    void drop();
    /// False, with a message unless `what` fails for the same reason as before, or as the request before it.
    bool fail(const std::string &what, int reason);
    std::string place() const;
    bool is_tcp() const { return connection_.type != Connection::Type::rtu; }

    std::string program_;
    Connection connection_;
    std::map<std::string, int> told_; ///< what fails, and why
    int last_reason_ = 0;             ///< of the request before; 0: it was good
    modbus_t *link_ = nullptr;
    bool connected_ = false, debug_ = false;
    int listener_ = -1, silences_ = 0;
    Clock::time_point due_;
};

} // namespace vfd
