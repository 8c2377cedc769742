/* SPDX-License-Identifier: GPL-2.0-or-later
 * A module that needs a service that the host does not have. */
#include "rtapi.h"
#include "rtapi_app.h"
int rtapi_app_main(void)
{
    return rtapi_sem_new(1, 1);
}
void rtapi_app_exit(void)
{
}
