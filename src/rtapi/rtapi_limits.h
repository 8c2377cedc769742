/* SPDX-License-Identifier: GPL-2.0-or-later
 * rtapi_limits.h - limits of the C integer types. */
#ifndef RTAPI_LIMITS_H
#define RTAPI_LIMITS_H
#include <limits.h>
#endif
