/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * rcpwmgen.c - pulses for servos of models: a width in ms at a low rate.
 */
#include "hm2.h"

enum { WIDTH, RATE };

#define WIDEST 65535.0
#define QUIET_CYCLES 100               /* between two messages */

struct channel {
    hal_real_t width, scale, offset;
};

struct rcpwmgen {
    struct hm2_md md;
    int count, quiet;
    struct channel *channel;
    hal_real_t rate;
    rtapi_u32 rate_written;
    rtapi_u32 *width;
};

static int claim(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    static const struct hm2_item items[] = {
        HM2_ITEM(FLOAT, IN, channel, width, "width", 0),
        HM2_ITEM(FLOAT, IN, channel, scale, "scale", 1),
        HM2_ITEM(FLOAT, IN, channel, offset, "offset", 0),
    };
    static const struct hm2_item globals[] = {HM2_ITEM(FLOAT, IN, rcpwmgen, rate, "rate", 50)};
    int i, n = hm2_count(hm2, md, HM2_NUM_RCPWMGENS);
    COMP_TRY(n);
    if(*state || !n) return 0;
    struct rcpwmgen *s = *state = hal_malloc(sizeof *s);
    if(!s || !(s->channel = hal_malloc((long)sizeof *s->channel * n))) return -ENOMEM;
    s->md = *md;
    s->count = n;
    COMP_TRY(hm2_export(hm2, globals, 1, s, "rcpwmgen."));
    for(i = 0; i < n; i++)
        COMP_TRY(hm2_export(hm2, items, HM2_COUNT(items), &s->channel[i], "rcpwmgen.%02d.", i));
    s->width = hm2_write_region(hm2, hm2_register_addr(md, WIDTH, 0), n);
    if(!s->width) return -ENOMEM;
    hm2->instances[md->gtag] = (rtapi_u8)n;
    return n;
}

static void complain(struct hm2 *hm2, struct rcpwmgen *s, int i, const char *what)
{
    if(s->quiet > 0) return;
    s->quiet = QUIET_CYCLES;
    HM2_ERR(hm2, "rcpwmgen.%02d: %s\n", i, what);
}

static rtapi_u32 width_register(struct hm2 *hm2, struct rcpwmgen *s, int i)
{
    struct channel *c = &s->channel[i];
    if(hal_get_real(c->scale) == 0) {
        complain(hm2, s, i, "scale 0 is 1 now");
        hal_set_real(c->scale, 1);
    }
    double ms = hal_get_real(c->width) / hal_get_real(c->scale) + hal_get_real(c->offset);
    if(!(ms >= 0)) {
        complain(hm2, s, i, "a pulse cannot be shorter than 0: width is 0 now");
        hal_set_real(c->width, 0);
        ms = 0;
    }
    double reg = s->md.clock / 16000.0 * ms - 1;
    if(reg > WIDEST) complain(hm2, s, i, "the pulse is too long, it is cut");
    return (rtapi_u32)hm2_clip(reg, 0, WIDEST);
}

static void prepare(struct hm2 *hm2, void *state, long period)
{
    struct rcpwmgen *s = state;
    int i;
    (void)period;
    if(s->quiet > 0) s->quiet--;
    for(i = 0; i < s->count; i++) s->width[i] = width_register(hm2, s, i);
}

static void write_settings(struct hm2 *hm2, void *state, bool force)
{
    struct rcpwmgen *s = state;
    double hz = hal_get_real(s->rate), possible = hm2_clip(hz, 0.01, 1000);
    if(hz != possible) {
        hal_set_real(s->rate, possible);
        HM2_ERR(hm2, "rcpwmgen.rate is 0.01 to 1000 Hz: it is %g now\n", possible);
    }
    double reg = hm2_clip(s->md.clock / possible - 2, 0, 4294967295.0);
    hm2_write_changed(hm2, hm2_register_addr(&s->md, RATE, 0), (rtapi_u32)reg, &s->rate_written, force);
}

const struct hm2_function_ops hm2_rcpwmgen = {
    .gtag = {HM2_GTAG_RCPWMGEN},
    .claim = claim,
    .prepare = prepare,
    .write = write_settings,
};
