/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * spindle.c - spindle control: gears, limits, acceleration, at-speed.
 *
 * In:     commanded speed (rpm), measured speed (rps), gear, limits of each gear
 * Out:    output for the drive, direction, states
 * Thread: one function per instance [servo], bounded by the number of gears
 *
 * Speeds are single precision, as documented.
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <rtapi_math.h>
#include <rtapi_string.h>
#include <hal.h>
#include "components/comp_util.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Spindle control");

#define MAX_INSTANCES 16
#define MAX_GEARS 16

static int count;
RTAPI_MP_INT(count, "number of spindles");
static char *names[MAX_INSTANCES];
RTAPI_MP_ARRAY_STRING(names, MAX_INSTANCES, "names of the spindles");
static int numgears[MAX_INSTANCES] = { [0 ... MAX_INSTANCES - 1] = 1 };
RTAPI_MP_ARRAY_INT(numgears, MAX_INSTANCES, "number of gears of each spindle");

struct gear {
    hal_real_t scale, min, max, accel, decel, speed_tolerance, zero_tolerance, offset;
    hal_bool_t select;
};

struct spindle {
    int gears;
    struct gear gear[MAX_GEARS];
    hal_uint_t select_gear, current_gear;
    hal_real_t commanded_speed, actual_speed, lpf, rpm, rpm_abs, output;
    hal_bool_t simulate_encoder, enable, at_speed, forward, reverse, brake, zero_speed, limited;
};

static int comp_id;

/* The gear in use; current-gear shows it. */
static const struct gear *choose_gear(struct spindle *s)
{
    rtapi_u32 wanted = hal_get_ui32(s->select_gear), chosen = 0;
    if(wanted) {
        chosen = wanted < (rtapi_u32)s->gears ? wanted : (rtapi_u32)s->gears - 1;
    } else {
        int g;
        for(g = 0; g < s->gears; g++)
            if(hal_get_bool(s->gear[g].select)) chosen = (rtapi_u32)g;
    }
    hal_set_ui32(s->current_gear, chosen);
    return &s->gear[chosen];
}

static void measure(struct spindle *s, float speed, float zero_tolerance, float dt)
{
    float lpf = (float)hal_get_real(s->lpf), before = (float)hal_get_real(s->rpm_abs), size = fabsf(speed);
    hal_set_bool(s->zero_speed, size <= zero_tolerance);
    if(lpf > 0 && hal_get_bool(s->at_speed) && isfinite(before))
        hal_set_real(s->rpm_abs, before + (size - before) * lpf * dt);
    else
        hal_set_real(s->rpm_abs, size);
}

/* The command within the speed limits of the gear. */
static float limit_command(const struct gear *g, float cmd, int *limited)
{
    float min = (float)hal_get_real(g->min), max = (float)hal_get_real(g->max), wanted = cmd;
    if(min > 0) {
        if(cmd > 0 && cmd < min) cmd = min;
        else if(cmd < 0 && cmd > -min) cmd = -min;
    }
    if(max > 0) {
        if(cmd > max) cmd = max;
        else if(cmd < -max) cmd = -max;
    }
    if(cmd != wanted) *limited = 1;
    return cmd;
}

/* Change of the speed in this cycle, within acceleration and deceleration. */
static float limit_change(const struct gear *g, float cmd, float speed, int reversing, float unit)
{
    float accel = (float)hal_get_real(g->accel), decel = (float)hal_get_real(g->decel), d = cmd - speed;
    if(speed > 0 && d < -speed) d = -speed;
    else if(speed < 0 && d > -speed) d = -speed;
    if(accel > 0 && !reversing) {
        accel *= unit;
        if(cmd > 0 && d > accel) d = accel;
        else if(cmd < 0 && d < -accel) d = -accel;
    }
    if(decel > 0) {
        decel *= unit;
        if(reversing) {
            if(cmd >= 0 && d > decel) d = decel;
            else if(cmd <= 0 && d < -decel) d = -decel;
        } else {
            if(cmd >= 0 && d < -decel) d = -decel;
            else if(cmd <= 0 && d > decel) d = decel;
        }
    }
    return d;
}

/* HAL function spindle.N. [servo] */
static void run(void *arg, long period)
{
    struct spindle *s = arg;
    const struct gear *g = choose_gear(s);
    float dt = (float)(period * 1e-9), speed, cmd, change, tolerance;
    int simulate = hal_get_bool(s->simulate_encoder), reversing, at_speed, limited = 0;
    if(!simulate) hal_set_real(s->rpm, (float)(hal_get_real(s->actual_speed) * 60));
    speed = (float)hal_get_real(s->rpm);
    if(!isfinite(speed)) speed = 0;
    cmd = hal_get_bool(s->enable) ? (float)hal_get_real(s->commanded_speed) : 0;

    measure(s, speed, (float)hal_get_real(g->zero_tolerance), dt);
    reversing = (cmd > 0 && speed < 0) || (cmd < 0 && speed > 0);
    tolerance = (float)hal_get_real(g->speed_tolerance);
    at_speed = tolerance > 0 && tolerance >= fabsf(cmd - speed) && !reversing;
    hal_set_bool(s->at_speed, at_speed);
    cmd = limit_command(g, cmd, &limited);
    change = limit_change(g, cmd, speed, reversing, simulate ? dt : 1);
    speed = at_speed ? cmd : speed + change;
    if(simulate) hal_set_real(s->rpm, speed);
    if(cmd != 0) {
        hal_set_bool(s->forward, speed > 0);
        hal_set_bool(s->reverse, speed < 0);
    } else {
        hal_set_bool(s->forward, speed > 0 && hal_get_bool(s->forward));
        hal_set_bool(s->reverse, speed < 0 && hal_get_bool(s->forward));
    }
    hal_set_real(s->output, (fabsf(speed) + (float)hal_get_real(g->offset)) * (float)hal_get_real(g->scale));
    hal_set_bool(s->limited, limited);
}

static int export_gear(struct gear *g, const char *name, int n, int only)
{
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &g->scale, 1, "%s.scale.%d", name, n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &g->min, 0, "%s.min.%d", name, n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &g->max, 0, "%s.max.%d", name, n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &g->accel, 0, "%s.accel.%d", name, n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &g->decel, 0, "%s.decel.%d", name, n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &g->speed_tolerance, 20, "%s.speed-tolerance.%d", name, n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &g->zero_tolerance, 20, "%s.zero-tolerance.%d", name, n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &g->offset, 0, "%s.offset.%d", name, n));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &g->select, only, "%s.select.%d", name, n));
    return 0;
}

static int export_spindle(int n, const char *name)
{
    int g;
    struct spindle *s = hal_malloc(sizeof *s);
    if(!s) return -ENOMEM;
    s->gears = numgears[n];
    COMP_TRY(hal_pin_new_ui32(comp_id, HAL_IN, &s->select_gear, 0, "%s.select-gear", name));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &s->commanded_speed, 0, "%s.commanded-speed", name));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &s->actual_speed, 0, "%s.actual-speed", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &s->simulate_encoder, 0, "%s.simulate-encoder", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &s->enable, 0, "%s.enable", name));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &s->lpf, 0, "%s.spindle-lpf", name));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &s->rpm, 0, "%s.spindle-rpm", name));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &s->rpm_abs, 0, "%s.spindle-rpm-abs", name));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &s->output, 0, "%s.output", name));
    COMP_TRY(hal_pin_new_ui32(comp_id, HAL_OUT, &s->current_gear, 0, "%s.current-gear", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &s->at_speed, 0, "%s.at-speed", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &s->forward, 0, "%s.forward", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &s->reverse, 0, "%s.reverse", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &s->brake, 0, "%s.brake", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &s->zero_speed, 0, "%s.zero-speed", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &s->limited, 0, "%s.limited", name));
    for(g = 0; g < s->gears; g++) COMP_TRY(export_gear(&s->gear[g], name, g, s->gears == 1));
    return hal_export_functf(run, s, 1, 0, comp_id, "%s", name);
}

static int export_all(int n)
{
    int i;
    for(i = 0; i < n; i++) {
        char name[HAL_NAME_LEN + 1];
        if(names[i] && names[i][0]) rtapi_snprintf(name, sizeof name, "%s", names[i]);
        else rtapi_snprintf(name, sizeof name, "spindle.%d", i);
        if(numgears[i] < 1 || numgears[i] > MAX_GEARS) {
            rtapi_print_msg(RTAPI_MSG_ERR, "Number of gears is out of range\n");
            return -EINVAL;
        }
        COMP_TRY(export_spindle(i, name));
    }
    return 0;
}

int rtapi_app_main(void)
{
    int n, r;
    COMP_TRY(n = comp_instances("SPINDLE", count, names, MAX_INSTANCES, 1));
    comp_id = hal_init("spindle");
    if(comp_id < 0) return comp_id;
    r = export_all(n);
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
