/* SPDX-License-Identifier: GPL-2.0-or-later
 * rtapi_math_i386.h - needed by kernel builds only; here it is <math.h>. */
#ifndef RTAPI_MATH_I386_H
#define RTAPI_MATH_I386_H
#include <math.h>
#endif
