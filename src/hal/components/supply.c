/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * supply.c - constant values for other components.
 *
 * Thread: N.update [any]
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <hal.h>
#include "components/comp_util.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Constant values");

#define MAX_CHAN 16

static int num_chan = 1;
RTAPI_MP_INT(num_chan, "number of supplies");

struct supply {
    hal_bool_t q, not_q, d;
    hal_real_t variable, minus_variable, value;
};

static int comp_id;

/* HAL function supply.N.update. */
static void update(void *arg, long period)
{
    struct supply *s = arg;
    int d = hal_get_bool(s->d);
    double value = hal_get_real(s->value);
    (void)period;
    hal_set_bool(s->q, d);
    hal_set_bool(s->not_q, !d);
    hal_set_real(s->variable, value);
    hal_set_real(s->minus_variable, -value);
}

static int export_supply(struct supply *s, int n)
{
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &s->q, 0, "supply.%d.q", n));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &s->not_q, 1, "supply.%d._q", n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &s->variable, 0, "supply.%d.variable", n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &s->minus_variable, 0, "supply.%d._variable", n));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IO, &s->d, 0, "supply.%d.d", n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IO, &s->value, 0, "supply.%d.value", n));
    return hal_export_functf(update, s, 1, 0, comp_id, "supply.%d.update", n);
}

static int export_all(void)
{
    int i;
    struct supply *supplies = hal_malloc((long)sizeof *supplies * num_chan);
    if(!supplies) return -ENOMEM;
    for(i = 0; i < num_chan; i++) COMP_TRY(export_supply(&supplies[i], i));
    return 0;
}

int rtapi_app_main(void)
{
    int r;
    if(num_chan < 1 || num_chan > MAX_CHAN) {
        rtapi_print_msg(RTAPI_MSG_ERR, "SUPPLY: ERROR: invalid num_chan: %d\n", num_chan);
        return -1;
    }
    comp_id = hal_init("supply");
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
