/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * traj.h - queue of moves, look-ahead and execution: the planner without HAL.
 *
 *   append -> junctions (how two moves join) -> cells (pieces of path with bounds)
 *          -> envelope K (highest speed from which the queue's end can be reached at rest)
 *          -> step (one servo cycle along the path)
 *
 * Invariants, held whatever is commanded and whenever:
 *   1. the position is always a point of the rounded path; a rounded path leaves
 *      the programmed one by no more than the tolerance;
 *   2. within a cell -down(b) <= u <= up(b) and b <= cap, u being the acceleration along
 *      the path and b the squared speed: that keeps every axis within its limits;
 *   3. from the present state, braking by the bound of 2 keeps 2 in all cells ahead and
 *      ends at rest before the last cell's end.
 * Overrides, pause, abort and reverse only change the speed that step() aims at.
 *
 * Context: traj_init [init]; all others [servo]: no allocation, no locks, bounded loops.
 * Units: machine units and degrees, seconds. Derivations and proofs: docs/planner.md.
 */
#ifndef KERF_TP_TRAJ_H
#define KERF_TP_TRAJ_H

#include <stdint.h>

#include "path.h"

#define TRAJ_SEGS 4096   /* capacity of the ring of moves, a power of two */
#define TRAJ_CELLS 16384 /* capacity of the ring of cells, a power of two */
#define TRAJ_HISTORY 200 /* executed moves kept for reverse run */

/* What happens at the end of a move. */
enum traj_end {
    TRAJ_STOP = 0,  /* rest */
    TRAJ_EXACT = 1, /* on the programmed path; speed may stay where the path is smooth */
    TRAJ_BLEND = 2  /* rounded within a tolerance */
};

/* What the speed of a move follows. */
enum traj_follow {
    TRAJ_FEED = 0,     /* its feed times the override, capped by the limit of speed */
    TRAJ_SYNC_SPEED,   /* drive.sync_speed times the override */
    TRAJ_SYNC_POSITION /* drive.sync_speed, no override */
};

/* A move to append; all speeds in the move's metric. */
struct traj_move {
    struct path_prim prim;
    double feed;  /* requested speed, units/s */
    double vmax;  /* the machine's limit along the move, units/s */
    double acc;   /* the machine's limit along the move, units/s^2 */
    double jerk;  /* units/s^3, 0 = none */
    double tol;   /* units; 0 = not limited */
    enum traj_end end;
    enum traj_follow follow;
    int rest_before; /* start from rest, and wait for traj_release() */
    int mark;        /* no path: motion rests here from traj_release() to traj_finish() */
};

/* How a move joins the one before. */
enum traj_join {
    JOIN_REST,   /* stop */
    JOIN_SMOOTH, /* tangent: nothing to do */
    JOIN_ROUND,  /* rounded over +-w */
    JOIN_KINK    /* corner passed exactly, with a step of velocity that one cycle's acceleration covers */
};

struct traj_seg {
    struct path_prim prim;
    double s0, s1;         /* place on the whole path */
    double feed, vmax;     /* as in traj_move */
    double acc;            /* limit of acceleration along s */
    double jerk;
    double tol;
    double stretch;        /* len / feed_len: metric speed to speed along s; large when the metric part is tiny */
    enum traj_end end;
    enum traj_follow follow;
    /* the junction at the start of this move */
    enum traj_join join;
    int released;          /* JOIN_REST: may start */
    int mark;              /* no path, see traj_move */
    int cut;               /* a cell must begin at s0 */
    double du[PATH_AXES];  /* jump of dp/ds */
    double dk[PATH_AXES];  /* jump of d2p/ds2 */
    double bend;           /* largest group norm of du */
    double w;              /* half width of the rounding, 0 = none */
    int solo;              /* the rounding overlaps no other */
    double tol_join;       /* tolerance at s0 */
    double off;            /* sum of |du| w E of all final roundings at s0: bounds the deviation */
    /* roundings that reach into this move: junctions lo .. hi, none when hi - lo < 0 */
    uint32_t lo, hi;
    double zone;           /* JOIN_KINK: half width of the region with reduced limits */
    double kink_b;         /* JOIN_KINK: cap of b */
};

/* A bound of acceleration that shrinks with the squared speed. */
struct traj_line {
    double c1, c2;
};

/* A piece of path with the bounds of motion on it. */
struct traj_cell {
    double s0, len;
    double cap;          /* of b */
    struct traj_line up[2], down[2]; /* -(c1 - c2 b) of down <= u <= c1 - c2 b of up, all four lines; c2 >= 0 */
    double metric;       /* largest |dp/ds| in the feed's metric */
    uint32_t seg;        /* move at s0: feed */
    uint32_t seg2;       /* the other move of a rounding between very different ones, else seg */
    int rest;            /* motion rests at s0 */
    double k;            /* b allowed at s0 when running forward */
    double kr;           /* b allowed at s0 when running backward */
};

/* What step() aims at; set before each cycle. */
struct traj_drive {
    double scale;      /* feed override now, >= 0; 0 holds */
    double max_scale;  /* largest override the rounding is planned for */
    double vlimit;     /* cap of xyz/uvw speed, units/s */
    double sync_speed; /* for moves that follow the spindle, metric units/s */
    int hold;          /* stop, whatever the move follows */
    int reverse;       /* run backward (obeyed at rest) */
    double stop_s;     /* come to rest at this place when it lies ahead in the direction of motion */
};

struct traj_limits {
    double v[PATH_AXES], a[PATH_AXES], j[PATH_AXES]; /* 0 = unknown: the moves' own limits serve */
};

struct traj {
    double dt; /* cycle, s */
    struct traj_limits lim;
    struct traj_drive drive;

    /* moves: first .. cur .. end, free running counters; cur: the move that started last */
    uint32_t first, cur, end;
    uint32_t fin;        /* first junction whose rounding is not final */
    double s_final;      /* the path is final up to here */
    int hungry;          /* cycles since the last append */
    int tail_forced;     /* s_final was moved to the end of the last move */

    /* cells */
    uint32_t cell_first, cell_end;
    uint32_t cut_seg;    /* move that contains cut_s */
    double cut_s;

    /* envelope */
    uint32_t sweep;      /* next cell to look at */
    int sweeping;
    int sweep_full;      /* caps changed: do not stop early */
    int sweep_anew;      /* the next sweep covers all cells */
    uint32_t swept_end;  /* cell_end when the last sweep began */
    double sweep_scale, sweep_vlimit;
    uint32_t back_sweep;   /* next cell of the envelope for running backward; cell_end: done */
    double back_scale;

    /* motion */
    double s, v;         /* v >= 0 */
    double acc;          /* along s, last cycle, signed by the direction of s */
    int dir;             /* +1, -1 */
    uint32_t cell;
    int waiting;         /* at rest before move cur + 1 (cur, at the very start) until released */
    int in_mark;         /* move cur is a mark that was released */

    double pos[PATH_AXES]; /* last position */

    /* counters of what cost speed, for diagnosis */
    uint64_t n_forced, n_rest, n_portions;

    struct traj_seg seg[TRAJ_SEGS];
    struct traj_cell cells[TRAJ_CELLS];
};

void traj_init(struct traj *tj, double dt);
/* Forgets all moves; the path begins anew at p. */
void traj_reset(struct traj *tj, const double p[PATH_AXES]);
/* Appends a move that begins where the last one ends. Returns its index, or -1: no room. */
int64_t traj_append(struct traj *tj, const struct traj_move *move);
/* One servo cycle: look-ahead within its budget, then dt along the path. */
void traj_cycle(struct traj *tj);
/* The move before which motion waits; -1: does not wait. */
int64_t traj_waiting(const struct traj *tj);
/* Lets it start. */
void traj_release(struct traj *tj);
/* Ends a mark. */
void traj_finish(struct traj *tj);
/* At rest (no speed, nothing left in filters). */
int traj_at_rest(const struct traj *tj);
/* At rest at the end of all moves. */
int traj_done(const struct traj *tj);
/* Seconds by which the position lags behind what drive asks for. */
double traj_lag(const struct traj *tj);
/* Moves that shape the position now: 0 idle, 2 in a rounding, else 1. */
int traj_active(const struct traj *tj);
/* Position of the rounded path at s. */
void traj_pose(const struct traj *tj, double s, double p[PATH_AXES]);

static inline struct traj_seg *traj_seg(struct traj *tj, uint32_t index)
{
    return &tj->seg[index & (TRAJ_SEGS - 1)];
}

static inline const struct traj_seg *traj_cseg(const struct traj *tj, uint32_t index)
{
    return &tj->seg[index & (TRAJ_SEGS - 1)];
}

#endif
