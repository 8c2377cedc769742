/* SPDX-License-Identifier: GPL-2.0-or-later
 * rtapi_device.h - a named device with an end. [init] */
#ifndef RTAPI_DEVICE_H
#define RTAPI_DEVICE_H

#include <stdio.h>

#define RTAPI_DEVICE_NAME_LEN 47

struct rtapi_device {
    char name[RTAPI_DEVICE_NAME_LEN + 1];
    void (*release)(struct rtapi_device *dev); /* called by rtapi_device_unregister; may be NULL */
};

#define rtapi_dev_set_name(dev, ...) snprintf((dev)->name, sizeof((dev)->name), __VA_ARGS__)

static inline int rtapi_device_register(struct rtapi_device *dev)
{
    (void)dev;
    return 0;
}
static inline void rtapi_device_unregister(struct rtapi_device *dev)
{
    if (dev->release) {
        dev->release(dev);
    }
}

#endif
