/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * host.h - what the parts of rtapi_app share.
 */
#ifndef RTAPI_HOST_H
#define RTAPI_HOST_H

#include "rtapi.h"
#include "rtapi_internal.h"

#ifdef __cplusplus
extern "C" {
#endif

/* [init] What the kernel and our rights allow; found once. */
rtapi_realtime_type_t host_realtime_type(void);
/* [init] The CPU for realtime threads, -1 = any. */
int host_realtime_cpu(void);
/* [init] Makes the process fit for realtime: memory, limits, signals. */
void host_setup(void);
/* [init] Starts the thread that prints what realtime threads say; flush waits until it is printed. */
void host_messages_start(void);
void host_messages_flush(void);

#ifdef __cplusplus
}
#endif
#endif
