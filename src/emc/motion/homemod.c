/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * homemod.c - the default homing module: homing.c as a realtime component.
 *
 * Thread: init
 */
#include "hal.h"
#include "rtapi.h"
#include "rtapi_app.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Homing of joints");
MODULE_LICENSE("GPL");

static char *home_parms;
RTAPI_MP_STRING(home_parms, "home parms");
static int comp_id;

int rtapi_app_main(void)
{
    comp_id = hal_init("homemod");
    if (comp_id < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "\nhomemod FAIL:<hal_init()>\n");
        return -1;
    }
    return hal_ready(comp_id);
}

void rtapi_app_exit(void) { hal_exit(comp_id); }
