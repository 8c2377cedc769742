/* SPDX-License-Identifier: GPL-2.0-or-later
 * rtapi_errno.h - error numbers. */
#ifndef RTAPI_ERRNO_H
#define RTAPI_ERRNO_H
#include <errno.h>
#endif
