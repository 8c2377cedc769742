/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_thread.c - functions, threads, and the cycle that runs them.
 *
 * In:     functions of realtime components, periods in ns
 * Out:    .time and .tmax (ns) of functions and threads, .threadbeat (cycles)
 * Thread: thread_task [rt]; everything else [init]
 * Method: a thread walks a list that is never changed once published; a change
 *         publishes a new list and waits until the cycle that may still use the
 *         old one is over.
 */
#include "hal_priv.h"

#include <errno.h>
#include <string.h>
#include <time.h>

/* ---- Lists of functions ------------------------------------------------------------ */

static size_t flist_size(uint32_t count)
{
    return sizeof(struct hal_flist) + count * sizeof(hal_off);
}

/* Waits until the cycle that may be running is over. false: it does not end (the
 * host hangs or is stopped). */
static bool cycle_over(struct hal_thread *t)
{
    struct timespec pause = {0, 20000};
    struct timespec now, until;
    atomic_thread_fence(memory_order_seq_cst);
    uint32_t seen = atomic_load(&t->cycle);
    if (!(seen & 1)) {
        return true;
    }
#ifdef RTAPI
    if (rtapi_task_self() >= 0) {
        return false; /* called from a cycle: it can not wait for itself */
    }
#endif
    clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_sec += 2;
    do {
        if (atomic_load(&t->cycle) != seen) {
            return true;
        }
        nanosleep(&pause, NULL);
        clock_gettime(CLOCK_MONOTONIC, &now);
    } while (now.tv_sec < until.tv_sec || (now.tv_sec == until.tv_sec && now.tv_nsec < until.tv_nsec));
    return halp_process_gone(&hal_data->host);
}

#ifdef RTAPI
void halp_cycles_over(void)
{
    bool told = false;
    for (struct hal_thread *t = halp_first(HAL_KIND_THREAD); t; t = halp_next(t)) {
        while (rtapi_task_self() < 0 && !cycle_over(t)) {
            if (!told) {
                halp_err("HAL: ERROR: thread '%s' does not end its cycle; waiting to unload\n", t->o.name);
                told = true;
            }
        }
    }
}
#endif

/* Makes fresh the list of t (place: &t->list or &t->inits) and gives the old one
 * back when nobody can be using it any more. */
static void publish(struct hal_thread *t, _Atomic hal_off *place, hal_off fresh)
{
    hal_off old = atomic_load(place);
    atomic_store(place, fresh);
    if (old && cycle_over(t)) {
        halp_block_free(old, flist_size(((struct hal_flist *)halp_ptr(old))->count));
    }
}

static uint32_t flist_count(hal_off list)
{
    return list ? ((struct hal_flist *)halp_ptr(list))->count : 0;
}

/* A copy of list with f at index. 0: no memory. */
static hal_off flist_with(hal_off list, uint32_t index, hal_off f)
{
    uint32_t n = flist_count(list);
    hal_off at = halp_block_new(flist_size(n + 1));
    if (!at) {
        return 0;
    }
    struct hal_flist *to = halp_ptr(at);
    const struct hal_flist *from = halp_ptr(list);
    to->count = n + 1;
    for (uint32_t i = 0; i <= n; i++) {
        to->functs[i] = i == index ? f : from->functs[i < index ? i : i - 1];
    }
    return at;
}

/* Publishes place without the entries that keep() refuses. false: nothing changed. */
static bool flist_filter(struct hal_thread *t, _Atomic hal_off *place, bool (*keep)(hal_off, uint32_t, const void *),
                         const void *arg)
{
    const struct hal_flist *from = halp_ptr(atomic_load(place));
    uint32_t n = from ? from->count : 0, kept = 0;
    for (uint32_t i = 0; i < n; i++) {
        kept += keep(from->functs[i], i, arg);
    }
    if (kept == n) {
        return false;
    }
    hal_off at = 0;
    if (kept) {
        at = halp_block_new(flist_size(kept));
        if (!at) {
            return false;
        }
        struct hal_flist *to = halp_ptr(at);
        to->count = 0;
        for (uint32_t i = 0; i < n; i++) {
            if (keep(from->functs[i], i, arg)) {
                to->functs[to->count++] = from->functs[i];
            }
        }
    }
    publish(t, place, at);
    return true;
}

static bool keep_live(hal_off f, uint32_t i, const void *arg)
{
    (void)i;
    (void)arg;
    return ((struct hal_obj *)halp_ptr(f))->state == HAL_LIVE;
}

static bool keep_others(hal_off f, uint32_t i, const void *arg)
{
    (void)i;
    return f != *(const hal_off *)arg;
}

static bool keep_index(hal_off f, uint32_t i, const void *arg)
{
    (void)f;
    return i != *(const uint32_t *)arg;
}

static void count_users(hal_off list, int by)
{
    const struct hal_flist *fl = halp_ptr(list);
    for (uint32_t i = 0; fl && i < fl->count; i++) {
        ((struct hal_funct *)halp_ptr(fl->functs[i]))->users += by;
    }
}

void halp_thread_filter(struct hal_thread *t)
{
    flist_filter(t, &t->list, keep_live, NULL);
    flist_filter(t, &t->inits, keep_live, NULL);
    count_users(atomic_load(&t->list), 1);
    count_users(atomic_load(&t->inits), 1);
}

/* The init functions of threads whose init cycle ran are in use no more. */
void halp_drain_inits(void)
{
    for (struct hal_thread *t = halp_first(HAL_KIND_THREAD); t; t = halp_next(t)) {
        hal_off list = atomic_load(&t->inits);
        if (list && atomic_load(&t->init_done)) {
            halp_change();
            count_users(list, -1);
            atomic_store(&t->inits, 0);
            halp_block_free(list, flist_size(flist_count(list)));
        }
    }
}

void halp_funct_remove(struct hal_funct *f)
{
    hal_off self = halp_off(f);
    HALP_COMMIT(f->o.state, HAL_DYING);
    for (struct hal_thread *t = halp_first(HAL_KIND_THREAD); t; t = halp_next(t)) {
        flist_filter(t, &t->list, keep_others, &self);
        flist_filter(t, &t->inits, keep_others, &self);
    }
    struct hal_comp *comp = halp_ptr(f->owner);
    if (f->owner_prev) {
        ((struct hal_funct *)halp_ptr(f->owner_prev))->owner_next = f->owner_next;
    } else if (comp) {
        comp->functs = f->owner_next;
    }
    if (f->owner_next) {
        ((struct hal_funct *)halp_ptr(f->owner_next))->owner_prev = f->owner_prev;
    }
    halp_obj_remove(&f->o);
    halp_obj_free(&f->o);
}

void halp_thread_remove(struct hal_thread *t)
{
    hal_off list = atomic_load(&t->list), inits = atomic_load(&t->inits);
    HALP_COMMIT(t->o.state, HAL_DYING);
    count_users(list, -1);
    count_users(inits, -1);
    atomic_store(&t->list, 0);
    atomic_store(&t->inits, 0);
    if (list) {
        halp_block_free(list, flist_size(flist_count(list)));
    }
    if (inits) {
        halp_block_free(inits, flist_size(flist_count(inits)));
    }
    halp_obj_remove(&t->o);
    halp_obj_free(&t->o);
}

/* ---- Adding and removing functions ------------------------------------------------------ */

/* Where position (1.. from the front, -1.. from the end) is in a list of n; -1
 * after a message. */
static int position_index(int position, uint32_t n)
{
    if (position > 0) {
        if ((uint32_t)position > n + 1) {
            halp_err("HAL: ERROR: position '%d' is too high\n", position);
            return -1;
        }
        return position - 1;
    }
    if (position < -(int)(n + 1)) {
        halp_err("HAL: ERROR: position '%d' is too low\n", position);
        return -1;
    }
    return (int)n + 1 + position;
}

/* The checks before names are looked up. */
static int list_args(const char *who, const char *funct_name, const char *thread_name, const int *position)
{
    if (!hal_data) {
        halp_err("HAL: ERROR: %s called before init\n", who);
        return -EFAULT;
    }
    if (hal_data->lock_bits & HAL_LOCK_CONFIG) {
        halp_err("HAL: ERROR: %s called while HAL is locked\n", who);
        return -EPERM;
    }
    if (position && *position == 0) {
        halp_err("HAL: ERROR: bad position: 0\n");
        return -EINVAL;
    }
    if (!funct_name) {
        halp_err("HAL: ERROR: missing function name\n");
        return -EINVAL;
    }
    if (!thread_name) {
        halp_err("HAL: ERROR: missing thread name\n");
        return -EINVAL;
    }
    return 0;
}

/* Puts f into a list of t. Lock held. */
static int insert(struct hal_thread *t, _Atomic hal_off *place, struct hal_funct *f, int position)
{
    int index = position_index(position, flist_count(atomic_load(place)));
    if (index < 0) {
        return -EINVAL;
    }
    halp_change();
    hal_off fresh = flist_with(atomic_load(place), (uint32_t)index, halp_off(f));
    if (!fresh) {
        halp_err("HAL: ERROR: insufficient memory for thread->function link\n");
        return -ENOMEM;
    }
    publish(t, place, fresh);
    f->users++;
    return 0;
}

int hal_add_funct_to_thread(const char *funct_name, const char *thread_name, int position)
{
    int result = list_args("add_funct_to_thread", funct_name, thread_name, &position);
    if (result < 0) {
        return result;
    }
    halp_dbg("HAL: adding function '%s' to thread '%s'\n", funct_name, thread_name);
    result = -EINVAL;
    halp_lock();
    halp_drain_inits();
    struct hal_funct *f = (struct hal_funct *)halp_find(HAL_KIND_FUNCT, funct_name);
    struct hal_thread *t = (struct hal_thread *)halp_find(HAL_KIND_THREAD, thread_name);
    if (!f) {
        halp_err("HAL: ERROR: function '%s' not found\n", funct_name);
    } else if (f->users > 0 && !f->reentrant) {
        halp_err("HAL: ERROR: function '%s' may only be added to one thread\n", funct_name);
    } else if (!t) {
        halp_err("HAL: ERROR: thread '%s' not found\n", thread_name);
    } else {
        result = insert(t, &t->list, f, position);
    }
    halp_unlock();
    return result;
}

int hal_init_funct_to_thread(const char *funct_name, const char *thread_name, int position)
{
    int result = list_args("init_funct_to_thread", funct_name, thread_name, &position);
    if (result < 0) {
        return result;
    }
    halp_dbg("HAL: adding init function '%s' to thread '%s'\n", funct_name, thread_name);
    result = -ENOENT;
    halp_lock();
    halp_drain_inits();
    struct hal_funct *f = (struct hal_funct *)halp_find(HAL_KIND_FUNCT, funct_name);
    struct hal_thread *t = (struct hal_thread *)halp_find(HAL_KIND_THREAD, thread_name);
    if (!f) {
        halp_err("HAL: ERROR: function '%s' not found\n", funct_name);
    } else if (!t) {
        halp_err("HAL: ERROR: thread '%s' not found\n", thread_name);
    } else if (atomic_load(&t->init_done)) {
        rtapi_print_msg(RTAPI_MSG_WARN, "HAL: WARNING: thread '%s' init cycle already ran; '%s' will not be invoked\n",
                        thread_name, funct_name);
        result = -EALREADY;
    } else {
        result = insert(t, &t->inits, f, position);
    }
    halp_unlock();
    return result;
}

int hal_del_funct_from_thread(const char *funct_name, const char *thread_name)
{
    int result = list_args("del_funct_from_thread", funct_name, thread_name, NULL);
    if (result < 0) {
        return result;
    }
    halp_dbg("HAL: removing function '%s' from thread '%s'\n", funct_name, thread_name);
    result = -EINVAL;
    halp_lock();
    halp_drain_inits();
    struct hal_funct *f = (struct hal_funct *)halp_find(HAL_KIND_FUNCT, funct_name);
    struct hal_thread *t = (struct hal_thread *)halp_find(HAL_KIND_THREAD, thread_name);
    if (!f) {
        halp_err("HAL: ERROR: function '%s' not found\n", funct_name);
    } else if (f->users == 0) {
        halp_err("HAL: ERROR: function '%s' is not in use\n", funct_name);
    } else if (!t) {
        halp_err("HAL: ERROR: thread '%s' not found\n", thread_name);
    } else {
        const struct hal_flist *fl = halp_ptr(atomic_load(&t->list));
        uint32_t i = 0, n = fl ? fl->count : 0;
        while (i < n && fl->functs[i] != halp_off(f)) {
            i++;
        }
        if (i == n) {
            halp_err("HAL: ERROR: thread '%s' doesn't use %s\n", thread_name, funct_name);
        } else {
            halp_change();
            result = flist_filter(t, &t->list, keep_index, &i) ? 0 : -ENOMEM;
            if (result == 0) {
                f->users--;
            }
        }
    }
    halp_unlock();
    return result;
}

int hal_start_threads(void)
{
    if (!hal_data) {
        halp_err("HAL: ERROR: start_threads called before init\n");
        return -EFAULT;
    }
    if (hal_data->lock_bits & HAL_LOCK_RUN) {
        halp_err("HAL: ERROR: start_threads called while HAL is locked\n");
        return -EPERM;
    }
    halp_dbg("HAL: starting threads\n");
    atomic_store(&hal_data->threads_running, 1);
    return 0;
}

int hal_stop_threads(void)
{
    if (!hal_data) {
        halp_err("HAL: ERROR: stop_threads called before init\n");
        return -EFAULT;
    }
    if (hal_data->lock_bits & HAL_LOCK_RUN) {
        halp_err("HAL: ERROR: stop_threads called while HAL is locked\n");
        return -EPERM;
    }
    atomic_store(&hal_data->threads_running, 0);
    halp_dbg("HAL: threads stopped\n");
    return 0;
}

#ifdef RTAPI
/* ---- Functions: exporting ---------------------------------------------------------------- */

static int funct_new(struct hal_comp *comp, const char *name, void (*funct)(void *, long), void *arg, int reentrant,
                     int comp_id)
{
    halp_change();
    struct hal_funct *f = halp_obj_new(HAL_KIND_FUNCT);
    if (!f) {
        halp_err("HAL: ERROR: insufficient memory for function '%s'\n", name);
        return -ENOMEM;
    }
    if (halp_find(HAL_KIND_FUNCT, name)) {
        halp_obj_free(&f->o);
        halp_err("HAL: ERROR: duplicate function '%s'\n", name);
        return -EINVAL;
    }
    strcpy(f->o.name, name);
    f->funct = (uintptr_t)funct;
    f->arg = (uintptr_t)arg;
    f->reentrant = reentrant != 0;
    f->owner = halp_off(comp);
    if (!halp_obj_insert(&f->o)) {
        halp_obj_free(&f->o);
        halp_err("HAL: ERROR: insufficient memory for function '%s'\n", name);
        return -ENOMEM;
    }
    f->owner_next = comp->functs;
    if (comp->functs) {
        ((struct hal_funct *)halp_ptr(comp->functs))->owner_prev = halp_off(f);
    }
    comp->functs = halp_off(f);
    if (hal_pin_s32_newf(HAL_OUT, &f->runtime, comp_id, "%s.time", name) < 0) {
        halp_err("HAL: ERROR: fail to create pin '%s.time'\n", name);
    } else if (hal_param_s32_newf(HAL_RW, &f->maxtime, comp_id, "%s.tmax", name) < 0) {
        halp_err("HAL: ERROR: fail to create parameter '%s.tmax'\n", name);
    } else if (hal_param_bit_newf(HAL_RO, &f->maxtime_increased, comp_id, "%s.tmax-increased", name) < 0) {
        halp_err("HAL: ERROR: fail to create parameter '%s.tmax-increased'\n", name);
    } else {
        return 0;
    }
    /* What was made of its pin and parameters goes with the component; the function
     * must not be run without them. */
    halp_funct_remove(f);
    return -EINVAL;
}

int hal_export_funct(const char *name, void (*funct)(void *, long), void *arg, int uses_fp, int reentrant, int comp_id)
{
    (void)uses_fp;
    if (!hal_data) {
        halp_err("HAL: ERROR: export_funct called before init\n");
        return -EFAULT;
    }
    if (!name || !funct) {
        halp_err("HAL: ERROR: missing function name\n");
        return -EINVAL;
    }
    if (strlen(name) > HAL_NAME_LEN) {
        halp_err("HAL: ERROR: function name '%s' is too long\n", name);
        return -EINVAL;
    }
    if (hal_data->lock_bits & HAL_LOCK_LOAD) {
        halp_err("HAL: ERROR: export_funct called while HAL locked\n");
        return -EPERM;
    }
    halp_dbg("HAL: exporting function '%s'\n", name);
    int result = -EINVAL;
    halp_lock();
    struct hal_comp *comp = halp_find_comp_id(comp_id);
    if (!comp) {
        halp_err("HAL: ERROR: component %d not found\n", comp_id);
    } else if (comp->type == HAL_COMP_TYPE_USER) {
        halp_err("HAL: ERROR: component %d is not realtime\n", comp_id);
    } else if (comp->ready) {
        halp_err("HAL: ERROR: export_funct called after hal_ready\n");
    } else {
        result = funct_new(comp, name, funct, arg, reentrant, comp_id);
    }
    halp_unlock();
    return result;
}

int hal_export_functf(void (*funct)(void *, long), void *arg, int uses_fp, int reentrant, int comp_id, const char *fmt,
                      ...)
{
    char name[HAL_NAME_LEN + 1];
    va_list ap;
    va_start(ap, fmt);
    int len = rtapi_vsnprintf(name, sizeof name, fmt, ap);
    va_end(ap);
    if (len < 0 || len > HAL_NAME_LEN) {
        halp_err("hal_export_functfv: length %d too long for name starting '%s'\n", len, name);
        return -ENOMEM;
    }
    return hal_export_funct(name, funct, arg, uses_fp, reentrant, comp_id);
}

/* ---- The cycle [rt] -------------------------------------------------------------------------- */

/* Cost: constant per function: its call, one reading of the clock, three stores. */
static void run_functs(struct hal_thread *t, long period)
{
    char *base = hal_shmem_base;
    const struct hal_flist *list = halp_ptr(atomic_load_explicit(&t->list, memory_order_acquire));
    long long start = rtapi_get_time();
    long long before = start;
    for (uint32_t i = 0, n = list ? list->count : 0; i < n; i++) {
        struct hal_funct *f = (struct hal_funct *)(base + list->functs[i]);
        ((void (*)(void *, long))(uintptr_t)f->funct)((void *)(uintptr_t)f->arg, period);
        long long now = rtapi_get_time();
        rtapi_s32 took = (rtapi_s32)(now - before);
        before = now;
        *f->runtime = took;
        if (took > f->maxtime) {
            f->maxtime = took;
            f->maxtime_increased = 1;
        } else {
            f->maxtime_increased = 0;
        }
    }
    rtapi_s32 took = (rtapi_s32)(before - start);
    *t->runtime = took;
    if (took > t->maxtime) {
        t->maxtime = took;
    }
    *t->beat = *t->beat + 1;
}

/* Once, before the first ordinary cycle. */
static void run_inits(struct hal_thread *t, long period)
{
    const struct hal_flist *list = halp_ptr(atomic_load_explicit(&t->inits, memory_order_acquire));
    for (uint32_t i = 0, n = list ? list->count : 0; i < n; i++) {
        struct hal_funct *f = halp_ptr(list->functs[i]);
        ((void (*)(void *, long))(uintptr_t)f->funct)((void *)(uintptr_t)f->arg, period);
    }
    atomic_store_explicit(&t->init_done, 1, memory_order_release);
    rtapi_task_self_resync();
}

static void thread_task(void *arg)
{
    struct hal_thread *t = arg;
    long period = (long)t->period;
    bool init_done = false;
    for (;;) {
        if (atomic_load_explicit(&hal_data->threads_running, memory_order_relaxed) > 0) {
            uint32_t cycle = atomic_load_explicit(&t->cycle, memory_order_relaxed);
            atomic_store_explicit(&t->cycle, cycle + 1, memory_order_relaxed);
            atomic_thread_fence(memory_order_seq_cst); /* who changes a list sees us, or we see the list */
            if (init_done) {
                run_functs(t, period);
            } else {
                run_inits(t, period);
                init_done = true;
            }
            atomic_store_explicit(&t->cycle, cycle + 2, memory_order_release);
        }
        rtapi_wait();
    }
}

/* ---- Threads: making and deleting --------------------------------------------------------------- */

/* Period and priority from the request and the thread made last. 0 or -EINVAL
 * after a message. */
static int plan(unsigned long period_nsec, int64_t *period, int *priority)
{
    const struct hal_thread *last = halp_first(HAL_KIND_THREAD);
    int64_t previous;
    int reference;
    if (!last) {
        long clock = rtapi_clock_set_period(0);
        if (clock == 0) {
            clock = rtapi_clock_set_period((long)period_nsec);
            if (clock < 0) {
                halp_err("HAL_LIB: ERROR: clock_set_period returned %ld\n", clock);
                return -EINVAL;
            }
        } else if (clock > (long)(period_nsec + period_nsec / 100)) {
            halp_err("HAL_LIB: ERROR: clock period too long: %ld\n", clock);
            return -EINVAL;
        }
        hal_data->base_period = hal_data->exact_base_period ? (int64_t)period_nsec : clock;
        reference = rtapi_prio_highest();
        previous = 0;
    } else {
        reference = last->priority;
        previous = last->period;
    }
    int64_t base = hal_data->base_period;
    if ((int64_t)period_nsec < base) {
        halp_err("HAL_LIB: ERROR: new thread period %ld is less than clock period %ld\n",
                 (long)period_nsec, (long)base);
        return -EINVAL;
    }
    *period = ((int64_t)period_nsec + base / 2) / base * base;
    if (*period < previous) {
        halp_err("HAL_LIB: ERROR: new thread period %ld is less than existing thread period %ld\n", (long)period_nsec,
                 (long)previous);
        return -EINVAL;
    }
    *priority = rtapi_prio_next_lower(reference);
    return 0;
}

/* The pseudo component with the pins of t. Its id or -errno. */
static int thread_comp(struct hal_thread *t, const char *name)
{
    char comp_name[HAL_NAME_LEN + 1];
    if (rtapi_snprintf(comp_name, sizeof comp_name, HAL_PSEUDO_COMP_PREFIX "%s", name) > HAL_NAME_LEN) {
        halp_err("HAL: ERROR: thread name '%s' is too long\n", name);
        return -EINVAL;
    }
    int id = hal_init(comp_name);
    if (id < 0) {
        return id;
    }
    int result = hal_param_s32_newf(HAL_RW, &t->maxtime, id, "%s.tmax", name);
    if (result == 0) {
        result = hal_pin_s32_newf(HAL_OUT, &t->runtime, id, "%s.time", name);
    }
    if (result == 0) {
        result = hal_pin_s64_newf(HAL_OUT, &t->beat, id, "%s.threadbeat", name);
    }
    if (result == 0) {
        result = hal_ready(id);
    }
    if (result < 0) {
        halp_err("HAL: ERROR: fail to create pins of thread '%s'\n", name);
        hal_exit(id);
        return result;
    }
    return id;
}

static int thread_new(const char *name, unsigned long period_nsec)
{
    if (halp_find(HAL_KIND_THREAD, name)) {
        halp_err("HAL: ERROR: duplicate thread name %s\n", name);
        return -EEXIST;
    }
    int64_t period = 0;
    int priority = 0;
    int result = plan(period_nsec, &period, &priority);
    if (result < 0) {
        return result;
    }
    halp_change();
    struct hal_thread *t = halp_obj_new(HAL_KIND_THREAD);
    if (!t) {
        halp_err("HAL: ERROR: insufficient memory to create thread\n");
        return -ENOMEM;
    }
    strcpy(t->o.name, name);
    t->period = period;
    t->priority = priority;
    /* Its pins exist before the task does: threads may be running. */
    int comp_id = thread_comp(t, name);
    if (comp_id < 0) {
        halp_obj_free(&t->o);
        return comp_id;
    }
    t->comp_id = comp_id;
    result = rtapi_task_new(thread_task, t, priority, halp_lib_module_id, 16384, RTAPI_USES_FP);
    if (result < 0) {
        halp_err("HAL_LIB: could not create task for thread %s\n", name);
        goto fail;
    }
    t->task_id = result;
    if (!halp_obj_insert(&t->o)) {
        halp_err("HAL: ERROR: insufficient memory to create thread\n");
        rtapi_task_delete(t->task_id);
        result = -ENOMEM;
        goto fail;
    }
    result = rtapi_task_start(t->task_id, (unsigned long)period);
    if (result < 0) {
        halp_err("HAL_LIB: could not start task for thread %s: %d\n", name, result);
        rtapi_task_delete(t->task_id);
        halp_obj_remove(&t->o);
        goto fail;
    }
    return comp_id;
fail:
    hal_exit(comp_id);
    halp_obj_free(&t->o);
    return result;
}

int hal_create_thread(const char *name, unsigned long period_nsec, int uses_fp)
{
    (void)uses_fp;
    if (!hal_data) {
        halp_err("HAL: ERROR: create_thread called before init\n");
        return -EFAULT;
    }
    halp_dbg("HAL: creating thread %s, %ld nsec\n", name ? name : "", (long)period_nsec);
    if (period_nsec == 0) {
        halp_err("HAL: ERROR: create_thread called with period of zero\n");
        return -EINVAL;
    }
    if (!name || strlen(name) > HAL_NAME_LEN) {
        halp_err("HAL: ERROR: thread name '%s' is too long\n", name ? name : "");
        return -EINVAL;
    }
    if (hal_data->lock_bits & HAL_LOCK_CONFIG) {
        halp_err("HAL: ERROR: create_thread called while HAL is locked\n");
        return -EPERM;
    }
    halp_lock();
    int result = thread_new(name, period_nsec);
    halp_unlock();
    return result;
}

/* Ends the task and removes the thread. The pseudo component stays. */
static void thread_end(struct hal_thread *t)
{
    atomic_store(&hal_data->threads_running, 0);
    rtapi_task_delete(t->task_id);
    halp_thread_remove(t);
}

int hal_thread_delete(const char *name)
{
    if (!hal_data) {
        halp_err("HAL: ERROR: thread_delete called before init\n");
        return -EFAULT;
    }
    if (hal_data->lock_bits & HAL_LOCK_CONFIG) {
        halp_err("HAL: ERROR: thread_delete called while HAL is locked\n");
        return -EPERM;
    }
    int result = 0;
    halp_lock();
    struct hal_thread *t = name ? (struct hal_thread *)halp_find(HAL_KIND_THREAD, name) : NULL;
    if (!t) {
        halp_err("HAL: ERROR: thread '%s' not found\n", name ? name : "");
        result = -EINVAL;
    } else {
        int comp_id = t->comp_id;
        halp_change();
        thread_end(t);
        if (halp_find_comp_id(comp_id)) {
            hal_exit(comp_id);
        }
    }
    halp_unlock();
    return result;
}

void halp_threads_end(void)
{
    struct hal_thread *t;
    halp_lock();
    halp_change();
    while ((t = halp_first(HAL_KIND_THREAD))) {
        thread_end(t);
    }
    halp_unlock();
}
#endif /* RTAPI */
