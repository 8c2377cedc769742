/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * emcmotutil.h - the error ring and the command lock of the motion segment.
 *
 * The ring stores a format and its arguments; text is made by the reader.
 * Many producers, one consumer, no lock: a full ring drops the new message.
 */
#ifndef KERF_EMCMOTUTIL_H
#define KERF_EMCMOTUTIL_H

#include <stdarg.h>
#include "motion.h"

#ifdef __cplusplus
extern "C" {
#endif

/* [init] Empties the ring. */
void emcmotErrorInit(emcmot_error_t *err);

/* [any], bounded, no allocation. Returns 0, -1 when the ring is full or the
 * format holds a conversion other than d i u x X o c p s f F e E g G %. */
int emcmotErrorPut(emcmot_error_t *err, const char *fmt, ...) __attribute__((format(printf, 2, 3)));
int emcmotErrorPutfv(emcmot_error_t *err, const char *fmt, va_list ap);

/* [task] Formats the oldest message into text (always terminated).
 * Returns 0, -1 when there is none. */
int emcmotErrorGet(emcmot_error_t *err, char *text, int size);

/* [servo] Takes the command lock for motion: 1 taken, 0 held by a writer. */
int emcmotCommandTryLock(emcmot_struct_t *shared);
/* [task] One attempt for process pid; a lock of a process that no longer exists is taken over. */
int emcmotCommandTryLockUser(emcmot_struct_t *shared, int pid);
void emcmotCommandUnlock(emcmot_struct_t *shared);

/* Brackets of a sequence-counted block: head, fields, tail. [servo] */
static inline void emcmotBlockBegin(unsigned int *head)
{
    __atomic_store_n(head, *head + 1, __ATOMIC_RELAXED);
    __atomic_thread_fence(__ATOMIC_RELEASE);
}
static inline void emcmotBlockEnd(const unsigned int *head, unsigned int *tail)
{
    __atomic_store_n(tail, *head, __ATOMIC_RELEASE);
}

#ifdef __cplusplus
}
#endif
#endif
