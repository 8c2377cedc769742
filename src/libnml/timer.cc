// SPDX-License-Identifier: GPL-2.0-or-later
//
// timer.cc - see timer.hh.
#include "timer.hh"

#include <algorithm>

#include "kerf_clock.h"

double etime() { return static_cast<double>(kerf_clock_now_ns()) * 1e-9; }
void esleep(double seconds) { kerf_clock_sleep_ns(static_cast<int64_t>(seconds * 1e9)); }

RCS_TIMER::RCS_TIMER(double period, SYNC_FUNC function, void *arg)
    : period_ns_(std::max<int64_t>(1, static_cast<int64_t>(period * 1e9))), function_(function), arg_(arg) {
    sync();
}

void RCS_TIMER::sync() {
    start_ns_ = kerf_clock_now_ns();
    next_ns_ = start_ns_ + period_ns_;
    slept_ns_ = 0;
}

int RCS_TIMER::wait() {
    const int64_t from = kerf_clock_now_ns();
    const int64_t missed = from > next_ns_ ? (from - next_ns_ + period_ns_ - 1) / period_ns_ : 0;
    next_ns_ += missed * period_ns_;
    if (function_) {
        if (function_(arg_) != 0) return -1;
    } else {
        kerf_clock_sleep_until_ns(next_ns_);
    }
    next_ns_ += period_ns_;
    slept_ns_ += kerf_clock_now_ns() - from;
    return static_cast<int>(missed);
}

double RCS_TIMER::load() const {
    const int64_t all = kerf_clock_now_ns() - start_ns_;
    return all > 0 ? 1.0 - static_cast<double>(slept_ns_) / static_cast<double>(all) : 0.0;
}
