/* SPDX-License-Identifier: GPL-2.0-or-later
 * rtapi_firmware.h - firmware files in memory. [init], realtime host. */
#ifndef RTAPI_FIRMWARE_H
#define RTAPI_FIRMWARE_H

#include <stddef.h>
#include "rtapi_device.h"
#include "rtapi_stdint.h"

struct rtapi_firmware {
    size_t size;
    const rtapi_u8 *data;
};

#ifdef __cplusplus
extern "C" {
#endif
/* Maps /lib/firmware/<kernel release>/<name>, else /lib/firmware/<name>. 0,
 * -ENOENT, -ENOMEM, or -1 when the file cannot be mapped. */
int rtapi_request_firmware(const struct rtapi_firmware **fw, const char *name, struct rtapi_device *device);
/* NULL is allowed. */
void rtapi_release_firmware(const struct rtapi_firmware *fw);
#ifdef __cplusplus
}
#endif
#endif
