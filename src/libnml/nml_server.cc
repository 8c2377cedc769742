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

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <set>

#include "nml_auth.hh"
#include "nml_code.hh"
#include "nml_wire.hh"
#include "rcs_print.hh"

namespace nml {

constexpr size_t MOST_CLIENTS = 200, MOST_UNREAD = 1000000; // connections; bytes of answers that wait
constexpr size_t MOST_NEWS = 100000; // bytes that wait: a subscriber that is slower misses news
constexpr int WAKE_MS = 200, PENDING_MS = 5;
constexpr int MOST_AT_A_TURN = 4; // requests of one client before the next one has its turn
constexpr int64_t ROOM_RETRY_NS = 1'000'000, MOST_HELD_NS = 1'000'000'000;

static int64_t wall_ns() {
    timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec * 1000000000LL + t.tv_nsec;
}

// Text field of `room` bytes that need not end with a zero.
static std::string text_of(const unsigned char *p, size_t room) {
    return std::string(reinterpret_cast<const char *>(p), strnlen(reinterpret_cast<const char *>(p), room));
}

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
    sockaddr_in at{};
    at.sin_family = AF_INET;
    if (inet_pton(AF_INET, address == "*" ? "0.0.0.0" : address.c_str(), &at.sin_addr) != 1) {
        rcs_print_error("NML server: '%s' is no address of this computer\n", address.c_str());
        return false;
    }
    bool good = true;
    for (auto &b : buffers_) {
        std::string problem;
        if (!b.second.line.passwd.empty()) read_logins(b.second.line.passwd, &problem);
        else if (!is_loopback(reinterpret_cast<sockaddr *>(&at)))
            problem = "other computers need a password: add passwd=FILE to its B line";
        if (problem.empty()) continue;
        rcs_print_error("NML server: buffer %s is not served: %s\n", b.second.line.name.c_str(), problem.c_str());
        ports.erase(b.first.first);
        good = false;
    }
    for (int port : ports) {
        int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0), one = 1;
        at.sin_port = htons(static_cast<uint16_t>(instance_port(port)));
        setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &one, sizeof one);
        if (bind(fd, reinterpret_cast<sockaddr *>(&at), sizeof at) != 0 || ::listen(fd, SOMAXCONN) != 0) {
            rcs_print_error("NML server: port %d: %s: programs on other computers, and those that use TCP, are not served\n", instance_port(port), strerror(errno));
            close(fd);
            good = false;
            continue;
        }
        listeners_.emplace_back(fd, port);
    }
    return good && !listeners_.empty();
}

// Answers a read. only_new: nothing is answered, and false returned, when there is no new message.
bool Server::reply_read(Client &c, uint32_t serial, Buffer &b, uint32_t access, int last_id, bool only_new) {
    Transport *t = b.channel->transport();
    std::vector<unsigned char> raw(static_cast<size_t>(t->max_message())), body;
    long size = 0;
    t->set_last_id(last_id);
    CMS_STATUS s = access == ACCESS_PEEK ? t->peek(raw.data(), &size) : t->read(raw.data(), &size);
    if (only_new && s == CMS_READ_OLD) return false;
    if (s == CMS_READ_OK) {
        body = encode_message(b.channel->messages(), *reinterpret_cast<NMLmsg *>(raw.data()), b.line.coding);
        if (body.empty() || (b.line.enc_max_size > 0 && body.size() > static_cast<size_t>(b.line.enc_max_size))) {
            body.clear();
            s = CMS_SERVER_SIDE_ERROR;
        }
    }
    int was_read = 0;
    t->check_if_read(&was_read);
    put_word(c.out, serial);
    put_word(c.out, static_cast<uint32_t>(s));
    put_word(c.out, static_cast<uint32_t>(body.size()));
    put_word(c.out, static_cast<uint32_t>(t->last_id()));
    put_word(c.out, static_cast<uint32_t>(was_read));
    c.out.insert(c.out.end(), body.begin(), body.end());
    return true;
}

void Server::try_pending(Client &c) {
    Pending &p = c.pending;
    bool late = p.until >= 0 && wall_ns() >= p.until;
    if (reply_read(c, p.serial, buffers_.at({c.port, p.number}), p.access, p.last_id, !late)) p.any = false;
}

void Server::subscribe(Client &c, int number, uint32_t serial, uint32_t kind, uint32_t period_ms) {
    if (kind != SUBSCRIBE_POLLED && kind != SUBSCRIBE_VARIABLE) {
        put_word(c.out, serial);
        put_word(c.out, 0);
        return;
    }
    c.subscriptions[number] = {
        serial, kind == SUBSCRIBE_POLLED ? static_cast<int64_t>(std::min(period_ms, 3'600'000u)) * 1'000'000 : 0, 0, 0};
    put_word(c.out, serial);
    put_word(c.out, 1);
}

void Server::send_news(Client &c) {
    for (auto &[number, s] : c.subscriptions) {
        const int64_t now = wall_ns();
        if (now < s.next_ns) continue;
        Buffer &b = buffers_.at({c.port, number});
        while (c.out.size() < MOST_NEWS && reply_read(c, s.serial, b, ACCESS_READ, s.last_id, true)) {
            s.last_id = b.channel->transport()->last_id();
            s.next_ns = now + s.period_ns;
            if (s.period_ns > 0 || !b.line.queue) break;
        }
    }
}

void Server::reply_diagnosis(Client &c, uint32_t serial, Buffer &b) {
    std::vector<Diagnosis> all;
    const CMS_STATUS s = b.channel->transport()->diagnose(&all);
    put_word(c.out, serial);
    put_word(c.out, static_cast<uint32_t>(s));
    put_word(c.out, static_cast<uint32_t>(all.size()));
    for (const Diagnosis &d : all) {
        put_word(c.out, static_cast<uint32_t>(d.cnum));
        char name[DIAG_NAME_BYTES] = "";
        strncpy(name, d.process.c_str(), sizeof name - 1);
        c.out.insert(c.out.end(), name, name + sizeof name);
        put_word(c.out, static_cast<uint32_t>(d.pid));
        for (int64_t v : {d.reads, d.read_bytes, d.writes, d.write_bytes, static_cast<int64_t>(d.last * 1e9)})
            put_long(c.out, v);
    }
}

bool Server::login(Client &c, const unsigned char *data, Buffer &b) {
    std::string problem, name = text_of(data, 16), answer(reinterpret_cast<const char *>(data) + 16, 16),
                         challenge = std::move(c.challenge);
    c.challenge.clear(); // each is good for one answer
    if (challenge.empty()) return false;
    bool good = false;
    for (const Login &l : read_logins(b.line.passwd, &problem))
        good |= l.name == name && equal_secret(hmac(l.password, challenge + name).substr(0, 16), answer);
    if (!good)
        rcs_print_error("NML server: login of '%s' from %s to %s refused%s%s\n", name.c_str(), c.peer.c_str(),
                        b.line.name.c_str(), problem.empty() ? "" : ": ", problem.c_str());
    return good;
}

// One request. False: the client is to be dropped.
bool Server::answer(Client &c, const unsigned char *head, const unsigned char *data, size_t size) {
    uint32_t serial = get_word(head), type = get_word(head + 4), number = get_word(head + 8), w3 = get_word(head + 12),
             w4 = get_word(head + 16);
    if (!c.begun && type == REQ_GET_BUF_NAME && serial == 0) c.counts = 1; // how those begin
    c.begun = true;
    serial += c.counts;
    auto it = buffers_.find({c.port, static_cast<int>(number)});
    auto words = [&](std::initializer_list<uint32_t> w) { for (uint32_t v : w) put_word(c.out, v); };
    if (it == buffers_.end()) {
        if (type == REQ_CLOSE_CHANNEL) return false;
        words({serial, static_cast<uint32_t>(CMS_SERVER_SIDE_ERROR), 0, 0, 0});
        return true;
    }
    Buffer &b = it->second;
    if (!b.line.passwd.empty() && !c.trusted.count(static_cast<int>(number)) && type != REQ_GET_KEYS &&
        type != REQ_LOGIN && type != REQ_CLOSE_CHANNEL && type != REQ_GET_BUF_NAME) {
        rcs_print_error("NML server: %s wants %s without a login\n", c.peer.c_str(), b.line.name.c_str());
        return false;
    }
    Transport *t = b.channel->transport();
    int n = 0;
    long bytes = 0;
    switch (type) {
    case REQ_READ: reply_read(c, serial, b, w3, static_cast<int>(w4), false); return true;
    case REQ_BLOCKING_READ:
        {
            int32_t ms = static_cast<int32_t>(get_word(data));
            c.pending = {true,
                         serial,
                         w3,
                         static_cast<int>(w4),
                         static_cast<int>(number),
                         ms < 0 ? -1 : wall_ns() + ms * 1000000LL};
            try_pending(c);
            return true;
        }
    case REQ_WRITE:
        {
        std::vector<unsigned char> raw(
            static_cast<size_t>(std::max(t->max_message(), static_cast<long>(sizeof(NMLmsg)))));
        NMLmsg *m = reinterpret_cast<NMLmsg *>(raw.data());
        CMS_STATUS s = CMS_UPDATE_ERROR;
        int id = 0;
        if (decode_message(b.channel->messages(), data, size, m, raw.size(), b.line.coding)) {
            b.channel->write_raw(*m, w3 == ACCESS_WRITE_IF_READ, &id);
            s = b.channel->status;
            if (s == CMS_WRITE_OK && wrote) wrote(c.id, *b.channel, *m);
            }
            if (b.line.confirm_write) words({static_cast<uint32_t>(id), static_cast<uint32_t>(s), 0});
            return s != CMS_UPDATE_ERROR;
        }
        case REQ_CHECK_IF_READ: {
            CMS_STATUS s = t->check_if_read(&n);
            words({serial, static_cast<uint32_t>(s), static_cast<uint32_t>(n)});
            return true;
        }
    case REQ_CLEAR: words({serial, static_cast<uint32_t>(t->clear())}); return true;
    case REQ_CLOSE_CHANNEL: return false;
    case REQ_GET_KEYS:
        c.challenge = random_bytes(16);
        words({serial});
        c.out.insert(c.out.end(), c.challenge.begin(), c.challenge.end());
        return true;
    case REQ_LOGIN:
        if (b.line.passwd.empty()) { words({serial, 1}); return true; }
        {
            bool good = login(c, data, b);
            if (good) c.trusted.insert(static_cast<int>(number));
            words({serial, good ? 1u : 0u});
            return true;
        }
    case REQ_SET_SUBSCRIPTION: subscribe(c, static_cast<int>(number), serial, w3, w4); return true;
    case REQ_CANCEL_SUBSCRIPTION:
        words({serial, static_cast<uint32_t>(c.subscriptions.erase(static_cast<int>(number)))});
        return true;
    case REQ_GET_BUF_NAME:
        {
            words({serial, static_cast<uint32_t>(CMS_STATUS_NOT_SET)});
            char name[NAME_BYTES] = "";
            strncpy(name, b.line.name.c_str(), sizeof name - 1);
            c.out.insert(c.out.end(), name, name + sizeof name);
            return true;
        }
    case REQ_SET_DIAG_INFO: return true; // the buffer counts by itself
    case REQ_GET_DIAG_INFO: reply_diagnosis(c, serial, b); return true;
    case REQ_GET_MSG_COUNT: {
        CMS_STATUS s = t->message_count(&n);
        words({serial, static_cast<uint32_t>(s), static_cast<uint32_t>(n)});
        return true;
    }
    case REQ_GET_QUEUE_LENGTH: {
        CMS_STATUS s = t->queue_length(&n);
        words({serial, static_cast<uint32_t>(s), static_cast<uint32_t>(n)});
        return true;
    }
    case REQ_GET_SPACE_AVAILABLE: {
        CMS_STATUS s = t->space_available(&bytes);
        words({serial, static_cast<uint32_t>(s), static_cast<uint32_t>(bytes)});
        return true;
    }
    default: return false;
    }
}

// Half of a queue is kept for programs of this computer, so that a flood from outside keeps no stop out. Where
// nobody reads the queue its writer hears so after a second.
bool Server::waits_for_room(Client &c, int number) {
    auto it = buffers_.find({c.port, number});
    if (it == buffers_.end() || !it->second.line.queue) return false;
    Transport *t = it->second.channel->transport();
    long room = 0;
    const bool full = t->space_available(&room) == CMS_READ_OK && room < t->max_message() / 2;
    const int64_t now = wall_ns();
    if (full && c.held_since == 0) c.held_since = now;
    if (full && now < c.held_since + MOST_HELD_NS) return true;
    c.held_since = 0;
    return false;
}

// Takes whole requests from the input, or leaves them for `later`. False: garbage.
bool Server::consume(Client &c) {
    c.later = 0;
    for (int n = 0;; n++) {
        if (c.in.size() < REQUEST_BYTES || c.pending.any) return true;
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
            rcs_print_error("NML server: %s sent what is no request (type %u, %zu bytes); dropped\n", c.peer.c_str(),
                            type, extra);
            return false;
        }
        if (c.in.size() < REQUEST_BYTES + extra) return true;
        const int64_t now = wall_ns();
        if (n == MOST_AT_A_TURN) c.later = now;
        else if (type == REQ_WRITE && waits_for_room(c, static_cast<int>(get_word(c.in.data() + 8))))
            c.later = now + ROOM_RETRY_NS;
        else if (!c.rate.take(now)) c.later = c.rate.next_ns();
        if (c.later) return true;
        if (!answer(c, c.in.data(), c.in.data() + REQUEST_BYTES, extra)) {
            if (type != REQ_CLOSE_CHANNEL)
                rcs_print_error("NML server: %s sent a request that can not be read (type %u); dropped\n",
                                c.peer.c_str(), type);
            return false;
        }
        c.in.erase(c.in.begin(), c.in.begin() + static_cast<std::ptrdiff_t>(REQUEST_BYTES + extra));
        if (c.out.size() > MOST_UNREAD) {
            rcs_print_error("NML server: %s does not read its answers; dropped\n", c.peer.c_str());
            return false;
        }
    }
}

void Server::accept_from(int listener, int port) {
    sockaddr_in from{};
    socklen_t len = sizeof from;
    int fd = accept4(listener, reinterpret_cast<sockaddr *>(&from), &len, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (fd < 0) return;
    char text[INET_ADDRSTRLEN] = "?";
    inet_ntop(AF_INET, &from.sin_addr, text, sizeof text);
    Client c{};
    c.fd = fd;
    c.port = port;
    c.id = ++last_client_;
    c.peer = std::string(text) + ":" + std::to_string(ntohs(from.sin_port));
    if (clients_.size() >= MOST_CLIENTS) {
        rcs_print_error("NML server: %s is one connection too many; dropped\n", c.peer.c_str());
        close(fd);
        return;
    }
    int one = 1;
    setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
    ask_when_quiet(fd);
    clients_.push_back(std::move(c));
}

void Server::run(const volatile int *stop) {
    while (!*stop) {
        int wake = WAKE_MS;
        std::vector<pollfd> fds;
        for (auto &l : listeners_) fds.push_back({l.first, POLLIN, 0});
        const int64_t now = wall_ns();
        for (Client &c : clients_) {
            short events = static_cast<short>((c.later ? 0 : POLLIN) | (c.out.empty() ? 0 : POLLOUT));
            fds.push_back({events ? c.fd : -1, events, 0});
            if (c.pending.any || !c.subscriptions.empty()) wake = std::min(wake, PENDING_MS);
            if (c.later) wake = std::clamp(static_cast<int>((c.later - now + 999'999) / 1'000'000), 0, wake);
        }
        if (::poll(fds.data(), fds.size(), wake) < 0) continue;
        size_t n = listeners_.size();
        std::vector<Client> kept;
        for (size_t i = 0; i < clients_.size(); i++) {
            Client &c = clients_[i];
            short ev = fds[n + i].revents;
            bool good = !(ev & (POLLERR | POLLNVAL));
            if (good && c.later) {
                if (wall_ns() >= c.later) good = consume(c);
            } else if (good && (ev & (POLLIN | POLLHUP))) {
                unsigned char buf[8192];
                ssize_t r = recv(c.fd, buf, sizeof buf, 0);
                if (r > 0) {
                    c.in.insert(c.in.end(), buf, buf + r);
                    good = consume(c);
                } else {
                    good = r < 0 && (errno == EAGAIN || errno == EINTR);
                }
            }
            if (good && c.pending.any) {
                try_pending(c);
                if (!c.pending.any) good = consume(c); // what came meanwhile
                if (c.in.size() > MOST_UNREAD) {
                    rcs_print_error("NML server: %s sends without waiting for its answer; dropped\n", c.peer.c_str());
                    good = false;
                }
            }
            if (good && !c.pending.any) send_news(c);
            if (good && !c.out.empty()) {
                ssize_t r = send(c.fd, c.out.data(), c.out.size(), MSG_NOSIGNAL);
                if (r > 0) c.out.erase(c.out.begin(), c.out.begin() + r);
                else good = r < 0 && (errno == EAGAIN || errno == EINTR);
            }
            if (good) {
                if (holds && holds(c.id) && peer_unheard(c.fd)) unheard(c.id);
                kept.push_back(std::move(c));
                continue;
            }
            close(c.fd);
            if (gone) gone(c.id);
        }
        clients_.swap(kept);
        // Whose message waits for room is the first to find some.
        auto held = [](const Client &c) { return c.held_since != 0; };
        auto first = std::find_if(clients_.begin(), clients_.end(), held);
        std::rotate(clients_.begin(), first, clients_.end());
        for (size_t i = 0; i < n; i++) {
            if (fds[i].revents & POLLIN) accept_from(listeners_[i].first, listeners_[i].second);
        }
    }
}

} // namespace nml
