/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * stepgen.c - step pulses in software.
 *
 * In:     position or velocity command (units, units/s), per channel
 * Out:    step and direction, up and down, or phases; position feedback (units)
 * Thread: make-pulses [base], update-freq and capture-position [servo]
 * Method: phase accumulation. `accum` counts steps in units of 2^-28; each pass of
 *         make-pulses adds the frequency, and a change of bit 28 is a step.
 *         update-freq chooses the frequency so that the position meets the command
 *         without exceeding velocity and acceleration.
 *
 * The accumulator is modulo 2^64 and each reader extends it to 128 bits, so a
 * channel may turn in one direction for ever.
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <rtapi_math.h>
#include <rtapi_string.h>
#include <hal.h>
#include "components/comp_util.h"
#include "components/real_to_int.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Step pulse generator in software");

#define MAX_CHAN 16
#define MAX_CYCLE 18
#define MAX_PHASES 5
#define USER_TYPE 15
#define PICKOFF 28                      /* bit of the accumulator that is one step */
#define ONE_STEP ((double)(1 << PICKOFF))
#define SETUP_MATTERS_NS 10             /* shorter ones are not asked for by hardware */
#define HALF_STEP ((rtapi_s64)1 << (PICKOFF - 1))

static int step_type[MAX_CHAN] = { [0 ... MAX_CHAN - 1] = -1 };
RTAPI_MP_ARRAY_INT(step_type, MAX_CHAN, "stepping type of each channel");
static char *ctrl_type[MAX_CHAN];
RTAPI_MP_ARRAY_STRING(ctrl_type, MAX_CHAN, "control of each channel: p position, v velocity");
static int user_step_type[MAX_CYCLE] = { [0 ... MAX_CYCLE - 1] = -1 };
RTAPI_MP_ARRAY_INT(user_step_type, MAX_CYCLE, "phase patterns of step type 15");

/* Patterns of the phase outputs, phase A in bit 0. */
struct pattern {
    int phases, length;
    unsigned char state[MAX_CYCLE];
};
static struct pattern patterns[USER_TYPE + 1] = {
    [2] = { 2, 4, { 1, 3, 2, 0 } },
    [3] = { 3, 3, { 1, 2, 4 } },
    [4] = { 3, 6, { 1, 3, 2, 6, 4, 5 } },
    [5] = { 4, 4, { 1, 2, 4, 8 } },
    [6] = { 4, 4, { 3, 6, 12, 9 } },
    [7] = { 4, 4, { 1, 7, 14, 8 } },
    [8] = { 4, 4, { 5, 6, 10, 9 } },
    [9] = { 4, 8, { 1, 3, 2, 6, 4, 12, 8, 9 } },
    [10] = { 4, 8, { 1, 5, 7, 6, 14, 10, 8, 9 } },
    [11] = { 5, 5, { 1, 2, 4, 8, 16 } },
    [12] = { 5, 5, { 3, 6, 12, 24, 17 } },
    [13] = { 5, 10, { 1, 3, 2, 6, 4, 12, 8, 24, 16, 17 } },
    [14] = { 5, 10, { 3, 7, 6, 14, 12, 28, 24, 25, 17, 19 } },
};

/* A reader's view of the accumulator: 128 bits from one that wraps at 64. */
struct position {
    rtapi_u64 seen;
    __int128 steps;                     /* units of 2^-28 step */
};

/* One of steplen, stepspace, dirsetup, dirhold/dirdelay: a parameter in ns that is
 * kept at a multiple of the base period. */
struct timing {
    hal_uint_t ns;
    rtapi_u32 accepted;                 /* the value, rounded */
    rtapi_u32 wanted;                   /* the value as it was set */
};

struct channel {
    /* Of make-pulses; enable is read by both threads. */
    const struct pattern *pattern;      /* NULL for types 0 and 1 */
    int type;
    rtapi_u64 accum;                    /* atomic; written by [base] only */
    rtapi_s32 addval;                   /* step rate per pass; [base], and [servo] while disabled */
    rtapi_s32 target_addval, deltalim;  /* atomic; written by [servo] */
    rtapi_u64 step_timer, hold_timer, setup_timer;  /* ns, from the last step */
    rtapi_u64 dir_timer;                /* ns, from the last change of dir (type 0) */
    int held, direction, state;
    hal_bool_t enable;
    hal_sint_t rawcounts;
    hal_bool_t out[MAX_PHASES];         /* step dir, up down, or phases */
    struct timing steplen, stepspace, dirsetup, dirdelay;

    /* Of update-freq and capture-position. */
    int velocity_mode, warned;
    double old_cmd;                     /* steps */
    struct position update, capture;
    hal_real_t position_scale, command, position_fb, frequency, maxvel, maxaccel;
    hal_sint_t counts;
    double update_scale, capture_scale;
};

static int comp_id, channels;
static struct channel *channel;
static rtapi_s32 base_period = 50000;   /* ns; atomic; written by make-pulses */
static rtapi_s32 update_base_period;    /* what update-freq has computed with */
static double freq_scale, accel_scale;  /* steps/s to addval, steps/s^2 to deltalim */

/* ---- [base] -------------------------------------------------------------- */

static rtapi_u64 count_down(rtapi_u64 timer, rtapi_u32 period)
{
    return timer > period ? timer - period : 0;
}

/* Moves addval toward its target; true if the direction reverses. */
static int ramp_addval(struct channel *c)
{
    rtapi_s32 target = __atomic_load_n(&c->target_addval, __ATOMIC_RELAXED);
    rtapi_s32 limit = __atomic_load_n(&c->deltalim, __ATOMIC_RELAXED);
    rtapi_s32 old = c->addval;
    rtapi_s64 new = target;
    if(limit != 0) {
        if(new > (rtapi_s64)old + limit) new = (rtapi_s64)old + limit;
        else if(new < (rtapi_s64)old - limit) new = (rtapi_s64)old - limit;
    }
    c->addval = (rtapi_s32)new;
    return (new >= 0) != (old >= 0);
}

static void write_outputs(struct channel *c)
{
    int i;
    if(c->pattern) {
        int bits = c->pattern->state[c->state];
        for(i = 0; i < c->pattern->phases; i++) hal_set_bool(c->out[i], (bits >> i) & 1);
    } else if(c->type == 0) {
        hal_set_bool(c->out[0], c->step_timer != 0);
        hal_set_bool(c->out[1], c->direction < 0);
    } else {
        hal_set_bool(c->out[0], c->step_timer != 0 && c->direction >= 0);
        hal_set_bool(c->out[1], c->step_timer != 0 && c->direction < 0);
    }
}

/* Type 0: true while the direction output has not been (or will not be) stable for
 * dirsetup, so that no step may come. Times too short for any drive, as the default
 * of 1 ns, mean that it may come together with the direction. */
static int direction_unsettled(const struct channel *c)
{
    int turns = c->hold_timer == 0 && c->addval != 0 && (c->addval > 0) != (c->direction >= 0);
    return c->dirsetup.wanted >= SETUP_MATTERS_NS && (c->dir_timer != 0 || turns);
}

static void make_channel_pulses(struct channel *c, rtapi_u32 period)
{
    int step = 0, before = c->direction, enabled = hal_get_bool(c->enable);
    c->step_timer = count_down(c->step_timer, period);
    c->hold_timer = count_down(c->hold_timer, period);
    if(c->setup_timer) {
        c->setup_timer = count_down(c->setup_timer, period);
        if(c->setup_timer == 0) c->held = 0;
    }
    if(!c->held && enabled && ramp_addval(c) && c->setup_timer) c->held = 1;
    if(!c->held && enabled) {
        rtapi_u64 next = c->accum + (rtapi_u64)(rtapi_s64)c->addval;
        step = ((c->accum ^ next) >> PICKOFF) & 1;
        if(step && c->type == 0 && direction_unsettled(c)) {
            step = 0;
            next = c->accum;
        }
        __atomic_store_n(&c->accum, next, __ATOMIC_RELAXED);
        hal_set_si32(c->rawcounts, (rtapi_s32)(rtapi_u32)(next >> PICKOFF));
    }
    if(c->dir_timer) c->dir_timer = count_down(c->dir_timer, period);
    if(c->hold_timer == 0 && c->addval != 0) c->direction = c->addval > 0 ? 1 : -1;
    if(c->type == 0 && (c->direction < 0) != (before < 0)) c->dir_timer = hal_get_ui32(c->dirsetup.ns);
    if(step) {
        c->step_timer = hal_get_ui32(c->steplen.ns);
        c->hold_timer = c->step_timer + hal_get_ui32(c->dirdelay.ns);
        c->setup_timer = c->hold_timer + (c->type == 0 ? hal_get_ui32(c->dirsetup.ns) : 0);
        if(c->pattern) {
            c->state += c->direction;
            if(c->state < 0) c->state = c->pattern->length - 1;
            else if(c->state >= c->pattern->length) c->state = 0;
        }
    }
    write_outputs(c);
}

/* HAL function stepgen.make-pulses. [base], bounded by the number of channels. */
static void make_pulses(void *arg, long period)
{
    int i;
    (void)arg;
    __atomic_store_n(&base_period, (rtapi_s32)period, __ATOMIC_RELAXED);
    for(i = 0; i < channels; i++) make_channel_pulses(&channel[i], (rtapi_u32)period);
}

/* ---- [servo] ------------------------------------------------------------- */

static void read_position(struct channel *c, struct position *p)
{
    rtapi_u64 accum = __atomic_load_n(&c->accum, __ATOMIC_RELAXED);
    p->steps += (rtapi_s64)(accum - p->seen);
    p->seen = accum;
}

/* Position in steps: half a step before the change of the count. */
static double position_steps(const struct position *p)
{
    return (double)(p->steps - HALF_STEP) * (1.0 / ONE_STEP);
}

/* Takes over a changed scale; one that cannot divide becomes 1. One that is 0 from the start
 * on stays: such a channel does not move. */
static double checked_scale(struct channel *c, double *seen)
{
    double scale = hal_get_real(c->position_scale);
    if(scale != *seen) {
        *seen = comp_scale(scale);
        if(*seen != scale) hal_set_real(c->position_scale, *seen);
    }
    return *seen;
}

/* HAL function stepgen.capture-position. [servo] */
static void capture_position(void *arg, long period)
{
    int i;
    (void)arg;
    (void)period;
    for(i = 0; i < channels; i++) {
        struct channel *c = &channel[i];
        double scale = checked_scale(c, &c->capture_scale);
        double recip = scale == 0 ? 0 : (1.0 / ONE_STEP) / scale;
        read_position(c, &c->capture);
        hal_set_si32(c->counts, (rtapi_s32)(rtapi_u32)(c->capture.seen >> PICKOFF));
        hal_set_real(c->position_fb, (double)(c->capture.steps - HALF_STEP) * recip);
    }
}

/* ns rounded up to a multiple of the base period. */
static rtapi_u32 round_up(rtapi_u32 ns, rtapi_u32 period)
{
    rtapi_u64 rounded = ns ? ((rtapi_u64)(ns - 1) / period + 1) * period : 0;
    return rounded > RTAPI_UINT32_MAX ? RTAPI_UINT32_MAX / period * period : (rtapi_u32)rounded;
}

static rtapi_u32 accept_timing(struct timing *t, rtapi_u32 least, rtapi_u32 period, int again)
{
    rtapi_u32 ns = hal_get_ui32(t->ns);
    if(again || ns != t->accepted) {
        if(ns != t->accepted) t->wanted = ns;
        if(ns < least) ns = least;
        t->accepted = round_up(ns, period);
        hal_set_ui32(t->ns, t->accepted);
    }
    return t->accepted;
}

/* Rounds the timing parameters; returns the highest step rate they allow, steps/s. */
static double timing_limit(struct channel *c, rtapi_u32 period, int again)
{
    rtapi_u32 len = accept_timing(&c->steplen, 1, period, again), space = 0, setup = 0, delay;
    if(c->type < 2) space = accept_timing(&c->stepspace, 0, period, again);
    if(c->type == 0) setup = accept_timing(&c->dirsetup, 0, period, again);
    delay = hal_get_ui32(c->dirdelay.ns);
    accept_timing(&c->dirdelay, c->type < 2 && setup + delay == 0 ? 1 : 0, period, again);
    return 1.0e9 / ((double)len + space);
}

/* Limits of this cycle in steps; writes back parameters that ask for more than is
 * possible. */
static void motion_limits(struct channel *c, int number, double scale, double dt,
                          double *max_freq, double *max_accel)
{
    double most = *max_freq, vel = hal_get_real(c->maxvel), accel = hal_get_real(c->maxaccel);
    double size = fabs(scale);
    if(!(vel > 0)) {
        hal_set_real(c->maxvel, 0);
    } else if(vel * size > most) {
        if(!c->warned) {
            c->warned = 1;
            rtapi_print_msg(RTAPI_MSG_ERR,
                            "STEPGEN: Channel %d: The requested maximum velocity of %d steps/sec is too high.\n",
                            number, real_to_s32(vel * size));
            rtapi_print_msg(RTAPI_MSG_ERR, "STEPGEN: The maximum possible frequency is %d steps/second\n",
                            real_to_s32(most));
        }
        hal_set_real(c->maxvel, most / size);
    } else {
        *max_freq = vel * size;
    }
    *max_accel = *max_freq / dt;
    if(!(accel > 0)) hal_set_real(c->maxaccel, 0);
    else if(accel * size > *max_accel) hal_set_real(c->maxaccel, *max_accel / size);
    else *max_accel = accel * size;
}

static double clamp(double x, double low, double high)
{
    return x < low ? low : x > high ? high : x;
}

/* Step rate that brings the position to the command: at the end of the time that
 * matching velocities takes, both are to be at the same place. */
static double follow_position(struct channel *c, double cmd, double old_freq, double max_accel, double dt)
{
    double vel_cmd = (cmd - c->old_cmd) / dt, pos;
    double accel, match_time, est_out, est_cmd, err;
    c->old_cmd = cmd;
    pos = position_steps(&c->update);
    accel = vel_cmd > old_freq ? max_accel : -max_accel;
    match_time = (vel_cmd - old_freq) / accel;
    est_out = pos + 0.5 * (vel_cmd + old_freq) * match_time;
    est_cmd = cmd + vel_cmd * (match_time - 1.5 * dt);
    err = est_out - est_cmd;
    if(match_time < dt) {
        double freq = fabs(err) < 0.0001 ? vel_cmd : vel_cmd - 0.5 * err / dt;
        return clamp(freq, old_freq - max_accel * dt, old_freq + max_accel * dt);
    } else {
        /* What one cycle of braking instead of accelerating would change. */
        double dv = -2.0 * accel * dt, dp = dv * match_time;
        if(fabs(err + dp * 2.0) < fabs(err)) accel = -accel;
        return old_freq + accel * dt;
    }
}

static rtapi_s32 limited_s32(double x)
{
    return (rtapi_s32)clamp(x, RTAPI_INT32_MIN, RTAPI_INT32_MAX);
}

static void update_channel(struct channel *c, int number, rtapi_u32 base, int base_changed, double dt)
{
    double scale = checked_scale(c, &c->update_scale);
    double max_freq = timing_limit(c, base, base_changed), max_accel, freq, old_freq;
    double cmd = hal_get_real(c->command) * scale;
    read_position(c, &c->update);
    if(!isfinite(cmd)) cmd = c->velocity_mode ? 0 : c->old_cmd;
    if(!hal_get_bool(c->enable)) {
        if(!c->velocity_mode) c->old_cmd = cmd;
        hal_set_real(c->frequency, 0);
        c->addval = 0;
        __atomic_store_n(&c->target_addval, 0, __ATOMIC_RELAXED);
        return;
    }
    motion_limits(c, number, scale, dt, &max_freq, &max_accel);
    old_freq = hal_get_real(c->frequency);
    if(c->velocity_mode) {
        freq = clamp(clamp(cmd, -max_freq, max_freq), old_freq - max_accel * dt, old_freq + max_accel * dt);
    } else {
        freq = clamp(follow_position(c, cmd, old_freq, max_accel, dt), -max_freq, max_freq);
    }
    hal_set_real(c->frequency, freq);
    __atomic_store_n(&c->deltalim, limited_s32(max_accel * accel_scale), __ATOMIC_RELAXED);
    __atomic_store_n(&c->target_addval, limited_s32(freq * freq_scale), __ATOMIC_RELAXED);
}

/* HAL function stepgen.update-freq. [servo] */
static void update_freq(void *arg, long period)
{
    rtapi_s32 base = __atomic_load_n(&base_period, __ATOMIC_RELAXED);
    int i, changed = base != update_base_period;
    (void)arg;
    if(changed) {
        update_base_period = base;
        freq_scale = ONE_STEP * base * 1e-9;
        accel_scale = freq_scale * base * 1e-9;
    }
    for(i = 0; i < channels; i++) update_channel(&channel[i], i, (rtapi_u32)base, changed, period * 1e-9);
}

/* ---- [init] -------------------------------------------------------------- */

static int export_outputs(struct channel *c, int n)
{
    static const char *const names[2][2] = { { "step", "dir" }, { "up", "down" } };
    int i;
    for(i = 0; i < (c->pattern ? c->pattern->phases : 2); i++) {
        if(c->pattern)
            COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &c->out[i], 0, "stepgen.%d.phase-%c", n, 'A' + i));
        else
            COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &c->out[i], 0, "stepgen.%d.%s", n, names[c->type][i]));
    }
    return 0;
}

static int export_timing(struct timing *t, int n, const char *name)
{
    return hal_param_new_ui32(comp_id, HAL_RW, &t->ns, 1, "stepgen.%d.%s", n, name);
}

static int export_channel(struct channel *c, int n)
{
    COMP_TRY(hal_param_new_si32(comp_id, HAL_RO, &c->rawcounts, 0, "stepgen.%d.rawcounts", n));
    COMP_TRY(hal_pin_new_si32(comp_id, HAL_OUT, &c->counts, 0, "stepgen.%d.counts", n));
    COMP_TRY(hal_param_new_real(comp_id, HAL_RW, &c->position_scale, 1.0, "stepgen.%d.position-scale", n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &c->command, 0, "stepgen.%d.%s", n,
                              c->velocity_mode ? "velocity-cmd" : "position-cmd"));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &c->enable, 0, "stepgen.%d.enable", n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &c->position_fb, 0, "stepgen.%d.position-fb", n));
    COMP_TRY(hal_param_new_real(comp_id, HAL_RO, &c->frequency, 0, "stepgen.%d.frequency", n));
    COMP_TRY(hal_param_new_real(comp_id, HAL_RW, &c->maxvel, 0, "stepgen.%d.maxvel", n));
    COMP_TRY(hal_param_new_real(comp_id, HAL_RW, &c->maxaccel, 0, "stepgen.%d.maxaccel", n));
    COMP_TRY(export_timing(&c->steplen, n, "steplen"));
    if(c->type < 2) COMP_TRY(export_timing(&c->stepspace, n, "stepspace"));
    if(c->type == 0) COMP_TRY(export_timing(&c->dirsetup, n, "dirsetup"));
    COMP_TRY(export_timing(&c->dirdelay, n, c->type == 0 ? "dirhold" : "dirdelay"));
    COMP_TRY(export_outputs(c, n));
    c->accum = c->update.seen = c->capture.seen = HALF_STEP;
    c->update.steps = c->capture.steps = HALF_STEP;
    return 0;
}

/* Pattern 15 from user_step_type; -EINVAL if it needs too many phases. */
static int make_user_pattern(void)
{
    struct pattern *p = &patterns[USER_TYPE];
    int i, used = 0;
    for(i = 0; i < MAX_CYCLE && user_step_type[i] >= 0; i++) {
        used |= user_step_type[i];
        p->state[i] = (unsigned char)user_step_type[i];
    }
    p->length = i;
    if(used >> MAX_PHASES) {
        rtapi_print_msg(RTAPI_MSG_ERR, "STEPGEN: ERROR: bad user step type uses more than %d phases\n",
                        MAX_PHASES);
        return -EINVAL;
    }
    for(p->phases = 0; used >> p->phases; p->phases++) {}
    return 0;
}

/* Checks the load parameters; sets `channels`. */
static int check_parameters(void)
{
    int n;
    for(n = 0; n < MAX_CHAN && step_type[n] != -1; n++) {
        const char *control = ctrl_type[n];
        if(step_type[n] < 0 || step_type[n] > USER_TYPE
           || (step_type[n] == USER_TYPE && patterns[USER_TYPE].length == 0)) {
            rtapi_print_msg(RTAPI_MSG_ERR, "STEPGEN: ERROR: bad stepping type '%i', axis %i\n", step_type[n], n);
            return -1;
        }
        if(control && control[0] && !strchr("pPvV", control[0])) {
            rtapi_print_msg(RTAPI_MSG_ERR,
                            "STEPGEN: ERROR: bad control type '%s' for axis %i (must be 'p' or 'v')\n", control, n);
            return -1;
        }
    }
    if(n == 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "STEPGEN: ERROR: no channels configured\n");
        return -1;
    }
    channels = n;
    return 0;
}

static int export_all(void)
{
    int i;
    channel = hal_malloc((long)sizeof *channel * channels);
    if(!channel) return -ENOMEM;
    for(i = 0; i < channels; i++) {
        struct channel *c = &channel[i];
        c->type = step_type[i];
        c->pattern = c->type >= 2 ? &patterns[c->type] : NULL;
        c->velocity_mode = ctrl_type[i] && (ctrl_type[i][0] == 'v' || ctrl_type[i][0] == 'V');
        COMP_TRY(export_channel(c, i));
    }
    COMP_TRY(hal_export_funct("stepgen.make-pulses", make_pulses, NULL, 0, 0, comp_id));
    COMP_TRY(hal_export_funct("stepgen.update-freq", update_freq, NULL, 1, 0, comp_id));
    COMP_TRY(hal_export_funct("stepgen.capture-position", capture_position, NULL, 1, 0, comp_id));
    return 0;
}

int rtapi_app_main(void)
{
    int r;
    COMP_TRY(make_user_pattern());
    COMP_TRY(check_parameters());
    comp_id = hal_init("stepgen");
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
