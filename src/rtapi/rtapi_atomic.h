/* SPDX-License-Identifier: GPL-2.0-or-later
 * rtapi_atomic.h - atomic types that C and C++ files share. The operations are
 * those of <stdatomic.h> in C and of std::atomic in C++; both lay the types out
 * alike. */
#ifndef RTAPI_ATOMIC_H
#define RTAPI_ATOMIC_H

#ifdef __cplusplus
#include <atomic>
#define RTAPI_ATOMIC_(T) std::atomic<T>
#else
#include <stdatomic.h>
#include <stdbool.h>
#define RTAPI_ATOMIC_(T) _Atomic(T)
#endif

typedef RTAPI_ATOMIC_(bool) rtapi_atomic_bool;
typedef RTAPI_ATOMIC_(char) rtapi_atomic_char;
typedef RTAPI_ATOMIC_(signed char) rtapi_atomic_schar;
typedef RTAPI_ATOMIC_(unsigned char) rtapi_atomic_uchar;
typedef RTAPI_ATOMIC_(short) rtapi_atomic_short;
typedef RTAPI_ATOMIC_(unsigned short) rtapi_atomic_ushort;
typedef RTAPI_ATOMIC_(int) rtapi_atomic_int;
typedef RTAPI_ATOMIC_(unsigned int) rtapi_atomic_uint;
typedef RTAPI_ATOMIC_(long) rtapi_atomic_long;
typedef RTAPI_ATOMIC_(unsigned long) rtapi_atomic_ulong;
typedef RTAPI_ATOMIC_(long long) rtapi_atomic_llong;
typedef RTAPI_ATOMIC_(unsigned long long) rtapi_atomic_ullong;

#undef RTAPI_ATOMIC_
#endif
