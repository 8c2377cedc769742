/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * traj.h - queue of moves, look-ahead and execution: the planner without HAL.
 *
 *   append -> junctions (how two moves join) -> cells (pieces of path with bounds)
 *          -> envelope K (highest speed from which the queue's end can be reached at rest)
 *          -> step (one servo cycle along the path) -> filter (with limits of jerk)
 *
 * Invariants, held whatever is commanded and whenever:
 *   1. the position is always a point of the rounded path; a rounded path leaves
 *      the programmed one by no more than the tolerance;
 *   2. within a cell -down(b) <= u <= up(b) and b <= cap, u being the acceleration along
 *      the path and b the squared speed: that keeps every axis and joint within its limits;
 *   3. from the present state, braking by the bound of 2 keeps 2 in all cells ahead and
 *      ends at rest before the last cell's end.
 * With limits of jerk the place on the path is the mean of the last `window` places of step():
 * acceleration then changes by no more than u / window, because between speeding up and braking step() keeps
 * its speed for a window (invariant 3 holds after that), and 2 holds for
 * every place where the mean may be while step() is in a cell: pieces with their own bounds become
 * cells when all that is in reach is known.
 * Overrides, pause, abort and reverse only change the speed that step() aims at.
 *
 * Context: traj_init [init]; all others [servo]: no allocation, no locks, bounded loops.
 * Units: machine units and degrees, seconds. Derivations and proofs: docs/planner.md.
 */
#ifndef KERF_TP_TRAJ_H
#define KERF_TP_TRAJ_H

#include <stdint.h>

#include "limits.h"
#include "path.h"

#define TRAJ_SEGS 4096   /* capacity of the ring of moves, a power of two */
#define TRAJ_CELLS 16384 /* capacity of the ring of cells, a power of two */
#define TRAJ_PIECES 2048 /* capacity of the ring of pieces on their way to cells, a power of two */
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
    double curl;           /* largest group norm of dk, 0 when jerk does not matter */
    double w;              /* half width of the rounding, 0 = none */
    int solo;              /* the rounding overlaps no other */
    double tol_join;       /* tolerance at s0 */
    double off;            /* sum of |du| w E of all final roundings at s0: bounds the deviation */
    /* roundings that reach into this move: junctions lo .. hi, none when hi - lo < 0 */
    uint32_t lo, hi;
    double zone;           /* JOIN_KINK: half width of the region with reduced limits */
    double kink_b;         /* JOIN_KINK: cap of b */
    int window;            /* JOIN_REST: cycles of the filter from here on, 1 = none */
};

/* A bound of acceleration that shrinks with the squared speed. */
struct traj_line {
    double c1, c2;
};

/* A piece of path with the bounds of motion on it; a cell when k and kr count. */
struct traj_cell {
    double s0, len;
    double cap;          /* of b, by limits and by the highest feed there may be */
    struct traj_line up[2], down[2]; /* -(c1 - c2 b) of down <= u <= c1 - c2 b of up, all four lines; c2 >= 0 */
    double top;          /* speed along s at cap */
    double metric;       /* largest |dp/ds| in the feed's metric */
    uint32_t seg;        /* move at s0: feed */
    uint32_t seg2;       /* the other move of a rounding between very different ones, else seg */
    int rest;            /* motion rests at s0 */
    int window;          /* of the filter, cycles */
    int turns;           /* acceleration may turn within the window: motion that follows a spindle */
    double k;            /* b allowed at s0 when running forward */
    double kr;           /* b allowed at s0 when running backward */
};

/* Pieces in reach of a piece, in order of the path, and the parts of it where their bounds hold. */
#define TRAJ_REACH 160 /* pieces that a bound may reach over, each side */
struct traj_reach {
    int count;
    const struct traj_cell *by[2 * TRAJ_REACH + 1];
    double from[2 * TRAJ_REACH + 1], to[2 * TRAJ_REACH + 1];
    int whole; /* all hold on all of the piece */
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

/* One axis or joint in a cell: ranges of its first and second derivative by s, largest third. */
struct traj_row {
    double lo1, hi1, lo2, hi2, most3;
    double v, a, j; /* limits, 0 = none */
};

/* Mean of the last n values. */
#define TRAJ_WINDOW 256
struct traj_filter {
    double x[TRAJ_WINDOW]; /* relative to base */
    double base, sum;
    int n, at, still;      /* still: cycles since the input changed */
};

struct traj {
    double dt; /* cycle, s */
    struct limits lim;
    struct traj_drive drive;

    /* moves: first .. cur .. end, free running counters; cur: the move that started last */
    uint32_t first, cur, end;
    uint32_t fin;        /* first junction whose rounding is not final */
    double s_final;      /* the path is final up to here */
    int hungry;          /* cycles since the last append */
    int tail_forced;     /* s_final was moved to the end of the last move */

    /* pieces of path with their own bounds, and the cells made of those that are ripe */
    uint32_t piece_ripe, piece_end;
    uint32_t cell_first, cell_end;
    double kin_len;      /* length of the last cell whose joints were sampled */
    int cut_window;      /* window of the cells being cut, */
    int cut_turns;       /* and how they follow */
    int blocked;         /* the kinematics have no solution right after the last cell */
    uint32_t cut_seg;    /* move that contains cut_s */
    double cut_s;

    /* envelope */
    uint32_t sweep;      /* next cell to look at */
    int sweeping;
    int sweep_full;      /* caps changed: do not stop early */
    int sweep_anew;      /* the next sweep covers all cells */
    uint32_t swept_end;  /* cell_end when the last sweep began */
    uint32_t swept_before; /* and when the one before it began: cells from there on have no envelope yet */
    double sweep_scale, sweep_vlimit;
    uint32_t back_sweep;   /* next cell of the envelope for running backward; cell_end: done */
    double back_scale;

    /* motion */
    double s, v;         /* of step(); v >= 0 */
    int sped, braked;    /* cycles since step() sped up, braked */
    struct traj_filter filter;
    double place;        /* on the path, behind the filter */
    double speed, acc;   /* of place, last cycle, signed by the direction of s */
    int dir;             /* +1, -1 */
    uint32_t cell;
    int waiting;         /* at rest before move cur + 1 (cur, at the very start) until released */
    int in_mark;         /* move cur is a mark that was released */

    double pos[PATH_AXES]; /* last position */

    /* of the piece being made: too big for the stack of a realtime thread */
    struct {
        struct path_jet at[3];
        struct limits_jet jet[3];
        struct traj_row rows[PATH_AXES + LIMITS_JOINTS];
    } scratch;
    struct traj_reach reach; /* of the piece that gets ripe */

    /* counters of what cost speed, for diagnosis */
    uint64_t n_forced, n_rest, n_portions;

    struct traj_seg seg[TRAJ_SEGS];
    struct traj_cell pieces[TRAJ_PIECES];
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
/* Takes over a new input (also sets n, 1 to TRAJ_WINDOW): all values are x. */
void traj_filter_set(struct traj_filter *f, int n, double x);
/* One cycle: the mean with x. */
double traj_filter_step(struct traj_filter *f, double x);
/* The output is the last input. */
int traj_filter_settled(const struct traj_filter *f);
/* Cycles of the filter that a motion with speed v, acceleration a and jerk j is best run with. turn: 1, or 2 where the
 * acceleration may turn from one bound to the other at once. */
int traj_window(const struct traj *tj, double v, double a, double j, int turn);
/* The path beyond the present place cannot be followed: no solution of the kinematics. */
int traj_blocked(const struct traj *tj);
/* At rest (no speed, nothing left in filters). */
int traj_at_rest(const struct traj *tj);
/* At rest at the end of all moves. */
int traj_done(const struct traj *tj);
/* Limit of jerk along a move, 0 = none. Joints that are sampled: by the time they take to build up
 * their acceleration. */
double traj_jerk(const struct traj *tj, const struct traj_seg *g);
/* Acceleration of a move that begins a run, metric units/s^2, with the limit of jerk. */
double traj_acc(const struct traj *tj, uint32_t index);
/* Seconds by which the position lags behind what drive asks for. */
double traj_lag(const struct traj *tj);
/* Path length (units of s) in which motion comes to rest when it is held from now on; not less. */
double traj_stop_distance(const struct traj *tj);
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
