// SPDX-License-Identifier: GPL-2.0-or-later
//
// timer.hh - periods for a loop, on the clock of kerf_clock.h. [task]
#ifndef KERF_TIMER_HH
#define KERF_TIMER_HH

#include <cstdint>

double etime();             // the clock, s
void esleep(double seconds);

class RCS_TIMER {
public:
    // Waits for the next beat of something else; 0, or -1 when that failed.
    typedef int (*SYNC_FUNC)(void *arg);

    // period in s; without a function the clock beats, the first time one period from now.
    explicit RCS_TIMER(double period, SYNC_FUNC function = nullptr, void *arg = nullptr);
    // Sleeps to the end of the current period. One that is over already is missed, as are those
    // after it: then to the end of the one under way. Whole periods missed; -1: the function failed.
    int wait();
    // The part of the time since the start, or the last sync, that was not slept: 0 to 1.
    double load() const;
    // Now a period begins.
    void sync();

private:
    int64_t period_ns_;
    SYNC_FUNC function_;
    void *arg_;
    int64_t start_ns_, next_ns_, slept_ns_;
};

#endif
