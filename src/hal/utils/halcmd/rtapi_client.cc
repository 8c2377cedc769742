/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * rtapi_client.cc - see rtapi_client.hh.
 *
 * Request: u16 size (all of it), u16 count, then per argument u16 length and bytes.
 * Answer: u16 size, i32 result, u16 length and bytes of a text. Little endian.
 */
#include "rtapi_client.hh"

#include "kerf_clock.h"
#include "kerf_instance.h"

#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <time.h>
#include <unistd.h>

namespace halcmd
{

namespace
{

class Socket
{
  public:
    explicit Socket(int fd) : fd(fd) {}
    ~Socket()
    {
        if (fd >= 0) close(fd);
    }
    Socket(const Socket &) = delete;
    Socket &operator=(const Socket &) = delete;
    const int fd;

    bool write_all(const std::string &data) const
    {
        for (size_t done = 0; done < data.size();) {
            ssize_t n = send(fd, data.data() + done, data.size() - done, MSG_NOSIGNAL);
            if (n < 0 && errno == EINTR) continue;
            if (n <= 0) return false;
            done += n;
        }
        return true;
    }

    bool read_all(std::string &data, size_t size) const
    {
        data.assign(size, '\0');
        for (size_t done = 0; done < size;) {
            ssize_t n = recv(fd, data.data() + done, size - done, 0);
            if (n < 0 && errno == EINTR) continue;
            if (n <= 0) return false;
            done += n;
        }
        return true;
    }
};

/// Virtual time while the realtime process works for us. It stands while a module is loaded,
/// so that what comes after happens at a repeatable moment; but a module that itself waits
/// would never be done, so from HOLD_MS of wall time on it goes. To unload, realtime tasks
/// must come to their ends: it goes at once.
class Patience
{
  public:
    Patience(int fd, const std::vector<std::string> &args)
    {
        pollfd answer = {fd, POLLIN, 0};
        const bool hold = !args.empty() && args[0] != "unload";
        if (!kerf_clock_joined() || (hold && poll(&answer, 1, HOLD_MS) != 0)) return;
        kerf_clock_suspend();
        suspended = true;
    }
    ~Patience()
    {
        if (suspended) kerf_clock_resume();
    }
    Patience(const Patience &) = delete;
    Patience &operator=(const Patience &) = delete;

  private:
    static constexpr int HOLD_MS = 2000;
    bool suspended = false;
};

} // namespace

/// The address: an abstract name, padded with NULs to its full length.
static bool address(sockaddr_un &where)
{
    const char *path = getenv("RTAPI_FIFO_PATH"), *home = getenv("HOME");
    std::string base = path ? path : home ? std::string(home) + "/.rtapi_fifo" : "";
    char name[PATH_MAX];
    if (base.empty() || kerf_instance_path(name, sizeof name, base.c_str()) < 0) return false;
    if (strlen(name) > sizeof where.sun_path - 2) return false;
    memset(&where, 0, sizeof where);
    where.sun_family = AF_UNIX;
    memcpy(where.sun_path + 1, name, strlen(name));
    return true;
}

static void put16(std::string &to, size_t n)
{
    to += static_cast<char>(n & 0xff);
    to += static_cast<char>(n >> 8);
}

static size_t get16(const std::string &from, size_t at)
{
    return static_cast<uint8_t>(from[at]) | static_cast<uint8_t>(from[at + 1]) << 8;
}

/// Connects; a full queue of the listener (EAGAIN) is tried again for 3 s.
static int connect_to(int fd, const sockaddr_un &where)
{
    for (int tries = 0;; tries++) {
        if (connect(fd, reinterpret_cast<const sockaddr *>(&where), sizeof where) == 0) return 0;
        if ((errno != EAGAIN && errno != EINTR) || tries >= 300) return -ECONNREFUSED;
        timespec pause = {0, 10'000'000};
        nanosleep(&pause, nullptr);
    }
}

int rtapi_request(const std::vector<std::string> &args, int &result, std::string &text)
{
    std::string body;
    put16(body, args.size());
    for (auto &arg : args) {
        if (arg.size() > 0xffff) return -E2BIG;
        put16(body, arg.size());
        body += arg;
    }
    if (body.size() + 2 > 0xffff) return -E2BIG;
    std::string message;
    put16(message, body.size() + 2);
    message += body;

    sockaddr_un where;
    Socket s(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    if (s.fd < 0 || !address(where)) return -ECONNREFUSED;
    if (int r = connect_to(s.fd, where)) return r;
    if (!s.write_all(message)) return -EPIPE;

    Patience patience(s.fd, args);
    std::string size, answer;
    if (!s.read_all(size, 2) || get16(size, 0) < 8 || !s.read_all(answer, get16(size, 0) - 2)) return -EPIPE;
    uint32_t value = 0;
    for (int i = 3; i >= 0; i--) value = value << 8 | static_cast<uint8_t>(answer[i]);
    result = static_cast<int32_t>(value);
    text = answer.substr(6, get16(answer, 4));
    return 0;
}

} // namespace halcmd
