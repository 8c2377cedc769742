/* SPDX-License-Identifier: GPL-2.0-or-later
 * A module whose symbol another one uses. */
#include "rtapi.h"
#include "rtapi_app.h"
int provided(void);
int provided(void)
{
    return 42;
}
EXPORT_SYMBOL(provided);
int rtapi_app_main(void)
{
    return 0;
}
void rtapi_app_exit(void)
{
}
