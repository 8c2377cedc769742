/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * encoder.c - quadrature decoder and counter in software.
 *
 * In:     phases A, B and Z, latch input
 * Out:    counts, position (units), velocity (units/s), latched position
 * Thread: update-counters [base], capture-position [servo]
 * Method: update-counters decodes and notes when the last count came; results go
 *         through one of two buffers, which capture-position swaps. Velocity is counts
 *         per time between the last count of this and of the previous capture.
 *
 * Counts are kept in 64 bits: positions stay right after the pins have wrapped.
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <rtapi_math.h>
#include <hal.h>
#include "components/comp_util.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Encoder counter in software");

#define MAX_CHAN 8

static int num_chan;
RTAPI_MP_INT(num_chan, "number of channels");
static char *names[MAX_CHAN];
RTAPI_MP_ARRAY_STRING(names, MAX_CHAN, "names of the channels");

/* What update-counters tells capture-position. */
struct buffer {
    rtapi_s64 raw, index, latch;
    rtapi_u64 timestamp;                /* ns, when the last count came */
    char counted, index_found, latch_found;
};

struct channel {
    /* Of update-counters. */
    rtapi_s64 raw;                      /* added to by capture-position for missing teeth */
    unsigned phases;                    /* A and B of the last pass */
    int old_z, old_latch;
    rtapi_u64 since_up;                 /* ns since the last count up */
    int gaps;                           /* missing teeth found; cleared by capture-position */
    hal_bool_t phase_a, phase_b, phase_z, x4_mode, counter_mode, latch_input, latch_rising, latch_falling;
    hal_sint_t rawcounts, missing_teeth;

    struct buffer buffers[2];
    int writing;                        /* atomic: index of the buffer of update-counters */
    int armed;                          /* atomic: index wanted; set by [servo], cleared by [base] */
    rtapi_u32 limit_dt;                 /* ns; a longer gap is a missing tooth */

    /* Of capture-position. */
    rtapi_s64 count, index_count, latch_count;
    rtapi_u64 last_timestamp;
    int captures;                       /* with counts, since standstill; up to 2 */
    double seen_scale, k;               /* k: units per count */
    hal_bool_t index_enable, reset;
    hal_sint_t counts, counts_latched;
    hal_real_t min_speed, position, position_interpolated, position_latched, velocity, velocity_rpm;
    hal_real_t position_scale;
};

static int comp_id, channels;
static struct channel *channel;
static rtapi_u64 timebase;              /* ns; atomic; written by update-counters */

/* ---- [base] -------------------------------------------------------------- */

enum { A = 1, B = 2 };

/* +1, -1 or 0 for a change of the phases. */
static int decode(const struct channel *c, unsigned old, unsigned now)
{
    /* Place in the sequence 00 10 11 01 of a turn forward (A first). */
    static const signed char place[4] = { 0, 1, 3, 2 };
    int turn;
    if(hal_get_bool(c->counter_mode)) return (now & ~old & A) ? 1 : 0;
    turn = (place[now] - place[old]) & 3;
    if(hal_get_bool(c->x4_mode)) return turn == 1 ? 1 : turn == 3 ? -1 : 0;
    if(old == 0 && now == A) return 1;
    return old == A && now == 0 ? -1 : 0;
}

static void count_edges(struct channel *c, struct buffer *buf, rtapi_u32 period)
{
    unsigned now = (hal_get_bool(c->phase_a) ? A : 0) | (hal_get_bool(c->phase_b) ? B : 0);
    int step = decode(c, c->phases, now);
    c->phases = now;
    c->since_up += period;
    if(step > 0) {
        if(hal_get_si32(c->missing_teeth) && c->since_up > c->limit_dt) c->gaps++;
        c->since_up = 0;
    }
    if(step) {
        c->raw += step;
        buf->raw = c->raw;
        buf->timestamp = timebase;
        buf->counted = 1;
    }
    hal_set_si32(c->rawcounts, (rtapi_s32)(rtapi_u64)c->raw);
}

static void watch_index(struct channel *c, struct buffer *buf)
{
    int z = hal_get_bool(c->phase_z) || c->gaps > 0;
    if(z && !c->old_z && __atomic_load_n(&c->armed, __ATOMIC_RELAXED)) {
        buf->index = c->raw;
        buf->index_found = 1;
        __atomic_store_n(&c->armed, 0, __ATOMIC_RELAXED);
    }
    c->old_z = z;
}

static void watch_latch(struct channel *c, struct buffer *buf)
{
    int now = hal_get_bool(c->latch_input), was = c->old_latch;
    c->old_latch = now;
    if((now && !was && hal_get_bool(c->latch_rising)) || (!now && was && hal_get_bool(c->latch_falling))) {
        buf->latch = c->raw;
        buf->latch_found = 1;
    }
}

/* HAL function encoder.update-counters. [base] */
static void update_counters(void *arg, long period)
{
    int i;
    (void)arg;
    for(i = 0; i < channels; i++) {
        struct channel *c = &channel[i];
        struct buffer *buf = &c->buffers[__atomic_load_n(&c->writing, __ATOMIC_ACQUIRE)];
        count_edges(c, buf, (rtapi_u32)period);
        watch_index(c, buf);
        watch_latch(c, buf);
    }
    __atomic_store_n(&timebase, timebase + (rtapi_u64)period, __ATOMIC_RELAXED);
}

/* ---- [servo] ------------------------------------------------------------- */

static struct buffer *swap_buffers(struct channel *c)
{
    int full = c->writing;
    __atomic_store_n(&c->writing, !full, __ATOMIC_RELEASE);
    return &c->buffers[full];
}

/* Adds the teeth that are missing on the wheel; returns the change of the count. */
static rtapi_s64 add_missing_teeth(struct channel *c, rtapi_s64 raw, rtapi_u64 elapsed)
{
    int teeth = hal_get_si32(c->missing_teeth);
    rtapi_s64 change = raw - c->count;
    if(teeth) {
        rtapi_s64 extra = (rtapi_s64)teeth * c->gaps;
        if(change)
            c->limit_dt = (rtapi_u32)(0.9 * c->limit_dt
                                      + 0.1 * ((teeth + 0.5) * (elapsed / (rtapi_u32)change)));
        c->raw += extra;
        hal_set_si32(c->rawcounts, (rtapi_s32)(rtapi_u64)c->raw);
        change += extra;
        c->gaps = 0;
    }
    c->count += change;
    return change;
}

static void velocity_with_counts(struct channel *c, const struct buffer *buf)
{
    rtapi_u64 elapsed = buf->timestamp - c->last_timestamp;
    rtapi_s64 change = add_missing_teeth(c, buf->raw, elapsed);
    c->last_timestamp = buf->timestamp;
    if(c->captures < 2) c->captures++;
    else hal_set_real(c->velocity, change * c->k / (elapsed * 1e-9));
}

/* No count came: the velocity cannot be more than one count since the last. */
static void velocity_without_counts(struct channel *c, double min_speed)
{
    if(c->captures > 0) {
        rtapi_u64 elapsed = __atomic_load_n(&timebase, __ATOMIC_RELAXED) - c->last_timestamp;
        if(hal_get_si32(c->missing_teeth) && elapsed > 1.5 * c->limit_dt) {
            /* Between the teeth around a gap. */
        } else if(elapsed < 1e9 / (min_speed * c->k)) {
            double bound = fabs(c->k / (elapsed * 1e-9)), velocity = hal_get_real(c->velocity);
            if(bound < velocity) hal_set_real(c->velocity, bound);
            if(-bound > velocity) hal_set_real(c->velocity, -bound);
        } else {
            c->captures = 0;
        }
    }
    if(c->captures == 0) hal_set_real(c->velocity, 0);
}

static void capture_channel(struct channel *c)
{
    struct buffer *buf = swap_buffers(c);
    double scale, min_speed, velocity;
    rtapi_s64 counts, latched;
    if(buf->index_found) {
        buf->index_found = 0;
        c->index_count = buf->index;
        hal_set_bool(c->index_enable, 0);
    }
    if(buf->latch_found) {
        buf->latch_found = 0;
        c->latch_count = buf->latch;
    }
    __atomic_store_n(&c->armed, hal_get_bool(c->index_enable), __ATOMIC_RELAXED);

    scale = hal_get_real(c->position_scale);
    if(scale != c->seen_scale) {
        c->seen_scale = comp_scale(scale);
        if(c->seen_scale != scale) hal_set_real(c->position_scale, c->seen_scale);
        c->k = 1.0 / c->seen_scale;
    }
    min_speed = hal_get_real(c->min_speed);
    if(min_speed == 0) {
        min_speed = 1;
        hal_set_real(c->min_speed, 1);
    }
    if(hal_get_bool(c->reset)) {
        c->count = c->raw;
        c->index_count = c->count;
    }
    if(buf->counted) {
        buf->counted = 0;
        velocity_with_counts(c, buf);
    } else {
        velocity_without_counts(c, min_speed);
    }

    velocity = hal_get_real(c->velocity);
    counts = c->count - c->index_count;
    latched = c->latch_count - c->index_count;
    hal_set_real(c->velocity_rpm, velocity * 60);
    hal_set_si32(c->counts, (rtapi_s32)(rtapi_u64)counts);
    hal_set_si32(c->counts_latched, (rtapi_s32)(rtapi_u64)latched);
    hal_set_real(c->position, counts * c->k);
    hal_set_real(c->position_latched, latched * c->k);
    hal_set_real(
        c->position_interpolated,
        counts * c->k +
            velocity * ((__atomic_load_n(&timebase, __ATOMIC_RELAXED) - c->last_timestamp) * 1e-9));
}

/* HAL function encoder.capture-position. [servo] */
static void capture_position(void *arg, long period)
{
    int i;
    (void)arg;
    (void)period;
    for(i = 0; i < channels; i++) capture_channel(&channel[i]);
}

/* ---- [init] -------------------------------------------------------------- */

static int export_channel(struct channel *c, const char *name)
{
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &c->phase_a, 0, "%s.phase-A", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &c->phase_b, 0, "%s.phase-B", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &c->phase_z, 0, "%s.phase-Z", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IO, &c->index_enable, 0, "%s.index-enable", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &c->reset, 0, "%s.reset", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &c->latch_input, 0, "%s.latch-input", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &c->latch_rising, 1, "%s.latch-rising", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &c->latch_falling, 1, "%s.latch-falling", name));
    COMP_TRY(hal_pin_new_si32(comp_id, HAL_OUT, &c->rawcounts, 0, "%s.rawcounts", name));
    COMP_TRY(hal_pin_new_si32(comp_id, HAL_OUT, &c->counts, 0, "%s.counts", name));
    COMP_TRY(hal_pin_new_si32(comp_id, HAL_OUT, &c->counts_latched, 0, "%s.counts-latched", name));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &c->min_speed, 1.0, "%s.min-speed-estimate", name));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &c->position, 0, "%s.position", name));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &c->position_interpolated, 0, "%s.position-interpolated", name));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &c->position_latched, 0, "%s.position-latched", name));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &c->velocity, 0, "%s.velocity", name));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &c->velocity_rpm, 0, "%s.velocity-rpm", name));
    c->seen_scale = COMP_SCALE_UNSEEN;
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IO, &c->position_scale, 1.0, "%s.position-scale", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IO, &c->x4_mode, 1, "%s.x4-mode", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IO, &c->counter_mode, 0, "%s.counter-mode", name));
    COMP_TRY(hal_pin_new_si32(comp_id, HAL_IN, &c->missing_teeth, 0, "%s.missing-teeth", name));
    return 0;
}

static int export_all(int n)
{
    int i;
    channel = hal_malloc((long)sizeof *channel * n);
    if(!channel) return -ENOMEM;
    for(i = 0; i < n; i++) {
        char name[HAL_NAME_LEN + 1];
        if(names[i] && names[i][0]) rtapi_snprintf(name, sizeof name, "%s", names[i]);
        else rtapi_snprintf(name, sizeof name, "encoder.%d", i);
        COMP_TRY(export_channel(&channel[i], name));
    }
    channels = n;
    COMP_TRY(hal_export_funct("encoder.update-counters", update_counters, NULL, 0, 0, comp_id));
    COMP_TRY(hal_export_funct("encoder.capture-position", capture_position, NULL, 1, 0, comp_id));
    return 0;
}

int rtapi_app_main(void)
{
    int n, r;
    COMP_TRY(n = comp_instances("ENCODER", num_chan, names, MAX_CHAN, 3));
    comp_id = hal_init("encoder");
    if(comp_id < 0) return comp_id;
    r = export_all(n);
    if(r < 0) {
        hal_exit(comp_id);
        return r;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void)
{
    hal_exit(comp_id);
}
