/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_priv.h - the shared HAL segment and what the parts of the library share.
 * Not installed: programs use the query interface of hal.h.
 *
 * Everything lies in one segment at offsets from its start (hal_off, 0 = none),
 * so that it may be mapped anywhere. docs/hal-internals.md describes it.
 *
 * Truth and index: the truth is in the objects' own fields and their state. All
 * lists, the hash index, the trees and counts can be made again from it; that is
 * what halp_recover() does after a process died while it changed something. So
 * every change has one store that commits it.
 */
#ifndef HAL_PRIV_H
#define HAL_PRIV_H

#include <pthread.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>
#include "hal.h"

#define HAL_KEY 0x48414C32
#define HAL_VER 0x14
#define HAL_MAGIC 0x4B455246u /* ours: the layout differs from others' of this version */
#define HAL_SIZE (256UL << 20) /* reserved; a page costs memory when first used */

typedef uint32_t hal_off;

/* ---- Objects ------------------------------------------------------------- */

enum hal_kind { HAL_KIND_COMP, HAL_KIND_PIN, HAL_KIND_PARAM, HAL_KIND_SIG, HAL_KIND_FUNCT, HAL_KIND_THREAD,
                HAL_KIND_ALIAS, HAL_KIND_COUNT };

/* FREE: in the free list or never used. NEW: being made, not there yet. LIVE.
 * DYING: being removed, must not survive a recovery. */
enum hal_state { HAL_FREE, HAL_NEW, HAL_LIVE, HAL_DYING };

/* Begins every object. hash_next, left, right, prev and next are index. */
struct hal_obj {
    uint8_t kind;
    uint8_t state;      /* enum hal_state: the commit point */
    uint16_t unused;
    uint32_t hash;      /* of name */
    hal_off hash_next;  /* chain of the bucket */
    hal_off left, right; /* treap by name; the priority comes from hash */
    hal_off prev, next; /* in order: by name, or newest first (comps, threads); free list */
    uint32_t serial;    /* order of creation */
    char name[HAL_NAME_LEN + 1];
};

struct hal_comp {
    struct hal_obj o;
    int32_t comp_id;
    int32_t type;            /* hal_comp_type_t */
    int32_t pid;             /* 0: realtime */
    uint32_t ready;
    uint64_t pid_start;      /* start time of process pid, clock ticks since boot */
    uint64_t pid_ns;         /* its pid name space */
    uint64_t base;           /* where the owner has the segment mapped */
    uint64_t make;           /* constructor, an address in the host; 0: none */
    hal_off insmod;          /* load arguments in HAL memory */
    hal_off pins, params, functs; /* index: owned objects, newest first */
    hal_off id_next;         /* index: chain by id */
};

struct hal_pin {
    struct hal_obj o;
    hal_off owner;
    hal_off var;             /* the owner's pointer variable */
    hal_off signal;          /* 0: not linked. Commit point of link and unlink */
    hal_off alias;           /* struct hal_alias; 0: the name is the original one */
    int8_t type;             /* hal_type_t */
    uint8_t dir;
    uint16_t unused;
    hal_off owner_next, owner_prev;   /* index */
    hal_off member_next, member_prev; /* index: pins of the signal */
    hal_data_u own __attribute__((aligned(8))); /* value while not linked */
};

struct hal_param {
    struct hal_obj o;
    hal_off owner;
    hal_off data;            /* the value: own, or the owner's variable */
    hal_off alias;
    int8_t type;
    uint8_t dir;
    uint16_t unused;
    hal_off owner_next, owner_prev; /* index */
    hal_data_u own __attribute__((aligned(8)));
};

struct hal_sig {
    struct hal_obj o;
    int32_t type;
    int32_t readers, writers, bidirs; /* index */
    hal_off members;                  /* index: linked pins */
    hal_off port;                     /* buffer block kept for this place; may be unused */
    hal_data_u value __attribute__((aligned(8)));
};

/* The first part is what a thread touches each cycle: one cache line. */
struct hal_funct {
    struct hal_obj o;
    uint64_t funct __attribute__((aligned(64))); /* void (*)(void *, long) in the host */
    uint64_t arg;
    hal_s32_t *runtime;      /* pin .time; an address in the host */
    hal_s32_t maxtime;       /* parameter .tmax */
    hal_bit_t maxtime_increased;
    uint8_t reentrant;
    uint16_t unused;
    int32_t users;           /* index: places in cyclic and pending init lists */
    hal_off owner;
    hal_off owner_next, owner_prev; /* index */
};

/* A list of functions as a thread walks it. Never changed once published. */
struct hal_flist {
    uint32_t count;
    hal_off functs[];
};

struct hal_thread {
    struct hal_obj o;
    int64_t period;          /* ns */
    int32_t priority;
    int32_t task_id;
    int32_t comp_id;         /* of the pseudo component */
    _Atomic uint32_t init_done;
    _Atomic uint32_t cycle;  /* odd while a cycle runs */
    _Atomic hal_off list;    /* struct hal_flist; 0: empty. Commit point */
    _Atomic hal_off inits;
    hal_s32_t maxtime;       /* parameter .tmax */
    hal_s32_t *runtime;      /* pin .time */
    hal_s64_t *beat;         /* pin .threadbeat */
};

/* o.name is the original name. */
struct hal_alias {
    struct hal_obj o;
    hal_off target;
    uint8_t target_kind;
    uint8_t ending;          /* 1: the target gets its original name back */
    uint16_t unused;
    char alias[HAL_NAME_LEN + 1];
};

/* ---- The segment ----------------------------------------------------------- */

struct hal_pool {
    uint32_t size;           /* of an object */
    uint32_t per_chunk;
    hal_off chunks;          /* newest; each begins with the offset of the next older one */
    uint32_t used;           /* objects of the newest chunk that were ever used */
    hal_off free_first, free_last; /* index: oldest freed first */
    uint32_t nfree, nlive;   /* index */
};

struct hal_tree {
    hal_off root;            /* index; 0 for comps and threads */
    hal_off first;           /* index: in order */
    uint32_t changes;        /* +1 when something comes or goes */
};

#define HAL_LOCKS 8
#define HAL_ID_BUCKETS 1024
#define HAL_BLOCK_CLASSES 28 /* blocks of 2^class bytes */

struct hal_process {
    int32_t pid;             /* 0: none */
    uint32_t unused;
    uint64_t start, ns;
};

struct hal_segment {
    int32_t version;         /* HAL_VER once the segment is usable */
    uint32_t magic;
    uint64_t size;

    /* The lock. Normally locks[lock_index % HAL_LOCKS]; a forced release goes on
     * to the next one. */
    _Atomic uint32_t lock_index;
    _Atomic int32_t lock_pid; /* who holds it */
    _Atomic uint32_t dirty;   /* the holder is changing something */
    uint32_t repairs;         /* how often a change was repaired */
    pthread_mutex_t locks[HAL_LOCKS];

    /* Memory: [bottom, top) is free. */
    hal_off bottom, top;
    struct {
        hal_off first, last;
        uint32_t count;
    } blocks[HAL_BLOCK_CLASSES]; /* free ones, oldest first */

    struct hal_pool pools[HAL_KIND_COUNT];
    struct hal_tree trees[HAL_KIND_COUNT];
    hal_off buckets;         /* index: array of hal_off */
    uint32_t nbuckets;       /* a power of two */
    uint32_t nhashed;
    hal_off ids[HAL_ID_BUCKETS]; /* index: components by id */
    uint32_t serial;

    uint32_t lock_bits;      /* HAL_LOCK_... */
    uint32_t exact_base_period;
    int64_t base_period;     /* ns, of the first thread */
    _Atomic int32_t threads_running;
    int32_t realtime_type;
    struct hal_process host; /* the realtime host */
    hal_data_u scratch __attribute__((aligned(8))); /* where pointers of removed pins lead */
};

/* Ports: a block, its place in HAL memory is the value of the signal. */
struct hal_port_shm {
    uint32_t size;           /* capacity + 1 */
    uint32_t room;           /* bytes of data[] */
    _Atomic uint32_t read __attribute__((aligned(64)));  /* written by the reader */
    _Atomic uint32_t write __attribute__((aligned(64))); /* written by the writer */
    uint8_t data[] __attribute__((aligned(64)));
};

/* ---- Inside of the library -------------------------------------------------- */

extern char *hal_shmem_base;

#pragma GCC visibility push(hidden)

extern struct hal_segment *hal_data; /* NULL: not mapped */

static inline void *halp_ptr(hal_off off)
{
    return off ? hal_shmem_base + off : NULL;
}
static inline hal_off halp_off(const void *ptr)
{
    return ptr ? (hal_off)((const char *)ptr - hal_shmem_base) : 0;
}
/* Is [ptr, ptr + size) inside of the segment? */
static inline bool halp_inside(const void *ptr, size_t size)
{
    uintptr_t at = (uintptr_t)ptr - (uintptr_t)hal_shmem_base;
    return hal_data && at < HAL_SIZE && size <= HAL_SIZE - at;
}
/* Stores that other processes or a recovery see in this order. */
#define HALP_COMMIT(lvalue, value)                              \
    do {                                                        \
        atomic_thread_fence(memory_order_release);              \
        __atomic_store_n(&(lvalue), (value), __ATOMIC_RELEASE); \
        atomic_signal_fence(memory_order_seq_cst);              \
    } while (0)

#define halp_err(...) rtapi_print_msg(RTAPI_MSG_ERR, __VA_ARGS__)
#define halp_dbg(...) rtapi_print_msg(RTAPI_MSG_DBG, __VA_ARGS__)

/* hal_segment.c: mapping, memory, lock. halp_map: 0, or -EINVAL after a message. */
int halp_map(int module_id);
void halp_unmap(int module_id);
/* The database lock; recursive in a thread. halp_lock repairs what a dead holder
 * left. halp_change says that the holder is about to change something. */
void halp_lock(void);
void halp_unlock(void);
void halp_change(void);
int halp_force_release(void);
/* Realtime memory (from below) and object memory (from above): zero, or 0 = none. */
hal_off halp_alloc_low(size_t size);
hal_off halp_alloc_high(size_t size);
/* Blocks that are given back: at least size bytes, contents undefined. */
hal_off halp_block_new(size_t size);
void halp_block_free(hal_off off, size_t size);
/* Who a process is, and whether it is gone (certain) or not. */
void halp_process_self(struct hal_process *p);
bool halp_process_gone(const struct hal_process *p);

/* hal_index.c: objects by kind. */
void halp_index_init(void);
/* A new object in state NEW, everything but kind and serial zero; NULL: no memory. */
void *halp_obj_new(enum hal_kind kind);
/* Makes it part of the index and LIVE. Its name is set. false: no memory. */
bool halp_obj_insert(struct hal_obj *obj);
/* Takes it out of the index; its state stays. */
void halp_obj_remove(struct hal_obj *obj);
/* Gives it back: FREE. */
void halp_obj_free(struct hal_obj *obj);
struct hal_obj *halp_find(enum hal_kind kind, const char *name); /* aliases included */
struct hal_comp *halp_find_comp_id(int comp_id);
/* The first object in order, and the one after it. */
void *halp_first(enum hal_kind kind);
void *halp_next(const void *obj);
/* The first one whose name is greater. */
struct hal_obj *halp_find_above(enum hal_kind kind, const char *name);
/* Calls fn for every place of the pool that was ever used. */
void halp_each_slot(enum hal_kind kind, void (*fn)(struct hal_obj *obj, void *arg), void *arg);
/* Empties index and free lists; halp_reindex puts a LIVE object back in. */
void halp_index_clear(void);
void halp_reindex(struct hal_obj *obj);
void halp_slot_free(struct hal_obj *obj);

static inline struct hal_pin *halp_find_pin(const char *name)
{
    return (struct hal_pin *)halp_find(HAL_KIND_PIN, name);
}
static inline struct hal_param *halp_find_param(const char *name)
{
    return (struct hal_param *)halp_find(HAL_KIND_PARAM, name);
}
static inline struct hal_sig *halp_find_sig(const char *name)
{
    return (struct hal_sig *)halp_find(HAL_KIND_SIG, name);
}

/* hal_recover.c */
void halp_recover(int dead_pid);
/* Removes components of processes that are gone, and says so. only: one of them,
 * or NULL for all and the host. */
void halp_reap(struct hal_comp *only);

/* hal_comp.c: removes everything of a component and itself. */
void halp_comp_remove(struct hal_comp *comp);
struct hal_comp *halp_comp_new(const char *name, int comp_id, hal_comp_type_t type);
extern int halp_lib_module_id;

/* hal_pin.c */
void *halp_pin_cell(const struct hal_pin *pin);   /* the value: own or the signal's */
void halp_pin_point(struct hal_pin *pin);         /* makes the owner's variable point there */
void halp_pin_remove(struct hal_pin *pin);
void halp_param_remove(struct hal_param *param);
void halp_copy_value(hal_data_u *to, const hal_data_u *from, int type);
int halp_pin_create(struct hal_comp *comp, const char *name, hal_type_t type, hal_pdir_t dir, void **var,
                    hal_data_u def);
int halp_param_create(struct hal_comp *comp, const char *name, hal_type_t type, hal_pdir_t dir, void *data,
                      hal_data_u def, void **ref);

/* hal_signal.c */
void halp_pin_unlink(struct hal_pin *pin);
void halp_member_add(struct hal_sig *sig, struct hal_pin *pin); /* list and counts */
int halp_port_alloc(struct hal_sig *sig, unsigned size);

/* hal_thread.c */
void halp_funct_remove(struct hal_funct *f);
void halp_thread_remove(struct hal_thread *t);  /* from the database; its task is gone */
void halp_drain_inits(void);
/* Waits until no thread is in a cycle that began before: whoever took functions out of it may
 * have died without waiting, and code must stay while it runs. In the host, lock held. [init] */
void halp_cycles_over(void);
void halp_thread_filter(struct hal_thread *t); /* drops functions that are not live, counts users */
void halp_threads_end(void);                   /* the host ends: tasks and threads */

#pragma GCC visibility pop
#endif
