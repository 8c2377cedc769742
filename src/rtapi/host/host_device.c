/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * host_device.c - hardware help for drivers: files and programs as root,
 * firmware, parallel ports, PCI cards.
 *
 * In:     sysfs, /proc/sys/dev/parport, /lib/firmware
 * Thread: [init], the command thread
 */
#include "host.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/parport.h>
#include <linux/ppdev.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <unistd.h>
#include "kerf_clock.h"
#include "rtapi_firmware.h"
#include "rtapi_parport.h"
#include "rtapi_pci.h"

int rtapi_open_as_root(const char *filename, int mode)
{
    host_root_begin();
    int fd = open(filename, mode | O_CLOEXEC);
    int err = errno;
    host_root_end();
    return fd < 0 ? -err : fd;
}

int rtapi_spawn_as_root(pid_t *pid, const char *path, const posix_spawn_file_actions_t *file_actions,
                        const posix_spawnattr_t *attrp, char *const argv[], char *const envp[])
{
    host_root_begin();
    int result = posix_spawn(pid, path, file_actions, attrp, argv, envp);
    host_root_end();
    return result;
}

int rtapi_spawnp_as_root(pid_t *pid, const char *file, const posix_spawn_file_actions_t *file_actions,
                         const posix_spawnattr_t *attrp, char *const argv[], char *const envp[])
{
    host_root_begin();
    int result = posix_spawnp(pid, file, file_actions, attrp, argv, envp);
    host_root_end();
    return result;
}

/* ---- Firmware ----------------------------------------------------------- */

static int open_firmware(const char *name)
{
    struct utsname kernel;
    char path[PATH_MAX];
    if (strstr(name, "..")) {
        errno = EINVAL;
        return -1;
    }
    uname(&kernel);
    snprintf(path, sizeof path, "/lib/firmware/%s/%s", kernel.release, name);
    int fd = open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0) {
        snprintf(path, sizeof path, "/lib/firmware/%s", name);
        fd = open(path, O_RDONLY | O_CLOEXEC);
    }
    return fd;
}

int rtapi_request_firmware(const struct rtapi_firmware **fw, const char *name, struct rtapi_device *device)
{
    (void)device;
    *fw = NULL;
    int fd = open_firmware(name);
    if (fd < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Could not locate firmware \"%s\". (%s)\n", name, strerror(errno));
        return -ENOENT;
    }
    struct stat info;
    void *data = MAP_FAILED;
    if (fstat(fd, &info) == 0 && info.st_size > 0) {
        data = mmap(NULL, (size_t)info.st_size, PROT_READ, MAP_PRIVATE, fd, 0);
    }
    close(fd);
    if (data == MAP_FAILED) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Could not map firmware \"%s\". (%s)\n", name, strerror(errno));
        return -1;
    }
    struct rtapi_firmware *result = malloc(sizeof *result);
    if (!result) {
        munmap(data, (size_t)info.st_size);
        return -ENOMEM;
    }
    result->size = (size_t)info.st_size;
    result->data = data;
    *fw = result;
    return 0;
}

void rtapi_release_firmware(const struct rtapi_firmware *fw)
{
    if (fw) {
        munmap((void *)fw->data, fw->size);
        free((void *)fw);
    }
}

/* ---- Parallel ports ----------------------------------------------------- */

#define LINUX_PORTS 16

/* I/O addresses of Linux port n; false when there is none. */
static bool linux_port(int n, unsigned *base, unsigned *base_hi)
{
    char path[64];
    snprintf(path, sizeof path, "/proc/sys/dev/parport/parport%d/base-addr", n);
    FILE *f = fopen(path, "re");
    if (!f) {
        return false;
    }
    *base_hi = 0;
    int fields = fscanf(f, "%u %u", base, base_hi);
    fclose(f);
    return fields >= 1;
}

#define STATUS_LOW 0x80 /* what a port's status register shows when all its inputs are low: one is inverted */

static int claim(const char *module_name, rtapi_parport_t *port, int n)
{
    char path[32];
    snprintf(path, sizeof path, "/dev/parport%d", n);
    int fd = rtapi_open_as_root(path, O_RDWR);
    if (fd < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: cannot open %s: %s\n", module_name, path, strerror(-fd));
        return fd;
    }
    if (ioctl(fd, PPEXCL) < 0 || ioctl(fd, PPCLAIM) < 0) {
        int err = errno;
        rtapi_print_msg(RTAPI_MSG_ERR, "%s: cannot claim %s: %s\n", module_name, path, strerror(err));
        close(fd);
        return -err;
    }
    port->fd = fd;
    return 0;
}

int rtapi_parport_get(const char *module_name, rtapi_parport_t *port, unsigned short base, unsigned short base_hi,
                      unsigned int modes)
{
    const bool other_device = modes & RTAPI_PARPORT_OTHER_DEVICE;
    unsigned found_base = 0, found_hi = 0;
    int n = -1;
    *port = (rtapi_parport_t){.base = base, .base_hi = base_hi, .fd = -1};
    if (kerf_clock_is_virtual()) {
        port->simulated = 1;
        port->memory[1] = STATUS_LOW;
        return 0;
    }
    if (base < LINUX_PORTS && !other_device) {
        if (!linux_port(base, &found_base, &found_hi)) {
            rtapi_print_msg(RTAPI_MSG_ERR, "Linux parallel port %d not found\n", base);
            return -ENOENT;
        }
        n = base;
    } else {
        for (int i = 0; i < LINUX_PORTS && n < 0 && !other_device; i++) {
            if (linux_port(i, &found_base, &found_hi) && found_base == base) {
                n = i;
            }
        }
    }
    if (host_io_errno()) {
        rtapi_print_msg(RTAPI_MSG_ERR,
                        "iopl() failed: %s\ncannot gain I/O privileges - missing CAP_SYS_RAWIO or using secure boot? - "
                        "parallel port access is not allowed\n",
                        strerror(host_io_errno()));
        return -host_io_errno();
    }
    if (n < 0) {
        if (!other_device) {
            rtapi_print_msg(RTAPI_MSG_ERR,
                            "No parport registered at 0x%x. This is not always an error. Continuing.\n", base);
        }
        return 0;
    }
    port->base = (unsigned short)found_base;
    port->base_hi = (unsigned short)found_hi;
    return claim(module_name, port, n);
}

void rtapi_parport_release(rtapi_parport_t *port)
{
    if (port->fd >= 0) {
        ioctl(port->fd, PPRELEASE);
        close(port->fd);
        port->fd = -1;
    }
}

/* ---- PCI ---------------------------------------------------------------- */

#define SYS_PCI "/sys/bus/pci/devices"
#define MAX_CARDS 32    /* of one driver */
#define MAX_MAPPINGS 64

struct cards {
    int count;
    struct rtapi_pci_dev *dev[MAX_CARDS];
};
static struct {
    void *addr;
    size_t size;
} mappings[MAX_MAPPINGS];

static unsigned sys_number(const char *dir, const char *name)
{
    char path[PATH_MAX], text[32] = "";
    snprintf(path, sizeof path, "%s/%s", dir, name);
    FILE *f = fopen(path, "re");
    if (f) {
        if (!fgets(text, sizeof text, f)) {
            text[0] = 0;
        }
        fclose(f);
    }
    return (unsigned)strtoul(text, NULL, 0);
}

static struct rtapi_pci_dev *card_new(const char *name)
{
    struct rtapi_pci_dev *dev = calloc(1, sizeof *dev);
    if (!dev) {
        return NULL;
    }
    snprintf(dev->dev_name, sizeof dev->dev_name, "%.31s", name);
    snprintf(dev->sys_path, sizeof dev->sys_path, SYS_PCI "/%.31s", name);
    dev->vendor = (unsigned short)sys_number(dev->sys_path, "vendor");
    dev->device = (unsigned short)sys_number(dev->sys_path, "device");
    dev->subsystem_vendor = (unsigned short)sys_number(dev->sys_path, "subsystem_vendor");
    dev->subsystem_device = (unsigned short)sys_number(dev->sys_path, "subsystem_device");
    dev->rtapi_class = sys_number(dev->sys_path, "class");
    return dev;
}

static const struct rtapi_pci_device_id *known(const struct rtapi_pci_driver *driver, const struct rtapi_pci_dev *dev)
{
    for (const struct rtapi_pci_device_id *id = driver->id_table; id->vendor; id++) {
        if (id->vendor == dev->vendor && id->device == dev->device && id->subvendor == dev->subsystem_vendor &&
            id->subdevice == dev->subsystem_device) {
            return id;
        }
    }
    return NULL;
}

static int name_order(const struct dirent **a, const struct dirent **b)
{
    return strcmp((*a)->d_name, (*b)->d_name);
}

int rtapi_pci_register_driver(struct rtapi_pci_driver *driver)
{
    struct dirent **names = NULL;
    int count = scandir(SYS_PCI, &names, NULL, name_order), result = 0;
    struct cards *cards = calloc(1, sizeof *cards);
    driver->private_data = cards;
    if (!cards) {
        result = -ENOMEM;
    }
    for (int i = 0; i < count; i++) {
        struct rtapi_pci_dev *dev = NULL;
        const struct rtapi_pci_device_id *id = NULL;
        if (result == 0 && names[i]->d_name[0] != '.' && cards->count < MAX_CARDS) {
            dev = card_new(names[i]->d_name);
            id = dev ? known(driver, dev) : NULL;
        }
        free(names[i]);
        if (id && driver->probe(dev, id) == 0) {
            cards->dev[cards->count++] = dev;
            continue;
        }
        free(dev);
        if (id) {
            rtapi_print_msg(RTAPI_MSG_ERR, "Driver probe function failed!\n");
            result = -1;
        }
    }
    free(names);
    if (result != 0) {
        rtapi_pci_unregister_driver(driver);
    }
    return result;
}

void rtapi_pci_unregister_driver(struct rtapi_pci_driver *driver)
{
    struct cards *cards = driver->private_data;
    for (int i = 0; cards && i < cards->count; i++) {
        driver->remove(cards->dev[i]);
        free(cards->dev[i]);
    }
    free(cards);
    driver->private_data = NULL;
}

static int set_enable(struct rtapi_pci_dev *dev, char value)
{
    char path[PATH_MAX];
    snprintf(path, sizeof path, "%s/enable", dev->sys_path);
    int fd = rtapi_open_as_root(path, O_WRONLY);
    if (fd < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "RTAPI_PCI: cannot open %s: %s\n", path, strerror(-fd));
        return fd;
    }
    int result = write(fd, &value, 1) == 1 ? 0 : -errno;
    close(fd);
    return result;
}

int rtapi_pci_enable_device(struct rtapi_pci_dev *dev)
{
    char path[PATH_MAX];
    int result = set_enable(dev, '1');
    if (result < 0) {
        return result;
    }
    snprintf(path, sizeof path, "%s/resource", dev->sys_path);
    FILE *f = fopen(path, "re");
    if (!f) {
        return -errno;
    }
    for (int bar = 0; bar < RTAPI_PCI_BARS && result == 0; bar++) {
        unsigned long long start, end, flags;
        if (fscanf(f, "%llx %llx %llx", &start, &end, &flags) != 3) {
            rtapi_print_msg(RTAPI_MSG_ERR, "RTAPI_PCI: %s has no line for BAR %d\n", path, bar);
            result = -EIO;
            break;
        }
        dev->resource[bar].start = (rtapi_intptr_t)start;
        dev->resource[bar].end = (rtapi_intptr_t)end;
        dev->resource[bar].flags = (unsigned long)flags;
    }
    fclose(f);
    return result;
}

int rtapi_pci_disable_device(struct rtapi_pci_dev *dev)
{
    return set_enable(dev, '0');
}

void *rtapi_pci_ioremap_bar(struct rtapi_pci_dev *dev, int bar)
{
    char path[PATH_MAX];
    int entry = 0;
    if (bar < 0 || bar >= RTAPI_PCI_BARS) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Invalid PCI BAR %d\n", bar);
        return NULL;
    }
    while (entry < MAX_MAPPINGS && mappings[entry].addr) {
        entry++;
    }
    size_t size = (size_t)rtapi_pci_resource_len(dev, bar);
    snprintf(path, sizeof path, "%s/resource%d", dev->sys_path, bar);
    int fd = entry < MAX_MAPPINGS && size > 0 ? rtapi_open_as_root(path, O_RDWR | O_SYNC) : -ENOSPC;
    void *addr = MAP_FAILED;
    if (fd >= 0) {
        addr = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
        close(fd);
    }
    if (addr == MAP_FAILED) {
        rtapi_print_msg(RTAPI_MSG_ERR, "RTAPI_PCI: cannot map %s: %s\n", path, strerror(fd < 0 ? -fd : errno));
        return NULL;
    }
    mappings[entry].addr = addr;
    mappings[entry].size = size;
    dev->resource[bar].mmio = addr;
    return addr;
}

void rtapi_iounmap(volatile void *addr)
{
    for (int i = 0; i < MAX_MAPPINGS; i++) {
        if (addr && mappings[i].addr == addr) {
            munmap(mappings[i].addr, mappings[i].size);
            mappings[i].addr = NULL;
            return;
        }
    }
    rtapi_print_msg(RTAPI_MSG_ERR, "RTAPI_PCI: %p is not mapped\n", (void *)addr);
}
