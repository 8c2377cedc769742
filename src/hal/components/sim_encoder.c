/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * sim_encoder.c - simulated quadrature encoder.
 *
 * In:     speed (units/s), scale (units per revolution), pulses per revolution
 * Out:    phases A, B and Z
 * Thread: make-pulses [base], update-speed [servo]
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <rtapi_math.h>
#include <hal.h>
#include "components/comp_util.h"
#include "components/real_to_int.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Simulated quadrature encoder");

#define MAX_CHAN 8
#define PICKOFF 31                      /* bit of the accumulator that is one count */

static int num_chan;
RTAPI_MP_INT(num_chan, "number of encoders");
static char *names[MAX_CHAN];
RTAPI_MP_ARRAY_STRING(names, MAX_CHAN, "names of the encoders");

struct encoder {
    rtapi_u32 accum;                    /* fraction of a count, units of 2^-31 */
    rtapi_s32 addval;                   /* atomic; per pass; written by update-speed */
    int state;                          /* 0 to 3: A, AB, B, none */
    rtapi_s64 cycle;                    /* pulse of the revolution */
    double seen_scale;
    hal_uint_t ppr;
    hal_real_t scale, speed;
    hal_bool_t phase_a, phase_b, phase_z;
    hal_sint_t rawcounts;
};

static int comp_id, encoders;
static struct encoder *encoder;
static rtapi_s32 base_period = 50000;   /* ns; atomic; written by make-pulses */

static void move_encoder(struct encoder *e, int step)
{
    rtapi_s64 ppr = hal_get_ui32(e->ppr);
    rtapi_u32 raw = (rtapi_u32)hal_get_si32(e->rawcounts);
    hal_set_si32(e->rawcounts, (rtapi_s32)(raw + (rtapi_u32)step));
    e->state += step;
    if(e->state > 3) {
        e->state = 0;
        e->cycle++;
        if(e->cycle >= ppr) e->cycle -= ppr;
    } else if(e->state < 0) {
        e->state = 3;
        e->cycle--;
        if(e->cycle < 0) e->cycle += ppr;
    }
}

/* HAL function sim-encoder.make-pulses. [base] */
static void make_pulses(void *arg, long period)
{
    int i;
    (void)arg;
    __atomic_store_n(&base_period, (rtapi_s32)period, __ATOMIC_RELAXED);
    for(i = 0; i < encoders; i++) {
        struct encoder *e = &encoder[i];
        rtapi_s32 addval = __atomic_load_n(&e->addval, __ATOMIC_RELAXED);
        rtapi_u32 next = e->accum + (rtapi_u32)addval;
        if((e->accum ^ next) >> PICKOFF) move_encoder(e, addval > 0 ? 1 : -1);
        e->accum = next;
        hal_set_bool(e->phase_a, e->state == 0 || e->state == 1);
        hal_set_bool(e->phase_b, e->state == 1 || e->state == 2);
        hal_set_bool(e->phase_z, e->state == 0 && e->cycle == 0);
    }
}

/* HAL function sim-encoder.update-speed. [servo] */
static void update_speed(void *arg, long period)
{
    int i;
    double base = __atomic_load_n(&base_period, __ATOMIC_RELAXED) * 1e-9;
    double freq_scale = 2147483648.0 * base, max_freq = 1.0 / base;
    (void)arg;
    (void)period;
    for(i = 0; i < encoders; i++) {
        struct encoder *e = &encoder[i];
        double scale = hal_get_real(e->scale), freq;
        if(scale != e->seen_scale) {
            e->seen_scale = comp_scale(scale);
            if(e->seen_scale != scale) hal_set_real(e->scale, e->seen_scale);
        }
        freq = hal_get_real(e->speed) / e->seen_scale * hal_get_ui32(e->ppr) * 4.0;
        freq = isnan(freq) ? 0 : fmin(max_freq, fmax(-max_freq, freq));
        /* At the highest speed each pass is half a turn of the accumulator: both
         * directions are the same, and count as backward. */
        __atomic_store_n(&e->addval, real_to_s32(freq * freq_scale), __ATOMIC_RELAXED);
    }
}

static int export_encoder(struct encoder *e, const char *name)
{
    COMP_TRY(hal_pin_new_ui32(comp_id, HAL_IO, &e->ppr, 100, "%s.ppr", name));
    e->seen_scale = COMP_SCALE_UNSEEN;
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IO, &e->scale, 1.0, "%s.scale", name));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &e->speed, 0, "%s.speed", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &e->phase_a, 0, "%s.phase-A", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &e->phase_b, 0, "%s.phase-B", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &e->phase_z, 0, "%s.phase-Z", name));
    COMP_TRY(hal_pin_new_si32(comp_id, HAL_IN, &e->rawcounts, 0, "%s.rawcounts", name));
    return 0;
}

static int export_all(void)
{
    int i;
    encoder = hal_malloc((long)sizeof *encoder * encoders);
    if(!encoder) return -ENOMEM;
    for(i = 0; i < encoders; i++) {
        char name[HAL_NAME_LEN + 1];
        if(names[i] && names[i][0]) rtapi_snprintf(name, sizeof name, "%s", names[i]);
        else rtapi_snprintf(name, sizeof name, "sim-encoder.%d", i);
        COMP_TRY(export_encoder(&encoder[i], name));
    }
    COMP_TRY(hal_export_funct("sim-encoder.make-pulses", make_pulses, NULL, 0, 0, comp_id));
    COMP_TRY(hal_export_funct("sim-encoder.update-speed", update_speed, NULL, 1, 0, comp_id));
    return 0;
}

int rtapi_app_main(void)
{
    int r;
    COMP_TRY(encoders = comp_instances("SIM_ENCODER", num_chan, names, MAX_CHAN, 1));
    comp_id = hal_init("sim_encoder");
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
