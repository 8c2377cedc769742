/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_segment.c - the shared HAL segment: mapping, memory, the database lock.
 *
 * In:     RTAPI shared memory under HAL_KEY
 * Out:    hal_data, blocks of memory, a lock that survives its holder
 * Thread: [init]
 *
 * Memory that realtime code touches grows from below and is never given back;
 * objects and index grow from above.
 */
#include "hal_priv.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>
#include "kerf_instance.h"

char *hal_shmem_base;
struct hal_segment *hal_data;
static int shmem_id = -1;

/* ---- Mapping -------------------------------------------------------------- */

static void segment_make(struct hal_segment *seg)
{
    pthread_mutexattr_t attr;
    memset(seg, 0, sizeof *seg);
    pthread_mutexattr_init(&attr);
    pthread_mutexattr_setpshared(&attr, PTHREAD_PROCESS_SHARED);
    pthread_mutexattr_setrobust(&attr, PTHREAD_MUTEX_ROBUST);
    for (int i = 0; i < HAL_LOCKS; i++) {
        pthread_mutex_init(&seg->locks[i], &attr);
    }
    pthread_mutexattr_destroy(&attr);
    seg->magic = HAL_MAGIC;
    seg->size = HAL_SIZE;
    seg->bottom = (sizeof *seg + 4095) & ~4095u;
    seg->top = HAL_SIZE;
    seg->realtime_type = REALTIME_TYPE_UNINITIALIZED;
    halp_index_init();
    HALP_COMMIT(seg->version, HAL_VER);
}

int halp_map(int module_id)
{
    void *mem;
    int id = rtapi_shmem_new(HAL_KEY, module_id, HAL_SIZE);
    if (id < 0) {
        halp_err("HAL: ERROR: could not open shared memory\n");
        return -EINVAL;
    }
    if (rtapi_shmem_getptr(id, &mem) < 0) {
        rtapi_shmem_delete(id, module_id);
        halp_err("HAL: ERROR: could not access shared memory\n");
        return -EINVAL;
    }
    struct hal_segment *seg = mem;
    hal_shmem_base = mem;
    hal_data = seg;
    if (__atomic_load_n(&seg->version, __ATOMIC_ACQUIRE) == 0) {
        /* New, or its maker died half-way. One process makes it. */
        int guard = kerf_instance_lock("hal");
        if (__atomic_load_n(&seg->version, __ATOMIC_ACQUIRE) == 0) {
            segment_make(seg);
        }
        kerf_instance_unlock(guard);
    }
    if (seg->version != HAL_VER || seg->magic != HAL_MAGIC) {
        rtapi_print("HAL: version:%d expected:%d\n", seg->version, HAL_VER);
        halp_err("HAL: ERROR: version code mismatch\n");
        halp_err("HAL: ERROR: could not init shared memory\n");
        hal_data = NULL;
        hal_shmem_base = NULL;
        rtapi_shmem_delete(id, module_id);
        return -EINVAL;
    }
    shmem_id = id;
    return 0;
}

void halp_unmap(int module_id)
{
    if (shmem_id >= 0) {
        rtapi_shmem_delete(shmem_id, module_id);
    }
    shmem_id = -1;
    hal_data = NULL;
    hal_shmem_base = NULL;
}

int hal_is_init(void)
{
    return hal_data != NULL;
}

/* ---- Processes ------------------------------------------------------------- */

/* State letter and start time (clock ticks since boot) of a process; false: there
 * is none, errno says why. */
static bool process_stat(int pid, char *state, uint64_t *start)
{
    char path[40], text[512];
    snprintf(path, sizeof path, "/proc/%d/stat", pid);
    int fd = open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0) {
        return false;
    }
    ssize_t n = read(fd, text, sizeof text - 1);
    int err = errno;
    close(fd);
    if (n <= 0) {
        errno = n < 0 ? err : ESRCH;
        return false;
    }
    text[n] = 0;
    char *p = strrchr(text, ')'); /* the name in parentheses may hold anything */
    errno = EINVAL;
    if (!p || p[1] != ' ') {
        return false;
    }
    *state = p[2];
    unsigned long long value;
    /* Fields 3 (state) to 22 (start time). */
    if (sscanf(p + 2,
               "%*c %*d %*d %*d %*d %*d %*u %*u %*u %*u %*u %*u %*u %*d %*d %*d %*d %*d %*d %llu",
               &value) != 1) {
        return false;
    }
    *start = value;
    return true;
}

static uint64_t pid_namespace(void)
{
    struct stat st;
    return stat("/proc/self/ns/pid", &st) == 0 ? (uint64_t)st.st_ino : 0;
}

void halp_process_self(struct hal_process *p)
{
    char state;
    memset(p, 0, sizeof *p);
    p->pid = getpid();
    if (!process_stat(p->pid, &state, &p->start)) {
        p->start = 0;
    }
    p->ns = pid_namespace();
}

bool halp_process_gone(const struct hal_process *p)
{
    char state;
    uint64_t start;
    if (p->pid == 0 || p->pid == getpid() || p->start == 0 || p->ns != pid_namespace()) {
        return false; /* nothing can be said about it */
    }
    if (!process_stat(p->pid, &state, &start)) {
        return errno == ENOENT || errno == ESRCH;
    }
    return start != p->start || state == 'Z' || state == 'X';
}

/* ---- Lock ------------------------------------------------------------------ */

#define LOCK_LOOK_NS 200000000L /* how often a waiter looks for a forced release */

static __thread int lock_depth;
static __thread uint32_t lock_held;

/* Takes the lock with number idx. 0: got it; ETIMEDOUT: look again. */
static int take(uint32_t idx)
{
    pthread_mutex_t *m = &hal_data->locks[idx % HAL_LOCKS];
    int r = pthread_mutex_trylock(m);
    if (r == EBUSY) {
        struct timespec until;
        clock_gettime(CLOCK_MONOTONIC, &until);
        until.tv_nsec += LOCK_LOOK_NS;
        if (until.tv_nsec >= 1000000000L) {
            until.tv_nsec -= 1000000000L;
            until.tv_sec++;
        }
        r = pthread_mutex_clocklock(m, CLOCK_MONOTONIC, &until);
    }
    return r;
}

void halp_lock(void)
{
    if (lock_depth++ > 0) {
        return;
    }
    for (;;) {
        uint32_t idx = atomic_load(&hal_data->lock_index);
        int r = take(idx);
        if (r == EOWNERDEAD || r == 0) {
            int dead = atomic_load(&hal_data->lock_pid);
            pthread_mutex_t *m = &hal_data->locks[idx % HAL_LOCKS];
            if (r == EOWNERDEAD) {
                pthread_mutex_consistent(m);
            }
            if (atomic_load(&hal_data->lock_index) != idx) {
                pthread_mutex_unlock(m);
                continue;
            }
            lock_held = idx;
            atomic_store(&hal_data->lock_pid, getpid());
            if (atomic_load(&hal_data->dirty)) {
                halp_recover(dead);
            }
            return;
        }
        if (r != ETIMEDOUT && r != EAGAIN) {
            atomic_compare_exchange_strong(&hal_data->lock_index, &idx, idx + 1);
        }
    }
}

void halp_unlock(void)
{
    if (--lock_depth > 0) {
        return;
    }
    atomic_signal_fence(memory_order_seq_cst);
    if (atomic_load(&hal_data->lock_index) == lock_held) {
        if (atomic_load_explicit(&hal_data->dirty, memory_order_relaxed)) {
            atomic_store(&hal_data->dirty, 0);
        }
        atomic_store(&hal_data->lock_pid, 0);
    }
    pthread_mutex_unlock(&hal_data->locks[lock_held % HAL_LOCKS]);
}

void halp_change(void)
{
    atomic_store(&hal_data->dirty, 1);
    atomic_signal_fence(memory_order_seq_cst);
}

int halp_force_release(void)
{
    uint32_t idx = atomic_load(&hal_data->lock_index);
    pthread_mutex_t *m = &hal_data->locks[idx % HAL_LOCKS];
    int r = pthread_mutex_trylock(m);
    if (r == EOWNERDEAD) {
        pthread_mutex_consistent(m);
        r = 0;
    }
    if (r == 0) {
        pthread_mutex_unlock(m); /* nobody holds it; what a dead one left is repaired at the next lock */
        return 0;
    }
    /* A living process hangs with it: everybody goes on with the next lock, and
     * what it was changing is repaired. */
    if (atomic_compare_exchange_strong(&hal_data->lock_index, &idx, idx + 1)) {
        halp_lock();
        halp_unlock();
    }
    return 0;
}

/* ---- Memory ----------------------------------------------------------------- */

hal_off halp_alloc_low(size_t size)
{
    size_t align = size >= 16 ? 16 : 8;
    size = size < 8 ? 8 : size;
    uint64_t at = ((uint64_t)hal_data->bottom + align - 1) & ~(uint64_t)(align - 1);
    if (at + size > hal_data->top) {
        return 0;
    }
    HALP_COMMIT(hal_data->bottom, (hal_off)(at + size));
    /* Brings the pages into this process, so that a cycle does not have to. */
    return halp_off(memset(hal_shmem_base + at, 0, size));
}

hal_off halp_alloc_high(size_t size)
{
    size = (size + 63) & ~(size_t)63;
    if (size > hal_data->top - hal_data->bottom) {
        return 0;
    }
    hal_off at = (hal_data->top - (hal_off)size) & ~63u;
    if (at < hal_data->bottom) {
        return 0;
    }
    HALP_COMMIT(hal_data->top, at);
    return halp_off(memset(hal_shmem_base + at, 0, size));
}

static int block_class(size_t size)
{
    int c = 6;
    while (((size_t)1 << c) < size) {
        c++;
    }
    return c;
}

/* A block that was given back may still be looked at for a moment; the oldest one
 * is used first, and only when some more wait behind it. */
#define BLOCKS_KEPT 4

hal_off halp_block_new(size_t size)
{
    int c = block_class(size);
    if (c >= HAL_BLOCK_CLASSES) {
        return 0;
    }
    if (hal_data->blocks[c].count > BLOCKS_KEPT) {
        hal_off at = hal_data->blocks[c].first;
        hal_data->blocks[c].first = *(hal_off *)halp_ptr(at);
        hal_data->blocks[c].count--;
        return at;
    }
    return halp_alloc_high((size_t)1 << c);
}

void halp_block_free(hal_off at, size_t size)
{
    int c = block_class(size);
    *(hal_off *)halp_ptr(at) = 0;
    if (hal_data->blocks[c].count) {
        *(hal_off *)halp_ptr(hal_data->blocks[c].last) = at;
    } else {
        hal_data->blocks[c].first = at;
    }
    hal_data->blocks[c].last = at;
    hal_data->blocks[c].count++;
}

void *hal_malloc(long int size)
{
    if (!hal_data) {
        halp_err("HAL: ERROR: hal_malloc called before init\n");
        return NULL;
    }
    if (size <= 0) {
        halp_err("HAL: ERROR: hal_malloc(%ld): size must be positive\n", size);
        return NULL;
    }
    halp_lock();
    halp_change();
    hal_off at = (size_t)size < HAL_SIZE ? halp_alloc_low((size_t)size) : 0;
    halp_unlock();
    if (!at) {
        halp_err("HAL: ERROR: hal_malloc(%ld): insufficient memory\n", size);
        return NULL;
    }
    return halp_ptr(at);
}

rtapi_intptr_t hal_reference_unmap(const void *ptr)
{
    return ptr && halp_inside(ptr, 1) ? (rtapi_intptr_t)halp_off(ptr) : 0;
}

void *hal_reference_map(rtapi_intptr_t ref)
{
    return hal_data && ref > 0 && (uint64_t)ref < HAL_SIZE ? hal_shmem_base + ref : NULL;
}
