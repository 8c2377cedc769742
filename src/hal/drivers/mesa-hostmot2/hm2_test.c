/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2_test.c - a board that is only a file of constant registers; most patterns have a fault that
 * hostmot2 has to find. [init] and [servo]
 */
#include <string.h>
#include <rtapi_app.h>
#include "hm2_llio.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("HostMot2 board without hardware");

static int test_pattern;
RTAPI_MP_INT(test_pattern, "registers of the board, 0 to 14");
static char *config[1];
RTAPI_MP_ARRAY_STRING(config, 1, "config string of the board");

#define SPACE 0x10000
#define COOKIE 0x100
#define IDROM 0x400
enum { TYPE = 0x00, MODULES = 0x04, PINS = 0x08, PORTS = 0x1C, WIDTH = 0x20, PORT_WIDTH = 0x24, CLOCK_LOW = 0x28,
       CLOCK_HIGH = 0x2C };

static rtapi_u8 registers[SPACE];
static struct hm2_llio board;
static int comp_id;

static int read_registers(struct hm2_llio *io, rtapi_u32 addr, void *buffer, int bytes)
{
    (void)io;
    addr &= SPACE - 1;
    if(addr + (rtapi_u32)bytes > SPACE) return 0;
    memcpy(buffer, registers + addr, (size_t)bytes);
    return 1;
}

static int ignore_write(struct hm2_llio *io, rtapi_u32 addr, const void *buffer, int bytes)
{
    (void)io;
    (void)addr;
    (void)buffer;
    (void)bytes;
    return 1;
}

static const struct hm2_llio_ops ops = {.read = read_registers, .write = ignore_write};

static void set(rtapi_u32 addr, rtapi_u32 value)
{
    memcpy(registers + addr, &value, sizeof value);
}

static void set_idrom(rtapi_u32 field, rtapi_u32 value)
{
    set(IDROM + field, value);
}

static void set_ports(rtapi_u32 ports, rtapi_u32 width, rtapi_u32 port_width)
{
    set_idrom(PORTS, ports);
    set_idrom(WIDTH, width);
    set_idrom(PORT_WIDTH, port_width);
}

static void set_clocks(rtapi_u32 low, rtapi_u32 high)
{
    set_idrom(CLOCK_LOW, low);
    set_idrom(CLOCK_HIGH, high);
}

/* The part of a good board that patterns from 2 on have. */
static void set_identity(int pattern)
{
    if(pattern >= 1) set(COOKIE, 0x55AACAFE);
    if(pattern >= 2) memcpy(registers + COOKIE + 4, "HOSTMOT2", 8);
    if(pattern >= 3) set(COOKIE + 12, IDROM);
    if(pattern >= 3) set_idrom(TYPE, pattern == 3 ? 0x1234 : 2);
}

static void set_connectors(const char *const names[], int n)
{
    int i;
    board.num_connectors = n;
    for(i = 0; i < n; i++) board.connector_name[i] = names[i];
}

static int set_pattern(int pattern)
{
    static const char *const one[] = {"P99"}, *const p3[] = {"P3"};
    static const char *const six[] = {"P4", "P5", "P6", "P9", "P8", "P7"};
    rtapi_u32 i;
    set_identity(pattern);
    set_connectors(one, 1);
    board.pins_per_connector = 24;
    switch(pattern) {
    case 0: case 1: case 2: case 3: case 4: return 0;
    case 5: set_idrom(PORT_WIDTH, 29); return 0;
    case 6: set_idrom(PORT_WIDTH, 24); return 0;
    case 7: set_ports(1, 99, 24); return 0;
    case 8: set_ports(2, 48, 24); return 0;
    case 9: set_ports(1, 24, 24); set_clocks(12345, 0); return 0;
    case 10: set_ports(1, 24, 24); set_clocks(2000000, 0); return 0;
    case 11:
        set_connectors(six, 6);
        set_ports(6, 144, 24);
        set_clocks(2000000, 20000000);
        set_idrom(PINS, 0x1C0);
        return 0;
    case 12:
        set_connectors(p3, 1);
        set_ports(1, 24, 24);
        set_clocks(2000000, 20000000);
        set_idrom(MODULES, 0x40);
        set_idrom(PINS, 0x1C0);
        for(i = 0; i < 24; i++) set_idrom(0x1C0 + 4 * i, 0x03000000);
        return 0;
    case 13: board.pins_per_connector = 5; set_idrom(PORT_WIDTH, 24); return 0;
    case 14: board.pins_per_connector = 37; set_idrom(PORT_WIDTH, 37); return 0;
    default: return -ENODEV;
    }
}

static int start(void)
{
    int r;
    if(set_pattern(test_pattern) < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "hm2_test: unknown test pattern %d: there are 0 to 14\n", test_pattern);
        return -ENODEV;
    }
    board.ops = &ops;
    board.comp_id = comp_id;
    board.fpga_part = "none";
    board.threadsafe = true;
    rtapi_snprintf(board.name, sizeof board.name, "hm2_test.0");
    r = hm2_register(&board, config[0]);
    if(r < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "hm2_test.0: hm2_test fails HM2 registration\n");
        return -EIO;
    }
    rtapi_print("hm2_test.0: initialized hm2 test-pattern %d\n", test_pattern);
    return 0;
}

int rtapi_app_main(void)
{
    int r;
    rtapi_print("hm2_test: loading HostMot2 test driver with test pattern %d\n", test_pattern);
    comp_id = hal_init("hm2_test");
    if(comp_id < 0) return comp_id;
    r = start();
    if(r < 0) {
        hal_exit(comp_id);
        return r;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void)
{
    hal_exit(comp_id);
    hm2_unregister(&board);
}
