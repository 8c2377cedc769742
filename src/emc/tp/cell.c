/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * cell.c - pieces of the path with bounds of motion, and the envelope over them.
 * See traj.h; derivations in docs/planner.md.
 */
#include <math.h>
#include <string.h>

#include "traj_priv.h"

#define CUT_BUDGET 32      /* cells made in a cycle, */
#define SAMPLE_BUDGET 12   /* and samples of the joints taken for them, */
#define RIPEN_BUDGET 1024  /* pieces looked at to make cells, */
#define SWEEP_BUDGET 512   /* and by the envelope */
#define RIPEN_PARTS 32     /* most cells made of a piece */
#define RIPEN_GRADE 0.25   /* growth of cells away from the ends of a piece */
#define SPLIT 0.15         /* share of acceleration that a cell may lose to changing curvature; */
#define LOSS_SHARE 0.6     /* of acceleration in use, before that counts */
#define ROUND_PARTS 2      /* pieces of half a rounding, before they are halved */
#define SPLITS 4           /* it is halved up to so many times */
#define KIN_SPLITS 6       /* and where joints are sampled */
#define KIN_STEP 16.0      /* units, deg: longest cell there */
#define CELLS_CYCLE 40     /* the speed is capped so that so many cells in a row last a cycle */
#define CELL_MOVES 64      /* moves that one cell may span; less than TRAJ_HISTORY */
#define ARC_CAP 0.97       /* share of acceleration that a curve at constant speed may use on arcs, */
#define ROUND_CAP 0.995    /* and in roundings: the rest leaves authority to brake */
#define ARC_STEP 0.1745    /* rad: longest cell on an arc of up to one turn */

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

double feed_b(const struct traj *tj, const struct traj_cell *c, double scale, double vlimit)
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

/* Corners of d2p/ds2 inside the cell: the sum of the jumps of d3p/ds3, and the largest one. */
struct corners {
    double sum[PATH_AXES], most[PATH_AXES];
};

static void find_corners(const struct traj *tj, const struct traj_cell *c, struct corners *at)
{
    static const double places[] = { -1, -0.75, 0.75, 1 }; /* of a junction's corners, in half widths */
    double a = c->s0, e = c->s0 + c->len, tiny = 1e-9 * c->len;
    uint32_t done = c->seg - TRAJ_SEGS; /* junctions up to here were counted */

    for (uint32_t t = c->seg; t != tj->end && traj_cseg(tj, t)->s0 < e; t++) {
        const struct traj_seg *g = traj_cseg(tj, t);
        for (uint32_t j = g->lo; (int32_t)(g->hi - j) >= 0; j++) {
            const struct traj_seg *q = traj_cseg(tj, j);
            if ((int32_t)(j - done) <= 0 || q->w <= 0) continue;
            done = j;
            int edges = 0, bends = 0;
            for (int n = 0; n < 4; n++) {
                double s = q->s0 + places[n] * q->w;
                if (s <= a + tiny || s >= e - tiny) continue;
                if (n == 0 || n == 3) edges++;
                if (q->curl > 0) bends++;
            }
            for (int i = 0; edges + bends > 0 && i < PATH_AXES; i++) {
                double round = edges ? PATH_ROUND_SLOPE * fabs(q->du[i]) / (q->w * q->w) : 0;
                double bend = bends ? 2 * PATH_BEND_SLOPE * fabs(q->dk[i]) / q->w : 0;
                at->sum[i] += edges * round + bends * bend;
                at->most[i] = fmax(at->most[i], round + bend);
            }
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

static void fill_row(struct traj_row *row, const double d1[3], const double d2[3],
                     const double d3[3], double corner, double edge, double more)
{
    range3(d1[0], d1[1], d1[2], more * fabs(d1[0] - 2 * d1[1] + d1[2]) / 8, &row->lo1, &row->hi1);
    range3(d2[0], d2[1], d2[2], corner + more * fabs(d2[0] - 2 * d2[1] + d2[2]) / 8, &row->lo2, &row->hi2);
    row->most3 = fmax(fabs(d3[0]), fmax(fabs(d3[1]), fabs(d3[2]))) + edge;
}

/* Rows of all axes and joints. at: the path at the cell's ends and middle. -1: joints have no solution. */
static int fill_rows(struct traj *tj, const struct traj_cell *c, const struct path_jet at[3],
                     const struct corners *corner, struct traj_row *rows, int *count)
{
    struct limits *lim = &tj->lim;
    const struct traj_seg *g = traj_cseg(tj, c->seg);
    int n = 0;

    for (int i = 0; i < PATH_AXES; i++, n++) {
        double d1[3], d2[3], d3[3];
        for (int k = 0; k < 3; k++) d1[k] = at[k].d1[i], d2[k] = at[k].d2[i], d3[k] = at[k].d3[i];
        fill_row(&rows[n], d1, d2, d3, corner->sum[i] * c->len / 8, corner->most[i], 0);
        rows[n].v = lim->v[i], rows[n].a = axis_acc(tj, i, g), rows[n].j = lim->j[i];
    }
    for (int r = 0; lim->kins == LIMITS_LINEAR && r < lim->rows; r++) {
        const struct limits_row *row = &lim->row[r];
        double d1[3] = { 0 }, d2[3] = { 0 }, d3[3] = { 0 }, sum = 0, most = 0;
        for (int i = 0; i < PATH_AXES; i++) {
            double m = row->m[i];
            if (m == 0) continue;
            for (int k = 0; k < 3; k++) d1[k] += m * at[k].d1[i], d2[k] += m * at[k].d2[i], d3[k] += m * at[k].d3[i];
            sum += fabs(m) * corner->sum[i];
            most += fabs(m) * corner->most[i];
        }
        fill_row(&rows[n], d1, d2, d3, sum * c->len / 8, most, 0);
        rows[n].v = row->v, rows[n].a = row->a, rows[n].j = row->j;
        n++;
    }
    if (lim->kins == LIMITS_SAMPLED) {
        struct limits_jet *jet = tj->scratch.jet;
        double sum = 0, most = 0;
        for (int k = 0; k < 3; k++)
            if (limits_sample(lim, &at[k], &jet[k]) != 0) return -1;
        for (int i = 0; i < PATH_AXES; i++) sum += corner->sum[i], most += corner->most[i];
        for (int r = 0; r < lim->rows; r++, n++) {
            double d1[3], d2[3], d3[3], gain = 0;
            for (int k = 0; k < 3; k++) d1[k] = jet[k].d1[r], d2[k] = jet[k].d2[r], d3[k] = jet[k].d3[r];
            for (int k = 0; sum > 0 && k < 3; k++) gain = fmax(gain, fabs(d1[k]));
            fill_row(&rows[n], d1, d2, d3, gain * sum * c->len / 8, gain * most, 1);
            rows[n].v = lim->row[r].v, rows[n].a = lim->row[r].a, rows[n].j = lim->row[r].j;
        }
    }
    *count = n;
    return 0;
}

/* Time by which the mean is behind step() at most, while what step() does acts in its jerk: half of the window, and the
 * cycles that a third difference of positions takes. */
static double lag_time(const struct traj *tj, int window)
{
    return window > 1 ? (window + JERK_CYCLES) * tj->dt / 2 : 0;
}

/* Bound of acceleration that a cell's jerk leaves when the mean's speed is at most `top` and the
 * acceleration builds up within `build`. */
static double jerk_bound(const struct traj_row *rows, int count, double top, double build, double share)
{
    double u = 1e30;

    for (int i = 0; i < count; i++) {
        const struct traj_row *r = &rows[i];
        if (r->j <= 0) continue;
        double q1 = fmax(r->hi1, -r->lo1), q2 = fmax(r->hi2, -r->lo2);
        double change = q1 / build + 3 * q2 * top;
        if (change > 1e-12) u = fmin(u, fmax(0, share * r->j - r->most3 * top * top * top) / change);
    }
    return u;
}

/* The same at b = 0, cap / 2 and cap. The acceleration builds up within the filter's window, in half of it where it may
 * turn from one bound to the other. While step() is at b, or anywhere above, the mean is no faster than
 * by what the bounds u allow in half a window: this makes more of them where motion is slower than it
 * might be. In b it is concave where speed is above that gain; below cap / 2 it is taken as constant. */
static void jerk_bounds(const struct traj_row *rows, int count, double top, double cap,
                        double window, double lag, int turns, double share, double u,
                        double bound[3])
{
    double slow = sqrt(cap / 2), build = turns ? window / 2 : window, gain;

    bound[2] = jerk_bound(rows, count, top, build, share);
    bound[1] = bound[0] = bound[2];
    gain = fmin(u, jerk_bound(rows, count, 0, build, share)) * lag;
    if (slow < gain || slow + gain >= top) return;
    bound[1] = bound[0] = jerk_bound(rows, count, slow + gain, build, share);
}

/* Bounds of motion on the cell from the limits of axes and joints and the path's derivatives. Returns
 * how much of the acceleration is lost because these change along the cell; -1: joints have no solution. */
static double bound_cell(struct traj *tj, struct traj_cell *c, int rounded, int arc, double share, double cap)
{
    struct path_jet *at = tj->scratch.at;
    struct traj_row *rows = tj->scratch.rows;
    struct corners corner = { { 0 }, { 0 } };
    const struct traj_seg *g = traj_cseg(tj, c->seg);
    double eps = c->len * 1e-7, spread = 0, least, most, m[3] = { 0, 0, 0 }, window = c->window * tj->dt;
    int group = g->prim.metric == PATH_XYZ ? PATH_X : g->prim.metric == PATH_UVW ? PATH_U : PATH_A, count;
    int jerk = c->window > 1, sampled = tj->lim.kins == LIMITS_SAMPLED;

    if (rounded) find_corners(tj, c, &corner);
    rounded_jet(tj, c->seg, c->s0 + eps, &at[0]);
    rounded_jet(tj, seg_of(tj, c->seg, c->s0 + c->len / 2), c->s0 + c->len / 2, &at[1]);
    rounded_jet(tj, seg_of(tj, c->seg, c->s0 + c->len - eps), c->s0 + c->len - eps, &at[2]);
    if (fill_rows(tj, c, at, &corner, rows, &count) != 0) return -1;

    for (int i = 0; i < count; i++) {
        const struct traj_row *r = &rows[i];
        double reserve = arc && !rounded ? ARC_CAP : ROUND_CAP, q1 = fmax(r->hi1, -r->lo1), q2 = fmax(r->hi2, -r->lo2);
        if (q1 > 1e-12 && r->v > 0) cap = fmin(cap, r->v * r->v / (q1 * q1));
        if (q2 > 0 && r->a > 0) cap = fmin(cap, reserve * share * r->a / q2);
        if (jerk && r->j > 0 && r->most3 > 0) {
            double v = cbrt(JERK_CURVE * share * r->j / r->most3);
            cap = fmin(cap, v * v);
        }
    }
    for (int k = 0; k < 3; k++) {
        for (int i = group; i < group + 3; i++) m[k] += at[k].d1[i] * at[k].d1[i];
        m[k] = sqrt(m[k]);
    }
    range3(m[0], m[1], m[2], 0, &least, &most);
    c->metric = most;
    if (rounded && c->metric * g->stretch > 2) {
        /* The feed of a move that hardly moves in its metric must not hold up a neighbour's. */
        uint32_t other = c->s0 + c->len / 2 > (g->s0 + g->s1) / 2 ? c->seg + 1 : c->seg - 1;
        if ((int32_t)(other - tj->first) >= 0 && (int32_t)(tj->end - other) > 0 &&
            traj_cseg(tj, other)->prim.metric == g->prim.metric)
            c->seg2 = other;
    }
    cap = fmin(cap, 1e12);
    double fed = feed_b(tj, c, fmax(tj->drive.max_scale, 1), 1e99), limit = cap;
    cap = fmin(cap, fed); /* so that the chords below end at the highest speed there is */
    c->cap = cap;
    c->top = sqrt(cap);

    /* Rows |q1 u + q2 b| <= A for all q1, q2 in their ranges, and |q1 u| <= A. With u of one sign
     * they are bounds of u that are concave in b: two chords over [0, cap] lie inside. */
    double up[3], down[3], by_jerk[3] = { 1e30, 1e30, 1e30 }, most_u = share * g->acc;
    for (int i = 0; i < count; i++)
        if (rows[i].a > 0) most_u = fmin(most_u, share * rows[i].a / fmax(1e-12, fmax(rows[i].hi1, -rows[i].lo1)));
    if (jerk) jerk_bounds(rows, count, c->top, cap, window, lag_time(tj, c->window), c->turns, share, most_u, by_jerk);
    for (int n = 0; n < 3; n++) {
        double b = cap * n / 2;
        up[n] = down[n] = fmin(most_u, by_jerk[n]);
        for (int i = 0; i < count; i++) {
            const struct traj_row *r = &rows[i];
            if (r->a <= 0) continue;
            double a = share * r->a, top = fmin(a, a - r->hi2 * b), bottom = fmin(a, a + r->lo2 * b);
            if (r->hi1 > 1e-12) {
                up[n] = fmin(up[n], top / r->hi1);
                down[n] = fmin(down[n], bottom / r->hi1);
            }
            if (r->lo1 < -1e-12) {
                up[n] = fmin(up[n], bottom / -r->lo1);
                down[n] = fmin(down[n], top / -r->lo1);
            }
        }
    }
    chords(c->up, up, cap);
    chords(c->down, down, cap);

    /* What the ranges cost, as a share of acceleration, if acceleration limits the speed. */
    for (int i = 0; i < count; i++) {
        const struct traj_row *r = &rows[i];
        if (r->a <= 0) continue;
        if (r->hi2 > r->lo2 && limit < fed && limit * fmax(r->hi2, -r->lo2) > LOSS_SHARE * share * r->a)
            spread = fmax(spread, (r->hi2 - r->lo2) * limit / (share * r->a));
        /* joints: also by a changing slope where that joint sets the bound */
        double q1 = fmax(r->hi1, -r->lo1);
        if (sampled && q1 * up[0] > 0.8 * share * r->a) spread = fmax(spread, (r->hi1 - r->lo1) / q1);
    }
    return spread;
}

/* A cell that would end within rounding of a move's end, ends there: both are compared with s. */
static double snap_end(const struct traj *tj, double end, double tiny)
{
    for (uint32_t t = tj->cut_seg; t != tj->end && traj_cseg(tj, t)->s1 <= end + tiny; t++)
        if (traj_cseg(tj, t)->s1 >= end - tiny) return traj_cseg(tj, t)->s1;
    return end;
}

double traj_jerk(const struct traj *tj, const struct traj_seg *g)
{
    const struct limits *lim = &tj->lim;
    double j = 1e300;

    if (!lim->jerk_on || g->mark) return 0;
    for (int i = 0; i < PATH_AXES; i++) {
        double u = g->prim.kind == PATH_ARC && i <= PATH_Z ? 1 : fabs(g->prim.u[i]);
        if (u > 1e-9 && lim->j[i] > 0) j = fmin(j, lim->j[i] / u);
    }
    for (int n = 0; n < lim->rows; n++) {
        const struct limits_row *row = &lim->row[n];
        double u = 0;
        if (row->j <= 0) continue;
        if (lim->kins == LIMITS_LINEAR) {
            for (int i = 0; i < PATH_AXES; i++) u += fabs(row->m[i] * g->prim.u[i]);
            if (g->prim.kind == PATH_ARC) u += fmax(fabs(row->m[0]), fmax(fabs(row->m[1]), fabs(row->m[2])));
            if (u > 1e-9) j = fmin(j, row->j / u);
        } else if (row->a > 0) {
            j = fmin(j, g->acc * row->j / row->a);
        }
    }
    return j < 1e299 ? j : 0;
}

/* The first cell after a rest: the window for all cells up to the next one. Moves known by now decide; where the next
 * rest is known too, motion is no faster than jerk lets it get over that length. That is the most; dense corners are
 * passed faster with less (pace.c). */
static int choose_window(const struct traj *tj, uint32_t index)
{
    double start = traj_cseg(tj, index)->s0, len = 1e99;
    uint32_t end = index;

    for (; end != tj->end && end - index < CELL_MOVES; end++)
        if (end != index && traj_cseg(tj, end)->join == JOIN_REST) break;
    const struct traj_seg *last = traj_cseg(tj, end - 1);
    if (end != tj->end ? traj_cseg(tj, end)->join == JOIN_REST
                       : tj->tail_forced || last->end == TRAJ_STOP)
        len = last->s1 - start;

    int most = 1;
    for (uint32_t t = index; t != end; t++) {
        const struct traj_seg *g = traj_cseg(tj, t);
        double j = traj_jerk(tj, g), peak = j > 0 ? j * pow(len / (2 * j), 2.0 / 3) : 0;
        int n = traj_window(tj, fmin(planned_speed(tj, g), peak), g->acc, j, tj->cut_turns ? 2 : 1);
        if (n > most) most = n;
    }
    return tj->cut_turns || most <= 2 ? most : pace_window(tj, index, end, most);
}

/* Makes the next piece of the final path. 0: nothing to do. */
static int cut_piece(struct traj *tj, int *samples)
{
    double a = tj->cut_s, tiny = 1e-12 * (1 + a), step = 1e30, end, share = 1, cap = 1e12, loss, seed[LIMITS_JOINTS];
    int rounded = 0, arc, sampled = tj->lim.kins == LIMITS_SAMPLED;
    uint32_t j;

    if (tj->s_final - a <= tiny || tj->blocked) return 0;
    if (tj->piece_end - tj->piece_ripe >= TRAJ_PIECES - 2 * TRAJ_REACH) return 0;
    while (tj->cut_seg + 1 != tj->end && a >= traj_seg(tj, tj->cut_seg)->s1 - tiny) tj->cut_seg++;
    struct traj_seg *g = traj_seg(tj, tj->cut_seg);
    end = tj->s_final;

    /* Roundings and zones: a lone one begins and ends cells at its edges; all are cut in parts. Where
     * they overlap only the parts are cut, and bound_cell() allows for the edges within. */
    for (uint32_t t = tj->cut_seg; t != tj->end && traj_seg(tj, t)->s0 < end && traj_seg(tj, t)->s0 < a + step; t++) {
        const struct traj_seg *on = traj_seg(tj, t);
        for (j = on->lo; (int32_t)(on->hi - j) >= 0; j++) {
            const struct traj_seg *q = traj_seg(tj, j);
            double lo = q->s0 - join_reach(q), hi = q->s0 + join_reach(q);
            if (join_reach(q) <= 0 || hi <= a + tiny || lo >= end) continue;
            if (lo > a + tiny) {
                if (q->solo || !rounded) end = fmin(end, lo);
                else if (q->w > 0) step = fmin(step, fmax(lo - a, q->w / ROUND_PARTS));
                continue;
            }
            if (q->solo) end = fmin(end, hi);
            for (int side = -1; q->curl > 0 && side <= 1; side += 2) { /* corners of the bend */
                double corner = q->s0 + 0.75 * side * q->w;
                if (corner > a + tiny) end = fmin(end, corner);
            }
            if (q->w > 0) {
                rounded = 1;
                step = fmin(step, q->w / ROUND_PARTS);
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
    if (sampled) step = fmin(step, fmin(KIN_STEP, tj->kin_len > 0 ? 2 * tj->kin_len : KIN_STEP));
    if (end - a > 1.25 * step) end = a + step;
    end = snap_end(tj, end, tiny);

    struct traj_cell *c = piece_at(tj, tj->piece_end);
    c->s0 = a;
    c->len = end - a;
    c->seg = c->seg2 = tj->cut_seg;
    c->rest = g->join == JOIN_REST && a <= g->s0 + tiny;
    if (c->rest) {
        tj->cut_turns = g->follow != TRAJ_FEED;
        tj->cut_window = g->window = choose_window(tj, tj->cut_seg);
    }
    c->window = tj->cut_window;
    c->turns = tj->cut_turns;
    c->k = c->kr = 0;
    if (tj->piece_end >= CELLS_CYCLE) {
        double v = (end - piece_at(tj, tj->piece_end - CELLS_CYCLE + 1)->s0) / tj->dt;
        cap = fmin(cap, v * v);
    }
    memcpy(seed, tj->lim.seed, sizeof seed);
    for (int n = 0; (loss = bound_cell(tj, c, rounded, arc, share, cap)) > SPLIT || loss < 0; n++) {
        *samples += 3 * sampled;
        if (!(rounded || sampled) || n >= (sampled ? KIN_SPLITS : SPLITS)) break;
        c->len /= 2;
        end = a + c->len;
        memcpy(tj->lim.seed, seed, sizeof seed); /* each try begins at the same place */
    }
    *samples += 3 * sampled;
    if (loss < 0) {
        tj->blocked = 1;
        return 0;
    }
    tj->kin_len = c->len;
    /* The end of the path known so far: only what is out of reach of what may follow gets ripe. */
    double tail = lag_time(tj, c->window);
    tail *= c->top + fmax(c->up[0].c1, c->down[0].c1) * tail;
    if (c->window > 1 && end == tj->s_final && end < traj_cseg(tj, tj->end - 1)->s1 && c->len > 3 * tail) {
        c->len -= 1.5 * tail;
        end = a + c->len;
    }
    tj->cut_s = end;
    tj->piece_end++;
    return 1;
}

void cut_pieces(struct traj *tj)
{
    int samples = 0;
    for (int n = 0; n < CUT_BUDGET && samples < SAMPLE_BUDGET && cut_piece(tj, &samples); n++) {}
}

double allowed(const struct traj_line line[2], double b)
{
    double p = line[0].c1 - line[0].c2 * b, q = line[1].c1 - line[1].c2 * b;
    double f = p < q ? p : q;
    return f > 0 ? f : 0;
}

/* ---- ripening ----------------------------------------------------------------
 *
 * While step() is in one piece the mean may be in another. A mean over `window` of a motion with
 * speeds up to v is within half a window times v of every place that it is taken of: so the bounds
 * of a piece hold that far before and behind it. docs/planner.md has the proof.
 */

/* No path can follow the last piece without a rest between. */
static int path_closed(const struct traj *tj)
{
    const struct traj_seg *last = traj_cseg(tj, tj->end - 1);
    if (tj->blocked) return 1;
    if (tj->cut_s < last->s1) return 0;
    return tj->tail_forced || last->end == TRAJ_STOP;
}

static double biggest_acc(const struct traj_cell *p)
{
    return fmax(p->up[0].c1, p->down[0].c1);
}

static inline double lesser(double a, double b)
{
    return a < b ? a : b;
}

static inline double greater(double a, double b)
{
    return a > b ? a : b;
}

/* A bound that reaches `far` counts from or up to a place in piece p; on all of p where that is short. */
static void note_reach(struct traj_reach *r, const struct traj_cell *p, const struct traj_cell *by,
                       double far, double from, double to)
{
    double end = p->s0 + p->len;

    if (from >= end || to <= p->s0) return;
    if (p->len < RIPEN_GRADE * far) from = p->s0, to = end;
    if (from > p->s0 || to < end) r->whole = 0;
    r->by[r->count] = by;
    r->from[r->count] = greater(from, p->s0);
    r->to[r->count++] = lesser(to, end);
}

/* 0: more of the path must be known first. */
static int find_reach(struct traj *tj, struct traj_reach *r)
{
    const struct traj_cell *p = piece_at(tj, tj->piece_ripe), *by;
    double end = p->s0 + p->len, half = lag_time(tj, p->window), acc = biggest_acc(p);
    uint32_t first = tj->piece_ripe, last = tj->piece_ripe;

    for (uint32_t n = tj->piece_ripe + 1; last - tj->piece_ripe < TRAJ_REACH; n++) {
        double limit = half * (p->top + acc * half);
        if (n == tj->piece_end) {
            if (tj->cut_s - end < limit && !path_closed(tj)) return 0;
            break;
        }
        by = piece_at(tj, n);
        if (by->rest || by->s0 - end > limit) break;
        acc = greater(acc, biggest_acc(by));
        last = n;
    }
    for (by = p; first != 0 && !by->rest && tj->piece_ripe - first < TRAJ_REACH; first--) {
        by = piece_at(tj, first - 1);
        if (p->s0 - by->s0 - by->len > half * (p->top + acc * half)) break;
        acc = greater(acc, biggest_acc(by));
    }
    double limit = p->top + acc * half;
    r->count = 0;
    r->whole = 1;
    for (uint32_t n = first; n != tj->piece_ripe; n++) {
        by = piece_at(tj, n);
        double far = half * lesser(by->top, limit);
        note_reach(r, p, by, far, p->s0, by->s0 + by->len + far);
    }
    note_reach(r, p, p, 0, p->s0, end);
    for (uint32_t n = tj->piece_ripe + 1; (int32_t)(last - n) >= 0; n++) {
        by = piece_at(tj, n);
        double far = half * lesser(by->top, limit);
        note_reach(r, p, by, far, by->s0 - far, end);
    }
    return 1;
}

/* End of the cell of piece p that begins at s: the next place where a bound begins or ends, or the last
 * of several such places that are near. What is near grows from both ends of the piece towards its
 * middle: that bounds the number of cells. */
static double cell_end(const struct traj_cell *p, const struct traj_reach *r, double s)
{
    double end = p->s0 + p->len, near = s + greater(RIPEN_GRADE * lesser(end - s, s - p->s0), 1e-6 * p->len);
    double group = s, next = end;

    if (r->whole) return end;
    for (int n = 0; n < r->count; n++) {
        if (r->from[n] > near) next = lesser(next, r->from[n]);
        else group = greater(group, r->from[n]);
        if (r->to[n] > near) next = lesser(next, r->to[n]);
        else group = greater(group, r->to[n]);
    }
    return group > s ? group : next;
}

/* Makes the cell of piece p from s to end. */
static void make_cell(struct traj *tj, const struct traj_cell *p, const struct traj_reach *r, double s, double end)
{
    struct traj_cell *c = cell_at(tj, tj->cell_end);
    double up[3] = { 1e30, 1e30, 1e30 }, down[3] = { 1e30, 1e30, 1e30 };

    *c = *p;
    c->s0 = s;
    c->len = end - s;
    c->rest = p->rest && s == p->s0;
    for (int n = 0; n < r->count; n++)
        if (r->from[n] < end && r->to[n] > s) c->cap = lesser(c->cap, r->by[n]->cap);
    for (int n = 0; n < r->count; n++) {
        const struct traj_cell *by = r->by[n];
        if (r->from[n] >= end || r->to[n] <= s) continue;
        for (int k = 0; k < 3; k++) {
            double b = c->cap * k / 2;
            up[k] = lesser(up[k], lesser(by->up[0].c1 - by->up[0].c2 * b, by->up[1].c1 - by->up[1].c2 * b));
            down[k] = lesser(down[k], lesser(by->down[0].c1 - by->down[0].c2 * b, by->down[1].c1 - by->down[1].c2 * b));
        }
    }
    chords(c->up, up, c->cap);
    chords(c->down, down, c->cap);
    tj->cell_end++;
}

void ripen_pieces(struct traj *tj)
{
    struct traj_reach *r = &tj->reach;

    for (int work = 0; work < RIPEN_BUDGET && tj->piece_ripe != tj->piece_end; work++) {
        const struct traj_cell *p = piece_at(tj, tj->piece_ripe);
        if (tj->cell_end - tj->cell_first >= TRAJ_CELLS - 2 * RIPEN_PARTS) return;
        if (p->window <= 1) {
            *cell_at(tj, tj->cell_end++) = *p;
        } else {
            if (!find_reach(tj, r)) return;
            double s = p->s0, end = p->s0 + p->len;
            for (int n = 1; s < end; n++) {
                double to = n < RIPEN_PARTS ? cell_end(p, r, s) : end;
                make_cell(tj, p, r, s, to);
                s = to;
                work += r->count;
            }
        }
        tj->piece_ripe++;
    }
}

/* ---- envelope ---------------------------------------------------------------- */

double ramp_b(const struct traj_line line[2], double b_end, double d)
{
    double p = (b_end + 2 * d * line[0].c1) / (1 + 2 * d * line[0].c2);
    double q = (b_end + 2 * d * line[1].c1) / (1 + 2 * d * line[1].c2);
    return p < q ? p : q;
}

void sweep_envelope(struct traj *tj)
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
        tj->swept_before = tj->swept_end;
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
        int same = (int32_t)(tj->swept_before - tj->sweep) > 0 && fabs(k - c->k) <= 1e-12 * k;
        c->k = k;
        if ((same && !tj->sweep_full) || tj->sweep == tj->cell ||
            tj->sweep == tj->cell_first) {
            tj->sweeping = 0;
            return;
        }
        tj->sweep--;
    }
}


int sweep_back(struct traj *tj)
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
