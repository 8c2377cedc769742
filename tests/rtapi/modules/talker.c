/* SPDX-License-Identifier: GPL-2.0-or-later
 * Realtime tasks that print: short texts, a flood, a long one. */
#include <string.h>
#include "rtapi.h"
#include "rtapi_app.h"

static int task;

static void talk(void *arg)
{
    char longest[2000];
    (void)arg;
    rtapi_print("task says %d\n", rtapi_task_self());
    rtapi_print_msg(RTAPI_MSG_ERR, "task has an error\n");
    rtapi_print_msg(RTAPI_MSG_DBG, "NOT SHOWN\n");
    memset(longest, 'x', sizeof longest - 1);
    longest[sizeof longest - 1] = 0;
    rtapi_print("%s", longest);
    rtapi_print("|\n");
    for (int i = 0; i < 1000; i++) {
        rtapi_print("flood %d\n", i);
    }
    for (;;) {
        rtapi_wait();
    }
}

int rtapi_app_main(void)
{
    task = rtapi_task_new(talk, 0, rtapi_prio_highest(), 1, 0, 0);
    return rtapi_task_start(task, 1000000);
}

void rtapi_app_exit(void)
{
    rtapi_task_delete(task);
    rtapi_print("talker ends\n");
}
