/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * follow.h - following the position of a spindle.
 *
 * A filter of second order estimates position and speed from the revolutions
 * that the encoder shows; follow_speed() is the law that brings a motion with
 * limited acceleration onto the reference. Pure arithmetic, [servo].
 */
#ifndef KERF_TP_FOLLOW_H
#define KERF_TP_FOLLOW_H

struct follower {
    int cycles;       /* measured so far, 0: the filter has no state */
    double revs;      /* estimated position, revolutions */
    double speed;     /* estimated, revolutions/s */
    double origin;    /* position at which the present move's reference is 0 */
};

#define FOLLOW_SETTLED 60 /* cycles after which the estimate of the speed is good */

/* One cycle of dt seconds: takes the measured position in. Returns 1 where counting has got another origin (an index,
 * a reset, a lost encoder); a reference that is followed goes on from its place. */
int follow_measure(struct follower *f, double revs, double dt);
/* The encoder was reset at its index: position anew, speed kept. */
void follow_index(struct follower *f, double revs);
/* Reference of a move of `upr` units a revolution, `lead` seconds from now. */
double follow_reference(const struct follower *f, double upr, double lead);
/* Speed that brings a motion with at most acc (units/s^2) onto a reference that is `error`
 * units ahead and moves at `speed`; dt: cycle, s. */
double follow_speed(double error, double speed, double acc, double dt);
/* Sets the origin so that the run-up from rest ends in phase: the reference passes 0 a whole
 * number of revolutions after the index, whatever the speed. */
void follow_start(struct follower *f, double upr, double acc, double lead, double dt);

#endif
