// SPDX-License-Identifier: GPL-2.0-or-later
//
// control.hh - which program has control of the machine. [task]
//
// Normally nobody has: every program may command. One that takes control (a sequence of commands that
// belong together) is the only one that may start, move or switch anything until it gives control back,
// ends, or somebody stops the machine. What stops or slows, anyone may at any time.
#ifndef KERF_CONTROL_HH
#define KERF_CONTROL_HH

#include <string>

#include "messages.hh"
#include "process_watch.hh"

class Control {
public:
    // Who: a process and the name it gives itself. False: another one has control.
    bool take(pid_t pid, const std::string &name);
    void release();
    bool taken() const { return pid_ != 0; }
    bool owned_by(pid_t pid) const { return pid_ != 0 && pid_ == pid; }
    // May process `pid` give this command now?
    bool allows(const NMLmsg &m, pid_t pid) const { return pid_ == 0 || pid_ == pid || for_everybody(m); }
    // Does this command, of anybody, end control?
    static bool ends_control(const NMLmsg &m);
    bool owner_ended() const { return watch_.ended(); }
    pid_t pid() const { return pid_; }
    const std::string &name() const { return name_; }

private:
    static bool for_everybody(const NMLmsg &m);
    pid_t pid_ = 0;
    std::string name_;
    ProcessWatch watch_;
};

#endif
