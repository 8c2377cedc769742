/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * usrmotintf.h - the user-space side of the motion controller's shared memory.
 *
 * Context: [task]. One thread of one program writes commands; reading status is
 * allowed to any number. Waiting goes through kerf_clock.h.
 */
#ifndef KERF_USRMOTINTF_H
#define KERF_USRMOTINTF_H

#include "motion.h"

#ifdef __cplusplus
extern "C" {
#endif

#define EMCMOT_COMM_OK 0
#define EMCMOT_COMM_ERROR_CONNECT (-1)    /* not connected */
#define EMCMOT_COMM_ERROR_TIMEOUT (-2)    /* motion did not echo the command in time */
#define EMCMOT_COMM_ERROR_COMMAND (-3)    /* commandStatus is not OK */
#define EMCMOT_COMM_SPLIT_READ_TIMEOUT (-4)
#define EMCMOT_COMM_INVALID_MOTION_ID (-5) /* id INT_MIN is no id */

/* Connects to the segment with this key (default 100; the instance is applied).
 * timeout_s: how long a command waits for its echo (default 1.0). name is the
 * RTAPI module name. Returns 0, or -1 when there is no segment. */
int usrmotInit(const char *name, int key, double timeout_s);
int usrmotExit(void);
/* 1: failures of commands are returned but not printed. */
void usrmotSetQuiet(int quiet);
/* The segment, or a null pointer. For stand-ins of motmod and for tests. */
emcmot_struct_t *usrmotSegment(void);

/* Sends a copy of *c with the next commandNum and waits for the echo.
 * Returns EMCMOT_COMM_*; prints the documented "USRMOT: ERROR: ..." line on failure. */
int usrmotWriteEmcmotCommand(emcmot_command_t *c);

/* Consistent copies. Status: 0, -1, -4 (contents then mixed, harmless; read again). */
int usrmotReadEmcmotStatus(emcmot_status_t *s);
int usrmotReadEmcmotConfig(emcmot_config_t *c);
int usrmotReadEmcmotInternal(emcmot_internal_t *i);

/* Oldest message into e (EMCMOT_ERROR_LEN bytes). Returns 0, -1 when there is none. */
int usrmotReadEmcmotError(char *e);

/* Reads a compensation file into commands SET_JOINT_COMP of a joint, see motion.md 12.
 * type 0: nominal, forward, reverse positions; other: nominal, forward trim, reverse trim.
 * Returns 0, -1 when the file cannot be opened (message printed). */
int usrmotLoadComp(int joint, const char *file, int type);

#ifdef __cplusplus
}
#endif
#endif
