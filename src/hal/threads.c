/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * threads.c - a module that makes up to three realtime threads, fastest first.
 *
 * In:     name1 period1 ... name3 period3 (ns); fp1 ... fp3 are accepted, threads
 *         may always use floating point
 * Thread: [init]
 */
#include "hal.h"
#include "rtapi.h"
#include "rtapi_app.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Realtime threads");
MODULE_LICENSE("GPL");

static char *name1 = "thread1";
static int fp1 = 1;
static long period1 = 1000000;
static char *name2;
static int fp2 = 1;
static long period2;
static char *name3;
static int fp3 = 1;
static long period3;
RTAPI_MP_STRING(name1, "name of thread 1");
RTAPI_MP_INT(fp1, "ignored");
RTAPI_MP_LONG(period1, "thread 1: period, ns");
RTAPI_MP_STRING(name2, "name of thread 2");
RTAPI_MP_INT(fp2, "ignored");
RTAPI_MP_LONG(period2, "thread 2: period, ns");
RTAPI_MP_STRING(name3, "name of thread 3");
RTAPI_MP_INT(fp3, "ignored");
RTAPI_MP_LONG(period3, "thread 3: period, ns");

static int comp_id;
static const char *made[3];
static int nmade;

static int make(const char *name, long period)
{
    if (period <= 0 || !name || !*name) {
        return 0;
    }
    if (hal_create_thread(name, (unsigned long)period, 1) < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "THREADS: ERROR: could not create thread '%s'\n", name);
        return -1;
    }
    made[nmade++] = name;
    return 0;
}

/* Newest first: a thread's period and priority follow from the one before it. */
static void unmake(void)
{
    while (nmade > 0) {
        hal_thread_delete(made[--nmade]);
    }
}

int rtapi_app_main(void)
{
    comp_id = hal_init("threads");
    if (comp_id < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "THREADS: ERROR: hal_init() failed\n");
        return -1;
    }
    if (make(name1, period1) < 0 || make(name2, period2) < 0 || make(name3, period3) < 0) {
        unmake();
        hal_exit(comp_id);
        return -1;
    }
    hal_ready(comp_id);
    return 0;
}

void rtapi_app_exit(void)
{
    unmake();
    hal_exit(comp_id);
}
