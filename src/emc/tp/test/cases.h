/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * cases.h - test programs made of named cases: one machine, checks, and main.
 * A file includes it, and ends with `static const struct test_case cases[]` and CASES_MAIN.
 */
#ifndef KERF_TP_TEST_CASES_H
#define KERF_TP_TEST_CASES_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"

struct test_case {
    const char *name;
    void (*run)(void);
    int jerk; /* run again with limits of jerk */
};
#define CASE(f) { #f, f, 0 }
#define CASE_JERK(f) { #f, f, 1 }

static struct bench b;
static int broken;

#define CHECK(cond, ...)                                        \
    do {                                                        \
        if (!(cond)) {                                          \
            broken++;                                           \
            printf("  line %d: %s: ", __LINE__, #cond);         \
            printf(__VA_ARGS__);                                \
            printf("\n");                                       \
        }                                                       \
    } while (0)

static inline void mill_with(double v, double a, double j)
{
    bench_init(&b, 0.001);
    for (int i = 0; i < AXES; i++) bench_axis(&b, i, v, a, j > 0 ? j : 50 * a);
    b.config.maxFeedScale = 2;
    bench_start(&b, j > 0);
}

static double jerk_of_acc; /* of mill(), 1/s; 0 none */

static inline void mill(double v, double a)
{
    mill_with(v, a, jerk_of_acc * a);
}

static inline void limits_kept(void)
{
    CHECK(b.worst_v <= 1.0001, "velocity ratio %g", b.worst_v);
    CHECK(b.worst_a <= 1.0001, "acceleration ratio %g axis %d cycle %llu", b.worst_a,
          b.worst_a_axis, (unsigned long long)b.worst_a_at);
    CHECK(b.worst_j <= 1.001, "jerk ratio %g axis %d cycle %llu", b.worst_j, b.worst_j_axis,
          (unsigned long long)b.worst_j_at);
    CHECK(b.worst_dev <= 1.0001, "deviation ratio %g (%g)", b.worst_dev, b.worst_off);
}

static inline struct prog *go(double x, double y, double z, double feed, int term, double tol)
{
    double p[AXES] = { x, y, z };
    return bench_line(&b, p, feed > 0 ? EMC_MOTION_TYPE_FEED : EMC_MOTION_TYPE_TRAVERSE, feed, term, tol);
}

static inline void send_all(void)
{
    while (b.next < b.n) bench_send(&b);
}

static inline uint64_t finish(uint64_t limit)
{
    uint64_t n = 0;
    while (!tpIsDone(&b.tp) && n < limit) bench_cycle(&b), n++;
    CHECK(tpIsDone(&b.tp), "not done after %llu cycles", (unsigned long long)n);
    return n;
}

/* Runs all cases, or the one named; a line each, exit status 1 when a promise is broken. */
static inline int run_cases(const struct test_case *cases, size_t count, const char *only)
{
    int failed = 0;
    for (size_t i = 0; i < count; i++) {
        if (only && strcmp(only, cases[i].name)) continue;
        bench_verbose = only != NULL;
        for (int jerk = 0; jerk <= cases[i].jerk; jerk++) {
            jerk_of_acc = jerk ? 30 : 0;
            broken = 0;
            cases[i].run();
            printf("%s %s%s\n", broken ? "FAIL" : "ok", cases[i].name, jerk ? " with limits of jerk" : "");
            failed += broken != 0;
        }
    }
    return failed != 0;
}

#define CASES_MAIN                                                                                    \
    int main(int argc, char **argv)                                                                   \
    {                                                                                                 \
        return run_cases(cases, sizeof cases / sizeof *cases, argc > 1 ? argv[1] : NULL);             \
    }

#endif
