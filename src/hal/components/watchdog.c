/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * watchdog.c - one or more heartbeats that must not stop.
 *
 * In:     heartbeats, time-outs (s), enable
 * Out:    ok
 * Thread: process [base], set-timeouts [servo]; bounded by the number of inputs
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <rtapi_math.h>
#include <hal.h>
#include "components/comp_util.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Watchdog of heartbeats");

#define MAX_INPUTS 32

static int num_inputs;
RTAPI_MP_INT(num_inputs, "number of heartbeats");

struct heartbeat {
    hal_bool_t input;
    hal_real_t timeout;
    int last;
    double seen_timeout;
    rtapi_s64 limit_ns;                 /* written by set-timeouts */
    rtapi_s64 left_ns;                  /* of process; set by set-timeouts while not ok */
};

static int comp_id;
static struct watchdog {
    hal_bool_t ok_out, enable_in;
    int was_enabled;
    struct heartbeat beat[MAX_INPUTS];
} *dog;

/* HAL function watchdog.process. [base] */
static void process(void *arg, long period)
{
    int i, fault = 0;
    (void)arg;
    if(!hal_get_bool(dog->enable_in) || !hal_get_bool(dog->ok_out)) return;
    for(i = 0; i < num_inputs; i++) {
        struct heartbeat *b = &dog->beat[i];
        int now = hal_get_bool(b->input);
        if(now != b->last) {
            b->left_ns = b->limit_ns;
        } else {
            b->left_ns -= period;
            if(b->left_ns < 0) {
                b->left_ns = 0;
                fault = 1;
            }
        }
        b->last = now;
    }
    if(fault) hal_set_bool(dog->ok_out, 0);
}

/* HAL function watchdog.set-timeouts. [servo] */
static void set_timeouts(void *arg, long period)
{
    int i, enabled = hal_get_bool(dog->enable_in);
    (void)arg;
    (void)period;
    for(i = 0; i < num_inputs; i++) {
        struct heartbeat *b = &dog->beat[i];
        double timeout = hal_get_real(b->timeout);
        if(!(timeout > 0)) timeout = 0;
        if(timeout > 1e9) timeout = 1e9;
        if(timeout != b->seen_timeout) {
            b->seen_timeout = timeout;
            b->limit_ns = (rtapi_s64)floor(timeout) * 1000000000
                + (rtapi_s64)(1e9 * (timeout - floor(timeout)));
        }
    }
    if(!hal_get_bool(dog->ok_out) && enabled && !dog->was_enabled) {
        for(i = 0; i < num_inputs; i++) dog->beat[i].left_ns = dog->beat[i].limit_ns;
        hal_set_bool(dog->ok_out, 1);
    }
    dog->was_enabled = enabled;
}

static int export_all(void)
{
    int i;
    dog = hal_malloc(sizeof *dog);
    if(!dog) return -ENOMEM;
    for(i = 0; i < num_inputs; i++) {
        COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &dog->beat[i].input, 0, "watchdog.input-%d", i));
        COMP_TRY(hal_param_new_real(comp_id, HAL_RW, &dog->beat[i].timeout, 0, "watchdog.timeout-%d", i));
    }
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &dog->ok_out, 0, "watchdog.ok-out"));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &dog->enable_in, 0, "watchdog.enable-in"));
    COMP_TRY(hal_export_funct("watchdog.process", process, NULL, 0, 0, comp_id));
    COMP_TRY(hal_export_funct("watchdog.set-timeouts", set_timeouts, NULL, 1, 0, comp_id));
    return 0;
}

int rtapi_app_main(void)
{
    int r;
    if(num_inputs < 1) {
        rtapi_print_msg(RTAPI_MSG_ERR, "WATCHDOG: ERROR: must specify at least one input\n");
        return -1;
    }
    if(num_inputs > MAX_INPUTS) {
        rtapi_print_msg(RTAPI_MSG_ERR, "WATCHDOG: ERROR: too many inputs requested (%d > %d)\n", num_inputs,
                        MAX_INPUTS);
        return -1;
    }
    comp_id = hal_init("watchdog");
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
