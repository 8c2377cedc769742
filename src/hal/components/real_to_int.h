/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * real_to_int.h - a real number to an integer pin, defined for every input.
 *
 * C leaves a conversion undefined when the truncated value does not fit. These
 * give what the x86-64 conversion instructions give, on every machine: the low
 * bits of the truncated 64-bit value, and the most negative number when even 64
 * bits are too few or the input is NaN. Context: [any], constant cost.
 */
#ifndef KERF_REAL_TO_INT_H
#define KERF_REAL_TO_INT_H

#include <rtapi_stdint.h>

/* Truncates toward zero; RTAPI_INT64_MIN if x is NaN or outside the range. */
static inline rtapi_s64 real_to_s64(double x)
{
    return x >= -9223372036854775808.0 && x < 9223372036854775808.0 ? (rtapi_s64)x : RTAPI_INT64_MIN;
}

/* Truncates toward zero; RTAPI_INT32_MIN if x is NaN or outside the range. */
static inline rtapi_s32 real_to_s32(double x)
{
    return x > -2147483649.0 && x < 2147483648.0 ? (rtapi_s32)x : RTAPI_INT32_MIN;
}

/* The low 32 bits of real_to_s64(x): negative numbers wrap. */
static inline rtapi_u32 real_to_u32(double x)
{
    return (rtapi_u32)real_to_s64(x);
}

/* Truncates toward zero up to 2^64; negative numbers wrap. */
static inline rtapi_u64 real_to_u64(double x)
{
    if(x >= 9223372036854775808.0)
        return (rtapi_u64)real_to_s64(x - 9223372036854775808.0) ^ 0x8000000000000000ull;
    return (rtapi_u64)real_to_s64(x);
}

#endif
