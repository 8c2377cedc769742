// SPDX-License-Identifier: GPL-2.0-or-later
//
// client.cc - see client.hh. Protocol: nml sheet, section 2.
#include "client.hh"

#include <algorithm>

#include "kerf_clock.h"
#include "nml_transport.hh"

EmcClient::EmcClient(const std::string &nmlfile) {
    const char *file = nmlfile.empty() ? nullptr : nmlfile.c_str();
    command_ = std::make_unique<NML>(emc_messages(), "emcCommand", "xemc", file);
    status_ = std::make_unique<NML>(emc_messages(), "emcStatus", "xemc", file);
}

constexpr int64_t ROOM_RETRY_NS = 1'000'000;
constexpr int MOST_TRIES = 1000;

// A flood of others may have filled the queue; the server does this for programs on other computers.
bool EmcClient::send(RCS_CMD_MSG &m) {
    if (!remote() && command_->valid())
        for (int n = 0; n < MOST_TRIES && command_->get_space_available() < m.size + 2 * nml::MESSAGE_HEADER_BYTES; n++)
            kerf_clock_sleep_ns(ROOM_RETRY_NS);
    return command_->write(m, &serial_) == 0;
}

bool EmcClient::send_aside(RCS_CMD_MSG &m) {
    int unused = 0;
    return command_->write(m, &unused) == 0;
}

// The channel gives each status once and keeps it: whoever asks next finds it there.
void EmcClient::look_at_status() {
    if (status_->peek() == EMC_STAT_TYPE) {
        last_ = *status_->get<RCS_STAT_MSG>();
        seen_ = true;
    }
}

bool EmcClient::refresh(EMC_STAT *out) {
    look_at_status();
    bool good = seen_ && (status_->status == CMS_READ_OK || status_->status == CMS_READ_OLD);
    if (good) *out = *status_->get<EMC_STAT>();
    return good;
}

// What the status says of the last command. An unchanged status says what it said before.
EmcClient::Answer EmcClient::look() {
    look_at_status();
    if (!seen_) return Answer::none;
    int diff = last_.echo_serial_number - serial_;
    if (diff > 0) return Answer::done;
    if (diff < 0) return Answer::none;
    if (last_.status == RCS_DONE) return Answer::done;
    if (last_.status == RCS_ERROR) return Answer::error;
    return Answer::received;
}

static int64_t deadline(double timeout_s) {
    constexpr double FOR_EVER_S = 1e9; // what is longer has no place in ns
    return kerf_clock_now_ns() + static_cast<int64_t>(std::min(timeout_s, FOR_EVER_S) * 1e9);
}

bool EmcClient::wait_received(double timeout_s, double poll_s) {
    const int64_t until = deadline(timeout_s);
    for (;;) {
        if (look() != Answer::none) return true;
        int64_t now = kerf_clock_now_ns(), nap = static_cast<int64_t>(poll_s * 1e9);
        if (timeout_s >= 0) {
            if (now >= until) return false;
            nap = std::min(nap, until - now);
        }
        kerf_clock_sleep_ns(nap);
    }
}

int EmcClient::wait_done(double timeout_s, double poll_s) {
    const int64_t until = deadline(timeout_s);
    for (;;) {
        Answer a = look();
        if (a == Answer::done) return RCS_DONE;
        if (a == Answer::error) return RCS_ERROR;
        int64_t now = kerf_clock_now_ns(), nap = static_cast<int64_t>(poll_s * 1e9);
        if (timeout_s >= 0) {
            if (now >= until) return -1;
            nap = std::min(nap, until - now);
        }
        kerf_clock_sleep_ns(nap);
    }
}
