/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * join.c - how moves join: rests, roundings, kinks; position on the rounded path.
 * See traj.h; derivations in docs/planner.md.
 */
#include <math.h>
#include <string.h>

#include "traj_priv.h"

#define JOIN_BUDGET 16     /* junctions made final in a cycle */
#define SPREAD 24          /* junctions that a rounding may reach over, each side */
#define TURN_LIMIT 1.0     /* rad: sum of the bends that one rounding smooths */
#define TOL_SHARE 0.8      /* of the tolerance, taken when roundings overlap */
#define GROW 1.5           /* step of the search for a width */
#define SMOOTH_SHARE 1e-4  /* a smaller step of acceleration or jerk counts as none */

/* ---- junctions ------------------------------------------------------------ */

double planned_speed(const struct traj *tj, const struct traj_seg *g)
{
    double v = g->vmax;
    if (g->follow == TRAJ_FEED) v = fmin(g->feed * fmax(tj->drive.max_scale, 1), v);
    return v * g->stretch;
}

double axis_acc(const struct traj *tj, int axis, const struct traj_seg *g)
{
    return tj->lim.a[axis] > 0 ? tj->lim.a[axis] : g->acc / g->stretch;
}

/* Largest |value of an axis| / limit, and of joints that are several axes. 0 limits do not count. */
static double worst_ratio(const struct traj *tj, const double value[PATH_AXES],
                          const double limit[PATH_AXES], int which)
{
    double worst = 0;
    for (int i = 0; i < PATH_AXES; i++)
        if (limit[i] > 0) worst = fmax(worst, fabs(value[i]) / limit[i]);
    if (tj->lim.kins != LIMITS_LINEAR) return worst;
    for (int n = 0; n < tj->lim.rows; n++) {
        const struct limits_row *row = &tj->lim.row[n];
        double sum = 0, most = which == 1 ? row->v : which == 2 ? row->a : row->j;
        if (most <= 0) continue;
        for (int i = 0; i < PATH_AXES; i++) sum += row->m[i] * value[i];
        worst = fmax(worst, fabs(sum) / most);
    }
    return worst;
}

static double acc_ratio(const struct traj *tj, const struct traj_seg *g, const double value[PATH_AXES])
{
    double limit[PATH_AXES];
    for (int i = 0; i < PATH_AXES; i++) limit[i] = axis_acc(tj, i, g);
    return worst_ratio(tj, value, limit, 2);
}

/* 0 when jerk is not limited. */
static double jerk_ratio(const struct traj *tj, const double value[PATH_AXES])
{
    return tj->lim.jerk_on ? worst_ratio(tj, value, tj->lim.j, 3) : 0;
}

/* Widest rounding that a move's end may ask for, whatever follows. Where short moves are smoothed over
 * several, the next rounding may be wider than the one before, and as wide as that reaches back. */
static double tail_reserve(const struct traj *tj, const struct traj_seg *g)
{
    double half = g->prim.len / 2, v, a = 0, wide;

    if (g->join == JOIN_ROUND && g->curl == 0) half = fmax(half, GROW * g->w);
    if (g->end == TRAJ_STOP) return 0;
    if (!(g->tol > 0)) return half;
    v = planned_speed(tj, g);
    for (int i = 0; i < PATH_AXES; i++) {
        double ai = axis_acc(tj, i, g);
        if (a == 0 || ai < a) a = ai;
    }
    wide = 2 * v * sqrt(8 * g->tol / a);
    if (tj->lim.jerk_on && g->jerk > 0) {
        double bend = PATH_BEND_SLOPE * a * v / (JOIN_JERK * g->jerk); /* onto the tightest arc at this speed */
        double turn = sqrt(2 * PATH_ROUND_SLOPE * v * v * v / (JOIN_JERK * g->jerk));
        wide = fmax(wide, fmax(bend, turn));
    }
    return fmin(half, wide);
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
    g->window = 0; /* chosen when its cells are made */
    g->cut = 1;
    g->w = g->zone = 0;
    tj->n_rest++;
}

/* Speed at which the steps of velocity and acceleration at the junction stay small, 1e30 when there
 * are none. */
static double kink_speed(const struct traj *tj, const struct traj_seg *g)
{
    double dt = tj->dt, v = 1e30, step = acc_ratio(tj, g, g->du), jerk = jerk_ratio(tj, g->du),
           bend = jerk_ratio(tj, g->dk);

    if (step > 0) v = fmin(v, KINK_SHARE * dt / step);
    if (jerk > 0) v = fmin(v, KINK_SHARE * dt * dt / (2 * jerk));
    if (bend > 0) v = fmin(v, sqrt(KINK_SHARE * dt / (2 * STEP_JERK * bend)));
    return v;
}

/* A corner that is passed exactly. room: path before it that is not final yet. */
static void join_kink(struct traj *tj, const struct traj_seg *prev, struct traj_seg *g, double room)
{
    double v = kink_speed(tj, g), ratio = 0;

    for (int i = 0; i < PATH_AXES; i++) ratio = fmax(ratio, fabs(g->du[i]));
    double zone = fmin(2 * v * tj->dt, fmin(prev->prim.len, g->prim.len) / 2);
    if (ratio > 0.1 || zone > room || tj->lim.kins == LIMITS_SAMPLED) {
        join_rest(tj, g);
        return;
    }
    v = fmin(v, zone / (2 * tj->dt));
    g->join = JOIN_KINK;
    g->w = 0;
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
    double speed, biggest, room, curl;

    path_jet_at(&prev->prim, prev->prim.len, &before);
    path_jet_at(&g->prim, 0, &after);
    for (int i = 0; i < PATH_AXES; i++) {
        g->du[i] = after.d1[i] - before.d1[i];
        g->dk[i] = after.d2[i] - before.d2[i];
    }
    g->cut = prev->prim.kind != PATH_LINE || g->prim.kind != PATH_LINE || prev->feed != g->feed ||
             prev->vmax != g->vmax || prev->acc != g->acc || prev->follow != g->follow ||
             prev->prim.metric != g->prim.metric || prev->stretch != g->stretch;
    /* A run with limits of jerk either follows a spindle or does not: the filter differs. */
    int turns = tj->lim.jerk_on && (prev->follow != TRAJ_FEED) != (g->follow != TRAJ_FEED);
    if (rest_before || prev->end == TRAJ_STOP || turns) {
        join_rest(tj, g);
        return;
    }
    speed = fmax(planned_speed(tj, prev), planned_speed(tj, g));
    biggest = acc_ratio(tj, g, g->du) * speed / tj->dt;
    biggest = fmax(biggest, jerk_ratio(tj, g->du) * speed / (tj->dt * tj->dt));
    curl = jerk_ratio(tj, g->dk) * STEP_JERK * speed * speed / tj->dt;
    room = g->s0 - tj->cut_s;
    if (biggest < SMOOTH_SHARE && curl < SMOOTH_SHARE) {
        g->join = JOIN_SMOOTH;
        /* Motion may be in cells already that were ripe for an end at rest here: no bound of what
         * comes was spread to them. */
        if (tj->lim.jerk_on && room <= 0) join_rest(tj, g);
        return;
    }
    if (prev->end == TRAJ_EXACT || g->end != TRAJ_BLEND) {
        join_kink(tj, prev, g, room);
        return;
    }
    g->join = JOIN_ROUND;
    g->bend = biggest < SMOOTH_SHARE ? 0 : path_max_norm(g->du);
    g->curl = curl < SMOOTH_SHARE ? 0 : path_max_norm(g->dk);
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

/* Deviation by the rounding of a junction alone, at its middle (at most, for the bend). */
static double deviation(const struct traj_seg *g, double w)
{
    return g->bend * w * PATH_ROUND_PEAK + g->curl * w * w * PATH_BEND_PEAK;
}

/* Width that deviates by tol. */
static double width_of(const struct traj_seg *g, double tol)
{
    double a = g->curl * PATH_BEND_PEAK, b = g->bend * PATH_ROUND_PEAK;
    if (tol <= 0) return 0;
    return 2 * tol / fmax(b + sqrt(b * b + 4 * a * tol), 1e-300);
}

/* Width that speed v needs. */
static double width_needed(const struct traj *tj, const struct traj_seg *prev, const struct traj_seg *g, double v)
{
    double acc = fmax(acc_ratio(tj, g, g->du), acc_ratio(tj, prev, g->du)), v3 = v * v * v / JOIN_JERK;
    double w = 2 * PATH_ROUND_CURVE * acc * v * v;

    w = fmax(w, sqrt(PATH_ROUND_SLOPE * jerk_ratio(tj, g->du) * v3));
    if (g->curl > 0) w = fmax(w, PATH_BEND_SLOPE * jerk_ratio(tj, g->dk) * v3);
    return w;
}

double junction_acc(const struct traj *tj, uint32_t c)
{
    const struct traj_seg *g = traj_cseg(tj, c);
    return fmax(acc_ratio(tj, g, g->du), acc_ratio(tj, traj_cseg(tj, c - 1), g->du));
}

void junction_jerk(const struct traj *tj, uint32_t c, double *jerk, double *bend)
{
    const struct traj_seg *g = traj_cseg(tj, c);
    *jerk = jerk_ratio(tj, g->du);
    *bend = g->curl > 0 ? jerk_ratio(tj, g->dk) : 0;
}

double join_guess(const struct traj *tj, uint32_t c)
{
    const struct traj_seg *prev = traj_cseg(tj, c - 1), *g = traj_cseg(tj, c);
    double v = fmax(planned_speed(tj, prev), planned_speed(tj, g));
    double w = fmin(fmin(prev->prim.len, g->prim.len) / 2, width_of(g, g->tol_join));
    return fmin(w, width_needed(tj, prev, g, v));
}

/* If all junctions around c were rounded over +-w: curvature at c, sum of deviations there, sum of
 * bends. 1: the curvature leaves half of each axis's acceleration and jerk at the speed v. */
static int try_width(const struct traj *tj, uint32_t c, double w, double v, double *off, double *turn)
{
    const struct traj_seg *at = traj_cseg(tj, c);
    double k[4], curve[PATH_AXES];

    for (int i = 0; i < PATH_AXES; i++) curve[i] = at->du[i] * PATH_ROUND_CURVE;
    *off = deviation(at, w);
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
    if (acc_ratio(tj, at, curve) / w * v * v > 0.5) return 0;
    return PATH_ROUND_SLOPE * jerk_ratio(tj, at->du) * v * v * v <= JOIN_JERK * w * w;
}

/* Largest share of w that keeps the sum of deviations within the tolerance at every junction reached. */
static double fit_width(const struct traj *tj, uint32_t c, double w)
{
    const struct traj_seg *at = traj_cseg(tj, c);
    double k[4];

    w = fmin(w, width_of(at, at->tol_join - at->off));
    for (int n = 0; n < 24 && w > 0; n++) {
        int fits = 1;
        for (int side = -1; side <= 1 && fits; side += 2) {
            for (uint32_t d = c + side; d != tj->end && (int32_t)(d - tj->first) > 0; d += side) {
                const struct traj_seg *q = traj_cseg(tj, d);
                double x = (q->s0 - at->s0) / w;
                if (fabs(x) >= 1) break;
                if (q->join != JOIN_ROUND) continue;
                path_round(x, 1, k);
                if (q->off + at->bend * w * k[0] + at->curl * w * w * PATH_BEND_PEAK > q->tol_join) {
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
            g->off += t == c ? deviation(at, at->w)
                             : at->bend * at->w * k[0] + at->curl * at->w * at->w * PATH_BEND_PEAK;
        }
    }
    for (uint32_t t = c - 1;; t--) {
        struct traj_seg *g = traj_seg(tj, t);
        if (at->s0 - g->s1 >= reach) break;
        if ((int32_t)(g->hi - g->lo) < 0) g->lo = c;
        g->hi = c;
        if (at->w > 0) {
            path_round(fmax(-1, (g->s0 - at->s0) / at->w), 1, k);
            g->off += at->bend * at->w * k[0] + at->curl * at->w * at->w * PATH_BEND_PEAK;
        }
        if (t == tj->first) break;
    }
}

/* Decides the width of the rounding at junction c. 0: more of the path must be known first. */
static int finish_join(struct traj *tj, uint32_t c)
{
    struct traj_seg *g = traj_seg(tj, c);
    const struct traj_seg *prev = traj_cseg(tj, c - 1);
    double v, half, needed, left, right, w, off, turn, kink;
    int open;

    if (g->join == JOIN_KINK) spread_rounding(tj, c);
    if (g->join != JOIN_ROUND) return 1;
    v = fmax(planned_speed(tj, prev), planned_speed(tj, g));
    left = reach_left(tj, c);
    right = reach_right(tj, c, &open);
    /* Alone: by tolerance, by half the neighbours, and no wider than the speed asks for. */
    half = fmin(fmin(prev->prim.len, g->prim.len) / 2, fmin(left, right));
    needed = width_needed(tj, prev, g, v);
    w = fmin(fmin(half, needed), width_of(g, g->tol_join));
    g->solo = 1;
    if (w >= half && g->curl == 0) {
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
    kink = g->bend == 0 && tj->lim.kins != LIMITS_SAMPLED ? kink_speed(tj, g) : 0;
    if (w < 1e-7 || w < 2 * kink * tj->dt) {
        join_kink(tj, prev, g, g->s0 - tj->cut_s);
        if (g->join == JOIN_KINK) spread_rounding(tj, c);
        return 1;
    }
    if (tj->lim.jerk_on && g->follow == TRAJ_FEED && traj_cseg(tj, c - 1)->w <= prev->prim.len &&
        pace_rests(tj, c, w)) {
        join_rest(tj, g);
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
    double most = width_of(g, g->tol_join), last = prev->join == JOIN_ROUND ? prev->w : 0;

    return fmin(most, fmax(GROW * last, 4 * fmin(prev->prim.len, g->prim.len)));
}

void finish_joins(struct traj *tj)
{
    for (int n = 0; n < JOIN_BUDGET && tj->fin != tj->end; n++) {
        if (tj->fin != tj->first && !finish_join(tj, tj->fin)) break;
        tj->fin++;
    }
}

void update_final(struct traj *tj)
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
    g->w = g->zone = g->kink_b = g->bend = g->curl = g->off = 0;
    g->window = 0;
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

double join_reach(const struct traj_seg *g)
{
    return g->w > g->zone ? g->w : g->zone;
}

uint32_t seg_of(const struct traj *tj, uint32_t from, double s)
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
    if (g->curl <= 0) return;
    path_bend((s - g->s0) / w, side, k);
    for (int i = 0; i < PATH_AXES; i++) {
        jet->p[i] += g->dk[i] * w * w * k[0];
        jet->d1[i] += g->dk[i] * w * k[1];
        jet->d2[i] += g->dk[i] * k[2];
        jet->d3[i] += g->dk[i] * (k[3] / w);
    }
}

void rounded_jet(const struct traj *tj, uint32_t index, double s, struct path_jet *jet)
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
        int side = (int32_t)(index - j) >= 0 ? 1 : -1;
        path_round((s - q->s0) / q->w, side, k);
        for (int i = 0; i < PATH_AXES; i++) p[i] += q->du[i] * q->w * k[0];
        if (q->curl <= 0) continue;
        path_bend((s - q->s0) / q->w, side, k);
        for (int i = 0; i < PATH_AXES; i++) p[i] += q->dk[i] * q->w * q->w * k[0];
    }
}

