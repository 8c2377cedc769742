/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * bench.h - a machine of nine axes around the planner, for test programs.
 *
 * Drives the planner through its interface to motmod only, and checks every
 * cycle's position by differences against the axes' limits and by distance
 * against its own copy of the program. Shares no code with the planner.
 */
#ifndef KERF_TP_TEST_BENCH_H
#define KERF_TP_TEST_BENCH_H

#include <stdint.h>

#include "tp.h"

#define AXES 9
#define JOINTS 16

/* A move as programmed. */
struct prog {
    int arc;
    double start[AXES], end[AXES];
    double center[3], normal[3];
    int turn;
    int canon;
    double feed;     /* units/s in the move's metric */
    double tol;
    int term;        /* EMCMOT_TERM_COND_* */
    int sent;
    double vmax, acc, jerk; /* as task would send them */
    double angle, radius, len; /* arcs: swept angle (rad), start radius; length in the metric */
    double ex[3], ey[3], nz[3], c0[3], rise, spiral;
};

struct bench {
    TP_STRUCT tp;
    emcmot_status_t status;
    emcmot_config_t config;
    double dt;
    double v[AXES], a[AXES], j[AXES];
    int jerk_on;

    /* joints behind the axes; none: axes only */
    int joints;
    int (*inverse)(const double p[AXES], double *q);
    double jv[JOINTS], ja[JOINTS], jj[JOINTS]; /* limits, jerk 0: none */
    double q[JOINTS], qs[4][JOINTS];           /* last joint positions */
    uint64_t inverses;                         /* calls of the inverse by the planner */

    struct prog *prog;
    int n, room, next; /* moves, allocated, next to send */
    double at[AXES];   /* end of the program so far */

    /* checker */
    uint64_t cycles;
    double p[4][AXES]; /* last positions, newest first */
    int have;
    double worst_v, worst_a, worst_j; /* ratios */
    double worst_dev;                 /* deviation / tolerance; exact moves: deviation / 1e-6 */
    double worst_off;                 /* largest deviation, units */
    uint64_t worst_v_at, worst_a_at, worst_j_at, worst_dev_at;
    int worst_v_axis, worst_a_axis, worst_j_axis; /* joint n: AXES + n */
    int check_every;  /* deviation is measured each so many cycles */
    int near;         /* move the last position was near to */
    uint64_t moving;  /* cycles with motion */
};

extern int bench_verbose;
extern char bench_message[300]; /* last one that the planner printed since bench_init */

/* Random numbers (splitmix64): the whole test hangs from one seed. */
uint64_t rnd(uint64_t *state);
double rnd_unit(uint64_t *state);                        /* [0, 1) */
double rnd_range(uint64_t *state, double lo, double hi);
double rnd_log(uint64_t *state, double lo, double hi);   /* log-uniform */
int rnd_int(uint64_t *state, int n);                     /* 0 .. n-1 */

void bench_init(struct bench *b, double dt);
void bench_free(struct bench *b);
/* Limits of an axis; jerk 0: none. */
void bench_axis(struct bench *b, int axis, double v, double a, double j);
/* Kinematics; before bench_start. */
void bench_joints(struct bench *b, int joints, int (*inverse)(const double p[AXES], double *q));
void bench_joint(struct bench *b, int joint, double v, double a, double j);
/* After the limits: makes the planner; jerk_on selects the jerk-limited planner. */
void bench_start(struct bench *b, int jerk_on);

/* Adds moves to the program. */
struct prog *bench_line(struct bench *b, const double end[AXES], int canon, double feed, int term, double tol);
struct prog *bench_arc(struct bench *b, const double end[AXES], const double center[3], const double normal[3],
                       int turn, double feed, int term, double tol);
/* Sends the next move to the planner. Returns the planner's result, 1 when there is none left. */
int bench_send(struct bench *b);
/* One servo cycle with checks. */
void bench_cycle(struct bench *b);
/* Distance of p from the program near b->near; *tol: the tolerance that holds there. */
double bench_distance(struct bench *b, const double p[AXES], double *tol);
/* After an abort or at the end: the program goes on from where the planner stands. */
void bench_resync(struct bench *b);
/* Runs the rest of the program, feeding per_cycle moves a cycle; stops after limit cycles. Returns cycles. */
uint64_t bench_run(struct bench *b, int per_cycle, uint64_t limit);

#endif
