/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * host_posix.c - back end: POSIX threads that sleep on CLOCK_MONOTONIC.
 *
 * Realtime: SCHED_FIFO with the task's priority on one CPU. Without: SCHED_OTHER,
 * and tasks take turns, as if one pre-empted the other never: cycles do not interleave.
 * Thread: init, start, stop [init]; the rest in the task [rt]
 */
#include "host.h"

#include <errno.h>
#include <limits.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>
#include <time.h>
#include "kerf_clock.h"

/* Turns without realtime: first come, first served, so that a task that is always late lets the
 * others in, and one that is alone catches up without giving its CPU away. */
static pthread_mutex_t turn_guard = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t turn_changed = PTHREAD_COND_INITIALIZER;
static unsigned turn_tickets; /* handed out */
static unsigned turn_serving; /* whose turn it is */
static int cpu = -1;

#define WAKE_SIGNAL (SIGRTMIN + 1) /* ends the sleep of a task that is deleted */

static void wake_handler(int sig)
{
    (void)sig;
}

static int posix_init(void)
{
    struct sigaction action = {.sa_handler = wake_handler};
    sigaction(WAKE_SIGNAL, &action, NULL);
    cpu = host_cpu();
    return 0;
}

/* Makes the pages of the stack present before the first cycle needs them. */
static void __attribute__((noinline)) stack_prefault(unsigned long size)
{
    volatile char block[16384];
    for (size_t i = 0; i < sizeof block; i += 1024) {
        block[i] = 0;
    }
    if (size > 2 * sizeof block) {
        stack_prefault(size - sizeof block);
    }
    block[0] = 1; /* keeps the call from becoming a loop on one block */
}

static void *thread_main(void *arg)
{
    struct task *t = arg;
    char name[16];
    snprintf(name, sizeof name, "rtapi_app:T#%d", t->id);
    pthread_setname_np(pthread_self(), name);
    prctl(PR_SET_TIMERSLACK, 1UL); /* ns; matters without realtime scheduling only */
    stack_prefault(t->stack - 65536);
    host_task_body(t);
    return NULL;
}

static int start(struct task *t, int policy)
{
    pthread_attr_t attr;
    struct sched_param param = {.sched_priority = t->prio};
    int err = pthread_attr_init(&attr);
    if (err) {
        return -err;
    }
    pthread_attr_setstacksize(&attr, t->stack);
    pthread_attr_setinheritsched(&attr, PTHREAD_EXPLICIT_SCHED);
    pthread_attr_setschedpolicy(&attr, policy);
    pthread_attr_setschedparam(&attr, &param);
    if (cpu >= 0) {
        cpu_set_t set;
        CPU_ZERO(&set);
        CPU_SET((size_t)cpu, &set);
        pthread_attr_setaffinity_np(&attr, sizeof set, &set);
    }
    sigset_t all, old; /* signals are for the command thread */
    sigfillset(&all);
    sigdelset(&all, SIGSEGV);
    sigdelset(&all, SIGILL);
    sigdelset(&all, SIGFPE);
    sigdelset(&all, SIGBUS);
    sigdelset(&all, WAKE_SIGNAL);
    pthread_sigmask(SIG_SETMASK, &all, &old);
    err = pthread_create(&t->thread, &attr, thread_main, t);
    pthread_sigmask(SIG_SETMASK, &old, NULL);
    pthread_attr_destroy(&attr);
    return -err;
}

static int start_rt(struct task *t)
{
    host_root_begin();
    int result = start(t, SCHED_FIFO);
    host_root_end();
    return result;
}

static int start_other(struct task *t)
{
    return start(t, SCHED_OTHER);
}

static void nothing(struct task *t)
{
    (void)t;
}

static void turn_take(struct task *t)
{
    (void)t;
    pthread_mutex_lock(&turn_guard);
    unsigned mine = turn_tickets++;
    while (mine != turn_serving) {
        pthread_cond_wait(&turn_changed, &turn_guard);
    }
    pthread_mutex_unlock(&turn_guard);
}

static void turn_give(struct task *t)
{
    (void)t;
    pthread_mutex_lock(&turn_guard);
    if (++turn_serving != turn_tickets) {
        pthread_cond_broadcast(&turn_changed);
    }
    pthread_mutex_unlock(&turn_guard);
}

static int64_t now(void)
{
    struct timespec ts;
    clock_gettime(CLOCK_MONOTONIC, &ts);
    return ts.tv_sec * 1000000000LL + ts.tv_nsec;
}

static void sleep_until(struct task *t, int64_t when_ns)
{
    struct timespec ts = {when_ns / 1000000000, when_ns % 1000000000};
    while (!atomic_load_explicit(&t->cancel, memory_order_relaxed) &&
           clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &ts, NULL) == EINTR) {
    }
}

static void sleep_in_turn(struct task *t, int64_t when_ns)
{
    turn_give(t);
    sleep_until(t, when_ns);
    turn_take(t);
}

/* A late task of many: those that wait come first. */
static void late_in_turn(struct task *t)
{
    turn_give(t);
    turn_take(t);
}

static void stop(struct task *t)
{
    struct timespec until;
    do { /* the signal may come just before the sleep begins: again */
        pthread_kill(t->thread, WAKE_SIGNAL);
        clock_gettime(CLOCK_REALTIME, &until);
        until.tv_nsec += 2000000;
        if (until.tv_nsec >= 1000000000) {
            until.tv_sec++;
            until.tv_nsec -= 1000000000;
        }
    } while (pthread_timedjoin_np(t->thread, NULL, &until) == ETIMEDOUT);
}

const struct rtapi_backend_ops backend_posix_rt = {
    .version = RTAPI_BACKEND_VERSION,
    .banner = "POSIX realtime",
    .warn_late = true,
    .prio_highest = 99,
    .prio_lowest = 1,
    .init = posix_init,
    .start = start_rt,
    .enter = nothing,
    .leave = nothing,
    .now = now,
    .sleep_until = sleep_until,
    .late = NULL,
    .stop = stop,
};

const struct rtapi_backend_ops backend_posix = {
    .version = RTAPI_BACKEND_VERSION,
    .banner = "POSIX non-realtime",
    .warn_late = false,
    .makes_up = true, /* what it drives is simulated: it keeps its rate on a busy computer */
    .prio_highest = 0,
    .prio_lowest = 0,
    .init = posix_init,
    .start = start_other,
    .enter = turn_take,
    .leave = turn_give,
    .now = now,
    .sleep_until = sleep_in_turn,
    .late = late_in_turn,
    .stop = stop,
};
