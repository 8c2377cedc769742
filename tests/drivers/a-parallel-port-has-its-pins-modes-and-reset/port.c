/* SPDX-License-Identifier: GPL-2.0-or-later
 * hal_parport, or another driver of port registers, on registers that are HAL pins: sim.ADDRESS.out shows what was written there and .writes how
 * often, .in is what reading gives. */
#define RTAPI_IO_H
#ifndef DRIVER
#define DRIVER "hal_parport"
#endif
static unsigned char rtapi_inb(unsigned short address);
static void rtapi_outb(unsigned char value, unsigned short address);
static unsigned rtapi_inl(unsigned short address) { return rtapi_inb(address); }
static void rtapi_outl(unsigned value, unsigned short address) { rtapi_outb((unsigned char)value, address); }
#define rtapi_parport_get sim_get
#define rtapi_parport_release sim_release
static int sim_init(const char *name);
#include <hal.h>
#define hal_init sim_init
#include SOURCE
#undef hal_init

static const unsigned short addresses[] = {0x378, 0x379, 0x37a, 0x77a, 0x278, 0x279, 0x27a, 0x67a, 0x61,
                                           0x3fb, 0x3fc, 0x3fe, 0x2fb, 0x2fc, 0x2fe};
#define REGISTERS (int)(sizeof addresses / sizeof addresses[0])

static struct sim {
    hal_uint_t in, out, writes;
} *sim;

static struct sim *at(unsigned short address)
{
    int i = 0;
    while(addresses[i] != address) i++;
    return &sim[i];
}

static unsigned char rtapi_inb(unsigned short address)
{
    return (unsigned char)hal_get_ui32(at(address)->in);
}

static void rtapi_outb(unsigned char value, unsigned short address)
{
    struct sim *s = at(address);
    hal_set_ui32(s->out, value);
    hal_set_ui32(s->writes, hal_get_ui32(s->writes) + 1);
}

int sim_get(const char *module_name, rtapi_parport_t *port, unsigned short base, unsigned short base_hi, unsigned int modes)
{
    (void)module_name; (void)base_hi;
    *port = (rtapi_parport_t){.base = base, .base_hi = modes ? 0 : base == 0x378 ? 0x778 : base == 0x278 ? 0x678 : 0, .fd = -1};
    return 0;
}

void sim_release(rtapi_parport_t *port)
{
    rtapi_print_msg(RTAPI_MSG_ERR, "released 0x%x\n", port->base);
}

static int sim_init(const char *name)
{
    int i, id = hal_init("kerf_test_port");
    if(id < 0 || strcmp(name, DRIVER)) return -EINVAL;
    sim = hal_malloc(sizeof *sim * REGISTERS);
    for(i = 0; i < REGISTERS; i++) {
        hal_pin_new_ui32(id, HAL_IN, &sim[i].in, 0, "sim.%x.in", addresses[i]);
        hal_pin_new_ui32(id, HAL_OUT, &sim[i].out, 0, "sim.%x.out", addresses[i]);
        hal_pin_new_ui32(id, HAL_OUT, &sim[i].writes, 0, "sim.%x.writes", addresses[i]);
    }
    return id;
}
