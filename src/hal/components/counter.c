/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * counter.c - pulse counter with index.
 *
 * In:     pulses on phase-A, index on phase-Z
 * Out:    counts, position (units), velocity (units/s)
 * Thread: update-counters [base], capture-position [servo]
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <rtapi_math.h>
#include <hal.h>
#include "components/comp_util.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Pulse counter");

#define MAX_CHAN 8

static int num_chan = 1;
RTAPI_MP_INT(num_chan, "number of counters");

struct counter {
    int old_a, old_z, armed;
    rtapi_s64 raw, last_index, last_count;
    double seen_scale, k;
    hal_bool_t phase_a, phase_z, index_enable, reset;
    hal_sint_t rawcounts, counts;
    hal_real_t position, velocity, position_scale;
};

static int comp_id;
static struct counter *counters;

/* HAL function counter.update-counters. [base] */
static void update_counters(void *arg, long period)
{
    int i;
    (void)arg;
    (void)period;
    for(i = 0; i < num_chan; i++) {
        struct counter *c = &counters[i];
        int a = hal_get_bool(c->phase_a), z = hal_get_bool(c->phase_z);
        if(a && !c->old_a) c->raw++;
        hal_set_si32(c->rawcounts, (rtapi_s32)(rtapi_u64)c->raw);
        c->old_a = a;
        if(c->armed && z && !c->old_z) {
            c->last_index = c->raw;
            hal_set_bool(c->index_enable, 0);
        }
        c->old_z = z;
    }
}

/* HAL function counter.capture-position. [servo] */
static void capture_position(void *arg, long period)
{
    int i;
    (void)arg;
    for(i = 0; i < num_chan; i++) {
        struct counter *c = &counters[i];
        double scale = hal_get_real(c->position_scale);
        rtapi_s64 counts, delta;
        c->armed = hal_get_bool(c->index_enable);
        if(hal_get_bool(c->reset)) {
            c->raw = c->last_index = c->last_count = 0;
            hal_set_si32(c->rawcounts, 0);
        }
        counts = c->raw - c->last_index;
        delta = c->raw - c->last_count;
        c->last_count = c->raw;
        hal_set_si32(c->counts, (rtapi_s32)(rtapi_u64)counts);
        if(scale != c->seen_scale) {
            c->seen_scale = comp_scale(scale);
            if(c->seen_scale != scale) hal_set_real(c->position_scale, c->seen_scale);
            c->k = 1.0 / c->seen_scale;
        }
        hal_set_real(c->position, counts * c->k);
        hal_set_real(c->velocity, delta * c->k * 1e9 / period);
    }
}

static int export_counter(struct counter *c, int n)
{
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &c->phase_a, 0, "counter.%d.phase-A", n));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &c->phase_z, 0, "counter.%d.phase-Z", n));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IO, &c->index_enable, 0, "counter.%d.index-enable", n));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &c->reset, 0, "counter.%d.reset", n));
    COMP_TRY(hal_pin_new_si32(comp_id, HAL_OUT, &c->rawcounts, 0, "counter.%d.rawcounts", n));
    COMP_TRY(hal_pin_new_si32(comp_id, HAL_OUT, &c->counts, 0, "counter.%d.counts", n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &c->position, 0, "counter.%d.position", n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &c->velocity, 0, "counter.%d.velocity", n));
    c->seen_scale = COMP_SCALE_UNSEEN;
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IO, &c->position_scale, 1.0, "counter.%d.position-scale", n));
    return 0;
}

static int export_all(void)
{
    int i;
    counters = hal_malloc((long)sizeof *counters * num_chan);
    if(!counters) return -ENOMEM;
    for(i = 0; i < num_chan; i++) COMP_TRY(export_counter(&counters[i], i));
    COMP_TRY(hal_export_funct("counter.update-counters", update_counters, NULL, 0, 0, comp_id));
    COMP_TRY(hal_export_funct("counter.capture-position", capture_position, NULL, 1, 0, comp_id));
    return 0;
}

int rtapi_app_main(void)
{
    int r;
    if(num_chan < 1 || num_chan > MAX_CHAN) {
        rtapi_print_msg(RTAPI_MSG_ERR, "COUNTER: ERROR: invalid num_chan: %d\n", num_chan);
        return -EINVAL;
    }
    comp_id = hal_init("counter");
    if(comp_id < 0) return comp_id;
    r = export_all();
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
