// SPDX-License-Identifier: GPL-2.0-or-later
//
// client.hh - a user interface's connection to task: send a command, wait for it, status,
// messages. Base of the Python module, halui, the shells. [any], one thread at a time.
#ifndef KERF_EMC_CLIENT_HH
#define KERF_EMC_CLIENT_HH

#include <memory>
#include <string>

#include "messages.hh"

class EmcClient {
public:
    // nmlfile "": the default one. Never fails: see valid().
    explicit EmcClient(const std::string &nmlfile = "");
    bool valid() { return command_->valid() && status_->valid(); }

    // Writes the command. False when the channel is not there.
    bool send(RCS_CMD_MSG &m);
    // The same for a message that task answers nothing to (EMC_JOG_HELD): serial() and what is waited for stay.
    bool send_aside(RCS_CMD_MSG &m);
    int serial() const { return serial_; }
    // Until task has read the last command; false after timeout_s (< 0: none) of the clock.
    bool wait_received(double timeout_s, double poll_s = 0.01);
    // RCS_DONE or RCS_ERROR; -1 after timeout_s. One look at least.
    int wait_done(double timeout_s, double poll_s = 0.01);

    // The newest status into *out; false, and *out as it was, while there is none.
    bool refresh(EMC_STAT *out);

    NML &status_channel() { return *status_; }
    NML &command_channel() { return *command_; }
    bool remote() const { return command_->remote(); } // the controller runs on another machine
private:
    enum class Answer { none, received, done, error };
    Answer look();
    void look_at_status();
    std::unique_ptr<NML> command_, status_;
    int serial_ = 0;
    bool seen_ = false;
    RCS_STAT_MSG last_;
};

#endif
