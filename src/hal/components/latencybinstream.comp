// SPDX-License-Identifier: GPL-2.0-or-later
component latencybinstream "Histogram of the latency of a thread, sent as a stream";
modparam dummy keys "Shared memory key of the stream of each instance, at most 8.";
pin in s64 maxbinnumber = 1000 "Bins on each side.";
pin in s64 nsbinsize "Width of a bin in ns.";
pin in bit reset = 1 "TRUE: starts again.";
pin in bit stream = 0 "Rising: publishes the statistics and sends the histogram.";
pin out bit stream_error "The last histogram did not fit into the stream.";
pin out s64 latency "Time since the last call less the period, in ns.";
pin out s64 latency_avg "Mean latency.";
pin out s64 latency_max "Greatest latency.";
pin out s64 latency_min "Least latency.";
pin out s64 variance "Variance of the latency.";
pin out s64 stream_time "Nanoseconds that sending took.";
pin out s64 availablebins = 1000 "Greatest number of bins.";
option data latency_stream;
option extra_setup;
option extra_cleanup;
option default_count 1;
function _ "Measures, and sends when asked.";
description """
The stream has records of one unsigned number: count below the last negative bin, the negative bins from the last
to the first, the positive bins from 0 on, count above the last positive bin.
""";
see_also "latencybins(9), histobinstream(9)";
license "GPL";
author "Kerf developers";
;;
#define BINS 1000
#define MAX_STREAMS 8
static int keys[MAX_STREAMS];
RTAPI_MP_ARRAY_INT(keys, MAX_STREAMS, "shared memory keys");

typedef struct {
    rtapi_u64 positive[BINS + 1], negative[BINS + 1], above, below;
    rtapi_s64 last, sum, least, most;
    __int128 sum2;
    rtapi_s64 n;
    int running, was_streaming;
    hal_stream_t fifo;
} latency_stream;

static latency_stream *streams[MAX_STREAMS];

EXTRA_SETUP() {
    int r;
    if(extra_arg < 0 || extra_arg >= MAX_STREAMS || keys[extra_arg] == 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "latencybinstream: no key for instance %ld\n", extra_arg);
        return -EINVAL;
    }
    r = hal_stream_create(&data.fifo, comp_id, keys[extra_arg], 2 * BINS + 4, "u");
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

static void start_again(latency_stream *h, int last_bin) {
    int i;
    for(i = 0; i <= last_bin; i++) h->positive[i] = h->negative[i] = 0;
    h->above = h->below = 0;
    h->sum = h->n = 0;
    h->sum2 = 0;
    h->least = RTAPI_INT64_MAX;
    h->most = RTAPI_INT64_MIN;
    h->running = 1;
}

static void put(hal_stream_t *fifo, rtapi_u64 count) {
    hal_stream_data_u record;
    record.u = count > RTAPI_UINT32_MAX ? RTAPI_UINT32_MAX : (rtapi_u32)count;
    hal_stream_write(fifo, &record);
}

/* Room for a histogram: free records of the stream. */
static int fits(hal_stream_t *fifo, int records) {
    return (int)hal_stream_maxdepth(fifo) - 1 - hal_stream_depth(fifo) >= records;
}

static void send_bins(latency_stream *h, int last_bin) {
    int i;
    put(&h->fifo, h->below);
    for(i = last_bin; i > 0; i--) put(&h->fifo, h->negative[i]);
    for(i = 0; i <= last_bin; i++) put(&h->fifo, h->positive[i]);
    put(&h->fifo, h->above);
}

FUNCTION(_) {
    latency_stream *h = &data;
    rtapi_s64 now = rtapi_get_time(), limit = maxbinnumber < availablebins ? maxbinnumber : availablebins;
    int last_bin = limit < 0 ? 0 : limit > BINS ? BINS : (int)limit;
    if(reset || !h->running || nsbinsize == 0) {
        start_again(h, last_bin);
        latency = 0;
    } else {
        rtapi_s64 late = now - h->last - period, bin = late / nsbinsize;
        latency = late;
        if(late < h->least) h->least = late;
        if(late > h->most) h->most = late;
        if(bin >= 0) {
            if(bin > last_bin) h->above++;
            else h->positive[bin]++;
        } else {
            if(-bin > last_bin) h->below++;
            else h->negative[-bin]++;
        }
        h->n++;
        h->sum += late;
        h->sum2 += (__int128)late * late;
    }
    h->last = now;
    if(stream && !h->was_streaming) {
        if(h->n > 1) {
            latency_avg = h->sum / h->n;
            latency_min = h->least;
            latency_max = h->most;
            variance = (rtapi_s64)((h->sum2 - (__int128)h->sum * h->sum / h->n) / (h->n - 1));
        }
        stream_error = !fits(&h->fifo, 2 * last_bin + 3);
        if(!stream_error) send_bins(h, last_bin);
        stream_time = rtapi_get_time() - now;
    }
    h->was_streaming = stream;
}
