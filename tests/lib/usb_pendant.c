/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * usb_pendant.c - a pendant for tests in place of libusb (LD_PRELOAD). In the folder PENDANT: the file `present` has
 * its USB numbers (vendor:product) and the bytes of a report, it is there while the file is; reports come from the pipe
 * `in` (one that begins with FC to FF: a transfer error); blocks for the display are added to the file `out`.
 * PENDANT_PACE: the program's time passes so many times as fast.
 */
#define _GNU_SOURCE
#include <fcntl.h>
#include <libusb.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

static int in = -1, report_bytes;

static const char *path(const char *name)
{
    static char text[4096];
    snprintf(text, sizeof text, "%s/%s", getenv("PENDANT"), name);
    return text;
}

static long pace(void)
{
    const char *text = getenv("PENDANT_PACE");
    return text ? atol(text) : 1;
}

int clock_gettime(clockid_t id, struct timespec *t)
{
    int result = (int)syscall(SYS_clock_gettime, id, t);
    if (id == CLOCK_MONOTONIC && pace() > 1) {
        long long ns = (t->tv_sec * 1000000000LL + t->tv_nsec) * pace();
        t->tv_sec = ns / 1000000000;
        t->tv_nsec = ns % 1000000000;
    }
    return result;
}

int nanosleep(const struct timespec *t, struct timespec *rest)
{
    long long ns = (t->tv_sec * 1000000000LL + t->tv_nsec) / pace();
    struct timespec shorter = {ns / 1000000000, ns % 1000000000};
    return (int)syscall(SYS_nanosleep, &shorter, rest);
}

int libusb_init(libusb_context **context)
{
    *context = NULL;
    return 0;
}

void libusb_exit(libusb_context *context)
{
    (void)context;
}

libusb_device_handle *libusb_open_device_with_vid_pid(libusb_context *context, uint16_t vendor, uint16_t product)
{
    unsigned maker = 0, present = 0;
    FILE *f = fopen(path("present"), "r");
    (void)context;
    if (!f) {
        return NULL;
    }
    if (fscanf(f, "%x:%x %d", &maker, &present, &report_bytes) != 3) {
        maker = 0;
    }
    fclose(f);
    if (vendor != maker || product != present) {
        return NULL;
    }
    in = open(path("in"), O_RDWR);
    return (libusb_device_handle *)&in;
}

void libusb_close(libusb_device_handle *handle)
{
    (void)handle;
    close(in);
}

int libusb_set_auto_detach_kernel_driver(libusb_device_handle *handle, int enable)
{
    (void)handle;
    (void)enable;
    return 0;
}

int libusb_claim_interface(libusb_device_handle *handle, int number)
{
    (void)handle;
    return number;
}

int libusb_release_interface(libusb_device_handle *handle, int number)
{
    (void)handle;
    return number;
}

libusb_device *libusb_get_device(libusb_device_handle *handle)
{
    (void)handle;
    return NULL;
}

int libusb_get_active_config_descriptor(libusb_device *device, struct libusb_config_descriptor **config)
{
    (void)device;
    (void)config;
    return LIBUSB_ERROR_NOT_FOUND;
}

int libusb_interrupt_transfer(libusb_device_handle *handle, unsigned char endpoint, unsigned char *data, int length,
                              int *done, unsigned timeout)
{
    (void)handle;
    struct pollfd wait = {in, POLLIN, 0};
    if (endpoint != 0x81 || length < report_bytes || poll(&wait, 1, (int)timeout) != 1) {
        return LIBUSB_ERROR_TIMEOUT;
    }
    static const int ERRORS[] = {LIBUSB_ERROR_OVERFLOW, LIBUSB_ERROR_IO, LIBUSB_ERROR_PIPE, LIBUSB_ERROR_NO_DEVICE};
    *done = (int)read(in, data, (size_t)report_bytes);
    return *done != report_bytes ? LIBUSB_ERROR_NO_DEVICE : data[0] < 0xFC ? 0 : ERRORS[data[0] - 0xFC];
}

int libusb_control_transfer(libusb_device_handle *handle, uint8_t type, uint8_t request, uint16_t value,
                            uint16_t index, unsigned char *data, uint16_t length, unsigned timeout)
{
    (void)handle;
    (void)timeout;
    if (type != 0x21 || request != 9 || value != 0x306 || index != 0) {
        return LIBUSB_ERROR_PIPE;
    }
    int out = open(path("out"), O_WRONLY | O_CREAT | O_APPEND, 0644);
    int done = (int)write(out, data, length);
    close(out);
    return done;
}
