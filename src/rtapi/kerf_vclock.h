/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * kerf_vclock.h - virtual time behind kerf_clock.h; used by kerf_clock.c only.
 * Functions mirror those of kerf_clock.h and may be called only in virtual time.
 */
#ifndef KERF_VCLOCK_H
#define KERF_VCLOCK_H

#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

/* [init] Attaches to (or makes) the instance's clock. pace: 0 = as fast as possible. 0 or -errno. */
int vclock_attach(double pace);
int64_t vclock_now(void);
int vclock_sleep_until(int64_t when_ns);
int vclock_join(const char *name, int prio, const char *place);
void vclock_leave(void);
int vclock_joined(void);
void vclock_suspend(void);
void vclock_resume(void);
int vclock_lend(char *value, size_t size);
void vclock_reclaim(void);
int vclock_reserve(char *value, size_t size, const char *name, int prio);
void vclock_reserved_for(const char *value, pid_t pid);
void vclock_unreserve(const char *value);

#endif
