/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * debounce.c - debounce filters in groups with a common delay.
 *
 * Thread: debounce.G [any], bounded by the size of the group
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <hal.h>
#include "components/comp_util.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Debounce filters");

#define MAX_GROUPS 8
#define MAX_FILTERS 50

static int cfg[MAX_GROUPS];
RTAPI_MP_ARRAY_INT(cfg, MAX_GROUPS, "number of filters in each group");

struct filter {
    hal_bool_t in, out;
    rtapi_s32 state;
};

struct group {
    int filters;
    hal_sint_t delay;
    struct filter *filter;
};

static int comp_id;

/* HAL function debounce.G. */
static void debounce(void *arg, long period)
{
    struct group *g = arg;
    rtapi_s32 delay = hal_get_si32(g->delay);
    int i;
    (void)period;
    if(delay < 0) delay = hal_set_si32(g->delay, 1);
    for(i = 0; i < g->filters; i++) {
        struct filter *f = &g->filter[i];
        if(hal_get_bool(f->in)) {
            if(f->state < delay) f->state++;
            else hal_set_bool(f->out, 1);
        } else {
            if(f->state > 0) f->state--;
            else hal_set_bool(f->out, 0);
        }
    }
}

static int export_group(int n)
{
    int i;
    struct group *g = hal_malloc(sizeof *g);
    if(!g) return -ENOMEM;
    g->filters = cfg[n];
    g->filter = hal_malloc((long)sizeof *g->filter * cfg[n]);
    if(!g->filter) return -ENOMEM;
    COMP_TRY(hal_param_new_si32(comp_id, HAL_RW, &g->delay, 5, "debounce.%d.delay", n));
    for(i = 0; i < cfg[n]; i++) {
        COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &g->filter[i].in, 0, "debounce.%d.%d.in", n, i));
        COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &g->filter[i].out, 0, "debounce.%d.%d.out", n, i));
    }
    return hal_export_functf(debounce, g, 0, 0, comp_id, "debounce.%d", n);
}

static int check_parameters(void)
{
    int n;
    for(n = 0; n < MAX_GROUPS && cfg[n]; n++) {
        if(cfg[n] < 1 || cfg[n] > MAX_FILTERS) {
            rtapi_print_msg(RTAPI_MSG_ERR, "DEBOUNCE: ERROR: bad group size '%d'\n", cfg[n]);
            return -1;
        }
    }
    if(n == 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "DEBOUNCE: ERROR: no channels configured\n");
        return -1;
    }
    return n;
}

int rtapi_app_main(void)
{
    int i, groups, r = 0;
    COMP_TRY(groups = check_parameters());
    comp_id = hal_init("debounce");
    if(comp_id < 0) return comp_id;
    for(i = 0; r >= 0 && i < groups; i++) r = export_group(i);
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
