// SPDX-License-Identifier: GPL-2.0-or-later
//
// session.hh - linuxcncrsh: one connection, and what all connections share. [task]
#ifndef KERF_RSH_SESSION_HH
#define KERF_RSH_SESSION_HH

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "client.hh"
#include "inifile.hh"
#include "rate_limit.hh"

namespace rsh {

enum class Level { none, hello, enable, on };
// sent: a command to task, the answer comes when task has done (or received) it; waits: the same
// for the command before, as wait_for() says; watches: it comes when what watch() got says so
enum class Result { failed, done, sent, waits, watches };

using Words = std::vector<std::string>;

struct Options {
    int port = 5007;
    std::string name = "EMCNETSVR", connect_password = "EMC", enable_password = "EMCTOO", path;
    std::string bind; // address to listen on; empty: this computer only, "*": any
    int sessions = 0;
    bool quiet = false, ipv4 = false;
    std::string ini_file = "emc.ini";
};

class Server;
struct Subcommand;

class Session {
public:
    // neighbour: the peer is on this computer.
    Session(Server &server, int fd, bool neighbour);
    ~Session();

    int fd;
    bool echo = true, verbose = false, linked = false, enabled = false, wait_done = true;
    bool timestamp = false, timestamp_epoch = false;
    double timeout_s = 0; // 0: none
    std::string client, version = "1.1", opened;
    nml::RateLimit rate; // of its lines
    bool closing = false, input_ended = false;
    int64_t last_answers_until = 0; // once it is closing

    void input(const char *data, size_t n);
    bool has_line() const { return !lines_.empty(); }
    size_t lines_waiting() const { return lines_.size(); }
    void next_line();     // takes one line and does it
    void poll_waiting();  // looks whether the command under way is done
    bool waiting() const { return waiting_ != nullptr; }
    const Subcommand *waiting_for() const { return waiting_; }
    bool holds_others_up() const; // no other connection may give task a command now
    void wait_for(bool done) { wait_for_done_ = done; }
    // Asked every heartbeat; watches: not yet.
    void watch(std::function<Result()> ask) { watch_ = std::move(ask); }
    void end_jogs();
    void disable(); // also ends its jogs, which it could not end any more
    int64_t next_poll_ns() const { return next_poll_; }

    void reply(const std::string &text);
    void error(const std::string &text) { reply("error: " + text); }
    void warning(const std::string &text) { reply("warning: " + text); }
    std::string output;
    // Continuous jogs that this connection began (number, jjogmode): they end with it.
    std::set<std::pair<int, int>> jogs;
    // Other computers never send a password but its answer to the challenge they asked for:
    // HMAC-SHA256(password, challenge), both in hexadecimal digits. Good once.
    std::string new_challenge();
    bool password_is(const std::string &given, const std::string &password);

private:
    void hello(const Words &w);
    void get(const Words &w, const std::string &line);
    void set(const Words &w, const std::string &line);
    void help(const Words &w);
    void finish_wait(bool good);
    bool telnet(unsigned char c);
    enum class Telnet { text, command, option, parameters, end_of_parameters } telnet_ = Telnet::text;
    std::function<Result()> watch_;
    Server &server_;
    const bool neighbour_;
    std::string challenge_;
    std::string partial_;
    std::deque<std::string> lines_;
    const Subcommand *waiting_ = nullptr;
    bool wait_for_done_ = true;
    int serial_ = 0; // of the last command that this connection gave
    int64_t started_ = 0, next_poll_ = 0, interval_ = 0;
};

class Server {
public:
    explicit Server(Options o) : options(std::move(o)) {}
    bool start();
    void run(const volatile int *stop);

    Options options;
    linuxcnc::IniFile ini;
    std::string ini_version;
    std::unique_ptr<EmcClient> client;
    std::unique_ptr<NML> errors;
    EMC_STAT stat;
    std::map<int, std::unique_ptr<Session>> sessions;
    bool shutdown = false;

    void refresh();
    void sleep_heartbeats(double n);
    double servo_period_s() const { return servo_period_s_; }
    // Messages read from the error channel, by kind; taken by the GETs of their kind.
    std::deque<std::string> error_text, operator_text, operator_display;
    void read_messages();
    // Unit conversions that the clients set (one for all)
    std::string linear_conversion = "AUTO", angular_conversion = "AUTO";
    std::string update_mode = "AUTO";
    int start_line = 0;
    int joints() const { return stat.motion.traj.joints; }
    int spindles() const { return stat.motion.traj.spindles; }
    void info(const std::string &text) const;

private:
    bool open_port(int family, const char *address);
    std::vector<int> listeners_;
    double servo_period_s_ = 0.01;
};

// Subcommands of GET and SET.
struct Subcommand {
    const char *name;
    Level level;
    bool remote;       // SET sends a command to task
    int get_args, set_args; // at least; -1: the other one only
    const char *usage;
    bool (*get)(Session &, Server &, const Words &args);
    Result (*set)(Session &, Server &, const Words &args, const std::string &rest);
};
const Subcommand *find_subcommand(const std::string &name);
const std::vector<Subcommand> &subcommands();

std::string upper(std::string s);
bool on_off(const std::string &word, bool *value);

} // namespace rsh
#endif
