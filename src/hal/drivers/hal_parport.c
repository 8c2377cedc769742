/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hal_parport.c - PC parallel ports: pins 1 to 17 as bits.
 *
 * A port has three registers of pins: data (2 to 9), status (10 to 13 and 15, always inputs) and
 * control (1, 14, 16, 17). One table says which bit of which register a pin is.
 *
 * Thread: every function [any], bounded by the number of pins; reset waits for at most a quarter of
 * its thread's period
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <rtapi_string.h>
#include <hal.h>
#include <hal_parport.h>
#include "components/comp_util.h"
#include "drivers/pulse.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Parallel ports");

#define MAX_PORTS 8
#define LINUX_PORTS 16                  /* an address below is the number of a Linux port */
#define STATUS_INVERTED 0x80            /* pin 11, by the port's hardware */
#define CONTROL_INVERTED 0x0B           /* pins 1, 14 and 17 */
#define CONTROL_PINS 0x0F
#define CONTROL_DATA_IN 0x20            /* the data pins are inputs */
#define ECR_PS2 0x20                    /* data direction can be switched */
#define ECR_EPP 0x94

static char *cfg = "0x0278";
RTAPI_MP_STRING(cfg, "address [in|out|x|epp] of each port");

enum reg { DATA, STATUS, CONTROL, REGISTERS };

static const struct wiring {
    int number;                         /* of the pin at the connector */
    enum reg reg;
    rtapi_u8 bit;
} wiring[] = {
    {1, CONTROL, 0x01},  {2, DATA, 0x01},     {3, DATA, 0x02},    {4, DATA, 0x04},
    {5, DATA, 0x08},     {6, DATA, 0x10},     {7, DATA, 0x20},    {8, DATA, 0x40},
    {9, DATA, 0x80},     {10, STATUS, 0x40},  {11, STATUS, 0x80}, {12, STATUS, 0x20},
    {13, STATUS, 0x10},  {14, CONTROL, 0x02}, {15, STATUS, 0x08}, {16, CONTROL, 0x04},
    {17, CONTROL, 0x08},
};
#define PINS ((int)(sizeof wiring / sizeof wiring[0]))

enum mode { MODE_OUT, MODE_IN, MODE_X, MODE_EPP };

struct pin {
    hal_bool_t in, in_not;              /* of an input */
    hal_bool_t out, invert, reset;      /* of an output */
};

/* What a register of outputs shows, and what reset makes of it. */
struct latch {
    rtapi_u8 fixed;                     /* bits that no pin drives */
    int shown;                          /* value in the register; -1: not known yet */
    rtapi_u8 reset_mask, reset_value;   /* sampled by write */
    long long written;                  /* time of the last change, ns */
};

struct port {
    rtapi_parport_t io;
    enum mode mode;
    rtapi_u8 outputs[REGISTERS];        /* masks */
    struct pin pin[PINS];
    struct latch data, control;
    hal_uint_t reset_time;              /* ns */
    hal_uint_t debug1, debug2;
};

static int comp_id;
static int ports;
static struct port *port[MAX_PORTS];

/* ---- Cycle -------------------------------------------------------------- */

static void read_register(struct port *p, enum reg reg, rtapi_u8 value)
{
    int i;
    for(i = 0; i < PINS; i++) {
        if(wiring[i].reg != reg) continue;
        rtapi_bool on = (value & wiring[i].bit) != 0;
        hal_set_bool(p->pin[i].in, on);
        hal_set_bool(p->pin[i].in_not, !on);
    }
}

/* HAL function parport.N.read. */
static void read_port(void *arg, long period)
{
    struct port *p = arg;
    (void)period;
    read_register(p, STATUS, rtapi_parport_status_read(&p->io) ^ STATUS_INVERTED);
    if(!p->outputs[DATA]) read_register(p, DATA, rtapi_parport_data_read(&p->io));
    if(!p->outputs[CONTROL]) read_register(p, CONTROL, rtapi_parport_control_read(&p->io) ^ CONTROL_INVERTED);
}

static void put_data(struct port *p, rtapi_u8 value)
{
    rtapi_parport_data_write(&p->io, value);
    p->data.shown = value;
}

static void put_control(struct port *p, rtapi_u8 value)
{
    rtapi_parport_control_write(&p->io, value ^ CONTROL_INVERTED);
    p->control.shown = value;
}

/* What the pins of a register ask for; remembers what reset shall do. */
static rtapi_u8 gather(struct port *p, enum reg reg, struct latch *latch)
{
    rtapi_u8 value = latch->fixed;
    int i;
    latch->reset_mask = latch->reset_value = 0;
    for(i = 0; i < PINS; i++) {
        if(wiring[i].reg != reg) continue;
        rtapi_bool inverted = hal_get_bool(p->pin[i].invert);
        if(hal_get_bool(p->pin[i].out) != inverted) value |= wiring[i].bit;
        if(hal_get_bool(p->pin[i].reset)) latch->reset_mask |= wiring[i].bit;
        if(inverted) latch->reset_value |= wiring[i].bit;
    }
    latch->reset_value &= latch->reset_mask;
    return value;
}

/* HAL function parport.N.write: a register is written when it changes. */
static void write_port(void *arg, long period)
{
    struct port *p = arg;
    (void)period;
    if(p->outputs[DATA]) {
        rtapi_u8 value = gather(p, DATA, &p->data);
        if(p->data.shown != value) {
            put_data(p, value);
            p->data.written = rtapi_get_time();
        }
    }
    if(p->outputs[CONTROL]) {
        rtapi_u8 value = gather(p, CONTROL, &p->control);
        if(p->control.shown != value) {
            put_control(p, value);
            p->control.written = rtapi_get_time();
        }
    }
}

static void reset_register(struct port *p, struct latch *latch, rtapi_u32 width, void (*put)(struct port *, rtapi_u8))
{
    rtapi_u8 value;
    if(latch->shown < 0) return;        /* nothing was written yet */
    value = (rtapi_u8)((latch->shown & ~latch->reset_mask) | latch->reset_value);
    if(value == latch->shown) return;
    pulse_wait(latch->written, width);
    put(p, value);
}

/* HAL function parport.N.reset: ends the pulses that the last write began. */
static void reset_port(void *arg, long period)
{
    struct port *p = arg;
    rtapi_u32 width = pulse_width(p->reset_time, period);
    if(p->outputs[DATA]) reset_register(p, &p->data, width, put_data);
    if(p->outputs[CONTROL]) reset_register(p, &p->control, width, put_control);
}

static void read_all(void *arg, long period)
{
    int n;
    (void)arg;
    for(n = 0; n < ports; n++) read_port(port[n], period);
}

static void write_all(void *arg, long period)
{
    int n;
    (void)arg;
    for(n = 0; n < ports; n++) write_port(port[n], period);
}

/* ---- Start -------------------------------------------------------------- */

static int export_pin(struct port *p, int n, int i)
{
    int number = wiring[i].number;
    if(!(p->outputs[wiring[i].reg] & wiring[i].bit)) {
        COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &p->pin[i].in, 0, "parport.%d.pin-%02d-in", n, number));
        return hal_pin_new_bool(comp_id, HAL_OUT, &p->pin[i].in_not, 1, "parport.%d.pin-%02d-in-not", n, number);
    }
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &p->pin[i].out, 0, "parport.%d.pin-%02d-out", n, number));
    COMP_TRY(hal_param_new_bool(comp_id, HAL_RW, &p->pin[i].invert, 0, "parport.%d.pin-%02d-out-invert", n, number));
    return hal_param_new_bool(comp_id, HAL_RW, &p->pin[i].reset, 0, "parport.%d.pin-%02d-out-reset", n, number);
}

static int export_port(struct port *p, int n)
{
    int i;
    for(i = 0; i < PINS; i++) COMP_TRY(export_pin(p, n, i));
    COMP_TRY(hal_param_new_ui32(comp_id, HAL_RW, &p->reset_time, 0, "parport.%d.reset-time", n));
    if(p->outputs[DATA]) {
        COMP_TRY(hal_param_new_ui32(comp_id, HAL_RW, &p->debug1, 0, "parport.%d.debug1", n));
        COMP_TRY(hal_param_new_ui32(comp_id, HAL_RW, &p->debug2, 0, "parport.%d.debug2", n));
    }
    COMP_TRY(hal_export_functf(read_port, p, 0, 0, comp_id, "parport.%d.read", n));
    COMP_TRY(hal_export_functf(write_port, p, 0, 0, comp_id, "parport.%d.write", n));
    return hal_export_functf(reset_port, p, 0, 0, comp_id, "parport.%d.reset", n);
}

/* Puts the port into its mode: direction of the data pins, control pins released in mode x. */
static void prepare(struct port *p)
{
    p->data.shown = p->control.shown = -1;
    p->outputs[DATA] = p->mode == MODE_IN ? 0 : 0xFF;
    p->outputs[CONTROL] = p->mode == MODE_X ? 0 : CONTROL_PINS;
    p->control.fixed = p->mode == MODE_IN ? CONTROL_DATA_IN : 0;
    if(p->io.base_hi) {
        if(p->mode == MODE_EPP) rtapi_parport_ecr_write(&p->io, ECR_EPP);
        else if(p->mode != MODE_OUT) rtapi_parport_ecr_write(&p->io, ECR_PS2);
    }
    if(p->mode == MODE_IN) rtapi_parport_control_write(&p->io, CONTROL_DATA_IN ^ CONTROL_INVERTED);
    if(p->mode == MODE_X) rtapi_parport_control_write(&p->io, CONTROL_PINS ^ CONTROL_INVERTED);
}

static int add_port(unsigned short base, enum mode mode)
{
    struct port *p;
    if(ports == MAX_PORTS) {
        rtapi_print_msg(RTAPI_MSG_ERR, "PARPORT: ERROR: more than %d ports in cfg=\"%s\"\n", MAX_PORTS, cfg);
        return -EINVAL;
    }
    p = hal_malloc(sizeof *p);
    if(!p) return -ENOMEM;
    *p = (struct port){.mode = mode};
    COMP_TRY(hal_parport_get(comp_id, &p->io, base, 0, 0));
    prepare(p);
    port[ports++] = p;
    return export_port(p, ports - 1);
}

/* The next word of the text, which is separated by blanks or underlines, or NULL; *at moves behind it. */
static const char *next_word(const char **at, int *length)
{
    const char *word = *at + strspn(*at, " \t\n_");
    *length = (int)strcspn(word, " \t\n_");
    *at = word + *length;
    return *length ? word : NULL;
}

/* 0 and the mode, when the word names one. */
static int mode_of(const char *word, enum mode *mode)
{
    switch(word[0] | 0x20) {
    case 'i': *mode = MODE_IN; return 0;
    case 'o': *mode = MODE_OUT; return 0;
    case 'x': *mode = MODE_X; return 0;
    case 'e': *mode = MODE_EPP; return 0;
    default: return -EINVAL;
    }
}

/* Hexadecimal, with or without 0x. */
static int address_of(const char *word, int length, unsigned short *address)
{
    unsigned value = 0;
    int i = length > 2 && word[0] == '0' && (word[1] | 0x20) == 'x' ? 2 : 0;
    for(; i < length; i++) {
        int c = word[i] | 0x20;
        int digit = c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
        if(digit < 0 || value > 0xFFF) {
            rtapi_print_msg(
                RTAPI_MSG_ERR,
                "PARPORT: ERROR: '%.*s' in cfg=\"%s\" is not an address: use 0x378, 378, or the "
                "number of a Linux port\n",
                length, word, cfg);
            return -EINVAL;
        }
        value = value * 16 + (unsigned)digit;
    }
    *address = (unsigned short)value;
    return 0;
}

static int add_ports(void)
{
    const char *at = cfg, *word, *behind;
    int length;
    while((word = next_word(&at, &length))) {
        unsigned short base;
        enum mode mode = MODE_OUT;
        COMP_TRY(address_of(word, length, &base));
        behind = at;
        word = next_word(&behind, &length);
        if(word && mode_of(word, &mode) == 0) at = behind;
        COMP_TRY(add_port(base, mode));
    }
    if(ports == 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "PARPORT: ERROR: no ports configured\n");
        return -EINVAL;
    }
    COMP_TRY(hal_export_funct("parport.read-all", read_all, NULL, 0, 0, comp_id));
    return hal_export_funct("parport.write-all", write_all, NULL, 0, 0, comp_id);
}

static void release(void)
{
    int n;
    for(n = 0; n < ports; n++) hal_parport_release(&port[n]->io);
}

int rtapi_app_main(void)
{
    int r;
    comp_id = hal_init("hal_parport");
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
