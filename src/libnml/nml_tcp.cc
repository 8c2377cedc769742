// SPDX-License-Identifier: GPL-2.0-or-later
//
// nml_tcp.cc - a buffer on another machine: one TCP connection, one request at a time.
//
// Each request waits at most the P line's timeout (wall time) for its reply; then the
// connection is closed, the call returns CMS_TIMED_OUT, and the next call connects again.
#include <fcntl.h>
#include <netdb.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>

#include "kerf_clock.h"
#include "nml_auth.hh"
#include "nml_code.hh"
#include "nml_transport.hh"
#include "nml_wire.hh"
#include "rcs_print.hh"

namespace nml {
namespace {

class Tcp : public Transport {
public:
    Tcp(const Connection &c, const MessageSet &set) : conn_(c), set_(set) {
        if (c.buffer.tcp_port <= 0) { open_status_ = CMS_CONFIG_ERROR; return; }
        open_status_ = reconnect() ? CMS_STATUS_NOT_SET : CMS_NO_SERVER_ERROR;
    }
    ~Tcp() override { drop(); }
    CMS_STATUS open_status() const override { return open_status_; }
    long max_message() const override { return conn_.buffer.size; }

    CMS_STATUS read(unsigned char *data, long *size) override { return fetch(ACCESS_READ, data, size); }
    CMS_STATUS peek(unsigned char *data, long *size) override { return fetch(ACCESS_PEEK, data, size); }

    CMS_STATUS write(const unsigned char *data, long, long, bool only_if_read, int *id) override {
        const NMLmsg &m = *reinterpret_cast<const NMLmsg *>(data);
        std::vector<unsigned char> body = encode_message(set_, m, conn_.buffer.coding);
        if (body.empty()) return CMS_UPDATE_ERROR;
        if (conn_.buffer.enc_max_size > 0 && body.size() > static_cast<size_t>(conn_.buffer.enc_max_size))
            return CMS_INSUFFICIENT_SPACE_ERROR;
        std::vector<unsigned char> reply(conn_.buffer.confirm_write ? 12 : 0);
        CMS_STATUS s = exchange(REQ_WRITE, only_if_read ? ACCESS_WRITE_IF_READ : ACCESS_WRITE,
                                static_cast<uint32_t>(body.size()), body, reply.data(), reply.size());
        if (s != CMS_STATUS_NOT_SET) return s;
        if (reply.empty()) { if (id) *id = 0; return CMS_WRITE_OK; }
        if (id) *id = static_cast<int>(get_word(reply.data()));
        return static_cast<CMS_STATUS>(static_cast<int32_t>(get_word(reply.data() + 4)));
    }

    CMS_STATUS check_if_read(int *was_read) override {
        unsigned char r[12];
        CMS_STATUS s = exchange(REQ_CHECK_IF_READ, 0, 0, {}, r, sizeof r);
        if (s == CMS_STATUS_NOT_SET) {
            *was_read = static_cast<int>(get_word(r + 8));
            s = static_cast<CMS_STATUS>(static_cast<int32_t>(get_word(r + 4)));
        }
        return s;
    }
    CMS_STATUS clear() override {
        unsigned char r[8];
        CMS_STATUS s = exchange(REQ_CLEAR, 0, 0, {}, r, sizeof r);
        return s == CMS_STATUS_NOT_SET ? static_cast<CMS_STATUS>(static_cast<int32_t>(get_word(r + 4))) : s;
    }
    CMS_STATUS queue_length(int *n) override { return number(REQ_GET_QUEUE_LENGTH, n); }
    CMS_STATUS message_count(int *n) override { return number(REQ_GET_MSG_COUNT, n); }
    CMS_STATUS space_available(long *bytes) override {
        int n = 0;
        CMS_STATUS s = number(REQ_GET_SPACE_AVAILABLE, &n);
        *bytes = n;
        return s;
    }

    CMS_STATUS diagnose(std::vector<Diagnosis> *all) override {
        unsigned char head[12], r[4 + DIAG_NAME_BYTES + 4 + 5 * 8];
        CMS_STATUS s = exchange(REQ_GET_DIAG_INFO, 0, 0, {}, head, sizeof head);
        if (s != CMS_STATUS_NOT_SET) return s;
        for (uint32_t n = get_word(head + 8); n > 0; n--) {
            if (!receive(r, sizeof r)) return CMS_TIMED_OUT;
            const unsigned char *name = r + 4, *v = r + 4 + DIAG_NAME_BYTES;
            all->push_back({static_cast<int>(get_word(r)),
                            std::string(reinterpret_cast<const char *>(name),
                                        strnlen(reinterpret_cast<const char *>(name), DIAG_NAME_BYTES)),
                            static_cast<int>(get_word(v)), get_long(v + 4), get_long(v + 12), get_long(v + 20),
                            get_long(v + 28), static_cast<double>(get_long(v + 36)) * 1e-9});
        }
        return static_cast<CMS_STATUS>(static_cast<int32_t>(get_word(head + 4)));
    }

    bool login(const std::string &name, const std::string &password) override {
        conn_.login_name = name;
        conn_.login_password = password;
        return fd_ < 0 ? reconnect() : login();
    }

private:
    CMS_STATUS number(Request what, int *n) {
        unsigned char r[12];
        CMS_STATUS s = exchange(what, 0, 0, {}, r, sizeof r);
        if (s != CMS_STATUS_NOT_SET) return s;
        *n = static_cast<int>(get_word(r + 8));
        return static_cast<CMS_STATUS>(static_cast<int32_t>(get_word(r + 4)));
    }

    CMS_STATUS fetch(Access access, unsigned char *data, long *size) {
        unsigned char r[20];
        CMS_STATUS s = exchange(REQ_READ, access, static_cast<uint32_t>(last_id_), {}, r, sizeof r);
        if (s != CMS_STATUS_NOT_SET) return s;
        s = static_cast<CMS_STATUS>(static_cast<int32_t>(get_word(r + 4)));
        uint32_t bytes = get_word(r + 8);
        if (bytes > 1000000) { drop(); return CMS_SERVER_SIDE_ERROR; }
        std::vector<unsigned char> body(bytes);
        if (bytes && !receive(body.data(), bytes)) return CMS_TIMED_OUT;
        if (s == CMS_READ_OK) {
            if (!decode_message(set_, body.data(), body.size(), reinterpret_cast<NMLmsg *>(data),
                                static_cast<size_t>(max_message()), conn_.buffer.coding))
                return CMS_UPDATE_ERROR;
            *size = reinterpret_cast<NMLmsg *>(data)->size;
            last_id_ = static_cast<int>(get_word(r + 12));
        }
        return s;
    }

    CMS_STATUS exchange(Request what, uint32_t w3, uint32_t w4, const std::vector<unsigned char> &body,
                        unsigned char *reply, size_t reply_size) {
        if (fd_ < 0 && !reconnect()) return CMS_NO_SERVER_ERROR;
        std::vector<unsigned char> out;
        put_word(out, static_cast<uint32_t>(serial_++));
        put_word(out, what);
        put_word(out, static_cast<uint32_t>(conn_.buffer.number));
        put_word(out, w3);
        put_word(out, w4);
        out.insert(out.end(), body.begin(), body.end());
        if (!transmit(out.data(), out.size())) return CMS_NO_SERVER_ERROR;
        if (reply_size && !receive(reply, reply_size)) return CMS_TIMED_OUT;
        return CMS_STATUS_NOT_SET;
    }

    int timeout_ms() const {
        return conn_.process.timeout < 0 ? -1 : std::max(1, static_cast<int>(conn_.process.timeout * 1000));
    }

    bool transmit(const unsigned char *p, size_t n) {
        while (n > 0) {
            ssize_t r = send(fd_, p, n, MSG_NOSIGNAL);
            if (r < 0 && (errno == EAGAIN || errno == EINTR)) {
                pollfd f{fd_, POLLOUT, 0};
                if (::poll(&f, 1, timeout_ms()) > 0) continue;
            }
            if (r <= 0) { drop(); return false; }
            p += r;
            n -= static_cast<size_t>(r);
        }
        return true;
    }

    bool receive(unsigned char *p, size_t n) {
        kerf_clock_suspend(); // the answer comes from outside: time goes on
        bool good = true;
        while (n > 0) {
            pollfd f{fd_, POLLIN, 0};
            int ready = ::poll(&f, 1, timeout_ms());
            if (ready < 0 && errno == EINTR) continue;
            ssize_t r = ready > 0 ? recv(fd_, p, n, 0) : 0;
            if (r < 0 && (errno == EINTR || errno == EAGAIN)) continue;
            if (r <= 0) { drop(); good = false; break; }
            p += r;
            n -= static_cast<size_t>(r);
        }
        kerf_clock_resume();
        return good;
    }

    bool reconnect() {
        addrinfo want{}, *found = nullptr;
        want.ai_socktype = SOCK_STREAM;
        std::string port = std::to_string(instance_port(conn_.buffer.tcp_port));
        // localhost is this computer, with or without /etc/hosts (RFC 6761)
        const std::string host = conn_.buffer.host == "localhost" ? "127.0.0.1" : conn_.buffer.host;
        if (getaddrinfo(host.c_str(), port.c_str(), &want, &found) != 0) return false;
        for (addrinfo *a = found; a && fd_ < 0; a = a->ai_next) {
            int fd = socket(a->ai_family, a->ai_socktype | SOCK_CLOEXEC, a->ai_protocol);
            if (fd < 0) continue;
            fcntl(fd, F_SETFL, O_NONBLOCK);
            int r = connect(fd, a->ai_addr, a->ai_addrlen);
            if (r < 0 && errno == EINPROGRESS) {
                pollfd f{fd, POLLOUT, 0};
                int error = 0;
                socklen_t len = sizeof error;
                if (::poll(&f, 1, timeout_ms()) > 0 && getsockopt(fd, SOL_SOCKET, SO_ERROR, &error, &len) == 0 &&
                    error == 0)
                    r = 0;
            }
            if (r == 0) {
                int one = 1;
                setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
                fd_ = fd;
                serial_ = 0;
            } else {
                close(fd);
            }
        }
        freeaddrinfo(found);
        if (fd_ >= 0 && !right_buffer()) {
            rcs_print_error("NML: buffer %d at %s port %s is not %s\n", conn_.buffer.number, conn_.buffer.host.c_str(),
                            port.c_str(), conn_.buffer.name.c_str());
            drop();
            return false;
        }
        const bool named = !conn_.login_name.empty();
        if (fd_ >= 0 && (named || !conn_.buffer.passwd.empty()) && !login()) {
            rcs_print_error("NML: the server of buffer %s at %s refuses the login of %s\n", conn_.buffer.name.c_str(),
                            conn_.buffer.host.c_str(), (named ? conn_.login_name : conn_.buffer.passwd).c_str());
            drop();
            return false;
        }
        if (fd_ < 0)
            rcs_print_error("NML: no server for buffer %s at %s port %s\n", conn_.buffer.name.c_str(),
                            conn_.buffer.host.c_str(), port.c_str());
        return fd_ >= 0;
    }

    // The first request of a classic client: what the buffer of this number is called.
    bool right_buffer() {
        unsigned char r[8 + NAME_BYTES];
        if (exchange(REQ_GET_BUF_NAME, 0, 0, {}, r, sizeof r) != CMS_STATUS_NOT_SET) return false;
        return strncmp(reinterpret_cast<const char *>(r + 8), conn_.buffer.name.c_str(), NAME_BYTES - 1) == 0;
    }

    // Answers the server's challenge; the password itself stays here.
    bool login() {
        std::string problem;
        std::vector<Login> logins{{conn_.login_name, conn_.login_password}};
        if (conn_.login_name.empty()) logins = read_logins(conn_.buffer.passwd, &problem);
        if (logins.empty()) { rcs_print_error("NML: %s\n", problem.c_str()); return false; }
        std::string name = logins[0].name.substr(0, 16);
        std::vector<unsigned char> body(16), keys(20), result(8);
        std::copy(conn_.buffer.name.begin(),
                  conn_.buffer.name.begin() +
                      static_cast<std::ptrdiff_t>(std::min<size_t>(16, conn_.buffer.name.size())),
                  body.begin());
        if (exchange(REQ_GET_KEYS, 0, 0, body, keys.data(), keys.size()) != CMS_STATUS_NOT_SET) return false;
        std::string answer = hmac(logins[0].password, std::string(keys.begin() + 4, keys.end()) + name).substr(0, 16);
        body.assign(32, 0);
        std::copy(name.begin(), name.end(), body.begin());
        std::copy(answer.begin(), answer.end(), body.begin() + 16);
        if (exchange(REQ_LOGIN, 0, 0, body, result.data(), result.size()) != CMS_STATUS_NOT_SET) return false;
        return get_word(result.data() + 4) == 1;
    }

    void drop() {
        if (fd_ >= 0) close(fd_);
        fd_ = -1;
    }

    Connection conn_;
    const MessageSet &set_;
    CMS_STATUS open_status_ = CMS_NO_SERVER_ERROR;
    int fd_ = -1, serial_ = 0, last_id_ = 0;
};

} // namespace

std::unique_ptr<Transport> open_tcp(const Connection &c, const MessageSet &set) {
    return std::make_unique<Tcp>(c, set);
}

} // namespace nml
