/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * basic.c - exploratory runs: prints time and worst ratios of named programs.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"

static void report(struct bench *b, const char *name, uint64_t cycles)
{
    printf("%-28s %9.4f s  v %.4f a %.5f (ax %d at %llu) j %.4f dev %.4f off %.5f %s\n", name, cycles * b->dt,
           b->worst_v, b->worst_a, b->worst_a_axis, (unsigned long long)b->worst_a_at, b->worst_j, b->worst_dev,
           b->worst_off, tpIsDone(&b->tp) && b->next >= b->n ? "" : "NOT DONE");
}

static void mill(struct bench *b, int jerk)
{
    bench_init(b, 0.001);
    for (int i = 0; i < 3; i++) bench_axis(b, i, 500, 1000, 50000);
    bench_start(b, jerk);
}

int main(int argc, char **argv)
{
    int jerk = argc > 1 && atoi(argv[1]);
    struct bench b;
    double p[AXES] = { 0 };
    double zn[3] = { 0, 0, 1 };

    mill(&b, jerk);
    p[0] = 100;
    bench_line(&b, p, EMC_MOTION_TYPE_TRAVERSE, 0, EMCMOT_TERM_COND_BLEND, 0.1);
    report(&b, "line 100 (0.6325)", bench_run(&b, 1, 100000));
    bench_free(&b);

    for (int k = 0; k < 3; k++) {
        double tol = k == 0 ? 0.5 : k == 1 ? 0.05 : 0.0001;
        char name[80];
        mill(&b, jerk);
        double sq[4][2] = { { 20, 0 }, { 20, 20 }, { 0, 20 }, { 0, 0 } };
        for (int i = 0; i < 4; i++) {
            memset(p, 0, sizeof p);
            p[0] = sq[i][0], p[1] = sq[i][1];
            bench_line(&b, p, EMC_MOTION_TYPE_FEED, 500, EMCMOT_TERM_COND_BLEND, tol);
        }
        snprintf(name, sizeof name, "square 20 P%g (.979 1.083)", tol);
        report(&b, name, bench_run(&b, 1, 100000));
        bench_free(&b);
    }

    mill(&b, jerk);
    double c[3] = { 10, 0, 0 };
    memset(p, 0, sizeof p);
    bench_arc(&b, p, c, zn, 0, 500, EMCMOT_TERM_COND_BLEND, 0.01);
    report(&b, "circle R10 (0.7146)", bench_run(&b, 1, 100000));
    bench_free(&b);

    for (int k = 0; k < 2; k++) {
        double chord = k ? 0.05 : 0.1;
        char name[80];
        int n = (int)(2 * M_PI * 10 / chord);
        mill(&b, jerk);
        for (int i = 1; i <= n; i++) {
            double t = 2 * M_PI * i / n;
            memset(p, 0, sizeof p);
            p[0] = floor((10 - 10 * cos(t)) * 1e4 + 0.5) / 1e4;
            p[1] = floor((10 * sin(t)) * 1e4 + 0.5) / 1e4;
            bench_line(&b, p, EMC_MOTION_TYPE_FEED, 500, EMCMOT_TERM_COND_BLEND, 0.01);
        }
        snprintf(name, sizeof name, "circle R10 from %g chords", chord);
        report(&b, name, bench_run(&b, 3, 100000));
        bench_free(&b);
    }

    mill(&b, jerk);
    for (int i = 1; i <= 900; i++) {
        double t = 2 * M_PI * i / 900;
        memset(p, 0, sizeof p);
        p[0] = 30 * sin(2 * t), p[1] = 20 * sin(3 * t + .5) - 20 * sin(.5);
        bench_line(&b, p, EMC_MOTION_TYPE_FEED, 500, EMCMOT_TERM_COND_BLEND, 0.01);
    }
    report(&b, "Lissajous (2.58)", bench_run(&b, 3, 100000));
    bench_free(&b);

    mill(&b, jerk);
    for (int i = 1; i <= 1000; i++) {
        memset(p, 0, sizeof p);
        p[0] = 0.1 * i;
        bench_line(&b, p, EMC_MOTION_TYPE_FEED, 100, EMCMOT_TERM_COND_BLEND, 0.01);
    }
    report(&b, "100 mm of 0.1 at 100 (1.1)", bench_run(&b, 1, 100000));
    bench_free(&b);
    return 0;
}
