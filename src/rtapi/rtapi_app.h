/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * rtapi_app.h - entry points of a realtime module. Include it in exactly one
 * file of the module.
 */
#ifndef RTAPI_APP_H
#define RTAPI_APP_H

#include "rtapi.h"

RTAPI_BEGIN_DECLS
/* [init] Called once after the parameters are set. 0, or a negative errno: the
 * module is closed again, rtapi_app_exit is not called. */
int rtapi_app_main(void);
/* [init] Called at unload, only after a successful rtapi_app_main. */
void rtapi_app_exit(void);
RTAPI_END_DECLS

EXPORT_SYMBOL(rtapi_app_main);
EXPORT_SYMBOL(rtapi_app_exit);

#endif
