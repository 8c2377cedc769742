/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * stepgen_days.c - stepgen as it is after having made `preset` steps, per channel: no
 * test can wait for them.
 */
#include <stdlib.h>
#include <hal.h>
#define hal_init(name) hal_init("stepgen_days")
#define rtapi_app_main stepgen_main
#include "components/stepgen.c"
#undef rtapi_app_main
#undef hal_init

static char *preset[MAX_CHAN];
RTAPI_MP_ARRAY_STRING(preset, MAX_CHAN, "steps already made, per channel");

static void go_to(struct channel *c, __int128 units)
{
    c->accum += (rtapi_u64)units;
    c->update.steps += units;
    c->capture.steps += units;
    c->update.seen = c->capture.seen = c->accum;
}

int rtapi_app_main(void)
{
    int i, result = stepgen_main();
    for(i = 0; result == 0 && i < channels && preset[i]; i++)
        go_to(&channel[i], (__int128)strtoll(preset[i], NULL, 10) * (1 << PICKOFF));
    return result;
}
