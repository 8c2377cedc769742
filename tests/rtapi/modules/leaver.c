/* SPDX-License-Identifier: GPL-2.0-or-later
 * A module whose exit forgets its task. */
#include "rtapi.h"
#include "rtapi_app.h"

static void work(void *arg)
{
    volatile int *n = arg;
    for (;;) {
        for (*n = 0; *n < 1000; ++*n) {
        }
        rtapi_wait();
    }
}

int rtapi_app_main(void)
{
    static volatile int n;
    int task = rtapi_task_new(work, (void *)&n, rtapi_prio_highest(), 1, 0, 0);
    return rtapi_task_start(task, 50000);
}

void rtapi_app_exit(void)
{
}
