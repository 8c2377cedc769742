// SPDX-License-Identifier: GPL-2.0-or-later
//
// session.cc - linuxcncrsh: lines in, commands and replies out. Source: rsh sheet, B.2 to B.4.
#include "session.hh"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>

#include "emc_args.hh"
#include "kerf_clock.h"
#include "nml_auth.hh"
#include "rcs_print.hh"

namespace rsh {

constexpr int64_t MS = 1'000'000;
constexpr int64_t LAST_ANSWERS_NS = 2000 * MS; // for a client to read them
constexpr size_t MAX_LINE = 4096; // bytes; half a command is never executed
constexpr size_t MAX_LINES = 1000, MAX_OUTPUT = 1'000'000; // lines that wait, bytes of unread answers

std::string upper(std::string s) {
    for (char &c : s) c = static_cast<char>(toupper(static_cast<unsigned char>(c)));
    return s;
}

bool on_off(const std::string &word, bool *value) {
    std::string w = upper(word);
    if (w == "ON" || w == "1" || w == "TRUE" || w == "YES") { *value = true; return true; }
    if (w == "OFF" || w == "0" || w == "FALSE" || w == "NO") { *value = false; return true; }
    return false;
}

static Words split(const std::string &line) {
    Words w;
    size_t at = 0;
    while ((at = line.find_first_not_of(" \t", at)) != std::string::npos) {
        size_t end = line.find_first_of(" \t", at);
        w.push_back(line.substr(at, end == std::string::npos ? end : end - at));
        if (end == std::string::npos) break;
        at = end;
    }
    return w;
}

// The line from its nth word on, blanks kept.
static std::string from_word(const std::string &line, int n) {
    size_t at = line.find_first_not_of(" \t");
    for (int i = 0; i < n && at != std::string::npos; i++) {
        at = line.find_first_of(" \t", at);
        if (at != std::string::npos) at = line.find_first_not_of(" \t", at);
    }
    return at == std::string::npos ? "" : line.substr(at);
}

// ---- session ----

Session::Session(Server &server, int f, bool neighbour)
    : fd(f), client("Default-" + std::to_string(f)), server_(server), neighbour_(neighbour) {}

std::string Session::new_challenge() { return challenge_ = nml::to_hex(nml::random_bytes(16)); }

bool Session::password_is(const std::string &given, const std::string &password) {
    std::string challenge = std::move(challenge_);
    challenge_.clear();
    if (!challenge.empty() && nml::equal_secret(given, nml::to_hex(nml::hmac(password, challenge)))) return true;
    return neighbour_ && nml::equal_secret(given, password);
}

Session::~Session() {
    close(fd);
    end_jogs();
}

// Those that still go: a stop that nobody needs would be an error, in a running program for instance.
void Session::end_jogs() {
    if (jogs.empty()) return;
    server_.refresh();
    const EMC_STAT &t = server_.stat;
    const bool go = t.task.state == EMC_TASK_STATE_ON && t.task.mode == EMC_TASK_MODE_MANUAL && t.motion.jogging_active;
    for (auto &[nr, mode] : jogs) {
        EMC_JOG_STOP m;
        m.joint_or_axis = nr;
        m.jjogmode = mode;
        if (go) server_.client->send(m);
    }
    jogs.clear();
}

void Session::disable() {
    enabled = false;
    end_jogs();
}

// Whether this byte belongs to a command of the TELNET protocol (RFC 854), which is passed over.
bool Session::telnet(unsigned char c) {
    enum { SE = 240, SB = 250, WILL = 251, DONT = 254, IAC = 255 };
    switch (telnet_) {
    case Telnet::text:
        if (c != IAC) return false;
        telnet_ = Telnet::command;
        return true;
    case Telnet::command:
        if (c == IAC) { // the byte itself
            telnet_ = Telnet::text;
            return false;
        }
        telnet_ = c == SB ? Telnet::parameters : c >= WILL && c <= DONT ? Telnet::option : Telnet::text;
        return c >= SE; // else the command itself was out of band
    case Telnet::option: telnet_ = Telnet::text; return true;
    case Telnet::parameters:
        if (c == IAC) telnet_ = Telnet::end_of_parameters;
        return true;
    case Telnet::end_of_parameters: telnet_ = c == SE ? Telnet::text : Telnet::parameters; return true;
    }
    return false;
}

void Session::input(const char *data, size_t n) {
    for (size_t i = 0; i < n; i++) {
        if (telnet(static_cast<unsigned char>(data[i]))) continue;
        if (data[i] == 0 && partial_.empty()) continue; // CR NUL ends a line of TELNET
        if (data[i] == '\r' || data[i] == '\n') {
            if (!partial_.empty()) lines_.push_back(partial_);
            partial_.clear();
        } else if (partial_.size() <= MAX_LINE) { // one more than allowed marks a line as too long
            partial_ += data[i];
        }
    }
}

void Session::reply(const std::string &text) {
    if (timestamp) {
        timeval tv;
        gettimeofday(&tv, nullptr);
        char t[64];
        if (timestamp_epoch) {
            snprintf(t, sizeof t, "%ld.%06ld: ", static_cast<long>(tv.tv_sec), static_cast<long>(tv.tv_usec));
        } else {
            tm parts;
            localtime_r(&tv.tv_sec, &parts);
            size_t n = strftime(t, sizeof t, "%Y-%m-%d %H:%M:%S", &parts);
            snprintf(t + n, sizeof t - n, ".%06ld: ", static_cast<long>(tv.tv_usec));
        }
        output += t;
    }
    output += text + "\r\n";
}

void Session::next_line() {
    std::string line = lines_.front();
    lines_.pop_front();
    if (line.size() > MAX_LINE) return error("Line too long, " + std::to_string(MAX_LINE) + " characters at most");
    if (line.find('\0') != std::string::npos) return error("Line with a byte 0"); // which would end it for task
    Words w = split(line);
    if (w.empty()) return;
    std::string command = upper(w[0]);
    auto echo_line = [&] { if (echo && linked) output += line + "\r\n"; };
    if (command == "HELLO") return hello(w);
    if (command == "GET" || command == "SET") {
        if (w.size() < 2) return error("Too few arguments for '" + w[0] + "' command");
        echo_line();
        return command == "GET" ? get(w, line) : set(w, line);
    }
    if (command == "QUIT") {
        echo_line();
        disable();
        reply("QUIT ACK");
        closing = true;
        return;
    }
    if (command == "SHUTDOWN") {
        echo_line();
        if (!enabled) {
            error("SHUTDOWN failed, not enabled");
            return reply("SHUTDOWN NAK");
        }
        reply("SHUTDOWN ACK");
        server_.shutdown = true;
        return;
    }
    if (command == "HELP") {
        echo_line();
        return help(w);
    }
    error("Command '" + w[0] + "' not found");
}

void Session::hello(const Words &w) {
    if (w.size() < 3) return error("Too few arguments for 'HELLO' command");
    linked = false;
    disable();
    if (w[2].size() > 80) {
        error("Client name too long, 80 characters at most");
        return reply("HELLO NAK");
    }
    if (!password_is(w[1], server_.options.connect_password)) return reply("HELLO NAK");
    client = w[2];
    version = w.size() > 3 ? w[3] : "1.1";
    if (w.size() > 3 && version > server_.ini_version)
        warning("Requested version '" + version + "' is newer than '" + server_.ini_version + "' from [EMC]VERSION");
    linked = true;
    server_.info("connected: " + client);
    reply("HELLO ACK " + server_.options.name + " " + server_.ini_version);
}

void Session::get(const Words &w, const std::string &) {
    const Subcommand *s = find_subcommand(upper(w[1]));
    if (!s) {
        error("Subcommand not found: " + upper(w[0]) + " " + w[1]);
        return reply("GET NAK");
    }
    server_.refresh();
    Words args(w.begin() + 2, w.end());
    std::string name = s->name;
    if (static_cast<int>(args.size()) < s->get_args) {
        error("Too few arguments to GET " + name + ", have " + std::to_string(args.size()) + ", need " +
              std::to_string(s->get_args) + " or more");
        return reply("GET " + name + " NAK");
    }
    if (!s->get || !s->get(*this, server_, args)) reply("GET " + name + " NAK");
}

void Session::set(const Words &w, const std::string &line) {
    const Subcommand *s = find_subcommand(upper(w[1]));
    if (!s) {
        error("Subcommand not found: " + upper(w[0]) + " " + w[1]);
        return reply("SET NAK");
    }
    server_.refresh();
    std::string name = s->name;
    Words args(w.begin() + 2, w.end());
    if (s->remote)
        for (auto &other : server_.sessions)
            if (other.second->holds_others_up())
                return error("Cannot issue SET " + name + " command while SET " + other.second->waiting_for()->name +
                             " command is still active");
    auto nak = [&](const std::string &text) {
        error(text);
        reply("SET " + name + " NAK");
    };
    if (static_cast<int>(args.size()) < s->set_args)
        return nak("Too few arguments to SET " + name + ", have " + std::to_string(args.size()) + ", need " +
                   std::to_string(s->set_args) + " or more");
    if (s->level >= Level::hello && !linked) return nak("A HELLO must be successfully negotiated for SET " + name);
    if (s->level >= Level::enable && !enabled) return nak("Connection must be enabled for SET " + name);
    if (s->level == Level::on && server_.stat.task.state != EMC_TASK_STATE_ON)
        return nak("Machine must be 'ON' for SET " + name);
    int before = server_.client->serial();
    Result r = s->set ? s->set(*this, server_, args, from_word(line, 2)) : Result::failed;
    if (server_.client->serial() != before) serial_ = server_.client->serial();
    switch (r) {
    case Result::failed: reply("SET " + name + " NAK"); break;
    case Result::done: if (verbose) reply("SET " + name + " ACK"); break;
    case Result::sent:
        wait_for_done_ = wait_done;
        [[fallthrough]];
    case Result::waits:
    case Result::watches:
        waiting_ = s;
        started_ = kerf_clock_now_ns();
        interval_ = MS;
        next_poll_ = started_ + interval_;
        break;
    }
}

// A client that is gone, or has ended its input, waits on for its own sake only.
bool Session::holds_others_up() const { return waiting_ && waiting_->remote && !input_ended; }

void Session::finish_wait(bool good) {
    std::string name = waiting_->name;
    waiting_ = nullptr;
    watch_ = nullptr;
    if (!good) reply("SET " + name + " NAK");
    else if (verbose) reply("SET " + name + " ACK");
}

void Session::poll_waiting() {
    int64_t now = kerf_clock_now_ns();
    if (!waiting_ || now < next_poll_) return;
    server_.refresh();
    if (watch_) {
        const Result r = watch_();
        if (r != Result::watches) return finish_wait(r == Result::done);
        next_poll_ = now + static_cast<int64_t>(server_.servo_period_s() * 1e9);
        return;
    }
    int diff = server_.stat.echo_serial_number - serial_;
    int status = server_.stat.status;
    if (diff > 0) return finish_wait(true);
    if (diff == 0 && (!wait_for_done_ || status == RCS_DONE || status == RCS_ERROR))
        return finish_wait(status != RCS_ERROR);
    if (timeout_s > 0 && static_cast<double>(now - started_) > timeout_s * 1e9) {
        error("command 'SET " + std::string(waiting_->name) + "' timed out");
        return finish_wait(status != RCS_ERROR);
    }
    interval_ = std::min<int64_t>(interval_ * 2, 100 * MS);
    next_poll_ = now + interval_;
}

void Session::help(const Words &w) {
    std::string what = w.size() > 1 ? upper(w[1]) : "";
    auto list = [&](bool set) {
        static const struct {
            Level level;
            const char *title;
        } groups[] = {{Level::none, "Always:"},
                      {Level::hello, "After HELLO:"},
                      {Level::enable, "After SET ENABLE:"},
                      {Level::on, "With the machine on:"}};
        for (auto &g : groups) {
            if (set) reply(std::string("  ") + g.title);
            for (const Subcommand &s : subcommands())
                if (s.level == g.level && (set ? s.set != nullptr : s.get != nullptr))
                    reply(std::string("    ") + s.name + (*s.usage ? std::string(" ") + s.usage : ""));
        }
    };
    if (what.empty()) {
        reply("Commands:");
        for (const char *t : {"  HELLO <password> <client> [version]", "  GET <subcommand> [arguments]",
                              "  SET <subcommand> [arguments]", "  QUIT", "  SHUTDOWN", "  HELP [command]"})
            reply(t);
    } else if (what == "HELLO") {
        reply("HELLO <password> <client> [version]");
        reply("  Links this connection; needed for most SET commands.");
    } else if (what == "GET") {
        reply("GET <subcommand> [arguments]");
        list(false);
    } else if (what == "SET") {
        reply("SET <subcommand> [arguments]");
        list(true);
    } else if (what == "QUIT") {
        reply("QUIT");
        reply("  Ends this connection.");
    } else if (what == "SHUTDOWN") {
        reply("SHUTDOWN");
        reply("  Ends the server; the connection must be enabled.");
    } else if (what == "HELP") {
        reply("HELP [command]");
    } else {
        error(w[1] + " is not a valid command. (" + what + ")");
    }
}

// ---- server ----

void Server::info(const std::string &text) const {
    if (!options.quiet) {
        printf("linuxcncrsh: %s\n", text.c_str());
        fflush(stdout);
    }
}

void Server::refresh() { client->refresh(&stat); }

void Server::sleep_heartbeats(double n) { kerf_clock_sleep_ns(static_cast<int64_t>(n * servo_period_s_ * 1e9)); }

void Server::read_messages() {
    for (auto *queue : {&error_text, &operator_text, &operator_display}) // nobody need ask for each kind
        if (queue->size() > MAX_LINES) queue->erase(queue->begin(), queue->end() - MAX_LINES);
    for (;;) {
        switch (errors->read()) {
        case 1: // NML_ERROR, whose type name is taken
            error_text.emplace_back(errors->get<::NML_ERROR>()->error); break;
        case NML_TEXT_TYPE: operator_text.emplace_back(errors->get<NML_TEXT>()->text); break;
        case NML_DISPLAY_TYPE: operator_display.emplace_back(errors->get<NML_DISPLAY>()->display); break;
        case EMC_OPERATOR_ERROR_TYPE: error_text.emplace_back(errors->get<EMC_OPERATOR_ERROR>()->error); break;
        case EMC_OPERATOR_TEXT_TYPE: operator_text.emplace_back(errors->get<EMC_OPERATOR_TEXT>()->text); break;
        case EMC_OPERATOR_DISPLAY_TYPE:
            operator_display.emplace_back(errors->get<EMC_OPERATOR_DISPLAY>()->display);
            break;
        default: return;
        }
    }
}

bool Server::open_port(int family, const char *address) {
    int fd = socket(family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0), one = 1, zero = 0;
    if (fd < 0) return false;
    setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &one, sizeof one);
    sockaddr_in6 six{};
    sockaddr_in four{};
    sockaddr *at = reinterpret_cast<sockaddr *>(&four);
    socklen_t size = sizeof four;
    int known;
    if (family == AF_INET6) {
        setsockopt(fd, IPPROTO_IPV6, IPV6_V6ONLY, &zero, sizeof zero);
        six.sin6_family = AF_INET6;
        six.sin6_port = htons(static_cast<uint16_t>(options.port));
        known = inet_pton(AF_INET6, address, &six.sin6_addr);
        at = reinterpret_cast<sockaddr *>(&six);
        size = sizeof six;
    } else {
        four.sin_family = AF_INET;
        four.sin_port = htons(static_cast<uint16_t>(options.port));
        known = inet_pton(AF_INET, address, &four.sin_addr);
    }
    if (known != 1 || bind(fd, at, size) != 0 || listen(fd, 16) != 0) {
        if (family == AF_INET || !options.bind.empty())
            fprintf(stderr, "linuxcncrsh: %s port %d: %s\n", address, options.port,
                    known != 1             ? "not an address"
                    : errno == EADDRINUSE ? "Address already in use: end the program that has it, or give another one with --port"
                                          : strerror(errno));
        close(fd);
        return false;
    }
    listeners_.push_back(fd);
    return true;
}

bool Server::start() {
    if (!ini.open(options.ini_file)) return false;
    set_rcs_print(ini);
    ini_version = ini.findStringV("VERSION", "EMC", "1.1");
    linear_conversion = upper(unit_setting(ini, "LINEAR_UNITS"));
    angular_conversion = upper(unit_setting(ini, "ANGULAR_UNITS"));
    servo_period_s_ = ini.findRealV("SERVO_PERIOD", "EMCMOT", 1e7) * 1e-9;
    std::string nml = ini.findStringV("NML_FILE", "EMC", "");
    verbose_nml_error_messages = 0;
    for (int waited = 0;; waited++) {
        client = std::make_unique<EmcClient>(nml);
        errors = std::make_unique<NML>(emc_messages(), "emcError", "xemc", nml.empty() ? nullptr : nml.c_str());
        if (client->valid() && errors->valid()) break;
        if (waited >= 10) {
            fprintf(stderr, "linuxcncrsh: can't connect to emc\n");
            return false;
        }
        kerf_clock_sleep_ns(1000 * MS);
    }
    // Other computers are let in on purpose only, and not with the passwords that everybody knows.
    if (!options.bind.empty() && (options.connect_password == Options().connect_password ||
                                  options.enable_password == Options().enable_password)) {
        fprintf(stderr, "linuxcncrsh: --bind needs passwords of your own: --connectpw and --enablepw\n");
        return false;
    }
    bool any = options.bind == "*";
    if (options.bind.empty() || any) {
        bool six = !options.ipv4 && open_port(AF_INET6, any ? "::" : "::1");
        if (!(six && any) && !open_port(AF_INET, any ? "0.0.0.0" : "127.0.0.1")) return false; // clients would meet another program there
    } else {
        open_port(options.bind.find(':') == std::string::npos ? AF_INET : AF_INET6, options.bind.c_str());
    }
    if (listeners_.empty()) return false;
    info("listening on port " + std::to_string(options.port));
    return true;
}

void Server::run(const volatile int *stop) {
    while (!*stop) {
        std::vector<pollfd> fds;
        for (int l : listeners_) fds.push_back({l, POLLIN, 0});
        size_t first = fds.size();
        std::vector<int> ids;
        int64_t timeout = 200 * MS, now = kerf_clock_now_ns();
        for (auto &s : sessions) {
            short events = 0;
            if (!s.second->input_ended && s.second->lines_waiting() < MAX_LINES) events |= POLLIN | POLLPRI;
            if (!s.second->output.empty()) events |= POLLOUT;
            fds.push_back(
                {events ? s.first : -1, events, 0}); // one that has ended its input and gets nothing has no news
            ids.push_back(s.first);
            if (s.second->waiting()) timeout = std::min(timeout, std::max<int64_t>(0, s.second->next_poll_ns() - now));
            else if (s.second->has_line() && !s.second->closing && !shutdown)
                timeout = std::clamp<int64_t>(s.second->rate.next_ns() - now, 0, timeout);
        }
        kerf_clock_poll(fds.data(), fds.size(), timeout);
        for (size_t i = 0; i < ids.size(); i++) {
            Session &s = *sessions[ids[i]];
            short ev = fds[first + i].revents;
            char buf[4096];
            if (ev & POLLPRI) (void)!recv(s.fd, buf, sizeof buf, MSG_OOB);
            if (ev & (POLLIN | POLLHUP | POLLERR)) {
                ssize_t n = recv(s.fd, buf, sizeof buf, 0);
                if (n > 0) s.input(buf, static_cast<size_t>(n));
                else if (n == 0) s.input_ended = true;
                else if (errno != EAGAIN && errno != EINTR) s.closing = true, s.output.clear();
            }
        }
        for (size_t l = 0; l < first; l++) {
            if (!(fds[l].revents & POLLIN)) continue;
            sockaddr_in6 from{};
            socklen_t from_size = sizeof from;
            int fd =
                accept4(listeners_[l], reinterpret_cast<sockaddr *>(&from), &from_size, SOCK_CLOEXEC | SOCK_NONBLOCK);
            if (fd >= 0 && options.sessions > 0 && static_cast<int>(sessions.size()) >= options.sessions) {
                close(fd);
            } else if (fd >= 0) {
                int one = 1;
                setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
                nml::ask_when_quiet(fd);
                sessions[fd] =
                    std::make_unique<Session>(*this, fd, nml::is_loopback(reinterpret_cast<sockaddr *>(&from)));
            }
        }
        for (auto &it : sessions) {
            Session &s = *it.second;
            if (!s.jogs.empty() && nml::peer_unheard(s.fd)) {
                info(s.client + " is not heard of: its jogs end");
                s.end_jogs();
            }
            if (s.waiting()) s.poll_waiting();
            if (!s.waiting() && !s.closing && !shutdown && s.has_line() && s.rate.take(kerf_clock_now_ns()))
                s.next_line();
            if (s.input_ended && !s.waiting() && !s.has_line()) s.closing = true;
            if (s.output.size() > MAX_OUTPUT) {
                info(s.client + " does not read its answers; dropped");
                s.output.clear();
                s.closing = true;
            }
        }
        for (auto it = sessions.begin(); it != sessions.end();) {
            Session &s = *it->second;
            if (!s.output.empty()) {
                ssize_t n = send(s.fd, s.output.data(), s.output.size(), MSG_NOSIGNAL);
                if (n > 0) s.output.erase(0, static_cast<size_t>(n));
                else if (n < 0 && errno != EAGAIN && errno != EINTR) s.output.clear(), s.closing = true;
            }
            if (s.closing || shutdown) { // who does not read the last answers does not get them
                const int64_t at = kerf_clock_now_ns();
                if (s.last_answers_until == 0) s.last_answers_until = at + LAST_ANSWERS_NS;
                if (at >= s.last_answers_until) s.output.clear();
            }
            if ((s.closing || shutdown) && s.output.empty()) it = sessions.erase(it);
            else ++it;
        }
        if (shutdown && sessions.empty()) break;
    }
    sessions.clear();
    for (int l : listeners_) close(l);
}

} // namespace rsh
