/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * pwmgen.c - pulse width and pulse density modulation in software.
 *
 * In:     value (units), scale, offset, limits of the duty cycle, frequency (Hz)
 * Out:    pwm, pwm and direction, or up and down
 * Thread: make-pulses [base], update [servo]
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <rtapi_math.h>
#include <hal.h>
#include "components/comp_util.h"
#include "components/real_to_int.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("PWM and PDM generator in software");

#define MAX_CHAN 8

static int output_type[MAX_CHAN] = { [0 ... MAX_CHAN - 1] = -1 };
RTAPI_MP_ARRAY_INT(output_type, MAX_CHAN, "0: pwm, 1: pwm and direction, 2: up and down");

enum mode {
    MODE_OFF,
    MODE_PURE,                          /* whole base periods high, then low */
    MODE_DITHER,                        /* errors of a pulse are made good in the next */
    MODE_PDM,                           /* as many changes as possible */
};

struct channel {
    /* Set by update, read by make-pulses: single words. */
    int type, mode, reverse;
    rtapi_s32 pulse_ns, high_ns;        /* length of the cycle and of its high part */
    /* Of make-pulses. */
    int output;
    rtapi_s32 cycle_timer, high_timer;  /* ns */
    hal_bool_t out0, out1;              /* pwm, up; dir, down */
    /* Of update. */
    double seen_scale, seen_freq;
    int periods;                        /* base periods in a cycle (MODE_PURE) */
    hal_bool_t enable, dither;
    hal_real_t value, scale, offset, freq, min_dc, max_dc, curr_dc;
};

static int comp_id, channels;
static struct channel *channel;
static rtapi_s32 base_period = -1;      /* ns; atomic; written by make-pulses */
static rtapi_s32 seen_base_period = -1; /* of update */

/* ---- [base] -------------------------------------------------------------- */

static void modulate(struct channel *c, rtapi_s32 period)
{
    switch(__atomic_load_n(&c->mode, __ATOMIC_RELAXED)) {
    case MODE_PURE:
        if(c->output) {
            c->high_timer += period;
            if(c->high_timer >= c->high_ns) c->output = 0;
        }
        c->cycle_timer += period;
        if(c->cycle_timer >= c->pulse_ns) {
            c->cycle_timer = c->high_timer = 0;
            if(c->high_ns > 0) c->output = 1;
        }
        break;
    case MODE_DITHER:
        if(c->output) {
            c->high_timer -= period;
            if(c->high_timer <= 0) c->output = 0;
        }
        c->cycle_timer += period;
        if(c->cycle_timer >= c->pulse_ns) {
            c->cycle_timer -= c->pulse_ns;
            c->high_timer += c->high_ns;
            if(c->high_timer > 0) c->output = 1;
        }
        break;
    case MODE_PDM:
        c->high_timer += c->high_ns;
        if(c->output) c->high_timer -= period;
        c->output = c->high_timer > 0;
        break;
    case MODE_OFF:
    default:
        c->output = 0;
        c->cycle_timer = c->high_timer = 0;
    }
}

/* HAL function pwmgen.make-pulses. [base] */
static void make_pulses(void *arg, long period)
{
    int i;
    (void)arg;
    __atomic_store_n(&base_period, (rtapi_s32)period, __ATOMIC_RELAXED);
    for(i = 0; i < channels; i++) {
        struct channel *c = &channel[i];
        modulate(c, (rtapi_s32)period);
        if(c->type < 2) {
            hal_set_bool(c->out0, c->output);
        } else {
            hal_set_bool(c->out0, c->output && !c->reverse);
            hal_set_bool(c->out1, c->output && c->reverse);
        }
    }
}

/* ---- [servo] ------------------------------------------------------------- */

static void set_real_if_changed(hal_real_t pin, double old, double new)
{
    if(new != old) hal_set_real(pin, new);
}

/* Brings min-dc and max-dc into 0 <= min <= max <= 1. */
static void limit_duty_cycle(struct channel *c, double *min, double *max)
{
    double low = hal_get_real(c->min_dc), high = hal_get_real(c->max_dc);
    *min = low;
    *max = high > 1 ? 1 : high;
    if(*min > *max) *min = *max;
    if(!(*min >= 0)) *min = 0;
    if(!(*max >= *min)) *max = *min;
    set_real_if_changed(c->min_dc, low, *min);
    set_real_if_changed(c->max_dc, high, *max);
}

static enum mode wanted_mode(const struct channel *c, double freq)
{
    if(!hal_get_bool(c->enable)) return MODE_OFF;
    if(freq == 0) return MODE_PDM;
    return hal_get_bool(c->dither) ? MODE_DITHER : MODE_PURE;
}

/* Length of the cycle; limits pwm-freq to what the base period allows. */
static void set_cycle(struct channel *c, enum mode mode, rtapi_s32 base)
{
    double freq = hal_get_real(c->freq), most = 5.0e8 / base;
    if(!(freq > 0)) {
        hal_set_real(c->freq, 0);
        c->pulse_ns = base;
        c->periods = 0;
        return;
    }
    if(freq < 0.5) freq = 0.5;
    if(freq > most) freq = most;
    if(mode == MODE_PURE) {
        c->periods = real_to_s32(1.0e9 / freq / base + 0.5);
        c->pulse_ns = c->periods * base;
        freq = 1.0e9 / c->pulse_ns;
    } else {
        c->pulse_ns = real_to_s32(1.0e9 / freq);
    }
    hal_set_real(c->freq, freq);
}

/* Duty cycle wanted, within its limits; its sign is the direction. */
static double duty_cycle(const struct channel *c, double min, double max)
{
    double dc = hal_get_real(c->value) / c->seen_scale + hal_get_real(c->offset);
    if(isnan(dc) || (c->type == 0 && dc < 0)) dc = 0;
    if(dc >= 0) return dc > max ? max : dc < min ? min : dc;
    return dc < -max ? -max : dc > -min ? -min : dc;
}

static void update_channel(struct channel *c, rtapi_s32 base, int base_changed)
{
    double min, max, scale = hal_get_real(c->scale), freq = hal_get_real(c->freq), dc, size;
    enum mode mode;
    int reverse;
    limit_duty_cycle(c, &min, &max);
    if(scale != c->seen_scale) {
        c->seen_scale = comp_scale(scale);
        set_real_if_changed(c->scale, scale, c->seen_scale);
    }
    mode = wanted_mode(c, freq);
    if(freq != c->seen_freq) c->mode = MODE_OFF;
    if((int)mode != c->mode || base_changed) {
        __atomic_store_n(&c->mode, MODE_OFF, __ATOMIC_RELAXED);
        set_cycle(c, mode, base);
        c->seen_freq = hal_get_real(c->freq);
    }
    dc = duty_cycle(c, min, max);
    reverse = dc < 0 || (dc == 0 && signbit(dc));
    size = fabs(dc);
    if(mode == MODE_PURE) {
        int high = real_to_s32(c->periods * size + 0.5);
        c->high_ns = high * base;
        size = high ? (double)high / c->periods : 0;
        hal_set_real(c->curr_dc, reverse ? -size : size);
    } else {
        c->high_ns = real_to_s32(c->pulse_ns * size + 0.5);
        hal_set_real(c->curr_dc, dc);
    }
    c->reverse = reverse;
    if(c->type == 1) hal_set_bool(c->out1, reverse);
    __atomic_store_n(&c->mode, mode, __ATOMIC_RELAXED);
}

/* HAL function pwmgen.update. [servo] */
static void update(void *arg, long period)
{
    rtapi_s32 base = __atomic_load_n(&base_period, __ATOMIC_RELAXED);
    int i, changed = base != seen_base_period;
    (void)arg;
    (void)period;
    seen_base_period = base;
    for(i = 0; i < channels; i++) update_channel(&channel[i], base, changed);
}

/* ---- [init] -------------------------------------------------------------- */

static int export_channel(struct channel *c, int n)
{
    c->seen_scale = COMP_SCALE_UNSEEN;
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IO, &c->scale, 1.0, "pwmgen.%d.scale", n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IO, &c->offset, 0, "pwmgen.%d.offset", n));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IO, &c->dither, 0, "pwmgen.%d.dither-pwm", n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IO, &c->freq, 0, "pwmgen.%d.pwm-freq", n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IO, &c->min_dc, 0, "pwmgen.%d.min-dc", n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IO, &c->max_dc, 1.0, "pwmgen.%d.max-dc", n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &c->curr_dc, 0, "pwmgen.%d.curr-dc", n));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &c->enable, 0, "pwmgen.%d.enable", n));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &c->value, 0, "pwmgen.%d.value", n));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &c->out0, 0, "pwmgen.%d.%s", n, c->type == 2 ? "up" : "pwm"));
    if(c->type == 1) COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &c->out1, 0, "pwmgen.%d.dir", n));
    if(c->type == 2) COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &c->out1, 0, "pwmgen.%d.down", n));
    return 0;
}

static int export_all(void)
{
    int i;
    channel = hal_malloc((long)sizeof *channel * channels);
    if(!channel) return -ENOMEM;
    for(i = 0; i < channels; i++) {
        channel[i].type = output_type[i];
        COMP_TRY(export_channel(&channel[i], i));
    }
    COMP_TRY(hal_export_funct("pwmgen.make-pulses", make_pulses, NULL, 0, 0, comp_id));
    COMP_TRY(hal_export_funct("pwmgen.update", update, NULL, 1, 0, comp_id));
    return 0;
}

int rtapi_app_main(void)
{
    int r;
    for(channels = 0; channels < MAX_CHAN && output_type[channels] != -1; channels++) {
        int type = output_type[channels];
        if(type < 0 || type > 2) {
            rtapi_print_msg(RTAPI_MSG_ERR, "PWMGEN: ERROR: bad output type '%i', channel %i\n", type, channels);
            return -1;
        }
    }
    if(channels == 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "PWMGEN: ERROR: no channels configured\n");
        return -1;
    }
    comp_id = hal_init("pwmgen");
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
