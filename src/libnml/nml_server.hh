// SPDX-License-Identifier: GPL-2.0-or-later
//
// nml_server.hh - serves local buffers to clients over TCP. One thread, one poll loop; a
// client that sends what is no request is dropped with a log line and disturbs nobody. One that sends
// too many waits (RateLimit), each has its turn, and together they never fill more than half of a queue.
//
// Buffers with passwd=FILE want a login first: GET_KEYS gives 16 random bytes, LOGIN brings a name
// and the first 16 bytes of HMAC-SHA256(password, random bytes + name); see nml_auth.hh.
#ifndef KERF_NML_SERVER_HH
#define KERF_NML_SERVER_HH

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "nml_transport.hh"
#include "rate_limit.hh"

namespace nml {

class Server {
public:
    Server() = default;
    ~Server();
    Server(const Server &) = delete;
    Server &operator=(const Server &) = delete;
    // The channel (not owned) answers requests for buffer `number` on `port`.
    void add(NML &channel, const BufferLine &line);
    // Opens the ports on `address`, "*" for all of this computer's. False when one could not be
    // opened. Other computers are let in only with a password: each buffer must have passwd=.
    bool listen(const std::string &address = "127.0.0.1");
    // Until *stop is set. Wakes at least every 200 ms of wall time to look at it.
    void run(const volatile int *stop);
    // Called after a client's message was written, and when that client has gone.
    std::function<void(int client, NML &channel, const NMLmsg &m)> wrote;
    std::function<void(int client)> gone;
    // Whether a client holds what must end when its computer is not heard of for 3 s; that ends it.
    std::function<bool(int client)> holds;
    std::function<void(int client)> unheard;
private:
    struct Buffer { NML *channel; BufferLine line; };
    // A read that waits for a message, until `until` (ns of wall time, negative: for ever).
    struct Pending {
        bool any = false;
        uint32_t serial = 0, access = 0;
        int last_id = 0, number = 0;
        int64_t until = 0;
    };
    struct Subscription { uint32_t serial = 0; int64_t period_ns = 0, next_ns = 0; int last_id = 0; };
    struct Client {
        int fd, port, id;
        std::string peer;
        uint32_t counts = 0; // 1: its replies have numbers one above those of their requests, as classic clients expect
        bool begun = false;
        std::set<int> trusted; // numbers of the buffers with passwd= that it has logged in to
        std::string challenge;
        std::vector<unsigned char> in, out;
        Pending pending;
        std::map<int, Subscription> subscriptions; // by number of the buffer
        RateLimit rate;
        int64_t later = 0;      // requests of it wait here until then (ns of wall time); 0: none
        int64_t held_since = 0; // its next message waits for room in the queue; 0: none does
    };
    void accept_from(int listener, int port);
    bool login(Client &c, const unsigned char *data, Buffer &b);
    void try_pending(Client &c);
    void subscribe(Client &c, int number, uint32_t serial, uint32_t kind, uint32_t period_ms);
    void send_news(Client &c);
    void reply_diagnosis(Client &c, uint32_t serial, Buffer &b);
    bool consume(Client &c);
    bool waits_for_room(Client &c, int number);
    bool answer(Client &c, const unsigned char *head, const unsigned char *data, size_t size);
    bool reply_read(Client &c, uint32_t serial, Buffer &b, uint32_t access, int last_id, bool only_new);
    std::map<std::pair<int, int>, Buffer> buffers_; // (port, number)
    std::vector<std::pair<int, int>> listeners_;    // (fd, port)
    std::vector<Client> clients_;
    int last_client_ = 0;
};

} // namespace nml
#endif
