/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * optimum.c - time of the planner against a lower bound on the same rounded path.
 *
 *   optimum [-j JERK] [-a ACC] [-v VEL] [-p TOLERANCE] [-f FEED] [FILE.canon...]
 *
 * The bound: the path as run is sampled densely, differentiated numerically, and
 * the highest speed profile found by a backward and a forward pass in which the
 * rows of all axes |q' u + q'' b| <= A are taken with their signs (Pham & Pham 2018,
 * without jerk). Without FILE: shapes of our own.
 */
#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "bench.h"
#include "../traj.h"

static double vel = 500, acc = 1000, jerk = 0, tolerance = 0.01, feed_limit = 1e9, grid = 0.005;
static double dt = 0.001;

struct sample {
    double s, p[3];
    double feed; /* along s */
    int rest;
};
static struct sample *samples;
static size_t count, room;

static void record(double s, const double *p, double feed, int rest)
{
    if (count == room) {
        room = room ? 2 * room : 1 << 16;
        samples = realloc(samples, room * sizeof *samples);
        if (!samples) abort();
    }
    samples[count].s = s;
    memcpy(samples[count].p, p, sizeof samples[count].p);
    samples[count].feed = feed;
    samples[count++].rest = rest;
}

/* One row of a linear programme in (u, b): interval of u at a given b. */
static int interval(const double *d1, const double *d2, double b, double *lo, double *hi)
{
    *lo = -1e30, *hi = 1e30;
    for (int i = 0; i < 3; i++) {
        double c = d2[i] * b;
        if (fabs(d1[i]) < 1e-9) {
            if (fabs(c) > acc * (1 + 1e-9)) return 0;
            continue;
        }
        double x = (-acc - c) / d1[i], y = (acc - c) / d1[i];
        *lo = fmax(*lo, fmin(x, y));
        *hi = fmin(*hi, fmax(x, y));
    }
    return *lo <= *hi;
}

static double lower_bound(void)
{
    size_t n = count;
    double *k = calloc(n, sizeof *k), (*d1)[3] = calloc(n, sizeof *d1), (*d2)[3] = calloc(n, sizeof *d2), t = 0;
    double *cap = calloc(n, sizeof *cap);

    for (size_t i = 0; i < n; i++) {
        size_t a = i > 0 ? i - 1 : i, c = i + 1 < n ? i + 1 : i;
        cap[i] = samples[i].feed * samples[i].feed;
        if (samples[i].rest || a == i || c == i) {
            cap[i] = 0;
        }
        if (c == i) continue;
        if (a == i || samples[i].rest) { /* leaves from rest in the direction of what follows */
            for (int x = 0; x < 3; x++) d1[i][x] = (samples[c].p[x] - samples[i].p[x]) / (samples[c].s - samples[i].s);
            continue;
        }
        double h1 = samples[i].s - samples[a].s, h2 = samples[c].s - samples[i].s;
        for (int x = 0; x < 3; x++) {
            double f1 = (samples[i].p[x] - samples[a].p[x]) / h1, f2 = (samples[c].p[x] - samples[i].p[x]) / h2;
            d1[i][x] = (f1 * h2 + f2 * h1) / (h1 + h2);
            d2[i][x] = samples[i].rest ? 0 : 2 * (f2 - f1) / (h1 + h2);
            if (fabs(d1[i][x]) > 1e-9) cap[i] = fmin(cap[i], vel * vel / (d1[i][x] * d1[i][x]));
        }
        if (samples[a].rest || samples[c].rest) memset(d2[i], 0, sizeof d2[i]);
    }
    /* backward */
    for (size_t i = n - 1; i-- > 0;) {
        double h = samples[i + 1].s - samples[i].s, lo, hi, bl = 0, bh = cap[i];
        for (int m = 0; m < 40; m++) {
            double b = m == 0 ? bh : (bl + bh) / 2;
            int ok = interval(d1[i], d2[i], b, &lo, &hi) && b + 2 * h * lo <= k[i + 1] && b + 2 * h * hi >= 0;
            if (ok) {
                bl = b;
                if (m == 0) break;
            } else {
                bh = b;
            }
        }
        k[i] = bl;
    }
    /* forward, greedy */
    double b = k[0];
    for (size_t i = 0; i + 1 < n; i++) {
        double h = samples[i + 1].s - samples[i].s, lo, hi, next;
        if (!interval(d1[i], d2[i], b, &lo, &hi)) hi = 0;
        next = fmin(k[i + 1], b + 2 * h * hi);
        if (next < 0) next = 0;
        double v = sqrt(b) + sqrt(next);
        if (v > 0) t += 2 * h / v;
        b = next;
    }
    free(k), free(d1), free(d2), free(cap);
    return t;
}

/* Samples the path between two places of the run. */
static void sample_path(struct traj *tj, double from, double to)
{
    int n = (int)ceil((to - from) / grid);
    for (int i = 1; i <= n; i++) {
        double s = from + (to - from) * i / n, p[PATH_AXES];
        uint32_t g = tj->cur;
        while (g != tj->first && s <= traj_cseg(tj, g)->s0) g--;
        const struct traj_seg *q = traj_cseg(tj, g);
        traj_pose(tj, s, p);
        double feed = q->feed < q->vmax ? q->feed : q->vmax;
        record(s, p, feed * q->stretch, 0);
    }
}

static void run(struct bench *b, const char *name, int per_cycle)
{
    static struct traj tj;
    double zero[PATH_AXES] = { 0 }, last = 0, worst_a = 0, worst_j = 0, p1[PATH_AXES], p2[PATH_AXES], p3[PATH_AXES];
    uint64_t cycles = 0, moving = 0;
    struct timespec t0, t1;
    double busy = 0, most = 0;

    traj_init(&tj, dt);
    for (int i = 0; i < PATH_AXES; i++) tj.lim.v[i] = vel, tj.lim.a[i] = acc, tj.lim.j[i] = jerk;
    tj.lim.jerk_on = jerk > 0;
    traj_reset(&tj, zero);
    tj.drive.vlimit = 1e99;
    tj.drive.max_scale = 1;
    count = 0;
    record(0, zero, 1e9, 1);
    memset(p1, 0, sizeof p1);
    memset(p2, 0, sizeof p2);
    memset(p3, 0, sizeof p3);
    while (cycles < 100000000) {
        clock_gettime(CLOCK_MONOTONIC, &t0);
        for (int i = 0; i < per_cycle && b->next < b->n && tj.end - tj.cur < 1780; i++) {
            struct prog *m = &b->prog[b->next++];
            struct traj_move move = { .feed = m->feed, .vmax = m->vmax, .acc = m->acc, .jerk = jerk, .tol = m->tol,
                                      .end = (enum traj_end)m->term };
            enum path_result r = m->arc ? path_arc(&move.prim, m->start, m->end, m->center, m->normal, m->turn)
                                        : path_line(&move.prim, m->start, m->end);
            if (r != PATH_OK) continue;
            move.rest_before = b->next > 1 && (m->canon == EMC_MOTION_TYPE_TRAVERSE) !=
                                                  (m[-1].canon == EMC_MOTION_TYPE_TRAVERSE);
            traj_append(&tj, &move);
        }
        if (traj_waiting(&tj) >= 0) {
            if (count > 1) samples[count - 1].rest = 1;
            traj_release(&tj);
        }
        traj_cycle(&tj);
        clock_gettime(CLOCK_MONOTONIC, &t1);
        double us = (t1.tv_sec - t0.tv_sec) * 1e6 + (t1.tv_nsec - t0.tv_nsec) / 1e3;
        busy += us;
        if (us > most) most = us;
        if (tj.s > last) sample_path(&tj, last, tj.s), last = tj.s, moving++;
        for (int i = 0; i < 3; i++) worst_a = fmax(worst_a, fabs(tj.pos[i] - 2 * p1[i] + p2[i]) / (dt * dt));
        for (int i = 0; i < 3; i++)
            worst_j = fmax(worst_j, fabs(tj.pos[i] - 3 * p1[i] + 3 * p2[i] - p3[i]) / (dt * dt * dt));
        memcpy(p3, p2, sizeof p3);
        memcpy(p2, p1, sizeof p2);
        memcpy(p1, tj.pos, sizeof p1);
        cycles++;
        if (b->next >= b->n && traj_done(&tj)) break;
    }
    double bound = lower_bound(), t = cycles * dt;
    printf("%-26s %6d moves %9.4f s, bound %9.4f s, ratio %.4f; acceleration %.5f jerk %.4f; %5.2f "
           "us/cycle, worst %6.1f; rests %llu forced %llu\n",
           name, b->n, t, bound, t / bound, worst_a / acc, jerk > 0 ? worst_j / jerk : 0,
           busy / cycles, most, (unsigned long long)tj.n_rest, (unsigned long long)tj.n_forced);
    fflush(stdout);
}

static void begin(struct bench *b)
{
    bench_init(b, dt);
    for (int i = 0; i < AXES; i++) bench_axis(b, i, vel, acc, jerk);
}

/* Reads canonical calls as `rs274` prints them. */
static int read_canon(struct bench *b, const char *path)
{
    FILE *f = fopen(path, "r");
    char line[1000];
    double feed = 100, tol = tolerance;
    int term = EMCMOT_TERM_COND_BLEND, plane = 2;

    if (!f) return 0;
    while (fgets(line, sizeof line, f)) {
        char *c;
        double p[AXES] = { 0 }, e1, e2, a1, a2, axis;
        int rot;
        if ((c = strstr(line, "SET_MOTION_CONTROL_MODE("))) {
            if (strstr(c, "EXACT_STOP")) term = EMCMOT_TERM_COND_STOP;
            else if (strstr(c, "EXACT_PATH")) term = EMCMOT_TERM_COND_EXACT;
            else {
                term = EMCMOT_TERM_COND_BLEND;
                if ((c = strchr(c, ','))) tol = atof(c + 1);
            }
        } else if ((c = strstr(line, "SELECT_PLANE("))) {
            plane = strstr(c, "XY") ? 2 : strstr(c, "YZ") ? 0 : 1;
        } else if ((c = strstr(line, "SET_FEED_RATE("))) {
            feed = atof(c + 14) / 60;
        } else if ((c = strstr(line, "STRAIGHT_TRAVERSE(")) && sscanf(c + 18, "%lf, %lf, %lf", p, p + 1, p + 2) == 3) {
            bench_line(b, p, EMC_MOTION_TYPE_TRAVERSE, 0, term, term == EMCMOT_TERM_COND_BLEND ? tol : 0);
        } else if ((c = strstr(line, "STRAIGHT_FEED(")) && sscanf(c + 14, "%lf, %lf, %lf", p, p + 1, p + 2) == 3) {
            bench_line(b, p, EMC_MOTION_TYPE_FEED, fmin(feed, feed_limit), term,
                       term == EMCMOT_TERM_COND_BLEND ? tol : 0);
        } else if ((c = strstr(line, "ARC_FEED(")) &&
                   sscanf(c + 9, "%lf, %lf, %lf, %lf, %d, %lf", &e1, &e2, &a1, &a2, &rot, &axis) == 6) {
            int i1 = (plane + 1) % 3, i2 = (plane + 2) % 3;
            double center[3], normal[3] = { 0 };
            p[i1] = e1, p[i2] = e2, p[plane] = axis;
            center[i1] = a1, center[i2] = a2, center[plane] = axis;
            normal[plane] = 1;
            bench_arc(b, p, center, normal, rot > 0 ? rot - 1 : rot, fmin(feed, feed_limit), term,
                      term == EMCMOT_TERM_COND_BLEND ? tol : 0);
        }
    }
    fclose(f);
    return 1;
}

static void shapes(void)
{
    struct bench b;
    double p[AXES] = { 0 }, F = fmin(vel, feed_limit);
    char name[100];

    for (double tol = 0.5; tol > 1e-4; tol /= 10) {
        begin(&b);
        double sq[4][2] = { { 20, 0 }, { 20, 20 }, { 0, 20 }, { 0, 0 } };
        for (int i = 0; i < 4; i++) {
            memset(p, 0, sizeof p);
            p[0] = sq[i][0], p[1] = sq[i][1];
            bench_line(&b, p, EMC_MOTION_TYPE_FEED, F, EMCMOT_TERM_COND_BLEND, tol);
        }
        snprintf(name, sizeof name, "square 20, P %g", tol);
        run(&b, name, 1);
        bench_free(&b);
    }
    for (double chord = 2; chord > 0.015; chord /= 5) {
        begin(&b);
        int n = (int)(2 * M_PI * 10 / chord);
        for (int i = 1; i <= n; i++) {
            double t = 2 * M_PI * i / n;
            memset(p, 0, sizeof p);
            p[0] = floor((10 - 10 * cos(t)) * 1e4 + 0.5) / 1e4;
            p[1] = floor((10 * sin(t)) * 1e4 + 0.5) / 1e4;
            bench_line(&b, p, EMC_MOTION_TYPE_FEED, F, EMCMOT_TERM_COND_BLEND, tolerance);
        }
        snprintf(name, sizeof name, "circle R10, chords %g", chord);
        run(&b, name, 4);
        bench_free(&b);
    }
    for (int n = 300; n <= 8100; n *= 3) {
        begin(&b);
        for (int i = 1; i <= n; i++) {
            double t = 2 * M_PI * i / n;
            memset(p, 0, sizeof p);
            p[0] = 30 * sin(2 * t), p[1] = 20 * sin(3 * t + .5) - 20 * sin(.5);
            bench_line(&b, p, EMC_MOTION_TYPE_FEED, F, EMCMOT_TERM_COND_BLEND, tolerance);
        }
        snprintf(name, sizeof name, "Lissajous, %d chords", n);
        run(&b, name, 10);
        bench_free(&b);
    }
    begin(&b);
    for (int i = 0; i < 60; i++) {
        memset(p, 0, sizeof p);
        p[0] = i * 2 + 2, p[1] = i & 1 ? 0 : 2;
        bench_line(&b, p, EMC_MOTION_TYPE_FEED, F, EMCMOT_TERM_COND_BLEND, tolerance);
    }
    run(&b, "zigzag 2 mm", 1);
    bench_free(&b);
    begin(&b);
    for (int i = 0; i < 40; i++) {
        double c[3] = { 0 }, n[3] = { 0, 0, 1 };
        memcpy(p, b.at, sizeof p);
        c[0] = p[0] + 4, c[1] = p[1];
        p[0] += 8;
        struct prog *m = bench_arc(&b, p, c, n, i & 1 ? 0 : -1, F, EMCMOT_TERM_COND_BLEND, tolerance);
        m->vmax = m->feed = F;
    }
    run(&b, "wave of arcs R4", 1);
    bench_free(&b);
}

int main(int argc, char **argv)
{
    int c;
    while ((c = getopt(argc, argv, "j:a:v:p:f:g:t:")) != -1) {
        switch (c) {
        case 'j': jerk = atof(optarg); break;
        case 'a': acc = atof(optarg); break;
        case 'v': vel = atof(optarg); break;
        case 'p': tolerance = atof(optarg); break;
        case 'f': feed_limit = atof(optarg); break;
        case 'g': grid = atof(optarg); break;
        case 't': dt = atof(optarg); break;
        default: return 2;
        }
    }
    if (optind == argc) shapes();
    for (; optind < argc; optind++) {
        struct bench b;
        begin(&b);
        if (!read_canon(&b, argv[optind])) {
            fprintf(stderr, "%s: cannot be read\n", argv[optind]);
            return 1;
        }
        const char *slash = strrchr(argv[optind], '/');
        run(&b, slash ? slash + 1 : argv[optind], 1);
        bench_free(&b);
    }
    free(samples);
    return 0;
}
