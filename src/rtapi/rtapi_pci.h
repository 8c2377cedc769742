/* SPDX-License-Identifier: GPL-2.0-or-later
 * rtapi_pci.h - PCI cards from user space. [init], realtime host. */
#ifndef RTAPI_PCI_H
#define RTAPI_PCI_H

#include "rtapi_stdint.h"

#define RTAPI_PCI_BARS 6
#ifndef PCI_ANY_ID
#define PCI_ANY_ID (~0U) /* no wildcard here: all four numbers are compared */
#endif

/* A card a driver knows; the table ends with vendor 0. */
struct rtapi_pci_device_id {
    rtapi_u32 vendor, device;
    rtapi_u32 subvendor, subdevice;
    rtapi_u32 rtapi_class, class_mask;
};

struct rtapi_pci_resource {
    rtapi_intptr_t start, end;
    unsigned long flags;
    void *mmio;
};

struct rtapi_pci_dev {
    char dev_name[32];
    char sys_path[256];
    unsigned short vendor, device;
    unsigned short subsystem_vendor, subsystem_device;
    unsigned int rtapi_class;
    struct rtapi_pci_resource resource[RTAPI_PCI_BARS];
    void *driver_data;
};

struct rtapi_pci_driver {
    char *name;
    const struct rtapi_pci_device_id *id_table;
    int (*probe)(struct rtapi_pci_dev *dev, const struct rtapi_pci_device_id *id); /* 0: taken */
    void (*remove)(struct rtapi_pci_dev *dev);
    void *private_data; /* of this library */
};

#define rtapi__iomem

#define rtapi_pci_resource_start(dev, bar) ((dev)->resource[bar].start)
#define rtapi_pci_resource_end(dev, bar) ((dev)->resource[bar].end)
#define rtapi_pci_resource_flags(dev, bar) ((dev)->resource[bar].flags)
#define rtapi_pci_resource_len(dev, bar) \
    ((rtapi_pci_resource_start(dev, bar) == 0 && rtapi_pci_resource_end(dev, bar) == 0) \
         ? 0 \
         : (rtapi_pci_resource_end(dev, bar) - rtapi_pci_resource_start(dev, bar) + 1))

#ifdef __cplusplus
extern "C" {
#endif
/* Calls probe for each card whose four numbers are in the table. 0 (also when
 * there is none), or -1 when a probe failed: the cards taken so far are removed. */
int rtapi_pci_register_driver(struct rtapi_pci_driver *driver);
/* Calls remove for each card. */
void rtapi_pci_unregister_driver(struct rtapi_pci_driver *driver);
/* Enables the card and reads its resources. 0 or a negative number. */
int rtapi_pci_enable_device(struct rtapi_pci_dev *dev);
int rtapi_pci_disable_device(struct rtapi_pci_dev *dev);
/* Maps BAR 0..5; NULL on error. Unmap with rtapi_iounmap. */
void rtapi__iomem *rtapi_pci_ioremap_bar(struct rtapi_pci_dev *dev, int bar);
void rtapi_iounmap(volatile void rtapi__iomem *addr);

static inline const char *rtapi_pci_name(const struct rtapi_pci_dev *dev)
{
    return dev->dev_name;
}
static inline void rtapi_pci_set_drvdata(struct rtapi_pci_dev *dev, void *data)
{
    dev->driver_data = data;
}
static inline void *rtapi_pci_get_drvdata(struct rtapi_pci_dev *dev)
{
    return dev->driver_data;
}
#ifdef __cplusplus
}
#endif
#endif
