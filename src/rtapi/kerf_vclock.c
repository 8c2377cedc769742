/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * kerf_vclock.c - virtual time: a conservative discrete-event simulation over the
 * threads of all processes of an instance.
 *
 * In:     waits of participants
 * Out:    one runs at a time, in the order (wake time, priority, place)
 * Thread: see kerf_clock.h; every change of state happens under one robust lock
 *
 * Invariants: (1) time stands while any place holds it (RUNNING, RESERVED or LENT);
 * (2) at most one place is made RUNNING by the clock at a time; (3) now never goes
 * back; (4) a place whose process is gone is freed by whoever waits.
 */
#include "kerf_vclock.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <linux/futex.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ipc.h>
#include <sys/mman.h>
#include <sys/shm.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>
#include "kerf_clock.h"
#include "kerf_instance.h"

#define VCLOCK_KEY 0x4b434c4b
#define VCLOCK_MAGIC 0x76636c6bu
#define MAX_PLACES 256
#define MAX_LENDERS 4
#define LOOK_NS 20000000    /* wall time between looks for dead participants */
#define SPINS 200           /* looks at the futex word before sleeping on it */

enum state { FREE, WAITING, SUSPENDED, RUNNING, RESERVED, LENT };

struct owner {
    pid_t pid;
    uint64_t start; /* start time of the process, so that a reused id is not taken for it */
};

struct place {
    _Atomic int state;  /* enum state; written under the lock, read by the waiter */
    int prio;
    int64_t wake_ns;
    struct owner owner;                 /* who runs or waits here */
    struct owner lenders[MAX_LENDERS];  /* who lent it, outermost first */
    int lent;                           /* depth of lenders */
    uint32_t generation;                /* tells a place from its successor */
    int64_t held_since;                 /* wall time at which it began to hold time */
    int reported;                       /* its hang was reported */
    char name[32];
};

struct vclock {
    _Atomic uint32_t magic;
    pthread_mutex_t lock;
    _Atomic int64_t now_ns;
    int64_t anchor_now_ns, anchor_wall_ns; /* the pace counts from here */
    double pace;
    int used;    /* places 0..used-1 have ever been used */
    int holding; /* places that hold time */
    struct place places[MAX_PLACES];
};

static struct vclock *clk;
static int64_t hang_ns = 10000000000;
static _Thread_local int mine = -1;
static _Thread_local int64_t guest_prio = KERF_CLOCK_PRIO_USER;

static int64_t wall(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec * 1000000000LL + t.tv_nsec;
}

static int holds(int state)
{
    return state == RUNNING || state == RESERVED || state == LENT;
}

/* Start time of a process in clock ticks; 0 when it is gone or a zombie. */
static uint64_t start_of(pid_t pid)
{
    char path[32], text[512];
    snprintf(path, sizeof path, "/proc/%d/stat", (int)pid);
    int fd = open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0) return 0;
    ssize_t n = read(fd, text, sizeof text - 1);
    close(fd);
    if (n <= 0) return 0;
    text[n] = 0;
    char *p = strrchr(text, ')');
    if (!p || p[2] == 'Z' || p[2] == 'X') return 0;
    p += 2;
    for (int field = 3; field < 22 && p; field++) p = strchr(p + 1, ' ');
    return p ? strtoull(p + 1, NULL, 10) : 0;
}

static struct owner myself(void)
{
    static _Thread_local struct owner me;
    pid_t pid = getpid();
    if (me.pid != pid) me = (struct owner){pid, start_of(pid)};
    return me;
}

static int alive(struct owner o)
{
    if (o.pid <= 0) return 0;
    if (kill(o.pid, 0) < 0 && errno == ESRCH) return 0;
    return start_of(o.pid) == o.start;
}

static void set_state(struct place *p, int state)
{
    int before = atomic_load_explicit(&p->state, memory_order_relaxed);
    clk->holding += holds(state) - holds(before);
    if (holds(state) && !holds(before)) {
        p->held_since = 0;
        p->reported = 0;
    }
    atomic_store_explicit(&p->state, state, memory_order_release);
}

static void futex_wake(struct place *p)
{
    syscall(SYS_futex, &p->state, FUTEX_WAKE, INT_MAX, NULL, NULL, 0);
}

/* Gives a place of a dead owner back to its lender, or frees it. */
static void vacate(struct place *p)
{
    while (p->lent > 0) {
        p->owner = p->lenders[p->lent - 1];
        if (alive(p->owner)) {
            set_state(p, LENT);
            futex_wake(p);
            return;
        }
        p->lent--;
    }
    p->generation++;
    set_state(p, FREE);
    futex_wake(p);
}

/* Frees the places of dead processes. Called under the lock, seldom. */
static void sweep(void)
{
    int64_t t = wall();
    for (int i = 0; i < clk->used; i++) {
        struct place *p = &clk->places[i];
        int state = p->state;
        if (state == FREE) continue;
        if (state == RESERVED && p->owner.pid == 0) { /* its process is not known yet */
            if (!p->held_since) p->held_since = t;
            if (!alive(p->lenders[0]) || t - p->held_since > hang_ns) vacate(p);
            continue;
        }
        if (!alive(p->owner)) {
            if (state == LENT) p->lent--; /* the lender itself is gone */
            vacate(p);
            continue;
        }
        if (state == RUNNING || state == RESERVED) {
            if (!p->held_since) p->held_since = t;
            if (!p->reported && t - p->held_since > hang_ns) {
                p->reported = 1;
                fprintf(stderr, "virtual clock: %s (process %d) has held time for %.0f s\n", p->name,
                        (int)p->owner.pid, (double)(t - p->held_since) * 1e-9);
            }
        }
    }
}

static void lock(void)
{
    if (pthread_mutex_lock(&clk->lock) == EOWNERDEAD) {
        pthread_mutex_consistent(&clk->lock);
        clk->holding = 0; /* the count may be half changed: make it anew */
        for (int i = 0; i < clk->used; i++) clk->holding += holds(clk->places[i].state);
        sweep();
    }
}

static void unlock(void)
{
    pthread_mutex_unlock(&clk->lock);
}

/* Keeps to the pace: sleeps in wall time before time jumps to `when`. The lock is free meanwhile. */
static int64_t pace_delay(int64_t when)
{
    if (clk->pace <= 0) return 0;
    return clk->anchor_wall_ns + (int64_t)((double)(when - clk->anchor_now_ns) / clk->pace) - wall();
}

/* Lets the first of those who wait run, if nothing holds time. Returns its place or -1. Under the lock. */
static int dispatch(void)
{
    if (clk->holding > 0) return -1;
    int best = -1;
    for (int i = 0; i < clk->used; i++) {
        struct place *p = &clk->places[i];
        if (p->state != WAITING) continue;
        if (best < 0) {
            best = i;
            continue;
        }
        struct place *b = &clk->places[best];
        if (p->wake_ns < b->wake_ns || (p->wake_ns == b->wake_ns && p->prio < b->prio)) best = i;
    }
    if (best < 0) return -1;
    struct place *p = &clk->places[best];
    if (p->wake_ns > clk->now_ns) atomic_store_explicit(&clk->now_ns, p->wake_ns, memory_order_release);
    set_state(p, RUNNING);
    return best;
}

/* Waits until place i leaves the state `from`; looks for dead participants meanwhile. */
static void await(int i, int from)
{
    struct place *p = &clk->places[i];
    for (int n = 0; n < SPINS; n++) {
        if (atomic_load_explicit(&p->state, memory_order_acquire) != from) return;
    }
    while (atomic_load_explicit(&p->state, memory_order_acquire) == from) {
        struct timespec t = {0, LOOK_NS};
        if (syscall(SYS_futex, &p->state, FUTEX_WAIT, from, &t, NULL, 0) < 0 && errno == ETIMEDOUT) {
            lock();
            sweep();
            int next = dispatch();
            unlock();
            if (next >= 0 && next != i) futex_wake(&clk->places[next]);
        }
    }
}

/* Puts place i to sleep until when, and wakes whoever is next. */
static void wait_in(int i, int64_t when)
{
    struct place *p = &clk->places[i];
    int64_t delay = pace_delay(when);
    lock();
    p->wake_ns = when;
    set_state(p, WAITING);
    int next = dispatch();
    unlock();
    if (next >= 0 && next != i) futex_wake(&clk->places[next]);
    if (next != i) await(i, WAITING);
    /* With a pace the one who runs next waits for wall time to come up; others stand still. */
    delay = pace_delay(clk->now_ns);
    if (delay > 0) {
        struct timespec t = {delay / 1000000000, delay % 1000000000};
        nanosleep(&t, NULL);
    }
}

/* The last process removes the segment. */
static void detach(void)
{
    int handle = kerf_instance_lock("vclock");
    int id = shmget(kerf_instance_key(VCLOCK_KEY), 0, 0);
    struct shmid_ds info;
    if (id >= 0 && shmctl(id, IPC_STAT, &info) == 0 && info.shm_nattch <= 1) shmctl(id, IPC_RMID, NULL);
    if (handle >= 0) kerf_instance_unlock(handle);
}

int vclock_attach(double pace)
{
    if (clk) return 0;
    const char *hang = getenv("KERF_CLOCK_HANG_S");
    if (hang && atof(hang) > 0) hang_ns = (int64_t)(atof(hang) * 1e9);
    int handle = kerf_instance_lock("vclock");
    if (handle < 0) return handle;
    int key = kerf_instance_key(VCLOCK_KEY);
    int id = shmget(key, 0, 0);
    struct shmid_ds info;
    if (id >= 0 && shmctl(id, IPC_STAT, &info) == 0 && info.shm_nattch == 0) {
        shmctl(id, IPC_RMID, NULL);
        id = -1;
    }
    if (id < 0) id = shmget(key, sizeof *clk, IPC_CREAT | 0600);
    void *at = id < 0 ? (void *)-1 : shmat(id, NULL, 0);
    int result = at == (void *)-1 ? -errno : 0;
    if (result == 0) {
        clk = at;
        if (clk->magic != VCLOCK_MAGIC) {
            pthread_mutexattr_t attr;
            pthread_mutexattr_init(&attr);
            pthread_mutexattr_setpshared(&attr, PTHREAD_PROCESS_SHARED);
            pthread_mutexattr_setrobust(&attr, PTHREAD_MUTEX_ROBUST);
            pthread_mutex_init(&clk->lock, &attr);
            pthread_mutexattr_destroy(&attr);
            clk->now_ns = 1000000000; /* a time of zero means "none" in places */
            clk->pace = pace;
            clk->anchor_now_ns = clk->now_ns;
            clk->anchor_wall_ns = wall();
            clk->magic = VCLOCK_MAGIC;
        }
        atexit(detach);
    }
    kerf_instance_unlock(handle);
    return result;
}

int64_t vclock_now(void)
{
    return atomic_load_explicit(&clk->now_ns, memory_order_acquire);
}

/* A free place, or -1. Under the lock. */
static int take_place(const char *name, int prio, struct owner owner)
{
    for (int i = 0; i < MAX_PLACES; i++) {
        struct place *p = &clk->places[i];
        if (p->state != FREE) continue;
        if (i >= clk->used) clk->used = i + 1;
        p->generation++;
        p->prio = prio;
        p->lent = 0;
        p->owner = owner;
        p->held_since = 0;
        p->reported = 0;
        snprintf(p->name, sizeof p->name, "%s", name);
        return i;
    }
    return -1;
}

/* Place named by a child's environment; -1 when it is not valid any more. Under the lock. */
static int named_place(const char *value)
{
    int i;
    unsigned generation;
    if (!value || sscanf(value, "%d.%u", &i, &generation) != 2 || i < 0 || i >= clk->used) return -1;
    return clk->places[i].generation == generation ? i : -1;
}

int vclock_join(const char *name, int prio, const char *place)
{
    if (mine >= 0) return 0;
    lock();
    int i = named_place(place);
    if (i >= 0 && clk->places[i].state == LENT && clk->places[i].lent < MAX_LENDERS + 1) {
        clk->places[i].owner = myself(); /* borrowed: lenders stay behind it */
        set_state(&clk->places[i], RUNNING);
        mine = i;
        unlock();
        return 0;
    }
    if (i >= 0 && clk->places[i].state == RESERVED) {
        struct place *p = &clk->places[i];
        p->owner = myself();
        p->lent = 0;
        p->prio = prio;
        snprintf(p->name, sizeof p->name, "%s", name);
        p->wake_ns = clk->now_ns;
    } else {
        i = take_place(name, prio, myself());
        if (i < 0) {
            unlock();
            return -ENOSPC;
        }
        clk->places[i].wake_ns = clk->now_ns;
    }
    unlock();
    mine = i;
    wait_in(i, vclock_now());
    return 0;
}

void vclock_leave(void)
{
    if (mine < 0) return;
    struct place *p = &clk->places[mine];
    mine = -1;
    lock();
    vacate(p);
    int next = dispatch();
    unlock();
    if (next >= 0) futex_wake(&clk->places[next]);
}

int vclock_joined(void)
{
    return mine >= 0;
}

void vclock_suspend(void)
{
    if (mine < 0) return;
    lock();
    set_state(&clk->places[mine], SUSPENDED);
    int next = dispatch();
    unlock();
    if (next >= 0) futex_wake(&clk->places[next]);
}

void vclock_resume(void)
{
    if (mine >= 0) wait_in(mine, vclock_now());
}

int vclock_sleep_until(int64_t when)
{
    if (mine >= 0) {
        wait_in(mine, when);
        return 0;
    }
    /* A guest takes a place for the length of its wait. */
    lock();
    int i = take_place("guest", (int)guest_prio, myself());
    unlock();
    if (i < 0) return -ENOSPC;
    wait_in(i, when);
    lock();
    vacate(&clk->places[i]);
    int next = dispatch();
    unlock();
    if (next >= 0) futex_wake(&clk->places[next]);
    return 0;
}

int vclock_lend(char *value, size_t size)
{
    if (size > 0) *value = 0;
    if (mine < 0) return 0;
    struct place *p = &clk->places[mine];
    lock();
    if (p->lent >= MAX_LENDERS) {
        unlock();
        return -ENOSPC;
    }
    p->lenders[p->lent++] = p->owner;
    set_state(p, LENT);
    snprintf(value, size, "%d.%u", mine, p->generation);
    unlock();
    return 0;
}

void vclock_reclaim(void)
{
    if (mine < 0) return;
    struct place *p = &clk->places[mine];
    struct owner me = myself();
    for (;;) {
        lock();
        if (p->state == LENT || p->owner.pid == me.pid) {
            if (p->lent > 0) p->lent--;
            p->owner = me;
            set_state(p, RUNNING);
            unlock();
            return;
        }
        if (!alive(p->owner)) {
            vacate(p);
            unlock();
            continue;
        }
        int state = p->state;
        unlock();
        struct timespec t = {0, LOOK_NS / 20};
        syscall(SYS_futex, &p->state, FUTEX_WAIT, state, &t, NULL, 0);
    }
}

int vclock_reserve(char *value, size_t size, const char *name, int prio)
{
    if (size > 0) *value = 0;
    if (mine < 0) return 0;
    lock();
    int i = take_place(name, prio, (struct owner){0, 0});
    if (i >= 0) {
        struct place *p = &clk->places[i];
        p->lenders[0] = myself(); /* whoever reserved it; not a lender of time */
        set_state(p, RESERVED);
        snprintf(value, size, "%d.%u", i, p->generation);
    }
    unlock();
    return i < 0 ? -ENOSPC : 0;
}

void vclock_reserved_for(const char *value, pid_t pid)
{
    lock();
    int i = named_place(value);
    if (i >= 0 && clk->places[i].state == RESERVED) clk->places[i].owner = (struct owner){pid, start_of(pid)};
    unlock();
}

void vclock_unreserve(const char *value)
{
    lock();
    int i = named_place(value), next = -1;
    if (i >= 0 && clk->places[i].state == RESERVED) {
        vacate(&clk->places[i]);
        next = dispatch();
    }
    unlock();
    if (next >= 0) futex_wake(&clk->places[next]);
}
