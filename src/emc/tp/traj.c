/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * traj.c - look-ahead and execution. See traj.h for the invariants, docs/planner.md for proofs.
 */
#include <math.h>
#include <string.h>

#include "traj_priv.h"

#define PORTIONS 320       /* pieces of constant acceleration in a cycle, never reached: 8 CELLS_CYCLE */
#define STOP_SCAN 256      /* cells looked ahead for a stop at a given place */
#define COAST_SCAN 512     /* and for keeping a speed; more of them: no higher speed */
#define COAST_TRIES 6      /* speeds tried where the highest cannot be kept, */
#define SLOW_TRIES 60      /* halvings of it near rest */
#define TINY_STEP 1e-13    /* of 1 + s: nothing is left of a cell */
#define HUNGRY 20          /* cycles without a new move: no more may come */
#define GUARD_TIME 0.02    /* s: the tail is made final so long before it limits the speed */

/* From rest: with this window, and free to do anything. */
static void start_filter(struct traj *tj, int n, double s)
{
    traj_filter_set(&tj->filter, n, s);
    tj->sped = tj->braked = 2 * TRAJ_WINDOW;
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
    start_filter(tj, 1, 0);
}

void traj_reset(struct traj *tj, const double p[PATH_AXES])
{
    tj->first = tj->cur = tj->end = 0;
    tj->cell_first = tj->piece_ripe = tj->piece_end = tj->cell_end = tj->cell = 0;
    tj->kin_len = 0;
    tj->cut_window = 1;
    tj->cut_turns = 0;
    tj->blocked = 0;
    tj->s_final = tj->cut_s = 0;
    tj->tail_forced = 0;
    tj->cut_seg = tj->fin = 0;
    tj->hungry = 0;
    tj->sweep = 0;
    tj->sweeping = tj->sweep_anew = 0;
    tj->swept_end = 0;
    tj->s = tj->v = tj->acc = tj->place = tj->speed = 0;
    start_filter(tj, 1, 0);
    tj->dir = 1;
    tj->waiting = tj->in_mark = 0;
    tj->back_sweep = 0;
    memcpy(tj->pos, p, sizeof tj->pos);
}

/* ---- filter ------------------------------------------------------------------- */

void traj_filter_set(struct traj_filter *f, int n, double x)
{
    f->n = n < 1 ? 1 : n > TRAJ_WINDOW ? TRAJ_WINDOW : n;
    for (int i = 0; i < f->n; i++) f->x[i] = 0;
    f->base = x;
    f->sum = 0;
    f->at = 0;
    f->still = f->n + 1;
}

double traj_filter_step(struct traj_filter *f, double x)
{
    double d = x - f->base, last = f->x[f->at ? f->at - 1 : f->n - 1];

    f->still = d == last ? f->still + 1 : 1;
    f->sum += d - f->x[f->at];
    f->x[f->at] = d;
    if (++f->at >= f->n) {
        f->at = 0;
        f->sum = 0; /* no rounding adds up */
        for (int i = 0; i < f->n; i++) f->sum += f->x[i];
    }
    if (f->still > f->n) f->still = f->n + 1;
    if (f->still >= f->n) return x;
    return f->base + f->sum / f->n;
}

int traj_filter_settled(const struct traj_filter *f)
{
    return f->n <= 1 || f->still > f->n; /* one cycle more: steps of acceleration fall between two cycles */
}

/* Acceleration is limited to a, or to j window / turn where that is less: the mean of what changes from
 * rest (turn 1) or from the other bound (turn 2) to a bound. Changing the speed by v takes
 * v / acceleration + window; this is least for a window of sqrt(turn v / j), and more than turn a / j
 * brings nothing. */
int traj_window(const struct traj *tj, double v, double a, double j, int turn)
{
    if (!tj->lim.jerk_on || j <= 0) return 1;
    double t = fmin(turn * a / j, sqrt(turn * v / j)) / tj->dt;
    return t >= TRAJ_WINDOW ? TRAJ_WINDOW : t <= 1 ? 1 : (int)ceil(t - 1e-6);
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
static double braked(const struct traj_cell *c, const struct traj_line brake[2], double b_end,
                     double d, double v, double t, double lo, double hi)
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

/* Moves on the counter of started moves to the place that motion has just reached. */
static void pass_moves(struct traj *tj)
{
    if (tj->dir > 0) {
        while (tj->cur + 1 != tj->end && tj->place >= traj_cseg(tj, tj->cur)->s1 &&
               traj_cseg(tj, tj->cur + 1)->join != JOIN_REST)
            tj->cur++;
    } else {
        while (tj->cur != tj->first && tj->place <= traj_cseg(tj, tj->cur)->s0) tj->cur--;
    }
}

/* At rest before a move that needs a release? */
static void check_gate(struct traj *tj)
{
    const struct traj_seg *g = traj_cseg(tj, tj->cur);

    tj->waiting = 0;
    if (tj->dir < 0 || tj->in_mark || !traj_at_rest(tj)) return;
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
            start_filter(tj, cell_at(tj, next)->window, cell_at(tj, next)->s0);
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

double traj_stop_distance(const struct traj *tj)
{
    uint32_t index = tj->cell;
    double b = tj->v * tj->v, x = 3 * tj->v * tj->dt + fabs(tj->s - tj->place); /* cycles until it brakes; the filter */

    if (tj->filter.n > 1 && tj->sped < tj->filter.n) x += tj->v * (tj->filter.n - tj->sped) * tj->dt;

    for (int n = 0; n < STOP_SCAN && b > 0; n++) {
        const struct traj_cell *c = &tj->cells[index & (TRAJ_CELLS - 1)];
        double brake = allowed(brakes(tj, c), b), d = c->len;
        if (n == 0) d = tj->dir > 0 ? c->s0 + c->len - tj->s : tj->s - c->s0;
        if (2 * brake * d >= b) return x + b / (2 * brake);
        x += d;
        b -= 2 * fmax(0, brake) * d;
        if (tj->dir > 0 ? ++index == tj->cell_end : index-- == tj->cell_first) break;
    }
    return x;
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

/* The place to stop at lies ahead, and braking from here meets it. */
static int stop_met(const struct traj *tj)
{
    const struct traj_cell *c = ccell_at(tj, tj->cell);
    double d = tj->dir > 0 ? c->s0 + c->len - tj->s : tj->s - c->s0, b = stop_b(tj, &d);
    return b >= 0 && tj->v * tj->v <= ramp_b(brakes(tj, c), b, d) * (1 + 1e-9);
}

/* The envelope, and the place to stop at where `stop`, hold if the speed stays for `cycles` and braking begins then. */
static int can_coast(struct traj *tj, int cycles, int stop)
{
    double left = tj->v * cycles * tj->dt, b = tj->v * tj->v * (1 + 1e-9), s = tj->s, start = tj->s;
    uint32_t cell = tj->cell;
    int good = 0;

    for (int n = 0; n < COAST_SCAN; n++) {
        const struct traj_cell *c = ccell_at(tj, tj->cell);
        double end = tj->dir > 0 ? c->s0 + c->len : c->s0, d = fabs(end - s), b_end;
        if (tj->dir > 0) b_end = tj->cell + 1 == tj->cell_end ? 0 : cell_at(tj, tj->cell + 1)->k;
        else b_end = tj->cell == tj->cell_first ? 0 : c->kr;
        if (b > c->cap) break;
        if (left <= d) {
            good = b <= ramp_b(brakes(tj, c), b_end, d - left);
            if (good && stop) {
                tj->s = s + tj->dir * left;
                good = stop_met(tj);
            }
            break;
        }
        if (b > b_end) break;
        left -= d;
        s = end;
        tj->cell += (uint32_t)tj->dir;
    }
    tj->s = start;
    tj->cell = cell;
    return good;
}

/* What step() may do in this cycle. */
struct leave {
    int brake;
    double top; /* speeding up: to this speed */
};

/* 1: faster, 2: slower, 0: by no more than rounding. */
static int change_of(double from, double to)
{
    double tiny = 1e-9 * from;
    return to > from + tiny ? 1 : to < from - tiny ? 2 : 0;
}

/* One cycle along the path. Returns 1 when motion sped up, 2 when it braked, 3 both. */
static int move_path(struct traj *tj, struct leave may)
{
    double left = tj->dt;
    int did = 0;

    for (int n = 0; n < PORTIONS && left > 1e-9 * tj->dt; n++) {
        struct traj_cell *c = cell_at(tj, tj->cell);
        double end = tj->dir > 0 ? c->s0 + c->len : c->s0;
        double d = tj->dir > 0 ? end - tj->s : tj->s - end;
        tj->n_portions++;
        if (d <= TINY_STEP * (1 + fabs(end))) {
            tj->s = end;
            if (!next_cell(tj)) break;
            continue;
        }
        double b_end, v = tj->v, b = v * v,
                      vt = fmin(target_speed(tj, c), did & 2 ? v : fmax(v, may.top)), ve2, t = left,
                      x;
        if (tj->dir > 0) b_end = tj->cell + 1 == tj->cell_end ? 0 : cell_at(tj, tj->cell + 1)->k;
        else b_end = tj->cell == tj->cell_first ? 0 : c->kr;
        if (!may.brake) vt = fmax(vt, v);
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
        double brake = may.brake ? allowed(brakes(tj, c), b) : 0, low2 = fmax(0, b - 2 * brake * d);

        if (v > vt) { /* too fast: brake to vt */
            double tv = brake > 0 ? (v - vt) / brake : 1e30;
            double xv = (v + vt) / 2 * tv;
            if (tv <= left && xv < d) {
                tj->s += tj->dir * xv;
                tj->v = vt;
                did |= change_of(v, vt);
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
                did |= change_of(v, ve);
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
        did |= change_of(v, v1);
        left = 0;
    }
    return did;
}

/* Where a cycle begins. */
struct step_start {
    double s, v;
    uint32_t cell;
    int stop; /* a place to stop at must be met */
};

/* The cycle from there; did: as move_path(). Returns 1 when the speed it ends with can be kept for `calm` cycles. */
static int try_step(struct traj *tj, const struct step_start *from, struct leave may, int calm, int *did)
{
    tj->s = from->s, tj->v = from->v, tj->cell = from->cell;
    *did = move_path(tj, may);
    return !calm || !(*did & 1) || (*did != 3 && can_coast(tj, calm, from->stop));
}

/* One cycle along the path. With limits of jerk the acceleration of the mean must not turn from one bound to the other:
 * between speeding up and braking the speed stays for the window. So it rises only to what can be kept that long. */
static void step_path(struct traj *tj)
{
    const int calm = tj->filter.n > 1 && !ccell_at(tj, tj->cell)->turns ? tj->filter.n : 0;
    const struct step_start from = { tj->s, tj->v, tj->cell, calm && stop_met(tj) };
    struct leave may = { tj->sped >= calm, tj->braked >= calm ? 1e99 : 0 };
    int did, good = 0;

    if (!try_step(tj, &from, may, calm, &did)) {
        double low = from.v, high = fmax(tj->v, low);
        if (low < (high - low) / 64) { /* from near rest, the speed may become many times of what it is */
            for (int n = 0; n < SLOW_TRIES && !good; n++) {
                may.top = (low + high) / 2;
                good = try_step(tj, &from, may, calm, &did);
                if (!good) high = may.top;
            }
        } else {
            may.top = low + (high - low) / 64;
            good = try_step(tj, &from, may, calm, &did);
        }
        if (good) low = may.top;
        for (int n = 0; n < COAST_TRIES && good; n++) {
            may.top = (low + high) / 2;
            if (try_step(tj, &from, may, calm, &did)) low = may.top;
            else high = may.top;
        }
        may.top = low;
        try_step(tj, &from, may, calm, &did);
    }
    tj->sped = did & 1 ? 0 : tj->sped + (tj->sped < 2 * TRAJ_WINDOW);
    tj->braked = did & 2 ? 0 : tj->braked + (tj->braked < 2 * TRAJ_WINDOW);
}

/* Distance in which the tail must be made final: stopping distance and some time in hand. */
static double tail_guard(const struct traj *tj)
{
    const struct traj_cell *c = ccell_at(tj, tj->cell);
    double acc = traj_cseg(tj, tj->cur)->acc, half = c->window * tj->dt / 2;
    if (half > tj->dt && tj->cell_first != tj->cell_end) acc = fmin(acc, fmax(allowed(c->down, 0), 1e-9));
    double v = tj->v + acc * 10 * tj->dt;
    return 1.5 * v * v / (2 * acc) + v * (GUARD_TIME + 3 * half);
}

/* Place up to which motion may go for now. */
static double known_end(const struct traj *tj)
{
    const struct traj_cell *last = ccell_at(tj, tj->cell_end - 1);
    if (tj->piece_ripe == tj->piece_end) return tj->s_final;
    return tj->cell_end == tj->cell_first ? tj->s : last->s0 + last->len;
}

static void work(struct traj *tj)
{
    if (tj->end == tj->first) return;
    const struct traj_seg *last = traj_cseg(tj, tj->end - 1);
    if (tj->hungry < HUNGRY) tj->hungry++;
    else if (!tj->tail_forced && last->end != TRAJ_STOP && tj->dir > 0 && known_end(tj) - tj->s < tail_guard(tj)) {
        tj->tail_forced = 1;
        tj->n_forced++;
    }
    finish_joins(tj);
    update_final(tj);
    cut_pieces(tj);
    ripen_pieces(tj);
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

/* Takes over the direction asked for, at rest. */
static void set_direction(struct traj *tj)
{
    int dir = tj->drive.reverse ? -1 : 1;

    if (dir == tj->dir || !traj_at_rest(tj) || tj->in_mark) return;
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

/* Moves on along the path for one cycle. */
static void advance(struct traj *tj)
{
    double before = tj->place, speed = tj->speed;

    if (tj->cell_end != tj->cell_first && !tj->in_mark) {
        check_gate(tj);
        /* From rest: with the window of these cells, and when what went before has left the filter. */
        int start = tj->v > 0 || traj_filter_settled(&tj->filter);
        if (start && tj->v <= 0 && tj->filter.n != ccell_at(tj, tj->cell)->window)
            start_filter(tj, ccell_at(tj, tj->cell)->window, tj->s);
        /* Backward, motion begins when its envelope is complete; a later sweep only changes feeds. */
        if (start && !tj->waiting && (tj->dir > 0 || sweep_back(tj) || tj->v > 0)) step_path(tj);
    }
    tj->place = traj_filter_step(&tj->filter, tj->s);
    tj->speed = (tj->place - before) / tj->dt;
    tj->acc = (tj->speed - speed) / tj->dt;
}

void traj_cycle(struct traj *tj)
{
    if (tj->end == tj->first) {
        tj->speed = tj->acc = 0;
        return;
    }
    set_direction(tj);
    work(tj);
    advance(tj);
    retire(tj);
    if (tj->cell_end != tj->cell_first || traj_cseg(tj, tj->cur)->mark) check_gate(tj);
    traj_pose(tj, tj->place, tj->pos);
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
    return tj->v <= 0 && traj_filter_settled(&tj->filter);
}

int traj_blocked(const struct traj *tj)
{
    return tj->blocked && tj->dir > 0 && traj_at_rest(tj) && tj->piece_ripe == tj->piece_end && tj->s >= tj->cut_s;
}

int traj_done(const struct traj *tj)
{
    if (tj->end == tj->first) return 1;
    return traj_at_rest(tj) && tj->dir > 0 && !tj->in_mark && !tj->waiting && tj->cur + 1 == tj->end &&
           tj->s >= traj_cseg(tj, tj->end - 1)->s1;
}

int traj_active(const struct traj *tj)
{
    if (tj->end == tj->first) return 0;
    const struct traj_seg *g = traj_cseg(tj, tj->cur);
    for (uint32_t j = g->lo; (int32_t)(g->hi - j) >= 0; j++)
        if (fabs(tj->place - traj_cseg(tj, j)->s0) < traj_cseg(tj, j)->w) return 2;
    return 1;
}

double traj_acc(const struct traj *tj, uint32_t index)
{
    const struct traj_seg *g = traj_cseg(tj, index);
    double j = traj_jerk(tj, g), window = g->window > 1 ? g->window : 1, turn = g->follow != TRAJ_FEED ? 2 : 1;
    return (j > 0 ? fmin(g->acc, j * window * tj->dt / turn) : g->acc) / g->stretch;
}

double traj_lag(const struct traj *tj)
{
    return (tj->filter.n - 1) * tj->dt / 2;
}
