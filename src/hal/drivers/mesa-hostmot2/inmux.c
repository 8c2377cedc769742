/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * inmux.c - filtered inputs, multiplexed (inmux) or not (inm), with four counters of hand wheels.
 */
#include "hm2.h"

enum { CONTROL, SLOW, FILTERED, RAW, MPG, REGISTERS };

#define BITS 32
#define WHEELS 4
#define CONTROL_INVERT 0x20u           /* always set */
#define MOST_DIVISOR 1023.0
#define MUX_RATE 5e6                   /* inputs per second */
#define PLAIN_RATE 1e7

struct input {
    hal_bool_t in, in_not, raw, raw_not, slow;
};

struct channel {
    hal_uint_t scan_rate, slow_scans, fast_scans, scan_width;
    struct input input[BITS];
    hal_bool_t mode4x[WHEELS], reset[WHEELS];
    hal_sint_t count[WHEELS];
    int width;
    rtapi_u32 wheels;                  /* counters as last seen */
    rtapi_u32 control, modes;          /* in the registers */
};

struct inmux {
    struct hm2_md md;
    int count;
    const char *name;
    double fastest;
    struct channel *channel;
    rtapi_u32 *slow, *filtered, *raw, *mpg;
};

/* Does input `bit` of an instance come out at a pin? All do where they are multiplexed. */
static bool has_pin(const struct hm2 *hm2, const struct inmux *s, int i, int bit)
{
    int k;
    if(s->md.gtag == HM2_GTAG_INMUX) return true;
    for(k = 0; k < hm2->pins; k++) {
        const struct hm2_pin *pin = &hm2->pin[k];
        if(pin->sec_tag == HM2_GTAG_INM && pin->sec_unit == i && (pin->sec_pin & 0x7F) == bit + 1) return true;
    }
    return false;
}

static int export_input(struct hm2 *hm2, struct inmux *s, int i, int bit)
{
    struct input *in = &s->channel[i].input[bit];
    const struct {
        hal_bool_t *ref;
        hal_pdir_t dir;
        const char *before, *behind;
    } pins[] = {
        {&in->in, HAL_OUT, "input", ""}, {&in->raw, HAL_OUT, "raw-input", ""}, {&in->in_not, HAL_OUT, "input", "-not"},
        {&in->raw_not, HAL_OUT, "raw-input", "-not"}, {&in->slow, HAL_IN, "input", "-slow"},
    };
    int k;
    for(k = 0; k < HM2_COUNT(pins); k++)
        COMP_TRY(hal_pin_new_bool(hm2->io->comp_id, pins[k].dir, pins[k].ref, 0, "%s.%s.%02d.%s-%02d%s", hm2->io->name,
                                  s->name, i, pins[k].before, bit, pins[k].behind));
    return 0;
}

static int export_wheel(struct hm2 *hm2, struct inmux *s, int i, int k)
{
    struct channel *c = &s->channel[i];
    int id = hm2->io->comp_id;
    const char *board = hm2->io->name;
    COMP_TRY(hal_param_new_bool(id, HAL_RW, &c->mode4x[k], 0, "%s.%s.%02d.enc%d_4xmode", board, s->name, i, k));
    COMP_TRY(hal_pin_new_si32(id, HAL_OUT, &c->count[k], 0, "%s.%s.%02d.enc%d-count", board, s->name, i, k));
    return hal_pin_new_bool(id, HAL_IN, &c->reset[k], 0, "%s.%s.%02d.enc%d-reset", board, s->name, i, k);
}

static int export_channel(struct hm2 *hm2, struct inmux *s, int i)
{
    static const struct hm2_item items[] = {
        HM2_ITEM(U32, RW, channel, scan_rate, "scan_rate", 20000),
        HM2_ITEM(U32, RW, channel, slow_scans, "slow_scans", 500),
        HM2_ITEM(U32, RW, channel, fast_scans, "fast_scans", 5),
        HM2_ITEM(U32, RO, channel, scan_width, "scan_width", 0),
    };
    struct channel *c = &s->channel[i];
    rtapi_u32 control;
    int k;
    if(!hm2_read_now(hm2, hm2_register_addr(&s->md, CONTROL, i), &control, sizeof control)) return -EIO;
    c->width = (int)(control & 0x1F) + 1;
    COMP_TRY(hm2_export(hm2, items, HM2_COUNT(items), c, "%s.%02d.", s->name, i));
    hal_set_ui32(c->scan_width, (rtapi_u32)c->width);
    for(k = 0; k < c->width; k++)
        if(has_pin(hm2, s, i, k)) COMP_TRY(export_input(hm2, s, i, k));
    for(k = 0; k < WHEELS; k++)
        if(has_pin(hm2, s, i, 2 * k) && has_pin(hm2, s, i, 2 * k + 1)) COMP_TRY(export_wheel(hm2, s, i, k));
    return 0;
}

static int claim_inputs(struct hm2 *hm2, const struct hm2_md *md, void **state, int n, double fastest)
{
    int i;
    COMP_TRY(n);
    if(*state || !n) return 0;
    struct inmux *s = *state = hal_malloc(sizeof *s);
    if(!s || !(s->channel = hal_malloc((long)sizeof *s->channel * n))) return -ENOMEM;
    s->md = *md;
    s->count = n;
    s->name = hm2_gtag_hal_name(md->gtag);
    s->fastest = fastest;
    for(i = 0; i < n; i++) COMP_TRY(export_channel(hm2, s, i));
    s->slow = hm2_write_region(hm2, hm2_register_addr(md, SLOW, 0), n);
    s->filtered = hm2_read_region(hm2, hm2_register_addr(md, FILTERED, 0), n);
    s->raw = hm2_read_region(hm2, hm2_register_addr(md, RAW, 0), n);
    s->mpg = hm2_read_region(hm2, hm2_register_addr(md, MPG, 0), n);
    if(!s->slow || !s->filtered || !s->raw || !s->mpg) return -ENOMEM;
    hm2->instances[md->gtag] = (rtapi_u8)n;
    return n;
}

static int claim_inmux(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    return claim_inputs(hm2, md, state, hm2_count(hm2, md, HM2_NUM_INMUXS), MUX_RATE);
}

static int claim_inm(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    return claim_inputs(hm2, md, state, hm2_count(hm2, md, HM2_NUM_INMS), PLAIN_RATE);
}

static void start(struct hm2 *hm2, void *state)
{
    struct inmux *s = state;
    int i;
    (void)hm2;
    for(i = 0; i < s->count; i++) s->channel[i].wheels = s->mpg[i];
}

static void process_channel(struct channel *c, rtapi_u32 filtered, rtapi_u32 raw, rtapi_u32 wheels)
{
    int k;
    for(k = 0; k < c->width; k++) {
        struct input *in = &c->input[k];
        if(!in->in) continue;
        hal_set_bool(in->in, filtered >> k & 1);
        hal_set_bool(in->in_not, !(filtered >> k & 1));
        hal_set_bool(in->raw, raw >> k & 1);
        hal_set_bool(in->raw_not, !(raw >> k & 1));
    }
    for(k = 0; k < WHEELS; k++) {
        if(!c->count[k]) continue;
        rtapi_s32 step = (rtapi_s8)((wheels >> 8 * k) - (c->wheels >> 8 * k));
        rtapi_s32 count = (rtapi_s32)((rtapi_u32)hal_get_si32(c->count[k]) + (rtapi_u32)step);
        hal_set_si32(c->count[k], hal_get_bool(c->reset[k]) ? 0 : count);
    }
    c->wheels = wheels;
}

static void process(struct hm2 *hm2, void *state, long period)
{
    struct inmux *s = state;
    int i;
    (void)hm2;
    (void)period;
    for(i = 0; i < s->count; i++) process_channel(&s->channel[i], s->filtered[i], s->raw[i], s->mpg[i]);
}

static void prepare(struct hm2 *hm2, void *state, long period)
{
    struct inmux *s = state;
    int i, k;
    (void)hm2;
    (void)period;
    for(i = 0; i < s->count; i++) {
        struct channel *c = &s->channel[i];
        s->slow[i] = 0;
        for(k = 0; k < c->width; k++)
            if(c->input[k].slow && hal_get_bool(c->input[k].slow)) s->slow[i] |= 1u << k;
    }
}

/* Scans per second that the clock can do, and how many of them the filters take. */
static rtapi_u32 control_register(struct hm2 *hm2, const struct inmux *s, int i)
{
    struct channel *c = &s->channel[i];
    double clock = s->md.clock, rate = hal_get_ui32(c->scan_rate);
    double slowest = clock / (4 * (MOST_DIVISOR + 1)) / c->width, fastest = s->fastest / c->width;
    double possible = hm2_clip(rate, ceil(slowest), floor(fastest));
    rtapi_u32 fast = (rtapi_u32)hm2_clip(hal_get_ui32(c->fast_scans), 1, 63);
    rtapi_u32 slow = (rtapi_u32)hm2_clip(hal_get_ui32(c->slow_scans), 1, 1023);
    if(possible != rate) {
        hal_set_ui32(c->scan_rate, (rtapi_u32)possible);
        HM2_ERR(hm2, "%s.%02d.scan_rate %g cannot be had, it is %g now\n", s->name, i, rate, possible);
    }
    hal_set_ui32(c->fast_scans, fast);
    hal_set_ui32(c->slow_scans, slow);
    double divisor = hm2_clip(clock / (4 * possible * c->width) - 1, 0, MOST_DIVISOR);
    return CONTROL_INVERT | (rtapi_u32)divisor << 6 | fast << 16 | slow << 22;
}

static void write_settings(struct hm2 *hm2, void *state, bool force)
{
    struct inmux *s = state;
    int i, k;
    for(i = 0; i < s->count; i++) {
        struct channel *c = &s->channel[i];
        rtapi_u32 modes = 0;
        for(k = 0; k < WHEELS; k++)
            if(c->mode4x[k] && hal_get_bool(c->mode4x[k])) modes |= 1u << 8 * k;
        hm2_write_changed(hm2, hm2_register_addr(&s->md, CONTROL, i), control_register(hm2, s, i), &c->control, force);
        hm2_write_changed(hm2, hm2_register_addr(&s->md, MPG, i), modes, &c->modes, force);
    }
}

const struct hm2_function_ops hm2_inmux = {
    .gtag = {HM2_GTAG_INMUX},
    .claim = claim_inmux,
    .start = start,
    .process = process,
    .prepare = prepare,
    .write = write_settings,
};

const struct hm2_function_ops hm2_inm = {
    .gtag = {HM2_GTAG_INM},
    .claim = claim_inm,
    .start = start,
    .process = process,
    .prepare = prepare,
    .write = write_settings,
};
