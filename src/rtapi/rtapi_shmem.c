/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * rtapi_shmem.c - shared memory segments by key, counted per process.
 *
 * In:     documented keys; kerf_instance_key() gives the instance's own
 * Out:    ids 0..63 of this process
 * Thread: new and delete [init]/[user]; getptr [any]
 *
 * A segment without attached process is left over from dead owners: it is
 * removed before a new one is made, so nobody starts on old contents or a wrong
 * size. Attach and removal happen under the instance's lock, so a segment can
 * not vanish between the two steps of another process.
 */
#include "rtapi_internal.h"

#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <string.h>
#include <sys/ipc.h>
#include <sys/mman.h>
#include <sys/shm.h>
#include <unistd.h>
#include "kerf_instance.h"

#define MAX_SHM 64

struct segment {
    int key;            /* of the instance; refs 0 = free entry */
    int refs;
    int shmid;
    unsigned long size; /* as attached */
    void *mem;
};
static struct segment segments[MAX_SHM];
static pthread_mutex_t segments_mutex = PTHREAD_MUTEX_INITIALIZER;

struct rtapi_shmem_policy rtapi_shmem_policy;

static void as_root(bool on)
{
    void (*step)(void) = on ? rtapi_shmem_policy.root_begin : rtapi_shmem_policy.root_end;
    if (step) {
        step();
    }
}

/* Called with the instance lock held. */
static int remove_if_unused(int key)
{
    struct shmid_ds info;
    int shmid = shmget(key, 0, 0);
    if (shmid < 0) {
        return errno == ENOENT ? 0 : -errno;
    }
    if (shmctl(shmid, IPC_STAT, &info) < 0) {
        return -errno;
    }
    if (info.shm_nattch != 0) {
        return 0;
    }
    return shmctl(shmid, IPC_RMID, NULL) < 0 ? -errno : 1;
}

/* Removes what the registry names and nobody uses. Called with the instance lock
 * held. */
static int remove_registered(void)
{
    int removed = 0, shmid = shmget(kerf_instance_key(RTAPI_UUID_KEY), sizeof(struct rtapi_uuid_segment), 0);
    void *mem = shmid < 0 ? (void *)-1 : shmat(shmid, NULL, SHM_RDONLY);
    if (mem == (void *)-1) {
        return 0;
    }
    struct rtapi_uuid_segment *uuid = mem;
    for (int i = 0; i < RTAPI_KEYS_MAX; i++) {
        int key = atomic_load_explicit(&uuid->keys[i], memory_order_relaxed);
        removed += key != 0 && remove_if_unused(key) > 0;
    }
    shmdt(mem);
    return removed;
}

int rtapi_shmem_remove_stale(const int *extra, int count)
{
    int lock = kerf_instance_lock("shm");
    as_root(true);
    int removed = remove_registered();
    for (int i = 0; i < count; i++) {
        removed += remove_if_unused(kerf_instance_key(extra[i])) > 0;
    }
    removed += remove_if_unused(kerf_instance_key(RTAPI_UUID_KEY)) > 0;
    as_root(false);
    kerf_instance_unlock(lock);
    return removed;
}

/* Notes the key in the registry, if this process has it. Instance lock held. */
static void register_key(int key)
{
    int uuid_key = kerf_instance_key(RTAPI_UUID_KEY);
    for (int i = 0; i < MAX_SHM; i++) {
        if (segments[i].refs == 0 || segments[i].key != uuid_key || key == uuid_key) {
            continue;
        }
        struct rtapi_uuid_segment *uuid = segments[i].mem;
        for (int k = 0; k < RTAPI_KEYS_MAX; k++) {
            int found = atomic_load_explicit(&uuid->keys[k], memory_order_relaxed);
            if (found == key) {
                return;
            }
            if (found == 0) {
                atomic_store(&uuid->keys[k], key);
                return;
            }
        }
    }
}

/* Locks what was attached. A sparse segment is attached while the process locks
 * pages on first use only; afterwards the stricter rule for new maps returns. */
static void *attach(int shmid, unsigned long size)
{
    bool sparse = size > RTAPI_SHMEM_SPARSE_MIN;
    if (rtapi_shmem_policy.lock && sparse) {
        mlockall(MCL_FUTURE | MCL_ONFAULT);
    }
    void *mem = shmat(shmid, NULL, 0);
    if (rtapi_shmem_policy.lock && sparse) {
        mlockall(MCL_FUTURE);
    }
    if (mem == (void *)-1 && errno == EAGAIN && rtapi_shmem_policy.lock) {
        rtapi_print_msg(RTAPI_MSG_ERR,
                        "rtapi_shmem_new: the limit of locked memory (ulimit -l) is too low for %lu KiB; memory is not "
                        "locked any more. Realtime latency may suffer.\n",
                        size >> 10);
        munlockall();
        rtapi_shmem_policy.lock = false;
        mem = shmat(shmid, NULL, 0);
    }
    if (mem == (void *)-1) {
        return NULL;
    }
    if (rtapi_shmem_policy.lock && !sparse && shmctl(shmid, SHM_LOCK, NULL) < 0) {
        rtapi_print_msg(RTAPI_MSG_WARN, "shared memory segment not locked as requested\n");
    }
    if (!sparse) {
        long page = sysconf(_SC_PAGESIZE);
        for (volatile char *p = mem; p < (char *)mem + size; p += page) {
            (void)*p;
        }
    }
    return mem;
}

/* Makes or opens the segment; under the instance lock. 0 or -errno, said why. */
static int open_segment(struct segment *seg, int key, unsigned long size)
{
    if (key == kerf_instance_key(RTAPI_UUID_KEY)) {
        struct shmid_ds info;
        int old = shmget(key, 0, 0);
        if (old >= 0 && shmctl(old, IPC_STAT, &info) == 0 && info.shm_nattch == 0) {
            remove_registered(); /* all its users are dead: so are their segments */
        }
    }
    int removed = remove_if_unused(key);
    if (removed > 0) {
        rtapi_print_msg(RTAPI_MSG_WARN, "rtapi_shmem_new: removed left-over segment 0x%08x\n", key);
    }
    int shmid = shmget(key, size, IPC_CREAT | 0600);
    if (shmid < 0) {
        int err = errno;
        rtapi_print_msg(RTAPI_MSG_ERR, "rtapi_shmem_new failed due to shmget(key=0x%08x): %s\n", key, strerror(err));
        return -err;
    }
    struct shmid_ds info;
    if (rtapi_shmem_policy.privileged && shmctl(shmid, IPC_STAT, &info) == 0 &&
        info.shm_perm.uid != rtapi_shmem_policy.owner) {
        info.shm_perm.uid = rtapi_shmem_policy.owner;
        if (shmctl(shmid, IPC_SET, &info) < 0) {
            rtapi_print_msg(RTAPI_MSG_WARN, "rtapi_shmem_new: segment 0x%08x stays root's: %s\n", key,
                            strerror(errno));
        }
    }
    void *mem = attach(shmid, size);
    if (!mem) {
        int err = errno;
        remove_if_unused(key);
        rtapi_print_msg(RTAPI_MSG_ERR, "rtapi_shmem_new failed due to shmat(): %s\n", strerror(err));
        return -err;
    }
    *seg = (struct segment){.key = key, .refs = 1, .shmid = shmid, .size = size, .mem = mem};
    register_key(key);
    return 0;
}

int rtapi_shmem_new(int key, int module_id, unsigned long size)
{
    (void)module_id;
    int own_key = kerf_instance_key(key);
    int id = -1, result = 0;
    pthread_mutex_lock(&segments_mutex);
    for (int i = 0; i < MAX_SHM; i++) {
        if (segments[i].refs > 0 && segments[i].key == own_key) {
            segments[i].refs++;
            pthread_mutex_unlock(&segments_mutex);
            return i;
        }
        if (segments[i].refs == 0 && id < 0) {
            id = i;
        }
    }
    if (id < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "rtapi_shmem_new failed due to MAX_SHM\n");
        result = -ENOMEM;
    } else {
        int lock = kerf_instance_lock("shm");
        as_root(true);
        result = open_segment(&segments[id], own_key, size);
        as_root(false);
        kerf_instance_unlock(lock);
    }
    pthread_mutex_unlock(&segments_mutex);
    return result < 0 ? result : id;
}

int rtapi_shmem_getptr(int shmem_id, void **ptr)
{
    if (shmem_id < 0 || shmem_id >= MAX_SHM || segments[shmem_id].refs == 0) {
        return -EINVAL;
    }
    *ptr = segments[shmem_id].mem;
    return 0;
}

int rtapi_shmem_delete(int shmem_id, int module_id)
{
    (void)module_id;
    int result = 0;
    if (shmem_id < 0 || shmem_id >= MAX_SHM) {
        return -EINVAL;
    }
    pthread_mutex_lock(&segments_mutex);
    struct segment *seg = &segments[shmem_id];
    if (seg->refs == 0) {
        result = -EINVAL;
    } else if (--seg->refs == 0) {
        int lock = kerf_instance_lock("shm");
        as_root(true);
        struct shmid_ds info;
        if (shmdt(seg->mem) < 0) {
            rtapi_print_msg(RTAPI_MSG_ERR, "rtapi_shmem_delete: shmdt: %s\n", strerror(errno));
            result = -EINVAL;
        } else if (shmctl(seg->shmid, IPC_STAT, &info) == 0 && info.shm_nattch == 0 &&
                   shmctl(seg->shmid, IPC_RMID, NULL) < 0) {
            rtapi_print_msg(RTAPI_MSG_ERR, "rtapi_shmem_delete: removing segment 0x%08x: %s\n", seg->key,
                            strerror(errno));
            result = -EINVAL;
        }
        as_root(false);
        kerf_instance_unlock(lock);
    }
    pthread_mutex_unlock(&segments_mutex);
    return result;
}
