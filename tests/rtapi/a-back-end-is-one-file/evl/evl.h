/* SPDX-License-Identifier: GPL-2.0-or-later
 * A stand-in for libevl: the documented calls that host_evl.c uses, over POSIX. */
#ifndef STAND_IN_EVL_H
#define STAND_IN_EVL_H
#include <time.h>
#define EVL_CLOCK_MONOTONIC (-CLOCK_MONOTONIC)
int evl_init(void);
int evl_attach_self(const char *fmt, ...) __attribute__((format(printf, 1, 2)));
int evl_detach_self(void);
int evl_unblock_thread(int efd);
int evl_read_clock(int clockfd, struct timespec *tp);
int evl_sleep_until(int clockfd, const struct timespec *timeout);
#endif
