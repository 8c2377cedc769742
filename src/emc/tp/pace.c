/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * pace.c - estimates of time, for choices between ways to move that all keep the limits: where a run
 * with limits of jerk rests, and with which window it moves. See traj.h; docs/planner.md.
 */
#include <math.h>

#include "traj_priv.h"

#define PACE_MOVES 32   /* of a run that the choice of its window looks at */
#define PACE_WINDOWS 7  /* tried, each 1 / PACE_STEP of the one before */
#define PACE_STEP 1.4142
#define REST_CYCLES 3   /* that a rest costs more than its share of the filter */

/* How a junction is passed: no faster than v, over w to each side. At a rest both are 0. */
struct pace {
    double v, w;
};

/* What a move allows between its junctions. */
struct pace_move {
    double len, v, a, j;
};

/* Curves at constant speed use up to so much of jerk and acceleration in cells. */
static struct pace_move pace_of_move(const struct traj *tj, const struct traj_seg *g)
{
    struct pace_move m = { g->prim.len, planned_speed(tj, g), g->acc, traj_jerk(tj, g) };

    if (g->prim.kind == PATH_ARC && g->prim.angle > 0) {
        double r = g->prim.len / g->prim.angle;
        m.v = fmin(m.v, sqrt(m.a * r));
        if (m.j > 0) m.v = fmin(m.v, cbrt(JERK_CURVE * m.j * r * r));
    }
    return m;
}

static struct pace pace_of_round(const struct traj *tj, uint32_t c, double w)
{
    const struct traj_seg *g = traj_cseg(tj, c), *prev = traj_cseg(tj, c - 1);
    double v = fmin(planned_speed(tj, prev), planned_speed(tj, g)), acc = junction_acc(tj, c), jerk, bend;

    /* Wider than the moves are long it is one of several that add up to a smooth curve. */
    double apart = (prev->prim.len + g->prim.len) / 2;
    junction_jerk(tj, c, &jerk, &bend);
    if (acc > 0) v = fmin(v, sqrt((w > apart ? apart : w / PATH_ROUND_CURVE) / acc));
    if (jerk > 0) v = fmin(v, cbrt(JERK_CURVE * w * (w > apart ? apart : w / PATH_ROUND_SLOPE) / jerk));
    w = fmin(w, apart / 2);
    if (bend > 0) v = fmin(v, cbrt(JERK_CURVE * w / (PATH_BEND_SLOPE * bend)));
    return (struct pace){ v, w };
}

static struct pace pace_of_join(const struct traj *tj, uint32_t c)
{
    const struct traj_seg *g = traj_cseg(tj, c);

    if (c == tj->first || g->join == JOIN_REST) return (struct pace){ 0, 0 };
    if (c == tj->end) {
        const struct traj_seg *last = traj_cseg(tj, c - 1);
        if (tj->tail_forced || last->end == TRAJ_STOP) return (struct pace){ 0, 0 };
        return (struct pace){ planned_speed(tj, last), 0 };
    }
    if (g->join == JOIN_KINK) return (struct pace){ sqrt(g->kink_b), g->zone };
    double v = fmin(planned_speed(tj, traj_cseg(tj, c - 1)), planned_speed(tj, g));
    if (g->join == JOIN_SMOOTH) return (struct pace){ v, 0 };
    return pace_of_round(tj, c, (int32_t)(tj->fin - c) > 0 ? g->w : join_guess(tj, c));
}

/* Seconds from one junction to the next with a window of t seconds: places near a junction are passed at
 * its speed (ripening), between speeding up and braking the speed stays for t. */
static double pace_time(const struct pace_move *m, const struct pace *from, const struct pace *to, double t,
                        double dt)
{
    double lag = (t + JERK_CYCLES * dt) / 2, u = fmin(m->a, m->j * t);
    double most = fmax(from->v, to->v), free = m->len - from->w - to->w - lag * (from->v + to->v);
    double time = 2 * lag + (from->v > 0 ? from->w / from->v : REST_CYCLES * dt / 2) +
                  (to->v > 0 ? to->w / to->v : REST_CYCLES * dt / 2);

    if (free <= 0) return fmin(from->v, to->v) > 0 ? m->len / fmin(from->v, to->v) : 2 * m->len / most + t;
    double peak = sqrt(u * u * t * t / 4 + u * free + (from->v * from->v + to->v * to->v) / 2) - u * t / 2;
    if (peak < most) return time + 2 * free / (from->v + to->v);
    if (peak <= m->v) return time + (2 * peak - from->v - to->v) / u + t;
    return time + (2 * m->v - from->v - to->v) / u +
           (free - (m->v * m->v - (from->v * from->v + to->v * to->v) / 2) / u) / m->v;
}

/* Seconds for moves of a run with a window of t seconds; joins are the moves + 1 junctions. */
static double pace_run(const struct pace_move *m, const struct pace *joins, int moves, double t, double dt)
{
    struct pace at[PACE_MOVES + 1];
    double sum = 0;

    for (int i = 0; i <= moves; i++) at[i] = joins[i];
    for (int i = 0; i < moves; i++)
        at[i + 1].v = fmin(at[i + 1].v, sqrt(at[i].v * at[i].v + 2 * fmin(m[i].a, m[i].j * t) * m[i].len));
    for (int i = moves; i-- > 0;)
        at[i].v = fmin(at[i].v, sqrt(at[i + 1].v * at[i + 1].v + 2 * fmin(m[i].a, m[i].j * t) * m[i].len));
    for (int i = 0; i < moves; i++) sum += pace_time(&m[i], &at[i], &at[i + 1], t, dt);
    return sum;
}

/* The best window for a move from rest to rest that reaches no limit but that of jerk. */
static double short_window(const struct pace_move *m)
{
    return cbrt(m->len / (2 * m->j));
}

/* The shortest time for up to two moves in one run. */
static double pace_best(const struct traj *tj, const struct pace_move *m, const struct pace *joins, int moves)
{
    double t = 0, best = 1e300;

    for (int i = 0; i < moves; i++)
        t = fmax(t, fmin(fmin(m[i].a / m[i].j, sqrt(m[i].v / m[i].j)), 2 * short_window(&m[i])));
    for (int n = 0; n < PACE_WINDOWS && t >= tj->dt; n++, t /= PACE_STEP) {
        double sum = pace_run(m, joins, moves, t, tj->dt);
        if (sum > best) break;
        best = sum;
    }
    return best;
}

int pace_rests(const struct traj *tj, uint32_t c, double w)
{
    const struct traj_seg *g = traj_cseg(tj, c), *prev = traj_cseg(tj, c - 1);
    struct pace_move m[2] = { pace_of_move(tj, prev), pace_of_move(tj, g) };
    struct pace joins[3] = { pace_of_join(tj, c - 1), pace_of_round(tj, c, w), pace_of_join(tj, c + 1) };
    struct pace first[2] = { joins[0], { 0, 0 } }, second[2] = { { 0, 0 }, joins[2] };

    if (m[0].j <= 0 || m[1].j <= 0) return 0;
    /* Not slower than half of what the moves allow, or than anything from rest to rest. */
    if (joins[1].v > 0.5 * fmin(m[0].v, m[1].v)) return 0;
    for (int i = 0; i < 2; i++) {
        double t = short_window(&m[i]);
        if (joins[1].v > m[i].j * t * t) return 0;
    }
    return pace_best(tj, &m[0], first, 1) + pace_best(tj, &m[1], second, 1) < pace_best(tj, m, joins, 2);
}

int pace_window(const struct traj *tj, uint32_t index, uint32_t end, int most)
{
    struct pace_move m[PACE_MOVES];
    struct pace joins[PACE_MOVES + 1];
    double t = most * tj->dt, best = 1e300, chosen = t;
    int moves = 0;

    for (; moves < PACE_MOVES && index + moves != end; moves++) {
        m[moves] = pace_of_move(tj, traj_cseg(tj, index + moves));
        joins[moves] = pace_of_join(tj, index + moves);
        if (m[moves].j <= 0) return most;
    }
    joins[0] = (struct pace){ 0, 0 };
    joins[moves] = pace_of_join(tj, index + moves);
    for (int n = 0; n < PACE_WINDOWS && t >= 2 * tj->dt; n++, t /= PACE_STEP) {
        double sum = pace_run(m, joins, moves, t, tj->dt);
        if (sum < best) best = sum, chosen = t;
    }
    int cycles = (int)ceil(chosen / tj->dt - 1e-6);
    return cycles < 1 ? 1 : cycles;
}
