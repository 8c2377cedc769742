/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * kerf_vclock.c - virtual time: a conservative discrete-event simulation over the
 * threads of all processes of an instance.
 *
 * In:     waits of participants
 * Out:    one runs at a time, in the order (wake time, priority, number)
 * Thread: see kerf_clock.h
 * Method: a place per participant in a shared segment. Every change of a place is
 *         made under one robust lock, except the commonest: a participant that is
 *         itself next moves the clock on alone (see advance_alone).
 *
 * Invariants: (1) time stands while any place holds it (RUNNING, RESERVED, LENT,
 * LEAVING); (2) a place becomes RUNNING by its turn only when none holds time;
 * (3) now never goes back; (4) numbers grow in the order of making, which is
 * repeatable as long as the makers are; (5) a place whose process is gone is freed
 * by whoever waits and sees no progress.
 */
#include "kerf_vclock.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <linux/futex.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ipc.h>
#include <sys/shm.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>
#include "kerf_clock.h"
#include "kerf_instance.h"

#define VCLOCK_KEY 0x4b434c4b /* mapped by the instance: kept inside the segment */
#define VCLOCK_MAGIC 0x76636c6c
#define START_NS 1000000000 /* a time of 0 means "none" to many */
#define MAX_PLACES 256
#define MAX_LENDERS 8
/* Wall times between looks at those who hold time: a start or an end of a process
 * is awaited every day, a death seldom. */
#define LOOK_NS 20000000
#define LOOK_SOON_NS 300000
#define CATCH_UP_NS 10000000 /* the pace forgets what it is behind by more */

enum state { FREE, WAITING, SUSPENDED, RUNNING, RESERVED, LENT, LEAVING };
static const char *const state_names[] = {"free", "waiting", "suspended", "running", "reserved", "lent", "leaving"};

struct owner {
    pid_t pid;
    uint64_t start; /* start time of the process: a reused id is another one */
};

struct place {
    _Atomic uint32_t state;             /* enum state: the word its thread sleeps on */
    _Atomic uint32_t asleep;            /* its thread is, or is about to be, asleep on state */
    int prio;
    uint64_t number;                    /* order among equals; also tells a place from its successor */
    int64_t wake_ns;
    struct owner owner;                 /* who runs or waits here */
    struct owner lenders[MAX_LENDERS];  /* who lent it, outermost first; of a RESERVED place: its maker */
    int lent;                           /* number of lenders */
    bool reported;                      /* its hang was told */
    char name[32];
};

struct vclock {
    uint32_t magic;
    int key;                    /* tells the instances apart */
    pthread_mutex_t lock;
    _Atomic int64_t now_ns;
    _Atomic uint64_t changes;   /* of any place, by anybody */
    uint64_t last_number;
    int64_t anchor_now_ns, anchor_wall_ns; /* the pace counts from here */
    double pace;
    int cpu;                    /* that participants stay on; -1: no matter */
    _Atomic int used;           /* places 0..used-1 have ever been used */
    _Atomic int holding;        /* places that hold time */
    struct place places[MAX_PLACES];
};

static struct vclock *clk;
static int64_t hang_ns = 10000000000;
static _Thread_local int mine = -1;
static _Thread_local uint64_t mine_number;
/* The first among the others, valid while `changes` is as it was. */
static _Thread_local struct {
    uint64_t changes;
    bool any;
    int64_t wake_ns;
    int prio;
    uint64_t number;
} next_other;
static pthread_key_t thread_end;

static int64_t wall(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec * 1000000000LL + t.tv_nsec;
}

#define SPIN_MAX 128  /* looks, some microseconds: longer than a switch takes */
#define SPIN_PROBE 64 /* after so many waits without spinning it is tried again */

static void pause_cpu(void)
{
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
}

/* ---- Processes ---------------------------------------------------------- */

/* Start time of a process in clock ticks; 0 when it is gone or a zombie. */
static uint64_t start_of(pid_t pid)
{
    char path[32], text[512];
    snprintf(path, sizeof path, "/proc/%d/stat", (int)pid);
    int fd = open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0) {
        return 0;
    }
    ssize_t n = read(fd, text, sizeof text - 1);
    close(fd);
    text[n > 0 ? n : 0] = 0;
    char *p = strrchr(text, ')');
    if (!p || p[2] == 'Z' || p[2] == 'X') {
        return 0;
    }
    p += 2;
    for (int field = 3; field < 22 && p; field++) {
        p = strchr(p + 1, ' ');
    }
    return p ? strtoull(p + 1, NULL, 10) : 0;
}

static struct owner myself(void)
{
    static _Thread_local struct owner me;
    pid_t pid = getpid();
    if (me.pid != pid) {
        me = (struct owner){pid, start_of(pid)};
    }
    return me;
}

static bool same(struct owner a, struct owner b)
{
    return a.pid == b.pid && a.start == b.start;
}

/* A start of 0: it had ended before anybody looked. */
static bool alive(struct owner o)
{
    return o.pid > 0 && o.start != 0 && start_of(o.pid) == o.start;
}

/* ---- Places; everything here under the lock ------------------------------ */

static bool holds(uint32_t state)
{
    return state == RUNNING || state == RESERVED || state == LENT || state == LEAVING;
}

static void changed(void)
{
    atomic_fetch_add_explicit(&clk->changes, 1, memory_order_acq_rel);
}

static void set_state(struct place *p, uint32_t state)
{
    clk->holding += holds(state) - holds(atomic_load_explicit(&p->state, memory_order_relaxed));
    atomic_store_explicit(&p->state, state, memory_order_release);
    changed();
}

/* state was changed before: either we see that the thread sleeps, or it sees the
 * new state before it falls asleep (both are sequentially consistent). */
static void futex_wake(struct place *p)
{
    atomic_thread_fence(memory_order_seq_cst);
    if (!atomic_load(&p->asleep)) {
        return;
    }
    syscall(SYS_futex, &p->state, FUTEX_WAKE, INT_MAX, NULL, NULL, 0);
}

/* A free place, or -1. */
static int take_place(const char *name, int prio, struct owner owner)
{
    for (int i = 0; i < MAX_PLACES; i++) {
        struct place *p = &clk->places[i];
        if (p->state != FREE) {
            continue;
        }
        if (i >= clk->used) {
            clk->used = i + 1;
        }
        p->number = ++clk->last_number;
        p->prio = prio;
        p->wake_ns = clk->now_ns;
        p->lent = 0;
        p->owner = owner;
        p->reported = false;
        snprintf(p->name, sizeof p->name, "%s", name);
        return i;
    }
    return -1;
}

/* The owner goes: back to the last living lender, or the place becomes free. */
static void vacate(struct place *p)
{
    while (p->lent > 0) {
        struct owner lender = p->lenders[p->lent - 1];
        if (alive(lender)) {
            p->owner = lender;
            set_state(p, LENT);
            futex_wake(p);
            return;
        }
        p->lent--;
    }
    p->number = 0;
    set_state(p, FREE);
    futex_wake(p);
}

static void report_hang(struct place *p, const char *what)
{
    if (!p->reported) {
        p->reported = true;
        fprintf(stderr, "virtual clock: \"%s\" (process %d) %s for more than %g s; time stands meanwhile\n", p->name,
                (int)p->owner.pid, what, (double)hang_ns * 1e-9);
    }
}

/* Frees the places of dead processes. still_ns: wall time for which nothing moved. */
static void sweep(int64_t still_ns)
{
    bool hangs = still_ns > hang_ns;
    for (int i = 0; i < clk->used; i++) {
        struct place *p = &clk->places[i];
        switch (atomic_load_explicit(&p->state, memory_order_relaxed)) {
        case FREE:
            break;
        case RESERVED:
            if (!alive(p->owner.pid ? p->owner : p->lenders[0])) {
                vacate(p);
            } else if (hangs) {
                report_hang(p, "has not joined");
                vacate(p);
            }
            break;
        case LENT:
            if (!alive(p->owner)) {
                p->lent--;
                vacate(p);
            } else if (hangs) {
                report_hang(p, "has lent its place");
            }
            break;
        case RUNNING:
            if (!alive(p->owner)) {
                vacate(p);
            } else if (hangs) {
                report_hang(p, "has been running");
            }
            break;
        default:
            if (!alive(p->owner)) {
                vacate(p);
            }
        }
    }
}

static void lock(void)
{
    if (pthread_mutex_lock(&clk->lock) == EOWNERDEAD) {
        pthread_mutex_consistent(&clk->lock);
        clk->holding = 0; /* it may have died between the two changes: count anew */
        for (int i = 0; i < clk->used; i++) {
            clk->holding += holds(clk->places[i].state);
        }
        changed();
        sweep(0);
    }
}

static void unlock(void)
{
    pthread_mutex_unlock(&clk->lock);
}

static bool before(const struct place *a, const struct place *b)
{
    if (a->wake_ns != b->wake_ns) {
        return a->wake_ns < b->wake_ns;
    }
    return a->prio != b->prio ? a->prio < b->prio : a->number < b->number;
}

/* The first of those who wait, without place `but`; NULL when none does. */
static struct place *first_waiting(int but)
{
    struct place *best = NULL;
    for (int i = 0; i < clk->used; i++) {
        struct place *p = &clk->places[i];
        if (p->state == WAITING && i != but && (!best || before(p, best))) {
            best = p;
        }
    }
    return best;
}

/* Wall time at which time may be `when`. */
static int64_t due_wall_ns(int64_t when)
{
    return clk->anchor_wall_ns + (int64_t)((double)(when - clk->anchor_now_ns) / clk->pace);
}

/* Lets the first of those who wait run, if nothing holds time. Returns whom to
 * wake: it may run, or (with a pace) must look at its own time again. */
static struct place *dispatch(void)
{
    if (clk->holding > 0) {
        return NULL;
    }
    struct place *best = first_waiting(-1);
    if (!best) {
        return NULL;
    }
    if (best->wake_ns > clk->now_ns) {
        if (clk->pace > 0) {
            int64_t wall_ns = wall(), due_ns = due_wall_ns(best->wake_ns);
            if (wall_ns < due_ns) {
                return best;
            }
            if (wall_ns > due_ns + CATCH_UP_NS) {
                clk->anchor_now_ns = best->wake_ns;
                clk->anchor_wall_ns = wall_ns;
            }
        }
        atomic_store_explicit(&clk->now_ns, best->wake_ns, memory_order_release);
    }
    set_state(best, RUNNING);
    return best;
}

static void unlock_and_wake(struct place *next, struct place *but)
{
    unlock();
    if (next && next != but) {
        futex_wake(next);
    }
}

/* ---- Waiting ------------------------------------------------------------ */

/* What a waiter remembers between looks. */
struct look {
    uint64_t changes;
    int64_t now_ns, since_wall_ns;
};

/* After a time-out: if nothing moved since the last one, looks for the dead. */
static void look_around(struct look *seen, struct place *self)
{
    int64_t wall_ns = wall();
    uint64_t changes = atomic_load(&clk->changes);
    int64_t now_ns = atomic_load(&clk->now_ns);
    bool moved = changes != seen->changes || now_ns != seen->now_ns;
    if (moved) {
        *seen = (struct look){changes, now_ns, wall_ns};
    }
    lock();
    if (!moved) {
        sweep(wall_ns - seen->since_wall_ns);
    }
    unlock_and_wake(dispatch(), self);
}

/* How long to sleep before the next look, ns. Only start and end of processes and
 * the pace need short ones. The values may be stale: then a look comes early. */
static int64_t look_after_ns(const struct place *p)
{
    if (clk->pace > 0 && clk->holding == 0) {
        lock();
        int64_t left_ns = due_wall_ns(p->wake_ns) - wall();
        unlock();
        return left_ns < 1000 ? 1000 : left_ns < LOOK_NS ? left_ns : LOOK_NS;
    }
    bool running = false, soon = false;
    for (int i = 0; i < clk->used; i++) {
        uint32_t s = atomic_load_explicit(&clk->places[i].state, memory_order_relaxed);
        running |= s == RUNNING || s == LENT;
        soon |= s == RESERVED || s == LEAVING;
    }
    return soon && !running ? LOOK_SOON_NS : LOOK_NS;
}

/* Looks at the place for a moment before its thread sleeps: with a CPU to spare the
 * next turn comes sooner than two system calls take. Where that does not pay (the
 * other runs on this CPU, or long) it stops trying for a while. */
static bool spin_for_turn(struct place *p)
{
    static _Thread_local int budget = SPIN_MAX, skipped;
    if (clk->cpu >= 0 || (budget < 8 && ++skipped < SPIN_PROBE)) {
        return false;
    }
    int limit = budget < 8 ? SPIN_MAX : budget;
    skipped = 0;
    for (int n = 0; n < limit; n++) {
        if (atomic_load_explicit(&p->state, memory_order_acquire) == RUNNING) {
            budget = SPIN_MAX;
            return true;
        }
        pause_cpu();
    }
    budget /= 2;
    return false;
}

/* Waits until the place is RUNNING. -EINTR: a signal came; the place has then
 * waited for its turn at that moment, unless a second signal came. */
static int await_turn(struct place *p, const _Atomic bool *cancel)
{
    int result = 0;
    struct look seen = {0, 0, wall()};
    if (spin_for_turn(p)) {
        return 0;
    }
    for (;;) {
        uint32_t state = atomic_load_explicit(&p->state, memory_order_acquire);
        if (state == RUNNING || (cancel && atomic_load(cancel))) {
            return result;
        }
        int64_t ns = look_after_ns(p);
        struct timespec t = {ns / 1000000000, ns % 1000000000};
        atomic_store(&p->asleep, 1);
        long woken = syscall(SYS_futex, &p->state, FUTEX_WAIT, state, &t, NULL, 0);
        int err = woken < 0 ? errno : 0;
        atomic_store(&p->asleep, 0);
        if (err == ETIMEDOUT) {
            look_around(&seen, p);
        } else if (err == EINTR) {
            lock();
            if (result == -EINTR) { /* asked twice: the one who runs may be stuck */
                set_state(p, RUNNING);
            }
            p->wake_ns = clk->now_ns;
            result = -EINTR;
            changed();
            unlock_and_wake(dispatch(), p);
        }
    }
}

/* The commonest case, without lock and system call: nothing has changed since we
 * last saw who comes first among the others, and we come before. We are the only
 * one who runs, so only joiners could have changed anything: they count it. */
static bool advance_alone(int i, int64_t when)
{
    struct place *p = &clk->places[i];
    if (clk->pace > 0 || next_other.changes != atomic_load_explicit(&clk->changes, memory_order_acquire) ||
        atomic_load_explicit(&p->state, memory_order_relaxed) != RUNNING) {
        return false;
    }
    if (next_other.any) {
        if (when > next_other.wake_ns ||
            (when == next_other.wake_ns &&
             (p->prio > next_other.prio || (p->prio == next_other.prio && p->number > next_other.number)))) {
            return false;
        }
    }
    if (when > atomic_load_explicit(&clk->now_ns, memory_order_relaxed)) {
        atomic_store_explicit(&clk->now_ns, when, memory_order_release);
    }
    return true;
}

/* Puts place i, which runs, to sleep until `when`; the next one runs. */
static int wait_in(int i, int64_t when, const _Atomic bool *cancel)
{
    if (advance_alone(i, when)) {
        return 0;
    }
    struct place *p = &clk->places[i];
    lock();
    struct place *other = first_waiting(i);
    if (clk->holding == 1 && clk->pace <= 0) { /* we alone: remember who is next for the coming waits */
        next_other.any = other != NULL;
        if (other) {
            next_other.wake_ns = other->wake_ns;
            next_other.prio = other->prio;
            next_other.number = other->number;
        }
        next_other.changes = atomic_load_explicit(&clk->changes, memory_order_relaxed);
        if (advance_alone(i, when)) {
            unlock();
            return 0;
        }
    }
    p->wake_ns = when;
    set_state(p, WAITING);
    unlock_and_wake(dispatch(), p);
    return await_turn(p, cancel);
}

/* ---- The segment -------------------------------------------------------- */

static void leave_on_thread_end(void *value)
{
    (void)value;
    vclock_leave();
}

static void forget_after_fork(void)
{
    mine = -1;
}

/* At the end of the process: its last acts come before time goes on. */
static void process_end(void)
{
    if (mine < 0) {
        return;
    }
    struct place *p = &clk->places[mine];
    lock();
    if (p->lent > 0) {
        vacate(p);
    } else {
        set_state(p, LEAVING);
    }
    mine = -1;
    unlock_and_wake(dispatch(), NULL);
}

/* One participant runs at a time: on one CPU the next takes over in microseconds, while
 * another CPU that fell asleep would have to wake up first, at every switch. The CPU of
 * this instance, of those its maker may use; KERF_CLOCK_CPU=N: the N-th of them, "any": -1. */
static int choose_cpu(void)
{
    cpu_set_t allowed;
    const char *wish = getenv("KERF_CLOCK_CPU");
    if ((wish && strcmp(wish, "any") == 0) || sched_getaffinity(0, sizeof allowed, &allowed) != 0) {
        return -1;
    }
    int count = CPU_COUNT(&allowed);
    if (count < 1) {
        return -1;
    }
    int nth = (int)((wish ? strtoul(wish, NULL, 10) : (unsigned long)getpid()) % (unsigned long)count);
    for (int cpu = 0; cpu < CPU_SETSIZE; cpu++) {
        if (CPU_ISSET(cpu, &allowed) && nth-- == 0) {
            return cpu;
        }
    }
    return -1;
}

/* Keeps the calling thread, and its children, on the CPU of this instance. */
static void stay_on_cpu(void)
{
    if (clk->cpu < 0) {
        return;
    }
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(clk->cpu, &set);
    sched_setaffinity(0, sizeof set, &set); /* not allowed: slower, no worse */
}

static void segment_init(int key, double pace)
{
    clk->key = key;
    pthread_mutexattr_t attr;
    pthread_mutexattr_init(&attr);
    pthread_mutexattr_setpshared(&attr, PTHREAD_PROCESS_SHARED);
    pthread_mutexattr_setrobust(&attr, PTHREAD_MUTEX_ROBUST);
    pthread_mutex_init(&clk->lock, &attr);
    pthread_mutexattr_destroy(&attr);
    clk->now_ns = START_NS;
    clk->changes = 1;
    clk->pace = pace;
    clk->anchor_now_ns = START_NS;
    clk->anchor_wall_ns = wall();
    clk->cpu = pace > 0 ? -1 : choose_cpu();
    clk->magic = VCLOCK_MAGIC;
}

/* The segment has no key that could outlive its users: it is removed at once, and the
 * kernel keeps it (as SHM_DEST) until the last process has detached or died. Until then
 * its id stays valid, and the kernel's own table says which there are. */

/* A process that is killed between making a segment and marking it leaves it empty, without key
 * and without a process that could know it. */
static void remove_unfinished(int id, const struct shmid_ds *info)
{
    static const struct vclock empty;
    if (info->shm_perm.__key != IPC_PRIVATE || info->shm_perm.uid != geteuid() || info->shm_nattch != 0 ||
        kill(info->shm_cpid, 0) == 0 || errno != ESRCH) {
        return;
    }
    void *at = shmat(id, NULL, SHM_RDONLY);
    if (at == (void *)-1) {
        return;
    }
    if (memcmp(at, &empty, sizeof empty) == 0) {
        shmctl(id, IPC_RMID, NULL);
    }
    shmdt(at);
}

/* Attaches the living segment of this instance. NULL: there is none. Instance lock held. */
static struct vclock *segment_find(int key)
{
    struct shm_info totals;
    int last = shmctl(0, SHM_INFO, (struct shmid_ds *)(void *)&totals);
    for (int i = 0; i <= last; i++) {
        struct shmid_ds info;
        int id = shmctl(i, SHM_STAT, &info);
        if (id < 0 || info.shm_segsz != sizeof *clk) {
            continue;
        }
        if (!(info.shm_perm.mode & SHM_DEST)) {
            remove_unfinished(id, &info);
            continue;
        }
        struct vclock *at = shmat(id, NULL, 0);
        if (at == (void *)-1) {
            continue; /* its last user has gone, or it is another user's */
        }
        if (at->magic == VCLOCK_MAGIC && at->key == key) {
            return at;
        }
        shmdt(at);
    }
    return NULL;
}

/* Makes the segment; clk is set. 0 or -errno. Instance lock held. */
static int segment_new(int key, double pace)
{
    int id = shmget(IPC_PRIVATE, sizeof *clk, IPC_CREAT | 0600);
    if (id < 0) {
        return -errno;
    }
    void *at = shmat(id, NULL, 0);
    int result = at == (void *)-1 ? -errno : 0;
    shmctl(id, IPC_RMID, NULL);
    if (result == 0) {
        clk = at;
        segment_init(key, pace);
    }
    return result;
}

int vclock_attach(double pace)
{
    const char *hang = getenv("KERF_CLOCK_HANG_S");
    if (hang && atof(hang) > 0) {
        hang_ns = (int64_t)(atof(hang) * 1e9);
    }
    int handle = kerf_instance_lock("vclock");
    if (handle < 0) {
        return handle;
    }
    int key = kerf_instance_key(VCLOCK_KEY);
    clk = segment_find(key);
    int result = clk ? 0 : segment_new(key, pace);
    if (result == 0) {
        pthread_key_create(&thread_end, leave_on_thread_end);
        pthread_atfork(NULL, NULL, forget_after_fork);
        atexit(process_end);
    }
    kerf_instance_unlock(handle);
    return result;
}

double vclock_pace(void)
{
    return clk->pace;
}

int64_t vclock_now(void)
{
    return atomic_load_explicit(&clk->now_ns, memory_order_acquire);
}

/* ---- Participants ------------------------------------------------------- */

static void own(int i)
{
    mine = i;
    mine_number = clk->places[i].number;
    next_other.changes = 0;
    pthread_setspecific(thread_end, clk); /* any value but NULL */
}

/* Place named by a child's environment; -1 when it is not valid any more. */
static int named_place(const char *value)
{
    int i;
    unsigned long long number;
    if (!value || sscanf(value, "%d.%llu", &i, &number) != 2 || i < 0 || i >= clk->used) {
        return -1;
    }
    return clk->places[i].number == number ? i : -1;
}

/* Takes a fresh place and returns in its turn. */
static int enter(const char *name, int prio)
{
    lock();
    int i = take_place(name, prio, myself());
    if (i < 0) {
        unlock();
        return -ENOSPC;
    }
    struct place *p = &clk->places[i];
    own(i);
    set_state(p, WAITING);
    unlock_and_wake(dispatch(), p);
    await_turn(p, NULL);
    return 0;
}

/* Takes the place the parent gave us. false: there is none. */
static bool take_given(const char *name, int prio, const char *value)
{
    lock();
    int i = named_place(value);
    struct place *p = i >= 0 ? &clk->places[i] : NULL;
    if (p && p->state == LENT) {
        p->owner = myself();
        own(i);
        set_state(p, RUNNING);
        unlock();
        return true;
    }
    if (p && p->state == RESERVED) {
        p->owner = myself();
        p->prio = prio;
        p->wake_ns = clk->now_ns;
        p->reported = false;
        snprintf(p->name, sizeof p->name, "%s", name);
        own(i);
        set_state(p, WAITING);
        unlock_and_wake(dispatch(), p);
        await_turn(p, NULL);
        return true;
    }
    unlock();
    return false;
}

int vclock_join(const char *name, int prio, const char *place)
{
    if (mine < 0) {
        stay_on_cpu();
    }
    if (mine >= 0 || take_given(name, prio, place)) {
        return 0;
    }
    return enter(name, prio);
}

void vclock_leave(void)
{
    if (mine < 0) {
        return;
    }
    struct place *p = &clk->places[mine];
    mine = -1;
    pthread_setspecific(thread_end, NULL);
    lock();
    if (p->number == mine_number) {
        vacate(p);
    }
    unlock_and_wake(dispatch(), NULL);
}

int vclock_joined(void)
{
    return mine >= 0;
}

void vclock_suspend(void)
{
    if (mine < 0) {
        return;
    }
    lock();
    set_state(&clk->places[mine], SUSPENDED);
    unlock_and_wake(dispatch(), NULL);
}

void vclock_resume(void)
{
    if (mine < 0 || clk->places[mine].state != SUSPENDED) {
        return;
    }
    struct place *p = &clk->places[mine];
    lock();
    p->wake_ns = clk->now_ns;
    set_state(p, WAITING);
    unlock_and_wake(dispatch(), p);
    await_turn(p, NULL);
}

int vclock_sleep_until(int64_t when_ns, const char *place)
{
    if (mine >= 0) {
        struct place *p = &clk->places[mine];
        if (p->state == LENT || (p->lent > 0 && !same(p->owner, myself()))) {
            /* Our child runs in our place: this can only be a wait for it. */
            struct timespec t = {0, 1000000};
            return nanosleep(&t, NULL) < 0 ? -errno : 0;
        }
        return wait_in(mine, when_ns, NULL);
    }
    /* A guest has a place for the length of its wait: its parent's if that is lent
     * (time would stand for ever otherwise), else one that comes up at `when`. */
    int result;
    if (take_given("guest", KERF_CLOCK_PRIO_USER, place)) {
        result = wait_in(mine, when_ns, NULL);
    } else {
        lock();
        int i = take_place("guest", KERF_CLOCK_PRIO_USER, myself());
        if (i < 0) {
            unlock();
            return -ENOSPC;
        }
        struct place *p = &clk->places[i];
        p->wake_ns = when_ns;
        own(i);
        set_state(p, WAITING);
        unlock_and_wake(dispatch(), p);
        result = await_turn(p, NULL);
    }
    vclock_leave();
    return result;
}

int vclock_place_new(const char *name, int prio)
{
    lock();
    int i = take_place(name, prio, myself());
    if (i >= 0) {
        set_state(&clk->places[i], WAITING);
    }
    unlock_and_wake(dispatch(), NULL);
    return i < 0 ? -ENOSPC : i;
}

void vclock_place_drop(int place)
{
    lock();
    vacate(&clk->places[place]);
    unlock_and_wake(dispatch(), NULL);
}

void vclock_place_adopt(int place, const _Atomic bool *cancel)
{
    stay_on_cpu();
    own(place);
    await_turn(&clk->places[place], cancel);
}

void vclock_sleep_cancelable(int64_t when_ns, const _Atomic bool *cancel)
{
    wait_in(mine, when_ns, cancel);
}

void vclock_poke(int place)
{
    futex_wake(&clk->places[place]);
}

/* ---- Children ----------------------------------------------------------- */

int vclock_lend(char *value, size_t size)
{
    if (size > 0) {
        *value = 0;
    }
    if (mine < 0) {
        return 0;
    }
    struct place *p = &clk->places[mine];
    lock();
    int result = p->lent < MAX_LENDERS ? 0 : -ENOSPC;
    if (result == 0) {
        p->lenders[p->lent++] = p->owner;
        set_state(p, LENT);
        snprintf(value, size, "%d.%llu", mine, (unsigned long long)p->number);
    }
    unlock();
    return result;
}

void vclock_reclaim(void)
{
    if (mine < 0) {
        return;
    }
    struct place *p = &clk->places[mine];
    struct owner me = myself();
    char name[sizeof p->name];
    lock();
    bool ours = p->number == mine_number && p->lent > 0 && same(p->lenders[p->lent - 1], me);
    if (ours && (p->state == LENT || !alive(p->owner))) {
        /* The borrower gave it back, or died in it: then its wait is ours to end. */
        bool turn = holds(p->state);
        p->lent--;
        p->owner = me;
        next_other.changes = 0;
        if (turn) {
            set_state(p, RUNNING);
            unlock();
            return;
        }
        p->wake_ns = clk->now_ns;
        set_state(p, WAITING);
        unlock_and_wake(dispatch(), p);
        await_turn(p, NULL);
        return;
    }
    /* Somebody else lives in it (a child that went into the background): it is
     * theirs now, and we take a new one. */
    int prio = p->prio;
    memcpy(name, p->name, sizeof name);
    if (ours) {
        p->lent = 0;
    }
    mine = -1;
    unlock();
    enter(name, prio);
}

int vclock_reserve(char *value, size_t size, const char *name, int prio)
{
    if (size > 0) {
        *value = 0;
    }
    if (mine < 0) {
        return 0;
    }
    lock();
    int i = take_place(name, prio, (struct owner){0, 0});
    if (i >= 0) {
        struct place *p = &clk->places[i];
        p->lenders[0] = myself();
        set_state(p, RESERVED);
        snprintf(value, size, "%d.%llu", i, (unsigned long long)p->number);
    }
    unlock();
    return i < 0 ? -ENOSPC : 0;
}

void vclock_reserved_for(const char *value, pid_t pid)
{
    uint64_t start = start_of(pid);
    lock();
    int i = named_place(value);
    if (i >= 0 && clk->places[i].state == RESERVED) {
        clk->places[i].owner = (struct owner){pid, start};
    }
    unlock();
}

void vclock_unreserve(const char *value)
{
    lock();
    int i = named_place(value);
    if (i >= 0 && clk->places[i].state == RESERVED) {
        vacate(&clk->places[i]);
    }
    unlock_and_wake(dispatch(), NULL);
}

/* ---- For people --------------------------------------------------------- */

void vclock_print(FILE *to)
{
    lock();
    fprintf(to, "virtual time %.9f s, ", (double)clk->now_ns * 1e-9);
    if (clk->pace > 0) {
        fprintf(to, "pace %g\n", clk->pace);
    } else {
        fprintf(to, "as fast as possible\n");
    }
    for (int i = 0; i < clk->used; i++) {
        struct place *p = &clk->places[i];
        if (p->state == FREE) {
            continue;
        }
        fprintf(to, "%5d %-9s %-24s prio %3d", (int)p->owner.pid, state_names[p->state], p->name, p->prio);
        if (p->state == WAITING) {
            fprintf(to, " wakes in %.6f s", (double)(p->wake_ns - clk->now_ns) * 1e-9);
        }
        fputc('\n', to);
    }
    unlock();
}
