/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * idrom.c - what the firmware says of itself: the IDROM and the module descriptors. [init]
 */
#include <string.h>
#include "hm2.h"

#define ADDR_IDROM_OFFSET 0x010C
#define LOWEST_CLOCK 1000000
#define CLOCK_LOW 1
#define CLOCK_HIGH 2

enum { /* words of the IDROM */
    IDROM_TYPE, IDROM_MODULES, IDROM_PINS, IDROM_NAME, IDROM_NAME2, IDROM_FPGA_SIZE, IDROM_FPGA_PINS, IDROM_IO_PORTS,
    IDROM_IO_WIDTH, IDROM_PORT_WIDTH, IDROM_CLOCK_LOW, IDROM_CLOCK_HIGH, IDROM_INSTANCE_STRIDE, IDROM_INSTANCE_STRIDE1,
    IDROM_REGISTER_STRIDE, IDROM_REGISTER_STRIDE1, IDROM_WORDS
};

static void print_idrom(struct hm2 *hm2)
{
    const struct hm2_idrom *d = &hm2->idrom;
    int i;
    HM2_PRINT(hm2, "IDRom:\n");
    HM2_PRINT(hm2, "    IDRom Type: 0x%08X\n", d->type);
    HM2_PRINT(hm2, "    Offset to Modules: 0x%08X\n", d->modules);
    HM2_PRINT(hm2, "    Offset to Pin Description: 0x%08X\n", d->pins);
    HM2_PRINT(hm2, "    Board Name: %s\n", d->board);
    HM2_PRINT(hm2, "    FPGA Size: %u\n", d->fpga_size);
    HM2_PRINT(hm2, "    FPGA Pins: %u\n", d->fpga_pins);
    HM2_PRINT(hm2, "    Port Width: %u\n", d->port_width);
    HM2_PRINT(hm2, "    IO Ports: %u\n", d->ports);
    HM2_PRINT(hm2, "    IO Width: %u\n", d->width);
    HM2_PRINT(hm2, "    Clock Low: %u Hz (%u KHz, %u MHz)\n", d->clock_low, d->clock_low / 1000,
              d->clock_low / 1000000);
    HM2_PRINT(hm2, "    Clock High: %u Hz (%u KHz, %u MHz)\n", d->clock_high, d->clock_high / 1000,
              d->clock_high / 1000000);
    for(i = 0; i < 2; i++) HM2_PRINT(hm2, "    Instance Stride %d: 0x%08X\n", i, d->instance_stride[i]);
    for(i = 0; i < 2; i++) HM2_PRINT(hm2, "    Register Stride %d: 0x%08X\n", i, d->register_stride[i]);
}

static int check_ports(struct hm2 *hm2)
{
    const struct hm2_idrom *d = &hm2->idrom;
    if(d->port_width != (rtapi_u32)hm2->io->pins_per_connector) {
        HM2_ERR(hm2, "invalid IDROM PortWidth %u, this board has %d pins per connector, aborting load\n",
                d->port_width, hm2->io->pins_per_connector);
        return -EINVAL;
    }
    if(d->ports != (rtapi_u32)hm2->io->num_connectors) {
        HM2_ERR(hm2, "IDROM IOPorts is %u but llio num_ioport_connectors is %d, driver and firmware are inconsistent, "
                "aborting driver load\n", d->ports, hm2->io->num_connectors);
        return -EINVAL;
    }
    if(d->width != d->ports * d->port_width) {
        HM2_ERR(hm2, "IDROM IOWidth is %u, but IDROM IOPorts is %u and IDROM PortWidth is %u (inconsistent firmware), "
                "aborting driver load\n", d->width, d->ports, d->port_width);
        return -EINVAL;
    }
    if(d->width > HM2_MAX_PINS) {
        HM2_ERR(hm2, "IDROM IOWidth is %u but at most %d pins are supported, aborting driver load\n", d->width,
                HM2_MAX_PINS);
        return -EINVAL;
    }
    return 0;
}

static int check_clock(struct hm2 *hm2, const char *which, rtapi_u32 hz)
{
    if(hz >= LOWEST_CLOCK) return 0;
    HM2_ERR(hm2, "IDROM %s is %u, that's too low, aborting driver load\n", which, hz);
    return -EINVAL;
}

int hm2_idrom_read(struct hm2 *hm2, bool debug)
{
    struct hm2_idrom *d = &hm2->idrom;
    rtapi_u32 offset, word[IDROM_WORDS];
    if(!hm2_read_now(hm2, ADDR_IDROM_OFFSET, &offset, sizeof offset)) return -EIO;
    hm2->idrom_addr = offset & 0xFFFF;
    if(!hm2_read_now(hm2, hm2->idrom_addr, word, sizeof word)) return -EIO;
    d->type = word[IDROM_TYPE];
    d->modules = word[IDROM_MODULES];
    d->pins = word[IDROM_PINS];
    memcpy(d->board, &word[IDROM_NAME], 8);
    d->fpga_size = word[IDROM_FPGA_SIZE];
    d->fpga_pins = word[IDROM_FPGA_PINS];
    d->ports = word[IDROM_IO_PORTS];
    d->width = word[IDROM_IO_WIDTH];
    d->port_width = word[IDROM_PORT_WIDTH];
    d->clock_low = word[IDROM_CLOCK_LOW];
    d->clock_high = word[IDROM_CLOCK_HIGH];
    memcpy(d->instance_stride, &word[IDROM_INSTANCE_STRIDE], sizeof d->instance_stride);
    memcpy(d->register_stride, &word[IDROM_REGISTER_STRIDE], sizeof d->register_stride);
    if(d->type != 2 && d->type != 3) {
        HM2_ERR(hm2, "invalid IDROM type %d, expected 2 or 3, aborting load\n", (int)d->type);
        return -EINVAL;
    }
    if(debug) print_idrom(hm2);
    COMP_TRY(check_ports(hm2));
    COMP_TRY(check_clock(hm2, "ClockLow", d->clock_low));
    return check_clock(hm2, "ClockHigh", d->clock_high);
}

static void print_module(struct hm2 *hm2, const struct hm2_md *md)
{
    HM2_PRINT(hm2, "    Module Descriptor at index %d: %s (GTag %d)\n", (int)(md - hm2->md), hm2_gtag_name(md->gtag),
              md->gtag);
    HM2_PRINT(hm2, "        Version: %d, Clock: %u Hz, Instances: %d\n", md->version, md->clock, md->instances);
    HM2_PRINT(hm2, "        Base Address: 0x%04X, Registers: %d, Register Stride: 0x%04X, Instance Stride: 0x%04X\n",
              md->base, md->registers, md->register_stride, md->instance_stride);
    HM2_PRINT(hm2, "        MultipleRegisters: 0x%08X\n", md->multiple);
}

static int decode_module(struct hm2 *hm2, const rtapi_u32 word[3], struct hm2_md *md)
{
    const struct hm2_idrom *d = &hm2->idrom;
    unsigned register_sel = word[1] >> 24 & 0xF, instance_sel = word[1] >> 28;
    md->gtag = word[0] & 0xFF;
    md->version = word[0] >> 8 & 0xFF;
    md->clock_tag = word[0] >> 16 & 0xFF;
    md->instances = word[0] >> 24;
    md->base = word[1] & 0xFFFF;
    md->registers = word[1] >> 16 & 0xFF;
    md->multiple = word[2];
    if(md->clock_tag != CLOCK_LOW && md->clock_tag != CLOCK_HIGH) {
        HM2_ERR(hm2, "module descriptor %d (%s) has clock tag %d, expected 1 or 2: the firmware is damaged\n", hm2->mds,
                hm2_gtag_name(md->gtag), md->clock_tag);
        return -EINVAL;
    }
    if(register_sel > 1 || instance_sel > 1) {
        HM2_ERR(hm2, "module descriptor %d (%s) has stride selectors %u and %u, expected 0 or 1: "
                "the firmware is damaged\n",
                hm2->mds, hm2_gtag_name(md->gtag), register_sel, instance_sel);
        return -EINVAL;
    }
    md->clock = md->clock_tag == CLOCK_LOW ? d->clock_low : d->clock_high;
    md->register_stride = d->register_stride[register_sel];
    md->instance_stride = d->instance_stride[instance_sel];
    return 0;
}

int hm2_modules_read(struct hm2 *hm2, bool debug)
{
    rtapi_u32 addr = hm2->idrom_addr + hm2->idrom.modules;
    for(hm2->mds = 0; hm2->mds < HM2_MAX_MODULES; hm2->mds++, addr += 12) {
        rtapi_u32 word[3];
        struct hm2_md *md = &hm2->md[hm2->mds];
        if(!hm2_read_now(hm2, addr, word, sizeof word)) return -EIO;
        if(!(word[0] & 0xFF)) break;
        COMP_TRY(decode_module(hm2, word, md));
        if(debug) print_module(hm2, md);
    }
    return 0;
}

int hm2_check_md(struct hm2 *hm2, const struct hm2_md *md, int version, int registers, rtapi_u32 instance_stride,
                 rtapi_u32 multiple)
{
    if((version < 0 || md->version == version) && md->registers == registers &&
       md->instance_stride == instance_stride && md->multiple == multiple) return 0;
    if(version < 0) version = md->version;
    HM2_ERR(hm2, "inconsistent Module Descriptor for %s, not loading driver\n", hm2_gtag_name(md->gtag));
    HM2_ERR(hm2, "    Version = %d, expected %d\n", md->version, version);
    HM2_ERR(hm2, "    NumRegisters = %d, expected %d\n", md->registers, registers);
    HM2_ERR(hm2, "    InstanceStride = 0x%08X, expected 0x%08X\n", md->instance_stride, instance_stride);
    HM2_ERR(hm2, "    MultipleRegisters = 0x%08X, expected 0x%08X\n", md->multiple, multiple);
    HM2_ERR(hm2, "    write a firmware to the board that fits this driver (mesaflash --write)\n");
    return -EINVAL;
}

int hm2_count(struct hm2 *hm2, const struct hm2_md *md, enum hm2_count what)
{
    int wanted = hm2->config.num[what];
    if(wanted < 0) return md->instances;
    if(wanted <= md->instances) return wanted;
    HM2_ERR(hm2, "config string has %s=%d, but the firmware has only %d, not loading driver\n", hm2_count_token(what),
            wanted, md->instances);
    return -EINVAL;
}

const struct hm2_md *hm2_find_md(const struct hm2 *hm2, int gtag)
{
    int i;
    for(i = 0; i < hm2->mds; i++)
        if(hm2->md[i].gtag == gtag) return &hm2->md[i];
    return NULL;
}
