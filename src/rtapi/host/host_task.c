/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * host_task.c - realtime tasks: table, periods, lateness.
 *
 * In:     rtapi_task_* calls of modules
 * Out:    the task's code called in a thread of the back end
 * Thread: new, start, delete [init]; rtapi_wait and pll [rt]
 * Method: next wake = last due time + period + pll correction. A cycle that is
 *         late begins at once and none is left out, so the number of cycles
 *         always fits the time.
 */
#include "host.h"

#include <dlfcn.h>
#include <errno.h>
#include <string.h>
#include "kerf_clock.h"

static struct task tasks[MAX_TASKS];
static __thread struct task *self;
static long clock_period_ns;
static const struct rtapi_backend_ops *backend;
static bool backend_ready;

const struct rtapi_backend_ops *host_backend_choose(void)
{
    if (kerf_clock_is_virtual()) {
        backend = &backend_virtual;
#ifdef KERF_EVL
    } else if (host_realtime_type() == REALTIME_TYPE_XENOMAI_EVL) {
        backend = &backend_evl;
#endif
    } else if (host_realtime_type() > REALTIME_TYPE_NONE) {
        backend = &backend_posix_rt;
    } else {
        backend = &backend_posix;
    }
    return backend;
}

const struct rtapi_backend_ops *host_backend(void)
{
    return backend;
}

static struct task *task_of(int id)
{
    return id >= 0 && id < MAX_TASKS && atomic_load(&tasks[id].state) != TASK_FREE ? &tasks[id] : NULL;
}

/* ---- Priorities --------------------------------------------------------- */

int rtapi_prio_highest(void)
{
    return backend->prio_highest;
}

int rtapi_prio_lowest(void)
{
    return backend->prio_lowest;
}

static int prio_clamp(int prio)
{
    return prio > backend->prio_highest ? backend->prio_highest
           : prio < backend->prio_lowest ? backend->prio_lowest
                                         : prio;
}

int rtapi_prio_next_higher(int prio)
{
    return prio_clamp(prio_clamp(prio) + 1);
}

int rtapi_prio_next_lower(int prio)
{
    return prio_clamp(prio_clamp(prio) - 1);
}

/* ---- Time --------------------------------------------------------------- */

long rtapi_clock_set_period(long ns)
{
    if (ns == 0) {
        return clock_period_ns;
    }
    if (clock_period_ns != 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "attempt to set period twice\n");
        return -EINVAL;
    }
    clock_period_ns = ns;
    return ns;
}

long rtapi_delay_max(void)
{
    return 10000;
}

void rtapi_delay(long ns)
{
    /* Outside a task time may stand still for the sake of the caller's client:
     * the wall clock serves. A task in virtual time has no delays to wait for. */
    struct timespec t = {0, ns < 10000 ? ns : 10000};
    if (ns > 0 && !(self && kerf_clock_is_virtual())) {
        clock_nanosleep(CLOCK_MONOTONIC, 0, &t, NULL);
    }
}

/* ---- Tasks -------------------------------------------------------------- */

int rtapi_task_new(void (*code)(void *), void *arg, int prio, int owner, unsigned long stack, int uses_fp)
{
    (void)uses_fp;
    if (prio > backend->prio_highest || prio < backend->prio_lowest) {
        rtapi_print_msg(RTAPI_MSG_ERR, "rtapi:task_new prio is not in bound lowest %i prio %i highest %i\n",
                        backend->prio_lowest, prio, backend->prio_highest);
        return -EINVAL;
    }
    for (int id = 0; id < MAX_TASKS; id++) {
        struct task *t = &tasks[id];
        if (atomic_load(&t->state) == TASK_FREE) {
            memset(t, 0, sizeof *t);
            t->id = id;
            t->code = code;
            t->arg = arg;
            t->prio = prio;
            t->owner = owner;
            t->slot = -1;
            t->stack = stack < TASK_STACK_MIN ? TASK_STACK_MIN : stack;
            atomic_store(&t->state, TASK_STOPPED);
            return id;
        }
    }
    return -ENOSPC;
}

int rtapi_task_start(int id, unsigned long period_ns)
{
    struct task *t = task_of(id);
    if (!t || atomic_load(&t->state) == TASK_RUNNING) {
        return -EINVAL;
    }
    if (!backend_ready) {
        int result = backend->init();
        if (result < 0) {
            rtapi_print_msg(RTAPI_MSG_ERR, "rtapi_task_start(): %s\n", strerror(-result));
            return result;
        }
        backend_ready = true;
    }
    t->period_ns = period_ns;
    t->next_ns = backend->now() + (int64_t)period_ns;
    atomic_store(&t->state, TASK_RUNNING);
    int result = backend->start(t);
    if (result < 0) {
        atomic_store(&t->state, TASK_STOPPED);
        rtapi_print_msg(RTAPI_MSG_ERR, "rtapi_task_start(): %s\n", strerror(-result));
    }
    return result < 0 ? result : 0;
}

int rtapi_task_delete(int id)
{
    struct task *t = task_of(id);
    if (!t || t == self) {
        return -EINVAL;
    }
    if (atomic_load(&t->state) == TASK_RUNNING) {
        atomic_store(&t->cancel, true);
        backend->stop(t);
    }
    atomic_store(&t->state, TASK_FREE);
    return 0;
}

void host_tasks_end(void)
{
    for (int id = 0; id < MAX_TASKS; id++) {
        rtapi_task_delete(id);
    }
}

void host_tasks_end_of(const void *base, const char *module)
{
    for (int id = 0; id < MAX_TASKS; id++) {
        struct task *t = task_of(id);
        Dl_info where;
        if (t && dladdr((const void *)(uintptr_t)t->code, &where) && where.dli_fbase == base) {
            rtapi_print_msg(RTAPI_MSG_ERR, "%s: its exit left task %d, which is ended\n", module, id);
            rtapi_task_delete(id);
        }
    }
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
    return self ? self->id : -EINVAL;
}

void rtapi_task_self_resync(void)
{
    if (self) {
        self->next_ns = backend->now();
    }
}

long long rtapi_task_pll_get_reference(void)
{
    return self ? self->next_ns : 0;
}

int rtapi_task_pll_set_correction(long ns)
{
    if (!self) {
        return -EINVAL;
    }
    long limit = (long)(self->period_ns / 100);
    self->pll_ns = ns > limit ? limit : ns < -limit ? -limit : ns;
    return 0;
}

void host_task_body(struct task *task)
{
    self = task;
    backend->enter(task);
    if (!atomic_load(&task->cancel)) {
        task->code(task->arg);
        if (!atomic_load(&task->cancel)) {
            rtapi_print_msg(RTAPI_MSG_ERR, "ERROR: reached end of wrapper for task %d\n", task->id);
        }
    }
    backend->leave(task);
    self = NULL;
}

/* ---- Lateness ----------------------------------------------------------- */

static void lateness_count(struct task *t, int64_t now_ns, int64_t late_ns, int64_t overruns)
{
    struct rtapi_lateness *l = &t->late;
    unsigned seq = atomic_load_explicit(&t->sequence, memory_order_relaxed);
    atomic_store_explicit(&t->sequence, seq + 1, memory_order_relaxed);
    atomic_thread_fence(memory_order_release);
    if (atomic_load_explicit(&t->reset, memory_order_relaxed)) {
        memset(l, 0, sizeof *l);
        atomic_store_explicit(&t->reset, false, memory_order_relaxed);
    }
    int64_t late = late_ns > 0 ? late_ns : 0;
    unsigned scaled = late >> 10 > 0x7fffffff ? 0x7fffffffU : (unsigned)(late >> 10);
    int bin = scaled ? 32 - __builtin_clz(scaled) : 0;
    l->cycles++;
    l->overruns += overruns;
    l->last_ns = late;
    l->bins[bin < RTAPI_LATENESS_BINS ? bin : RTAPI_LATENESS_BINS - 1]++;
    if (late > l->worst_ns) {
        l->worst_ns = late;
        l->worst_time = now_ns;
    }
    atomic_store_explicit(&t->sequence, seq + 2, memory_order_release);
}

int rtapi_task_lateness(int id, struct rtapi_lateness *out)
{
    struct task *t = task_of(id);
    if (!t || !out) {
        return -EINVAL;
    }
    /* The writer needs nanoseconds; 1000 rounds are ages. */
    for (int tries = 0; tries < 1000; tries++) {
        unsigned before = atomic_load_explicit(&t->sequence, memory_order_acquire);
        *out = t->late;
        atomic_thread_fence(memory_order_acquire);
        if (!(before & 1) && atomic_load_explicit(&t->sequence, memory_order_relaxed) == before) {
            break;
        }
    }
    return 0;
}

int rtapi_task_lateness_reset(int id)
{
    struct task *t = task_of(id);
    if (!t) {
        return -EINVAL;
    }
    atomic_store(&t->reset, true);
    return 0;
}

static void warn_once(const struct task *t)
{
    static atomic_flag said = ATOMIC_FLAG_INIT;
    if (!atomic_flag_test_and_set(&said)) {
        rtapi_print_msg(RTAPI_MSG_ERR,
                        "Unexpected realtime delay on task %d with period %ld\n"
                        "This Message will only display once per session.\n"
                        "Run the Latency Test and resolve before continuing.\n",
                        t->id, (long)t->period_ns);
    }
}

/* A task that was held up for more cycles than this goes on with its next one. Run one after the other at once, those
 * it missed would send a motor all the steps of the stall in no time. */
#define MOST_MADE_UP 10

void rtapi_wait(void)
{
    struct task *t = self;
    if (!t) {
        return;
    }
    t->next_ns += (int64_t)t->period_ns + t->pll_ns;
    int64_t now_ns = backend->now();
    bool overrun = t->next_ns < now_ns;
    int64_t due_ns = t->next_ns, missed = overrun ? (now_ns - due_ns) / (int64_t)t->period_ns : 0;
    if (!backend->makes_up && missed > MOST_MADE_UP) {
        t->next_ns += missed * (int64_t)t->period_ns;
    } else {
        missed = 0;
    }
    if (overrun) {
        if (backend->warn_late) {
            warn_once(t);
        }
        if (backend->late) {
            backend->late(t);
        }
    } else {
        backend->sleep_until(t, t->next_ns);
        now_ns = backend->now();
    }
    if (atomic_load_explicit(&t->cancel, memory_order_relaxed)) {
        backend->leave(t);
        pthread_exit(NULL);
    }
    lateness_count(t, now_ns, now_ns - due_ns, missed + overrun);
}
