/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * bits.c - modules that are only bits on pins of the board: solid-state relays (ssr) with the rate
 * of their drive, and outputs (outm).
 */
#include "hm2.h"

enum { DATA, RATE };

#define BITS 31
#define RATE_ENABLE 0x1000u
#define MOST_DIVISOR 0xFFF
#define SLOWEST 25e3                   /* Hz */
#define FASTEST 25e6

struct channel {
    hal_bool_t out[BITS], invert[BITS];
    hal_uint_t rate;
    rtapi_u32 rate_written;
};

struct bits {
    struct hm2_md md;
    int count;
    bool has_rate;
    struct channel *channel;
    rtapi_u32 *data;
};

static int export_bit(struct hm2 *hm2, struct channel *c, const char *name, int i, int bit)
{
    int id = hm2->io->comp_id;
    const char *board = hm2->io->name;
    if(c->out[bit]) return 0;
    COMP_TRY(hal_pin_new_bool(id, HAL_IN, &c->out[bit], 0, "%s.%s.%02d.out-%02d", board, name, i, bit));
    return hal_pin_new_bool(id, HAL_IN, &c->invert[bit], 0, "%s.%s.%02d.invert-%02d", board, name, i, bit);
}

static int claim_bits(struct hm2 *hm2, const struct hm2_md *md, void **state, int n, bool has_rate)
{
    static const struct hm2_item rate[] = {HM2_ITEM(U32, IN, channel, rate, "rate", 1000000)};
    const char *name = hm2_gtag_hal_name(md->gtag);
    int i;
    COMP_TRY(n);
    if(*state || !n) return 0;
    struct bits *s = *state = hal_malloc(sizeof *s);
    if(!s || !(s->channel = hal_malloc((long)sizeof *s->channel * n))) return -ENOMEM;
    s->md = *md;
    s->count = n;
    s->has_rate = has_rate;
    for(i = 0; has_rate && i < n; i++) COMP_TRY(hm2_export(hm2, rate, 1, &s->channel[i], "%s.%02d.", name, i));
    for(i = 0; i < hm2->pins; i++) {
        const struct hm2_pin *pin = &hm2->pin[i];
        int code = pin->sec_pin & 0x7F;
        if(pin->sec_tag == md->gtag && pin->sec_unit < n && code >= 1 && code <= BITS)
            COMP_TRY(export_bit(hm2, &s->channel[pin->sec_unit], name, pin->sec_unit, code - 1));
    }
    s->data = hm2_write_region(hm2, hm2_register_addr(md, DATA, 0), n);
    if(!s->data) return -ENOMEM;
    hm2->instances[md->gtag] = (rtapi_u8)n;
    return n;
}

static int claim_ssr(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    return claim_bits(hm2, md, state, hm2_count(hm2, md, HM2_NUM_SSRS), true);
}

static int claim_outm(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    return claim_bits(hm2, md, state, hm2_count(hm2, md, HM2_NUM_OUTMS), false);
}

static void prepare(struct hm2 *hm2, void *state, long period)
{
    struct bits *s = state;
    int i, k;
    (void)hm2;
    (void)period;
    for(i = 0; i < s->count; i++) {
        struct channel *c = &s->channel[i];
        s->data[i] = 0;
        for(k = 0; k < BITS; k++)
            if(c->out[k] && hal_get_bool(c->out[k]) != hal_get_bool(c->invert[k])) s->data[i] |= 1u << k;
    }
}

/* Nothing is driven before the pins' directions are set. */
static void write_rates(struct hm2 *hm2, void *state, bool force)
{
    struct bits *s = state;
    int i;
    for(i = 0; i < s->count; i++) {
        struct channel *c = &s->channel[i];
        rtapi_u32 hz = hal_get_ui32(c->rate), reg = 0;
        if(hz) {
            double possible = hm2_clip(hz, SLOWEST, FASTEST);
            if(possible != hz) {
                hal_set_ui32(c->rate, (rtapi_u32)possible);
                HM2_ERR(hm2, "ssr.%02d.rate is 25 kHz to 25 MHz, or 0: it is %g now\n", i, possible);
            }
            reg = RATE_ENABLE | (rtapi_u32)hm2_clip(s->md.clock / (2 * possible) - 2, 0, MOST_DIVISOR);
        }
        if(!hm2->written) reg = 0;
        hm2_write_changed(hm2, hm2_register_addr(&s->md, RATE, i), reg, &c->rate_written, force);
    }
}

const struct hm2_function_ops hm2_ssr = {
    .gtag = {HM2_GTAG_SSR},
    .claim = claim_ssr,
    .prepare = prepare,
    .write = write_rates,
};

const struct hm2_function_ops hm2_outm = {
    .gtag = {HM2_GTAG_OUTM},
    .claim = claim_outm,
    .prepare = prepare,
};
