/* SPDX-License-Identifier: GPL-2.0-or-later
 * rtapi_vsnprintf.h - kernel builds format by themselves; here rtapi_vsnprintf
 * (rtapi.h) is the C library's. */
#ifndef RTAPI_VSNPRINTF_H
#define RTAPI_VSNPRINTF_H
#include <stdarg.h>
#include <stdio.h>
#endif
