/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * simple_tp.h - one-dimensional planner of joint jogs, homing, axis jogs and external offsets.
 *
 * Units: joint or axis units (mm, inch or degree) and seconds.
 * Invariants, for any sequence of targets and enables with constant limits:
 * (1) differences of consecutive positions stay within max_vel, max_acc and,
 * where max_jerk > SIMPLE_TP_MIN_JERK, max_jerk; (2) a target farther away than
 * the stopping distance is reached exactly; overshoot: none, jerk-limited at most
 * 0.05 max_jerk T^3 (SIMPLE_TP_OVERSHOOT).
 */
#ifndef KERF_SIMPLE_TP_H
#define KERF_SIMPLE_TP_H

#ifdef __cplusplus
extern "C" {
#endif

#define SIMPLE_TP_MIN_JERK 0.0001 /* units/s^3; at or below: no jerk limit */

/* Bound of the overshoot of a jerk-limited approach, in parts of max_jerk T^3. */
#define SIMPLE_TP_OVERSHOOT 0.05

#define SIMPLE_TP_PHASES 3 /* of a stop: the brake comes, stays, goes */

typedef struct simple_tp {
    double pos_cmd;   /* target, may change at any time */
    double max_vel;   /* > 0; lowering it decelerates with max_acc */
    double max_acc;   /* > 0 */
    double max_jerk;  /* 0: none */
    int enable;       /* 0: stop with the limits, the target becomes the place of the stop */
    double curr_pos;
    double curr_vel;
    double curr_acc;
    double curr_jerk; /* last step's; 0 without jerk limit */
    int active;       /* 1: moving or about to */
} simple_tp_t;

/* [servo] One step of period (s, > 0). Trapezoidal unless max_jerk is set. Cost: bounded. */
void simple_tp_update(simple_tp_t *tp, double period);

/* [servo] Takes over a motion: position, speed and acceleration; not enabled, so that it stops. */
void simple_tp_adopt(simple_tp_t *tp, double pos, double vel, double acc);

/* [any] Signed distance (units) from here to rest when stopping now. */
double simple_tp_stop_distance(const simple_tp_t *tp, double period);
/* [any] Signed distance after t >= 0 seconds of this stop. */
double simple_tp_stop_way(const simple_tp_t *tp, double period, double t);
/* [any] Ends of its phases, s from now, ascending: the last is its end. */
void simple_tp_stop_times(const simple_tp_t *tp, double period, double times[SIMPLE_TP_PHASES]);

#ifdef __cplusplus
}
#endif
#endif
