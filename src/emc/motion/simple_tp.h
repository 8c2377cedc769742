/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * simple_tp.h - one-dimensional planner of joint jogs, homing, axis jogs and external offsets.
 *
 * Units: joint or axis units (mm, inch or degree) and seconds.
 * Invariant: with constant limits the position sequence stays within max_vel
 * and max_acc, with max_jerk > SIMPLE_TP_MIN_JERK and planner type 1 within
 * max_jerk too; a target that lies farther than the stopping distance is not overshot.
 */
#ifndef KERF_SIMPLE_TP_H
#define KERF_SIMPLE_TP_H

#ifdef __cplusplus
extern "C" {
#endif

#define SIMPLE_TP_MIN_JERK 0.0001 /* units/s^3; at or below: no jerk limit */

typedef struct simple_tp {
    double pos_cmd;   /* target, may change at any time */
    double max_vel;   /* > 0; lowering it decelerates with max_acc */
    double max_acc;   /* > 0 */
    double max_jerk;  /* 0: none */
    int enable;       /* 0: stop with the limits, target follows */
    double curr_pos;
    double curr_vel;
    double curr_acc;
    double curr_jerk; /* last step's; 0 without jerk limit */
    int active;       /* 1: moving or about to */
} simple_tp_t;

/* [servo] One step of period (s, > 0). planner_type: 0 trapezoidal, 1 jerk-limited. */
void simple_tp_update(simple_tp_t *tp, double period, int planner_type);

#ifdef __cplusplus
}
#endif
#endif
