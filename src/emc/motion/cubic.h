/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * cubic.h - cubic interpolation of one joint between planner points.
 *
 * Four points of history; between the smoothed middle ones runs a cubic with
 * their slopes. Output is a weighted mean of the points, so neither its speed
 * nor its acceleration nor its jerk (as differences) exceeds theirs.
 * Units: joint units and seconds. Context: [servo].
 */
#ifndef KERF_CUBIC_H
#define KERF_CUBIC_H

typedef struct {
    double segment_s;  /* time between points */
    double step_s;     /* time between outputs */
    double t;          /* time of the next output within the segment */
    double x[4];       /* points, oldest first */
    int filled;        /* 0: empty, the next point fills all four */
    int need_next;     /* 1: a point is wanted before the next output */
    double a, b, c, d; /* the cubic: ((a t + b) t + c) t + d */
} cubic_t;

/* Sets the times (s, > 0): rate outputs a segment. Empties the history. */
void cubic_init(cubic_t *ci, double segment_s, int rate);
/* Forgets the history. */
void cubic_drain(cubic_t *ci);
/* Adds the newest point. */
void cubic_add_point(cubic_t *ci, double point);
/* Next output; pointers may be null. Without points all are 0. */
double cubic_interpolate(cubic_t *ci, double *vel, double *acc, double *jerk);
/* 1 when all points are equal: the output rests. An empty one rests too. */
int cubic_at_rest(const cubic_t *ci);

#endif
