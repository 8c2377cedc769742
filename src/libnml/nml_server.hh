// SPDX-License-Identifier: GPL-2.0-or-later
//
// nml_server.hh - serves local buffers to clients over TCP. One thread, one poll loop; a
// client that sends what is no request is dropped with a log line and disturbs nobody.
#ifndef KERF_NML_SERVER_HH
#define KERF_NML_SERVER_HH

#include <map>
#include <string>
#include <vector>

#include "nml_transport.hh"

namespace nml {

class Server {
public:
    explicit Server(const MessageSet &set) : set_(set) {}
    ~Server();
    // The channel (not owned) answers requests for buffer `number` on `port`.
    void add(NML &channel, const BufferLine &line);
    // Opens the ports on `address` (default: this machine only). False when none could be opened.
    bool listen(const std::string &address = "127.0.0.1");
    // Until *stop is set. Wakes at least every 200 ms of wall time to look at it.
    void run(const volatile int *stop);
private:
    struct Buffer { NML *channel; BufferLine line; };
    struct Client { int fd, port; std::string peer; std::vector<unsigned char> in, out; };
    bool consume(Client &c);
    bool answer(Client &c, const unsigned char *head, const unsigned char *data, size_t size);
    void reply_read(Client &c, uint32_t serial, Buffer &b, uint32_t access, int last_id);
    const MessageSet &set_;
    std::map<std::pair<int, int>, Buffer> buffers_; // (port, number)
    std::vector<std::pair<int, int>> listeners_;    // (fd, port)
    std::vector<Client> clients_;
};

} // namespace nml
#endif
