// SPDX-License-Identifier: GPL-2.0-or-later
component histobinstream "Histogram of a signal, sent as a stream";
modparam dummy keys "Shared memory key of the stream of each instance, at most 8.";
pin in u32 pintype "Input in use: 0 *input*, 1 *input-s32*, 2 *input-u32*, 3 *input-bit*.";
pin in float input "Float input.";
pin in s32 input_s32 "Integer input.";
pin in u32 input_u32 "Unsigned input.";
pin in bit input_bit "Bit input.";
pin in u32 nbins = 20 "Number of bins, 1 to 200.";
pin in float binsize = 1 "Width of a bin, above zero.";
pin in float minvalue = 0 "Lower end of the first bin.";
pin in bit reset = 1 "TRUE: starts again.";
pin in bit method "Variance: FALSE by running mean (Welford), TRUE by sums.";
pin in bit stream = 0 "Rising: publishes the statistics and sends the histogram.";
pin out bit stream_error "The last histogram did not fit into the stream.";
pin out bit input_error "*nbins* or *binsize* is out of its range; until *reset*.";
pin out s64 stream_time "Nanoseconds that sending took.";
pin out float input_min "Least sample.";
pin out float input_max "Greatest sample.";
pin out u32 nsamples "Number of samples.";
pin out float variance "Variance of the samples.";
pin out float mean "Mean of the samples.";
pin out s32 availablebins = 200 "Greatest number of bins.";
option data histogram_stream;
option extra_setup;
option extra_cleanup;
option period no;
function _ "Takes a sample, and sends when asked.";
description "The stream has records of one unsigned number: count below the bins, the bins, count above them.";
see_also "histobins(9), latencybinstream(9)";
license "GPL";
author "Kerf developers";
include <rtapi_math.h>;
;;
#define BINS 200
#define MAX_STREAMS 8
static int keys[MAX_STREAMS];
RTAPI_MP_ARRAY_INT(keys, MAX_STREAMS, "shared memory keys");

typedef struct {
    rtapi_u64 bin[BINS], above, below;
    rtapi_u32 bins, n;
    double width, low, least, most, average, m2, sum, sum2;
    int running, was_streaming;
    hal_stream_t fifo;
} histogram_stream;

static histogram_stream *streams[MAX_STREAMS];

EXTRA_SETUP() {
    int r;
    if(extra_arg < 0 || extra_arg >= MAX_STREAMS || keys[extra_arg] == 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "histobinstream: no key for instance %ld\n", extra_arg);
        return -EINVAL;
    }
    r = hal_stream_create(&data.fifo, comp_id, keys[extra_arg], BINS + 3, "u");
    if(r < 0) return r;
    streams[extra_arg] = &data;
    return 0;
}

EXTRA_CLEANUP() {
    int i;
    for(i = 0; i < MAX_STREAMS; i++) {
        if(streams[i]) hal_stream_destroy(&streams[i]->fifo);
        streams[i] = NULL;
    }
}

static void start_again(histogram_stream *h, rtapi_u32 bins, double width, double low) {
    int i;
    for(i = 0; i < BINS; i++) h->bin[i] = 0;
    h->above = h->below = 0;
    h->bins = bins;
    h->n = 0;
    h->width = width;
    h->low = low;
    h->least = 1e99;
    h->most = -1e99;
    h->average = h->m2 = h->sum = h->sum2 = 0;
    h->running = 1;
}

static void take(histogram_stream *h, double x) {
    double place = (x - h->low) / h->width, delta;
    if(isnan(place)) return;
    if(place < 0) h->below++;
    else if(place >= h->bins) h->above++;
    else h->bin[(int)place]++;
    if(x < h->least) h->least = x;
    if(x > h->most) h->most = x;
    h->n++;
    h->sum += x;
    h->sum2 += x * x;
    delta = x - h->average;
    h->average += delta / h->n;
    h->m2 += delta * (x - h->average);
}

static void put(hal_stream_t *fifo, rtapi_u64 count) {
    hal_stream_data_u record;
    record.u = count > RTAPI_UINT32_MAX ? RTAPI_UINT32_MAX : (rtapi_u32)count;
    hal_stream_write(fifo, &record);
}

FUNCTION(_) {
    histogram_stream *h = &data;
    double x = pintype == 1 ? input_s32 : pintype == 2 ? input_u32 : pintype == 3 ? input_bit : input;
    if(reset) input_error = 0;
    if(nbins < 1 || nbins > BINS || !(binsize > 0)) {
        input_error = 1;
        return;
    }
    if(reset || !h->running || h->bins != nbins || h->width != binsize || h->low != minvalue)
        start_again(h, nbins, binsize, minvalue);
    else
        take(h, x);
    if(stream && !h->was_streaming) {
        rtapi_s64 begin = rtapi_get_time();
        rtapi_u32 i;
        nsamples = h->n;
        mean = !method ? h->average : h->n ? h->sum / h->n : 0;
        variance = h->n < 2 ? 0 : !method ? h->m2 / (h->n - 1) : (h->sum2 - h->sum * h->sum / h->n) / (h->n - 1);
        input_min = h->n ? h->least : 0;
        input_max = h->n ? h->most : 0;
        stream_error = (rtapi_s64)hal_stream_maxdepth(&h->fifo) - 1 - hal_stream_depth(&h->fifo)
                       < (rtapi_s64)h->bins + 2;
        if(!stream_error) {
            put(&h->fifo, h->below);
            for(i = 0; i < h->bins; i++) put(&h->fifo, h->bin[i]);
            put(&h->fifo, h->above);
        }
        stream_time = rtapi_get_time() - begin;
    }
    h->was_streaming = stream;
}
