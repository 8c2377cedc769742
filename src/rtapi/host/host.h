/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * host.h - parts of rtapi_app, the process that runs realtime modules.
 *
 *   host_main.c     command line, socket between client and daemon
 *   host_module.c   loading, parameters, unloading
 *   host_task.c     tasks, periods, lateness; calls a back end
 *   host_posix.c    back end: POSIX threads on CLOCK_MONOTONIC
 *   host_virtual.c  back end: the instance's virtual clock
 *   host_evl.c      back end: EVL core of Xenomai 4 (where its headers are)
 *   host_rt.c       what this machine allows; privileges, memory, signals
 *   host_msg.c      messages of tasks, printed by a thread of their own
 *   host_device.c   ports, PCI, firmware, files and programs as root
 */
#ifndef HOST_H
#define HOST_H

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include "rtapi_internal.h"

#define MAX_TASKS 64
#define TASK_STACK_MIN (1UL << 20)

/* ---- Tasks and back ends ------------------------------------------------ */

struct task {
    _Atomic int state;          /* enum task_state */
    int id, prio, owner;
    unsigned long stack;        /* bytes */
    void (*code)(void *);
    void *arg;
    unsigned long period_ns;
    /* The schedule; written by the task only. */
    int64_t next_ns;            /* when the present cycle was due */
    int64_t pll_ns;             /* added to every period */
    /* Set by rtapi_task_delete, read by the task. */
    _Atomic bool cancel;
    /* Figures; written by the task (or by reset between cycles). */
    _Atomic bool reset;
    _Atomic unsigned sequence;  /* odd while figures change */
    struct rtapi_lateness late;
    /* Back end's own. */
    pthread_t thread;
    _Atomic int slot;
};
enum task_state { TASK_FREE, TASK_STOPPED, TASK_RUNNING };

/* A realtime API. All functions are called with a valid task; wait and now from
 * the task itself [rt], the others from the command thread [init]. */
#define RTAPI_BACKEND_VERSION 1
struct rtapi_backend_ops {
    unsigned version;           /* RTAPI_BACKEND_VERSION */
    const char *banner;         /* "POSIX realtime": printed as "Note: Using ..." */
    bool warn_late;             /* tell the user about the first late cycle */
    bool makes_up;              /* a late task runs all the cycles it missed; else few (MOST_MADE_UP) */
    int prio_highest, prio_lowest;
    /* Once, before the first task. 0 or -errno. */
    int (*init)(void);
    /* Makes the thread that runs host_task_body(task). 0 or -errno. */
    int (*start)(struct task *task);
    /* The thread, before and after the task's own code. */
    void (*enter)(struct task *task);
    void (*leave)(struct task *task);
    /* The present time, ns. */
    int64_t (*now)(void);
    /* Sleeps until when_ns; returns early when task->cancel is set. */
    void (*sleep_until)(struct task *task, int64_t when_ns);
    /* A cycle that is late does not sleep: a place to let others run, or NULL. */
    void (*late)(struct task *task);
    /* Wakes a task whose cancel was set, and waits for its end. */
    void (*stop)(struct task *task);
};
extern const struct rtapi_backend_ops backend_posix_rt, backend_posix, backend_virtual;
#ifdef KERF_EVL
extern const struct rtapi_backend_ops backend_evl;
bool host_evl_usable(void);
#endif

/* Chooses the back end; to be called once. Its name is printed by the caller. */
const struct rtapi_backend_ops *host_backend_choose(void);
const struct rtapi_backend_ops *host_backend(void);
/* What a back end's thread runs. Returns when the task was deleted. */
void host_task_body(struct task *task);
/* Ends all tasks. [init] */
void host_tasks_end(void);
/* Ends the tasks whose code is in the module loaded at base, with a message. [init] */
void host_tasks_end_of(const void *base, const char *module);

/* ---- This machine ------------------------------------------------------- */

/* The type, found at the first call. Says on stderr why there is none. */
rtapi_realtime_type_t host_realtime_type(void);
const char *host_realtime_name(rtapi_realtime_type_t type);
/* Further findings, one line each, on stderr (for `check_rt`). */
void host_realtime_report(void);
/* What makes realtime late on this computer, and how to change it, on stderr; nothing when all is well. [init] */
void host_realtime_advice(void);
/* Takes over the real user's rights where root's are not needed. 0, or an exit
 * status after a message. */
int host_privileges_init(void);
void host_root_begin(void);
void host_root_end(void);
/* Memory, limits, latency of the CPU: for realtime. [init] */
void host_realtime_setup(void);

/* [init] Asks for the right to use I/O ports, before any thread exists; see host_io_errno. */
void host_io_setup(void);
/* The CPU for all tasks, or -1 for any. Tells once when none is isolated. */
int host_cpu(void);
/* Whether this process may use I/O ports; 0, or the errno of iopl. */
int host_io_errno(void);
/* SIGTERM and SIGINT write to a pipe; SIGSEGV and the like say so and abort. */
int host_signals_init(bool realtime);
int host_signal_received(void);

/* ---- Messages ----------------------------------------------------------- */

void host_messages_init(void);  /* by the command thread */
void host_messages_start(void); /* the printing thread */
void host_messages_flush(void); /* prints what is queued; from any thread */

/* ---- Modules ------------------------------------------------------------ */

int host_load(int argc, char **argv); /* NAME [PARAMETER=VALUE...] */
int host_unload(const char *name);
int host_newinst(const char *comp, const char *inst, const char *arg);
void host_unload_all(void);           /* newest first */

#endif
