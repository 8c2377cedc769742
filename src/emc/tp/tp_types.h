/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * tp_types.h - what motmod knows of a trajectory planner's object.
 *
 * motmod owns the TP_STRUCT (zeroed); the members listed here are written by
 * the planner and read by motmod; everything else of a planner hangs from `impl`.
 */
#ifndef KERF_TP_TYPES_H
#define KERF_TP_TYPES_H

typedef enum {
    TC_DIR_FORWARD = 0,
    TC_DIR_REVERSE = 1
} tc_direction_t;

/* Return codes of the planner. Negative: failed; positive: nothing to do. */
typedef enum {
    TP_ERR_INVALID = -9,
    TP_ERR_INPUT_TYPE = -8,
    TP_ERR_TOLERANCE = -7,
    TP_ERR_RADIUS_TOO_SMALL = -6,
    TP_ERR_GEOM = -5,
    TP_ERR_RANGE = -4,
    TP_ERR_MISSING_OUTPUT = -3,
    TP_ERR_MISSING_INPUT = -2,
    TP_ERR_FAIL = -1,
    TP_ERR_OK = 0,
    TP_ERR_NO_ACTION = 1,
    TP_ERR_SLOWING = 2,
    TP_ERR_STOPPED = 3,
    TP_ERR_WAITING = 4,
    TP_ERR_ZERO_LENGTH = 5,
    TP_ERR_REVERSE_EMPTY = 6
} tp_err_t;

typedef struct {
    void *impl;
} TC_QUEUE_STRUCT;

typedef struct {
    int waiting_for_index;   /* id of the move that waits, -1 none */
    int waiting_for_atspeed; /* id of the move that waits, -1 none */
} tp_spindle_t;

typedef struct {
    TC_QUEUE_STRUCT queue; /* passed to tcqFull() */
    tp_spindle_t spindle;
    int reverse_run;       /* tc_direction_t in effect */
    void *impl;            /* the planner's own */
} TP_STRUCT;

#endif
