/* hm2_7i90 with a parallel port of its own; register 0x7000 not 0: the board does not answer. with narrow=1 the port
 * transfers bytes only. */
#define RTAPI_IO_H
static unsigned char rtapi_inb(unsigned short address);
static void rtapi_outb(unsigned char value, unsigned short address);
static unsigned rtapi_inl(unsigned short address);
static void rtapi_outl(unsigned value, unsigned short address);
#define rtapi_parport_get sim_get
#define rtapi_parport_release sim_release
#include "tests/lib/hm2_registers.h"
#include <hal.h>
#define hal_init(name) hal_init("kerf_port")
#include "src/hal/drivers/mesa-hostmot2/hm2_epp_link.c"
#include "src/hal/drivers/mesa-hostmot2/hm2_7i90.c"

static int narrow;
RTAPI_MP_INT(narrow, "bytes only");
static unsigned addr, half, status;

static unsigned char rtapi_inb(unsigned short address)
{
    if(address == 0x379) return (unsigned char)status;
    if(address != 0x37C) return 0;
    if(registers[0x7000]) status |= 1;
    return registers[addr++];
}

static void rtapi_outb(unsigned char value, unsigned short address)
{
    if(address == 0x379) status = 0;
    if(address == 0x37B) addr = half++ & 1 ? (addr & 0xFF) | (value & 0x7Fu) << 8 : value;
    if(address == 0x37C) registers[addr++] = value;
    if(address == 0x778 + 2) rtapi_print("ECR %02x\n", value);
}

static unsigned rtapi_inl(unsigned short address)
{
    unsigned i, word = 0;
    if(narrow) return rtapi_inb(address) * 0x01010101u;
    for(i = 0; i < 4; i++) word |= (unsigned)rtapi_inb(address) << 8 * i;
    return word;
}

static void rtapi_outl(unsigned value, unsigned short address)
{
    unsigned i;
    for(i = 0; i < 4; i++) rtapi_outb((unsigned char)(value >> 8 * i), address);
}

int sim_get(const char *name, rtapi_parport_t *port, unsigned short base, unsigned short base_hi, unsigned int modes)
{
    (void)name;
    (void)modes;
    if(base == 1) return -ENOENT;
    fill_registers("MESA7I90", 3, 24);
    *port = (rtapi_parport_t){.base = base, .base_hi = base_hi, .fd = -1};
    return 0;
}

void sim_release(rtapi_parport_t *port)
{
    rtapi_print("released 0x%x\n", port->base);
}
