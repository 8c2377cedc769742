/* SPDX-License-Identifier: GPL-2.0-or-later
 * rtapi_mutex.h - a spinning lock in a word of (shared) memory.
 *
 * Bit 0: 0 = free, 1 = taken. Not recursive, knows no owner: a process that dies
 * holding it leaves it taken. The _rd twins use the reverse (0 = taken, 1 =
 * free), so that fresh zero memory is locked until its maker gives it.
 * try returns 0 when it got the lock. [any]; get spins and yields: never in a
 * realtime cycle.
 */
#ifndef RTAPI_MUTEX_H
#define RTAPI_MUTEX_H

#include <sched.h>

typedef unsigned long rtapi_mutex_t;

static inline int rtapi_mutex_try(rtapi_mutex_t *mutex)
{
    return (int)(__atomic_fetch_or(mutex, 1UL, __ATOMIC_ACQUIRE) & 1UL);
}
static inline void rtapi_mutex_get(rtapi_mutex_t *mutex)
{
    while (rtapi_mutex_try(mutex)) {
        sched_yield();
    }
}
static inline void rtapi_mutex_give(rtapi_mutex_t *mutex)
{
    __atomic_fetch_and(mutex, ~1UL, __ATOMIC_RELEASE);
}

static inline int rtapi_mutex_try_rd(rtapi_mutex_t *mutex)
{
    return !(__atomic_fetch_and(mutex, ~1UL, __ATOMIC_ACQUIRE) & 1UL);
}
static inline void rtapi_mutex_get_rd(rtapi_mutex_t *mutex)
{
    while (rtapi_mutex_try_rd(mutex)) {
        sched_yield();
    }
}
static inline void rtapi_mutex_give_rd(rtapi_mutex_t *mutex)
{
    __atomic_fetch_or(mutex, 1UL, __ATOMIC_RELEASE);
}

#endif
