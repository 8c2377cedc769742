/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * serport.c - the modem lines of PC serial ports (16550) as pins.
 *
 * Thread: read and write [any]; one or two accesses to a port
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <hal.h>
#include <hal_parport.h>
#include "components/comp_util.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Modem lines of serial ports");

#define MAX_PORTS 8
#define FIRST_ADDRESS 0x10              /* what is below is no serial port; above FFFF there is none */
#define LAST_ADDRESS 0xFFF8

static int io[MAX_PORTS];
RTAPI_MP_ARRAY_INT(io, MAX_PORTS, "address of each port");

/* Registers, from the port's address on. */
enum { LINE_CONTROL = 3, MODEM_CONTROL = 4, MODEM_STATUS = 6 };

static const struct wiring {
    int number;                         /* of the pin at the connector of 9 pins */
    rtapi_u8 bit;
} input_wiring[] = {{1, 0x80}, {6, 0x20}, {8, 0x10}, {9, 0x40}},     /* DCD, DSR, CTS, RI in the modem status */
  output_wiring[] = {{3, 0x40}, {4, 0x01}, {7, 0x02}};              /* TX (break) in the line control; DTR, RTS */
#define INPUTS ((int)(sizeof input_wiring / sizeof input_wiring[0]))
#define OUTPUTS ((int)(sizeof output_wiring / sizeof output_wiring[0]))
#define BREAK 0                         /* index of the output that is in the line control */

struct port {
    rtapi_parport_t io;                 /* eight registers, as a parallel port has them */
    hal_bool_t in[INPUTS], in_not[INPUTS], out[OUTPUTS], invert[OUTPUTS];
    hal_uint_t address;
};

static int comp_id;
static int ports;
static struct port *port[MAX_PORTS];

/* HAL function serport.N.read. */
static void read_port(void *arg, long period)
{
    struct port *p = arg;
    rtapi_u8 status = rtapi_parport_in(&p->io, MODEM_STATUS);
    int n;
    (void)period;
    for(n = 0; n < INPUTS; n++) {
        rtapi_bool on = !(status & input_wiring[n].bit);
        hal_set_bool(p->in[n], on);
        hal_set_bool(p->in_not[n], !on);
    }
}

/* HAL function serport.N.write. */
static void write_port(void *arg, long period)
{
    struct port *p = arg;
    rtapi_u8 line = 0, modem = 0;
    int n;
    (void)period;
    for(n = 0; n < OUTPUTS; n++) {
        if(hal_get_bool(p->out[n]) == hal_get_bool(p->invert[n])) continue;
        if(n == BREAK) line |= output_wiring[n].bit;
        else modem |= output_wiring[n].bit;
    }
    rtapi_parport_out(&p->io, MODEM_CONTROL, modem);
    rtapi_parport_out(&p->io, LINE_CONTROL, line);
}

static int export_port(struct port *p, int n)
{
    int i;
    for(i = 0; i < INPUTS; i++) {
        int number = input_wiring[i].number;
        COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &p->in[i], 0, "serport.%d.pin-%d-in", n, number));
        COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &p->in_not[i], 1, "serport.%d.pin-%d-in-not", n, number));
    }
    for(i = 0; i < OUTPUTS; i++) {
        int number = output_wiring[i].number;
        COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &p->out[i], 0, "serport.%d.pin-%d-out", n, number));
        COMP_TRY(hal_param_new_bool(comp_id, HAL_RW, &p->invert[i], 0, "serport.%d.pin-%d-out-invert", n, number));
    }
    COMP_TRY(hal_param_new_ui32(comp_id, HAL_RO, &p->address, p->io.base, "serport.%d.ioaddr", n));
    COMP_TRY(hal_export_functf(read_port, p, 0, 0, comp_id, "serport.%d.read", n));
    return hal_export_functf(write_port, p, 0, 0, comp_id, "serport.%d.write", n);
}

static int add_port(int address)
{
    struct port *p = hal_malloc(sizeof *p);
    if(!p) return -ENOMEM;
    if(address < FIRST_ADDRESS || address > LAST_ADDRESS) {
        rtapi_print_msg(RTAPI_MSG_ERR, "serport: io=0x%x is not the address of a port: 0x3f8 and 0x2f8 are usual\n",
                        (unsigned)address);
        return -EINVAL;
    }
    COMP_TRY(hal_parport_get(comp_id, &p->io, (unsigned short)address, 0, RTAPI_PARPORT_OTHER_DEVICE));
    port[ports++] = p;
    return export_port(p, ports - 1);
}

static int add_ports(void)
{
    int n;
    for(n = 0; n < MAX_PORTS && io[n]; n++) COMP_TRY(add_port(io[n]));
    if(ports) return 0;
    rtapi_print_msg(RTAPI_MSG_ERR, "serport: no ports: io= must have the addresses, as in io=0x3f8\n");
    return -EINVAL;
}

static void release(void)
{
    int n;
    for(n = 0; n < ports; n++) hal_parport_release(&port[n]->io);
}

int rtapi_app_main(void)
{
    int r;
    comp_id = hal_init("serport");
    if(comp_id < 0) return comp_id;
    r = add_ports();
    if(r < 0) {
        release();
        hal_exit(comp_id);
        return r;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void)
{
    hal_exit(comp_id);
    release();
}
