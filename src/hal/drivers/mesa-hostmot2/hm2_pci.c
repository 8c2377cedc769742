/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2_pci.c - HostMot2 boards in a PCI or PCI Express slot, whose registers are memory.
 *
 * Boards with Mesa's own bridge keep their firmware in flash memory. Those with a PLX bridge would
 * have to be programmed at each start; they are named and left alone.
 */
#include <string.h>
#include <rtapi_app.h>
#include <rtapi_pci.h>
#include "hm2_llio.h"
#include "components/comp_util.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("HostMot2 boards in a PCI slot");

#define MAX_BOARDS 8
static char *config[MAX_BOARDS];
RTAPI_MP_ARRAY_STRING(config, MAX_BOARDS, "config string of each board");

#define MESA 0x2718
#define PLX 0x10B5
#define REGISTERS 0x10000              /* bytes */

static const struct model {
    rtapi_u32 vendor, device, subdevice; /* the subsystem's vendor is the vendor */
    const char *name;
    int connectors, pins;
    const char *connector[HM2_MAX_CONNECTORS];
    const char *fpga;
    int leds;
} models[] = {
    {MESA, 0x5124, 0x5124, "5i24", 3, 24, {"P4", "P3", "P2"}, "6slx16ftg256", 2},
    {MESA, 0x5125, 0x5125, "5i25", 2, 17, {"P3", "P2"}, "6slx9tqg144", 2},
    {MESA, 0x6125, 0x6125, "6i25", 2, 17, {"P3", "P2"}, "6slx9tqg144", 2},
    {MESA, 0x5925, 0x5925, "5i25", 2, 17, {"P3", "P2"}, "t20f256", 2},
    {MESA, 0x6925, 0x6925, "6i25", 2, 17, {"P3", "P2"}, "t20f256", 2},
    /* With a PLX bridge. */
    {PLX, 0x9030, 0x3131, "5i20", 0, 0, {0}, NULL, 0}, {PLX, 0x9030, 0x3132, "4i65", 0, 0, {0}, NULL, 0},
    {PLX, 0x9054, 0x3312, "5i21", 0, 0, {0}, NULL, 0}, {PLX, 0x9054, 0x3314, "5i22", 0, 0, {0}, NULL, 0},
    {PLX, 0x9054, 0x3313, "5i22", 0, 0, {0}, NULL, 0}, {PLX, 0x9054, 0x3315, "5i23", 0, 0, {0}, NULL, 0},
    {PLX, 0x9054, 0x3311, "4i68", 0, 0, {0}, NULL, 0}, {PLX, 0x9054, 0x3133, "4i68", 0, 0, {0}, NULL, 0},
    {PLX, 0x9054, 0x3472, "4i69", 0, 0, {0}, NULL, 0}, {PLX, 0x9054, 0x3473, "4i69", 0, 0, {0}, NULL, 0},
    {PLX, 0x9056, 0x3427, "3x20", 0, 0, {0}, NULL, 0}, {PLX, 0x9056, 0x3428, "3x20", 0, 0, {0}, NULL, 0},
    {PLX, 0x9056, 0x3429, "3x20", 0, 0, {0}, NULL, 0},
};
#define MODELS ((int)(sizeof models / sizeof models[0]))

struct board {
    struct hm2_llio io;
    volatile rtapi_u32 *registers;
    struct rtapi_pci_dev *dev;
};

static struct board board[MAX_BOARDS];
static int comp_id, boards;
static struct rtapi_pci_device_id ids[MODELS + 1];

/* ---- Transfers [servo] ------------------------------------------------------ */

static int read_registers(struct hm2_llio *io, rtapi_u32 addr, void *buffer, int bytes)
{
    const struct board *b = (struct board *)io;
    rtapi_u32 *to = buffer;
    int i;
    if(addr + (rtapi_u32)bytes > REGISTERS) return 0;
    for(i = 0; i < bytes / 4; i++) to[i] = b->registers[addr / 4 + (rtapi_u32)i];
    return 1;
}

static int write_registers(struct hm2_llio *io, rtapi_u32 addr, const void *buffer, int bytes)
{
    const struct board *b = (struct board *)io;
    const rtapi_u32 *from = buffer;
    int i;
    if(addr + (rtapi_u32)bytes > REGISTERS) return 0;
    for(i = 0; i < bytes / 4; i++) b->registers[addr / 4 + (rtapi_u32)i] = from[i];
    return 1;
}

static const struct hm2_llio_ops ops = {.read = read_registers, .write = write_registers};

/* ---- Cards [init] ----------------------------------------------------------- */

static const struct model *model_of(const struct rtapi_pci_device_id *id)
{
    return &models[id - ids];
}

static void name_board(struct board *b, const struct model *m)
{
    int i, number = 0;
    for(i = 0; i < boards; i++)
        if(!strncmp(board[i].io.name + 4, m->name, 4)) number++;
    rtapi_snprintf(b->io.name, sizeof b->io.name, "hm2_%s.%d", m->name, number);
}

static int start_board(struct board *b, const struct model *m, struct rtapi_pci_dev *dev)
{
    int i, r;
    name_board(b, m);
    b->dev = dev;
    b->io.ops = &ops;
    b->io.comp_id = comp_id;
    b->io.num_connectors = m->connectors;
    b->io.pins_per_connector = m->pins;
    for(i = 0; i < m->connectors; i++) b->io.connector_name[i] = m->connector[i];
    b->io.fpga_part = m->fpga;
    b->io.num_leds = m->leds;
    b->io.threadsafe = true;
    r = rtapi_pci_enable_device(dev);
    if(r < 0) return r;
    b->registers = rtapi_pci_ioremap_bar(dev, 0);
    if(!b->registers || rtapi_pci_resource_len(dev, 0) < REGISTERS) {
        rtapi_print_msg(RTAPI_MSG_ERR,
                        "hm2_pci: board %s at %s: its registers cannot be reached; this needs the rights of "
                        "root, and no kernel lockdown\n", m->name, rtapi_pci_name(dev));
        return -ENODEV;
    }
    rtapi_print("hm2_pci: discovered %s at %s\n", m->name, rtapi_pci_name(dev));
    return hm2_register(&b->io, config[boards]);
}

static void stop_board(struct board *b)
{
    hm2_unregister(&b->io);
    if(b->registers) rtapi_iounmap(b->registers);
    b->registers = NULL;
    rtapi_pci_disable_device(b->dev);
}

static int probe(struct rtapi_pci_dev *dev, const struct rtapi_pci_device_id *id)
{
    const struct model *m = model_of(id);
    if(!m->connectors) {
        rtapi_print_msg(RTAPI_MSG_ERR, "hm2_pci: board %s at %s has a PLX bridge and needs its firmware loaded at each "
                        "start, which this driver cannot do\n", m->name, rtapi_pci_name(dev));
        return 0; /* the others work */
    }
    if(boards == MAX_BOARDS) return -ENOSPC;
    struct board *b = &board[boards];
    int r = start_board(b, m, dev);
    if(r < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "hm2_pci: board %s at %s does not work (%d)\n", m->name, rtapi_pci_name(dev), r);
        stop_board(b);
        return r;
    }
    rtapi_pci_set_drvdata(dev, b);
    boards++;
    return 0;
}

static void remove_card(struct rtapi_pci_dev *dev)
{
    struct board *b = rtapi_pci_get_drvdata(dev);
    if(b) stop_board(b);
}

static struct rtapi_pci_driver driver = {.name = "hm2_pci", .id_table = ids, .probe = probe, .remove = remove_card};

int rtapi_app_main(void)
{
    int i, r;
    rtapi_print("hm2_pci: loading Mesa AnyIO HostMot2 driver version 0.7\n");
    comp_id = hal_init("hm2_pci");
    if(comp_id < 0) return comp_id;
    for(i = 0; i < MODELS; i++) {
        ids[i].vendor = models[i].vendor;
        ids[i].device = models[i].device;
        ids[i].subvendor = models[i].vendor;
        ids[i].subdevice = models[i].subdevice;
    }
    r = rtapi_pci_register_driver(&driver);
    if(r == 0 && !boards) {
        rtapi_print_msg(RTAPI_MSG_ERR, "hm2_pci: no board found (lspci -nn shows what is in the slots)\n");
        rtapi_pci_unregister_driver(&driver);
        r = -ENODEV;
    }
    if(r < 0) {
        hal_exit(comp_id);
        return r;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void)
{
    hal_exit(comp_id);
    rtapi_pci_unregister_driver(&driver);
}
