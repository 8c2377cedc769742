// SPDX-License-Identifier: GPL-2.0-or-later
//
// nml_transport.hh - where the messages of one connection go to: shared memory, this
// process, TCP, nowhere. One object per connection, used by one thread at a time.
#ifndef KERF_NML_TRANSPORT_HH
#define KERF_NML_TRANSPORT_HH

#include "nml.hh"
#include "nml_config.hh"

namespace nml {

// Bytes of bookkeeping that the documented layout takes from a buffer's size.
constexpr long NAME_BYTES = 32, VALUE_HEADER_BYTES = 24, QUEUE_HEADER_BYTES = 40, MESSAGE_HEADER_BYTES = 24;

class Transport {
public:
    virtual ~Transport() = default;
    virtual CMS_STATUS open_status() const = 0;      // why the connection failed, or CMS_STATUS_NOT_SET
    virtual long max_message() const = 0;            // bytes
    // Into data (max_message() bytes); *id is the caller's last id and is updated.
    virtual CMS_STATUS read(unsigned char *data, long *size) = 0;
    virtual CMS_STATUS peek(unsigned char *data, long *size) = 0;
    // serial: where in data the write id goes (an int), or -1. Returns the id in *id.
    virtual CMS_STATUS write(const unsigned char *data, long size, long serial_offset, bool only_if_read, int *id) = 0;
    virtual CMS_STATUS check_if_read(int *was_read) = 0;
    virtual CMS_STATUS clear() = 0;
    virtual CMS_STATUS queue_length(int *length) = 0;
    virtual CMS_STATUS space_available(long *bytes) = 0;
    virtual CMS_STATUS message_count(int *count) = 0;
    virtual CMS_STATUS diagnose(std::vector<Diagnosis> *) { return CMS_NO_IMPLEMENTATION_ERROR; }
    virtual bool login(const std::string &, const std::string &) { return true; } // name, password; false: refused
    // Number of the last message read, as read() compares it; a server sets its client's.
    virtual int last_id() const { return 0; }
    virtual void set_last_id(int) {}
    // The process that wrote the last message read from a queue; 0: not known.
    virtual int last_writer() const { return 0; }
};

std::unique_ptr<Transport> open_shared_memory(const Connection &c, bool master);
std::unique_ptr<Transport> open_local_memory(const Connection &c);
std::unique_ptr<Transport> open_phantom(const Connection &c);
std::unique_ptr<Transport> open_tcp(const Connection &c, const MessageSet &set);

// TCP port p as this instance uses it (the default instance: p itself).
int instance_port(int p);

} // namespace nml
#endif
