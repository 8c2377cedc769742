// SPDX-License-Identifier: GPL-2.0-or-later
//
// hardware_time.hh - for programs that wait for hardware.
#pragma once

#include "kerf_clock.h"

/// Virtual time does not wait for this program: its devices live in real time. Once, at the start.
inline void live_in_real_time(const char *program) {
    kerf_clock_join(program, KERF_CLOCK_PRIO_USER);
    kerf_clock_leave();
}
