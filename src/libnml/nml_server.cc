// SPDX-License-Identifier: GPL-2.0-or-later
//
// nml_server.cc - see nml_server.hh. [task]; plain poll(2): it only reacts to clients.
#include "nml_server.hh"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <set>

#include "nml_code.hh"
#include "nml_wire.hh"
#include "rcs_print.hh"

namespace nml {

Server::~Server() {
    for (auto &l : listeners_) close(l.first);
    for (Client &c : clients_) close(c.fd);
}

void Server::add(NML &channel, const BufferLine &line) {
    if (line.tcp_port > 0) buffers_[{line.tcp_port, line.number}] = {&channel, line};
}

bool Server::listen(const std::string &address) {
    std::set<int> ports;
    for (auto &b : buffers_) ports.insert(b.first.first);
    for (int port : ports) {
        int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0), one = 1;
        sockaddr_in at{};
        at.sin_family = AF_INET;
        at.sin_port = htons(static_cast<uint16_t>(instance_port(port)));
        inet_pton(AF_INET, address.c_str(), &at.sin_addr);
        setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &one, sizeof one);
        if (bind(fd, reinterpret_cast<sockaddr *>(&at), sizeof at) != 0 || ::listen(fd, 5) != 0) {
            rcs_print_error("NML server: port %d: %s\n", instance_port(port), strerror(errno));
            close(fd);
            continue;
        }
        listeners_.emplace_back(fd, port);
    }
    return !listeners_.empty();
}

void Server::reply_read(Client &c, uint32_t serial, Buffer &b, uint32_t access, int last_id) {
    Transport *t = b.channel->transport();
    std::vector<unsigned char> raw(static_cast<size_t>(t->max_message())), body;
    long size = 0;
    t->set_last_id(last_id);
    CMS_STATUS s = access == ACCESS_PEEK ? t->peek(raw.data(), &size) : t->read(raw.data(), &size);
    if (s == CMS_READ_OK) {
        body = encode_message(set_, *reinterpret_cast<NMLmsg *>(raw.data()));
        if (body.empty()) s = CMS_SERVER_SIDE_ERROR;
    }
    int was_read = 0;
    t->check_if_read(&was_read);
    put_word(c.out, serial);
    put_word(c.out, static_cast<uint32_t>(s));
    put_word(c.out, static_cast<uint32_t>(body.size()));
    put_word(c.out, static_cast<uint32_t>(t->last_id()));
    put_word(c.out, static_cast<uint32_t>(was_read));
    c.out.insert(c.out.end(), body.begin(), body.end());
}

// One request. False: the client is to be dropped.
bool Server::answer(Client &c, const unsigned char *head, const unsigned char *data, size_t size) {
    uint32_t serial = get_word(head), type = get_word(head + 4), number = get_word(head + 8), w3 = get_word(head + 12), w4 = get_word(head + 16);
    auto it = buffers_.find({c.port, static_cast<int>(number)});
    auto words = [&](std::initializer_list<uint32_t> w) { for (uint32_t v : w) put_word(c.out, v); };
    if (it == buffers_.end()) {
        if (type == REQ_CLOSE_CHANNEL) return false;
        words({serial, static_cast<uint32_t>(CMS_SERVER_SIDE_ERROR), 0, 0, 0});
        return true;
    }
    Buffer &b = it->second;
    Transport *t = b.channel->transport();
    int n = 0;
    long bytes = 0;
    switch (type) {
    case REQ_READ: reply_read(c, serial, b, w3, static_cast<int>(w4)); return true;
    case REQ_BLOCKING_READ: reply_read(c, serial, b, w3, static_cast<int>(w4)); return true; // the client polls
    case REQ_WRITE:
        {
            std::vector<unsigned char> raw(static_cast<size_t>(std::max(t->max_message(), static_cast<long>(sizeof(NMLmsg)))));
            NMLmsg *m = reinterpret_cast<NMLmsg *>(raw.data());
            CMS_STATUS s = CMS_UPDATE_ERROR;
            int id = 0;
            if (decode_message(set_, data, size, m, raw.size())) {
                b.channel->write_raw(*m, w3 == ACCESS_WRITE_IF_READ, &id);
                s = b.channel->status;
            }
            if (b.line.confirm_write) words({static_cast<uint32_t>(id), static_cast<uint32_t>(s), 0});
            return s != CMS_UPDATE_ERROR;
        }
    case REQ_CHECK_IF_READ: { CMS_STATUS s = t->check_if_read(&n); words({serial, static_cast<uint32_t>(s), static_cast<uint32_t>(n)}); return true; }
    case REQ_CLEAR: words({serial, static_cast<uint32_t>(t->clear())}); return true;
    case REQ_CLOSE_CHANNEL: return false;
    case REQ_GET_KEYS: words({serial, 0, 0, 0, 0}); return true;
    case REQ_LOGIN: words({serial, 1}); return true;
    case REQ_SET_SUBSCRIPTION: case REQ_CANCEL_SUBSCRIPTION: words({serial, 0}); return true; // not offered: the client polls
    case REQ_GET_BUF_NAME:
        {
            words({serial, static_cast<uint32_t>(CMS_STATUS_NOT_SET)});
            char name[NAME_BYTES] = "";
            strncpy(name, b.line.name.c_str(), sizeof name - 1);
            c.out.insert(c.out.end(), name, name + sizeof name);
            return true;
        }
    case REQ_SET_DIAG_INFO: return true;
    case REQ_GET_MSG_COUNT: { CMS_STATUS s = t->message_count(&n); words({serial, static_cast<uint32_t>(s), static_cast<uint32_t>(n)}); return true; }
    case REQ_GET_QUEUE_LENGTH: { CMS_STATUS s = t->queue_length(&n); words({serial, static_cast<uint32_t>(s), static_cast<uint32_t>(n)}); return true; }
    case REQ_GET_SPACE_AVAILABLE: { CMS_STATUS s = t->space_available(&bytes); words({serial, static_cast<uint32_t>(s), static_cast<uint32_t>(bytes)}); return true; }
    default: return false;
    }
}

// Takes whole requests from the input. False: garbage.
bool Server::consume(Client &c) {
    for (;;) {
        if (c.in.size() < REQUEST_BYTES) return true;
        uint32_t type = get_word(c.in.data() + 4), w4 = get_word(c.in.data() + 16);
        size_t extra = 0;
        switch (type) {
        case REQ_WRITE: extra = w4; break;
        case REQ_GET_KEYS: extra = 16; break;
        case REQ_LOGIN: extra = 32; break;
        case REQ_BLOCKING_READ: extra = 4; break;
        case REQ_SET_DIAG_INFO: extra = 68; break;
        default: break;
        }
        if (extra > MAX_REQUEST_DATA || type < REQ_READ || type > REQ_GET_SPACE_AVAILABLE) {
            rcs_print_error("NML server: %s sent what is no request (type %u, %zu bytes); dropped\n", c.peer.c_str(), type, extra);
            return false;
        }
        if (c.in.size() < REQUEST_BYTES + extra) return true;
        if (!answer(c, c.in.data(), c.in.data() + REQUEST_BYTES, extra)) {
            if (type != REQ_CLOSE_CHANNEL) rcs_print_error("NML server: %s sent a request that can not be read (type %u); dropped\n", c.peer.c_str(), type);
            return false;
        }
        c.in.erase(c.in.begin(), c.in.begin() + static_cast<std::ptrdiff_t>(REQUEST_BYTES + extra));
        if (c.out.size() > 1000000) return false; // does not read its answers
    }
}

void Server::run(const volatile int *stop) {
    while (!*stop) {
        std::vector<pollfd> fds;
        for (auto &l : listeners_) fds.push_back({l.first, POLLIN, 0});
        for (Client &c : clients_) fds.push_back({c.fd, static_cast<short>(POLLIN | (c.out.empty() ? 0 : POLLOUT)), 0});
        if (::poll(fds.data(), fds.size(), 200) <= 0) continue;
        size_t n = listeners_.size();
        std::vector<Client> kept;
        for (size_t i = 0; i < clients_.size(); i++) {
            Client &c = clients_[i];
            short ev = fds[n + i].revents;
            bool good = !(ev & (POLLERR | POLLNVAL));
            if (good && (ev & (POLLIN | POLLHUP))) {
                unsigned char buf[8192];
                ssize_t r = recv(c.fd, buf, sizeof buf, 0);
                if (r > 0) {
                    c.in.insert(c.in.end(), buf, buf + r);
                    good = consume(c);
                } else {
                    good = r < 0 && (errno == EAGAIN || errno == EINTR);
                }
            }
            if (good && !c.out.empty()) {
                ssize_t r = send(c.fd, c.out.data(), c.out.size(), MSG_NOSIGNAL);
                if (r > 0) c.out.erase(c.out.begin(), c.out.begin() + r);
                else good = r < 0 && (errno == EAGAIN || errno == EINTR);
            }
            if (good) kept.push_back(std::move(c));
            else close(c.fd);
        }
        clients_.swap(kept);
        for (size_t i = 0; i < n; i++) {
            if (!(fds[i].revents & POLLIN)) continue;
            sockaddr_in from{};
            socklen_t len = sizeof from;
            int fd = accept4(listeners_[i].first, reinterpret_cast<sockaddr *>(&from), &len, SOCK_CLOEXEC | SOCK_NONBLOCK);
            if (fd < 0) continue;
            int one = 1;
            setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
            char text[INET_ADDRSTRLEN] = "?";
            inet_ntop(AF_INET, &from.sin_addr, text, sizeof text);
            clients_.push_back({fd, listeners_[i].second, std::string(text) + ":" + std::to_string(ntohs(from.sin_port)), {}, {}});
        }
    }
}

} // namespace nml
