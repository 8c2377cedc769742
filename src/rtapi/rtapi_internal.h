/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * rtapi_internal.h - what the parts of RTAPI share among themselves; the same
 * objects serve ordinary processes (liblinuxcnchal) and the realtime host.
 */
#ifndef RTAPI_INTERNAL_H
#define RTAPI_INTERNAL_H

#include <stdarg.h>
#include <stdbool.h>
#include <sys/types.h>
#include "rtapi.h"
#include "rtapi_atomic.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RTAPI_UUID_KEY 0x48484c34 /* holds the counter of module ids */

/* Prints one message; one implementation per kind of process. */
void rtapi_default_msg_handler(msg_level_t level, const char *fmt, va_list ap);

/* How shared segments are made; the host sets it once at its start. */
struct rtapi_shmem_policy {
    bool privileged;        /* effective uid 0: give segments to `owner` */
    uid_t owner;
    bool lock;              /* keep them in RAM */
    void (*root_begin)(void); /* around system calls that need root's rights */
    void (*root_end)(void);
};
extern struct rtapi_shmem_policy rtapi_shmem_policy;

/* Above this size a segment is sparse: pages come into being at first use, and
 * only they are locked. Below, all pages are touched at attach. */
#define RTAPI_SHMEM_SPARSE_MIN (4UL << 20)

/* The segment of module ids. It also knows which segments the instance ever had,
 * so that left-over ones are found. Counter and entries are atomic: nobody can die
 * holding a lock in it. A key of 0 is a free entry; entries are never taken back. */
#define RTAPI_KEYS_MAX 1000
struct rtapi_uuid_segment {
    unsigned long unused; /* a lock in other versions */
    rtapi_atomic_int last_id;
    rtapi_atomic_int keys[RTAPI_KEYS_MAX]; /* as mapped for the instance */
};

/* Removes this instance's segments that no process is attached to, also those of
 * `extra` (documented keys; count may be 0). Returns how many it removed. [init] */
int rtapi_shmem_remove_stale(const int *extra, int count);

#ifdef __cplusplus
}
#endif

#endif
