/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * oneshot.c - pulses of a set width after a trigger, two in each module.
 */
#include "hm2.h"

enum { WIDTH1, WIDTH2, FILTER1, FILTER2, RATE, CONTROL, REGISTERS };

#define WIDEST 0x7FFFFFFF
#define LONGEST_FILTER 0xFFFFFF
#define MOST_SELECT 7

/* Bits of the control register that a half has, at 0 and at 16. */
enum { RISE = 3, FALL, RETRIGGER, ENABLE, RESET, OUT, EXTERNAL, SOFTWARE };

struct half {
    hal_real_t width, filter;
    hal_uint_t select;
    hal_bool_t rise, fall, retriggerable, enable, reset, software, external, out;
};

struct channel {
    struct half half[2];
    hal_real_t rate;
    hal_sint_t timer;
};

struct oneshot {
    struct hm2_md md;
    int count;
    struct channel *channel;
    rtapi_u32 *write[REGISTERS], *control;
};

static int export_half(struct hm2 *hm2, struct half *h, int i, int k)
{
    int id = hm2->io->comp_id, n = k + 1;
    const char *board = hm2->io->name;
    const struct {
        hal_bool_t *ref;
        hal_pdir_t dir;
        const char *name;
    } bits[] = {
        {&h->rise, HAL_IN, "trigger_on_rise"}, {&h->fall, HAL_IN, "trigger_on_fall"},
        {&h->retriggerable, HAL_IN, "retriggerable"}, {&h->enable, HAL_IN, "enable"}, {&h->reset, HAL_IN, "reset"},
        {&h->software, HAL_IN, "swtrigger"}, {&h->external, HAL_OUT, "exttrigger"}, {&h->out, HAL_OUT, "out"},
    };
    int b;
    COMP_TRY(hal_pin_new_real(id, HAL_IN, &h->width, 1, "%s.oneshot.%02d.width%d", board, i, n));
    COMP_TRY(hal_pin_new_real(id, HAL_IN, &h->filter, 0.1, "%s.oneshot.%02d.filter%d", board, i, n));
    COMP_TRY(hal_pin_new_ui32(id, HAL_IN, &h->select, 0, "%s.oneshot.%02d.trigger_select%d", board, i, n));
    for(b = 0; b < HM2_COUNT(bits); b++)
        COMP_TRY(hal_pin_new_bool(id, bits[b].dir, bits[b].ref, 0, "%s.oneshot.%02d.%s%d", board, i, bits[b].name, n));
    return 0;
}

static int claim(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    static const struct hm2_item items[] = {
        HM2_ITEM(FLOAT, IN, channel, rate, "rate", 1000),
        HM2_ITEM(S32, IN, channel, timer, "dpll_timer_number", 0),
    };
    int i, k, n = hm2_count(hm2, md, HM2_NUM_ONESHOTS);
    COMP_TRY(n);
    COMP_TRY(hm2_check_md(hm2, md, 0, REGISTERS, 4, 0x3F));
    if(*state || !n) return 0;
    struct oneshot *s = *state = hal_malloc(sizeof *s);
    if(!s || !(s->channel = hal_malloc((long)sizeof *s->channel * n))) return -ENOMEM;
    s->md = *md;
    s->count = n;
    for(i = 0; i < n; i++) {
        for(k = 0; k < 2; k++) COMP_TRY(export_half(hm2, &s->channel[i].half[k], i, k));
        COMP_TRY(hm2_export(hm2, items, HM2_COUNT(items), &s->channel[i], "oneshot.%02d.", i));
    }
    for(k = 0; k < REGISTERS; k++)
        if(!(s->write[k] = hm2_write_region(hm2, hm2_register_addr(md, k, 0), n))) return -ENOMEM;
    if(!(s->control = hm2_read_region(hm2, hm2_register_addr(md, CONTROL, 0), n))) return -ENOMEM;
    hm2->instances[md->gtag] = (rtapi_u8)n;
    return n;
}

static void process(struct hm2 *hm2, void *state, long period)
{
    struct oneshot *s = state;
    int i, k;
    (void)hm2;
    (void)period;
    for(i = 0; i < s->count; i++)
        for(k = 0; k < 2; k++) {
            struct half *h = &s->channel[i].half[k];
            rtapi_u32 control = s->control[i] >> 16 * k;
            hal_set_bool(h->out, control >> OUT & 1);
            hal_set_bool(h->external, control >> EXTERNAL & 1);
        }
}

static rtapi_u32 half_bits(struct half *h)
{
    rtapi_u32 select = hal_get_ui32(h->select);
    if(select > MOST_SELECT) select = hal_set_ui32(h->select, 0);
    return select | (rtapi_u32)hal_get_bool(h->rise) << RISE | (rtapi_u32)hal_get_bool(h->fall) << FALL |
           (rtapi_u32)hal_get_bool(h->retriggerable) << RETRIGGER | (rtapi_u32)hal_get_bool(h->enable) << ENABLE |
           (rtapi_u32)hal_get_bool(h->reset) << RESET | (rtapi_u32)hal_get_bool(h->software) << SOFTWARE;
}

static void prepare(struct hm2 *hm2, void *state, long period)
{
    struct oneshot *s = state;
    double per_ms = s->md.clock / 1e3;
    int i, k;
    (void)hm2;
    (void)period;
    for(i = 0; i < s->count; i++) {
        struct channel *c = &s->channel[i];
        rtapi_u32 timer = (rtapi_u32)hal_get_si32(c->timer) & 7;
        for(k = 0; k < 2; k++) {
            struct half *h = &c->half[k];
            s->write[WIDTH1 + k][i] = (rtapi_u32)hm2_clip(hal_get_real(h->width) * per_ms, 0, WIDEST);
            s->write[FILTER1 + k][i] = (rtapi_u32)hm2_clip(hal_get_real(h->filter) * per_ms, 0, LONGEST_FILTER);
        }
        s->write[RATE][i] = (rtapi_u32)hm2_clip(hal_get_real(c->rate) * 4294967296.0 / s->md.clock, 0, 4294967295.0);
        s->write[CONTROL][i] = half_bits(&c->half[0]) | timer << 12 | half_bits(&c->half[1]) << 16;
    }
}

const struct hm2_function_ops hm2_oneshot = {
    .gtag = {HM2_GTAG_ONESHOT},
    .claim = claim,
    .process = process,
    .prepare = prepare,
};
