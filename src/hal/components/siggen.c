/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * siggen.c - signal generator: square, sawtooth, triangle, sine, cosine, clock.
 *
 * In:     frequency (Hz), amplitude, offset, reset
 * Thread: N.update [servo], constant cost
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <rtapi_math.h>
#include <hal.h>
#include "components/comp_util.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Signal generator");

#define MAX_CHAN 16

static int num_chan;
RTAPI_MP_INT(num_chan, "number of generators");
static char *names[MAX_CHAN];
RTAPI_MP_ARRAY_STRING(names, MAX_CHAN, "names of the generators");

struct siggen {
    hal_real_t square, sawtooth, triangle, sine, cosine, frequency, amplitude, offset;
    hal_bool_t clock, reset;
    double index;                       /* place in the period, 0 to 1 */
};

static int comp_id, generators;
static struct siggen *siggens;

/* HAL function siggen.N.update. [servo] */
static void update(void *arg, long period)
{
    struct siggen *g = arg;
    double dt = period * 1e-9, step = hal_get_real(g->frequency) * dt, sign, wave, angle;
    double amplitude = hal_get_real(g->amplitude), offset = hal_get_real(g->offset);
    if(step > 0.5) {
        hal_set_real(g->frequency, 0.5 / dt);
        step = 0.5;
    }
    if(hal_get_bool(g->reset)) g->index = 0.5;
    else if(isfinite(step)) g->index += step;
    if(g->index >= 1.0) g->index -= 1.0;

    sign = g->index > 0.5 ? 1.0 : -1.0;
    wave = g->index * 2.0 - 1.0;
    angle = g->index * (2.0 * 3.1415927);
    hal_set_bool(g->clock, g->index > 0.5);
    hal_set_real(g->square, sign * amplitude + offset);
    hal_set_real(g->sawtooth, wave * amplitude + offset);
    hal_set_real(g->triangle, (wave * 2.0 * sign - 1.0) * amplitude + offset);
    hal_set_real(g->sine, sin(angle) * amplitude + offset);
    hal_set_real(g->cosine, cos(angle) * amplitude + offset);
}

static int export_siggen(struct siggen *g, const char *name)
{
    COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &g->square, 0, "%s.square", name));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &g->sawtooth, 0, "%s.sawtooth", name));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &g->triangle, 0, "%s.triangle", name));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &g->sine, 0, "%s.sine", name));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &g->cosine, 0, "%s.cosine", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_OUT, &g->clock, 0, "%s.clock", name));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &g->frequency, 1.0, "%s.frequency", name));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &g->amplitude, 1.0, "%s.amplitude", name));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_IN, &g->offset, 0, "%s.offset", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &g->reset, 0, "%s.reset", name));
    return hal_export_functf(update, g, 1, 0, comp_id, "%s.update", name);
}

static int export_all(void)
{
    int i;
    siggens = hal_malloc((long)sizeof *siggens * generators);
    if(!siggens) return -ENOMEM;
    for(i = 0; i < generators; i++) {
        char name[HAL_NAME_LEN + 1];
        if(names[i] && names[i][0]) rtapi_snprintf(name, sizeof name, "%s", names[i]);
        else rtapi_snprintf(name, sizeof name, "siggen.%d", i);
        COMP_TRY(export_siggen(&siggens[i], name));
    }
    return 0;
}

int rtapi_app_main(void)
{
    int r;
    COMP_TRY(generators = comp_instances("SIGGEN", num_chan, names, MAX_CHAN, 1));
    comp_id = hal_init("siggen");
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
