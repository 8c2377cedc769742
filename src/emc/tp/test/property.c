/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * property.c - random programs with random events; every cycle must keep the promises.
 *
 *   property [-s FIRST] [-n COUNT] [-j] [-k kinematics] [-v] [-1 SEED]
 *
 * Each seed makes a machine (limits of nine axes), a program (lines, arcs,
 * helices, short segments; exact and blended) and a story (overrides, pauses,
 * aborts, steps, reverse runs, starvation). Checked in each cycle by the bench:
 * velocity, acceleration and jerk of every axis, distance from the program.
 * Checked at the end: the program's end point is reached exactly.
 */
#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "machines.h"

#define LIMIT_RATIO 1.001

struct totals {
    uint64_t cycles, moves, programs;
    double v, a, j, dev;
};

static const struct machine *kins; /* of the machines, NULL axes only */

/* Is p, and all that is nearer than reach, on the machine? */
static int on_machine(const double p[3], double reach)
{
    for (int i = 0; kins && kins->box > 0 && i < 3; i++)
        if (fabs(p[i]) + reach > kins->box) return 0;
    return 1;
}

static void onto_machine(double p[AXES])
{
    for (int i = 0; kins && kins->box > 0 && i < 3; i++) p[i] = fmax(-kins->box, fmin(kins->box, p[i]));
    if (kins && kins->axes & 2) p[3] = fmax(-80, fmin(80, p[3]));
}

static void random_machine(struct bench *b, uint64_t *r, int jerk)
{
    static const double periods[] = { 0.001, 0.001, 0.0005, 0.002, 0.00025 };
    bench_init(b, periods[rnd_int(r, 5)]);
    int same = rnd_int(r, 3) == 0;
    double v = rnd_log(r, 5, 1000), a = rnd_log(r, 20, 10000), j = a * rnd_log(r, 5, 200);
    for (int i = 0; i < AXES; i++) {
        if (!same) v = rnd_log(r, 5, 1000), a = rnd_log(r, 20, 10000), j = a * rnd_log(r, 5, 200);
        bench_axis(b, i, v, a, j);
    }
    static const double max_scale[] = { 1, 1.2, 2, 5 };
    b->config.maxFeedScale = max_scale[rnd_int(r, 4)];
    if (kins) {
        bench_joints(b, kins->joints, kins->inverse);
        for (int n = 0; n < kins->joints; n++) {
            double vj = rnd_log(r, 5, 1000), aj = rnd_log(r, 20, 10000);
            bench_joint(b, n, vj, aj, rnd_int(r, 5) ? aj * rnd_log(r, 5, 200) : 0);
        }
    }
    bench_start(b, jerk);
}

/* A unit vector. */
static void direction(uint64_t *r, double d[3])
{
    double n;
    do {
        for (int i = 0; i < 3; i++) d[i] = rnd_range(r, -1, 1);
        n = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    } while (n < 0.1 || n > 1);
    for (int i = 0; i < 3; i++) d[i] /= n;
}

static double random_feed(uint64_t *r)
{
    return rnd_log(r, 5, 1000);
}

static void random_line(struct bench *b, uint64_t *r, double scale, int axes, double feed, int term, double tol)
{
    double p[AXES], d[3];
    double len = scale * rnd_log(r, 0.02, 3);
    memcpy(p, b->at, sizeof p);
    direction(r, d);
    if (axes & 1) for (int i = 0; i < 3; i++) p[i] += d[i] * len;
    if (axes & 8) p[rnd_int(r, 3)] += len * (rnd_int(r, 2) ? 1 : -1);
    if (axes & 2) for (int i = 3; i < 6; i++) p[i] += rnd_range(r, -1, 1) * len;
    if (axes & 4) for (int i = 6; i < 9; i++) p[i] += rnd_range(r, -1, 1) * len;
    onto_machine(p);
    bench_line(b, p, EMC_MOTION_TYPE_FEED, feed, term, tol);
}

static void random_arc(struct bench *b, uint64_t *r, double scale, int axes, double feed, int term, double tol)
{
    double p[AXES], radius = scale * rnd_log(r, 0.02, 2), c[3], n[3] = { 0, 0, 0 }, u[3], w[3];
    int plane = rnd_int(r, 4);

    memcpy(p, b->at, sizeof p);
    if (plane < 3) n[plane] = 1;
    else direction(r, n);
    /* a direction in the plane */
    double k;
    do {
        direction(r, u);
        k = u[0] * n[0] + u[1] * n[1] + u[2] * n[2];
    } while (fabs(k) > 0.9);
    for (int i = 0; i < 3; i++) u[i] -= k * n[i];
    k = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    for (int i = 0; i < 3; i++) u[i] /= k;
    w[0] = n[1] * u[2] - n[2] * u[1];
    w[1] = n[2] * u[0] - n[0] * u[2];
    w[2] = n[0] * u[1] - n[1] * u[0];
    double angle = rnd_range(r, 0.02, 2 * M_PI), rise = rnd_int(r, 3) ? 0 : rnd_range(r, -1, 1) * scale;
    double drift = rnd_int(r, 4) ? 1 : 1 + rnd_range(r, -1e-3, 1e-3);
    int turn = rnd_int(r, 2) ? 0 : -1, full = rnd_int(r, 5) == 0, turns = rnd_int(r, 6) ? 0 : rnd_int(r, 4);
    if (turn < 0) angle = -angle;
    for (int i = 0; i < 3; i++) {
        c[i] = p[i] - radius * u[i];
        if (!full) p[i] = c[i] + drift * radius * (u[i] * cos(angle) + w[i] * sin(angle));
        p[i] += n[i] * rise;
    }
    if (axes & 2) for (int i = 3; i < 6; i++) p[i] += rnd_range(r, -1, 1) * scale;
    if (axes & 4) for (int i = 6; i < 9; i++) p[i] += rnd_range(r, -1, 1) * scale;
    if (!on_machine(c, radius + fabs(rise))) {
        random_line(b, r, scale, axes, feed, term, tol);
        return;
    }
    onto_machine(p);
    bench_arc(b, p, c, n, turn < 0 ? -1 - turns : turns, feed, term, tol);
}

/* A curve in short chords, rounded to 4 decimals as CAM does. */
static void random_chords(struct bench *b, uint64_t *r, double feed, double tol)
{
    double base[AXES], radius = rnd_log(r, 0.5, 50), chord = rnd_log(r, 0.01, 1), p[AXES];
    double f1 = rnd_range(r, 0.3, 3), f2 = rnd_range(r, 0.3, 3), ph = rnd_range(r, 0, 6);
    int n = 20 + rnd_int(r, 100), five = rnd_int(r, 4) == 0;
    memcpy(base, b->at, sizeof base);
    for (int i = 1; i <= n; i++) {
        double t = i * chord / radius;
        memcpy(p, base, sizeof p);
        p[0] += radius * sin(f1 * t);
        p[1] += radius * (cos(f2 * t + ph) - cos(ph));
        p[2] += 0.2 * radius * sin(t);
        if (five) p[3] += 20 * sin(t), p[5] += 30 * (1 - cos(t));
        if (!on_machine(p, 0)) break;
        for (int k = 0; k < AXES; k++) p[k] = floor(p[k] * 1e4 + 0.5) / 1e4;
        bench_line(b, p, EMC_MOTION_TYPE_FEED, feed, EMCMOT_TERM_COND_BLEND, tol);
    }
}

static void random_program(struct bench *b, uint64_t *r)
{
    int groups = 1 + rnd_int(r, 5);
    for (int g = 0; g < groups; g++) {
        double feed = random_feed(r), tol = rnd_int(r, 4) ? rnd_log(r, 1e-4, 1) : 0, scale = rnd_log(r, 0.05, 50);
        int term = rnd_int(r, 6)   ? EMCMOT_TERM_COND_BLEND
                   : rnd_int(r, 2) ? EMCMOT_TERM_COND_STOP
                                   : EMCMOT_TERM_COND_EXACT;
        int axes = rnd_int(r, 3)   ? 1
                   : rnd_int(r, 2) ? 8
                                   : 1 + rnd_int(r, 7),
            kind = rnd_int(r, 6), n = 1 + rnd_int(r, 15);
        if (term != EMCMOT_TERM_COND_BLEND) tol = 0;
        if (kins) axes = axes & 8 ? kins->axes & 2 ? 3 : 1 : axes & kins->axes;
        if (!axes) axes = 1;
        if (kind == 0) {
            random_chords(b, r, feed, tol);
            continue;
        }
        for (int i = 0; i < n; i++) {
            if (rnd_int(r, 8) == 0) feed = random_feed(r);
            if (kind >= 2 && rnd_int(r, 2)) random_arc(b, r, scale, axes, feed, term, tol);
            else random_line(b, r, scale, axes, feed, term, tol);
            if (rnd_int(r, 20) == 0) {
                double p[AXES];
                memcpy(p, b->at, sizeof p);
                for (int k = 0; k < 3; k++) p[k] += rnd_range(r, -1, 1) * scale;
                onto_machine(p);
                bench_line(b, p, EMC_MOTION_TYPE_TRAVERSE, 0, term, tol);
            }
        }
    }
}

/* One program. 0: all promises kept. */
static int run_seed(uint64_t seed, int jerk, int verbose, struct totals *sum)
{
    uint64_t r = seed * 2654435761u + 12345;
    struct bench b;
    int calm, failed = 0;
    uint64_t limit, idle = 0, story = 20000; /* events end */
    double scale_to = 1;

    random_machine(&b, &r, jerk);
    random_program(&b, &r);
    b.check_every = 5;
    calm = rnd_int(&r, 4) == 0;
    int starve = rnd_int(&r, 3) == 0, continuous = rnd_int(&r, 4) == 0, paused = 0, aborted = 0, stepping = 0;
    int abort_allowed = rnd_int(&r, 3) == 0;
    double event = calm ? 0 : rnd_log(&r, 1e-3, 0.05);
    limit = 2000000;
    int per_cycle = 1 + rnd_int(&r, 3);
    uint64_t moves = (uint64_t)b.n;

    while (b.cycles < limit) {
        if (!starve || rnd_int(&r, 20) == 0)
            for (int i = 0; i < per_cycle && b.next < b.n && !tcqFull(&b.tp.queue) && !aborted; i++) bench_send(&b);
        if (rnd_unit(&r) < event && b.cycles < story) {
            switch (rnd_int(&r, abort_allowed ? 8 : 7)) {
            case 0: scale_to = 0; break;
            case 1: scale_to = 1; break;
            case 2: scale_to = b.config.maxFeedScale; break;
            case 3: scale_to = rnd_range(&r, 0, b.config.maxFeedScale); break;
            case 4: tpPause(&b.tp), paused = 1; break;
            case 5: tpResume(&b.tp), paused = 0; break;
            case 6:
                tpResume(&b.tp), paused = 0;
                tpSetRunDir(&b.tp, rnd_int(&r, 2));
                break;
            case 7: tpAbort(&b.tp), aborted = 1; break;
            }
        }
        if (continuous && !calm) b.status.net_feed_scale = rnd_range(&r, 0, b.config.maxFeedScale);
        else b.status.net_feed_scale = scale_to;
        if (b.cycles == story) {
            tpResume(&b.tp), paused = 0;
            continuous = 0, scale_to = b.config.maxFeedScale, starve = 0;
        }
        if (b.cycles > story || idle > 3000) {
            if (b.tp.reverse_run) tpSetRunDir(&b.tp, TC_DIR_FORWARD);
            if (paused) tpResume(&b.tp), paused = 0;
            scale_to = 1, continuous = 0;
            idle = 0;
        }
        uint64_t moving = b.moving;
        bench_cycle(&b);
        idle = b.moving == moving ? idle + 1 : 0;
        if (aborted && tpIsDone(&b.tp)) {
            /* the rest of the program from where it stopped */
            double p[AXES];
            bench_resync(&b);
            memcpy(p, b.at, sizeof p);
            p[0] += 1;
            onto_machine(p);
            bench_line(&b, p, EMC_MOTION_TYPE_FEED, 10, EMCMOT_TERM_COND_BLEND, 0.1);
            aborted = 0, paused = 0;
            abort_allowed = 0;
        }
        if (b.next >= b.n && tpIsDone(&b.tp)) break;
    }
    (void)stepping;
    EmcPose pose;
    tpGetPos(&b.tp, &pose);
    double now[AXES] = {pose.tran.x, pose.tran.y, pose.tran.z, pose.a, pose.b,
                        pose.c,      pose.u,      pose.v,      pose.w},
           end_off = 0;
    for (int i = 0; i < AXES; i++) end_off = fmax(end_off, fabs(now[i] - b.at[i]));
    const char *why = NULL;
    if (!tpIsDone(&b.tp) || b.next < b.n) why = "not finished";
    else if (end_off > 2e-8) why = "end point missed";
    else if (b.worst_v > LIMIT_RATIO) why = "velocity";
    else if (b.worst_a > LIMIT_RATIO) why = "acceleration";
    else if (b.worst_j > LIMIT_RATIO) why = "jerk";
    else if (b.worst_dev > 1.001) why = "deviation";
    if (why) failed = 1;
    if (why || verbose)
        printf("seed %llu: %s; v %.5f (axis %d cycle %llu) a %.5f (axis %d cycle %llu) j %.5f "
               "(axis %d cycle %llu) dev %.4f (%.6f, cycle %llu) end %.2g; %d moves %llu cycles\n",
               (unsigned long long)seed, why ? why : "ok", b.worst_v, b.worst_v_axis,
               (unsigned long long)b.worst_v_at, b.worst_a, b.worst_a_axis,
               (unsigned long long)b.worst_a_at, b.worst_j, b.worst_j_axis,
               (unsigned long long)b.worst_j_at, b.worst_dev, b.worst_off,
               (unsigned long long)b.worst_dev_at, end_off, b.n, (unsigned long long)b.cycles);
    sum->cycles += b.cycles;
    sum->moves += moves;
    sum->programs++;
    sum->v = fmax(sum->v, b.worst_v);
    sum->a = fmax(sum->a, b.worst_a);
    sum->j = fmax(sum->j, b.worst_j);
    sum->dev = fmax(sum->dev, b.worst_dev);
    bench_free(&b);
    return failed;
}

int main(int argc, char **argv)
{
    uint64_t first = 1, count = 200;
    int jerk = 0, verbose = 0, c, failed = 0;
    struct totals sum = { 0, 0, 0, 0, 0, 0, 0 };

    while ((c = getopt(argc, argv, "s:n:jk:v1:")) != -1) {
        switch (c) {
        case 's': first = strtoull(optarg, NULL, 10); break;
        case 'n': count = strtoull(optarg, NULL, 10); break;
        case 'j': jerk = 1; break;
        case 'k':
            kins = machine_named(optarg);
            if (!kins) {
                fprintf(stderr, "%s: no kinematics of this name\n", optarg);
                return 2;
            }
            break;
        case 'v': verbose = 1; bench_verbose = 1; break;
        case '1': first = strtoull(optarg, NULL, 10), count = 1, verbose = 1; break;
        default: fprintf(stderr, "usage: %s [-s first] [-n count] [-j] [-v] [-1 seed]\n", argv[0]); return 2;
        }
    }
    for (uint64_t s = first; s < first + count; s++) failed += run_seed(s, jerk, verbose, &sum);
    printf("%llu programs, %llu moves, %llu cycles; worst ratios: velocity %.6f acceleration %.6f "
           "jerk %.6f deviation %.4f; %d failed\n",
           (unsigned long long)sum.programs, (unsigned long long)sum.moves,
           (unsigned long long)sum.cycles, sum.v, sum.a, sum.j, sum.dev, failed);
    return failed != 0;
}
