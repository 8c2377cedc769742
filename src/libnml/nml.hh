// SPDX-License-Identifier: GPL-2.0-or-later
//
// nml.hh - typed messages between processes, through buffers named in a .nml file.
//
// A buffer holds the last message (status) or a queue of messages (commands, errors).
// Local buffers live in shared memory; remote ones are reached over TCP through
// linuxcncsvr. All calls: [task] or [any] non-realtime thread; an NML object belongs
// to one thread at a time. Waiting goes through the clock (kerf_clock.h).
#ifndef KERF_NML_HH
#define KERF_NML_HH

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

typedef int32_t NMLTYPE;

constexpr int NML_ERROR_LEN = 256, NML_TEXT_LEN = 256, NML_DISPLAY_LEN = 256;

// Head of each message. type > 0 is unique in the system; size is that of the whole struct.
struct NMLmsg {
    NMLTYPE _type = 0;
    long size = 0;
    NMLmsg() = default;
    NMLmsg(NMLTYPE t, long s) : _type(t), size(s) {}
};

// Command: the buffer write stores a number unique among all writers of the buffer.
struct RCS_CMD_MSG : NMLmsg {
    int serial_number = 0;
    RCS_CMD_MSG() = default;
    RCS_CMD_MSG(NMLTYPE t, long s) : NMLmsg(t, s) {}
};

enum RCS_STATUS { UNINITIALIZED_STATUS = -1, RCS_DONE = 1, RCS_EXEC = 2, RCS_ERROR = 3 };

struct RCS_STAT_MSG : NMLmsg {
    NMLTYPE command_type = 0;
    int echo_serial_number = 0;
    int status = 0; // RCS_STATUS; 0 before the first cycle of the writer
    int _state = 0;
    RCS_STAT_MSG() = default;
    RCS_STAT_MSG(NMLTYPE t, long s) : NMLmsg(t, s) {}
};

enum NML_ERROR_TYPE {
    NML_NO_ERROR = 0, NML_BUFFER_NOT_READ, NML_TIMED_OUT, NML_INVALID_CONFIGURATION, NML_FORMAT_ERROR,
    NML_INTERNAL_CMS_ERROR, NML_NO_MASTER_ERROR, NML_INVALID_MESSAGE_ERROR, NML_QUEUE_FULL_ERROR
};

enum CMS_STATUS {
    CMS_MISC_ERROR = -1, CMS_UPDATE_ERROR = -2, CMS_INTERNAL_ACCESS_ERROR = -3, CMS_NO_MASTER_ERROR = -4,
    CMS_CONFIG_ERROR = -5, CMS_TIMED_OUT = -6, CMS_QUEUE_FULL = -7, CMS_CREATE_ERROR = -8,
    CMS_PERMISSIONS_ERROR = -9, CMS_NO_SERVER_ERROR = -10, CMS_RESOURCE_CONFLICT_ERROR = -11,
    CMS_NO_IMPLEMENTATION_ERROR = -12, CMS_INSUFFICIENT_SPACE_ERROR = -13, CMS_LIBRARY_UNAVAILABLE_ERROR = -14,
    CMS_SERVER_SIDE_ERROR = -15, CMS_NO_BLOCKING_SEM_ERROR = -16,
    CMS_STATUS_NOT_SET = 0, CMS_READ_OLD = 1, CMS_READ_OK = 2, CMS_WRITE_OK = 3, CMS_WRITE_WAS_BLOCKED = 4,
    CMS_CLEAR_OK = 5, CMS_CLOSED = 6
};

// The error class a client sees for a status of the buffer.
NML_ERROR_TYPE nml_error_of(CMS_STATUS status);

namespace nml {

class Encoder; // nml_code.hh
class Decoder;

enum class Kind { plain, command, status };

// What the library must know of a message type; made from its one description (see
// emc/nml/messages.hh). encode/decode code everything after type and size.
struct MessageType {
    NMLTYPE type;
    const char *name;
    long size;
    Kind kind;
    void (*encode)(const NMLmsg &, Encoder &);
    void (*decode)(NMLmsg &, Decoder &);
};

// The messages a channel may carry, sorted by type.
class MessageSet {
public:
    explicit MessageSet(std::vector<MessageType> types);
    const MessageType *find(NMLTYPE type) const; // nullptr: unknown
    const char *name(NMLTYPE type) const;        // "UNKNOWN" when unknown
    const std::vector<MessageType> &all() const { return types_; }
private:
    std::vector<MessageType> types_;
};

class Transport; // nml_transport.hh
struct Connection; // nml_config.hh

// What the connections of one number (cnum) have done with a buffer that has the option `diag`.
struct Diagnosis {
    int cnum = 0;
    std::string process; // the last one that connected
    int pid = 0;
    int64_t reads = 0, read_bytes = 0, writes = 0, write_bytes = 0; // messages since the buffer was made
    double last = 0;     // when the last message passed, s of the clock of the computer (CLOCK_MONOTONIC); 0: never
};

} // namespace nml

class NML {
public:
    // Connects `process` to `buffer` as file says. On failure the object exists, valid() is
    // false and error_type tells why. set_to_server: -1 never, 0 as the P line, 1 forced;
    // set_to_master: -1 attach only, 0 as the P line, 1 create.
    NML(const nml::MessageSet &set, const char *buffer, const char *process, const char *file,
        int set_to_server = 0, int set_to_master = 0);
    ~NML();
    NML(const NML &) = delete;
    NML &operator=(const NML &) = delete;

    bool valid();

    // Type (> 0) of a new message, 0 nothing new, -1 error. read() takes the head of a queue.
    NMLTYPE read();
    // As read(), leaves a queue and the was-read mark alone.
    NMLTYPE peek();
    // As read(), waits up to t seconds (t < 0: for ever) for a message.
    NMLTYPE blocking_read(double t);
    // 0 or -1. A command's serial number is set in msg and *serial.
    int write(NMLmsg &msg, int *serial = nullptr);
    int write(NMLmsg *msg, int *serial = nullptr) { return msg ? write(*msg, serial) : -1; }
    // Only if the last message was read (queue: only if empty); else -1, NML_BUFFER_NOT_READ.
    int write_if_read(NMLmsg &msg, int *serial = nullptr);
    int write_if_read(NMLmsg *msg, int *serial = nullptr) { return msg ? write_if_read(*msg, serial) : -1; }
    // For servers: as write or write_if_read, whatever the P line allows.
    int write_raw(NMLmsg &msg, bool only_if_read, int *serial);
    int check_if_read();       // 1, 0 or -1
    int clear();               // 0 or -1
    int get_queue_length();    // messages waiting; -1 when the buffer is no queue
    long get_space_available();// bytes; -1 on error
    int last_writer() const;   // process that wrote the last message read from a queue; 0: not known
    int get_msg_count();       // messages written so far; -1 on error
    // Of all connection numbers that were used; empty: the buffer has no diagnostics, or on error.
    std::vector<nml::Diagnosis> get_diag_info();

    void disconnect();         // gives the buffer up; valid() is false then
    bool reconnect();          // connects anew, as the constructor did
    int reset();               // forgets the last error; what is not connected, or remote, connects anew: 0, or -1
    // Name and password for the server of a remote buffer, instead of those of the B line's passwd= file;
    // reconnects use them, too. 0: accepted, or the buffer is on this computer; -1.
    int login(const char *name, const char *password);
    // A message as text (encoding `disp`), and back: its type, or -1. The text is then the last message read.
    std::string msg2str(const NMLmsg &msg) const;
    NMLTYPE str2msg(const std::string &text);

    NMLmsg *get_address() { return reinterpret_cast<NMLmsg *>(local_.data()); } // last message read
    template <class T> T *get() { return static_cast<T *>(get_address()); }

    NML_ERROR_TYPE error_type = NML_NO_ERROR;
    CMS_STATUS status = CMS_STATUS_NOT_SET;

    const nml::MessageSet &messages() const { return set_; }
    nml::Transport *transport() { return transport_.get(); }
    const std::string &buffer_name() const { return buffer_; }
    bool remote() const { return remote_; } // reached over TCP
    const nml::Connection *connection() const { return connection_.get(); } // null: not found in the file

private:
    NMLTYPE finish_read(CMS_STATUS s);
    CMS_STATUS set_status(CMS_STATUS s);
    const nml::MessageSet &set_;
    std::unique_ptr<nml::Connection> connection_; // null: not found in the file
    bool master_ = false;
    std::string buffer_, process_;
    std::vector<unsigned char> local_;
    std::unique_ptr<nml::Transport> transport_;
    bool can_read_ = true, can_write_ = true, remote_ = false;
    NMLTYPE force_type_ = 0;     // of the B line: every message is one of this type
    int64_t nap_ns_ = 1'000'000; // between the looks of a blocking read
};

// Tries every `seconds` until the connection is there; never gives up on anything but a wrong file.
std::unique_ptr<NML> nmlWaitOpen(const nml::MessageSet &set, const char *buffer, const char *process, const char *file,
                                 double seconds);
// File used when the constructor gets a null file. Initially the one of this installation.
void set_default_nml_config_file(const char *file);
const char *default_nml_config_file();
// Where B lines of .nml files read later say ALIAS, HOST is meant.
void nmlSetHostAlias(const char *host, const char *alias);
void nmlClearHostAliases();
// Makes all connections remote (local) whatever the P lines say; nullptr-safe, global.
void nmlForceRemoteConnection();
void nmlForceLocalConnection();

// Serves over TCP, on this computer, those connections of this process that serve their buffers (set_to_server,
// P lines), until *stop is set. nullptr: for ever. 0, or -1 when there is none or a port can't be had.
int run_nml_servers(const volatile int *stop = nullptr);

extern int verbose_nml_error_messages; // 1: errors are printed. The Python module sets 0.

#endif
