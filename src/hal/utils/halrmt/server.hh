/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * server.hh - halrmt: HAL over TCP, one line a command.
 *
 * In:     lines of clients
 * Out:    reply lines, changes of HAL
 * Thread: [task], one thread; programs that are loaded run beside it
 * Source: HAL tools reference part 2, section 8
 */
#ifndef KERF_HALRMT_SERVER_HH
#define KERF_HALRMT_SERVER_HH

#include "../halcmd/session.hh"
#include "inifile.hh"

#include <csignal>
#include <memory>
#include <string>
#include <vector>

namespace halrmt
{

using Words = std::vector<std::string>;

struct Settings {
    int port = 5006;
    std::string name = "EMCNETSVR", connect_password = "EMC", enable_password = "EMCTOO", ini_file;
    int sessions = 0; ///< at most; 0: any number
    bool quiet = false, ipv4_only = false;
};

/// A client.
struct Connection {
    int fd = -1;
    std::string input, output;
    bool linked = false, enabled = false; ///< after HELLO; after SET ENABLE
    bool echo = true, verbose = false, expand = false, header = false, timestamp = false, epoch = false;
    bool closing = false; ///< close when all output is sent
    std::string client, ini_file;

    /// A reply line; CR LF is added, and the time before it when asked for.
    void say(const std::string &text);
    void error(const std::string &text) { say("error: " + text); }
};

/// A program started by SET LOADUSR whose end or component is waited for.
struct Job {
    Connection *owner; ///< null when the client has gone
    int pid;
    bool wait_ready, wait_end, ignore_status;
    std::string component, program;
};

class Server
{
  public:
    explicit Server(const Settings &settings) : settings(settings) {}
    /// Serves until SHUTDOWN or a signal. The exit status.
    int run();

    const Settings settings;
    halcmd::Session session;        ///< for loading and unloading; owns the mapping of HAL
    bool shutdown = false;
    std::vector<Job> jobs;
    void log(const std::string &text) const;

  private:
    std::vector<std::unique_ptr<Connection>> clients;
    int listener = -1;
    bool open_listener();
    void accept_client();
    void read_client(Connection &c);
    void check_jobs();
};

/// Set by a signal handler: the server ends.
extern volatile sig_atomic_t ended;
/// Executes one line of a client.
void execute(Server &server, Connection &c, std::string line);
/// Replies at the end of a job, good or bad.
void job_done(Connection &c, bool good);

} // namespace halrmt

#endif
