/* SPDX-License-Identifier: GPL-2.0-or-later
 * rtapi_bool.h - bool, true, false. */
#ifndef RTAPI_BOOL_H
#define RTAPI_BOOL_H
#ifndef __cplusplus
#include <stdbool.h>
#endif
typedef bool rtapi_bool;
#endif
