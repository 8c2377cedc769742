/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * kins_main.c - start, end and exports of a kinematics module (kins_main.h).
 */
#include "kins_main.h"
#include "rtapi_app.h"

static int comp_id;

KINEMATICS_TYPE kinematicsType(void) { return KINEMATICS_BOTH; }

EXPORT_SYMBOL(kinematicsType);
EXPORT_SYMBOL(kinematicsForward);
EXPORT_SYMBOL(kinematicsInverse);

int rtapi_app_main(void)
{
    comp_id = hal_init(kins_name);
    if (comp_id < 0)
        return comp_id;
    if (kins_setup(comp_id) < 0) {
        hal_exit(comp_id);
        return -1;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void) { hal_exit(comp_id); }
