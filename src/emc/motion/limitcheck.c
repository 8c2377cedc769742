/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * limitcheck.c - watches position commands against limits, every cycle.
 *
 * In:     loadrt limitcheck count=N (1 to 64, default 1); pins of each instance
 * Out:    worst values and violations since the last reset
 * Thread: servo, function limitcheck.N after motion-controller
 * Method: differences of consecutive commands over the thread's nominal period;
 *         a value counts once its whole history was taken while enabled.
 *
 * Pins of limitcheck.N (units of the watched command, seconds):
 *   in  float pos-cmd                the command, usually joint.N.pos-cmd
 *   in  float max-vel max-acc max-jerk   limits, 0 = not checked
 *   in  float min-pos max-pos        limits, both 0 = not checked
 *   in  float tolerance              relative, for speed, acceleration, jerk (default 0.001)
 *   in  float pos-tolerance          absolute, for positions (default 1e-6)
 *   in  bit   enable                 1 (default): watch; rising edge primes the history
 *   in  bit   reset                  1: forget worst values, violations and history
 *   out float worst-vel worst-acc worst-jerk  largest magnitudes
 *   out float worst-min worst-max    least and greatest position
 *   out float worst-vel-time worst-acc-time worst-jerk-time  when, s of watching since reset
 *   out bit   vel-violation acc-violation jerk-violation pos-violation  latched
 *   out float violation-time         of the first violation, s of watching; -1 none
 *   out float violation-value        the value that was too large; 0 none
 *   out u32   cycles                 watched since reset
 */
#include <math.h>
#include "hal.h"
#include "rtapi.h"
#include "rtapi_app.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Watches position commands against velocity, acceleration, jerk and position limits");
MODULE_LICENSE("GPL");

#define MAX_INSTANCES 64
static int count = 1;
RTAPI_MP_INT(count, "number of instances");

struct instance {
    hal_real_t pos_cmd, max_vel, max_acc, max_jerk, min_pos, max_pos, tolerance, pos_tolerance;
    hal_bool_t enable, reset;
    hal_real_t worst[3], worst_time[3], worst_min, worst_max;
    hal_bool_t violation[3], pos_violation;
    hal_real_t violation_time, violation_value;
    hal_uint_t cycles;
    double p[3];  /* commands of the last cycles, newest first */
    int known;    /* how many of them */
    double time_s;
};

static int comp_id;
static struct instance *instances;

static void forget(struct instance *i)
{
    for (int k = 0; k < 3; k++) {
        hal_set_real(i->worst[k], 0.0);
        hal_set_real(i->worst_time[k], 0.0);
        hal_set_bool(i->violation[k], 0);
    }
    hal_set_bool(i->pos_violation, 0);
    hal_set_real(i->violation_time, -1.0);
    hal_set_real(i->violation_value, 0.0);
    hal_set_real(i->worst_min, 0.0);
    hal_set_real(i->worst_max, 0.0);
    hal_set_ui32(i->cycles, 0);
    i->known = 0;
    i->time_s = 0.0;
}

static void note_violation(struct instance *i, hal_bool_t which, double value)
{
    if (hal_get_real(i->violation_time) < 0.0) {
        hal_set_real(i->violation_time, i->time_s);
        hal_set_real(i->violation_value, value);
    }
    hal_set_bool(which, 1);
}

static void watch_rate(struct instance *i, int k, double value, double limit)
{
    double size = fabs(value);
    if (!(size <= hal_get_real(i->worst[k]))) { /* a value that is no number is worst */
        hal_set_real(i->worst[k], size);
        hal_set_real(i->worst_time[k], i->time_s);
    }
    if (limit > 0.0 && !(size <= limit * (1.0 + hal_get_real(i->tolerance))))
        note_violation(i, i->violation[k], value);
}

static void watch_position(struct instance *i, double p, int first)
{
    double lo = hal_get_real(i->min_pos), hi = hal_get_real(i->max_pos), tol = hal_get_real(i->pos_tolerance);
    if (first || p < hal_get_real(i->worst_min))
        hal_set_real(i->worst_min, p);
    if (first || p > hal_get_real(i->worst_max))
        hal_set_real(i->worst_max, p);
    if ((lo != 0.0 || hi != 0.0) && !(p >= lo - tol && p <= hi + tol))
        note_violation(i, i->pos_violation, p);
}

static void watch(void *arg, long period_ns)
{
    struct instance *i = arg;
    double T = (double)period_ns * 1e-9, p = hal_get_real(i->pos_cmd);
    if (hal_get_bool(i->reset)) {
        forget(i);
        return;
    }
    if (!hal_get_bool(i->enable)) {
        i->known = 0;
        return;
    }
    i->time_s += T;
    watch_position(i, p, hal_get_ui32(i->cycles) == 0);
    hal_set_ui32(i->cycles, hal_get_ui32(i->cycles) + 1);
    if (i->known >= 1)
        watch_rate(i, 0, (p - i->p[0]) / T, hal_get_real(i->max_vel));
    if (i->known >= 2)
        watch_rate(i, 1, ((p - i->p[0]) - (i->p[0] - i->p[1])) / (T * T), hal_get_real(i->max_acc));
    if (i->known >= 3)
        watch_rate(i, 2, ((p - i->p[2]) - 3.0 * (i->p[0] - i->p[1])) / (T * T * T), hal_get_real(i->max_jerk));
    i->p[2] = i->p[1];
    i->p[1] = i->p[0];
    i->p[0] = p;
    if (i->known < 3)
        i->known++;
}

static int make_instance(int n)
{
    static const char *const rate[] = {"vel", "acc", "jerk"};
    struct instance *i = &instances[n];
    int r = 0, id = comp_id;
    r |= hal_pin_new_real(id, HAL_IN, &i->pos_cmd, 0, "limitcheck.%d.pos-cmd", n);
    r |= hal_pin_new_real(id, HAL_IN, &i->max_vel, 0, "limitcheck.%d.max-vel", n);
    r |= hal_pin_new_real(id, HAL_IN, &i->max_acc, 0, "limitcheck.%d.max-acc", n);
    r |= hal_pin_new_real(id, HAL_IN, &i->max_jerk, 0, "limitcheck.%d.max-jerk", n);
    r |= hal_pin_new_real(id, HAL_IN, &i->min_pos, 0, "limitcheck.%d.min-pos", n);
    r |= hal_pin_new_real(id, HAL_IN, &i->max_pos, 0, "limitcheck.%d.max-pos", n);
    r |= hal_pin_new_real(id, HAL_IN, &i->tolerance, 0.001, "limitcheck.%d.tolerance", n);
    r |= hal_pin_new_real(id, HAL_IN, &i->pos_tolerance, 1e-6, "limitcheck.%d.pos-tolerance", n);
    r |= hal_pin_new_bool(id, HAL_IN, &i->enable, 1, "limitcheck.%d.enable", n);
    r |= hal_pin_new_bool(id, HAL_IN, &i->reset, 0, "limitcheck.%d.reset", n);
    for (int k = 0; k < 3; k++) {
        r |= hal_pin_new_real(id, HAL_OUT, &i->worst[k], 0, "limitcheck.%d.worst-%s", n, rate[k]);
        r |= hal_pin_new_real(id, HAL_OUT, &i->worst_time[k], 0, "limitcheck.%d.worst-%s-time", n, rate[k]);
        r |= hal_pin_new_bool(id, HAL_OUT, &i->violation[k], 0, "limitcheck.%d.%s-violation", n, rate[k]);
    }
    r |= hal_pin_new_real(id, HAL_OUT, &i->worst_min, 0, "limitcheck.%d.worst-min", n);
    r |= hal_pin_new_real(id, HAL_OUT, &i->worst_max, 0, "limitcheck.%d.worst-max", n);
    r |= hal_pin_new_bool(id, HAL_OUT, &i->pos_violation, 0, "limitcheck.%d.pos-violation", n);
    r |= hal_pin_new_real(id, HAL_OUT, &i->violation_time, -1.0, "limitcheck.%d.violation-time", n);
    r |= hal_pin_new_real(id, HAL_OUT, &i->violation_value, 0, "limitcheck.%d.violation-value", n);
    r |= hal_pin_new_ui32(id, HAL_OUT, &i->cycles, 0, "limitcheck.%d.cycles", n);
    r |= hal_export_functf(watch, i, 1, 0, id, "limitcheck.%d", n);
    return r < 0 ? r : 0;
}

int rtapi_app_main(void)
{
    if (count < 1 || count > MAX_INSTANCES) {
        rtapi_print_msg(RTAPI_MSG_ERR, "limitcheck: count is %d, must be between 1 and %d\n", count, MAX_INSTANCES);
        return -EINVAL;
    }
    comp_id = hal_init("limitcheck");
    if (comp_id < 0)
        return comp_id;
    instances = hal_malloc((long)sizeof(*instances) * count);
    int r = instances ? 0 : -ENOMEM;
    for (int n = 0; n < count && r == 0; n++)
        r = make_instance(n);
    if (r < 0) {
        hal_exit(comp_id);
        return r;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void) { hal_exit(comp_id); }
