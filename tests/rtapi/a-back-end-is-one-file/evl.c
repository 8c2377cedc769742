/* SPDX-License-Identifier: GPL-2.0-or-later
 * The stand-in's library. Calls that break libevl's rules end the process: sleeping without
 * being attached, detaching twice, a name that another thread has. */
#include <errno.h>
#include <evl/evl.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define THREADS 8
static struct { char name[64]; _Atomic int used, unblock; } threads[THREADS];
static __thread int self = -1;
static _Atomic int ready;

static void broken(const char *rule)
{
    fprintf(stderr, "stand-in of EVL: %s\n", rule);
    abort();
}

int evl_init(void)
{
    ready = 1;
    return 0;
}

int evl_attach_self(const char *fmt, ...)
{
    char name[64];
    va_list ap;
    va_start(ap, fmt);
    vsnprintf(name, sizeof name, fmt, ap);
    va_end(ap);
    if (!ready || self >= 0) {
        broken("attached twice, or before evl_init");
    }
    for (int i = 0; i < THREADS; i++) {
        if (threads[i].used && strcmp(threads[i].name, name) == 0) {
            return -EEXIST;
        }
    }
    for (int i = 0; i < THREADS; i++) {
        if (!atomic_exchange(&threads[i].used, 1)) {
            strcpy(threads[i].name, name);
            threads[i].unblock = 0;
            self = i;
            fprintf(stderr, "EVL: attached T#%s\n", strrchr(name, '#') + 1);
            return i + 100;
        }
    }
    return -ENOMEM;
}

int evl_detach_self(void)
{
    if (self < 0) {
        broken("detached without being attached");
    }
    fprintf(stderr, "EVL: detached T#%s\n", strrchr(threads[self].name, '#') + 1);
    threads[self].used = 0;
    self = -1;
    return 0;
}

int evl_unblock_thread(int efd)
{
    if (efd < 100 || efd >= 100 + THREADS) {
        return -EBADF;
    }
    threads[efd - 100].unblock = 1;
    return 0;
}

int evl_read_clock(int clockfd, struct timespec *tp)
{
    return clock_gettime(-clockfd, tp);
}

int evl_sleep_until(int clockfd, const struct timespec *when)
{
    if (self < 0) {
        broken("a thread that is not attached sleeps");
    }
    for (;;) {
        struct timespec now, next;
        clock_gettime(-clockfd, &now);
        if (now.tv_sec > when->tv_sec || (now.tv_sec == when->tv_sec && now.tv_nsec >= when->tv_nsec)) {
            return 0;
        }
        if (atomic_exchange(&threads[self].unblock, 0)) {
            return -EINTR;
        }
        next = now;
        next.tv_nsec += 1000000;
        if (next.tv_nsec >= 1000000000) {
            next.tv_sec++;
            next.tv_nsec -= 1000000000;
        }
        if (next.tv_sec > when->tv_sec || (next.tv_sec == when->tv_sec && next.tv_nsec > when->tv_nsec)) {
            next = *when;
        }
        clock_nanosleep(-clockfd, TIMER_ABSTIME, &next, NULL);
    }
}
