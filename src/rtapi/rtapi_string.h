/* SPDX-License-Identifier: GPL-2.0-or-later
 * rtapi_string.h - strings that always end with NUL. */
#ifndef RTAPI_STRING_H
#define RTAPI_STRING_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "rtapi_gfp.h"

#ifdef __cplusplus
#include <type_traits>
#define rtapi_static_assert(expr, msg) static_assert(expr, msg)
#define rtapi_is_array(x) (std::is_array<std::remove_reference_t<decltype(x)>>::value)
#define RTAPI_ARRAY_CHECK_(x) static_assert(rtapi_is_array(x), #x " must be an array")
extern "C" {
#else
#define rtapi_static_assert(expr, msg) _Static_assert(expr, msg)
#define rtapi_is_array(x) (!__builtin_types_compatible_p(__typeof__(x), __typeof__(&(x)[0])))
#define RTAPI_ARRAY_CHECK_(x) _Static_assert(rtapi_is_array(x), #x " must be an array")
#endif

/* [any] Copies src, cut to size - 1 characters. Returns strlen(src). */
static inline size_t rtapi_strlcpy(char *dst, const char *src, size_t size)
{
    size_t len = strlen(src);
    if (size > 0) {
        size_t n = len < size ? len : size - 1;
        memcpy(dst, src, n);
        dst[n] = 0;
    }
    return len;
}
/* [any] Appends src, cut so that all fits in size. Returns strlen(src). */
static inline size_t rtapi_strlcat(char *dst, const char *src, size_t size)
{
    const char *end = (const char *)memchr(dst, 0, size);
    size_t used = end ? (size_t)(end - dst) : size;
    return rtapi_strlcpy(dst + used, src, size - used);
}
/* The same for an array: its size is known, a pointer does not compile. */
#define rtapi_strxcpy(dst, src) __extension__({ RTAPI_ARRAY_CHECK_(dst); rtapi_strlcpy((dst), (src), sizeof(dst)); })
#define rtapi_strxcat(dst, src) __extension__({ RTAPI_ARRAY_CHECK_(dst); rtapi_strlcat((dst), (src), sizeof(dst)); })

/* [init] Words of text, divided at white space (no quotes), ended by NULL; *argc
 * gets their number (argc may be NULL). NULL without memory. In the realtime host. */
char **rtapi_argv_split(rtapi_gfp_t gfp, const char *text, int *argc);
void rtapi_argv_free(char **argv);

/* [init] A copy to be freed with rtapi_kfree, or NULL. */
static inline char *rtapi_kstrdup(const char *s, rtapi_gfp_t gfp)
{
    size_t size = strlen(s) + 1;
    char *copy = (char *)malloc(size);
    (void)gfp;
    return copy ? (char *)memcpy(copy, s, size) : NULL;
}

#ifdef __cplusplus
}
#endif
#endif
