/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * host_tasks.c - realtime tasks of the host: threads with a period, on the posix
 * or on the virtual clock.
 *
 * In:     function, priority, period (ns)
 * Out:    the function's waits end at start + n periods (+ PLL correction)
 * Thread: rtapi_task_new/start/delete [init]; rtapi_wait and pll calls in a task
 */
#include "host.h"

#include <errno.h>
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>
#include "kerf_clock.h"

#define MAX_TASKS 64
#define MIN_STACK (1UL << 20)

struct task {
    int used, prio;
    void (*code)(void *);
    void *arg;
    unsigned long stack;
    long period_ns;
    int64_t next_ns;
    long pll_ns;
    pthread_t thread;
    int started;
    _Atomic int stop;
};
static struct task tasks[MAX_TASKS];
static _Thread_local struct task *self;
static pthread_mutex_t turn = PTHREAD_MUTEX_INITIALIZER; /* without realtime scheduling cycles do not interleave */
static long clock_period;
static _Atomic int delay_reported;

static int policy(void)
{
    return host_realtime_type() > REALTIME_TYPE_NONE ? SCHED_FIFO : SCHED_OTHER;
}

static int takes_turns(void)
{
    return policy() == SCHED_OTHER && !kerf_clock_is_virtual();
}

long rtapi_clock_set_period(long ns)
{
    if (ns == 0) return clock_period;
    if (clock_period != 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "attempt to set period twice\n");
        return -EINVAL;
    }
    return clock_period = ns;
}

int rtapi_prio_highest(void)
{
    return sched_get_priority_max(policy());
}

int rtapi_prio_lowest(void)
{
    return sched_get_priority_min(policy());
}

static int clamped(int prio)
{
    int low = rtapi_prio_lowest(), high = rtapi_prio_highest();
    return prio < low ? low : prio > high ? high : prio;
}

int rtapi_prio_next_higher(int prio)
{
    return clamped(clamped(prio) + 1);
}

int rtapi_prio_next_lower(int prio)
{
    return clamped(clamped(prio) - 1);
}

int rtapi_task_new(void (*code)(void *), void *arg, int prio, int owner, unsigned long stack, int uses_fp)
{
    (void)owner, (void)uses_fp;
    if (prio < rtapi_prio_lowest() || prio > rtapi_prio_highest()) {
        rtapi_print_msg(RTAPI_MSG_ERR, "rtapi:task_new prio is not in bound lowest %i prio %i highest %i\n",
                        rtapi_prio_lowest(), prio, rtapi_prio_highest());
        return -EINVAL;
    }
    for (int i = 0; i < MAX_TASKS; i++) {
        if (tasks[i].used) continue;
        tasks[i] = (struct task){.used = 1, .code = code, .arg = arg, .prio = prio,
                                 .stack = stack < MIN_STACK ? MIN_STACK : stack};
        return i;
    }
    return -ENOSPC;
}

static void *run(void *arg)
{
    struct task *t = arg;
    int id = (int)(t - tasks);
    char name[16];
    snprintf(name, sizeof name, "rtapi_app:T#%d", id);
    pthread_setname_np(pthread_self(), name);
    pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, NULL);
    self = t;
    kerf_clock_join(name, KERF_CLOCK_PRIO_RT + (policy() == SCHED_FIFO ? 99 - t->prio : id));
    if (takes_turns()) pthread_mutex_lock(&turn);
    t->next_ns = kerf_clock_now_ns() + t->period_ns;
    t->code(t->arg);
    rtapi_print("ERROR: reached end of wrapper for task %d\n", id);
    return NULL;
}

static struct task *started_task(int id)
{
    return id >= 0 && id < MAX_TASKS && tasks[id].used ? &tasks[id] : NULL;
}

int rtapi_task_start(int id, unsigned long period_ns)
{
    struct task *t = started_task(id);
    if (!t || t->started) return -EINVAL;
    t->period_ns = (long)period_ns;
    atomic_store(&t->stop, 0);
    pthread_attr_t attr;
    pthread_attr_init(&attr);
    pthread_attr_setstacksize(&attr, t->stack);
    pthread_attr_setinheritsched(&attr, PTHREAD_EXPLICIT_SCHED);
    pthread_attr_setschedpolicy(&attr, policy());
    struct sched_param p = {.sched_priority = policy() == SCHED_FIFO ? t->prio : 0};
    pthread_attr_setschedparam(&attr, &p);
    cpu_set_t set;
    int cpu = host_realtime_cpu();
    if (cpu >= 0) {
        CPU_ZERO(&set);
        CPU_SET(cpu, &set);
        pthread_attr_setaffinity_np(&attr, sizeof set, &set);
    }
    int result = -pthread_create(&t->thread, &attr, run, t);
    pthread_attr_destroy(&attr);
    if (result < 0) {
        rtapi_print("rtapi_task_start(): %s\n", strerror(-result));
        return result;
    }
    t->started = 1;
    return 0;
}

int rtapi_task_delete(int id)
{
    struct task *t = started_task(id);
    if (!t) return -EINVAL;
    if (t->started) {
        atomic_store(&t->stop, 1);
        pthread_join(t->thread, NULL);
    }
    t->used = t->started = 0;
    return 0;
}

int rtapi_task_pause(int id)
{
    (void)id;
    return -ENOSYS;
}

int rtapi_task_resume(int id)
{
    (void)id;
    return -ENOSYS;
}

int rtapi_task_self(void)
{
    return self ? (int)(self - tasks) : -EINVAL;
}

void rtapi_task_self_resync(void)
{
    if (self) self->next_ns = kerf_clock_now_ns();
}

long long rtapi_task_pll_get_reference(void)
{
    return self ? self->next_ns : 0;
}

int rtapi_task_pll_set_correction(long ns)
{
    if (!self) return -EINVAL;
    long most = self->period_ns / 100;
    self->pll_ns = ns > most ? most : ns < -most ? -most : ns;
    return 0;
}

void rtapi_wait(void)
{
    struct task *t = self;
    if (!t) return;
    t->next_ns += t->period_ns + t->pll_ns;
    if (takes_turns()) pthread_mutex_unlock(&turn);
    int64_t now = kerf_clock_now_ns();
    if (t->next_ns < now && !kerf_clock_is_virtual()) {
        if (policy() == SCHED_FIFO && !atomic_exchange(&delay_reported, 1)) {
            rtapi_print_msg(RTAPI_MSG_ERR,
                            "Unexpected realtime delay on task %d with period %ld\n"
                            "This Message will only display once per session.\n"
                            "Run the Latency Test and resolve before continuing.\n",
                            (int)(t - tasks), t->period_ns);
        }
    } else {
        kerf_clock_sleep_until_ns(t->next_ns);
    }
    if (atomic_load_explicit(&t->stop, memory_order_relaxed)) {
        kerf_clock_leave();
        pthread_exit(NULL);
    }
    if (takes_turns()) pthread_mutex_lock(&turn);
}
