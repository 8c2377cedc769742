/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * encoder.c - counters of encoders, each with its own inputs or two on one (muxed).
 *
 * Counts are 64 bits wide inside: 16 bits of the board, extended in each cycle. The time stamp of a
 * count's last change gives speeds far below one count per cycle; stamps too are made wide, so that
 * the time between two counts is exact over any number of turns of the 16-bit clock.
 */
#include "hm2.h"

enum { COUNTER, CONTROL, TS_DIVISOR, TS_COUNT, FILTER, TIMER, REGISTERS = 5 };

#define ON_INPUT_A 0x0001u
#define ON_INPUT_B 0x0002u
#define ON_INPUT_INDEX 0x0004u
#define INDEX_POLARITY 0x0008u
#define LATCH_ON_INDEX 0x0010u
#define LATCH_ONCE 0x0040u
#define MASK_POLARITY 0x0100u
#define USE_MASK 0x0200u
#define COUNT_UP_DOWN 0x0400u
#define LONG_FILTER 0x0800u
#define PROBE_POLARITY 0x1000u
#define LATCH_ON_PROBE 0x2000u
#define QUAD_ERROR 0x8000u

#define VERSION_PROBE 0x80
#define SLOW_TICKS 2e6                 /* per second */
#define FAST_TICKS 1e7
#define AHEAD 0xFF00u                  /* a stamp that is newer than the clock read before it */

struct channel {
    hal_sint_t rawcounts, rawlatch, count, count_latched;
    hal_real_t position, position_interpolated, position_latched, velocity, velocity_rpm;
    hal_bool_t reset, index_enable, no_clear_on_index, probe_enable, probe_invert;
    hal_bool_t quad_error, quad_error_enable, input_a, input_b, input_index;
    hal_real_t scale, vel_timeout;
    hal_bool_t index_invert, index_mask, index_mask_invert, counter_mode, filter;

    rtapi_s64 raw, zero, latch;        /* counts */
    rtapi_s64 event_raw, event_ticks;  /* last change of the count: its value, and when */
    rtapi_s64 last_step;               /* counts of the change before */
    double speed;                      /* units/s */
    bool moving, quad_error_armed;
    rtapi_u32 control;                 /* in the register */
};

struct encoder {
    struct hm2_md md;
    int count;
    bool probe, skews, muxed, has_timer;
    struct channel *channel;
    hal_uint_t sample_frequency, skew;
    hal_sint_t timer_number;
    hal_bool_t hires_timestamp;
    rtapi_u32 frequency_known, skew_known, filter_reg, divisor_reg, timer_reg;
    rtapi_s64 ticks;                   /* the board's clock of stamps */
    rtapi_u32 *clock, *counter, *latch; /* as read */
};

/* ---- Registration --------------------------------------------------------- */

static int check(struct hm2 *hm2, const struct hm2_md *md)
{
    bool muxed = md->gtag == HM2_GTAG_MUXED_ENCODER;
    int v = md->version;
    bool known = muxed ? v == 2 || v == 3 || v == 4 || v == 0x84 : v == 1 || v == 2 || v == 3 || v == 0x83;
    if(known && v == (muxed ? 2 : 1))
        HM2_WARN(hm2, "this firmware has %s v%d, which misses some index pulses: write a newer firmware to the board\n",
                 hm2_gtag_name(md->gtag), v);
    return hm2_check_md(hm2, md, known ? -1 : 3, REGISTERS, 4, 0x3);
}

static int export_globals(struct hm2 *hm2, struct encoder *s)
{
    static const struct hm2_item plain[] = {HM2_ITEM(U32, IN, encoder, sample_frequency, "sample-frequency", 25000000)};
    static const struct hm2_item muxed[] = {
        HM2_ITEM(U32, IN, encoder, sample_frequency, "muxed-sample-frequency", 8000000)};
    static const struct hm2_item skew[] = {HM2_ITEM(U32, IN, encoder, skew, "muxed-skew", 0)};
    static const struct hm2_item timer[] = {HM2_ITEM(S32, IN, encoder, timer_number, "timer-number", -1)};
    static const struct hm2_item always[] = {HM2_ITEM(BIT, IN, encoder, hires_timestamp, "hires-timestamp", 0)};
    COMP_TRY(hm2_export(hm2, s->muxed ? muxed : plain, 1, s, "encoder."));
    if(s->skews) COMP_TRY(hm2_export(hm2, skew, 1, s, "encoder."));
    if(s->has_timer) COMP_TRY(hm2_export(hm2, timer, 1, s, "encoder."));
    return hm2_export(hm2, always, 1, s, "encoder.");
}

static int export_channel(struct hm2 *hm2, struct encoder *s, int i)
{
    static const struct hm2_item items[] = {
        HM2_ITEM(S32, OUT, channel, rawcounts, "rawcounts", 0),
        HM2_ITEM(S32, OUT, channel, rawlatch, "rawlatch", 0),
        HM2_ITEM(S32, OUT, channel, count, "count", 0),
        HM2_ITEM(S32, OUT, channel, count_latched, "count-latched", 0),
        HM2_ITEM(FLOAT, OUT, channel, position, "position", 0),
        HM2_ITEM(FLOAT, OUT, channel, position_interpolated, "position-interpolated", 0),
        HM2_ITEM(FLOAT, OUT, channel, position_latched, "position-latched", 0),
        HM2_ITEM(FLOAT, OUT, channel, velocity, "velocity", 0),
        HM2_ITEM(FLOAT, OUT, channel, velocity_rpm, "velocity-rpm", 0),
        HM2_ITEM(BIT, IN, channel, reset, "reset", 0),
        HM2_ITEM(BIT, IO, channel, index_enable, "index-enable", 0),
        HM2_ITEM(BIT, IN, channel, no_clear_on_index, "no_clear_on_index", 0),
        HM2_ITEM(BIT, OUT, channel, quad_error, "quad-error", 0),
        HM2_ITEM(BIT, IN, channel, quad_error_enable, "quad-error-enable", 0),
        HM2_ITEM(BIT, OUT, channel, input_a, "input-a", 0),
        HM2_ITEM(BIT, OUT, channel, input_b, "input-b", 0),
        HM2_ITEM(BIT, OUT, channel, input_index, "input-index", 0),
        HM2_ITEM(FLOAT, RW, channel, scale, "scale", 1),
        HM2_ITEM(BIT, RW, channel, index_invert, "index-invert", 0),
        HM2_ITEM(BIT, RW, channel, index_mask, "index-mask", 0),
        HM2_ITEM(BIT, RW, channel, index_mask_invert, "index-mask-invert", 0),
        HM2_ITEM(BIT, RW, channel, counter_mode, "counter-mode", 0),
        HM2_ITEM(BIT, RW, channel, filter, "filter", 1),
        HM2_ITEM(FLOAT, RW, channel, vel_timeout, "vel-timeout", 0.5),
    };
    static const struct hm2_item probe[] = {
        HM2_ITEM(BIT, IN, channel, probe_enable, "probe-enable", 0),
        HM2_ITEM(BIT, IN, channel, probe_invert, "probe-invert", 0),
    };
    COMP_TRY(hm2_export(hm2, items, HM2_COUNT(items), &s->channel[i], "encoder.%02d.", i));
    return s->probe ? hm2_export(hm2, probe, HM2_COUNT(probe), &s->channel[i], "encoder.%02d.", i) : 0;
}

/* Does the firmware have the register that makes a DPLL's timer sample the counters? */
static bool probe_timer(struct hm2 *hm2, const struct hm2_md *md)
{
    rtapi_u32 value = 0, addr = hm2_register_addr(md, TIMER, 0);
    if(!hm2_has_dpll(hm2) || !hm2_write_now(hm2, addr, 0)) return false;
    return hm2_read_now(hm2, addr, &value, sizeof value) && value == 0;
}

static int claim(struct hm2 *hm2, const struct hm2_md *md, void **state)
{
    struct encoder *s;
    int i, n = hm2_count(hm2, md, HM2_NUM_ENCODERS);
    COMP_TRY(n);
    COMP_TRY(check(hm2, md));
    if(*state) {
        HM2_ERR(hm2, "firmware has encoders and muxed encoders: only one kind can be used\n");
        return -EINVAL;
    }
    if(!n) return 0;
    s = *state = hal_malloc(sizeof *s);
    if(!s) return -ENOMEM;
    s->channel = hal_malloc((long)sizeof *s->channel * n);
    if(!s->channel) return -ENOMEM;
    s->md = *md;
    s->count = n;
    s->muxed = md->gtag == HM2_GTAG_MUXED_ENCODER;
    s->probe = md->version & VERSION_PROBE;
    s->skews = s->muxed && md->version > 3;
    s->has_timer = probe_timer(hm2, md);
    COMP_TRY(export_globals(hm2, s));
    for(i = 0; i < n; i++) COMP_TRY(export_channel(hm2, s, i));
    s->clock = hm2_read_region(hm2, hm2_register_addr(md, TS_COUNT, 0), 1);
    s->counter = hm2_read_region(hm2, hm2_register_addr(md, COUNTER, 0), n);
    s->latch = hm2_read_region(hm2, hm2_register_addr(md, CONTROL, 0), n);
    if(!s->clock || !s->counter || !s->latch) return -ENOMEM;
    hm2->instances[md->gtag] = (rtapi_u8)(s->muxed ? (n + 1) / 2 : n);
    if(s->muxed) hm2->instances[HM2_GTAG_MUXED_ENCODER_SEL] = (rtapi_u8)n;
    return n;
}

static void start(struct hm2 *hm2, void *state)
{
    struct encoder *s = state;
    int i;
    (void)hm2;
    s->ticks = *s->clock & 0xFFFF;
    for(i = 0; i < s->count; i++) {
        struct channel *c = &s->channel[i];
        c->raw = c->zero = c->latch = c->event_raw = s->counter[i] & 0xFFFF;
        hal_set_sint(c->rawcounts, c->raw);
    }
}

/* ---- Reading -------------------------------------------------------------- */

static double scale_of(struct hm2 *hm2, struct channel *c, int i)
{
    double scale = hal_get_real(c->scale);
    if(scale != 0 && isfinite(scale)) return scale;
    HM2_ERR(hm2, "encoder.%02d.scale == 0, bogus, setting to 1.0\n", i);
    return hal_set_real(c->scale, 1.0);
}

static void set_s32(hal_sint_t pin, rtapi_s64 value)
{
    hal_set_si32(pin, (rtapi_s32)value);
}

static void process_quad_error(struct hm2 *hm2, struct channel *c, int i, rtapi_u32 status)
{
    if(!hal_get_bool(c->quad_error_enable)) {
        hal_set_bool(c->quad_error, 0);
        c->quad_error_armed = false;
        return;
    }
    if(!c->quad_error_armed || hal_get_bool(c->quad_error)) return; /* the bit is being cleared, or told */
    if(!(status & QUAD_ERROR)) return;
    hal_set_bool(c->quad_error, 1);
    HM2_ERR(hm2, "Encoder %d: quadrature count error\n", i);
}

/* A latch that was armed and is not armed in the board any more has caught a count. */
static void process_latch(struct channel *c, rtapi_u32 reg)
{
    rtapi_s64 latched = hal_extend_counter(c->raw, reg >> 16, 16);
    rtapi_u32 fired = c->control & ~reg;
    if(fired & LATCH_ON_INDEX) {
        if(!hal_get_bool(c->no_clear_on_index)) c->zero = latched;
        c->latch = latched;
        hal_set_bool(c->index_enable, 0);
    } else if(fired & LATCH_ON_PROBE) {
        c->latch = latched;
        hal_set_bool(c->probe_enable, 0);
    }
}

/* When the count of `stamp` changed, in ticks of the board since the driver was loaded. */
static rtapi_s64 stamp_ticks(const struct encoder *s, rtapi_u32 stamp)
{
    rtapi_u32 age = ((rtapi_u32)s->ticks - stamp) & 0xFFFF;
    return age > AHEAD ? s->ticks + (0x10000 - age) : s->ticks - age;
}

static void count_changed(struct channel *c, rtapi_s64 ticks, double scale, double tick_s)
{
    rtapi_s64 step = c->raw - c->event_raw;
    double dt = (double)(ticks - c->event_ticks) * tick_s;
    if(c->moving) {
        bool dithers = (step == 1 && c->last_step < 0) || (step == -1 && c->last_step > 0);
        if(dithers) c->speed = 0;
        else if(dt > 0) c->speed = (double)step / scale / dt;
    }
    c->moving = true;
    c->last_step = step;
    c->event_raw = c->raw;
    c->event_ticks = ticks;
}

/* Nothing came since the last change: the speed is at most one count in that time. */
static double wait_for_count(const struct encoder *s, struct channel *c, double scale, double tick_s)
{
    double dt = (double)(s->ticks - c->event_ticks) * tick_s;
    if(dt >= hal_get_real(c->vel_timeout)) {
        c->speed = 0;
        c->moving = false;
        return 0;
    }
    double fastest = dt > 0 ? fabs(1 / scale) / dt : fabs(c->speed);
    if(fabs(c->speed) > fastest) c->speed = copysign(fastest, c->speed);
    return dt * c->speed;
}

static void process_speed(const struct encoder *s, struct channel *c, rtapi_u32 stamp, double scale, double tick_s)
{
    double beyond = 0;
    bool armed = c->control & (LATCH_ON_INDEX | LATCH_ON_PROBE);
    if(c->raw != c->event_raw || (armed && !c->moving)) count_changed(c, stamp_ticks(s, stamp), scale, tick_s);
    else if(c->moving) beyond = wait_for_count(s, c, scale, tick_s);
    hal_set_real(c->velocity, c->speed);
    hal_set_real(c->velocity_rpm, c->speed * 60);
    hal_set_real(c->position_interpolated, (double)(c->raw - c->zero) / scale + beyond);
}

static void process_channel(struct hm2 *hm2, struct encoder *s, int i, double tick_s)
{
    struct channel *c = &s->channel[i];
    rtapi_u32 counter = s->counter[i], status = s->latch[i];
    double scale = scale_of(hm2, c, i);
    hal_set_bool(c->input_a, status & ON_INPUT_A);
    hal_set_bool(c->input_b, status & ON_INPUT_B);
    hal_set_bool(c->input_index, status & ON_INPUT_INDEX);
    process_quad_error(hm2, c, i, status);
    process_latch(c, status);
    c->raw = hal_extend_counter(c->raw, counter & 0xFFFF, 16);
    if(hal_get_bool(c->reset)) c->zero = c->latch = c->raw;
    set_s32(c->rawcounts, c->raw);
    set_s32(c->rawlatch, c->latch);
    set_s32(c->count, c->raw - c->zero);
    set_s32(c->count_latched, c->latch - c->zero);
    hal_set_real(c->position, (double)(c->raw - c->zero) / scale);
    hal_set_real(c->position_latched, (double)(c->latch - c->zero) / scale);
    process_speed(s, c, counter >> 16, scale, tick_s);
}

static void process(struct hm2 *hm2, void *state, long period)
{
    struct encoder *s = state;
    double tick_s = (s->divisor_reg + 2.0) / s->md.clock;
    int i;
    (void)period;
    s->ticks = hal_extend_counter(s->ticks, *s->clock & 0xFFFF, 16);
    for(i = 0; i < s->count; i++) process_channel(hm2, s, i, tick_s);
}

/* ---- Settings ------------------------------------------------------------- */

static rtapi_u32 control_register(const struct encoder *s, struct channel *c)
{
    bool index = hal_get_bool(c->index_enable), probe = s->probe && hal_get_bool(c->probe_enable) && !index;
    rtapi_u32 reg = 0;
    if(index) reg |= LATCH_ON_INDEX;
    if(probe) reg |= LATCH_ON_PROBE;
    if(index || probe) reg |= LATCH_ONCE;
    if(s->probe && hal_get_bool(c->probe_invert)) reg |= PROBE_POLARITY;
    if(hal_get_bool(c->index_invert)) reg |= INDEX_POLARITY;
    if(hal_get_bool(c->index_mask)) reg |= USE_MASK;
    if(hal_get_bool(c->index_mask_invert)) reg |= MASK_POLARITY;
    if(hal_get_bool(c->counter_mode)) reg |= COUNT_UP_DOWN;
    if(hal_get_bool(c->filter)) reg |= LONG_FILTER;
    return reg;
}

static void write_control(struct hm2 *hm2, struct encoder *s, int i, bool force)
{
    struct channel *c = &s->channel[i];
    rtapi_u32 reg = control_register(s, c), addr = hm2_register_addr(&s->md, CONTROL, i);
    if(hal_get_bool(c->quad_error_enable) && !c->quad_error_armed) {
        c->quad_error_armed = true;
        c->control = reg;
        hm2_queue_write(hm2, addr, reg | QUAD_ERROR);
    } else
        hm2_write_changed(hm2, addr, reg, &c->control, force);
}

/* Sampling of the inputs; the pins show what the clock can do. */
static rtapi_u32 filter_register(struct encoder *s)
{
    rtapi_u32 hz = hal_get_ui32(s->sample_frequency), reg, skew = 0;
    if(hz != s->frequency_known || (s->skews && hal_get_ui32(s->skew) != s->skew_known)) {
        rtapi_u32 divisor = s->md.clock / (hz ? hz : 1);
        reg = divisor <= 1 ? 0xFFF : divisor - 2;
        if(divisor > 1 && reg > 0xFFE) reg = 0xFFE;
        s->frequency_known = hal_set_ui32(s->sample_frequency, reg == 0xFFF ? s->md.clock : s->md.clock / (reg + 2));
        if(s->skews) {
            double tick_ns = 1e9 / s->md.clock;
            skew = (rtapi_u32)round(hal_get_ui32(s->skew) / tick_ns);
            if(skew > 15) skew = 15;
            s->skew_known = hal_set_ui32(s->skew, (rtapi_u32)(skew * tick_ns));
        }
        return reg | skew << 28;
    }
    return s->filter_reg;
}

static void write_settings(struct hm2 *hm2, void *state, bool force)
{
    struct encoder *s = state;
    double ticks = hal_get_bool(s->hires_timestamp) ? FAST_TICKS : SLOW_TICKS;
    int i;
    hm2_write_changed(hm2, hm2_register_addr(&s->md, TS_DIVISOR, 0), (rtapi_u32)(s->md.clock / ticks) - 2,
                      &s->divisor_reg,
                      force);
    hm2_write_changed(hm2, hm2_register_addr(&s->md, FILTER, 0), filter_register(s), &s->filter_reg, force);
    if(s->has_timer) {
        rtapi_s32 n = hal_get_si32(s->timer_number);
        if(n < -1 || n > 4) n = hal_set_si32(s->timer_number, -1);
        hm2_write_changed(hm2, hm2_register_addr(&s->md, TIMER, 0), hm2_timer_register(n), &s->timer_reg, force);
    }
    for(i = 0; i < s->count; i++) write_control(hm2, s, i, force);
}

static void print(struct hm2 *hm2, void *state)
{
    struct encoder *s = state;
    int i;
    HM2_PRINT(hm2, "Encoder: clock 0x%04X divisor %u filter 0x%08X\n", *s->clock, s->divisor_reg, s->filter_reg);
    for(i = 0; i < s->count; i++)
        HM2_PRINT(hm2, "    %d: counter 0x%08X latch 0x%08X control 0x%04X\n", i, s->counter[i], s->latch[i],
                  s->channel[i].control);
}

const struct hm2_function_ops hm2_encoder = {
    .gtag = {HM2_GTAG_ENCODER, HM2_GTAG_MUXED_ENCODER},
    .claim = claim,
    .start = start,
    .process = process,
    .write = write_settings,
    .print = print,
};
