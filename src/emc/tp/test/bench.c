/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * bench.c - see bench.h.
 */
#include "bench.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rtapi.h"

int bench_verbose;
char bench_message[300];

static struct bench *active; /* callbacks of the planner have no context */

void rtapi_print_msg(msg_level_t level, const char *fmt, ...)
{
    va_list ap;
    (void)level;
    va_start(ap, fmt);
    vsnprintf(bench_message, sizeof bench_message, fmt, ap);
    va_end(ap);
    if (bench_verbose) fputs(bench_message, stderr);
}

void rtapi_print(const char *fmt, ...)
{
    va_list ap;
    va_start(ap, fmt);
    if (bench_verbose) vfprintf(stderr, fmt, ap);
    va_end(ap);
}

uint64_t rnd(uint64_t *state)
{
    uint64_t z = (*state += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
}

double rnd_unit(uint64_t *state)
{
    return (double)(rnd(state) >> 11) / 9007199254740992.0;
}

double rnd_range(uint64_t *state, double lo, double hi)
{
    return lo + (hi - lo) * rnd_unit(state);
}

double rnd_log(uint64_t *state, double lo, double hi)
{
    return lo * exp(log(hi / lo) * rnd_unit(state));
}

int rnd_int(uint64_t *state, int n)
{
    return (int)(rnd(state) % (uint64_t)n);
}

static void dio(int i, char v)
{
    if (active) active->status.synch_do[i] = v;
}

static void aio(int i, double v)
{
    if (active) active->status.analog_output[i] = v;
}

static void unlock(int joint, int on)
{
    (void)joint, (void)on;
}

static int unlocked(int joint)
{
    (void)joint;
    return 1;
}

static double axis_v(int i)
{
    return active->v[i];
}

static double axis_a(int i)
{
    return active->a[i];
}

static int joints(void)
{
    return active->joints;
}

static int inverse(const EmcPose *pose, double *q)
{
    double p[AXES] = { pose->tran.x, pose->tran.y, pose->tran.z, pose->a, pose->b, pose->c, pose->u, pose->v, pose->w };
    active->inverses++;
    return active->inverse(p, q);
}

static void joint_commands(double *q)
{
    memcpy(q, active->q, sizeof active->q);
}

static void joint_limits(int n, double *v, double *a, double *j)
{
    *v = active->jv[n], *a = active->ja[n], *j = active->jj[n];
}

static double axis_jerk(int i)
{
    return active->j[i];
}

static const struct tp_machine machine = { joints, inverse, joint_commands, joint_limits, axis_jerk };

void bench_joints(struct bench *b, int n, int (*f)(const double p[AXES], double *q))
{
    b->joints = n;
    b->inverse = f;
}

void bench_joint(struct bench *b, int joint, double v, double a, double j)
{
    b->jv[joint] = v, b->ja[joint] = a, b->jj[joint] = j;
}

void bench_init(struct bench *b, double dt)
{
    memset(b, 0, sizeof *b);
    *bench_message = 0;
    b->dt = dt;
    b->check_every = 1;
    b->status.net_feed_scale = 1;
    b->status.feed_scale = 1;
    b->config.maxFeedScale = 1;
    b->config.numSpindles = 1;
    b->status.spindle_status[0].at_speed = 1;
}

void bench_free(struct bench *b)
{
    free(b->tp.impl);
    free(b->prog);
    if (active == b) active = NULL;
}

void bench_axis(struct bench *b, int axis, double v, double a, double j)
{
    b->v[axis] = v;
    b->a[axis] = a;
    b->j[axis] = j;
}

void bench_start(struct bench *b, int jerk_on)
{
    active = b;
    b->jerk_on = jerk_on;
    b->status.planner_type = jerk_on;
    b->status.jerk = 1e9;
    b->status.scurve_peak_scale = 1;
    tpMotFunctions(dio, aio, unlock, unlocked, axis_v, axis_a);
    tpMotMachine(&machine);
    tpMotData(&b->status, &b->config);
    tpCreate(&b->tp, 2000, 0);
    tpSetCycleTime(&b->tp, b->dt);
    EmcPose zero;
    ZERO_EMC_POSE(zero);
    tpSetPos(&b->tp, &zero);
    tpSetVlimit(&b->tp, 1e99);
}

static struct prog *grow(struct bench *b)
{
    if (b->n == b->room) {
        b->room = b->room ? 2 * b->room : 64;
        b->prog = realloc(b->prog, sizeof *b->prog * (size_t)b->room);
        if (!b->prog) abort();
    }
    struct prog *m = &b->prog[b->n++];
    memset(m, 0, sizeof *m);
    memcpy(m->start, b->at, sizeof m->start);
    return m;
}

static double norm3(const double *d)
{
    return sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

/* Limits along a straight displacement, by the rules that task uses. */
static void straight_limits(struct bench *b, const double *d, double *len, double *v, double *a, double *j)
{
    double tv = 0, ta = 0, tj = 0;
    *len = norm3(d);
    if (*len < 1e-8) *len = norm3(d + 6);
    if (*len < 1e-8) *len = norm3(d + 3);
    for (int i = 0; i < AXES; i++) {
        double x = fabs(d[i]);
        if (x < 1e-8 || b->v[i] <= 0) continue;
        tv = fmax(tv, x / b->v[i]);
        ta = fmax(ta, x / b->a[i]);
        if (b->j[i] > 0) tj = fmax(tj, cbrt(x / b->j[i]));
        else tj = 1e30;
    }
    *v = tv > 0 ? *len / tv : 1;
    *a = ta > 0 ? *len / ta : 1;
    *j = tj > 0 && tj < 1e29 ? *len / (tj * tj * tj) : 0;
}

struct prog *bench_line(struct bench *b, const double end[AXES], int canon, double feed, int term, double tol)
{
    struct prog *m = grow(b);
    double d[AXES];
    for (int i = 0; i < AXES; i++) d[i] = end[i] - m->start[i];
    memcpy(m->end, end, sizeof m->end);
    memcpy(b->at, end, sizeof b->at);
    straight_limits(b, d, &m->len, &m->vmax, &m->acc, &m->jerk);
    m->canon = canon;
    m->feed = canon == EMC_MOTION_TYPE_TRAVERSE ? m->vmax : fmin(feed, m->vmax);
    m->term = term;
    m->tol = tol;
    return m;
}

struct prog *bench_arc(struct bench *b, const double end[AXES], const double center[3], const double normal[3],
                       int turn, double feed, int term, double tol)
{
    struct prog *m = grow(b);
    double nn = norm3(normal), s[3], e[3], dir = turn < 0 ? -1 : 1, lift = 0, ends = 0, d[AXES];
    int turns = turn < 0 ? -1 - turn : turn, big = 0;

    m->arc = 1;
    memcpy(m->end, end, sizeof m->end);
    memcpy(m->center, center, sizeof m->center);
    memcpy(m->normal, normal, sizeof m->normal);
    m->turn = turn;
    for (int i = 0; i < 3; i++) m->nz[i] = normal[i] / nn * dir;
    for (int i = 0; i < 3; i++) lift += (m->start[i] - center[i]) * m->nz[i];
    for (int i = 0; i < 3; i++) {
        m->c0[i] = center[i] + lift * m->nz[i];
        s[i] = m->start[i] - m->c0[i];
        e[i] = end[i] - m->c0[i];
    }
    m->rise = e[0] * m->nz[0] + e[1] * m->nz[1] + e[2] * m->nz[2];
    for (int i = 0; i < 3; i++) e[i] -= m->rise * m->nz[i];
    m->radius = norm3(s);
    m->spiral = norm3(e) - m->radius;
    for (int i = 0; i < 3; i++) m->ex[i] = s[i] / m->radius;
    m->ey[0] = m->nz[1] * m->ex[2] - m->nz[2] * m->ex[1];
    m->ey[1] = m->nz[2] * m->ex[0] - m->nz[0] * m->ex[2];
    m->ey[2] = m->nz[0] * m->ex[1] - m->nz[1] * m->ex[0];
    for (int i = 0; i < 3; i++) ends += (e[i] - s[i]) * (e[i] - s[i]);
    m->angle = atan2(e[0] * m->ey[0] + e[1] * m->ey[1] + e[2] * m->ey[2],
                     e[0] * m->ex[0] + e[1] * m->ex[1] + e[2] * m->ex[2]);
    if (sqrt(ends) < 1e-8) m->angle = 2 * M_PI;
    if (m->angle <= 0) m->angle += 2 * M_PI;
    m->angle += 2 * M_PI * turns;

    /* Limits as task computes them: the two slower axes of the plane, centripetal cap. */
    for (int i = 1; i < 3; i++) if (fabs(m->nz[i]) > fabs(m->nz[big])) big = i;
    double v1 = 1e30, a1 = 1e30, j1 = 1e30, len, tv, ta, tj;
    for (int i = 0; i < 3; i++) {
        if (i == big && fabs(m->nz[i]) > 1 - 1e-9) continue;
        v1 = fmin(v1, b->v[i]), a1 = fmin(a1, b->a[i]), j1 = fmin(j1, b->j[i]);
    }
    for (int i = 0; i < AXES; i++) d[i] = end[i] - m->start[i];
    straight_limits(b, d, &len, &tv, &ta, &tj);
    double r = fmin(m->radius, m->radius + m->spiral);
    double planar = hypot((m->radius + m->spiral / 2) * m->angle, m->spiral);
    double v_planar = fmin(sqrt(a1 * sqrt(0.75) * r), v1);
    double total = hypot(planar, m->rise);
    double t = fmax(len > 1e-8 ? len / tv : 0, planar / v_planar);
    m->len = total;
    m->vmax = total / t;
    m->acc = total / fmax(len > 1e-8 ? len / ta : 0, planar / a1);
    m->jerk = j1;
    m->canon = EMC_MOTION_TYPE_ARC;
    m->feed = fmin(feed, m->vmax);
    m->term = term;
    m->tol = tol;
    memcpy(b->at, end, sizeof b->at);
    return m;
}

static EmcPose pose_of(const double p[AXES])
{
    EmcPose pose = { { p[0], p[1], p[2] }, p[3], p[4], p[5], p[6], p[7], p[8] };
    return pose;
}

int bench_send(struct bench *b)
{
    struct state_tag_t tag;
    int r;

    if (b->next >= b->n) return 1;
    struct prog *m = &b->prog[b->next];
    memset(&tag, 0, sizeof tag);
    tag.fields[GM_FIELD_LINE_NUMBER] = b->next;
    tpSetId(&b->tp, b->next + 1);
    tpSetTermCond(&b->tp, m->term, m->tol);
    if (m->arc) {
        PmCartesian c = { m->center[0], m->center[1], m->center[2] };
        PmCartesian n = { m->normal[0], m->normal[1], m->normal[2] };
        r = tpAddCircle(&b->tp, pose_of(m->end), c, n, m->turn, m->canon, m->feed, m->vmax, m->acc,
                        m->jerk, 0xff, 0, tag);
    } else {
        r = tpAddLine(&b->tp, pose_of(m->end), m->canon, m->feed, m->vmax, m->acc, m->jerk, 0xff, 0, -1, tag);
    }
    m->sent = r == 0;
    b->next++;
    return r;
}

/* Point of a move at t in [0, 1]. */
static void point(const struct prog *m, double t, double p[AXES])
{
    for (int i = 0; i < AXES; i++) p[i] = m->start[i] + (m->end[i] - m->start[i]) * t;
    if (!m->arc) return;
    double r = m->radius + m->spiral * t, c = r * cos(m->angle * t), s = r * sin(m->angle * t);
    for (int i = 0; i < 3; i++) p[i] = m->c0[i] + m->ex[i] * c + m->ey[i] * s + m->nz[i] * m->rise * t;
}

/* The longest of the three groups of p - q. */
static double group_dist(const double p[AXES], const double q[AXES])
{
    double d[AXES];
    for (int i = 0; i < AXES; i++) d[i] = p[i] - q[i];
    return fmax(norm3(d), fmax(norm3(d + 3), norm3(d + 6)));
}

static double dist_at(const struct prog *m, double t, const double p[AXES])
{
    double q[AXES];
    point(m, t, q);
    return group_dist(p, q);
}

/* Length of the longest group of an arc. */
static double group_step(const struct prog *m)
{
    double d[AXES];
    for (int i = 0; i < AXES; i++) d[i] = m->end[i] - m->start[i];
    return fmax(m->len, fmax(norm3(d + 3), norm3(d + 6)));
}

static double dist_to(const struct prog *m, const double p[AXES])
{
    if (!m->arc) {
        /* xyz only: exact projection */
        double d[AXES], num = 0, den = 0;
        int others = 0;
        for (int i = 0; i < AXES; i++) {
            d[i] = m->end[i] - m->start[i];
            if (i >= 3 && (d[i] != 0 || p[i] != m->start[i])) others = 1;
        }
        for (int i = 0; i < AXES; i++) num += d[i] * (p[i] - m->start[i]), den += d[i] * d[i];
        double t = den > 0 ? num / den : 0;
        t = t < 0 ? 0 : t > 1 ? 1 : t;
        double best = dist_at(m, t, p);
        if (!others) return best;
        double lo = fmax(0, t - 0.5), hi = fmin(1, t + 0.5);
        for (int n = 0; n < 60; n++) {
            double t1 = lo + (hi - lo) / 3, t2 = hi - (hi - lo) / 3;
            if (dist_at(m, t1, p) < dist_at(m, t2, p)) hi = t2;
            else lo = t1;
        }
        return fmin(best, dist_at(m, (lo + hi) / 2, p));
    }
    /* Coarse samples, then a search around each local minimum that could still be the least. */
    int parts = 8 + (int)(m->angle * 8);
    double best = 1e30, before = 1e30, here = dist_at(m, 0, p);
    for (int n = 0; n <= parts; n++) {
        double after = n < parts ? dist_at(m, (n + 1.0) / parts, p) : 1e30;
        if (here <= before && here <= after && here - 3 * group_step(m) / parts < best) {
            double lo = fmax(0, (n - 1.0) / parts), hi = fmin(1, (n + 1.0) / parts);
            for (int k = 0; k < 50; k++) {
                double t1 = lo + (hi - lo) / 3, t2 = hi - (hi - lo) / 3;
                if (dist_at(m, t1, p) < dist_at(m, t2, p)) hi = t2;
                else lo = t1;
            }
            best = fmin(best, fmin(here, dist_at(m, (lo + hi) / 2, p)));
        }
        before = here, here = after;
    }
    return best;
}

/* The distance is at least this. */
static double at_least(const struct prog *m, const double p[AXES])
{
    double d[3], reach;
    for (int i = 0; i < 3; i++) d[i] = p[i] - (m->arc ? m->c0[i] : (m->start[i] + m->end[i]) / 2);
    if (m->arc) {
        reach = fmax(m->radius, m->radius + m->spiral) + fabs(m->rise);
    } else {
        double e[3] = { m->end[0] - m->start[0], m->end[1] - m->start[1], m->end[2] - m->start[2] };
        reach = norm3(e) / 2;
    }
    return norm3(d) - reach;
}

/* A junction's tolerance is the smaller of its moves' (0 in blend mode: none given). A point near move
 * k may belong to a rounding at either end of it, or of a neighbour that is as near. */
static double tolerance_near(const struct bench *b, int near)
{
    double most = 0;
    for (int k = near - 2; k <= near + 1; k++) {
        if (k < 0 || k + 1 >= b->n) continue;
        double t = 1e30;
        for (int i = k; i <= k + 1; i++) {
            const struct prog *m = &b->prog[i];
            if (m->term != EMCMOT_TERM_COND_BLEND) t = 0;
            else if (m->tol > 0) t = fmin(t, m->tol);
        }
        most = fmax(most, t);
    }
    return most;
}

double bench_distance(struct bench *b, const double p[AXES], double *tol)
{
    double best = 1e30;
    int id = b->status.id > 0 ? b->status.id - 1 : b->near;

    *tol = 0;
    if (b->n == 0) return 0;
    if (id >= b->n) id = b->n - 1;
    int from = id - 40 < 0 ? 0 : id - 40, to = id + 40 >= b->n ? b->n - 1 : id + 40;
    /* nearest first: the executing move and its neighbours usually suffice */
    for (int ring = 0; ring <= 40; ring++) {
        for (int side = -1; side <= 1; side += 2) {
            int k = id + side * ring;
            if (k < from || k > to || !b->prog[k].sent || (ring == 0 && side > 0)) continue;
            if (at_least(&b->prog[k], p) >= best) continue;
            double d = dist_to(&b->prog[k], p);
            if (d < best) best = d, b->near = k;
        }
        if (best < 1e-9) break;
    }
    *tol = fmax(tolerance_near(b, b->near), tolerance_near(b, id));
    return best;
}

/* Differences of the last positions against limits; noise: rounding of a position, in units of its last bit. */
static void check_limits(struct bench *b, int row, const double p[4], double lim_v, double lim_a,
                         double lim_j, double rounding)
{
    double noise = 4e-16 * (fabs(p[0]) + 1) * rounding, dt = b->dt;

    if (b->have < 2) return;
    double v = (fabs(p[0] - p[1]) - 2 * noise) / dt / lim_v;
    if (lim_v <= 0 && p[0] == p[1]) v = 0;
    if (v > b->worst_v) b->worst_v = v, b->worst_v_at = b->cycles, b->worst_v_axis = row;
    if (b->have < 3 || lim_a <= 0) return;
    double a = (fabs(p[0] - 2 * p[1] + p[2]) - 4 * noise) / (dt * dt) / lim_a;
    if (bench_verbose && a > 1.001)
        fprintf(stderr, "cycle %llu: row %d acceleration ratio %g, id %d, position %.9g, steps %g %g\n",
                (unsigned long long)b->cycles, row, a, b->status.id, p[0], p[0] - p[1], p[1] - p[2]);
    if (a > b->worst_a) b->worst_a = a, b->worst_a_at = b->cycles, b->worst_a_axis = row;
    if (b->have < 4 || !b->jerk_on || lim_j <= 0) return;
    double j = (fabs(p[0] - 3 * p[1] + 3 * p[2] - p[3]) - 8 * noise) / (dt * dt * dt) / lim_j;
    if (bench_verbose && j > 1.001)
        fprintf(stderr, "cycle %llu: row %d jerk ratio %g, id %d, position %.9g\n",
                (unsigned long long)b->cycles, row, j, b->status.id, p[0]);
    if (j > b->worst_j) b->worst_j = j, b->worst_j_at = b->cycles, b->worst_j_axis = row;
}

void bench_cycle(struct bench *b)
{
    EmcPose pose;
    double q[AXES];

    tpRunCycle(&b->tp, (long)(b->dt * 1e9));
    tpGetPos(&b->tp, &pose);
    b->status.id = tpGetExecId(&b->tp);
    memmove(b->p[1], b->p[0], sizeof b->p[0] * 3);
    double now[AXES] = { pose.tran.x, pose.tran.y, pose.tran.z, pose.a, pose.b, pose.c, pose.u, pose.v, pose.w };
    memcpy(b->p[0], now, sizeof now);
    if (b->have < 4) b->have++;
    b->cycles++;

    int moved = memcmp(b->p[0], b->p[1], sizeof b->p[0]) != 0;
    for (int i = 0; i < AXES; i++) {
        double p[4] = { b->p[0][i], b->p[1][i], b->p[2][i], b->p[3][i] };
        check_limits(b, i, p, b->v[i], b->a[i], b->j[i], 1);
    }
    if (b->joints) {
        memmove(b->qs[1], b->qs[0], sizeof b->qs[0] * 3);
        b->inverse(now, b->q);
        memcpy(b->qs[0], b->q, sizeof b->q);
        for (int i = 0; i < b->joints; i++) {
            double p[4] = { b->qs[0][i], b->qs[1][i], b->qs[2][i], b->qs[3][i] };
            check_limits(b, AXES + i, p, b->jv[i], b->ja[i], b->jj[i], 100);
        }
    }
    if (moved) b->moving++;
    if (moved && b->cycles % (uint64_t)b->check_every == 0) {
        double tol, off;
        memcpy(q, now, sizeof q);
        off = bench_distance(b, q, &tol);
        double ratio = off / (tol > 1e-6 ? tol : 1e-6);
        if (off > b->worst_off && tol < 1e29) b->worst_off = off;
        if (ratio > b->worst_dev) {
            b->worst_dev = ratio, b->worst_dev_at = b->cycles;
            if (bench_verbose && ratio > 1.001) {
                const struct prog *m = &b->prog[b->near];
                const struct prog *e = &b->prog[b->status.id > 0 ? b->status.id - 1 : 0];
                fprintf(stderr,
                        "executing: %s radius %g angle %g len %g spiral %g rise %g normal %g %g %g "
                        "turn %d: %g off\n",
                        e->arc ? "arc" : "line", e->radius, e->angle, e->len, e->spiral, e->rise,
                        e->normal[0], e->normal[1], e->normal[2], e->turn, dist_to(e, q));
                fprintf(stderr,
                        "cycle %llu: %g off (tolerance %g), move %d (id %d): %s term %d tol %g len "
                        "%g radius %g angle %g\n",
                        (unsigned long long)b->cycles, off, tol, b->near, b->status.id,
                        m->arc ? "arc" : "line", m->term, m->tol, m->len, m->radius, m->angle);
            }
        }
    }
}

void bench_resync(struct bench *b)
{
    EmcPose pose;
    tpGetPos(&b->tp, &pose);
    double now[AXES] = { pose.tran.x, pose.tran.y, pose.tran.z, pose.a, pose.b, pose.c, pose.u, pose.v, pose.w };
    memcpy(b->at, now, sizeof now);
    b->n = b->next = b->near = 0;
}

uint64_t bench_run(struct bench *b, int per_cycle, uint64_t limit)
{
    uint64_t begin = b->cycles;
    while (b->cycles - begin < limit) {
        for (int i = 0; i < per_cycle && b->next < b->n && !tcqFull(&b->tp.queue); i++) bench_send(b);
        bench_cycle(b);
        if (b->next >= b->n && tpIsDone(&b->tp)) break;
    }
    return b->cycles - begin;
}
