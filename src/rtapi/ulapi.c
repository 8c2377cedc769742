/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * ulapi.c - RTAPI of ordinary processes where it differs from the host's.
 *
 * Thread: [user]
 */
#include "rtapi_internal.h"

#include <errno.h>
#include <stdio.h>
#include "kerf_clock.h"

#define DELAY_MAX_NS 999999999L

void rtapi_default_msg_handler(msg_level_t level, const char *fmt, va_list ap)
{
    FILE *to = level == RTAPI_MSG_ALL ? stdout : stderr;
    vfprintf(to, fmt, ap);
    fflush(to);
}

long rtapi_delay_max(void)
{
    return DELAY_MAX_NS;
}

void rtapi_delay(long ns)
{
    if (ns > 0) {
        kerf_clock_sleep_ns(ns < DELAY_MAX_NS ? ns : DELAY_MAX_NS);
    }
}

int rtapi_is_realtime(void)
{
    rtapi_print_msg(RTAPI_MSG_ERR, "rtapi_is_realtime() only allowed in real time context");
    return 0;
}

int rtapi_fifo_new(int key, int module_id, unsigned long size, char mode)
{
    (void)key, (void)module_id, (void)size, (void)mode;
    return -ENOSYS;
}

int rtapi_fifo_delete(int fifo_id, int module_id)
{
    (void)fifo_id, (void)module_id;
    return -ENOSYS;
}

int rtapi_fifo_read(int fifo_id, char *buf, unsigned long size)
{
    (void)fifo_id, (void)buf, (void)size;
    return -ENOSYS;
}

int rtapi_fifo_write(int fifo_id, char *buf, unsigned long size)
{
    (void)fifo_id, (void)buf, (void)size;
    return -ENOSYS;
}
