/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * rtapi.h - the realtime interface: messages, time, tasks, shared memory,
 * module metadata.
 *
 * Define RTAPI (module in the realtime host) or ULAPI (ordinary process)
 * before including; not both. Functions return >= 0 on success and a negative
 * errno on failure unless said otherwise. Contexts: [init] rtapi_app_main, may
 * allocate; [rt] inside a realtime task, bounded; [user] an ordinary process;
 * [any] all of them.
 */
#ifndef RTAPI_H
#define RTAPI_H

#if !defined(RTAPI) && !defined(ULAPI)
#error "rtapi.h: define RTAPI (realtime module) or ULAPI (ordinary process)"
#endif
#if defined(RTAPI) && defined(ULAPI)
#error "rtapi.h: RTAPI and ULAPI exclude each other"
#endif

#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <sys/types.h>
#include <spawn.h>
#include "rtapi_errno.h"
#include "rtapi_stdint.h"
#include "rtapi_bool.h"

#ifdef __cplusplus
#define RTAPI_BEGIN_DECLS extern "C" {
#define RTAPI_END_DECLS }
#else
#define RTAPI_BEGIN_DECLS
#define RTAPI_END_DECLS
#endif

#define RTAPI_NAME_LEN 31 /* longest RTAPI name, without the NUL */
#define RTAPI_NO_FP 0
#define RTAPI_USES_FP 1   /* every task may use floating point; the flag is ignored */

#define RTAPI_STRINGIFY_(x) #x
#define RTAPI_STRINGIFY(x) RTAPI_STRINGIFY_(x)

RTAPI_BEGIN_DECLS

/* ---- General ------------------------------------------------------------ */

/* [init][user] Registers a module; the name is for reading only. Returns its
 * id (> 0, unique on the machine per instance), or -EINVAL when the counter's
 * shared memory cannot be had. */
int rtapi_init(const char *modname);

/* [init][user] Gives the id back. Returns 0. */
int rtapi_exit(int module_id);

/* [any] C snprintf, floats and long long included. */
int rtapi_snprintf(char *buf, unsigned long size, const char *fmt, ...) __attribute__((format(printf, 3, 4)));
int rtapi_vsnprintf(char *buf, unsigned long size, const char *fmt, va_list ap) __attribute__((format(printf, 3, 0)));

/* ---- Messages ----------------------------------------------------------- */

typedef enum {
    RTAPI_MSG_NONE = 0,
    RTAPI_MSG_ERR,
    RTAPI_MSG_WARN,
    RTAPI_MSG_INFO,
    RTAPI_MSG_DBG,
    RTAPI_MSG_ALL
} msg_level_t;

/* [any] Always printed, to standard output. No prefix or newline is added. */
void rtapi_print(const char *fmt, ...) __attribute__((format(printf, 1, 2)));

/* [any] Printed on standard error when level <= the current level and that is
 * not RTAPI_MSG_NONE (RTAPI_MSG_ALL: on standard output). In a realtime task the
 * text (at most 1019 characters) goes to a queue of 128 and is printed later. */
void rtapi_print_msg(msg_level_t level, const char *fmt, ...) __attribute__((format(printf, 2, 3)));

/* [any] The level of this process; default RTAPI_MSG_ERR. Set returns 0. */
int rtapi_set_msg_level(int level);
int rtapi_get_msg_level(void);

/* [any] Who prints. NULL restores the default. The handler gets every message
 * that passed the level test, in the caller's thread. */
typedef void (*rtapi_msg_handler_t)(msg_level_t level, const char *fmt, va_list ap);
void rtapi_set_msg_handler(rtapi_msg_handler_t handler);
rtapi_msg_handler_t rtapi_get_msg_handler(void);

/* ---- Capabilities ------------------------------------------------------- */

typedef enum {
    REALTIME_TYPE_UNINITIALIZED = -1,
    REALTIME_TYPE_NONE = 0,
    REALTIME_TYPE_UNKNOWN,
    REALTIME_TYPE_PREEMPT_DYNAMIC,
    REALTIME_TYPE_PREEMPT_RT,
    REALTIME_TYPE_RTAI,
    REALTIME_TYPE_LXRT,
    REALTIME_TYPE_XENOMAI,
    REALTIME_TYPE_XENOMAI_EVL
} rtapi_realtime_type_t;

/* [any] 0: modules run in user space. */
int rtapi_is_kernelspace(void);

/* [init][rt] Nonzero when tasks are scheduled in real time. In an ordinary
 * process: prints that it is not allowed there and returns 0. */
int rtapi_is_realtime(void);

#ifdef RTAPI
/* [init][rt] What the host found at its start; does not change afterwards. */
rtapi_realtime_type_t rtapi_get_realtime_type(void);
#endif

/* ---- Time --------------------------------------------------------------- */

/* [any] Nanoseconds of the clock that all waiting uses: CLOCK_MONOTONIC, or the
 * virtual clock (see kerf_clock.h). Only differences mean something. */
long long rtapi_get_time(void);

/* [any] Waits ns (ns, clamped to rtapi_delay_max). Sleeps; for short gaps in
 * drivers. */
void rtapi_delay(long ns);

/* [any] 10000 ns in the realtime host, 999999999 ns elsewhere. */
long rtapi_delay_max(void);

#ifdef RTAPI
/* [init] The clock period, ns. 0 asks (0 while unset). The first other call sets
 * it and returns it; later ones return -EINVAL. */
long rtapi_clock_set_period(long ns);

/* ---- Tasks -------------------------------------------------------------- */

/* [init] Priorities: next_higher and next_lower clamp to highest..lowest. */
int rtapi_prio_highest(void);
int rtapi_prio_lowest(void);
int rtapi_prio_next_higher(int prio);
int rtapi_prio_next_lower(int prio);

/* [init] A task, not yet running. stack in bytes (at least 1 MiB is given).
 * Returns its id 0..63, -EINVAL (priority out of range) or -ENOSPC. */
int rtapi_task_new(void (*code)(void *), void *arg, int prio, int owner, unsigned long stack, int uses_fp);

/* [init] Ends the task at its next rtapi_wait and joins it. 0 or -EINVAL. */
int rtapi_task_delete(int id);

/* [init] Starts the task with the given period (ns, > 0). 0 or -errno. */
int rtapi_task_start(int id, unsigned long period_ns);

/* Not available in user space: -ENOSYS. */
int rtapi_task_pause(int id);
int rtapi_task_resume(int id);

/* [rt] This task's id, or -EINVAL outside a task. */
int rtapi_task_self(void);

/* [rt] Sleeps until the next period begins. A late task catches up: no cycle is
 * left out. Also the point at which a task is deleted. */
void rtapi_wait(void);

/* [rt] Takes this moment as the beginning of the schedule: the next wake-up is
 * one period from now. */
void rtapi_task_self_resync(void);

#define RTAPI_TASK_PLL_SUPPORT
/* [rt] When the present cycle was due (ns, rtapi_get_time); 0 outside a task. */
long long rtapi_task_pll_get_reference(void);
/* [rt] Lengthens every following period by ns, at most by a hundredth of the
 * period either way. 0, or -EINVAL outside a task. */
int rtapi_task_pll_set_correction(long ns);

/* [init][any] How late wake-ups were since the task began (ns; lateness = wake
 * minus due, 0 with the virtual clock). overruns counts cycles that began after
 * the next one was already due. bins: number of wake-ups with lateness below
 * 2^(i+10) ns (1.024 us, 2.048 us ...), the last one all above. */
#define RTAPI_LATENESS_BINS 16
struct rtapi_lateness {
    long long cycles;       /* wake-ups counted */
    long long overruns;     /* cycles that were already due again when they began */
    long long worst_ns;     /* greatest lateness */
    long long worst_time;   /* rtapi_get_time of it */
    long long last_ns;      /* of the present cycle */
    long long bins[RTAPI_LATENESS_BINS];
};
/* Copies the figures of task id; may be called while it runs. 0 or -EINVAL. */
int rtapi_task_lateness(int id, struct rtapi_lateness *out);
/* Sets the figures to zero at the task's next wake-up. 0 or -EINVAL. */
int rtapi_task_lateness_reset(int id);

/* Kernel-only services: declared for source compatibility, absent from the
 * user-space host, so that a module using them does not load. */
int rtapi_sem_new(int key, int module_id);
int rtapi_sem_delete(int sem_id, int module_id);
int rtapi_sem_give(int sem_id);
int rtapi_sem_take(int sem_id);
int rtapi_sem_try(int sem_id);
int rtapi_irq_new(unsigned int irq_num, int owner, void (*handler)(void));
int rtapi_irq_delete(unsigned int irq_num);
int rtapi_enable_interrupt(unsigned int irq);
int rtapi_disable_interrupt(unsigned int irq);
#endif /* RTAPI */

/* Fifos: absent from the host; in an ordinary process they return -ENOSYS. */
int rtapi_fifo_new(int key, int module_id, unsigned long size, char mode);
int rtapi_fifo_delete(int fifo_id, int module_id);
int rtapi_fifo_read(int fifo_id, char *buf, unsigned long size);
int rtapi_fifo_write(int fifo_id, char *buf, unsigned long size);

/* ---- Shared memory ------------------------------------------------------ */

/* [init][user] Opens or makes the segment of a key (the instance's own, see
 * kerf_instance.h), zero when new. Returns its id (0..63; 0 is valid). The same
 * key again in a process returns the same id and counts. -ENOMEM: 64 are open;
 * else -errno of the system. */
int rtapi_shmem_new(int key, int module_id, unsigned long size);
/* [init][user] Undoes one rtapi_shmem_new; the last process removes the segment.
 * 0 or -EINVAL. */
int rtapi_shmem_delete(int shmem_id, int module_id);
/* [any] Where the segment is. 0 or -EINVAL. */
int rtapi_shmem_getptr(int shmem_id, void **ptr);

/* ---- Privileged help (realtime host only) ------------------------------- */

long int simple_strtol(const char *nptr, char **endptr, int base);
/* [init] open(2) with root's file rights; fd or -errno. */
int rtapi_open_as_root(const char *filename, int mode);
/* [init] posix_spawn and posix_spawnp. */
int rtapi_spawn_as_root(pid_t *pid, const char *path, const posix_spawn_file_actions_t *file_actions,
                        const posix_spawnattr_t *attrp, char *const argv[], char *const envp[]);
int rtapi_spawnp_as_root(pid_t *pid, const char *file, const posix_spawn_file_actions_t *file_actions,
                         const posix_spawnattr_t *attrp, char *const argv[], char *const envp[]);
#define rtapi_request_region(base, size, name) ((void *)-1)
#define rtapi_release_region(base, size) ((void)0)

RTAPI_END_DECLS

/* ---- Module parameters and metadata (realtime modules) ------------------ */

#ifndef KERNEL_VERSION
#define KERNEL_VERSION(a, b, c) (((a) << 16) + ((b) << 8) + (c))
#endif
#ifndef LINUX_VERSION_CODE
#define LINUX_VERSION_CODE 0
#endif

#ifdef RTAPI
/* The contract with the host and the linker: what a module says about itself are
 * exported data `rtapi_info_*` in section .modinfo; names that must stay global
 * are listed in section .rtapi_export. */
#ifdef __cplusplus
#define RTAPI_C_DEFINE(decl) extern "C" { decl; }
#else
#define RTAPI_C_DEFINE(decl) decl;
#endif
#define RTAPI_SECTION(name) __attribute__((section(name), used, visibility("default")))
/* Swallows the semicolon that follows a macro at file scope. */
#define RTAPI_NEED_SEMICOLON(tag, line) RTAPI_NEED_SEMICOLON_(tag, line)
#define RTAPI_NEED_SEMICOLON_(tag, line) struct rtapi_semicolon_##tag##_##line

#define RTAPI_EXPORT_(x) RTAPI_C_DEFINE(char rtapi_exported_##x[] RTAPI_SECTION(".rtapi_export") = #x)
#define EXPORT_SYMBOL(x) RTAPI_EXPORT_(x) struct rtapi_semicolon_export_##x
#define EXPORT_SYMBOL_GPL(x) EXPORT_SYMBOL(x)

#define RTAPI_INFO_(name, value) RTAPI_C_DEFINE(const char *rtapi_info_##name RTAPI_SECTION(".modinfo") = value)
#define RTAPI_INFO_LINE_(x, y, line) RTAPI_C_DEFINE(const char *rtapi_info_##x##_##line RTAPI_SECTION(".modinfo") = y)
#define RTAPI_INFO_LINE(x, y, line) RTAPI_INFO_LINE_(x, y, line)
#define MODULE_INFO(x, y) RTAPI_INFO_LINE(x, y, __LINE__) RTAPI_NEED_SEMICOLON(info, __LINE__)
#define MODULE_LICENSE(s) RTAPI_INFO_(license, s) struct rtapi_semicolon_license
#define MODULE_AUTHOR(s) RTAPI_INFO_(author, s) struct rtapi_semicolon_author
#define MODULE_DESCRIPTION(s) RTAPI_INFO_(description, s) struct rtapi_semicolon_description
#define MODULE_SUPPORTED_DEVICE(s) RTAPI_INFO_(supported_device, s) struct rtapi_semicolon_supported_device
#define MODULE_SUPPORTED_DEVICES(s) MODULE_SUPPORTED_DEVICE(s)
#define MODULE_DEVICE_TABLE(x, y) \
    RTAPI_C_DEFINE(struct rtapi_pci_device_id *rtapi_info_device_table_##x RTAPI_SECTION(".modinfo") = \
        (struct rtapi_pci_device_id *)(y)) struct rtapi_semicolon_device_table_##x

#define RTAPI_PARM_(v, t) \
    RTAPI_C_DEFINE(const char *rtapi_info_type_##v RTAPI_SECTION(".modinfo") = t) \
    RTAPI_C_DEFINE(void *rtapi_info_address_##v RTAPI_SECTION(".modinfo") = (void *)&v)
#define MODULE_PARM(v, t) RTAPI_PARM_(v, t) struct rtapi_semicolon_parm_##v
#define MODULE_PARM_DESC(v, t) \
    RTAPI_C_DEFINE(const char *rtapi_info_description_##v RTAPI_SECTION(".modinfo") = t) \
    struct rtapi_semicolon_desc_##v

/* var: a global int, long or char *. Set from `var=value` of the load command
 * before rtapi_app_main runs. */
#define RTAPI_MP_INT(var, descr) RTAPI_PARM_(var, "i") MODULE_PARM_DESC(var, descr)
#define RTAPI_MP_LONG(var, descr) RTAPI_PARM_(var, "l") MODULE_PARM_DESC(var, descr)
#define RTAPI_MP_STRING(var, descr) RTAPI_PARM_(var, "s") MODULE_PARM_DESC(var, descr)
/* var: a global array of num; values separated by commas; the rest keep theirs. */
#define RTAPI_MP_ARRAY(type, var, num, descr) \
    RTAPI_PARM_(var, type) \
    RTAPI_C_DEFINE(int rtapi_info_size_##var RTAPI_SECTION(".modinfo") = num) \
    MODULE_PARM_DESC(var, descr)
#define RTAPI_MP_ARRAY_INT(var, num, descr) RTAPI_MP_ARRAY("i", var, num, descr)
#define RTAPI_MP_ARRAY_LONG(var, num, descr) RTAPI_MP_ARRAY("l", var, num, descr)
#define RTAPI_MP_ARRAY_STRING(var, num, descr) RTAPI_MP_ARRAY("s", var, num, descr)
#endif /* RTAPI */

#endif
