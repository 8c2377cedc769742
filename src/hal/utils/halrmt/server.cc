/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * server.cc - see server.hh: connections and the loop over them.
 */
#include "server.hh"

#include "hal.h"
#include "kerf_clock.h"
#include "rtapi.h"

#include <algorithm>
#include <arpa/inet.h>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

using halcmd::strf;

namespace halrmt
{

constexpr size_t MAX_LINE = 4096;     ///< bytes a client may send without a line's end
constexpr size_t MAX_OUTPUT = 64 << 20; ///< bytes waiting for a client that does not read
constexpr int64_t JOB_PERIOD_NS = 10'000'000;

volatile sig_atomic_t ended;

void Connection::say(const std::string &text)
{
    if (timestamp) {
        timeval now;
        gettimeofday(&now, nullptr);
        if (epoch) {
            output += strf("%lld.%06ld: ", static_cast<long long>(now.tv_sec), static_cast<long>(now.tv_usec));
        } else {
            tm local;
            char date[32];
            localtime_r(&now.tv_sec, &local);
            strftime(date, sizeof date, "%Y-%m-%d %H:%M:%S", &local);
            output += strf("%s.%06ld: ", date, static_cast<long>(now.tv_usec));
        }
    }
    output += text + "\r\n";
}

void Server::log(const std::string &text) const
{
    if (settings.quiet) return;
    printf("halrmt: %s\n", text.c_str());
    fflush(stdout);
}

bool Server::open_listener()
{
    const int family = settings.ipv4_only ? AF_INET : AF_INET6;
    listener = socket(family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (listener < 0 && family == AF_INET6) listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (listener < 0) return false;
    const int on = 1, off = 0;
    setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    sockaddr_storage where = {};
    socklen_t size;
    int domain;
    socklen_t domain_size = sizeof domain;
    getsockopt(listener, SOL_SOCKET, SO_DOMAIN, &domain, &domain_size);
    if (domain == AF_INET6) {
        setsockopt(listener, IPPROTO_IPV6, IPV6_V6ONLY, &off, sizeof off);
        auto *in6 = reinterpret_cast<sockaddr_in6 *>(&where);
        in6->sin6_family = AF_INET6;
        in6->sin6_addr = in6addr_any;
        in6->sin6_port = htons(settings.port);
        size = sizeof *in6;
    } else {
        auto *in = reinterpret_cast<sockaddr_in *>(&where);
        in->sin_family = AF_INET;
        in->sin_addr.s_addr = INADDR_ANY;
        in->sin_port = htons(settings.port);
        size = sizeof *in;
    }
    return bind(listener, reinterpret_cast<sockaddr *>(&where), size) == 0 && listen(listener, 10) == 0;
}

void Server::accept_client()
{
    int fd = accept4(listener, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (fd < 0) return;
    if (settings.sessions > 0 && clients.size() >= static_cast<size_t>(settings.sessions)) {
        log("connection refused: all sessions are taken");
        close(fd);
        return;
    }
    auto c = std::make_unique<Connection>();
    c->fd = fd;
    c->ini_file = settings.ini_file;
    clients.push_back(std::move(c));
    log(strf("client connected (%zu)", clients.size()));
}

void Server::read_client(Connection &c)
{
    char buffer[4096];
    ssize_t n = recv(c.fd, buffer, sizeof buffer, 0);
    if (n == 0 || (n < 0 && errno != EAGAIN && errno != EINTR)) {
        c.closing = true;
        c.output.clear();
        return;
    }
    if (n < 0) return;
    c.input.append(buffer, n);
    size_t start = 0, end;
    while (!c.closing && !shutdown && (end = c.input.find_first_of("\r\n", start)) != std::string::npos) {
        if (end > start) execute(*this, c, c.input.substr(start, end - start));
        start = end + 1;
    }
    c.input.erase(0, start);
    if (c.input.size() > MAX_LINE) {
        c.error("Line too long");
        c.input.clear();
    }
}

/// Looks whether programs have ended or their components are ready.
void Server::check_jobs()
{
    for (size_t i = 0; i < jobs.size();) {
        Job &j = jobs[i];
        int status = 0;
        const bool ended = waitpid(j.pid, &status, WNOHANG) != 0;
        hal_query_t q = {};
        const bool ready = j.wait_ready && hal_comp_by_name(j.component.c_str(), &q) == 0 && q.comp.ready;
        bool done = false, good = false;
        if (ready && !j.wait_end) done = good = true;
        else if (ended) {
            done = true;
            good = (j.wait_ready ? ready : true) &&
                   (!j.wait_end || j.ignore_status || (WIFEXITED(status) && WEXITSTATUS(status) == 0));
        }
        if (!done) {
            i++;
            continue;
        }
        if (j.owner) job_done(*j.owner, good);
        jobs.erase(jobs.begin() + i);
    }
}

int Server::run()
{
    if (!open_listener()) {
        fprintf(stderr, "halrmt: cannot listen on port %d: %s\n", settings.port, strerror(errno));
        return 1;
    }
    log(strf("listening on port %d", settings.port));
    while (!shutdown && !ended) {
        std::vector<pollfd> fds = {{listener, POLLIN, 0}};
        for (auto &c : clients)
            fds.push_back(
                {c->fd, static_cast<short>((c->closing ? 0 : POLLIN) | (c->output.empty() ? 0 : POLLOUT)), 0});
        kerf_clock_poll(fds.data(), fds.size(), jobs.empty() ? -1 : JOB_PERIOD_NS);
        for (size_t i = 1; i < fds.size(); i++)
            if (fds[i].revents & (POLLIN | POLLHUP | POLLERR)) read_client(*clients[i - 1]);
        if (fds[0].revents & POLLIN) accept_client();
        check_jobs();
        for (auto &c : clients) {
            if (!c->output.empty()) {
                ssize_t n = send(c->fd, c->output.data(), c->output.size(), MSG_NOSIGNAL);
                if (n > 0) c->output.erase(0, n);
                else if (n < 0 && errno != EAGAIN && errno != EINTR) c->closing = true, c->output.clear();
                if (c->output.size() > MAX_OUTPUT) c->closing = true, c->output.clear();
            }
            if (!c->closing || !c->output.empty()) continue;
            for (auto &j : jobs)
                if (j.owner == c.get()) j.owner = nullptr;
            close(c->fd);
            c.reset();
        }
        size_t before = clients.size();
        clients.erase(std::remove(clients.begin(), clients.end(), nullptr), clients.end());
        if (clients.size() != before) log(strf("client disconnected (%zu)", clients.size()));
    }
    for (auto &c : clients) {
        fcntl(c->fd, F_SETFL, 0);
        if (send(c->fd, c->output.data(), c->output.size(), MSG_NOSIGNAL) < 0)
            log("client did not take its last lines");
        close(c->fd);
    }
    close(listener);
    log("ended");
    return 0;
}

} // namespace halrmt
