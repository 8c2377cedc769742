/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * traj.c - look-ahead and execution. See traj.h for the invariants, docs/planner.md for proofs.
 */
#include "traj.h"

#include <math.h>
#include <string.h>

#define JOIN_BUDGET 16     /* junctions made final in a cycle */
#define CUT_BUDGET 32      /* cells made in a cycle */
#define SWEEP_BUDGET 512   /* cells looked at by the envelope in a cycle */
#define SPLIT 0.15         /* share of acceleration that a cell may lose to changing curvature; */
#define SPLITS 3           /* it is halved up to so many times */
#define CELLS_CYCLE 40     /* the speed is capped so that so many cells in a row last a cycle */
#define PORTIONS (8 * CELLS_CYCLE) /* pieces of constant acceleration in a cycle, never reached */
#define STOP_SCAN 256      /* cells looked ahead for a stop at a given place */
#define SPREAD 24          /* junctions that a rounding may reach over, each side */
#define TURN_LIMIT 1.0     /* rad: sum of the bends that one rounding smooths */
#define TOL_SHARE 0.8      /* of the tolerance, taken when roundings overlap */
#define GROW 1.5           /* step of the search for a width */
#define HUNGRY 20          /* cycles without a new move: no more may come */

#define CELL_MOVES 64      /* moves that one cell may span; less than TRAJ_HISTORY */

#define ARC_CAP 0.97       /* share of acceleration that a curve at constant speed may use on arcs, */
#define ROUND_CAP 0.995    /* and in roundings: the rest leaves authority to brake */
#define ARC_STEP 0.1745    /* rad: longest cell on an arc of up to one turn */
#define KINK_SHARE 0.5     /* of one cycle's acceleration, for the velocity step of a kink */
#define SMOOTH_SHARE 1e-4  /* a smaller step counts as none */
#define GUARD_TIME 0.02    /* s: the tail is made final so long before it limits the speed */

static struct traj_cell *cell_at(struct traj *tj, uint32_t index)
{
    return &tj->cells[index & (TRAJ_CELLS - 1)];
}

void traj_init(struct traj *tj, double dt)
{
    memset(tj, 0, sizeof *tj);
    tj->dt = dt;
    tj->dir = 1;
    tj->drive.scale = 1;
    tj->drive.max_scale = 1;
    tj->drive.vlimit = 1e99;
    tj->drive.stop_s = NAN;
    tj->sweep_scale = 1;
    tj->sweep_vlimit = 1e99;
}

void traj_reset(struct traj *tj, const double p[PATH_AXES])
{
    tj->first = tj->cur = tj->end = 0;
    tj->cell_first = tj->cell_end = tj->cell = 0;
    tj->s_final = tj->cut_s = 0;
    tj->tail_forced = 0;
    tj->cut_seg = tj->fin = 0;
    tj->hungry = 0;
    tj->sweep = 0;
    tj->sweeping = tj->sweep_anew = 0;
    tj->swept_end = 0;
    tj->s = tj->v = tj->acc = 0;
    tj->dir = 1;
    tj->waiting = tj->in_mark = 0;
    tj->back_sweep = 0;
    memcpy(tj->pos, p, sizeof tj->pos);
}

/* ---- junctions ------------------------------------------------------------ */

/* Speed along s that the rounding of a junction of this move is made for. */
static double planned_speed(const struct traj *tj, const struct traj_seg *g)
{
    double v = g->vmax;
    if (g->follow == TRAJ_FEED) v = fmin(g->feed * fmax(tj->drive.max_scale, 1), v);
    return v * g->stretch;
}

/* Limit of acceleration of an axis; the move's own where the axis has none. */
static double axis_acc(const struct traj *tj, int axis, const struct traj_seg *g)
{
    return tj->lim.a[axis] > 0 ? tj->lim.a[axis] : g->acc / g->stretch;
}

/* Widest rounding that a move's end may ask for, whatever follows. */
static double tail_reserve(const struct traj *tj, const struct traj_seg *g)
{
    double half = g->prim.len / 2, v, a = 0;

    if (g->end == TRAJ_STOP) return 0;
    if (!(g->tol > 0)) return half;
    v = planned_speed(tj, g);
    for (int i = 0; i < PATH_AXES; i++) {
        double ai = axis_acc(tj, i, g);
        if (a == 0 || ai < a) a = ai;
    }
    return fmin(half, 2 * v * sqrt(8 * g->tol / a));
}

/* The share of P left after motmod's cubic interpolator, which moves a sample by A T^2 / 6. */
static double tolerance_left(const struct traj *tj, double tol, const struct traj_seg *g)
{
    double a = 0;
    for (int i = 0; i < PATH_AXES; i++) a = fmax(a, axis_acc(tj, i, g));
    return fmax(tol / 2, tol - a * tj->dt * tj->dt / 6 - 1e-9);
}

static void join_rest(struct traj *tj, struct traj_seg *g)
{
    g->join = JOIN_REST;
    g->cut = 1;
    g->w = g->zone = 0;
    tj->n_rest++;
}

/* A corner that is passed exactly. room: path before it that is not final yet. */
static void join_kink(struct traj *tj, const struct traj_seg *prev, struct traj_seg *g, double room)
{
    double v = 1e30, ratio = 0;

    for (int i = 0; i < PATH_AXES; i++) {
        double step = fabs(g->du[i]);
        if (step > 0) v = fmin(v, KINK_SHARE * axis_acc(tj, i, g) * tj->dt / step);
        ratio = fmax(ratio, step);
    }
    double zone = fmin(2 * v * tj->dt, fmin(prev->prim.len, g->prim.len) / 2);
    if (ratio > 0.1 || zone > room) {
        join_rest(tj, g);
        return;
    }
    v = fmin(v, zone / (2 * tj->dt));
    g->join = JOIN_KINK;
    g->zone = zone;
    g->kink_b = v * v;
    g->cut = 1;
}

/* Decides how move `index` joins the one before; fills the junction. */
static void make_join(struct traj *tj, uint32_t index, int rest_before)
{
    struct traj_seg *g = traj_seg(tj, index);
    const struct traj_seg *prev = traj_cseg(tj, index - 1);
    struct path_jet before, after;
    double speed, biggest = 0, room;

    path_jet_at(&prev->prim, prev->prim.len, &before);
    path_jet_at(&g->prim, 0, &after);
    for (int i = 0; i < PATH_AXES; i++) {
        g->du[i] = after.d1[i] - before.d1[i];
        g->dk[i] = after.d2[i] - before.d2[i];
    }
    g->cut = prev->prim.kind != PATH_LINE || g->prim.kind != PATH_LINE || prev->feed != g->feed ||
             prev->vmax != g->vmax || prev->acc != g->acc || prev->follow != g->follow ||
             prev->prim.metric != g->prim.metric || prev->stretch != g->stretch;
    if (rest_before || prev->end == TRAJ_STOP) {
        join_rest(tj, g);
        return;
    }
    speed = fmax(planned_speed(tj, prev), planned_speed(tj, g));
    for (int i = 0; i < PATH_AXES; i++)
        biggest = fmax(biggest, fabs(g->du[i]) * speed / (axis_acc(tj, i, g) * tj->dt));
    room = g->s0 - tj->cut_s;
    if (biggest < SMOOTH_SHARE) {
        g->join = JOIN_SMOOTH;
        return;
    }
    if (prev->end == TRAJ_EXACT || g->end != TRAJ_BLEND) {
        join_kink(tj, prev, g, room);
        return;
    }
    g->join = JOIN_ROUND;
    g->bend = path_max_norm(g->du);
    g->tol_join = prev->tol > 0 && g->tol > 0 ? fmin(prev->tol, g->tol) : fmax(prev->tol, g->tol);
    if (!(g->tol_join > 0)) g->tol_join = fmin(prev->prim.len, g->prim.len) / 4; /* none given */
    else g->tol_join = tolerance_left(tj, g->tol_join, g);
}

/* How far a rounding at junction c may reach: no barrier, no exact move, at most half an arc.
 * *open: to that side the path is not known far enough yet. */
static double reach_right(const struct traj *tj, uint32_t c, int *open)
{
    *open = 0;
    for (uint32_t t = c;; t++) {
        const struct traj_seg *g = traj_cseg(tj, t);
        if (g->prim.kind != PATH_LINE) return t == c ? g->prim.len / 2 : g->s0 - traj_cseg(tj, c)->s0;
        if (t + 1 == tj->end) {
            *open = g->end == TRAJ_BLEND && !tj->tail_forced;
            return g->s1 - traj_cseg(tj, c)->s0;
        }
        const struct traj_seg *next = traj_cseg(tj, t + 1);
        if (next->join == JOIN_REST || next->join == JOIN_KINK || next->end != TRAJ_BLEND || t - c >= SPREAD)
            return g->s1 - next->zone - traj_cseg(tj, c)->s0;
    }
}

static double reach_left(const struct traj *tj, uint32_t c)
{
    const struct traj_seg *at = traj_cseg(tj, c);
    double room = at->s0 - tj->cut_s;

    for (uint32_t t = c - 1;; t--) {
        const struct traj_seg *g = traj_cseg(tj, t);
        if (g->end != TRAJ_BLEND) return fmin(room, at->s0 - g->s1);
        if (g->prim.kind != PATH_LINE) return fmin(room, at->s0 - g->s1 + (t == c - 1 ? g->prim.len / 2 : 0));
        if (g->join == JOIN_REST || g->join == JOIN_KINK || t == tj->first || c - t >= SPREAD)
            return fmin(room, at->s0 - g->s0 - g->zone);
        if (at->s0 - g->s0 >= room) return room;
    }
}

/* If all junctions around c were rounded over +-w: curvature at c, sum of deviations there, sum of
 * bends. 1: the curvature leaves half of each axis's acceleration at the speed v. */
static int try_width(const struct traj *tj, uint32_t c, double w, double v, double *off, double *turn)
{
    const struct traj_seg *at = traj_cseg(tj, c);
    double k[4], curve[PATH_AXES];

    for (int i = 0; i < PATH_AXES; i++) curve[i] = at->du[i] * PATH_ROUND_CURVE;
    *off = at->bend * w * PATH_ROUND_PEAK;
    *turn = at->bend;
    for (int side = -1; side <= 1; side += 2) {
        for (uint32_t d = c + side; d != tj->end && (int32_t)(d - tj->first) > 0; d += side) {
            const struct traj_seg *q = traj_cseg(tj, d);
            double x = (q->s0 - at->s0) / w;
            if (fabs(x) >= 1) break;
            if (q->join != JOIN_ROUND) continue;
            path_round(x, 1, k);
            for (int i = 0; i < PATH_AXES; i++) curve[i] += q->du[i] * k[2];
            *off += q->bend * w * k[0];
            *turn += q->bend;
        }
    }
    for (int i = 0; i < PATH_AXES; i++)
        if (fabs(curve[i]) / w * v * v > axis_acc(tj, i, at) / 2) return 0;
    return 1;
}

/* Largest share of w that keeps the sum of deviations within the tolerance at every junction reached. */
static double fit_width(const struct traj *tj, uint32_t c, double w)
{
    const struct traj_seg *at = traj_cseg(tj, c);
    double k[4];

    w = fmin(w, (at->tol_join - at->off) / (PATH_ROUND_PEAK * at->bend));
    for (int n = 0; n < 24 && w > 0; n++) {
        int fits = 1;
        for (int side = -1; side <= 1 && fits; side += 2) {
            for (uint32_t d = c + side; d != tj->end && (int32_t)(d - tj->first) > 0; d += side) {
                const struct traj_seg *q = traj_cseg(tj, d);
                double x = (q->s0 - at->s0) / w;
                if (fabs(x) >= 1) break;
                if (q->join != JOIN_ROUND) continue;
                path_round(x, 1, k);
                if (q->off + at->bend * w * k[0] > q->tol_join) {
                    fits = 0;
                    break;
                }
            }
        }
        if (fits) break;
        w *= 0.8;
    }
    return w > 0 ? w : 0;
}

/* Enters the rounding of junction c into the moves that it reaches. */
static void spread_rounding(struct traj *tj, uint32_t c)
{
    struct traj_seg *at = traj_seg(tj, c);
    double reach = at->w > at->zone ? at->w : at->zone, k[4];

    for (uint32_t t = c; t != tj->end && (t == c || traj_seg(tj, t)->s0 - at->s0 < reach); t++) {
        struct traj_seg *g = traj_seg(tj, t);
        if ((int32_t)(g->hi - g->lo) < 0) g->lo = c;
        g->hi = c;
        if (at->w > 0) {
            path_round(fmin(1, (g->s0 - at->s0) / at->w), 1, k);
            g->off += at->bend * at->w * k[0];
        }
    }
    for (uint32_t t = c - 1;; t--) {
        struct traj_seg *g = traj_seg(tj, t);
        if (at->s0 - g->s1 >= reach) break;
        if ((int32_t)(g->hi - g->lo) < 0) g->lo = c;
        g->hi = c;
        if (at->w > 0) {
            path_round(fmax(-1, (g->s0 - at->s0) / at->w), 1, k);
            g->off += at->bend * at->w * k[0];
        }
        if (t == tj->first) break;
    }
}

/* Decides the width of the rounding at junction c. 0: more of the path must be known first. */
static int finish_join(struct traj *tj, uint32_t c)
{
    struct traj_seg *g = traj_seg(tj, c);
    const struct traj_seg *prev = traj_cseg(tj, c - 1);
    double v, half, needed = 0, left, right, w, off, turn;
    int open;

    if (g->join == JOIN_KINK) spread_rounding(tj, c);
    if (g->join != JOIN_ROUND) return 1;
    v = fmax(planned_speed(tj, prev), planned_speed(tj, g));
    left = reach_left(tj, c);
    right = reach_right(tj, c, &open);
    /* Alone: by tolerance, by half the neighbours, and no wider than the speed asks for. */
    half = fmin(fmin(prev->prim.len, g->prim.len) / 2, fmin(left, right));
    for (int i = 0; i < PATH_AXES; i++) {
        double a = fmin(axis_acc(tj, i, g), axis_acc(tj, i, prev));
        needed = fmax(needed, 2 * PATH_ROUND_CURVE * fabs(g->du[i]) * v * v / a);
    }
    w = fmin(fmin(half, needed), g->tol_join / (PATH_ROUND_PEAK * g->bend));
    g->solo = 1;
    if (w >= half) {
        /* Short moves: smooth over several, as far as tolerance allows and speed asks for. */
        double limit = fmin(left, right);
        int enough = try_width(tj, c, w, v, &off, &turn);
        while (!enough && w < limit && off < TOL_SHARE * g->tol_join) {
            double wider = fmin(w * GROW, limit);
            enough = try_width(tj, c, wider, v, &off, &turn);
            if (turn > TURN_LIMIT) break;
            if (off > TOL_SHARE * g->tol_join) {
                wider = fmax(w, wider * sqrt(TOL_SHARE * g->tol_join / off));
                enough = 1;
            }
            w = wider;
        }
        if (!enough && open && w >= limit && right <= left && turn <= TURN_LIMIT) return 0;
    }
    w = fit_width(tj, c, w);
    if (w < 1e-7) {
        join_kink(tj, prev, g, g->s0 - tj->cut_s);
        if (g->join == JOIN_KINK) spread_rounding(tj, c);
        return 1;
    }
    g->w = w;
    g->solo = w <= half * (1 + 1e-9) && g->off == 0;
    spread_rounding(tj, c);
    return 1;
}

/* Length of path before an unfinished junction that its rounding may take. */
static double join_reserve(const struct traj *tj, uint32_t c)
{
    const struct traj_seg *g = traj_cseg(tj, c), *prev = traj_cseg(tj, c - 1);
    double most = g->tol_join / (PATH_ROUND_PEAK * g->bend), last = prev->join == JOIN_ROUND ? prev->w : 0;

    return fmin(most, fmax(GROW * last, 4 * fmin(prev->prim.len, g->prim.len)));
}

static void finish_joins(struct traj *tj)
{
    for (int n = 0; n < JOIN_BUDGET && tj->fin != tj->end; n++) {
        if (tj->fin != tj->first && !finish_join(tj, tj->fin)) break;
        tj->fin++;
    }
}

/* Moves on the end of the final path. */
static void update_final(struct traj *tj)
{
    const struct traj_seg *last = traj_cseg(tj, tj->end - 1);
    double s;

    if (tj->fin != tj->end) {
        const struct traj_seg *g = traj_cseg(tj, tj->fin);
        s = tj->fin == tj->first ? g->s0 : g->s0 - fmax(join_reserve(tj, tj->fin), g->zone);
    } else {
        s = tj->tail_forced ? last->s1 : last->s1 - tail_reserve(tj, last);
    }
    if (s > tj->s_final) tj->s_final = s;
}

int64_t traj_append(struct traj *tj, const struct traj_move *move)
{
    if (tj->end - tj->first >= TRAJ_SEGS - 1) return -1;
    uint32_t index = tj->end;
    struct traj_seg *g = traj_seg(tj, index);

    g->prim = move->prim;
    g->s0 = index == tj->first ? tj->s : traj_cseg(tj, index - 1)->s1;
    g->s1 = g->s0 + move->prim.len;
    g->feed = move->feed;
    g->vmax = move->vmax;
    g->mark = move->mark;
    g->stretch = g->mark ? 1 : move->prim.len / fmax(move->prim.feed_len, 1e-300);
    g->acc = move->acc * g->stretch;
    g->jerk = move->jerk * g->stretch;
    g->tol = move->tol;
    g->end = move->end;
    g->follow = move->follow;
    g->released = 0;
    g->w = g->zone = g->kink_b = g->bend = g->off = 0;
    g->solo = 1;
    g->tol_join = 0;
    g->lo = index + 1;
    g->hi = index;
    if (index == tj->first) {
        memset(g->du, 0, sizeof g->du);
        memset(g->dk, 0, sizeof g->dk);
        join_rest(tj, g);
    } else {
        make_join(tj, index, move->rest_before || move->mark || traj_cseg(tj, index - 1)->mark);
    }
    tj->end++;
    tj->tail_forced = 0;
    tj->hungry = 0;
    return index;
}

/* ---- rounded path ----------------------------------------------------------- */

/* Largest distance from the junction at which its rounding or zone acts. */
static double reach(const struct traj_seg *g)
{
    return g->w > g->zone ? g->w : g->zone;
}

/* The move that contains s, searched from `from`. */
static uint32_t seg_of(const struct traj *tj, uint32_t from, double s)
{
    while (from != tj->first && s < traj_cseg(tj, from)->s0) from--;
    while (from + 1 != tj->end && s >= traj_cseg(tj, from)->s1) from++;
    return from;
}

static void add_round(const struct traj_seg *g, double s, int side, struct path_jet *jet)
{
    double k[4], w = g->w;

    path_round((s - g->s0) / w, side, k);
    for (int i = 0; i < PATH_AXES; i++) {
        jet->p[i] += g->du[i] * w * k[0];
        jet->d1[i] += g->du[i] * k[1];
        jet->d2[i] += g->du[i] * (k[2] / w);
        jet->d3[i] += g->du[i] * (k[3] / (w * w));
    }
}

/* Position and derivatives of the rounded path at s in move g. */
static void rounded_jet(const struct traj *tj, uint32_t index, double s, struct path_jet *jet)
{
    const struct traj_seg *g = traj_cseg(tj, index);

    path_jet_at(&g->prim, s - g->s0, jet);
    for (uint32_t j = g->lo; (int32_t)(g->hi - j) >= 0; j++) {
        const struct traj_seg *q = traj_cseg(tj, j);
        if (fabs(s - q->s0) < q->w) add_round(q, s, (int32_t)(index - j) >= 0 ? 1 : -1, jet);
    }
}

void traj_pose(const struct traj *tj, double s, double p[PATH_AXES])
{
    const struct traj_seg *g;
    double k[4];

    if (tj->end == tj->first) {
        memcpy(p, tj->pos, sizeof tj->pos);
        return;
    }
    uint32_t index = seg_of(tj, tj->cur, s);
    g = traj_cseg(tj, index);
    if (s >= g->s1) memcpy(p, g->prim.end, sizeof g->prim.end);
    else path_at(&g->prim, s - g->s0, p);
    for (uint32_t j = g->lo; (int32_t)(g->hi - j) >= 0; j++) {
        const struct traj_seg *q = traj_cseg(tj, j);
        if (!(fabs(s - q->s0) < q->w)) continue;
        path_round((s - q->s0) / q->w, (int32_t)(index - j) >= 0 ? 1 : -1, k);
        for (int i = 0; i < PATH_AXES; i++) p[i] += q->du[i] * q->w * k[0];
    }
}

/* ---- cells ------------------------------------------------------------------- */

/* Speed that a move allows in its metric: feed, override, limit of speed. */
static double feed_of(const struct traj *tj, uint32_t index, double scale, double vlimit)
{
    const struct traj_seg *g = traj_cseg(tj, index);
    double v = g->vmax;

    if (g->follow == TRAJ_FEED) v = fmin(v, g->feed * fmin(scale, fmax(tj->drive.max_scale, 1)));
    if (g->follow != TRAJ_SYNC_POSITION && g->prim.metric != PATH_ABC) v = fmin(v, vlimit);
    return v;
}

/* Cap of b by the same. */
static double feed_b(const struct traj *tj, const struct traj_cell *c, double scale, double vlimit)
{
    if (c->metric < 1e-12) return 1e30;
    double v = feed_of(tj, c->seg, scale, vlimit);
    if (c->seg2 != c->seg) v = fmax(v, feed_of(tj, c->seg2, scale, vlimit));
    v /= c->metric;
    return v * v;
}

/* Range of f on a cell from its values at both ends and the middle, f being nearly quadratic. */
static void range3(double a, double m, double c, double more, double *lo, double *hi)
{
    more += fabs(a - 2 * m + c) / 8;
    *lo = fmin(a, fmin(m, c)) - more;
    *hi = fmax(a, fmax(m, c)) + more;
}

/* Sum of the jumps of d3p/ds3 inside the cell: there d2p/ds2 has corners. */
static void slope_jumps(const struct traj *tj, const struct traj_cell *c, double jump[PATH_AXES])
{
    double a = c->s0, e = c->s0 + c->len, tiny = 1e-9 * c->len;
    uint32_t done = c->seg - TRAJ_SEGS; /* junctions up to here were counted */

    for (uint32_t t = c->seg; t != tj->end && traj_cseg(tj, t)->s0 < e; t++) {
        const struct traj_seg *g = traj_cseg(tj, t);
        for (uint32_t j = g->lo; (int32_t)(g->hi - j) >= 0; j++) {
            const struct traj_seg *q = traj_cseg(tj, j);
            if ((int32_t)(j - done) <= 0 || q->w <= 0) continue;
            done = j;
            double lo = q->s0 - q->w, hi = q->s0 + q->w;
            int n = (lo > a + tiny && lo < e - tiny) + (hi > a + tiny && hi < e - tiny);
            for (int i = 0; n > 0 && i < PATH_AXES; i++) jump[i] += n * 1.5 * fabs(q->du[i]) / (q->w * q->w);
        }
    }
}

/* Lines through the values f at b = 0, cap / 2, cap. */
static void chords(struct traj_line line[2], const double f[3], double cap)
{
    for (int n = 0; n < 2; n++) {
        double from = fmax(f[n], 0), to = fmax(f[n + 1], 0);
        line[n].c2 = fmax(0, (from - to) / (cap / 2));
        line[n].c1 = from + line[n].c2 * cap * n / 2;
    }
}

/* Bounds of motion on the cell from the axes' limits and the path's derivatives. Returns how much
 * of the acceleration is lost because the curvature changes along the cell. */
static double bound_cell(struct traj *tj, struct traj_cell *c, int rounded, int arc, double share, double cap)
{
    struct path_jet ja, jm, jc;
    const struct traj_seg *g = traj_cseg(tj, c->seg);
    double eps = c->len * 1e-7, lo1[PATH_AXES], hi1[PATH_AXES], lo2[PATH_AXES], hi2[PATH_AXES], acc[PATH_AXES], spread = 0;
    int group = g->prim.metric == PATH_XYZ ? PATH_X : g->prim.metric == PATH_UVW ? PATH_U : PATH_A;
    double ma = 0, mm = 0, mc = 0, edges[PATH_AXES] = { 0 }, least, most;

    if (rounded) slope_jumps(tj, c, edges);
    rounded_jet(tj, c->seg, c->s0 + eps, &ja);
    rounded_jet(tj, seg_of(tj, c->seg, c->s0 + c->len / 2), c->s0 + c->len / 2, &jm);
    rounded_jet(tj, seg_of(tj, c->seg, c->s0 + c->len - eps), c->s0 + c->len - eps, &jc);

    for (int i = 0; i < PATH_AXES; i++) {
        double reserve = arc && !rounded ? ARC_CAP : ROUND_CAP, q1, q2;
        range3(ja.d1[i], jm.d1[i], jc.d1[i], 0, &lo1[i], &hi1[i]);
        range3(ja.d2[i], jm.d2[i], jc.d2[i], edges[i] * c->len / 8, &lo2[i], &hi2[i]);
        acc[i] = share * axis_acc(tj, i, g);
        q1 = fmax(hi1[i], -lo1[i]);
        q2 = fmax(hi2[i], -lo2[i]);
        if (q1 > 1e-12 && tj->lim.v[i] > 0) cap = fmin(cap, tj->lim.v[i] * tj->lim.v[i] / (q1 * q1));
        if (q2 > 0) cap = fmin(cap, reserve * acc[i] / q2);
    }
    for (int i = group; i < group + 3; i++) {
        ma += ja.d1[i] * ja.d1[i];
        mm += jm.d1[i] * jm.d1[i];
        mc += jc.d1[i] * jc.d1[i];
    }
    range3(sqrt(ma), sqrt(mm), sqrt(mc), 0, &least, &most);
    c->metric = most;
    if (rounded && c->metric * g->stretch > 2) {
        /* The feed of a move that hardly moves in its metric must not hold up a neighbour's. */
        uint32_t other = c->s0 + c->len / 2 > (g->s0 + g->s1) / 2 ? c->seg + 1 : c->seg - 1;
        if ((int32_t)(other - tj->first) >= 0 && (int32_t)(tj->end - other) > 0 &&
            traj_cseg(tj, other)->prim.metric == g->prim.metric)
            c->seg2 = other;
    }
    cap = fmin(cap, 1e12);
    c->cap = cap;

    /* Rows |q1 u + q2 b| <= A for all q1, q2 in their ranges, and |q1 u| <= A. With u of one sign
     * they are bounds of u that are concave in b: two chords over [0, cap] lie inside. */
    double up[3], down[3];
    for (int n = 0; n < 3; n++) {
        double b = cap * n / 2;
        up[n] = down[n] = share * g->acc;
        for (int i = 0; i < PATH_AXES; i++) {
            double top = fmin(acc[i], acc[i] - hi2[i] * b), bottom = fmin(acc[i], acc[i] + lo2[i] * b);
            if (hi1[i] > 1e-12) {
                up[n] = fmin(up[n], top / hi1[i]);
                down[n] = fmin(down[n], bottom / hi1[i]);
            }
            if (lo1[i] < -1e-12) {
                up[n] = fmin(up[n], bottom / -lo1[i]);
                down[n] = fmin(down[n], top / -lo1[i]);
            }
        }
    }
    chords(c->up, up, cap);
    chords(c->down, down, cap);

    /* What the ranges of curvature cost, as a share of acceleration, if acceleration limits the speed. */
    for (int i = 0; i < PATH_AXES; i++)
        if (hi2[i] > lo2[i]) spread = fmax(spread, (hi2[i] - lo2[i]) * cap / acc[i]);
    return cap < feed_b(tj, c, tj->drive.max_scale, 1e99) ? spread : 0;
}

/* A cell that would end within rounding of a move's end, ends there: both are compared with s. */
static double snap_end(const struct traj *tj, double end, double tiny)
{
    for (uint32_t t = tj->cut_seg; t != tj->end && traj_cseg(tj, t)->s1 <= end + tiny; t++)
        if (traj_cseg(tj, t)->s1 >= end - tiny) return traj_cseg(tj, t)->s1;
    return end;
}

/* Makes the next cell of the final path. 0: nothing to do. */
static int cut_cell(struct traj *tj)
{
    double a = tj->cut_s, tiny = 1e-12 * (1 + a), step = 1e30, end, share = 1, cap = 1e12;
    int rounded = 0, arc;
    uint32_t j;

    if (tj->s_final - a <= tiny || tj->cell_end - tj->cell_first >= TRAJ_CELLS - 1) return 0;
    while (tj->cut_seg + 1 != tj->end && a >= traj_seg(tj, tj->cut_seg)->s1 - tiny) tj->cut_seg++;
    const struct traj_seg *g = traj_seg(tj, tj->cut_seg);
    end = tj->s_final;

    /* Roundings and zones: a lone one begins and ends cells at its edges; all are cut in parts. Where
     * they overlap only the parts are cut, and bound_cell() allows for the edges within. */
    for (uint32_t t = tj->cut_seg; t != tj->end && traj_seg(tj, t)->s0 < end && traj_seg(tj, t)->s0 < a + step; t++) {
        const struct traj_seg *on = traj_seg(tj, t);
        for (uint32_t j = on->lo; (int32_t)(on->hi - j) >= 0; j++) {
            const struct traj_seg *q = traj_seg(tj, j);
            double lo = q->s0 - reach(q), hi = q->s0 + reach(q);
            if (reach(q) <= 0 || hi <= a + tiny || lo >= end) continue;
            if (lo > a + tiny) {
                if (q->solo || !rounded) end = fmin(end, lo);
                else if (q->w > 0) step = fmin(step, fmax(lo - a, q->w / 4));
                continue;
            }
            if (q->solo) end = fmin(end, hi);
            if (q->w > 0) {
                rounded = 1;
                step = fmin(step, q->w / 4);
            } else {
                share = KINK_SHARE;
                cap = fmin(cap, q->kink_b);
            }
        }
        if (t - tj->cut_seg >= CELL_MOVES) break;
    }
    /* Ends of moves where the bounds or the feed change. */
    for (j = tj->cut_seg + 1; j != tj->end; j++) {
        const struct traj_seg *q = traj_seg(tj, j);
        if (q->s0 >= end) break;
        if (q->cut || j - tj->cut_seg >= CELL_MOVES) {
            end = fmin(end, q->s0);
            break;
        }
    }
    arc = g->prim.kind == PATH_ARC;
    if (arc) {
        double angle = fmax(ARC_STEP, g->prim.angle / 64);
        step = fmin(step, angle * g->prim.len / g->prim.angle);
    }
    if (end - a > 1.25 * step) end = a + step;
    end = snap_end(tj, end, tiny);

    struct traj_cell *c = cell_at(tj, tj->cell_end);
    c->s0 = a;
    c->len = end - a;
    c->seg = c->seg2 = tj->cut_seg;
    c->rest = g->join == JOIN_REST && a <= g->s0 + tiny;
    c->k = 0;
    c->kr = 0;
    if (tj->cell_end - tj->cell_first >= CELLS_CYCLE) {
        double v = (end - cell_at(tj, tj->cell_end - CELLS_CYCLE + 1)->s0) / tj->dt;
        cap = fmin(cap, v * v);
    }
    for (int n = 0; bound_cell(tj, c, rounded, arc, share, cap) > SPLIT && rounded && n < SPLITS; n++) {
        c->len /= 2;
        end = a + c->len;
    }
    tj->cut_s = end;
    tj->cell_end++;
    return 1;
}

/* ---- envelope ---------------------------------------------------------------- */

/* Highest b at distance d before a boundary that must be passed with at most b_end (line: bound of
 * braking), or at distance d after one passed with b_end (line: bound of speeding up). */
static double ramp_b(const struct traj_line line[2], double b_end, double d)
{
    double p = (b_end + 2 * d * line[0].c1) / (1 + 2 * d * line[0].c2);
    double q = (b_end + 2 * d * line[1].c1) / (1 + 2 * d * line[1].c2);
    return p < q ? p : q;
}

static void sweep_envelope(struct traj *tj)
{
    double scale = tj->drive.scale;

    /* A hold aims at rest by itself; the envelope stays. */
    if (scale < 1e-9) scale = tj->sweep_scale;
    if (!tj->sweeping) {
        int changed = scale != tj->sweep_scale || tj->drive.vlimit != tj->sweep_vlimit || tj->sweep_anew;
        if (!changed && tj->swept_end == tj->cell_end) return;
        if (tj->cell_end == tj->cell_first) return;
        tj->sweeping = 1;
        tj->sweep_full = changed;
        tj->sweep_anew = 0;
        tj->sweep_scale = scale;
        tj->sweep_vlimit = tj->drive.vlimit;
        tj->swept_end = tj->cell_end;
        tj->sweep = tj->cell_end - 1;
    }
    for (int n = 0; n < SWEEP_BUDGET; n++) {
        struct traj_cell *c = cell_at(tj, tj->sweep);
        double k = 0;
        if (!c->rest) {
            double ahead = tj->sweep + 1 == tj->swept_end ? 0 : cell_at(tj, tj->sweep + 1)->k;
            k = fmin(ramp_b(c->down, ahead, c->len), c->cap);
            k = fmin(k, feed_b(tj, c, tj->sweep_scale, tj->sweep_vlimit));
        }
        int same = fabs(k - c->k) <= 1e-12 * k;
        c->k = k;
        if ((same && !tj->sweep_full && tj->sweep + 1 != tj->swept_end) || tj->sweep == tj->cell ||
            tj->sweep == tj->cell_first) {
            tj->sweeping = 0;
            return;
        }
        tj->sweep--;
    }
}

/* ---- execution ---------------------------------------------------------------- */

static double clamp_b(const struct traj_cell *c, double b)
{
    return b < c->cap ? b : c->cap;
}

/* Bounds of braking and of speeding up in the direction of motion. */
static const struct traj_line *brakes(const struct traj *tj, const struct traj_cell *c)
{
    return tj->dir > 0 ? c->down : c->up;
}

static const struct traj_line *speeds(const struct traj *tj, const struct traj_cell *c)
{
    return tj->dir > 0 ? c->up : c->down;
}

/* Acceleration allowed at b. */
static double allowed(const struct traj_line line[2], double b)
{
    double p = line[0].c1 - line[0].c2 * b, q = line[1].c1 - line[1].c2 * b;
    double f = p < q ? p : q;
    return f > 0 ? f : 0;
}

/* Highest speed after accelerating for t from v: v' = v + t (c1 - c2 v'^2). */
static double accelerated(const struct traj_line line[2], double v, double t)
{
    double best = 1e30;
    for (int n = 0; n < 2; n++) {
        double top = v + line[n].c1 * t, k = line[n].c2 * t;
        double r = 2 * top / (1 + sqrt(1 + 4 * k * top));
        if (r < best) best = r;
    }
    return best;
}

/* Highest speed in [lo, hi] after t such that the boundary at distance d can still be met with b_end. */
static double braked(const struct traj_cell *c, const struct traj_line brake[2], double b_end, double d, double v, double t, double lo, double hi)
{
    if ((v + hi) * t / 2 > d) hi = 2 * d / t - v;
    if (hi <= lo) return lo;
    if (hi * hi <= clamp_b(c, ramp_b(brake, b_end, d - (v + hi) * t / 2))) return hi;
    for (int n = 0; n < 24; n++) {
        double mid = (lo + hi) / 2;
        if (mid * mid <= clamp_b(c, ramp_b(brake, b_end, d - (v + mid) * t / 2))) lo = mid;
        else hi = mid;
    }
    return lo;
}

/* Moves on the counter of started moves to place s, which motion has just reached. */
static void pass_moves(struct traj *tj)
{
    if (tj->dir > 0) {
        while (tj->cur + 1 != tj->end && tj->s >= traj_cseg(tj, tj->cur)->s1 &&
               traj_cseg(tj, tj->cur + 1)->join != JOIN_REST)
            tj->cur++;
    } else {
        while (tj->cur != tj->first && tj->s <= traj_cseg(tj, tj->cur)->s0) tj->cur--;
    }
}

/* At rest before a move that needs a release? */
static void check_gate(struct traj *tj)
{
    const struct traj_seg *g = traj_cseg(tj, tj->cur);

    tj->waiting = 0;
    if (tj->dir < 0 || tj->in_mark || tj->v > 0) return;
    if (tj->cur == tj->first && tj->s == g->s0 && !g->released && g->join == JOIN_REST) {
        tj->waiting = 1;
        return;
    }
    if (tj->s < g->s1 || tj->cur + 1 == tj->end) return;
    if (traj_cseg(tj, tj->cur + 1)->join == JOIN_REST) tj->waiting = 1;
}

/* Goes on to the next cell in the direction of motion. 0: motion ends here for this cycle. */
static int next_cell(struct traj *tj)
{
    if (tj->dir > 0) {
        uint32_t next = tj->cell + 1;
        if (next == tj->cell_end) {
            tj->v = 0;
            return 0;
        }
        if (cell_at(tj, next)->rest) {
            tj->v = 0;
            /* a move that was released has become the current one */
            if (tj->cur != cell_at(tj, next)->seg) return 0;
        }
        tj->cell = next;
        tj->s = cell_at(tj, next)->s0;
    } else {
        if (tj->cell == tj->cell_first) {
            tj->v = 0;
            return 0;
        }
        int rest = cell_at(tj, tj->cell)->rest;
        tj->cell--;
        if (rest) {
            tj->v = 0;
            return 0;
        }
    }
    return 1;
}

/* b allowed at the end of the present cell (in the direction of motion) such that motion can rest
 * at stop_s; *d is shortened when the place lies in this cell. Negative: nothing to stop for. */
static double stop_b(const struct traj *tj, double *d)
{
    double stop = tj->drive.stop_s, b = 0;
    uint32_t index = tj->cell;
    const struct traj_cell *c = &tj->cells[index & (TRAJ_CELLS - 1)];

    if (isnan(stop) || (stop - tj->s) * tj->dir < 0) return -1;
    if ((stop - tj->s) * tj->dir <= *d) {
        *d = fabs(stop - tj->s);
        return 0;
    }
    for (int n = 0; n < STOP_SCAN; n++) {
        uint32_t next = tj->dir > 0 ? index + 1 : index - 1;
        if (tj->dir > 0 ? next == tj->cell_end : index == tj->cell_first) break;
        index = next;
        c = &tj->cells[index & (TRAJ_CELLS - 1)];
        if (tj->dir > 0 ? c->s0 + c->len >= stop : c->s0 <= stop) {
            double part = tj->dir > 0 ? stop - c->s0 : c->s0 + c->len - stop;
            b = fmin(c->cap, ramp_b(brakes(tj, c), 0, part));
            index = tj->dir > 0 ? index - 1 : index + 1;
            break;
        }
    }
    while (index != tj->cell) {
        c = &tj->cells[index & (TRAJ_CELLS - 1)];
        b = fmin(c->cap, ramp_b(brakes(tj, c), b, c->len));
        index = tj->dir > 0 ? index - 1 : index + 1;
    }
    return b;
}

/* Speed aimed at in a cell. */
static double target_speed(const struct traj *tj, const struct traj_cell *c)
{
    const struct traj_seg *g = traj_cseg(tj, c->seg);
    double b;

    if (tj->drive.hold) return 0;
    b = feed_b(tj, c, tj->drive.scale, tj->drive.vlimit);
    if (g->follow != TRAJ_FEED) {
        double v = tj->drive.sync_speed * (g->follow == TRAJ_SYNC_SPEED ? tj->drive.scale : 1);
        v = c->metric > 1e-12 ? v / c->metric : 0;
        b = fmin(b, v * v);
    }
    return sqrt(clamp_b(c, b));
}

static void step_path(struct traj *tj)
{
    double left = tj->dt, v_before = tj->v;

    for (int n = 0; n < PORTIONS && left > 1e-9 * tj->dt; n++) {
        struct traj_cell *c = cell_at(tj, tj->cell);
        double end = tj->dir > 0 ? c->s0 + c->len : c->s0;
        double d = tj->dir > 0 ? end - tj->s : tj->s - end;
        tj->n_portions++;
        if (d <= 0) {
            if (!next_cell(tj)) break;
            continue;
        }
        double b_end, v = tj->v, b = v * v, vt = target_speed(tj, c), ve2, t = left, x;
        if (tj->dir > 0) b_end = tj->cell + 1 == tj->cell_end ? 0 : cell_at(tj, tj->cell + 1)->k;
        else b_end = tj->cell == tj->cell_first ? 0 : c->kr;
        if (vt <= 0 && v <= 0) break;
        double d_stop = d, b_stop = stop_b(tj, &d_stop);
        if (b_stop >= 0 && b <= ramp_b(brakes(tj, c), b_stop, d_stop) * (1 + 1e-9)) {
            if (d_stop <= 0) { /* arrived */
                tj->v = 0;
                break;
            }
            if (d_stop < d) {
                d = d_stop;
                end = tj->drive.stop_s;
                b_end = 0;
            } else {
                b_end = fmin(b_end, b_stop);
            }
        }
        double brake = allowed(brakes(tj, c), b), low2 = fmax(0, b - 2 * brake * d);

        if (v > vt) { /* too fast: brake to vt */
            double tv = brake > 0 ? (v - vt) / brake : 1e30;
            double xv = (v + vt) / 2 * tv;
            if (tv <= left && xv < d) {
                tj->s += tj->dir * xv;
                tj->v = vt;
                left -= tv;
                continue;
            }
            ve2 = xv < d ? -1 : low2;
        } else {
            ve2 = fmax(low2, fmin(fmin(ramp_b(speeds(tj, c), b, d), vt * vt), b_end));
        }
        if (ve2 >= 0) { /* reach the boundary within the cycle? */
            double ve = sqrt(ve2), te = v + ve > 0 ? 2 * d / (v + ve) : 1e30;
            if (te <= left) {
                tj->s = end;
                tj->v = ve;
                left -= te;
                continue;
            }
        }
        double lo = v - brake * t, hi;
        if (lo < 0) lo = 0;
        hi = v > vt ? fmax(lo, vt) : fmin(accelerated(speeds(tj, c), v, t), vt);
        double v1 = braked(c, brakes(tj, c), b_end, d, v, t, lo, hi);
        x = (v + v1) * t / 2;
        if (v1 <= 0 && brake > 0 && v / brake < t) x = b / (2 * brake); /* comes to rest within t */
        if (x > d) x = d;
        tj->s += tj->dir * x;
        tj->v = v1;
        left = 0;
    }
    tj->acc = (tj->v - v_before) / tj->dt;
}

/* Distance in which the tail must be made final: stopping distance and some time in hand. */
static double tail_guard(const struct traj *tj)
{
    const struct traj_seg *g = traj_cseg(tj, tj->cur);
    double v = tj->v + g->acc * 10 * tj->dt;
    return 1.5 * v * v / (2 * g->acc) + v * GUARD_TIME;
}

static void work(struct traj *tj)
{
    if (tj->end == tj->first) return;
    const struct traj_seg *last = traj_cseg(tj, tj->end - 1);
    if (tj->hungry < HUNGRY) tj->hungry++;
    else if (!tj->tail_forced && tj->s_final < last->s1 && tj->dir > 0 && tj->s_final - tj->s < tail_guard(tj)) {
        tj->tail_forced = 1;
        tj->n_forced++;
    }
    finish_joins(tj);
    update_final(tj);
    for (int n = 0; n < CUT_BUDGET && cut_cell(tj); n++) {}
    sweep_envelope(tj);
}

/* Forgets executed moves beyond the history. */
static void retire(struct traj *tj)
{
    pass_moves(tj);
    while (tj->cur - tj->first > TRAJ_HISTORY) tj->first++;
    while (tj->cell_first != tj->cell) {
        const struct traj_cell *second = cell_at(tj, tj->cell_first + 1);
        int old = second->s0 <= traj_seg(tj, tj->first)->s0;
        int tight = tj->cell_end - tj->cell_first > TRAJ_CELLS - 256 && tj->cell - tj->cell_first > 1;
        if (!old && !tight) break;
        tj->cell_first++;
    }
}

/* Envelope for running backward: from the oldest cell to the present one. 1: complete. */
static int sweep_back(struct traj *tj)
{
    double scale = tj->drive.scale < 1e-9 ? tj->back_scale : tj->drive.scale;

    if (scale != tj->back_scale && (int32_t)(tj->back_sweep - tj->cell) >= 0) {
        tj->back_scale = scale;
        tj->back_sweep = tj->cell_first;
    }
    scale = tj->back_scale;
    for (int n = 0; n < SWEEP_BUDGET; n++) {
        if ((int32_t)(tj->back_sweep - tj->cell) >= 0) return 1;
        const struct traj_cell *c = cell_at(tj, tj->back_sweep);
        struct traj_cell *next = cell_at(tj, tj->back_sweep + 1);
        double kr = tj->back_sweep == tj->cell_first || c->rest ? 0 : c->kr;
        kr = fmin(fmin(ramp_b(c->up, kr, c->len), c->cap), feed_b(tj, c, scale, tj->drive.vlimit));
        next->kr = next->rest ? 0 : kr;
        tj->back_sweep++;
    }
    return 0;
}

/* Takes over the direction asked for, at rest. */
static void set_direction(struct traj *tj)
{
    int dir = tj->drive.reverse ? -1 : 1;

    if (dir == tj->dir || tj->v > 0 || tj->in_mark) return;
    tj->dir = dir;
    tj->waiting = 0;
    if (dir < 0) {
        tj->back_sweep = tj->cell_first;
        tj->back_scale = tj->drive.scale;
    } else {
        tj->sweeping = 0;
        tj->sweep_anew = 1;
    }
}

void traj_cycle(struct traj *tj)
{
    tj->acc = 0;
    if (tj->end == tj->first) return;
    set_direction(tj);
    work(tj);
    if (tj->cell_end != tj->cell_first && !tj->in_mark) {
        check_gate(tj);
        /* Backward, motion begins when its envelope is complete; a later sweep only changes feeds. */
        if (!tj->waiting && (tj->dir > 0 || sweep_back(tj) || tj->v > 0)) step_path(tj);
    }
    retire(tj);
    if (tj->cell_end != tj->cell_first || traj_cseg(tj, tj->cur)->mark) check_gate(tj);
    traj_pose(tj, tj->s, tj->pos);
}

int64_t traj_waiting(const struct traj *tj)
{
    if (!tj->waiting) return -1;
    return tj->cur == tj->first && !traj_cseg(tj, tj->cur)->released ? tj->cur : tj->cur + 1;
}

void traj_release(struct traj *tj)
{
    if (!tj->waiting) return;
    tj->cur = (uint32_t)traj_waiting(tj);
    struct traj_seg *g = traj_seg(tj, tj->cur);
    g->released = 1;
    tj->waiting = 0;
    tj->in_mark = g->mark;
}

void traj_finish(struct traj *tj)
{
    tj->in_mark = 0;
}

int traj_at_rest(const struct traj *tj)
{
    return tj->v <= 0;
}

int traj_done(const struct traj *tj)
{
    if (tj->end == tj->first) return 1;
    return tj->v <= 0 && tj->dir > 0 && !tj->in_mark && !tj->waiting && tj->cur + 1 == tj->end &&
           tj->s >= traj_cseg(tj, tj->end - 1)->s1;
}

int traj_active(const struct traj *tj)
{
    if (tj->end == tj->first) return 0;
    const struct traj_seg *g = traj_cseg(tj, tj->cur);
    for (uint32_t j = g->lo; (int32_t)(g->hi - j) >= 0; j++)
        if (fabs(tj->s - traj_cseg(tj, j)->s0) < traj_cseg(tj, j)->w) return 2;
    return 1;
}

double traj_lag(const struct traj *tj)
{
    (void)tj;
    return 0;
}
