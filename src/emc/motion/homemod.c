/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * homemod.c - the default homing module: homing.c as a realtime component.
 *
 * Thread: init
 */
#include "hal.h"
#include "homing_priv.h"
#include "rtapi.h"
#include "rtapi_app.h"

MODULE_AUTHOR("Kerf");
MODULE_DESCRIPTION("Homing of joints");
MODULE_LICENSE("GPL");

static char *home_parms;
RTAPI_MP_STRING(home_parms, "home parms");
int rtapi_app_main(void)
{
    homing_owner = hal_init("homemod");
    if (homing_owner < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "\nhomemod FAIL:<hal_init()>\n");
        return -1;
    }
    return hal_ready(homing_owner);
}

void rtapi_app_exit(void) { hal_exit(homing_owner); }
