/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * kerf_instance.h - names of one of several controllers on a machine.
 *
 * The environment variable KERF_INSTANCE (default: empty) selects every shared
 * name. The empty instance uses the documented keys and paths. [any] after the
 * first call, which reads the environment [init].
 */
#ifndef KERF_INSTANCE_H
#define KERF_INSTANCE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define KERF_INSTANCE_LEN 48 /* longest name, without the NUL */

/* The instance's name: letters, digits, "_-." (anything else becomes "_"); a
 * longer one is cut and made unique by a hash. Owned by the library. */
const char *kerf_instance(void);

/* The SysV key of this instance for a documented key: key itself for the empty
 * instance, else a positive hash of both. Never 0 (unless key is). */
int kerf_instance_key(int key);

/* Writes base, followed by ".<instance>" unless the instance is empty (sockets,
 * lock files, logs). Returns the length, or -ENAMETOOLONG. */
int kerf_instance_path(char *buf, size_t size, const char *base);

/* Segment bookkeeping of this instance is done under a lock that dies with its
 * holder: it lives in the kernel's table of abstract socket names and leaves no
 * file. Short critical sections only; not recursive, one thread at a time.
 * Returns a handle for kerf_instance_unlock, or -errno. */
int kerf_instance_lock(const char *what);
void kerf_instance_unlock(int handle);

#ifdef __cplusplus
}
#endif
#endif
