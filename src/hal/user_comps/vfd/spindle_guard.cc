// SPDX-License-Identifier: GPL-2.0-or-later
//
// spindle_guard.cc - see spindle_guard.hh.
#include "spindle_guard.hh"

#include <algorithm>

namespace vfd {

void Guard::answered(bool good, bool connected) {
    auto now = Clock::now();
    if (good) {
        good_ = std::min(good_ + 1, OK_AFTER + 1);
        bad_ = 0;
        lost_ = false;
        last_good_ = now;
        return;
    }
    good_ = 0;
    bad_ = std::min(bad_ + 1, FAILURES);
    if (!connected || (bad_ >= FAILURES && now - last_good_ >= LOST_AFTER)) {
        lost_ = true;
        armed_ = false;
    }
}

bool Guard::may_run(bool wanted, bool enabled) {
    if (!wanted && !lost_ && Clock::now() >= blind_until_) armed_ = true;
    if (wanted && !enabled) armed_ = false;
    return wanted && enabled && armed_;
}

void Guard::disarm(double for_s) {
    armed_ = false;
    if (for_s > 0)
        blind_until_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(for_s));
}

} // namespace vfd
