/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * streamer.c - puts records of a stream onto pins, one each cycle or clock edge;
 * halstreamer fills the stream.
 *
 * In:     stream 0x48535430+N; streamer.N.enable, .clock, .clock-mode
 * Out:    streamer.N.pin.M, .empty, .curr-depth, .underruns
 * Thread: stream() [servo]/[base], cost: one pass over the pins
 */
#include "rtapi.h"
#include "rtapi_app.h"
#include "channel.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Realtime HAL data streamer");
MODULE_LICENSE("GPL");

static char *cfg[CHANNELS];
static int depth[CHANNELS];
RTAPI_MP_ARRAY_STRING(cfg, CHANNELS, "types of the values: f b s u l k");
RTAPI_MP_ARRAY_INT(depth, CHANNELS, "records in the queue");

enum { CLOCK_EVERY_CYCLE, CLOCK_FALLING, CLOCK_RISING, CLOCK_BOTH };

struct streamer {
    hal_bool_t empty, enable, clock;
    hal_sint_t curr_depth, underruns, clock_mode;
    hal_refs_u pins[HAL_STREAM_MAX_PINS];
    int count;
    unsigned history; /* the clock of the last two calls, newest in bit 0 */
    hal_stream_t fifo;
};

static int comp_id;
static struct streamer *streamers[CHANNELS];
static int channels;

static bool clocked(const struct streamer *s)
{
    switch (hal_get_si32(s->clock_mode)) {
    case CLOCK_FALLING: return s->history == 2;
    case CLOCK_RISING: return s->history == 1;
    case CLOCK_BOTH: return s->history == 1 || s->history == 2;
    default: return true;
    }
}

static void stream(void *arg, long period)
{
    struct streamer *s = arg;
    (void)period;
    s->history = (s->history << 1 | hal_get_bool(s->clock)) & 3;
    int queued = hal_stream_depth(&s->fifo);
    hal_set_si32(s->curr_depth, queued);
    hal_set_bool(s->empty, queued == 0);
    if (!hal_get_bool(s->enable) || !clocked(s)) {
        return;
    }
    hal_stream_data_u data[HAL_STREAM_MAX_PINS];
    if (hal_stream_read(&s->fifo, data, NULL) < 0) {
        hal_set_si32(s->underruns, hal_get_si32(s->underruns) + 1);
        return;
    }
    for (int m = 0; m < s->count; m++) {
        switch (hal_stream_element_type(&s->fifo, m)) {
        case HAL_BIT: hal_set_bool(s->pins[m].b, data[m].b); break;
        case HAL_FLOAT: hal_set_real(s->pins[m].r, data[m].f); break;
        case HAL_S32: hal_set_si32(s->pins[m].s, data[m].s); break;
        case HAL_U32: hal_set_ui32(s->pins[m].u, data[m].u); break;
        case HAL_S64: hal_set_sint(s->pins[m].s, data[m].l); break;
        case HAL_U64: hal_set_uint(s->pins[m].u, data[m].k); break;
        default: break;
        }
    }
}

static int channel_new(int n)
{
    struct streamer *s = hal_malloc(sizeof *s);
    if (!s) {
        return -ENOMEM;
    }
    int result = hal_stream_create(&s->fifo, comp_id, STREAMER_KEY + n, (unsigned)depth[n], cfg[n]);
    if (result < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "STREAMER: ERROR: could not create stream of channel %d\n", n);
        return result;
    }
    streamers[channels++] = s;
    s->count = hal_stream_element_count(&s->fifo);
    if ((result = hal_pin_new_bool(comp_id, HAL_OUT, &s->empty, 1, "streamer.%d.empty", n)) < 0 ||
        (result = hal_pin_new_bool(comp_id, HAL_IN, &s->enable, 1, "streamer.%d.enable", n)) < 0 ||
        (result = hal_pin_new_si32(comp_id, HAL_OUT, &s->curr_depth, 0, "streamer.%d.curr-depth", n)) < 0 ||
        (result = hal_pin_new_si32(comp_id, HAL_IO, &s->underruns, 0, "streamer.%d.underruns", n)) < 0 ||
        (result = hal_pin_new_bool(comp_id, HAL_IN, &s->clock, 0, "streamer.%d.clock", n)) < 0 ||
        (result = hal_pin_new_si32(comp_id, HAL_IN, &s->clock_mode, 0, "streamer.%d.clock-mode", n)) < 0) {
        return result;
    }
    for (int m = 0; m < s->count; m++) {
        result = channel_pin_new(&s->fifo, m, HAL_OUT, &s->pins[m], comp_id, "streamer", n);
        if (result < 0) {
            return result;
        }
    }
    return hal_export_functf(stream, s, 1, 0, comp_id, "streamer.%d", n);
}

static void streams_close(void)
{
    while (channels > 0) {
        hal_stream_destroy(&streamers[--channels]->fifo);
    }
}

int rtapi_app_main(void)
{
    if (!cfg[0] || !*cfg[0] || depth[0] <= 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "STREAMER: ERROR: no channels specified\n");
        return -EINVAL;
    }
    comp_id = hal_init("streamer");
    if (comp_id < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "STREAMER: ERROR: hal_init() failed\n");
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
