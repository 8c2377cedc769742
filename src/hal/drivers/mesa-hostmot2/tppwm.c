/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * tppwm.c - PWM for motors with three phases (3pwmgen): three pulses with a dead time, and a fault
 * input that ends them.
 */
#include "hm2.h"

enum { VALUE, ENABLE, SETUP, RATE, REGISTERS };

#define ENABLED 1u
#define FAULT 2u
#define SETUP_FAULT_POLARITY 0x8000u
#define HALF 511.0
#define MIDDLE 512.0
#define LONGEST_DEADTIME 511

struct channel {
    hal_real_t a, b, c, scale, deadtime, sample_time;
    hal_bool_t enable, fault, fault_invert;
    rtapi_u32 setup;                   /* in the register */
};

struct tppwm {
    struct hm2_md md;
    int count;
    struct channel *channel;
    hal_uint_t frequency;
    rtapi_u32 frequency_known, dds, dds_written;
    rtapi_u32 *value, *enable;         /* as written; as read */
};

static int claim(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    static const struct hm2_item items[] = {
        HM2_ITEM(FLOAT, IN, channel, a, "A-value", 0),
        HM2_ITEM(FLOAT, IN, channel, b, "B-value", 0),
        HM2_ITEM(FLOAT, IN, channel, c, "C-value", 0),
        HM2_ITEM(BIT, IN, channel, enable, "enable", 0),
        HM2_ITEM(BIT, OUT, channel, fault, "fault", 0),
        HM2_ITEM(FLOAT, RW, channel, scale, "scale", 1),
        HM2_ITEM(FLOAT, RW, channel, deadtime, "deadtime", 5000),
        HM2_ITEM(BIT, RW, channel, fault_invert, "fault-invert", 0),
        HM2_ITEM(FLOAT, RW, channel, sample_time, "sample-time", 0.5),
    };
    static const struct hm2_item globals[] = {HM2_ITEM(U32, RW, tppwm, frequency, "frequency", 20000)};
    int i, n = hm2_count(hm2, md, HM2_NUM_TPPWMGENS);
    COMP_TRY(n);
    COMP_TRY(hm2_check_md(hm2, md, 0, REGISTERS, 4, 0x3));
    if(*state || !n) return 0;
    struct tppwm *s = *state = hal_malloc(sizeof *s);
    if(!s || !(s->channel = hal_malloc((long)sizeof *s->channel * n))) return -ENOMEM;
    s->md = *md;
    s->count = n;
    COMP_TRY(hm2_export(hm2, globals, 1, s, "3pwmgen."));
    for(i = 0; i < n; i++)
        COMP_TRY(hm2_export(hm2, items, HM2_COUNT(items), &s->channel[i], "3pwmgen.%02d.", i));
    s->value = hm2_write_region(hm2, hm2_register_addr(md, VALUE, 0), n);
    s->enable = hm2_read_region(hm2, hm2_register_addr(md, ENABLE, 0), n);
    if(!s->value || !s->enable) return -ENOMEM;
    hm2->instances[md->gtag] = (rtapi_u8)n;
    return n;
}

static void process(struct hm2 *hm2, void *state, long period)
{
    struct tppwm *s = state;
    int i;
    (void)hm2;
    (void)period;
    for(i = 0; i < s->count; i++) hal_set_bool(s->channel[i].fault, s->enable[i] & FAULT);
}

static rtapi_u32 phase(hal_real_t value, double scale)
{
    double share = hm2_clip(hal_get_real(value) / scale, -1, 1);
    return (rtapi_u32)(share * HALF + MIDDLE);
}

static void prepare(struct hm2 *hm2, void *state, long period)
{
    struct tppwm *s = state;
    int i;
    (void)hm2;
    (void)period;
    for(i = 0; i < s->count; i++) {
        struct channel *c = &s->channel[i];
        if(hal_get_real(c->scale) == 0) hal_set_real(c->scale, 1);
        double scale = hal_get_real(c->scale);
        s->value[i] = phase(c->c, scale) << 20 | phase(c->b, scale) << 10 | phase(c->a, scale);
    }
}

static void follow_frequency(struct hm2 *hm2, struct tppwm *s)
{
    rtapi_u32 hz = hal_get_ui32(s->frequency);
    if(hz == s->frequency_known && s->dds) return;
    double dds = hz * 65536.0 * 2048 / s->md.clock;
    s->dds = dds < 1 ? 1 : dds > 65535 ? 65535 : (rtapi_u32)dds;
    s->frequency_known = hz;
    if(dds >= 1 && dds <= 65535) return;
    s->frequency_known = hal_set_ui32(s->frequency, (rtapi_u32)((double)s->dds * s->md.clock / (65536.0 * 2048)));
    HM2_ERR(hm2, "3pwmgen.frequency %u Hz cannot be had, it is %u Hz now\n", hz, s->frequency_known);
}

static rtapi_u32 setup_register(struct hm2 *hm2, struct tppwm *s, int i)
{
    struct channel *c = &s->channel[i];
    double clocks_per_ns = (double)s->md.clock * s->dds / (2 * 65536 * 1e9);
    double dead = hal_get_real(c->deadtime) * clocks_per_ns;
    if(!(dead >= 0 && dead <= LONGEST_DEADTIME)) {
        dead = dead > LONGEST_DEADTIME ? LONGEST_DEADTIME : 0;
        hal_set_real(c->deadtime, dead / clocks_per_ns);
        HM2_ERR(hm2, "3pwmgen.%02d.deadtime cannot be had, it is %g ns now\n", i, dead / clocks_per_ns);
    }
    double sample = hm2_clip(hal_get_real(c->sample_time), 0, 1);
    hal_set_real(c->sample_time, sample);
    return (rtapi_u32)(sample * 1023) << 16 | (hal_get_bool(c->fault_invert) ? SETUP_FAULT_POLARITY : 0) |
           (rtapi_u32)dead;
}

/* An enable that the board does not show is asked for again, also after a fault took it away. */
static void write_settings(struct hm2 *hm2, void *state, bool force)
{
    struct tppwm *s = state;
    int i;
    follow_frequency(hm2, s);
    hm2_write_changed(hm2, hm2_register_addr(&s->md, RATE, 0), s->dds, &s->dds_written, force);
    for(i = 0; i < s->count; i++) {
        struct channel *c = &s->channel[i];
        rtapi_u32 enable = hal_get_bool(c->enable) ? ENABLED : 0;
        hm2_write_changed(hm2, hm2_register_addr(&s->md, SETUP, i), setup_register(hm2, s, i), &c->setup, force);
        if(force || enable != (s->enable[i] & ENABLED))
            hm2_queue_write(hm2, hm2_register_addr(&s->md, ENABLE, i), enable);
    }
}

const struct hm2_function_ops hm2_tppwm = {
    .gtag = {HM2_GTAG_TPPWM},
    .claim = claim,
    .process = process,
    .prepare = prepare,
    .write = write_settings,
};
