/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * host_evl.c - back end: threads of the EVL core (Xenomai 4), through libevl.
 *
 * Built where configure finds <evl/evl.h>. Written from libevl's documented calls (evl_attach_self,
 * evl_sleep_until, evl_unblock_thread, evl_detach_self: https://v4.xenomai.org/core/user-api);
 * it has run with a stand-in for that library (tests/rtapi/a-back-end-is-one-file), not on an
 * EVL kernel yet.
 *
 * A task is a SCHED_FIFO thread that attaches itself to the core; from then on it sleeps out of
 * band. A component that calls the kernel in its cycle is brought in band by the core and goes
 * on; EVL counts that (evl ps -l). EVL_CLOCK_MONOTONIC has the time of CLOCK_MONOTONIC.
 * Thread: init, start, stop [init]; the rest in the task [rt]
 */
#include "host.h"

#include <errno.h>
#include <evl/evl.h>
#include <grp.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#ifndef CONTROL
#define CONTROL "/dev/evl/control"
#endif

static int cpu = -1;

/* Whether the core runs and this user may use it: root, or a member of the device's group. */
bool host_evl_usable(void)
{
    struct stat control;
    gid_t groups[256];
    if (stat(CONTROL, &control) != 0) {
        return false;
    }
    if (geteuid() == 0) {
        return true;
    }
    int n = getgroups(sizeof groups / sizeof *groups, groups);
    for (int i = 0; i < n && control.st_gid != 0; i++) {
        if (groups[i] == control.st_gid) {
            return true;
        }
    }
    if (control.st_gid != 0 && getegid() == control.st_gid) {
        return true;
    }
    fprintf(stderr, "Note: %s exists, but this user is not in its group: EVL is not used.\n", CONTROL);
    return false;
}

static int evl_backend_init(void)
{
    cpu = host_cpu();
    return evl_init();
}

static void *thread_main(void *arg)
{
    struct task *t = arg;
    host_task_body(t);
    return NULL;
}

static int start(struct task *t)
{
    pthread_attr_t attr;
    struct sched_param param = {.sched_priority = t->prio};
    sigset_t all, old; /* signals are for the command thread */
    t->slot = -1;
    pthread_attr_init(&attr);
    pthread_attr_setstacksize(&attr, t->stack);
    pthread_attr_setinheritsched(&attr, PTHREAD_EXPLICIT_SCHED);
    pthread_attr_setschedpolicy(&attr, SCHED_FIFO);
    pthread_attr_setschedparam(&attr, &param);
    if (cpu >= 0) {
        cpu_set_t set;
        CPU_ZERO(&set);
        CPU_SET((size_t)cpu, &set);
        pthread_attr_setaffinity_np(&attr, sizeof set, &set);
    }
    sigfillset(&all);
    sigdelset(&all, SIGSEGV);
    sigdelset(&all, SIGILL);
    sigdelset(&all, SIGFPE);
    sigdelset(&all, SIGBUS);
    host_root_begin();
    pthread_sigmask(SIG_SETMASK, &all, &old);
    int err = pthread_create(&t->thread, &attr, thread_main, t);
    pthread_sigmask(SIG_SETMASK, &old, NULL);
    host_root_end();
    pthread_attr_destroy(&attr);
    return -err;
}

/* The name is that of an EVL element: unique on the machine. */
static void enter(struct task *t)
{
    int efd = evl_attach_self("rtapi_app:%d:T#%d", (int)getpid(), t->id);
    if (efd < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "rtapi_app: task %d: evl_attach_self: %s\n", t->id, strerror(-efd));
    }
    t->slot = efd;
}

static void leave(struct task *t)
{
    if (t->slot >= 0) {
        evl_detach_self();
    }
    t->slot = -1;
}

static int64_t now(void)
{
    struct timespec ts;
    evl_read_clock(EVL_CLOCK_MONOTONIC, &ts);
    return ts.tv_sec * 1000000000LL + ts.tv_nsec;
}

static void sleep_until(struct task *t, int64_t when_ns)
{
    struct timespec ts = {when_ns / 1000000000, when_ns % 1000000000};
    while (!atomic_load_explicit(&t->cancel, memory_order_relaxed) &&
           evl_sleep_until(EVL_CLOCK_MONOTONIC, &ts) == -EINTR) {
    }
}

static void stop(struct task *t)
{
    struct timespec until;
    do { /* the task may not sleep yet: again */
        int efd = t->slot;
        if (efd >= 0) {
            evl_unblock_thread(efd);
        }
        clock_gettime(CLOCK_REALTIME, &until);
        until.tv_nsec += 2000000;
        if (until.tv_nsec >= 1000000000) {
            until.tv_sec++;
            until.tv_nsec -= 1000000000;
        }
    } while (pthread_timedjoin_np(t->thread, NULL, &until) == ETIMEDOUT);
}

const struct rtapi_backend_ops backend_evl = {
    .version = RTAPI_BACKEND_VERSION,
    .banner = "XENOMAI4 EVL realtime",
    .warn_late = true,
    .prio_highest = 98, /* 99 is the core's own */
    .prio_lowest = 1,
    .init = evl_backend_init,
    .start = start,
    .enter = enter,
    .leave = leave,
    .now = now,
    .sleep_until = sleep_until,
    .late = NULL,
    .stop = stop,
};
