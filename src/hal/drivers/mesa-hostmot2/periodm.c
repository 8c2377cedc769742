/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * periodm.c - period, width and frequency of a signal.
 */
#include "hm2.h"

enum { MODE, PERIOD, WIDTH, LIMIT, REGISTERS };

#define POLARITY 1u
#define VALID 2u
#define INPUT 4u
#define MOST_AVERAGES 4095
#define LONGEST_FILTER 0xFFFF

struct channel {
    hal_real_t period_us, width_us, duty_cycle, frequency;
    hal_real_t duty_cycle_scale, duty_cycle_offset, filtertc_us, minimum_frequency;
    hal_uint_t averages;
    hal_bool_t invert, valid, input_status;
    rtapi_u32 mode, limit;             /* in the registers */
};

struct periodm {
    struct hm2_md md;
    int count;
    struct channel *channel;
    rtapi_u32 *mode, *period, *width;
};

static int claim(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    static const struct hm2_item items[] = {
        HM2_ITEM(FLOAT, OUT, channel, period_us, "period_us", 0),
        HM2_ITEM(FLOAT, OUT, channel, width_us, "width_us", 0),
        HM2_ITEM(FLOAT, OUT, channel, duty_cycle, "duty_cycle", 0),
        HM2_ITEM(FLOAT, OUT, channel, frequency, "frequency", 0),
        HM2_ITEM(FLOAT, IN, channel, duty_cycle_scale, "duty_cycle_scale", 100),
        HM2_ITEM(FLOAT, IN, channel, duty_cycle_offset, "duty_cycle_offset", 0),
        HM2_ITEM(FLOAT, IN, channel, filtertc_us, "filtertc_us", 1),
        HM2_ITEM(FLOAT, IN, channel, minimum_frequency, "minimum_frequency", 1),
        HM2_ITEM(U32, IO, channel, averages, "averages", 1),
        HM2_ITEM(BIT, IO, channel, invert, "invert", 0),
        HM2_ITEM(BIT, OUT, channel, valid, "valid", 0),
        HM2_ITEM(BIT, OUT, channel, input_status, "input_status", 0),
    };
    int i, n = hm2_count(hm2, md, HM2_NUM_PERIODMS);
    COMP_TRY(n);
    COMP_TRY(hm2_check_md(hm2, md, 0, REGISTERS, 4, 0xF));
    if(*state || !n) return 0;
    struct periodm *s = *state = hal_malloc(sizeof *s);
    if(!s || !(s->channel = hal_malloc((long)sizeof *s->channel * n))) return -ENOMEM;
    s->md = *md;
    s->count = n;
    for(i = 0; i < n; i++)
        COMP_TRY(hm2_export(hm2, items, HM2_COUNT(items), &s->channel[i], "periodm.%02d.", i));
    s->mode = hm2_read_region(hm2, hm2_register_addr(md, MODE, 0), n);
    s->period = hm2_read_region(hm2, hm2_register_addr(md, PERIOD, 0), n);
    s->width = hm2_read_region(hm2, hm2_register_addr(md, WIDTH, 0), n);
    if(!s->mode || !s->period || !s->width) return -ENOMEM;
    hm2->instances[md->gtag] = (rtapi_u8)n;
    return n;
}

static void process(struct hm2 *hm2, void *state, long period)
{
    struct periodm *s = state;
    int i;
    (void)hm2;
    (void)period;
    for(i = 0; i < s->count; i++) {
        struct channel *c = &s->channel[i];
        double averages = hal_get_ui32(c->averages) ? hal_get_ui32(c->averages) : 1, clock = s->md.clock;
        hal_set_bool(c->valid, s->mode[i] & VALID);
        hal_set_bool(c->input_status, s->mode[i] & INPUT);
        hal_set_real(c->period_us, s->period[i] / clock * 1e6 / averages);
        hal_set_real(c->width_us, s->width[i] / clock * 1e6 / averages);
        if(!s->period[i]) continue;
        hal_set_real(c->duty_cycle, (double)s->width[i] / s->period[i] * hal_get_real(c->duty_cycle_scale) +
                     hal_get_real(c->duty_cycle_offset));
        hal_set_real(c->frequency, averages * clock / s->period[i]);
    }
}

static void write_settings(struct hm2 *hm2, void *state, bool force)
{
    struct periodm *s = state;
    int i;
    for(i = 0; i < s->count; i++) {
        struct channel *c = &s->channel[i];
        rtapi_u32 averages = (rtapi_u32)hm2_clip(hal_get_ui32(c->averages), 1, MOST_AVERAGES);
        rtapi_u32 filter = (rtapi_u32)hm2_clip(hal_get_real(c->filtertc_us) * s->md.clock / 1e6, 0, LONGEST_FILTER);
        hal_set_ui32(c->averages, averages);
        double limit = s->md.clock / hal_get_real(c->minimum_frequency) * averages;
        if(!(limit >= 0 && limit <= 4294967295.0)) {
            hal_set_real(c->minimum_frequency, 0.025 * averages);
            limit = hm2_clip(s->md.clock / 0.025, 0, 4294967295.0);
            HM2_ERR(hm2, "periodm.%02d.minimum_frequency is too low, it is %g now\n", i, 0.025 * averages);
        }
        rtapi_u32 mode = (hal_get_bool(c->invert) ? POLARITY : 0) | (averages - 1) << 4 | filter << 16;
        hm2_write_changed(hm2, hm2_register_addr(&s->md, MODE, i), mode, &c->mode, force);
        hm2_write_changed(hm2, hm2_register_addr(&s->md, LIMIT, i), (rtapi_u32)limit, &c->limit, force);
    }
}

const struct hm2_function_ops hm2_periodm = {
    .gtag = {HM2_GTAG_PERIODM},
    .claim = claim,
    .process = process,
    .write = write_settings,
};
