// SPDX-License-Identifier: GPL-2.0-or-later
//
// spindle_guard.hh - whether a spindle may run: never by itself (docs/compatibility.md).
#pragma once

#include <chrono>

namespace vfd {

/// Whether a spindle may run. Invariants: (1) it does not while its drive is lost or disabled; (2) after that, after
/// disarm() and at the start it does not before the command to run has been seen FALSE while the drive answered.
class Guard {
public:
    /// `lost` FALSE: a drive that is asked nothing before it is enabled counts as there.
    explicit Guard(bool lost = true) : lost_(lost) {}

    /// After each request; `connected`: the link is there.
    void answered(bool good, bool connected);
    /// More than ten good answers in a row.
    bool ok() const { return good_ > OK_AFTER; }
    /// Nothing is known of the drive: no good answer for a second, or the connection is gone.
    bool lost() const { return lost_; }

    /// Once in a look, with `wanted` read from HAL before `enabled`: one signal may drive both.
    bool may_run(bool wanted, bool enabled);
    /// A fault, an emergency stop: the command has to come anew. `for_s`: what is seen within that time does not
    /// count (the program itself has cleared the pin).
    void disarm(double for_s = 0);

private:
    using Clock = std::chrono::steady_clock;
    static constexpr int OK_AFTER = 10, FAILURES = 2;
    static constexpr auto LOST_AFTER = std::chrono::seconds(1);

    int good_ = 0, bad_ = 0;
    bool lost_, armed_ = false;
    Clock::time_point last_good_, blind_until_;
};

} // namespace vfd
