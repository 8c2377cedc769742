// SPDX-License-Identifier: GPL-2.0-or-later
component histobins "Histogram of a signal";
pin in unsigned pintype "Input in use: 0 *input*, 1 *input-s32*, 2 *input-u32*, 3 *input-bit*.";
pin in float input "Float input.";
pin in s32 input_s32 "Integer input.";
pin in u32 input_u32 "Unsigned input.";
pin in bit input_bit "Bit input.";
pin in u32 nbins = 20 "Number of bins, 1 to 200.";
pin in float binsize = 1 "Width of a bin.";
pin in float minvalue = 0 "Lower end of the first bin.";
pin in s32 index "Bin to show.";
pin out s32 check "The index to which *binvalue* belongs.";
pin in bit reset "TRUE: starts again.";
pin in bit method "Variance: FALSE by running mean (Welford), TRUE by sums.";
pin out bit input_error "*nbins* is out of its range.";
pin out float binvalue "Samples in the bin; -1 for a bad index.";
pin out float pextra "Samples above the last bin.";
pin out float nextra "Samples below the first bin.";
pin out float input_min "Least sample.";
pin out float input_max "Greatest sample.";
pin out u32 nsamples "Number of samples.";
pin out float variance "Variance of the samples.";
pin out float mean "Mean of the samples.";
pin out s32 availablebins = 200 "Greatest number of bins.";
option data histogram;
function _ "Takes a sample.";
option period no;
see_also "histobinstream(9), latencybins(9)";
license "GPL";
author "Kerf developers";
;;
#define BINS 200

typedef struct {
    rtapi_u64 bin[BINS + 1];          /* one more: a sample at the upper end */
    rtapi_u32 bins;                   /* geometry of what is counted */
    double width, low, high;
    double m2, sum, sum2;
    int running;
} histogram;

FUNCTION(_) {
    histogram *h = &data;
    int geometry, i;
    double x = pintype == 1 ? input_s32 : pintype == 2 ? input_u32 : pintype == 3 ? input_bit : input;
    check = index;
    if(x != x) return;                  /* not a number: no sample */
    if(nbins < 1 || nbins > BINS) {
        input_error = 1;
        return;
    }
    input_error = 0;
    geometry = h->bins != nbins || h->width != binsize || h->low != minvalue;
    if(reset || !h->running || geometry) {
        for(i = 0; i <= BINS; i++) h->bin[i] = 0;
        h->bins = nbins;
        h->width = binsize;
        h->low = minvalue;
        h->high = minvalue + nbins * binsize;
        h->m2 = h->sum = h->sum2 = 0;
        h->running = 1;
        pextra = nextra = 0;
        input_min = 1e99;
        input_max = -1e99;
        nsamples = 0;
        mean = variance = 0;
    } else if(x < h->low) {
        nextra += 1;
    } else if(x > h->high) {
        pextra += 1;
    } else {
        double place = (x - h->low) / h->width;
        if(place >= 0 && place < BINS + 1) h->bin[(int)place]++;
    }
    binvalue = index >= 0 && index < (rtapi_s32)h->bins ? (double)h->bin[index] : -1;
    if(x < input_min) input_min = x;
    if(x > input_max) input_max = x;
    nsamples++;
    if(nsamples >= 2) {
        if(!method) {
            double delta = x - mean;
            mean += delta / nsamples;
            h->m2 += delta * (x - mean);
            variance = h->m2 / (nsamples - 1);
        } else {
            h->sum += x;
            h->sum2 += x * x;
            mean = h->sum / nsamples;
            variance = (h->sum2 - h->sum * h->sum / nsamples) / (nsamples - 1);
        }
    }
}
