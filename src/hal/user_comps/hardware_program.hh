// SPDX-License-Identifier: GPL-2.0-or-later
//
// hardware_program.hh - for programs that serve hardware: time, and their end.
#pragma once

#include <atomic>
#include <csignal>

#include "kerf_clock.h"

/// TRUE after SIGINT or SIGTERM, once begin_hardware_program() has run.
inline std::atomic<bool> ending{false};

/// Once, at the start. Virtual time does not wait for the program: its devices live in real time.
inline void begin_hardware_program(const char *name) {
    struct sigaction action = {};
    action.sa_handler = [](int) { ending = true; };
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    kerf_clock_join(name, KERF_CLOCK_PRIO_USER);
    kerf_clock_leave();
}
