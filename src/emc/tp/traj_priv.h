/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * traj_priv.h - what the parts of the trajectory planner share: join.c (how moves join, the
 * rounded path), cell.c (bounds and the envelope), traj.c (execution). Context: [servo].
 */
#ifndef KERF_TP_TRAJ_PRIV_H
#define KERF_TP_TRAJ_PRIV_H

#include "traj.h"

#define JERK_CURVE 0.75    /* share of jerk that a path's third derivative may use at constant speed: */
                           /* the rest is for changes of speed */
#define JOIN_JERK 0.5      /* share of jerk that the width of a rounding is made for */
#define KINK_SHARE 0.5     /* of one cycle's acceleration, for the velocity step of a kink */
#define STEP_JERK 0.75     /* jerk of sampled positions by a step of acceleration 1 / cycle */

static inline struct traj_cell *cell_at(struct traj *tj, uint32_t index)
{
    return &tj->cells[index & (TRAJ_CELLS - 1)];
}

static inline const struct traj_cell *ccell_at(const struct traj *tj, uint32_t index)
{
    return &tj->cells[index & (TRAJ_CELLS - 1)];
}

static inline struct traj_cell *piece_at(struct traj *tj, uint32_t index)
{
    return &tj->pieces[index & (TRAJ_PIECES - 1)];
}

/* ---- join.c ---- */

/* Speed along s that the rounding of a junction of this move is made for. */
double planned_speed(const struct traj *tj, const struct traj_seg *g);
/* Limit of acceleration of an axis; the move's own where the axis has none. */
double axis_acc(const struct traj *tj, int axis, const struct traj_seg *g);
/* Makes the roundings of junctions final, within the budget of a cycle, and moves on the end of
 * the final path. */
void finish_joins(struct traj *tj);
void update_final(struct traj *tj);
/* Largest distance from the junction at which its rounding or zone acts. */
double join_reach(const struct traj_seg *g);
/* The move that contains s, searched from `from`. */
uint32_t seg_of(const struct traj *tj, uint32_t from, double s);
/* Position and derivatives of the rounded path at s in move `index`. */
void rounded_jet(const struct traj *tj, uint32_t index, double s, struct path_jet *jet);

/* What a junction's jumps are of the limits of acceleration, and of jerk; bend: those of curvature. */
double junction_acc(const struct traj *tj, uint32_t c);
void junction_jerk(const struct traj *tj, uint32_t c, double *jerk, double *bend);
/* Half width that the rounding of a junction which is not final will have, about. */
double join_guess(const struct traj *tj, uint32_t c);

/* ---- pace.c ---- */

/* 1: motion gets on faster with a rest at junction c than with a rounding over +-w. */
int pace_rests(const struct traj *tj, uint32_t c, double w);
/* Window, up to `most` cycles, that moves index .. end - 1 of a run are fastest with. */
int pace_window(const struct traj *tj, uint32_t index, uint32_t end, int most);

/* ---- cell.c ---- */

/* A step of acceleration acts in jerk while its place is within the window and so many cycles. */
#define JERK_CYCLES 5

/* Cap of b by the feeds of a cell's moves. */
double feed_b(const struct traj *tj, const struct traj_cell *c, double scale, double vlimit);
/* Cuts the final path into pieces, makes cells of those that are ripe, and brings the envelope up to date; each within
 * the budget of a cycle. */
void cut_pieces(struct traj *tj);
void ripen_pieces(struct traj *tj);
void sweep_envelope(struct traj *tj);
/* Envelope for running backward: from the oldest cell to the present one. 1: complete. */
int sweep_back(struct traj *tj);
/* Highest b at distance d before a boundary that must be passed with at most b_end (line: bound of
 * braking), or at distance d after one passed with b_end (line: bound of speeding up). */
double ramp_b(const struct traj_line line[2], double b_end, double d);
/* Acceleration allowed at b. */
double allowed(const struct traj_line line[2], double b);

#endif
