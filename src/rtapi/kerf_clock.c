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
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include "kerf_vclock.h"

/* Virtual time between looks at a child or a descriptor: grows from the first to
 * the second, so that a long wait costs little. */
#define LOOK_FIRST_NS 1000000
#define LOOK_LAST_NS 10000000

static int is_virtual;
static pthread_once_t once = PTHREAD_ONCE_INIT;
static _Thread_local int lent_to_child; /* our place is lent */

static void forget_after_fork(void)
{
    lent_to_child = 0;
}

static void choose(void)
{
    const char *mode = getenv("KERF_CLOCK");
    if (!mode || !*mode || strcmp(mode, "real") == 0) {
        return;
    }
    char *end = "";
    double pace = 0;
    if (strncmp(mode, "virtual:", 8) == 0) {
        pace = strtod(mode + 8, &end);
    } else if (strcmp(mode, "virtual") != 0) {
        end = "?";
    }
    if (*end || !(pace >= 0 && pace <= 1e9)) {
        fprintf(stderr, "KERF_CLOCK=%s is not \"real\", \"virtual\" or \"virtual:PACE\"; using real time\n", mode);
        return;
    }
    int result = vclock_attach(pace);
    if (result < 0) {
        fprintf(stderr, "virtual clock: cannot attach: %s; using real time\n", strerror(-result));
        return;
    }
    pthread_atfork(NULL, NULL, forget_after_fork);
    is_virtual = 1;
}

int kerf_clock_is_virtual(void)
{
    pthread_once(&once, choose);
    return is_virtual;
}

double kerf_clock_pace(void)
{
    return kerf_clock_is_virtual() ? vclock_pace() : 1;
}

int64_t kerf_clock_now_ns(void)
{
    if (kerf_clock_is_virtual()) return vclock_now();
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec * 1000000000LL + t.tv_nsec;
}

int kerf_clock_sleep_until_ns(int64_t when_ns)
{
    if (kerf_clock_is_virtual())
        return vclock_sleep_until(when_ns, vclock_joined() ? NULL : getenv(KERF_CLOCK_SLOT_ENV));
    struct timespec t = {when_ns / 1000000000, when_ns % 1000000000};
    return when_ns > 0 ? -clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, NULL) : 0;
}

int kerf_clock_sleep_ns(int64_t ns)
{
    return kerf_clock_sleep_until_ns(kerf_clock_now_ns() + (ns > 0 ? ns : 0));
}

int kerf_clock_join(const char *name, int prio)
{
    return kerf_clock_is_virtual() ? vclock_join(name, prio, getenv(KERF_CLOCK_SLOT_ENV)) : 0;
}

void kerf_clock_leave(void)
{
    if (kerf_clock_is_virtual()) vclock_leave();
}

int kerf_clock_joined(void)
{
    return kerf_clock_is_virtual() && vclock_joined();
}

void kerf_clock_suspend(void)
{
    if (kerf_clock_is_virtual()) vclock_suspend();
}

void kerf_clock_resume(void)
{
    if (kerf_clock_is_virtual()) vclock_resume();
}

static int64_t look_next(int64_t step_ns)
{
    return step_ns * 2 < LOOK_LAST_NS ? step_ns * 2 : LOOK_LAST_NS;
}

static int poll_virtual(struct pollfd *fds, nfds_t count, int64_t timeout_ns)
{
    if (timeout_ns < 0) { /* only the outside world ends it */
        kerf_clock_suspend();
        int n = poll(fds, count, -1);
        int err = errno;
        kerf_clock_resume();
        return n < 0 ? -err : n;
    }
    int64_t end = kerf_clock_now_ns() + timeout_ns, step_ns = LOOK_FIRST_NS;
    for (;;) {
        int n = poll(fds, count, 0);
        if (n != 0) {
            return n < 0 ? -errno : n;
        }
        int64_t now_ns = kerf_clock_now_ns();
        if (now_ns >= end) {
            return 0;
        }
        int result = kerf_clock_sleep_until_ns(end < now_ns + step_ns ? end : now_ns + step_ns);
        if (result < 0) {
            return result;
        }
        step_ns = look_next(step_ns);
    }
}

int kerf_clock_poll(struct pollfd *fds, nfds_t count, int64_t timeout_ns)
{
    if (kerf_clock_is_virtual()) return poll_virtual(fds, count, timeout_ns);
    struct timespec t = {timeout_ns / 1000000000, timeout_ns % 1000000000};
    int n = ppoll(fds, count, timeout_ns < 0 ? NULL : &t, NULL);
    return n < 0 ? -errno : n;
}

int kerf_clock_wait(int (*ready)(void *arg), void *arg, int64_t period_ns, int64_t timeout_ns)
{
    int64_t end = kerf_clock_now_ns() + timeout_ns;
    while (!ready(arg)) {
        if (timeout_ns >= 0 && kerf_clock_now_ns() >= end) return -ETIMEDOUT;
        int result = kerf_clock_sleep_ns(period_ns);
        if (result < 0) return result;
    }
    return 0;
}

int kerf_clock_lend(char *value, size_t size)
{
    if (size > 0) *value = 0;
    if (!kerf_clock_joined()) return 0;
    int result = vclock_lend(value, size);
    lent_to_child = result == 0;
    return result;
}

void kerf_clock_reclaim(void)
{
    if (lent_to_child) vclock_reclaim();
    lent_to_child = 0;
}

void kerf_clock_print(FILE *to)
{
    if (kerf_clock_is_virtual()) {
        vclock_print(to);
    } else {
        fprintf(to, "real time\n");
    }
}

int kerf_clock_reserve(char *value, size_t size, const char *name, int prio)
{
    if (size > 0) *value = 0;
    return kerf_clock_is_virtual() ? vclock_reserve(value, size, name, prio) : 0;
}

void kerf_clock_reserved_for(const char *value, pid_t pid)
{
    if (kerf_clock_is_virtual() && value && *value) vclock_reserved_for(value, pid);
}

void kerf_clock_unreserve(const char *value)
{
    if (kerf_clock_is_virtual() && value && *value) vclock_unreserve(value);
}

pid_t kerf_clock_waitpid(pid_t pid, int *status, int options)
{
    if (lent_to_child) {
        pid_t result = waitpid(pid, status, options);
        if (result != 0) kerf_clock_reclaim();
        return result;
    }
    if (!kerf_clock_joined() || (options & WNOHANG)) return waitpid(pid, status, options);
    for (int64_t step_ns = LOOK_FIRST_NS;; step_ns = look_next(step_ns)) {
        pid_t result = waitpid(pid, status, options | WNOHANG);
        if (result != 0) return result;
        if (kerf_clock_sleep_ns(step_ns) < 0) {
            errno = EINTR;
            return -1;
        }
    }
}
