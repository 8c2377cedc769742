/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * rtapi_common.c - what is the same in the realtime host and in ordinary
 * processes: text, message levels, module ids, time.
 *
 * Thread: [any], except rtapi_init and rtapi_exit [init]/[user]
 */
#include "rtapi_internal.h"

#include <errno.h>
#include <stdatomic.h>
#include <stdio.h>
#include "kerf_clock.h"

int rtapi_vsnprintf(char *buf, unsigned long size, const char *fmt, va_list ap)
{
    return vsnprintf(buf, size, fmt, ap);
}

int rtapi_snprintf(char *buf, unsigned long size, const char *fmt, ...)
{
    va_list ap;
    va_start(ap, fmt);
    int n = vsnprintf(buf, size, fmt, ap);
    va_end(ap);
    return n;
}

static _Atomic int msg_level = RTAPI_MSG_ERR;
static _Atomic(rtapi_msg_handler_t) msg_handler = rtapi_default_msg_handler;

void rtapi_print(const char *fmt, ...)
{
    va_list ap;
    va_start(ap, fmt);
    atomic_load(&msg_handler)(RTAPI_MSG_ALL, fmt, ap);
    va_end(ap);
}

void rtapi_print_msg(msg_level_t level, const char *fmt, ...)
{
    int current = atomic_load_explicit(&msg_level, memory_order_relaxed);
    if ((int)level > current || current == RTAPI_MSG_NONE) {
        return;
    }
    va_list ap;
    va_start(ap, fmt);
    atomic_load(&msg_handler)(level, fmt, ap);
    va_end(ap);
}

int rtapi_set_msg_level(int level)
{
    atomic_store(&msg_level, level);
    return 0;
}

int rtapi_get_msg_level(void)
{
    return atomic_load(&msg_level);
}

void rtapi_set_msg_handler(rtapi_msg_handler_t handler)
{
    atomic_store(&msg_handler, handler ? handler : rtapi_default_msg_handler);
}

rtapi_msg_handler_t rtapi_get_msg_handler(void)
{
    return atomic_load(&msg_handler);
}

static _Atomic int uuid_shmem = -1;

int rtapi_init(const char *modname)
{
    (void)modname;
    int id = rtapi_shmem_new(RTAPI_UUID_KEY, 0, sizeof(struct rtapi_uuid_segment));
    void *mem;
    if (id < 0 || rtapi_shmem_getptr(id, &mem) < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "rtapi_init: could not open shared memory for uuid\n");
        return -EINVAL;
    }
    atomic_store(&uuid_shmem, id);
    return atomic_fetch_add(&((struct rtapi_uuid_segment *)mem)->last_id, 1) + 1;
}

int rtapi_exit(int module_id)
{
    rtapi_shmem_delete(atomic_load(&uuid_shmem), module_id);
    return 0;
}

int rtapi_is_kernelspace(void)
{
    return 0;
}

long long rtapi_get_time(void)
{
    return kerf_clock_now_ns();
}
