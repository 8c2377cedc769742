// SPDX-License-Identifier: GPL-2.0-or-later
//
// user_codes.hh - programs M100 to M199 of the user. [task] Source: task sheet, section 10.
#ifndef KERF_USER_CODES_HH
#define KERF_USER_CODES_HH

#include <sys/types.h>

#include <array>
#include <string>
#include <vector>

#include "inifile.hh"

class UserCodes {
public:
    void scan(const linuxcnc::IniFile &ini, unsigned debug); // once, at start
    bool exists(int num) const { return !path_[static_cast<size_t>(num)].empty(); } // num 0..99
    std::string command(int num, double p, double q) const;
private:
    std::array<std::string, 100> path_;
};

// A program that runs beside task. One at a time.
class Child {
public:
    ~Child() { interrupt(); }
    bool start(const char *command_line); // words; double quotes group; no shell
    bool running() const { return pid_ > 0; }
    // 0 still running, 1 ended with status 0, -1 ended otherwise
    int poll();
    const std::string &failure() const { return failure_; } // of the last one that did not end well: a sentence
    void interrupt(); // SIGINT
private:
    void collect();
    pid_t pid_ = 0;
    std::string name_, failure_;
    std::vector<pid_t> left_; // were interrupted
};

#endif
