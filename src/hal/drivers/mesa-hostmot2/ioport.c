/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * ioport.c - pins as bits, and the registers that say which way each of them goes.
 *
 * Every pin can be read. A pin that no function owns can be written too; an output of a function can
 * be inverted and made open drain. Registers have a bit for each pin of a port.
 */
#include "hm2.h"

enum { DATA, DDR, ALT_SOURCE, OPEN_DRAIN, INVERT, REGISTERS };

struct port {
    rtapi_u32 written[REGISTERS];
};

struct ioport {
    struct hm2_md md;
    int ports, width;
    rtapi_u32 *in, *out;               /* data, as read and as written */
    struct port port[HM2_MAX_CONNECTORS];
};

static int claim(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    struct ioport *s;
    COMP_TRY(hm2_check_md(hm2, md, 0, REGISTERS, 4, 0x1F));
    if(*state || md->instances != hm2->idrom.ports) {
        HM2_ERR(hm2, "IDROM IOPorts is %u, but there are %d IOPort instances: inconsistent firmware\n",
                hm2->idrom.ports, md->instances);
        return -EINVAL;
    }
    s = *state = hal_malloc(sizeof *s);
    if(!s) return -ENOMEM;
    s->md = *md;
    s->ports = md->instances;
    s->width = (int)hm2->idrom.port_width;
    s->in = hm2_read_region(hm2, hm2_register_addr(md, DATA, 0), s->ports);
    s->out = hm2_write_region(hm2, hm2_register_addr(md, DATA, 0), s->ports);
    if(!s->in || !s->out) return -ENOMEM;
    hm2->instances[md->gtag] = md->instances;
    return s->ports;
}

static void show_input(struct hm2_pin *pin, bool on)
{
    hal_set_bool(pin->in, on);
    hal_set_bool(pin->in_not, !on);
}

static void process(struct hm2 *hm2, void *state, long period)
{
    struct ioport *s = state;
    int i;
    (void)period;
    for(i = 0; i < hm2->pins; i++) show_input(&hm2->pin[i], s->in[i / s->width] >> i % s->width & 1);
}

static void start(struct hm2 *hm2, void *state)
{
    process(hm2, state, 0);
}

static void prepare(struct hm2 *hm2, void *state, long period)
{
    struct ioport *s = state;
    int i, p;
    (void)period;
    /* Whole words: the other thread may be writing them to the board. */
    for(p = 0; p < s->ports; p++) {
        const struct hm2_pin *pin = &hm2->pin[p * s->width];
        rtapi_u32 word = 0;
        for(i = 0; i < s->width; i++)
            if(pin[i].out && hal_get_bool(pin[i].out)) word |= 1u << i;
        s->out[p] = word;
    }
}

/* A pin's bits of the registers; invert stays as it was while the pin is an input. */
static void settings_of_pin(struct hm2_pin *pin, rtapi_u32 bit, rtapi_u32 now[REGISTERS])
{
    if(pin->owner == HM2_GTAG_IOPORT) pin->output = pin->is_output && hal_get_bool(pin->is_output);
    else now[ALT_SOURCE] |= bit;
    if(!pin->output) return;
    now[DDR] |= bit;
    if(pin->opendrain && hal_get_bool(pin->opendrain)) now[OPEN_DRAIN] |= bit;
    now[INVERT] &= ~bit;
    if(pin->invert && hal_get_bool(pin->invert)) now[INVERT] |= bit;
}

static void write_port(struct hm2 *hm2, struct ioport *s, int p, bool force)
{
    /* A pin drives last of all, when it is known how. Everything at once has its own order. */
    static const int order_changed[] = {OPEN_DRAIN, INVERT, DDR, ALT_SOURCE};
    static const int order_forced[] = {INVERT, OPEN_DRAIN, ALT_SOURCE, DDR};
    const int *order = force ? order_forced : order_changed;
    struct port *port = &s->port[p];
    rtapi_u32 now[REGISTERS] = {0};
    int i;
    now[INVERT] = port->written[INVERT];
    for(i = 0; i < s->width; i++) settings_of_pin(&hm2->pin[p * s->width + i], 1u << i, now);
    for(i = 0; i < REGISTERS - 1; i++)
        hm2_write_changed(hm2, hm2_register_addr(&s->md, order[i], p), now[order[i]], &port->written[order[i]], force);
}

static void write_settings(struct hm2 *hm2, void *state, bool force)
{
    struct ioport *s = state;
    int p;
    for(p = 0; p < s->ports; p++) write_port(hm2, s, p, force);
}

static void print(struct hm2 *hm2, void *state)
{
    struct ioport *s = state;
    int p;
    for(p = 0; p < s->ports; p++)
        HM2_PRINT(hm2, "IOPort %d: in 0x%08X out 0x%08X ddr 0x%08X alt_source 0x%08X open_drain 0x%08X invert 0x%08X\n",
                  p, s->in[p], s->out[p], s->port[p].written[DDR], s->port[p].written[ALT_SOURCE],
                  s->port[p].written[OPEN_DRAIN], s->port[p].written[INVERT]);
}

const struct hm2_function_ops hm2_ioport = {
    .gtag = {HM2_GTAG_IOPORT},
    .claim = claim,
    .start = start,
    .process = process,
    .prepare = prepare,
    .write = write_settings,
    .print = print,
};

/* ---- The faster thread's own transfers ------------------------------------- */

void hm2_ioport_read_gpio(struct hm2 *hm2)
{
    struct ioport *s = hm2_state(hm2, &hm2_ioport);
    rtapi_u32 data[HM2_MAX_CONNECTORS];
    int i;
    if(!s || !hm2->io->ops->read(hm2->io, hm2_register_addr(&s->md, DATA, 0), data, s->ports * 4)) return;
    for(i = 0; i < hm2->pins; i++)
        if(!hm2->pin[i].output) show_input(&hm2->pin[i], data[i / s->width] >> i % s->width & 1);
}

void hm2_ioport_write_gpio(struct hm2 *hm2)
{
    struct ioport *s = hm2_state(hm2, &hm2_ioport);
    if(!s) return;
    prepare(hm2, s, 0);
    hm2->io->ops->write(hm2->io, hm2_register_addr(&s->md, DATA, 0), s->out, s->ports * 4);
    write_settings(hm2, s, false);
    void *watchdog = hm2_state(hm2, &hm2_watchdog);
    if(watchdog) hm2_watchdog.write(hm2, watchdog, false);
}
