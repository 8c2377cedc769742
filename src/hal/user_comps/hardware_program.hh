// SPDX-License-Identifier: GPL-2.0-or-later
//
// hardware_program.hh - for programs that serve hardware: time, and their end.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

#include "kerf_clock.h"

/// TRUE after SIGINT, SIGTERM or SIGHUP (its terminal is closed), once begin_hardware_program() has run.
inline std::atomic<bool> ending{false};

/// Once, at the start. Virtual time does not wait for the program: its devices live in real time.
inline void begin_hardware_program(const char *name) {
    struct sigaction action = {};
    action.sa_handler = [](int) { ending = true; };
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    struct sigaction hangup = {};
    sigaction(SIGHUP, nullptr, &hangup);
    if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr); // not under nohup
    kerf_clock_join(name, KERF_CLOCK_PRIO_USER);
    kerf_clock_leave();
}

/// Waits so long, or until the program is to end.
inline void pause_s(double seconds) {
    using Clock = std::chrono::steady_clock;
    constexpr auto LOOK = std::chrono::milliseconds(20);
    const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    for (auto now = Clock::now(); !ending && now < end; now = Clock::now())
        std::this_thread::sleep_for(std::min<Clock::duration>(end - now, LOOK));
}
