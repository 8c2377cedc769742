/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * ownswitch.h - modules that switch kinematics without switchkins.c: pins and choice of type.
 *
 * Included once by a module. Context: init of ownswitch_pins, else [servo].
 */
#ifndef KERF_OWNSWITCH_H
#define KERF_OWNSWITCH_H

#include "kins_main.h"

#define OWNSWITCH_MAX 3

static hal_bool_t *is_type_pins; /* array in HAL memory */
static int type_count, type_now;

static int ownswitch_pins(int comp_id, int types)
{
    int r = 0;
    type_count = types;
    is_type_pins = hal_malloc((long)sizeof(hal_bool_t) * OWNSWITCH_MAX);
    if (!is_type_pins)
        return -1;
    for (int n = 0; n < types; n++)
        r |= hal_pin_new_bool(comp_id, HAL_OUT, &is_type_pins[n], n == 0, "kinstype.is-%d", n);
    return r < 0 ? -1 : 0;
}

int kinematicsSwitchable(void) { return 1; }

/* An unknown type is refused and the old one stays (the peer falls out of all types). */
int kinematicsSwitch(int type)
{
    rtapi_print_msg(RTAPI_MSG_INFO, "kinematicsSwitch(): type=%d\n", type);
    if (type < 0 || type >= type_count) {
        rtapi_print_msg(RTAPI_MSG_ERR, "kinematicsSwitch:BAD VALUE <%d>\n", type);
        return -1;
    }
    type_now = type;
    for (int n = 0; n < type_count; n++)
        hal_set_bool(is_type_pins[n], n == type);
    return 0;
}

EXPORT_SYMBOL(kinematicsSwitchable);
EXPORT_SYMBOL(kinematicsSwitch);

#endif
