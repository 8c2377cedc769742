/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * host_virtual.c - back end: tasks as participants of the instance's virtual
 * clock. Cycles never overlap and are never late.
 * Thread: start, stop [init]; the rest in the task [rt]
 */
#include "host.h"

#include <signal.h>
#include <stdio.h>
#include "kerf_clock.h"
#include "kerf_vclock.h"

static int virtual_init(void)
{
    return 0;
}

static void *thread_main(void *arg)
{
    struct task *t = arg;
    char name[16];
    snprintf(name, sizeof name, "rtapi_app:T#%d", t->id);
    pthread_setname_np(pthread_self(), name);
    host_task_body(t);
    return NULL;
}

static int start(struct task *t)
{
    char name[32];
    snprintf(name, sizeof name, "realtime task %d", t->id);
    /* The place exists before the thread: the first cycle comes at this moment,
     * however long the thread takes to start. */
    t->slot = vclock_place_new(name, KERF_CLOCK_PRIO_RT + backend_virtual.prio_highest - t->prio);
    if (t->slot < 0) {
        return t->slot;
    }
    pthread_attr_t attr;
    sigset_t all, old;
    pthread_attr_init(&attr);
    pthread_attr_setstacksize(&attr, t->stack);
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &old);
    int err = pthread_create(&t->thread, &attr, thread_main, t);
    pthread_sigmask(SIG_SETMASK, &old, NULL);
    pthread_attr_destroy(&attr);
    if (err) {
        vclock_place_drop(t->slot);
    }
    return -err;
}

static void enter(struct task *t)
{
    vclock_place_adopt(t->slot, &t->cancel);
}

static void leave(struct task *t)
{
    (void)t;
    vclock_leave();
}

static int64_t now(void)
{
    return vclock_now();
}

static void sleep_until(struct task *t, int64_t when_ns)
{
    vclock_sleep_cancelable(when_ns, &t->cancel);
}

/* Time moved on within a cycle: only a task that itself slept can be late. */
static void late(struct task *t)
{
    vclock_sleep_cancelable(vclock_now(), &t->cancel);
}

static void stop(struct task *t)
{
    vclock_poke(t->slot);
    pthread_join(t->thread, NULL);
}

const struct rtapi_backend_ops backend_virtual = {
    .version = RTAPI_BACKEND_VERSION,
    .banner = "virtual time",
    .warn_late = false,
    .prio_highest = 99,
    .prio_lowest = 1,
    .init = virtual_init,
    .start = start,
    .enter = enter,
    .leave = leave,
    .now = now,
    .sleep_until = sleep_until,
    .late = late,
    .stop = stop,
};
