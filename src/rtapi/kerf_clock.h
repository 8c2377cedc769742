/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * kerf_clock.h - the one clock that all waiting goes through.
 *
 * KERF_CLOCK=real (default): CLOCK_MONOTONIC; join, leave, lend and the like do
 * nothing. KERF_CLOCK=virtual: time of this instance is simulated, as fast as
 * possible; KERF_CLOCK=virtual:N: at most N times as fast as the wall clock.
 *
 * In virtual time exactly one participant (a thread that joined) runs at any
 * moment; time stands while it runs. When it waits, the one with the least
 * (wake time, priority, number) runs next and the clock jumps to its wake time.
 * Threads that never joined run freely; a wait of theirs takes a place in the
 * order and gives it back on waking. docs/virtual-time.md explains the rules.
 *
 * Thread context: now [any]; sleep, wait and poll [task] or a realtime task's
 * own wait; everything else [init]/[task]. Times are int64 nanoseconds. A place
 * belongs to the calling thread; after fork the child has none.
 */
#ifndef KERF_CLOCK_H
#define KERF_CLOCK_H

#include <poll.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/types.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Priorities: at equal times the smaller number runs first. */
#define KERF_CLOCK_PRIO_RT 0     /* realtime tasks: 0 to 99, the fastest first */
#define KERF_CLOCK_PRIO_TASK 200 /* milltask, io */
#define KERF_CLOCK_PRIO_USER 500 /* user components, halcmd, samplers */
#define KERF_CLOCK_PRIO_TEST 900 /* drivers of tests: see everything settled */

/* 1 when this instance runs in virtual time. */
int kerf_clock_is_virtual(void);

/* The pace: wall-clock multiple, 0 = as fast as possible, 1 in real mode. */
double kerf_clock_pace(void);

/* The present time, ns. Never goes back. */
int64_t kerf_clock_now_ns(void);

/* Waits. A time that has passed returns at once (in virtual time after those
 * who come first at this moment). 0, or -EINTR when a signal handler ran. */
int kerf_clock_sleep_ns(int64_t ns);
int kerf_clock_sleep_until_ns(int64_t when_ns);

/* Makes the calling thread a participant and returns when it is its turn. Takes
 * the place given by KERF_CLOCK_SLOT in the environment (reserved or lent by the
 * parent) when there is one. 0; joined already: 0; -ENOSPC: 256 participants. */
int kerf_clock_join(const char *name, int prio);
/* Gives the place back (a borrowed one to its lender). Nothing when not joined.
 * A process that ends without it holds time until it is really gone. */
void kerf_clock_leave(void);
/* 1 when the calling thread is a participant. */
int kerf_clock_joined(void);

/* For waits that only the outside world ends (a terminal, a socket, a lock):
 * between suspend and resume time goes on without the caller. */
void kerf_clock_suspend(void);
void kerf_clock_resume(void);

/* poll(2) whose timeout (ns; negative: none) is in this clock's time. Time goes
 * on meanwhile. Number of ready descriptors, 0 at the timeout, or -errno. */
int kerf_clock_poll(struct pollfd *fds, nfds_t count, int64_t timeout_ns);

/* Asks ready(arg) every period_ns until it gives nonzero. 0; -ETIMEDOUT after
 * timeout_ns (negative: never); -EINTR. */
int kerf_clock_wait(int (*ready)(void *arg), void *arg, int64_t period_ns, int64_t timeout_ns);

/* For people: one line on the clock, then one for each participant. */
void kerf_clock_print(FILE *to);

/* ---- Children -----------------------------------------------------------
 * KERF_CLOCK_SLOT=<value> in the child's environment tells it which place to
 * take. Both ways keep time standing while the child starts, so that its first
 * action comes at a repeatable moment.
 *   lend     the parent waits for the child; the child runs in the parent's place
 *   reserve  both run on; the child gets a place of its own
 * Values are strings of less than KERF_CLOCK_SLOT_LEN; empty in real mode and for
 * a caller that is not a participant (then do not set the variable: unset it).
 */
#define KERF_CLOCK_SLOT_ENV "KERF_CLOCK_SLOT"
#define KERF_CLOCK_SLOT_LEN 48

/* Lends the caller's place: it may be taken and given back many times until
 * kerf_clock_reclaim. The caller must do nothing but wait (wall time) for its
 * child. Nested lending is fine. 0 or -errno. */
int kerf_clock_lend(char *value, size_t size);
/* Ends lending; returns when it is the caller's turn again. */
void kerf_clock_reclaim(void);

/* Reserves a place for a child; time stands until the child joins, dies, or
 * KERF_CLOCK_HANG_S (default 10 s of wall time) have passed. name and prio are
 * used until the child joins with its own. 0 or -errno. */
int kerf_clock_reserve(char *value, size_t size, const char *name, int prio);
/* Says which process the place is for; call it right after fork in the parent. */
void kerf_clock_reserved_for(const char *value, pid_t pid);
/* Gives up a reservation that was not claimed. */
void kerf_clock_unreserve(const char *value);

/* waitpid(2): for a child in the caller's lent place it waits and reclaims; for
 * other children of a participant it waits in virtual time; else plain. */
pid_t kerf_clock_waitpid(pid_t pid, int *status, int options);

#ifdef __cplusplus
}
#endif
#endif
