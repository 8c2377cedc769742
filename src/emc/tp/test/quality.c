/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * quality.c - what users suffered from in planners, each with the number of the field problem:
 * limits in blends, stops without reason, history, overrides. See cases.h.
 */
#include "cases.h"

static const double up_z[3] = { 0, 0, 1 };

/* Short arcs of radius 4, alternately left and right, as a wave. */
static void wave_of_arcs(double tol)
{
    double p[AXES] = { 0 }, c[3] = { 0 };
    for (int i = 0; i < 60; i++) {
        double turn = 0.9, side = i & 1 ? -1 : 1, x = p[0];
        c[0] = x + 4 * sin(turn / 2), c[1] = -side * 4 * cos(turn / 2), c[2] = 0;
        p[0] = x + 8 * sin(turn / 2);
        bench_arc(&b, p, c, up_z, i & 1 ? 0 : -1, 200, EMCMOT_TERM_COND_BLEND, tol);
    }
}

static void fp_032_a_looser_tolerance_is_never_harsher(void)
{
    double jerk[] = { 0, 40000 };
    for (int k = 0; k < 2; k++) {
        uint64_t before = 0;
        for (double tol = 0.001; tol < 1.1; tol *= 10) {
            mill_with(250, 1750, jerk[k]);
            wave_of_arcs(tol);
            uint64_t n = bench_run(&b, 2, 200000);
            limits_kept();
            CHECK(before == 0 || n <= before * 1.005 + 2,
                  "P %g: %llu cycles, with a tenth of it %llu", tol, (unsigned long long)n,
                  (unsigned long long)before);
            before = n;
            bench_free(&b);
        }
    }
}

static void fp_033_the_tightest_tolerances_keep_limits(void)
{
    /* 20 in/s, 200 in/s^2, from 1e-7 to 0.003 in */
    for (double tol = 1e-7; tol < 0.004; tol *= 3) {
        mill(20, 200);
        for (int i = 1; i <= 40; i++) go(0.2 * i, i & 1 ? 0.15 : 0, 0, 20, EMCMOT_TERM_COND_BLEND, tol);
        for (int i = 1; i <= 200; i++) go(8 + 0.003 * i, 0.001 * (i & 1), 0, 20, EMCMOT_TERM_COND_BLEND, tol);
        bench_run(&b, 1, 200000);
        CHECK(tpIsDone(&b.tp), "P %g: not done", tol);
        limits_kept();
        bench_free(&b);
    }
}

static void fp_034_any_mix_of_linear_and_rotary_travel_keeps_limits(void)
{
    for (double x = 1e-10; x < 1000; x *= 10) {
        mill(300, 1500);
        double p[AXES] = { x, 0, 0, 100 };
        bench_line(&b, p, EMC_MOTION_TYPE_FEED, 100, EMCMOT_TERM_COND_BLEND, 0.1);
        p[0] = 2 * x, p[3] = 0, p[8] = x;
        bench_line(&b, p, EMC_MOTION_TYPE_FEED, 100, EMCMOT_TERM_COND_BLEND, 0.1);
        bench_run(&b, 1, 1000000);
        CHECK(tpIsDone(&b.tp) && b.p[0][3] == 0, "x %g: ends at %g", x, b.p[0][3]);
        limits_kept();
        bench_free(&b);
    }
}

static void fp_037_motion_that_stands_says_why(void)
{
    mill(300, 1500);
    go(10, 0, 0, 1e-300, EMCMOT_TERM_COND_BLEND, 0);
    b.prog[0].feed = 0; /* F0 */
    send_all();
    for (int i = 0; i < 1900; i++) bench_cycle(&b);
    CHECK(!*bench_message, "after 1.9 s: %s", bench_message);
    for (int i = 0; i < 300; i++) bench_cycle(&b);
    CHECK(strstr(bench_message, "line 1 waits: its feed is zero"), "after 2.2 s: %s", bench_message);
    bench_free(&b);
    /* a hold is shown by motmod: no message */
    mill(300, 1500);
    go(10, 0, 0, 1, EMCMOT_TERM_COND_BLEND, 0);
    send_all();
    tpPause(&b.tp);
    for (int i = 0; i < 3000; i++) bench_cycle(&b);
    CHECK(!*bench_message, "paused: %s", bench_message);
    bench_free(&b);
}

static void fp_038_a_full_helix_is_one_as_the_first_move_too(void)
{
    double p[AXES] = { 0, 0, -2 }, c[3] = { 5, 0, 0 }, least = 1e9, most = -1e9;
    mill(300, 1500);
    bench_arc(&b, p, c, up_z, 0, 50, EMCMOT_TERM_COND_BLEND, 0.1);
    send_all();
    while (!tpIsDone(&b.tp) && b.cycles < 5000) {
        bench_cycle(&b);
        least = fmin(least, b.p[0][1]), most = fmax(most, b.p[0][1]);
    }
    CHECK(fabs(most - 5) < 1e-2 && fabs(least + 5) < 1e-2, "y from %g to %g", least, most);
    limits_kept();
    bench_free(&b);
}

/* Slowest speed between leaving the start and nearing the end. */
#define SENDS 8 /* moves a cycle */
static double slowest_on_the_way(double margin_s)
{
    static double speed[100000];
    int n = 0;
    while ((b.next < b.n || !tpIsDone(&b.tp)) && n < 100000) {
        for (int i = 0; i < SENDS && b.next < b.n && !tcqFull(&b.tp.queue); i++) bench_send(&b);
        bench_cycle(&b);
        speed[n++] = b.status.current_vel;
    }
    int margin = (int)(margin_s / b.dt);
    double slow = 1e9;
    for (int i = margin; i < n - margin; i++) slow = fmin(slow, speed[i]);
    CHECK(n > 2 * margin, "only %d cycles", n);
    return slow;
}

static double r4(double x)
{
    return floor(x * 1e4 + 0.5) / 1e4;
}

static void fp_040_chains_tangent_within_rounding_do_not_stop(void)
{
    double jerk[] = { 0, 200000 };
    for (int k = 0; k < 2; k++) {
        double p[AXES] = { 0 }, c[3] = { 0 };
        mill_with(300, 1500, jerk[k]);
        /* helix, then arcs in the plane, then lines, all ends rounded to 4 decimals */
        p[2] = -1;
        c[0] = 10, c[1] = 0;
        bench_arc(&b, p, c, up_z, 0, 50, EMCMOT_TERM_COND_BLEND, 0.01);
        double angle = M_PI, r = 10;
        for (int i = 0; i < 4; i++) {
            double a = angle + 0.7;
            p[0] = r4(10 + r * cos(a)), p[1] = r4(r * sin(a));
            bench_arc(&b, p, c, up_z, 0, 50, EMCMOT_TERM_COND_BLEND, 0.01);
            angle = a;
        }
        p[0] = r4(p[0] - 20 * sin(angle)), p[1] = r4(p[1] + 20 * cos(angle));
        bench_line(&b, p, EMC_MOTION_TYPE_FEED, 50, EMCMOT_TERM_COND_BLEND, 0.01);
        double slow = slowest_on_the_way(0.2);
        CHECK(slow > 25, "slowest %g of 50", slow);
        limits_kept();
        bench_free(&b);
    }
}

/* The work of a cycle has a budget (the defines at the head of each file): it must be enough. */
static void fp_041_many_tiny_moves_with_jerk_limits_keep_the_feed(void)
{
    mill_with(200, 1500, 50000);
    for (int i = 1; i <= 20000; i++) {
        double t = 0.001 * i; /* 0.05 long: two in a cycle */
        go(50 * sin(t), 50 * (1 - cos(t)), 2 * sin(2 * t), 100, EMCMOT_TERM_COND_BLEND, 0.01);
    }
    double slow = slowest_on_the_way(0.3);
    CHECK(slow > 95, "slowest %g of 100", slow);
    limits_kept();
    bench_free(&b);
}

static void fp_042_reverse_and_forward_again_gives_the_same_speeds(void)
{
    /* the time over the last half is the same whether or not it was run back before */
    uint64_t n[2];
    for (int k = 0; k < 2; k++) {
        mill(300, 1500);
        for (int i = 0; i < 120; i++) go(0.5 * (i + 1), sin(0.05 * i), 0, 60, EMCMOT_TERM_COND_BLEND, 0.01);
        send_all();
        while (b.p[0][0] < 30) bench_cycle(&b);
        tpPause(&b.tp);
        for (int i = 0; i < 300; i++) bench_cycle(&b);
        if (k) {
            tpSetRunDir(&b.tp, TC_DIR_REVERSE);
            tpResume(&b.tp);
            while (b.p[0][0] > 20) bench_cycle(&b);
            tpPause(&b.tp);
            for (int i = 0; i < 300; i++) bench_cycle(&b);
            tpSetRunDir(&b.tp, TC_DIR_FORWARD);
        }
        tpResume(&b.tp);
        while (b.p[0][0] < 40) bench_cycle(&b);
        uint64_t from = b.cycles;
        finish(100000);
        n[k] = b.cycles - from;
        limits_kept();
        bench_free(&b);
    }
    CHECK(n[1] <= n[0] + 2 && n[0] <= n[1] + 2, "%llu cycles, after reverse %llu",
          (unsigned long long)n[0], (unsigned long long)n[1]);
}

static void fp_042_moves_that_come_one_by_one_run_as_fast_as_all_at_once(void)
{
    double jerk[] = { 0, 50000 };
    for (int k = 0; k < 2; k++) {
        uint64_t n[2];
        for (int all = 0; all < 2; all++) {
            mill_with(200, 1500, jerk[k]);
            for (int i = 1; i <= 600; i++) {
                double t = 0.01 * i;
                go(30 * sin(t), 30 * (1 - cos(t)), 5 * sin(1.7 * t), 100, EMCMOT_TERM_COND_BLEND, 0.01);
            }
            if (all) send_all();
            n[all] = bench_run(&b, 1, 100000);
            limits_kept();
            bench_free(&b);
        }
        CHECK(n[0] <= n[1] * 1.02 + 20, "%llu cycles, %llu all at once", (unsigned long long)n[0],
              (unsigned long long)n[1]);
    }
}

static void fp_043_five_axis_paths_blend_at_small_angles(void)
{
    mill(300, 1500);
    for (int i = 1; i <= 300; i++) {
        double t = 0.01 * i, p[AXES] = { 30 * t, 5 * sin(t), cos(t) - 1, 20 * sin(t), 0, 15 * t, 0.3 * t };
        bench_line(&b, p, EMC_MOTION_TYPE_FEED, 20, EMCMOT_TERM_COND_BLEND, 0.01);
    }
    double slow = slowest_on_the_way(0.2);
    CHECK(slow > 18, "slowest %g of 20", slow);
    limits_kept();
    bench_free(&b);
}

static void fp_044_with_jerk_limits_an_override_acts_at_any_moment(void)
{
    /* new speed within dv / a + a / j and the planner's window, wherever in the move */
    for (int at = 20; at < 1500; at += 37) {
        mill_with(300, 1000, 20000);
        go(400, 0, 0, 100, EMCMOT_TERM_COND_BLEND, 0.1);
        send_all();
        for (int i = 0; i < at; i++) bench_cycle(&b);
        b.status.net_feed_scale = 0.3;
        for (int i = 0; i < 260; i++) bench_cycle(&b);
        CHECK(fabs(b.status.current_vel - 30) < 1e-6, "cycle %d: speed %g", at, b.status.current_vel);
        b.status.net_feed_scale = 0;
        for (int i = 0; i < 190; i++) bench_cycle(&b);
        CHECK(b.status.current_vel == 0, "cycle %d: speed %g", at, b.status.current_vel);
        b.status.net_feed_scale = 2;
        for (int i = 0; i < 350; i++) bench_cycle(&b);
        CHECK(fabs(b.status.current_vel - 200) < 1e-6, "cycle %d: speed %g", at, b.status.current_vel);
        finish(100000);
        limits_kept();
        bench_free(&b);
        if (broken) return;
    }
}

static void fp_046_tolerance_holds_at_every_override(void)
{
    for (double scale = 0.2; scale < 11; scale *= 3) {
        mill(300, 1500);
        b.config.maxFeedScale = 10;
        b.status.net_feed_scale = scale;
        for (int i = 0; i < 20; i++) go(5 * i + 5, i & 1 ? 0 : 5, 0, 20, EMCMOT_TERM_COND_BLEND, 0.05);
        bench_run(&b, 1, 1000000);
        limits_kept();
        bench_free(&b);
    }
}

static void fp_047_a_lone_move_uses_all_of_the_limits(void)
{
    double lengths[] = { 0.1, 1, 10, 100, 400 };
    for (int k = 0; k < 5; k++) {
        double d = lengths[k], best = d > 250 ? d / 500 + 0.5 : 2 * sqrt(d / 1000), a = 0;
        mill(500, 1000);
        go(d, 0, 0, 0, EMCMOT_TERM_COND_BLEND, 0.1);
        send_all();
        while (!tpIsDone(&b.tp) && b.cycles < 10000) {
            bench_cycle(&b);
            if (b.have > 2) a = fmax(a, fabs(b.p[0][0] - 2 * b.p[1][0] + b.p[2][0]) / (b.dt * b.dt));
        }
        CHECK(b.cycles * b.dt < best + 0.025, "%g mm: %g s, optimum %g s", d, b.cycles * b.dt, best);
        CHECK(a > 950, "%g mm: acceleration %g of 1000", d, a);
        limits_kept();
        bench_free(&b);
    }
}

/* Rest to rest over d with limits of speed, acceleration and jerk. */
static double s_curve_time(double d, double v, double a, double j)
{
    double tj = a / j;
    if (v >= a * tj && d >= v * v / a + v * tj) return d / v + v / a + tj;
    if (d >= 2 * a * tj * tj) return tj + sqrt(tj * tj + 4 * d / a);
    return cbrt(32 * d / j);
}

static void lone_moves_with_jerk_limits_take_little_more_than_the_optimum(void)
{
    for (double d = 0.1; d < 1000; d *= 3) {
        mill_with(500, 1000, 50000);
        go(d, 0, 0, 0, EMCMOT_TERM_COND_BLEND, 0.1);
        send_all();
        finish(100000);
        double t = b.cycles * b.dt, best = s_curve_time(d, 500, 1000, 50000);
        CHECK(t < best + 0.035, "%g mm: %g s, optimum %g s", d, t, best);
        CHECK(b.worst_j > 0.49, "%g mm: jerk ratio %g", d, b.worst_j);
        limits_kept();
        bench_free(&b);
    }
}

static void moves_that_end_at_rest_take_as_long_together_as_alone(void)
{
    static const double corner[][2] = {{3, 7}, {6, 3},  {9, 10},   {2, 6},
                                       {4, 1}, {20, 3}, {20.5, 9}, {1, 1}};
    double jerk[] = { 0, 20000, 100000, 200000 };
    int moves = sizeof corner / sizeof *corner;

    for (int k = 0; k < 4; k++) {
        uint64_t alone = 0, together;
        for (int i = 0; i < moves; i++) {
            mill_with(80, 800, jerk[k]);
            memset(b.at, 0, sizeof b.at);
            go(corner[i][0] - (i ? corner[i - 1][0] : 0), corner[i][1] - (i ? corner[i - 1][1] : 0),
               0, 50, EMCMOT_TERM_COND_EXACT, 0);
            send_all();
            alone += finish(100000);
            bench_free(&b);
        }
        mill_with(80, 800, jerk[k]);
        for (int i = 0; i < moves; i++) go(corner[i][0], corner[i][1], 0, 50, EMCMOT_TERM_COND_EXACT, 0);
        together = bench_run(&b, 1, 100000);
        limits_kept();
        CHECK(together <= alone + 5u * moves, "jerk %g: %llu cycles together, %llu alone", jerk[k],
              (unsigned long long)together, (unsigned long long)alone);
        bench_free(&b);
    }
}

/* Corners too sharp for the tolerance and the jerk are passed at rest where that is faster, with the window of a short
 * move: no slower than moves that each end at rest. */
static void dense_sharp_corners_with_jerk_limits_are_no_slower_than_rests(void)
{
    for (double d = 0.2; d < 10; d *= 3) {
        uint64_t rests = 0;
        for (double tol = 0; tol < 0.2; tol = tol > 0 ? 10 * tol : 0.001) {
            mill_with(100, 1000, 5000);
            for (int i = 1; i <= 40; i++)
                go(d * i, i & 1 ? d : 0, 0, 100, tol > 0 ? EMCMOT_TERM_COND_BLEND : EMCMOT_TERM_COND_STOP, tol);
            uint64_t n = bench_run(&b, 1, 200000);
            limits_kept();
            if (rests == 0) rests = n;
            CHECK(n <= rests * 1.02, "%g mm, P %g: %llu cycles, %llu with rests", d, tol, (unsigned long long)n,
                  (unsigned long long)rests);
            bench_free(&b);
        }
    }
}

/* Unreachable beyond x = 50. */
static int short_arm(const double p[AXES], double *q)
{
    if (p[0] > 50) return -1;
    q[0] = p[0] + 1e-3 * p[0] * p[0], q[1] = p[1], q[2] = p[2];
    return 0;
}

static void a_path_out_of_reach_ends_at_rest_with_a_message(void)
{
    bench_init(&b, 0.001);
    for (int i = 0; i < AXES; i++) bench_axis(&b, i, 300, 1500, 0);
    bench_joints(&b, 3, short_arm);
    for (int i = 0; i < 3; i++) bench_joint(&b, i, 100, 1000, 0);
    bench_start(&b, 0);
    go(100, 0, 0, 100, EMCMOT_TERM_COND_BLEND, 0.1);
    go(100, 10, 0, 100, EMCMOT_TERM_COND_BLEND, 0.1);
    send_all();
    finish(10000);
    CHECK(strstr(bench_message, "kinematicsInverse failed: line 1 cannot be followed"), "%s", bench_message);
    CHECK(b.status.motionFlag & EMCMOT_MOTION_ERROR_BIT, "no error");
    CHECK(b.p[0][0] > 30 && b.p[0][0] <= 50, "rests at %g", b.p[0][0]);
    CHECK(tpQueueDepth(&b.tp) == 0, "%d moves left", tpQueueDepth(&b.tp));
    limits_kept();
    bench_free(&b);
}

static const struct test_case cases[] = {
    CASE(fp_032_a_looser_tolerance_is_never_harsher),
    CASE(fp_033_the_tightest_tolerances_keep_limits),
    CASE(fp_034_any_mix_of_linear_and_rotary_travel_keeps_limits),
    CASE(fp_037_motion_that_stands_says_why),
    CASE(fp_038_a_full_helix_is_one_as_the_first_move_too),
    CASE(fp_040_chains_tangent_within_rounding_do_not_stop),
    CASE(fp_041_many_tiny_moves_with_jerk_limits_keep_the_feed),
    CASE(fp_042_reverse_and_forward_again_gives_the_same_speeds),
    CASE(fp_042_moves_that_come_one_by_one_run_as_fast_as_all_at_once),
    CASE(fp_043_five_axis_paths_blend_at_small_angles),
    CASE(fp_044_with_jerk_limits_an_override_acts_at_any_moment),
    CASE(fp_046_tolerance_holds_at_every_override),
    CASE(fp_047_a_lone_move_uses_all_of_the_limits),
    CASE(lone_moves_with_jerk_limits_take_little_more_than_the_optimum),
    CASE(dense_sharp_corners_with_jerk_limits_are_no_slower_than_rests),
    CASE(moves_that_end_at_rest_take_as_long_together_as_alone),
    CASE(a_path_out_of_reach_ends_at_rest_with_a_message),
};
CASES_MAIN
