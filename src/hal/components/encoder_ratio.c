/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * encoder_ratio.c - electronic gear: error of a slave axis that follows a master.
 *
 * In:     phases of the master and slave encoders, their resolutions, tooth numbers
 * Out:    error in revolutions of the slave
 * Thread: sample [base], update [servo]
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <hal.h>
#include "components/comp_util.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Electronic gear by two encoders");

#define MAX_CHAN 8

static int num_chan;
RTAPI_MP_INT(num_chan, "number of gears");
static char *names[MAX_CHAN];
RTAPI_MP_ARRAY_STRING(names, MAX_CHAN, "names of the gears");

struct gear {
    unsigned master_phases, slave_phases;
    rtapi_s64 raw;                      /* slave ahead of master, in common units; of sample */
    rtapi_s64 master_step, slave_step;  /* common units per count; of update */
    double output_scale;                /* common units per unit of the error */
    hal_bool_t master_a, master_b, slave_a, slave_b, enable;
    hal_real_t error;
    hal_uint_t master_ppr, slave_ppr, master_teeth, slave_teeth;
};

static int comp_id, gears;
static struct gear *gear;

/* +1 for a count forward (A leads B), -1 backward, 0 for none or a double change. */
static int decode(unsigned *phases, int a, int b)
{
    static const signed char place[4] = { 0, 1, 3, 2 };
    unsigned now = (a ? 1 : 0) | (b ? 2 : 0);
    int turn = (place[now] - place[*phases]) & 3;
    *phases = now;
    return turn == 1 ? 1 : turn == 3 ? -1 : 0;
}

/* HAL function encoder-ratio.sample. [base] */
static void sample(void *arg, long period)
{
    int i;
    (void)arg;
    (void)period;
    for(i = 0; i < gears; i++) {
        struct gear *g = &gear[i];
        int master = decode(&g->master_phases, hal_get_bool(g->master_a), hal_get_bool(g->master_b));
        int slave = decode(&g->slave_phases, hal_get_bool(g->slave_a), hal_get_bool(g->slave_b));
        if(hal_get_bool(g->enable)) g->raw -= master * g->master_step;
        g->raw += slave * g->slave_step;
    }
}

/* HAL function encoder-ratio.update. [servo] */
static void update(void *arg, long period)
{
    int i;
    (void)arg;
    (void)period;
    for(i = 0; i < gears; i++) {
        struct gear *g = &gear[i];
        rtapi_u32 master_ppr = hal_get_ui32(g->master_ppr), slave_ppr = hal_get_ui32(g->slave_ppr);
        rtapi_u32 slave_teeth = hal_get_ui32(g->slave_teeth);
        if(g->output_scale > 0) hal_set_real(g->error, g->raw / g->output_scale);
        g->master_step = (rtapi_s32)(hal_get_ui32(g->master_teeth) * slave_ppr);
        g->slave_step = (rtapi_s32)(slave_teeth * master_ppr);
        g->output_scale = master_ppr * slave_ppr * slave_teeth;
    }
}

static int export_gear(struct gear *g, const char *name)
{
    g->output_scale = 1.0;
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &g->master_a, 0, "%s.master-A", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &g->master_b, 0, "%s.master-B", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &g->slave_a, 0, "%s.slave-A", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &g->slave_b, 0, "%s.slave-B", name));
    COMP_TRY(hal_pin_new_bool(comp_id, HAL_IN, &g->enable, 0, "%s.enable", name));
    COMP_TRY(hal_pin_new_real(comp_id, HAL_OUT, &g->error, 0, "%s.error", name));
    COMP_TRY(hal_pin_new_ui32(comp_id, HAL_IO, &g->master_ppr, 0, "%s.master-ppr", name));
    COMP_TRY(hal_pin_new_ui32(comp_id, HAL_IO, &g->slave_ppr, 0, "%s.slave-ppr", name));
    COMP_TRY(hal_pin_new_ui32(comp_id, HAL_IO, &g->master_teeth, 0, "%s.master-teeth", name));
    COMP_TRY(hal_pin_new_ui32(comp_id, HAL_IO, &g->slave_teeth, 0, "%s.slave-teeth", name));
    return 0;
}

static int export_all(void)
{
    int i;
    gear = hal_malloc((long)sizeof *gear * gears);
    if(!gear) return -ENOMEM;
    for(i = 0; i < gears; i++) {
        char name[HAL_NAME_LEN + 1];
        if(names[i] && names[i][0]) rtapi_snprintf(name, sizeof name, "%s", names[i]);
        else rtapi_snprintf(name, sizeof name, "encoder-ratio.%d", i);
        COMP_TRY(export_gear(&gear[i], name));
    }
    COMP_TRY(hal_export_funct("encoder-ratio.sample", sample, NULL, 0, 0, comp_id));
    COMP_TRY(hal_export_funct("encoder-ratio.update", update, NULL, 1, 0, comp_id));
    return 0;
}

int rtapi_app_main(void)
{
    int r;
    COMP_TRY(gears = comp_instances("ENCODER_RATIO", num_chan, names, MAX_CHAN, 1));
    comp_id = hal_init("encoder_ratio");
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
