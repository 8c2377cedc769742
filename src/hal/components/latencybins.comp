// SPDX-License-Identifier: GPL-2.0-or-later
component latencybins "Histogram of the latency of a thread";
pin in s32 maxbinnumber = 1000 "Bins on each side.";
pin in s32 index "Bin to show.";
pin in bit reset "TRUE: starts again.";
pin in s32 nsbinsize "Width of a bin in ns.";
pin out s32 check "The index to which the values belong.";
pin out s32 latency "Time since the last call less the period, in ns.";
pin out s32 latency_max "Greatest latency.";
pin out s32 latency_min "Least latency.";
pin out s32 pbinvalue "Count of the positive bin; -1 for a bad index.";
pin out s32 nbinvalue "Count of the negative bin; -1 for a bad index.";
pin out s32 pextra "Count above the last positive bin.";
pin out s32 nextra "Count below the last negative bin.";
pin out s32 variance "Variance of the latency.";
pin out s32 availablebins = 1000 "Greatest number of bins.";
option data latency_histogram;
function _ "Measures.";
see_also "timedelta(9), latencybinstream(9)";
license "GPL";
author "Kerf developers";
;;
#define BINS 1000

typedef struct {
    rtapi_u64 positive[BINS + 1], negative[BINS + 1], above, below;
    rtapi_s64 last, sum;
    rtapi_u64 sum2, n;
    int running;
} latency_histogram;

/* A count on a pin of 32 bits: stays at the greatest. */
static rtapi_s32 shown(rtapi_u64 count) {
    return count > RTAPI_INT32_MAX ? RTAPI_INT32_MAX : (rtapi_s32)count;
}

FUNCTION(_) {
    latency_histogram *h = &data;
    rtapi_s64 now = rtapi_get_time();
    int last_bin = maxbinnumber < availablebins ? maxbinnumber : availablebins, i;
    if(last_bin > BINS) last_bin = BINS;
    if(reset || !h->running || nsbinsize == 0) {
        for(i = 0; i <= last_bin; i++) h->positive[i] = h->negative[i] = 0;
        h->above = h->below = 0;
        h->sum = 0;
        h->sum2 = h->n = 0;
        h->running = 1;
        latency = 0;
        latency_min = RTAPI_INT32_MAX;
        latency_max = RTAPI_INT32_MIN;
    } else {
        rtapi_s32 late = (rtapi_s32)(now - h->last - period), bin = late / nsbinsize;
        latency = late;
        if(late < latency_min) latency_min = late;
        if(late > latency_max) latency_max = late;
        if(bin >= 0) {
            if(bin > last_bin) h->above++;
            else h->positive[bin]++;
        } else {
            if(-bin > last_bin) h->below++;
            else h->negative[-bin]++;
        }
        h->n++;
        h->sum += late;
        h->sum2 += (rtapi_u64)((rtapi_s64)late * late);
        if(h->n > 1)
            variance = (rtapi_s32)((h->sum2 - (rtapi_u64)(h->sum * h->sum) / h->n) / (h->n - 1));
    }
    h->last = now;
    pextra = shown(h->above);
    nextra = shown(h->below);
    check = index;
    if(index < 0 || index > last_bin) {
        pbinvalue = -1;
        nbinvalue = -1;
    } else {
        pbinvalue = shown(h->positive[index]);
        nbinvalue = shown(h->negative[index]);
    }
}
