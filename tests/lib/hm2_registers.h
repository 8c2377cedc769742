/* SPDX-License-Identifier: GPL-2.0-or-later
 * hm2_registers.h - 64 KiB of registers of a small board: watchdog, ports, one step generator without pins. */
#include <string.h>
#include <rtapi_stdint.h>

static rtapi_u8 registers[0x10000];

static void put_register(rtapi_u32 addr, rtapi_u32 value)
{
    memcpy(registers + addr, &value, sizeof value);
}

static void fill_registers(const char *board, rtapi_u32 ports, rtapi_u32 width)
{
    const rtapi_u32 idrom[] = {3, 0x40, 0x200, 0, 0, 0, 0, ports, ports * width, width, 100000000,
                               100000000, 4, 0x40, 0x100, 4};
    const rtapi_u32 modules[] = {2 | 1 << 16 | 1 << 24, 0x0C00 | 3 << 16, 0, 3 | 1 << 16 | ports << 24,
                                 0x1000 | 5 << 16, 0x1F,
                                 5 | 2 << 8 | 1 << 16 | 1 << 24, 0x2000 | 10 << 16, 0x1FF, 0};
    rtapi_u32 i;
    put_register(0x100, 0x55AACAFE);
    memcpy(registers + 0x104, "HOSTMOT2", 8);
    put_register(0x10C, 0x400);
    memcpy(registers + 0x400, idrom, sizeof idrom);
    memcpy(registers + 0x40C, board, 8);
    memcpy(registers + 0x440, modules, sizeof modules);
    for(i = 0; i < ports * width; i++) put_register(0x600 + 4 * i, 0x03000000);
}
