/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * sampler.c - puts the values of pins into a stream each cycle; halsampler prints
 * them.
 *
 * In:     sampler.N.pin.M, sampler.N.enable
 * Out:    stream 0x48534130+N; sampler.N.full, .curr-depth, .overruns
 * Thread: sample() [servo]/[base], cost: one pass over the pins
 */
#include "rtapi.h"
#include "rtapi_app.h"
#include "channel.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Realtime HAL data sampler");
MODULE_LICENSE("GPL");

static char *cfg[CHANNELS];
static int depth[CHANNELS];
RTAPI_MP_ARRAY_STRING(cfg, CHANNELS, "types of the values: f b s u l k");
RTAPI_MP_ARRAY_INT(depth, CHANNELS, "records in the queue");

struct sampler {
    hal_bool_t full, enable;
    hal_sint_t curr_depth, overruns, sample_num;
    hal_refs_u pins[HAL_STREAM_MAX_PINS];
    int count;
    hal_stream_t fifo;
};

static int comp_id;
static struct sampler *samplers[CHANNELS];
static int channels;

static void sample(void *arg, long period)
{
    struct sampler *s = arg;
    (void)period;
    if (!hal_get_bool(s->enable)) {
        hal_set_si32(s->curr_depth, hal_stream_depth(&s->fifo));
        hal_set_bool(s->full, !hal_stream_writable(&s->fifo));
        return;
    }
    hal_stream_data_u data[HAL_STREAM_MAX_PINS];
    for (int m = 0; m < s->count; m++) {
        data[m].k = 0;
        switch (hal_stream_element_type(&s->fifo, m)) {
        case HAL_BIT: data[m].b = hal_get_bool(s->pins[m].b); break;
        case HAL_FLOAT: data[m].f = hal_get_real(s->pins[m].r); break;
        case HAL_S32: data[m].s = hal_get_si32(s->pins[m].s); break;
        case HAL_U32: data[m].u = hal_get_ui32(s->pins[m].u); break;
        case HAL_S64: data[m].l = hal_get_sint(s->pins[m].s); break;
        case HAL_U64: data[m].k = hal_get_uint(s->pins[m].u); break;
        default: break;
        }
    }
    if (hal_stream_write(&s->fifo, data) < 0) {
        hal_set_si32(s->overruns, hal_get_si32(s->overruns) + 1);
        hal_set_bool(s->full, 1);
        hal_set_si32(s->curr_depth, (rtapi_s32)hal_stream_maxdepth(&s->fifo));
    } else {
        hal_set_bool(s->full, 0);
        hal_set_si32(s->curr_depth, hal_stream_depth(&s->fifo));
    }
}

static int channel_new(int n)
{
    struct sampler *s = hal_malloc(sizeof *s);
    if (!s) {
        return -ENOMEM;
    }
    int result = hal_stream_create(&s->fifo, comp_id, SAMPLER_KEY + n, (unsigned)depth[n], cfg[n]);
    if (result < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "SAMPLER: ERROR: could not create stream of channel %d\n", n);
        return result;
    }
    samplers[channels++] = s;
    s->count = hal_stream_element_count(&s->fifo);
    if ((result = hal_pin_new_bool(comp_id, HAL_OUT, &s->full, 0, "sampler.%d.full", n)) < 0 ||
        (result = hal_pin_new_bool(comp_id, HAL_IN, &s->enable, 1, "sampler.%d.enable", n)) < 0 ||
        (result = hal_pin_new_si32(comp_id, HAL_OUT, &s->curr_depth, 0, "sampler.%d.curr-depth", n)) < 0 ||
        (result = hal_pin_new_si32(comp_id, HAL_IO, &s->overruns, 0, "sampler.%d.overruns", n)) < 0 ||
        (result = hal_pin_new_si32(comp_id, HAL_IO, &s->sample_num, 0, "sampler.%d.sample-num", n)) < 0) {
        return result;
    }
    for (int m = 0; m < s->count; m++) {
        result = channel_pin_new(&s->fifo, m, HAL_IN, &s->pins[m], comp_id, "sampler", n);
        if (result < 0) {
            return result;
        }
    }
    return hal_export_functf(sample, s, 1, 0, comp_id, "sampler.%d", n);
}

static void streams_close(void)
{
    while (channels > 0) {
        hal_stream_destroy(&samplers[--channels]->fifo);
    }
}

int rtapi_app_main(void)
{
    if (!cfg[0] || !*cfg[0] || depth[0] <= 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "SAMPLER: ERROR: no channels specified\n");
        return -EINVAL;
    }
    comp_id = hal_init("sampler");
    if (comp_id < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "SAMPLER: ERROR: hal_init() failed\n");
        return -EINVAL;
    }
    for (int n = 0; n < CHANNELS && cfg[n] && *cfg[n] && depth[n] > 0; n++) {
        int result = channel_new(n);
        if (result < 0) {
            hal_exit(comp_id);
            streams_close();
            return result;
        }
    }
    hal_ready(comp_id);
    return 0;
}

void rtapi_app_exit(void)
{
    hal_exit(comp_id); /* the function is in no thread any more */
    streams_close();
}
