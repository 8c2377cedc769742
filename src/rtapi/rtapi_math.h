/* SPDX-License-Identifier: GPL-2.0-or-later
 * rtapi_math.h - mathematics, its constants and the parts of a double. */
#ifndef RTAPI_MATH_H
#define RTAPI_MATH_H

#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* for M_PIl and the M_ constants */
#endif
#include <float.h>
#include <math.h>
#include <ieee754.h> /* union ieee754_double, IEEE754_DOUBLE_BIAS */

#ifndef M_E
#define M_E 2.7182818284590452354
#endif
#ifndef M_LOG2E
#define M_LOG2E 1.4426950408889634074
#endif
#ifndef M_LOG10E
#define M_LOG10E 0.43429448190325182765
#endif
#ifndef M_LN2
#define M_LN2 0.69314718055994530942
#endif
#ifndef M_LN10
#define M_LN10 2.30258509299404568402
#endif
#ifndef M_PI
#define M_PI 3.14159265358979323846
#endif
#ifndef M_PI_2
#define M_PI_2 1.57079632679489661923
#endif
#ifndef M_PI_4
#define M_PI_4 0.78539816339744830962
#endif
#ifndef M_1_PI
#define M_1_PI 0.31830988618379067154
#endif
#ifndef M_2_PI
#define M_2_PI 0.63661977236758134308
#endif
#ifndef M_2_SQRTPI
#define M_2_SQRTPI 1.12837916709551257390
#endif
#ifndef M_SQRT2
#define M_SQRT2 1.41421356237309504880
#endif
#ifndef M_SQRT1_2
#define M_SQRT1_2 0.70710678118654752440
#endif
#ifndef M_PIl
#define M_PIl 3.141592653589793238462643383279502884L
#endif
#ifndef M_PI_2l
#define M_PI_2l 1.570796326794896619231321691639751442L
#endif

#endif
