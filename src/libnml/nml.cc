// SPDX-License-Identifier: GPL-2.0-or-later
//
// nml.cc - the client's view of a buffer: checks, statuses, types. See nml.hh.
#include "nml.hh"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <mutex>

#include "kerf_clock.h"
#include "kerf_paths.h"
#include "nml_code.hh"
#include "nml_server.hh"
#include "nml_transport.hh"
#include "rcs_print.hh"

namespace nml {

MessageSet::MessageSet(std::vector<MessageType> types) : types_(std::move(types)) {
    std::sort(types_.begin(), types_.end(), [](const MessageType &a, const MessageType &b) { return a.type < b.type; });
}

const MessageType *MessageSet::find(NMLTYPE type) const {
    auto it = std::lower_bound(types_.begin(), types_.end(), type,
                               [](const MessageType &m, NMLTYPE t) { return m.type < t; });
    return it != types_.end() && it->type == type ? &*it : nullptr;
}

const char *MessageSet::name(NMLTYPE type) const {
    const MessageType *m = find(type);
    return m ? m->name : "UNKNOWN";
}

// Those of this process whose buffer was found, for run_nml_servers.
static std::mutex all_guard;
static std::vector<NML *> all_connections;

} // namespace nml

NML_ERROR_TYPE nml_error_of(CMS_STATUS status) {
    switch (status) {
    case CMS_TIMED_OUT: return NML_TIMED_OUT;
    case CMS_QUEUE_FULL: return NML_QUEUE_FULL_ERROR;
    case CMS_NO_MASTER_ERROR: return NML_NO_MASTER_ERROR;
    case CMS_WRITE_WAS_BLOCKED: return NML_BUFFER_NOT_READ;
    case CMS_RESOURCE_CONFLICT_ERROR: case CMS_CREATE_ERROR: case CMS_CONFIG_ERROR: return NML_INVALID_CONFIGURATION;
    case CMS_STATUS_NOT_SET:
    case CMS_READ_OLD:
    case CMS_READ_OK:
    case CMS_WRITE_OK:
    case CMS_CLEAR_OK: return NML_NO_ERROR;
    default: return NML_INTERNAL_CMS_ERROR;
    }
}

static std::string &default_file() {
    static std::string file;
    return file;
}

void set_default_nml_config_file(const char *file) { default_file() = file ? file : ""; }

const char *default_nml_config_file() {
    return default_file().empty() ? kerf_path(KERF_PATH_NMLFILE) : default_file().c_str();
}

NML::NML(const nml::MessageSet &set, const char *buffer, const char *process, const char *file, int set_to_server,
         int set_to_master)
    : set_(set), buffer_(buffer, strnlen(buffer, 39)), process_(process, strnlen(process, 39)) {
    std::string path = file ? std::string(file, strnlen(file, 159)) : default_nml_config_file();
    auto c = nml::find_connection(path, buffer_, process_);
    if (!c) { set_status(CMS_CONFIG_ERROR); return; }
    master_ = set_to_master > 0 || (set_to_master == 0 && c->process.master);
    if (set_to_server > 0) c->process.server = 1;
    if (set_to_server < 0) c->process.server = 0;
    remote_ = c->process.kind == nml::ProcessKind::remote;
    force_type_ = c->buffer.force_type;
    if (remote_) nap_ns_ = static_cast<int64_t>(std::max(c->buffer.poll_interval, 0.02) * 1e9);
    can_read_ = c->process.read || c->process.server;
    can_write_ = c->process.write || c->process.server;
    connection_ = std::make_unique<nml::Connection>(*c);
    reconnect();
    std::lock_guard<std::mutex> hold(nml::all_guard);
    nml::all_connections.push_back(this);
}

NML::~NML() {
    std::lock_guard<std::mutex> hold(nml::all_guard);
    auto &all = nml::all_connections;
    all.erase(std::remove(all.begin(), all.end(), this), all.end());
}

void NML::disconnect() {
    transport_.reset();
    set_status(CMS_CLOSED);
}

bool NML::reconnect() {
    if (!connection_) return false;
    const nml::Connection &c = *connection_;
    transport_.reset(); // before the next one: it may be the same place
    if (c.process.kind == nml::ProcessKind::phantom || c.buffer.kind == nml::BufferKind::phantom)
        transport_ = nml::open_phantom(c);
    else if (c.process.kind == nml::ProcessKind::remote) transport_ = nml::open_tcp(c, set_);
    else if (c.buffer.kind == nml::BufferKind::locmem) transport_ = nml::open_local_memory(c);
    else transport_ = nml::open_shared_memory(c, master_);
    set_status(transport_->open_status());
    if (error_type != NML_NO_ERROR) {
        transport_.reset();
        return false;
    }
    local_.resize(static_cast<size_t>(std::max(transport_->max_message(), static_cast<long>(sizeof(NMLmsg)))));
    return true;
}

int NML::reset() {
    if (!transport_ || remote_) return reconnect() ? 0 : -1;
    set_status(CMS_STATUS_NOT_SET);
    return 0;
}

int NML::login(const char *name, const char *password) {
    if (!connection_ || !name || !password) return -1;
    connection_->login_name = name;
    connection_->login_password = password;
    if (!remote_) return valid() ? 0 : -1;
    if (!transport_) return reconnect() ? 0 : -1;
    return transport_->login(name, password) ? 0 : -1;
}

int run_nml_servers(const volatile int *stop) {
    nml::Server server;
    bool any = false;
    {
        std::lock_guard<std::mutex> hold(nml::all_guard);
        for (NML *channel : nml::all_connections) {
            const nml::Connection &c = *channel->connection();
            if (c.process.server != 1 || c.buffer.tcp_port <= 0 || !channel->valid()) continue;
            server.add(*channel, c.buffer);
            any = true;
        }
    }
    if (!any || !server.listen()) return -1;
    static const volatile int never = 0;
    server.run(stop ? stop : &never);
    return 0;
}

std::unique_ptr<NML> nmlWaitOpen(const nml::MessageSet &set, const char *buffer, const char *process, const char *file,
                                 double seconds) {
    for (;;) {
        auto channel = std::make_unique<NML>(set, buffer, process, file);
        if (channel->valid() || channel->status == CMS_CONFIG_ERROR) return channel;
        kerf_clock_sleep_ns(static_cast<int64_t>(seconds * 1e9));
    }
}

CMS_STATUS NML::set_status(CMS_STATUS s) {
    status = s;
    error_type = nml_error_of(s);
    return s;
}

bool NML::valid() {
    if (!transport_) {
        if (error_type == NML_NO_ERROR) error_type = NML_INVALID_CONFIGURATION;
        return false;
    }
    return true;
}

NMLTYPE NML::finish_read(CMS_STATUS s) {
    set_status(s);
    if (s == CMS_READ_OLD) return 0;
    if (s != CMS_READ_OK) return -1;
    if (force_type_ > 0) reinterpret_cast<NMLmsg *>(local_.data())->_type = force_type_;
    NMLTYPE type = get_address()->_type;
    if (type <= 0) {
        rcs_print_error("New data received but type of %d is invalid.\n", type);
        return -1;
    }
    return type;
}

NMLTYPE NML::read() {
    if (!valid()) return -1;
    if (!can_read_) {
        rcs_print_error("CMS: %s was not configured to read %s\n", process_.c_str(), buffer_.c_str());
        set_status(CMS_PERMISSIONS_ERROR);
        return -1;
    }
    long size = 0;
    return finish_read(transport_->read(local_.data(), &size));
}

NMLTYPE NML::peek() {
    if (!valid()) return -1;
    if (!can_read_) {
        rcs_print_error("CMS: %s was not configured to read %s\n", process_.c_str(), buffer_.c_str());
        set_status(CMS_PERMISSIONS_ERROR);
        return -1;
    }
    long size = 0;
    return finish_read(transport_->peek(local_.data(), &size));
}

NMLTYPE NML::blocking_read(double t) {
    int64_t until = kerf_clock_now_ns() + static_cast<int64_t>(t * 1e9);
    for (;;) {
        NMLTYPE type = read();
        if (type != 0) return type;
        int64_t now = kerf_clock_now_ns(), nap = nap_ns_;
        if (t >= 0) {
            nap = std::max(int64_t(1000000), std::min(nap, static_cast<int64_t>(t * 0.5e9)));
            if (now >= until) { set_status(CMS_TIMED_OUT); return 0; }
            nap = std::min(nap, until - now);
        }
        kerf_clock_sleep_ns(nap);
    }
}

#pragma GCC diagnostic ignored "-Winvalid-offsetof" // single inheritance of plain data: the offset is fixed

static int write_message(NML &n, nml::Transport *to, const nml::MessageSet &set, NMLmsg &msg, bool only_if_read,
                         int *serial) {
    const nml::MessageType *m = set.find(msg._type);
    bool command = m && m->kind == nml::Kind::command;
    int id = 0;
    long at = command ? static_cast<long>(offsetof(RCS_CMD_MSG, serial_number)) : -1;
    if (msg.size <= 0 || msg._type <= 0) {
        n.error_type = NML_INVALID_MESSAGE_ERROR;
        rcs_print_error("NML: a message of type %d and size %ld can not be written.\n", msg._type, msg.size);
        if (msg.size < 0) return -1;
    }
    NML_ERROR_TYPE before = n.error_type;
    n.status = to->write(reinterpret_cast<const unsigned char *>(&msg), msg.size, at, only_if_read, &id);
    n.error_type = nml_error_of(n.status);
    if (n.status == CMS_INSUFFICIENT_SPACE_ERROR) n.error_type = NML_FORMAT_ERROR;
    if (n.error_type == NML_NO_ERROR && before == NML_INVALID_MESSAGE_ERROR && (msg.size <= 0 || msg._type <= 0))
        n.error_type = before;
    if (n.status != CMS_WRITE_OK) return -1;
    if (command) static_cast<RCS_CMD_MSG &>(msg).serial_number = id;
    if (serial) *serial = id;
    return 0;
}

int NML::write(NMLmsg &msg, int *serial) {
    if (!valid()) return -1;
    if (!can_write_) {
        rcs_print_error("CMS: %s was not configured to write to %s\n", process_.c_str(), buffer_.c_str());
        set_status(CMS_PERMISSIONS_ERROR);
        return -1;
    }
    return write_message(*this, transport_.get(), set_, msg, false, serial);
}

int NML::write_if_read(NMLmsg &msg, int *serial) {
    if (!valid()) return -1;
    if (!can_write_) { set_status(CMS_PERMISSIONS_ERROR); return -1; }
    return write_message(*this, transport_.get(), set_, msg, true, serial);
}

int NML::write_raw(NMLmsg &msg, bool only_if_read, int *serial) {
    if (!valid()) return -1;
    return write_message(*this, transport_.get(), set_, msg, only_if_read, serial);
}

int NML::check_if_read() {
    int r = 0;
    if (!valid() || set_status(transport_->check_if_read(&r)) < 0) return -1;
    return r;
}

int NML::clear() {
    if (!valid()) return -1;
    return set_status(transport_->clear()) == CMS_CLEAR_OK ? 0 : -1;
}

int NML::get_queue_length() {
    int n = -1;
    if (!valid() || set_status(transport_->queue_length(&n)) < 0) return -1;
    return n;
}

long NML::get_space_available() {
    long n = -1;
    if (!valid() || set_status(transport_->space_available(&n)) < 0) return -1;
    return n;
}

std::vector<nml::Diagnosis> NML::get_diag_info() {
    std::vector<nml::Diagnosis> all;
    if (valid()) set_status(transport_->diagnose(&all));
    return all;
}

std::string NML::msg2str(const NMLmsg &msg) const {
    const std::vector<unsigned char> text = nml::encode_message(set_, msg, nml::Coding::disp);
    return std::string(text.begin(), text.end());
}

NMLTYPE NML::str2msg(const std::string &text) {
    const bool good = nml::decode_message(set_, reinterpret_cast<const unsigned char *>(text.data()), text.size(),
                                          get_address(), local_.size(), nml::Coding::disp);
    return good ? get_address()->_type : -1;
}

int NML::last_writer() const { return transport_ ? transport_->last_writer() : 0; }

int NML::get_msg_count() {
    int n = -1;
    if (!valid() || set_status(transport_->message_count(&n)) < 0) return -1;
    return n;
}
