/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * demux_generic.c - hands a value to one of several outputs, of any type and number.
 *
 * Thread: demux-gen.NN [any], constant cost
 */
#include <rtapi.h>
#include <rtapi_app.h>
#include <hal.h>
#include "components/mux_common.h"

MODULE_LICENSE("GPL");
MODULE_AUTHOR("Kerf developers");
MODULE_DESCRIPTION("Demux, types and number of entries chosen at load time");

static char *config[MUX_MAX_INSTANCES];
RTAPI_MP_ARRAY_STRING(config, MUX_MAX_INSTANCES, "number of entries and types of each instance, as ff8");

static int comp_id;

/* HAL function demux-gen.NN. */
static void select_entry(void *arg, long period)
{
    struct mux *m = arg;
    int entry = mux_choose(m, period);
    if(entry >= 0) mux_copy(m->many[entry], m->out_type, m->one, m->in_type);
}

static int export_instance(int n)
{
    char name[HAL_NAME_LEN + 1];
    int i;
    struct mux *m = hal_malloc(sizeof *m);
    if(!m) return -ENOMEM;
    COMP_TRY(mux_parse(m, config[n], "demux_generic", "demux"));
    m->many = hal_malloc((long)sizeof *m->many * m->entries);
    if(!m->many) return -ENOMEM;
    COMP_TRY(mux_export_selection(m, comp_id, "demux-gen", n));
    for(i = 0; i < m->entries; i++) {
        rtapi_snprintf(name, sizeof name, "demux-gen.%02d.out-%s-%02d", n, mux_type_name(m->out_type), i);
        COMP_TRY(mux_pin(comp_id, m->out_type, HAL_OUT, &m->many[i], name));
    }
    rtapi_snprintf(name, sizeof name, "demux-gen.%02d.in-%s", n, mux_type_name(m->in_type));
    COMP_TRY(mux_pin(comp_id, m->in_type, HAL_IN, &m->one, name));
    return hal_export_functf(select_entry, m, 1, 0, comp_id, "demux-gen.%02d", n);
}

int rtapi_app_main(void)
{
    int i, r = 0;
    if(!config[0] || !config[0][0]) {
        rtapi_print_msg(RTAPI_MSG_ERR, "The demux_generic component requires at least one valid format string\n");
        return -EINVAL;
    }
    comp_id = hal_init("demux_generic");
    if(comp_id < 0) return comp_id;
    for(i = 0; r >= 0 && i < MUX_MAX_INSTANCES && config[i] && config[i][0]; i++) r = export_instance(i);
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
