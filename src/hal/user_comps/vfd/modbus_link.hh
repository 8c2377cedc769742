// SPDX-License-Identifier: GPL-2.0-or-later
//
// modbus_link.hh - drives on a serial line or a TCP connection (libmodbus): requests, the return of a lost
// connection, and whether a spindle may run.
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

/// Whether a spindle may run. Invariants: (1) it does not while its drive is lost or disabled; (2) after that, after
/// disarm() and at the start it does not before the command to run has been seen FALSE while the drive answered.
class Guard {
public:
    /// After each request; `connected`: the link is there.
    void answered(bool good, bool connected);
    /// More than ten good answers in a row.
    bool ok() const { return good_ > OK_AFTER; }
    /// Nothing is known of the drive: no good answer for a second, or the connection is gone.
    bool lost() const { return lost_; }

    /// Once in a look, with `wanted` read from HAL before `enabled`: one signal may drive both.
    bool may_run(bool wanted, bool enabled);
    /// A fault, an emergency stop: the command has to come anew. `for_s`: what is seen within that time does not
    /// count (the program itself has cleared the pin).
    void disarm(double for_s = 0);

private:
    using Clock = std::chrono::steady_clock;
    static constexpr int OK_AFTER = 10, FAILURES = 2;
    static constexpr auto LOST_AFTER = std::chrono::seconds(1);

    int good_ = 0, bad_ = 0;
    bool lost_ = true, armed_ = false;
    Clock::time_point last_good_, blind_until_;
};

} // namespace vfd
