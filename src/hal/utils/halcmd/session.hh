/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * session.hh - one user of HAL who gives commands: where the commands come from, where
 * the texts go, which options hold. No globals; a process may hold several.
 *
 * In:     command lines or argument lists
 * Out:    changes of HAL; texts through Channels
 * Thread: [task]
 * Source: HAL tools reference, sections 1.1 to 1.6
 */
#ifndef KERF_HALCMD_SESSION_HH
#define KERF_HALCMD_SESSION_HH

#include "text.hh"

#include <csignal>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace linuxcnc
{
class IniFile;
}

namespace halcmd
{

using Args = std::vector<std::string>;

enum class Level { None = 0, Err, Warn, Info, Dbg, All };

/// Where a command stands.
struct Place {
    std::string file = "<commandline>";
    int line = 0;
};

/// Where texts go. Texts end with their newline where they have one.
class Channels
{
  public:
    virtual ~Channels() = default;
    virtual void error(const Place &place, const std::string &text) = 0;
    virtual void warning(const Place &place, const std::string &text) = 0;
    virtual void info(const Place &place, const std::string &text) = 0;
    virtual void print(const Place &place, const std::string &text) = 0; ///< the `print` command
    virtual void output(const std::string &text) = 0;                   ///< results of show, getp ...
    virtual void console(const std::string &text) = 0;                  ///< help, echo, save without a file
};

/// Standard output and error, with FILE:LINE: prefixes.
class TerminalChannels : public Channels
{
  public:
    explicit TerminalChannels(const Level &level) : level(level) {}
    void error(const Place &place, const std::string &text) override;
    void warning(const Place &place, const std::string &text) override;
    void info(const Place &place, const std::string &text) override;
    void print(const Place &place, const std::string &text) override;
    void output(const std::string &text) override;
    void console(const std::string &text) override;

  private:
    const Level &level;
};

class Session
{
  public:
    Session() = default;
    ~Session();
    Session(const Session &) = delete;
    Session &operator=(const Session &) = delete;

    // Options
    Level level = Level::Err;
    bool keep_going = false, script = false, echo = false;
    const linuxcnc::IniFile *ini = nullptr; ///< borrowed; null: no -i

    // HAL
    bool anonymous = false; ///< maps HAL without registering a component
    /// Maps HAL and registers the component halcmd<pid>. 0 or a negative errno.
    int attach();
    /// Gives the component back but keeps the memory mapped, so that it outlives the last user.
    void detach();
    /// Gives everything back.
    void leave();
    int component() const { return comp_id; }

    // Texts
    Channels *channels = nullptr; ///< borrowed
    Place place;
    void error(const std::string &text) { channels->error(place, text); }
    void warning(const std::string &text) { channels->warning(place, text); }
    void info(const std::string &text) { channels->info(place, text); }
    void output(const std::string &text) { channels->output(text); }
    void console(const std::string &text) { channels->console(text); }
    /// show, list, status and save print nothing with -Q.
    bool silent() const { return level == Level::None; }

    // Commands. 0 or a negative errno (or another nonzero status); failures are told.
    int run(const Args &args);            ///< one command, arguments as given
    int run_line(const std::string &line); ///< one logical line of a file; quit and exit set quit_seen
    int run_stream(FILE *in);             ///< a file or standard input to its end; counts failures
    int source(const std::string &path);  ///< the `source` command

    int failures = 0;      ///< commands that failed in run_stream
    bool quit_seen = false;
    /// Set by a signal handler: finish the present command, then stop.
    volatile sig_atomic_t stop = 0;
    /// 1 while a command runs.
    volatile sig_atomic_t busy = 0;

  private:
    int comp_id = 0;
    bool mapped = false;
    bool dos_warned = false;
    int source_depth = 0;
    int run_logical(std::string line, bool top_level);
    Lookup lookup() const;
};

/// Reads one physical line (MAX_PHYSICAL characters with its newline at most) without the
/// newline and, at the file's begin, the byte order mark of some editors; counts it in number. False at the
/// end. cut: the line was longer and goes on in the next read.
bool read_physical(FILE *in, std::string &line, int &number, bool &cut);

} // namespace halcmd

#endif
