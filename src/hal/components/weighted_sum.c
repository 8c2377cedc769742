/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * weighted_sum.c - sums of weighted bits.
 *
 * Thread: process_wsums [any], bounded by the number of bits
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <hal.h>
#include "components/comp_util.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Weighted sums of bits");

#define MAX_SUMS 8
#define MAX_BITS 1024

static int wsum_sizes[MAX_SUMS] = { [0 ... MAX_SUMS - 1] = -1 };     /* -1: none */
RTAPI_MP_ARRAY_INT(wsum_sizes, MAX_SUMS, "number of bits of each sum");

struct bit {
    hal_bool_t in;
    hal_sint_t weight;
};

struct sum {
    int bits;
    struct bit *bit;
    hal_sint_t offset, sum;
    hal_bool_t hold;
};

static int comp_id, sums;
static struct sum *sum;

/* HAL function process_wsums. */
static void process(void *arg, long period)
{
    int i, k;
    (void)arg;
    (void)period;
    for(i = 0; i < sums; i++) {
        struct sum *s = &sum[i];
        rtapi_u32 total;
        if(hal_get_bool(s->hold)) continue;
        total = (rtapi_u32)hal_get_si32(s->offset);
        for(k = 0; k < s->bits; k++)
            if(hal_get_bool(s->bit[k].in)) total += (rtapi_u32)hal_get_si32(s->bit[k].weight);
        hal_set_si32(s->sum, (rtapi_s32)total);
    }
}

static int export_sum(struct sum *s, int n)
{
    int k;
    s->bits = wsum_sizes[n];
    s->bit = hal_malloc((long)sizeof *s->bit * s->bits);
    if(!s->bit) return -ENOMEM;
    for(k = 0; k < s->bits; k++) {
        COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &s->bit[k].in, 0, "wsum.%d.bit.%d.in", n, k));
        COMP_TRY(hal_pin_new_si32(comp_id, HAL_IO, &s->bit[k].weight, k < 32 ? (rtapi_s32)(1u << k) : 0,
                                  "wsum.%d.bit.%d.weight", n, k));
    }
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &s->hold, 0, "wsum.%d.hold", n));
    COMP_TRY(hal_pin_new_si32(comp_id, HAL_IO, &s->offset, 0, "wsum.%d.offset", n));
    COMP_TRY(hal_pin_new_si32(comp_id, HAL_OUT, &s->sum, 0, "wsum.%d.sum", n));
    return 0;
}

static int export_all(void)
{
    int i;
    sum = hal_malloc((long)sizeof *sum * sums);
    if(!sum) return -ENOMEM;
    for(i = 0; i < sums; i++) COMP_TRY(export_sum(&sum[i], i));
    return hal_export_funct("process_wsums", process, NULL, 1, 0, comp_id);
}

int rtapi_app_main(void)
{
    int r;
    for(sums = 0; sums < MAX_SUMS && wsum_sizes[sums] != -1; sums++) {
        if(wsum_sizes[sums] < 1 || wsum_sizes[sums] > MAX_BITS) {
            rtapi_print_msg(RTAPI_MSG_ERR, "WEIGHTED_SUM: ERROR: Invalid number of bits '%i' for summer %i\n",
                            wsum_sizes[sums], sums);
            return -1;
        }
    }
    if(sums == 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "WEIGHTED_SUM: ERROR: no summers specified\n");
        return -1;
    }
    comp_id = hal_init("weighted_sum");
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
