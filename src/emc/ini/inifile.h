/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * inifile.h - C interface of the INI reader (inifile.hh). [task]
 *
 * All return 0, -EINVAL (null argument, or the file cannot be loaded), -ENOENT (missing or
 * not convertible) or -ENOSPC (buffer too small). section NULL or "" means any section.
 */
#ifndef INIFILE_H
#define INIFILE_H

#include <limits.h>
#include <stdbool.h>
#include <stddef.h>
#include "rtapi_stdint.h"

#ifdef __cplusplus
extern "C" {
#endif

#define INI_MAX_LINELEN PATH_MAX

int iniFindString(const char *path, const char *tag, const char *section, char *buf, size_t size);
int iniFindBool(const char *path, const char *tag, const char *section, bool *result);
int iniFindSInt(const char *path, const char *tag, const char *section, rtapi_s64 *result);
int iniFindUInt(const char *path, const char *tag, const char *section, rtapi_u64 *result);
int iniFindDouble(const char *path, const char *tag, const char *section, double *result);
/* Values beyond the range of int are truncated. */
int iniFindInt(const char *path, const char *tag, const char *section, int *result);
/* "~/x" to "$HOME/x"; other paths are copied. */
int TildeExpansion(const char *file, char *buf, size_t size);

#ifdef __cplusplus
}
#endif
#endif
