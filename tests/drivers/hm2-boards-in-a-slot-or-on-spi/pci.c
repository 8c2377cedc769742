/* hm2_pci with a slot of its own: a 5i25, or with plx=1 a 5i20 beside it. */
#include "tests/lib/hm2_registers.h"
#include <rtapi.h>
#include <rtapi_pci.h>
#define rtapi_pci_register_driver sim_register
#define rtapi_pci_unregister_driver sim_unregister
#define rtapi_pci_enable_device sim_enable
#define rtapi_pci_disable_device sim_enable
#define rtapi_pci_ioremap_bar sim_map
#define rtapi_iounmap sim_unmap
int sim_register(struct rtapi_pci_driver *driver);
void sim_unregister(struct rtapi_pci_driver *driver);
int sim_enable(struct rtapi_pci_dev *dev);
void *sim_map(struct rtapi_pci_dev *dev, int bar);
void sim_unmap(volatile void *addr);
#include <hal.h>
#define hal_init(name) hal_init("kerf_slot")
#include "src/hal/drivers/mesa-hostmot2/hm2_pci.c"

static int plx;
RTAPI_MP_INT(plx, "an old board too");
static struct rtapi_pci_dev card = {.dev_name = "0000:04:00.0", .resource = {{.start = 0x1000, .end = 0x10FFF}}};
static struct rtapi_pci_dev old_card = {.dev_name = "0000:05:00.0"};

int sim_register(struct rtapi_pci_driver *driver)
{
    const struct rtapi_pci_device_id *id;
    fill_registers("MESA5I25", 2, 17);
    for(id = driver->id_table; id->vendor; id++)
        if(plx && id->device == 0x9030 && id->subdevice == 0x3131 && driver->probe(&old_card, id) < 0) return -1;
    for(id = driver->id_table; id->vendor; id++)
        if(id->vendor == 0x2718 && id->device == 0x5125) return driver->probe(&card, id);
    return 0;
}

void sim_unregister(struct rtapi_pci_driver *driver)
{
    if(plx) driver->remove(&old_card);
    if(card.driver_data) driver->remove(&card);
}

int sim_enable(struct rtapi_pci_dev *dev)
{
    (void)dev;
    return 0;
}

void *sim_map(struct rtapi_pci_dev *dev, int bar)
{
    (void)dev;
    return bar == 0 ? registers : NULL;
}

void sim_unmap(volatile void *addr)
{
    (void)addr;
}
