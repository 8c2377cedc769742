// SPDX-License-Identifier: GPL-2.0-or-later
//
// hal_number.hh - what #<_hal[name]> reads.
#ifndef KERF_HAL_NUMBER_HH
#define KERF_HAL_NUMBER_HH

#include <string>

// A pin, else a signal, else a parameter of that name as a number: bits are 0 or 1. False: there is
// none, or this process has no component in HAL. [any] non-realtime thread
bool hal_number(const char *name, double *value);

// The same; a process that has no component joins with the first question, as COMPONENT and its number, until it ends.
bool hal_number_joining(const std::string &component, const char *name, double *value);

#endif
