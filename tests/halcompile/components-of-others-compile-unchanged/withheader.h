// SPDX-License-Identifier: GPL-2.0-or-later
#include <rtapi_math.h>
#define PLAIN_COS(a) cos(a)
