/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal.h - the signal layer: components offer pins and parameters, signals
 * connect pins, threads run functions.
 *
 * Define RTAPI (module in the realtime host) or ULAPI (ordinary process) before
 * including; not both. Every function returns 0 (or a positive value) on success
 * and a negative errno on failure unless said otherwise; a refusal is explained
 * by a message of level RTAPI_MSG_ERR.
 *
 * Contexts: [init] rtapi_app_main/rtapi_app_exit or an ordinary process: takes
 * the database lock, may wait for it; [rt] cyclic code: no lock, bounded;
 * [user] ordinary processes only; [any] all of them.
 *
 * Two generations of the interface live side by side:
 *   legacy   hal_pin_float_newf(...) with hal_float_t *: volatile C variables
 *   typed    hal_pin_new_real(...) with hal_real_t and hal_get/set_real(...):
 *            atomic access to 8-byte cells, pins with a default value
 */
#ifndef HAL_H
#define HAL_H

#if !defined(RTAPI) && !defined(ULAPI)
#error "hal.h: define RTAPI (realtime module) or ULAPI (ordinary process)"
#endif
#if defined(RTAPI) && defined(ULAPI)
#error "hal.h: RTAPI and ULAPI exclude each other"
#endif

#ifdef ULAPI
#include <signal.h> /* not for modules: it declares read() and write(), common names of functions */
#endif
#include <stdarg.h>
#include "rtapi.h"

#if __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "hal.h: values of 32 bits share the low end of 64-bit cells: little-endian machines only"
#endif

#ifdef __cplusplus
#define HAL_STATIC_ASSERT(expr, msg) static_assert(expr, msg)
#else
#define HAL_STATIC_ASSERT(expr, msg) _Static_assert(expr, msg)
#endif

RTAPI_BEGIN_DECLS

/* ---- Constants and types ------------------------------------------------ */

/* Longest name of a component, pin, parameter, signal, function, thread or
 * alias, without the NUL. */
#define HAL_NAME_LEN 55
/* Names of the components that stand for threads begin so. */
#define HAL_PSEUDO_COMP_PREFIX "__"

/* Locks: what hal_set_lock forbids. */
#define HAL_LOCK_NONE 0
#define HAL_LOCK_LOAD 1   /* new pins, parameters and functions */
#define HAL_LOCK_CONFIG 2 /* signals, links, aliases, threads, addf */
#define HAL_LOCK_PARAMS 4 /* hal_param_set */
#define HAL_LOCK_RUN 8    /* starting and stopping threads */
#define HAL_LOCK_TUNE (HAL_LOCK_LOAD | HAL_LOCK_CONFIG)
#define HAL_LOCK_ALL 255

typedef enum {
    HAL_TYPE_UNSPECIFIED = -1,
    HAL_TYPE_UNINITIALIZED = 0,
    HAL_BIT = 1,
    HAL_FLOAT = 2,
    HAL_S32 = 3,
    HAL_U32 = 4,
    HAL_PORT = 5,
    HAL_S64 = 6,
    HAL_U64 = 7,
    HAL_TYPE_MAX,
    HAL_BOOL = HAL_BIT,
    HAL_REAL = HAL_FLOAT,
    HAL_SINT = HAL_S64,
    HAL_UINT = HAL_U64
} hal_type_t;

typedef enum {
    HAL_DIR_UNSPECIFIED = -1,
    HAL_IN = 16,
    HAL_OUT = 32,
    HAL_IO = HAL_IN | HAL_OUT,
    HAL_RO = 64,
    HAL_WO = 128, /* never accepted alone */
    HAL_RW = HAL_RO | HAL_WO
} hal_pdir_t;
typedef hal_pdir_t hal_pin_dir_t;
typedef hal_pdir_t hal_param_dir_t;

static inline bool hal_pdir_is_pin(hal_pdir_t dir)
{
    return ((int)dir & HAL_IO) != 0 && ((int)dir & ~HAL_IO) == 0;
}
static inline bool hal_pdir_is_param(hal_pdir_t dir)
{
    return ((int)dir & HAL_RW) != 0 && ((int)dir & ~HAL_RW) == 0;
}
static inline bool hal_pdir_is_neither(hal_pdir_t dir)
{
    return !hal_pdir_is_pin(dir) && !hal_pdir_is_param(dir);
}

typedef enum {
    HAL_COMP_TYPE_UNKNOWN = -1,
    HAL_COMP_TYPE_USER = 0,
    HAL_COMP_TYPE_REALTIME = 1,
    HAL_COMP_TYPE_OTHER = 2
} hal_comp_type_t;
#define COMPONENT_TYPE_UNKNOWN HAL_COMP_TYPE_UNKNOWN
#define COMPONENT_TYPE_USER HAL_COMP_TYPE_USER
#define COMPONENT_TYPE_REALTIME HAL_COMP_TYPE_REALTIME
#define COMPONENT_TYPE_OTHER HAL_COMP_TYPE_OTHER

typedef rtapi_realtime_type_t hal_realtime_type_t;

/* Legacy value types. They live in HAL shared memory. */
typedef volatile bool hal_bit_t;
typedef volatile rtapi_u32 hal_u32_t;
typedef volatile rtapi_s32 hal_s32_t;
typedef volatile rtapi_u64 hal_u64_t;
typedef volatile rtapi_s64 hal_s64_t;
typedef volatile int hal_port_t; /* where the buffer is in HAL memory; 0: none */
typedef double real_t __attribute__((aligned(8)));
typedef rtapi_u64 ireal_t __attribute__((aligned(8))); /* an integer as wide as real_t */
typedef volatile real_t hal_float_t;

/* Any value: the 8 bytes of a pin, signal or parameter. */
typedef union {
    hal_bit_t b;
    hal_s32_t s;
    hal_u32_t u;
    hal_float_t f;
    hal_port_t p;
    hal_s64_t ls;
    hal_u64_t lu;
} hal_data_u;

/* References of the typed interface: each is where an 8-byte cell is. The
 * variable itself lies in memory from hal_malloc, because linking rewrites it. */
typedef struct hal_bool_cell *hal_bool_t;
typedef struct hal_sint_cell *hal_sint_t;
typedef struct hal_uint_cell *hal_uint_t;
typedef struct hal_real_cell *hal_real_t;
typedef union {
    hal_bool_t b;
    hal_sint_t s;
    hal_uint_t u;
    hal_real_t r;
} hal_refs_u;

/* ---- Values of the typed interface [rt] ---------------------------------- *
 * One relaxed atomic access each; setters return what was stored. */

#define HAL_INLINE_ static inline __attribute__((always_inline))
typedef rtapi_u64 __attribute__((may_alias)) hal_cell_u64_;
typedef rtapi_s64 __attribute__((may_alias)) hal_cell_s64_;
typedef rtapi_u32 __attribute__((may_alias)) hal_cell_u32_;
typedef rtapi_s32 __attribute__((may_alias)) hal_cell_s32_;
typedef rtapi_u8 __attribute__((may_alias)) hal_cell_u8_;

HAL_INLINE_ rtapi_bool hal_get_bool(const hal_bool_t ref)
{
    return __atomic_load_n((const hal_cell_u8_ *)ref, __ATOMIC_RELAXED) != 0;
}
HAL_INLINE_ rtapi_bool hal_set_bool(hal_bool_t ref, rtapi_bool value)
{
    __atomic_store_n((hal_cell_u64_ *)ref, (rtapi_u64)(value ? 1 : 0), __ATOMIC_RELAXED);
    return value;
}

HAL_INLINE_ rtapi_sint hal_get_sint(const hal_sint_t ref)
{
    return __atomic_load_n((const hal_cell_s64_ *)ref, __ATOMIC_RELAXED);
}
HAL_INLINE_ rtapi_sint hal_set_sint(hal_sint_t ref, rtapi_sint value)
{
    __atomic_store_n((hal_cell_s64_ *)ref, value, __ATOMIC_RELAXED);
    return value;
}
/* The low 32 bits. */
HAL_INLINE_ rtapi_s32 hal_get_si32(const hal_sint_t ref)
{
    return __atomic_load_n((const hal_cell_s32_ *)ref, __ATOMIC_RELAXED);
}
/* The 64-bit value, limited to what 32 bits hold. */
HAL_INLINE_ rtapi_s32 hal_get_si32_clamped(const hal_sint_t ref)
{
    rtapi_sint value = hal_get_sint(ref);
    return value > RTAPI_INT32_MAX ? RTAPI_INT32_MAX : value < RTAPI_INT32_MIN ? RTAPI_INT32_MIN : (rtapi_s32)value;
}
HAL_INLINE_ rtapi_s32 hal_set_si32(hal_sint_t ref, rtapi_s32 value)
{
    return (rtapi_s32)hal_set_sint(ref, value);
}

HAL_INLINE_ rtapi_uint hal_get_uint(const hal_uint_t ref)
{
    return __atomic_load_n((const hal_cell_u64_ *)ref, __ATOMIC_RELAXED);
}
HAL_INLINE_ rtapi_uint hal_set_uint(hal_uint_t ref, rtapi_uint value)
{
    __atomic_store_n((hal_cell_u64_ *)ref, value, __ATOMIC_RELAXED);
    return value;
}
HAL_INLINE_ rtapi_u32 hal_get_ui32(const hal_uint_t ref)
{
    return __atomic_load_n((const hal_cell_u32_ *)ref, __ATOMIC_RELAXED);
}
HAL_INLINE_ rtapi_u32 hal_get_ui32_clamped(const hal_uint_t ref)
{
    rtapi_uint value = hal_get_uint(ref);
    return value > RTAPI_UINT32_MAX ? RTAPI_UINT32_MAX : (rtapi_u32)value;
}
HAL_INLINE_ rtapi_u32 hal_set_ui32(hal_uint_t ref, rtapi_u32 value)
{
    return (rtapi_u32)hal_set_uint(ref, value);
}

HAL_INLINE_ rtapi_real hal_get_real(const hal_real_t ref)
{
    union {
        rtapi_u64 bits;
        rtapi_real value;
    } cell;
    cell.bits = __atomic_load_n((const hal_cell_u64_ *)ref, __ATOMIC_RELAXED);
    return cell.value;
}
HAL_INLINE_ rtapi_real hal_set_real(hal_real_t ref, rtapi_real value)
{
    union {
        rtapi_real value;
        rtapi_u64 bits;
    } cell;
    cell.value = value;
    __atomic_store_n((hal_cell_u64_ *)ref, cell.bits, __ATOMIC_RELAXED);
    return value;
}

/* [any] A counter of nbits (1..64) bits, made 64 bits wide: returns old plus the
 * signed difference of newlow and old in nbits. Right as long as it moves by less
 * than 2^(nbits-1) between calls. */
static inline rtapi_s64 hal_extend_counter(rtapi_s64 old, rtapi_s64 newlow, int nbits)
{
    int shift = 64 - nbits;
    rtapi_s64 diff = (rtapi_s64)(((rtapi_u64)newlow << shift) - ((rtapi_u64)old << shift));
    return (rtapi_s64)((rtapi_u64)old + (rtapi_u64)(diff >> shift));
}

/* ---- Components [init] --------------------------------------------------- */

/* [any] 1 when this process has HAL memory mapped, else 0. */
int hal_is_init(void);

/* Registers a component and returns its id (> 0). -EINVAL: no or too long a
 * name, no shared memory; -EEXIST: the name is taken; -ENOMEM. Components begin
 * not ready: pins, parameters and functions are made before hal_ready. */
int hal_init(const char *name);
/* Removes a component with its functions, pins and parameters; signals stay.
 * -EFAULT: HAL is not mapped; -ENOENT: no such id. */
int hal_exit(int comp_id);
/* Says that the component has made all its pins. -EINVAL: unknown, or ready. */
int hal_ready(int comp_id);
/* Allows new pins again, ready or not. -EINVAL: unknown id. */
int hal_set_unready(int comp_id);
/* The component's name (owned by HAL), or NULL. */
char *hal_comp_name(int comp_id);
/* [any] What the realtime host found at its start; REALTIME_TYPE_UNINITIALIZED
 * while none runs; -EFAULT when HAL is not mapped. */
hal_realtime_type_t hal_get_realtime_type(void);
/* [any] A few words for a negative errno of this library. */
const char *hal_strerror(int err);

/* Memory for pins and what realtime code shares, zeroed, never given back.
 * Aligned to 16 bytes from 16 bytes on, else to 8. NULL: size <= 0, none left,
 * or HAL not mapped. */
void *hal_malloc(long int size);

/* [any] A place in HAL memory as a number that is the same in every process, and
 * back. 0 and NULL: outside of HAL memory, or HAL is not mapped. */
rtapi_intptr_t hal_reference_unmap(const void *ptr);
void *hal_reference_map(rtapi_intptr_t ref);

#ifdef ULAPI
/* [user] Maps HAL without a component; counts. 0, or -EINVAL. */
int hal_lib_init(void);
/* [user] Undoes one hal_lib_init. */
void hal_lib_exit(void);
/* [user] Makes a ready component not ready. -EINVAL: unknown, or not ready. */
int hal_unready(int comp_id);
/* [user] Frees the database lock from a process that hangs while holding it. (A
 * dead one does not hold it.) 0 or -errno. */
int hal_mutex_force_release(void);
/* [user] The first thread's period is taken as the clock's true period. Before
 * any thread. -EACCES: set already; -EFAULT. */
int hal_enforce_exact_base_period(void);
/* [user] Notes how a realtime component was loaded; args lies in HAL memory.
 * -EFAULT, -EINVAL (NULL, or not in HAL memory), -ENOENT. */
int hal_comp_insmod_args(const char *comp_name, const char *args);
#endif

/* A component's constructor: makes one more instance named prefix. */
typedef int (*constructor)(const char *prefix, const char *arg);
#ifdef RTAPI
/* [init] -EINVAL: unknown component. */
int hal_set_constructor(int comp_id, constructor make);
#endif
/* [init] In the realtime host only. -EFAULT, -EINVAL (NULL), -ENOENT, -ENOEXEC
 * (no constructor), else what the constructor returns. */
int hal_comp_invoke_make(const char *comp_name, const char *newname, const char *arg);

/* ---- Pins [init] ---------------------------------------------------------- *
 * data_ptr_addr and ref: a variable in HAL memory (hal_malloc) that will point to
 * the value: the pin's own cell, or while linked the signal's. Legacy pins begin
 * with 0, typed ones with def. Directions HAL_IN, HAL_OUT, HAL_IO (ports: no IO).
 * Errors: -EFAULT (not mapped), -EINVAL (type, direction, name longer than 55,
 * unknown or ready component, name taken, variable outside HAL memory), -EPERM
 * (locked), -ENOMEM (memory; formatted name too long). */
#define HAL_PRINTF_(fmt, args) __attribute__((format(printf, fmt, args)))

int hal_pin_bit_new(const char *name, hal_pin_dir_t dir, hal_bit_t **data_ptr_addr, int comp_id);
int hal_pin_float_new(const char *name, hal_pin_dir_t dir, hal_float_t **data_ptr_addr, int comp_id);
int hal_pin_u32_new(const char *name, hal_pin_dir_t dir, hal_u32_t **data_ptr_addr, int comp_id);
int hal_pin_s32_new(const char *name, hal_pin_dir_t dir, hal_s32_t **data_ptr_addr, int comp_id);
int hal_pin_u64_new(const char *name, hal_pin_dir_t dir, hal_u64_t **data_ptr_addr, int comp_id);
int hal_pin_s64_new(const char *name, hal_pin_dir_t dir, hal_s64_t **data_ptr_addr, int comp_id);
int hal_pin_port_new(const char *name, hal_pin_dir_t dir, hal_port_t **data_ptr_addr, int comp_id);

int hal_pin_bit_newf(hal_pin_dir_t dir, hal_bit_t **data_ptr_addr, int comp_id, const char *fmt, ...) HAL_PRINTF_(4, 5);
int hal_pin_float_newf(hal_pin_dir_t dir, hal_float_t **data_ptr_addr, int comp_id, const char *fmt, ...)
    HAL_PRINTF_(4, 5);
int hal_pin_u32_newf(hal_pin_dir_t dir, hal_u32_t **data_ptr_addr, int comp_id, const char *fmt, ...) HAL_PRINTF_(4, 5);
int hal_pin_s32_newf(hal_pin_dir_t dir, hal_s32_t **data_ptr_addr, int comp_id, const char *fmt, ...) HAL_PRINTF_(4, 5);
int hal_pin_u64_newf(hal_pin_dir_t dir, hal_u64_t **data_ptr_addr, int comp_id, const char *fmt, ...) HAL_PRINTF_(4, 5);
int hal_pin_s64_newf(hal_pin_dir_t dir, hal_s64_t **data_ptr_addr, int comp_id, const char *fmt, ...) HAL_PRINTF_(4, 5);
int hal_pin_port_newf(hal_pin_dir_t dir, hal_port_t **data_ptr_addr, int comp_id, const char *fmt, ...)
    HAL_PRINTF_(4, 5);

int hal_pin_new(const char *name, hal_type_t type, hal_pin_dir_t dir, void **data_ptr_addr, int comp_id);

int hal_pin_new_bool(int comp_id, hal_pdir_t dir, hal_bool_t *ref, rtapi_bool def, const char *fmt, ...)
    HAL_PRINTF_(5, 6);
int hal_pin_new_si32(int comp_id, hal_pdir_t dir, hal_sint_t *ref, rtapi_s32 def, const char *fmt, ...)
    HAL_PRINTF_(5, 6);
int hal_pin_new_ui32(int comp_id, hal_pdir_t dir, hal_uint_t *ref, rtapi_u32 def, const char *fmt, ...)
    HAL_PRINTF_(5, 6);
int hal_pin_new_sint(int comp_id, hal_pdir_t dir, hal_sint_t *ref, rtapi_sint def, const char *fmt, ...)
    HAL_PRINTF_(5, 6);
int hal_pin_new_uint(int comp_id, hal_pdir_t dir, hal_uint_t *ref, rtapi_uint def, const char *fmt, ...)
    HAL_PRINTF_(5, 6);
int hal_pin_new_real(int comp_id, hal_pdir_t dir, hal_real_t *ref, rtapi_real def, const char *fmt, ...)
    HAL_PRINTF_(5, 6);
int hal_pin_new_port(int comp_id, hal_pdir_t dir, hal_sint_t *ref, const char *fmt, ...) HAL_PRINTF_(4, 5);

/* Gives a pin another current name; the original one keeps working. NULL: back
 * to the original. -EPERM: locked; -EINVAL: too long, taken, or no such pin. */
int hal_pin_alias(const char *pin_name, const char *alias);

/* ---- Signals [init] ------------------------------------------------------- */

/* -EFAULT, -EINVAL (name too long or taken, bad type), -EPERM, -ENOMEM. */
int hal_signal_new(const char *name, hal_type_t type);
/* Unlinks all pins (they keep the value) and removes it. -EPERM, -EINVAL. */
int hal_signal_delete(const char *name);
/* At most one OUT pin and then no IO, or any number of IO; any number of IN; a
 * port has one OUT and one IN. The signal takes the pin's value when it had no
 * pin that drives it (for an IN pin: no pin at all). Linking to the same signal
 * again is fine. -EFAULT, -EPERM, -EINVAL. */
int hal_link(const char *pin_name, const char *sig_name);
/* The pin keeps the signal's value; a port loses its buffer. -EPERM, -EINVAL. */
int hal_unlink(const char *pin_name);

/* ---- Parameters [init] ---------------------------------------------------- *
 * Legacy: data_addr is the caller's variable in HAL memory, not changed here.
 * Typed: the cell is HAL's, set to def, *ref points to it. Directions HAL_RO and
 * HAL_RW; no ports. Errors as for pins. */
int hal_param_bit_new(const char *name, hal_param_dir_t dir, hal_bit_t *data_addr, int comp_id);
int hal_param_float_new(const char *name, hal_param_dir_t dir, hal_float_t *data_addr, int comp_id);
int hal_param_u32_new(const char *name, hal_param_dir_t dir, hal_u32_t *data_addr, int comp_id);
int hal_param_s32_new(const char *name, hal_param_dir_t dir, hal_s32_t *data_addr, int comp_id);
int hal_param_u64_new(const char *name, hal_param_dir_t dir, hal_u64_t *data_addr, int comp_id);
int hal_param_s64_new(const char *name, hal_param_dir_t dir, hal_s64_t *data_addr, int comp_id);

int hal_param_bit_newf(hal_param_dir_t dir, hal_bit_t *data_addr, int comp_id, const char *fmt, ...) HAL_PRINTF_(4, 5);
int hal_param_float_newf(hal_param_dir_t dir, hal_float_t *data_addr, int comp_id, const char *fmt, ...)
    HAL_PRINTF_(4, 5);
int hal_param_u32_newf(hal_param_dir_t dir, hal_u32_t *data_addr, int comp_id, const char *fmt, ...) HAL_PRINTF_(4, 5);
int hal_param_s32_newf(hal_param_dir_t dir, hal_s32_t *data_addr, int comp_id, const char *fmt, ...) HAL_PRINTF_(4, 5);
int hal_param_u64_newf(hal_param_dir_t dir, hal_u64_t *data_addr, int comp_id, const char *fmt, ...) HAL_PRINTF_(4, 5);
int hal_param_s64_newf(hal_param_dir_t dir, hal_s64_t *data_addr, int comp_id, const char *fmt, ...) HAL_PRINTF_(4, 5);

int hal_param_new(const char *name, hal_type_t type, hal_param_dir_t dir, void *data_addr, int comp_id);

int hal_param_new_bool(int comp_id, hal_pdir_t dir, hal_bool_t *ref, rtapi_bool def, const char *fmt, ...)
    HAL_PRINTF_(5, 6);
int hal_param_new_si32(int comp_id, hal_pdir_t dir, hal_sint_t *ref, rtapi_s32 def, const char *fmt, ...)
    HAL_PRINTF_(5, 6);
int hal_param_new_ui32(int comp_id, hal_pdir_t dir, hal_uint_t *ref, rtapi_u32 def, const char *fmt, ...)
    HAL_PRINTF_(5, 6);
int hal_param_new_sint(int comp_id, hal_pdir_t dir, hal_sint_t *ref, rtapi_sint def, const char *fmt, ...)
    HAL_PRINTF_(5, 6);
int hal_param_new_uint(int comp_id, hal_pdir_t dir, hal_uint_t *ref, rtapi_uint def, const char *fmt, ...)
    HAL_PRINTF_(5, 6);
int hal_param_new_real(int comp_id, hal_pdir_t dir, hal_real_t *ref, rtapi_real def, const char *fmt, ...)
    HAL_PRINTF_(5, 6);
/* A cell of its own, zero, without a name. -EINVAL: ref is NULL; -ENOMEM. */
int hal_param_new_fake(int comp_id, hal_refs_u *ref);

/* -EPERM: locked; -EINVAL: no such parameter, other type, read-only. */
int hal_param_bit_set(const char *name, int value);
int hal_param_float_set(const char *name, double value);
int hal_param_u32_set(const char *name, unsigned long value);
int hal_param_s32_set(const char *name, signed long value);
int hal_param_u64_set(const char *name, unsigned long value);
int hal_param_s64_set(const char *name, signed long value);
/* value_addr: int for bit, double, long (s32, s64), unsigned long (u32, u64). */
int hal_param_set(const char *name, hal_type_t type, void *value_addr);
int hal_param_alias(const char *param_name, const char *alias);

/* ---- Functions and threads [init] ----------------------------------------- */

#ifdef RTAPI
/* Offers funct(arg, period in ns) to threads. Also makes <name>.time (s32 pin,
 * ns), <name>.tmax (s32 parameter, ns) and <name>.tmax-increased (bit parameter),
 * so a name has at most 40 characters. uses_fp is ignored. A function that is not
 * reentrant runs in one thread only. -EFAULT, -EINVAL, -EPERM, -ENOMEM. */
int hal_export_funct(const char *name, void (*funct)(void *, long), void *arg, int uses_fp, int reentrant, int comp_id);
int hal_export_functf(void (*funct)(void *, long), void *arg, int uses_fp, int reentrant, int comp_id, const char *fmt,
                      ...) HAL_PRINTF_(6, 7);
/* Makes a thread, fastest first. period_nsec is rounded to a multiple of the
 * first one's. Also makes component __<name>, <name>.time (s32 pin, ns),
 * <name>.tmax (s32 parameter, ns), <name>.threadbeat (s64 pin, cycles). Returns
 * that component's id. -EFAULT, -EINVAL, -EPERM, -EEXIST, -ENOMEM. */
int hal_create_thread(const char *name, unsigned long period_nsec, int uses_fp);
int hal_thread_delete(const char *name);
#endif

/* position n > 0: becomes the n-th; n < 0: the n-th from the end; 0 is refused.
 * -EPERM, -EINVAL. */
int hal_add_funct_to_thread(const char *funct_name, const char *thread_name, int position);
/* Functions that run once, in a cycle of their own before the first ordinary
 * one. -ENOENT: unknown; -EALREADY: that cycle is over; -EPERM, -EINVAL. */
int hal_init_funct_to_thread(const char *funct_name, const char *thread_name, int position);
int hal_del_funct_from_thread(const char *funct_name, const char *thread_name);
/* All threads at once. A cycle that runs is finished. -EPERM, -EFAULT. */
int hal_start_threads(void);
int hal_stop_threads(void);

/* ---- Locks [user] ---------------------------------------------------------- */

#ifdef ULAPI
int hal_set_lock(unsigned char lock_type);
unsigned char hal_get_lock(void);
#endif

/* ---- Ports [rt] ------------------------------------------------------------ *
 * A byte queue for one writer and one reader, without locks; a buffer of size n
 * holds n-1 bytes. All or nothing; count 0 is false. A port without a buffer:
 * false or 0, and a message each time. Reader: read, peek, peek_commit, readable,
 * clear. Writer: write, writable. */
#define HAL_PORT_SIZE_MAX 65536
bool hal_port_read(const hal_port_t *port, char *dest, unsigned count);
bool hal_port_peek(const hal_port_t *port, char *dest, unsigned count);
bool hal_port_peek_commit(const hal_port_t *port, unsigned count);
bool hal_port_write(const hal_port_t *port, const char *src, unsigned count);
unsigned hal_port_readable(const hal_port_t *port);
unsigned hal_port_writable(const hal_port_t *port);
unsigned hal_port_buffer_size(const hal_port_t *port);
void hal_port_clear(const hal_port_t *port);
#ifdef ULAPI
/* [user] Wait until count bytes (or their room) are there or *stop (may be NULL)
 * is nonzero; looks every 10 ms. */
void hal_port_wait_readable(hal_port_t **port, unsigned count, sig_atomic_t *stop);
void hal_port_wait_writable(hal_port_t **port, unsigned count, sig_atomic_t *stop);
#endif

/* ---- Streams --------------------------------------------------------------- *
 * Records of up to 21 values from one writer to one reader in shared memory of
 * their own, selected by key. depth d holds d-1 records. */
#define HAL_STREAM_MAX_PINS 21

struct hal_stream_shm;
typedef struct hal_stream {
    int comp_id;
    int shmem_id;
    struct hal_stream_shm *fifo;
} hal_stream_t;
typedef hal_stream_t *hal_stream_ptr_t;

typedef union hal_stream_data {
    real_t f;
    bool b;
    rtapi_s32 s;
    rtapi_u32 u;
    rtapi_s64 l;
    rtapi_u64 k;
} hal_stream_data_u;
typedef hal_stream_data_u *hal_stream_data_ptr_u;

/* [init] types: a letter per value: f or r float, b bit, s s32, u u32, l s64,
 * k u64. Create resets an existing stream. -EINVAL, -ENOMEM. */
int hal_stream_create(hal_stream_t *stream, int comp_id, int key, unsigned depth, const char *types);
void hal_stream_destroy(hal_stream_t *stream);
/* [init] types NULL: any. -EINVAL: no stream there, or other types. */
int hal_stream_attach(hal_stream_t *stream, int comp_id, int key, const char *types);
int hal_stream_detach(hal_stream_t *stream);

/* [rt] */
int hal_stream_element_count(hal_stream_t *stream);
hal_type_t hal_stream_element_type(hal_stream_t *stream, int idx);
/* -ENOSPC: empty (counts an underrun). sampleno (NULL is fine): from 1 on. */
int hal_stream_read(hal_stream_t *stream, hal_stream_data_u *buf, unsigned *sampleno);
/* -ENOSPC: full (counts an overrun). */
int hal_stream_write(hal_stream_t *stream, hal_stream_data_u *buf);
bool hal_stream_readable(hal_stream_t *stream);
bool hal_stream_writable(hal_stream_t *stream);
int hal_stream_depth(hal_stream_t *stream);
unsigned hal_stream_maxdepth(hal_stream_t *stream);
int hal_stream_num_underruns(hal_stream_t *stream);
int hal_stream_num_overruns(hal_stream_t *stream);
#ifdef ULAPI
void hal_stream_wait_readable(hal_stream_t *stream, sig_atomic_t *stop);
void hal_stream_wait_writable(hal_stream_t *stream, sig_atomic_t *stop);
#endif

/* ---- Looking things up [user] ---------------------------------------------- */

#ifdef ULAPI
/* Legacy: 0 or -1. *data points to the live value. connected, has_writers: may be
 * NULL. */
int hal_get_pin_value_by_name(const char *name, hal_type_t *type, hal_data_u **data, bool *connected);
int hal_get_signal_value_by_name(const char *name, hal_type_t *type, hal_data_u **data, bool *has_writers);
int hal_get_param_value_by_name(const char *name, hal_type_t *type, hal_data_u **data);

typedef enum {
    HAL_QTYPE_ANY = 0,
    HAL_QTYPE_PIN,
    HAL_QTYPE_PARAM,
    HAL_QTYPE_SIGNAL,
    HAL_QTYPE_COMP,
    HAL_QTYPE_FUNCT,
    HAL_QTYPE_THREAD,
    HAL_QTYPE_THREAD_FUNCT
} hal_qtype_t;

typedef union {
    rtapi_bool b;
    rtapi_sint s;
    rtapi_uint u;
    rtapi_real r;
} hal_query_value_u;

typedef struct {
    hal_type_t type;
    hal_refs_u ref;
    hal_query_value_u value;
    hal_pdir_t dir;
    const char *alias;  /* the original name, while there is an alias; else NULL */
    const char *signal; /* NULL: not linked */
    const char *comp;
    int comp_id;
} hal_query_pp_t;

typedef struct {
    hal_type_t type;
    hal_refs_u ref;
    hal_query_value_u value;
    int writers;
    int readers;
    int bidirs;
} hal_query_sig_t;

typedef struct {
    int comp_id;
    hal_comp_type_t type;
    int pid;
    bool ready;
    const char *insmod; /* NULL: none */
} hal_query_comp_t;

typedef struct {
    int comp_id;
    const char *comp;
    int users;
    rtapi_intptr_t funct;
    rtapi_intptr_t arg;
    bool reentrant;
} hal_query_funct_t;

typedef struct {
    int comp_id;
    const char *comp;
    int priority;
    long period; /* ns */
    int functidx;
    const char *funct;
    bool is_init;
} hal_query_thread_t;

/* Zero it before use. Names it returns are the live ones. */
typedef struct hal_query {
    const char *name;
    hal_qtype_t qtype;
    union {
        void *vpval;
        const void *cpval;
        rtapi_intptr_t ipval;
        rtapi_uintptr_t upval;
        rtapi_sint sival;
        rtapi_uint uival;
    } callerdata;
    union {
        hal_query_pp_t pp;
        hal_query_sig_t sig;
        hal_query_comp_t comp;
        hal_query_funct_t funct;
        hal_query_thread_t thread;
    };
} hal_query_t;

/* Called with the database lock held; may call HAL, must come back. Nonzero ends
 * the query, which returns it. */
typedef int (*hal_query_cb)(hal_query_t *q, void *arg);

/* One pin or parameter (pin first). -EFAULT, -EINVAL, -ENOENT, -EIO; -EEXIST:
 * another type than asked for; set: -EACCES (output, linked, read-only), -EBADF
 * (port). cb may be NULL for get; for set it fills q->pp.value. */
int hal_getref_p(hal_query_t *q);
int hal_get_p(hal_query_t *q, hal_query_cb cb, void *arg);
int hal_set_p(hal_query_t *q, hal_query_cb cb, void *arg);
/* One signal. The value of a port is the size of its buffer; setting it makes the
 * buffer, once (-EISCONN). -EACCES: the signal has a writer. */
int hal_getref_s(hal_query_t *q);
int hal_get_s(hal_query_t *q, hal_query_cb cb, void *arg);
int hal_set_s(hal_query_t *q, hal_query_cb cb, void *arg);
/* All, sorted by name; components and threads newest first. */
int hal_list_p(hal_query_t *q, hal_query_cb cb, void *arg);
int hal_list_p_s(hal_query_t *q, hal_query_cb cb, void *arg);
int hal_list_s(hal_query_t *q, hal_query_cb cb, void *arg);
int hal_list_comp(hal_query_t *q, hal_query_cb cb, void *arg);
int hal_list_funct(hal_query_t *q, hal_query_cb cb, void *arg);
int hal_list_thread(hal_query_t *q, hal_query_cb cb, void *arg);
/* q may be NULL. 0, -ENOENT, -EINVAL, -EFAULT. */
int hal_comp_by_name(const char *name, hal_query_t *q);
int hal_comp_by_id(int comp_id, hal_query_t *q);

typedef struct {
    long mem_total, mem_free; /* bytes */
    int ncomps, ncomps_free;  /* in use; ready to be used again */
    int npins, npins_free;
    int nparams, nparams_free;
    int naliases, naliases_free;
    int nsignals, nsignals_free;
    int nthreads, nthreads_free;
    int nfuncts, nfuncts_free;
} hal_statistics_t;
int hal_statistics(hal_statistics_t *stat);
#endif /* ULAPI */

RTAPI_END_DECLS
#endif
