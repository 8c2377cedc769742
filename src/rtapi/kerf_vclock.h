/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * kerf_vclock.h - virtual time behind kerf_clock.h; used by kerf_clock.c and by
 * the virtual back end of the realtime host. Functions mirror those of
 * kerf_clock.h and may be called only in virtual time (after vclock_attach).
 */
#ifndef KERF_VCLOCK_H
#define KERF_VCLOCK_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/types.h>

/* [init] Attaches to (or makes) the instance's clock. pace: 0 = as fast as
 * possible; counts for the one who makes it. 0 or -errno. */
int vclock_attach(double pace);
double vclock_pace(void);
int64_t vclock_now(void);
/* place: KERF_CLOCK_SLOT of the environment or NULL; used by a thread that is no
 * participant. 0, -EINTR or -ENOSPC. */
int vclock_sleep_until(int64_t when_ns, const char *place);
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

/* A place for a thread that is about to start: it waits at the present moment
 * from now on, so the order does not depend on how fast the thread starts. Its
 * index or -ENOSPC. */
int vclock_place_new(const char *name, int prio);
/* The thread takes it and returns when it is its turn (or cancelled); drop gives
 * up a place whose thread could not be made. */
void vclock_place_drop(int place);
void vclock_place_adopt(int place, const _Atomic bool *cancel);
/* As vclock_sleep_until of a participant; returns early, not in its turn, when
 * *cancel is true after a poke. */
void vclock_sleep_cancelable(int64_t when_ns, const _Atomic bool *cancel);
void vclock_poke(int place);

/* One line for the clock and one for each place. */
void vclock_print(FILE *to);

#endif
