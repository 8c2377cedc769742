/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * kerf_clock.c - the clock's interface: real time here, virtual time by
 * kerf_vclock.c.
 *
 * In:     KERF_CLOCK of the environment
 * Thread: see kerf_clock.h
 */
#include "kerf_clock.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <time.h>

int kerf_clock_is_virtual(void)
{
    return 0;
}

double kerf_clock_pace(void)
{
    return 1;
}

int64_t kerf_clock_now_ns(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec * 1000000000LL + t.tv_nsec;
}

int kerf_clock_sleep_until_ns(int64_t when_ns)
{
    struct timespec t = {when_ns / 1000000000, when_ns % 1000000000};
    return when_ns > 0 ? -clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, NULL) : 0;
}

int kerf_clock_sleep_ns(int64_t ns)
{
    return kerf_clock_sleep_until_ns(kerf_clock_now_ns() + (ns > 0 ? ns : 0));
}

int kerf_clock_join(const char *name, int prio)
{
    (void)name, (void)prio;
    return 0;
}

void kerf_clock_leave(void)
{
}

int kerf_clock_joined(void)
{
    return 0;
}

void kerf_clock_suspend(void)
{
}

void kerf_clock_resume(void)
{
}

int kerf_clock_poll(struct pollfd *fds, nfds_t count, int64_t timeout_ns)
{
    struct timespec t = {timeout_ns / 1000000000, timeout_ns % 1000000000};
    int n = ppoll(fds, count, timeout_ns < 0 ? NULL : &t, NULL);
    return n < 0 ? -errno : n;
}

int kerf_clock_wait(int (*ready)(void *arg), void *arg, int64_t period_ns, int64_t timeout_ns)
{
    int64_t end = kerf_clock_now_ns() + timeout_ns;
    while (!ready(arg)) {
        if (timeout_ns >= 0 && kerf_clock_now_ns() >= end) {
            return -ETIMEDOUT;
        }
        int result = kerf_clock_sleep_ns(period_ns);
        if (result < 0) {
            return result;
        }
    }
    return 0;
}

int kerf_clock_lend(char *value, size_t size)
{
    if (size > 0) {
        *value = 0;
    }
    return 0;
}

void kerf_clock_reclaim(void)
{
}

int kerf_clock_reserve(char *value, size_t size, const char *name, int prio)
{
    (void)name, (void)prio;
    if (size > 0) {
        *value = 0;
    }
    return 0;
}

void kerf_clock_reserved_for(const char *value, pid_t pid)
{
    (void)value, (void)pid;
}

void kerf_clock_unreserve(const char *value)
{
    (void)value;
}

pid_t kerf_clock_waitpid(pid_t pid, int *status, int options)
{
    return waitpid(pid, status, options);
}
