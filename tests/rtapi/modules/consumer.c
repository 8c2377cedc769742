/* SPDX-License-Identifier: GPL-2.0-or-later
 * Uses a symbol of module provider. */
#include "rtapi.h"
#include "rtapi_app.h"
int provided(void);
int rtapi_app_main(void)
{
    rtapi_print("provided %d\n", provided());
    return 0;
}
void rtapi_app_exit(void)
{
}
