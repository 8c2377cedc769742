/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * api.c - named promises of the planner's interface. Prints one line per promise;
 * exit status 1 when one is broken. `api NAME` runs one only.
 */
#include "cases.h"

/* ---- the spindle of the bench: position integrates speed, encoder with index ---- */

struct spin {
    double revs, speed;   /* as the encoder sees it; rev/s */
    double target, accel; /* rev/s, rev/s^2 */
    double total;         /* revolutions since ever, for phase */
    double counts;        /* per revolution, 0 ideal */
    int counts_on;        /* the request of an index is answered at once, nothing is reset */
};

static void spin_cycle(struct spin *s)
{
    struct spindle_status *sp = &b.status.spindle_status[0];
    double dv = s->accel * b.dt, before = s->total;
    s->speed += fmax(-dv, fmin(dv, s->target - s->speed));
    s->total += s->speed * b.dt;
    s->revs += s->speed * b.dt;
    if (s->counts_on) sp->spindle_index_enable = 0;
    if (sp->spindle_index_enable && floor(s->total) != floor(before)) {
        s->revs = s->total - floor(s->total); /* counting begins at the index mark */
        sp->spindle_index_enable = 0;
    }
    sp->spindleRevs = s->counts > 0 ? floor(s->revs * s->counts) / s->counts : s->revs;
    sp->spindleSpeedIn = s->speed;
}

static void spin_start(struct spin *s, double rps)
{
    memset(s, 0, sizeof *s);
    s->speed = s->target = rps;
    s->accel = 1e9;
    s->total = 0.37;
    b.status.spindle_status[0].speed = rps * 60;
    b.status.spindle_status[0].direction = rps < 0 ? -1 : 1;
}

/* ---- cases ----------------------------------------------------------------------- */

static void a_single_move_takes_the_optimal_time(void)
{
    mill(500, 1000);
    go(100, 0, 0, 0, EMCMOT_TERM_COND_BLEND, 0.1);
    send_all();
    uint64_t n = finish(10000);
    double best = 2 * sqrt(100 / 1000.0);
    CHECK(n * b.dt < best + 0.003, "%g s, optimum %g s", n * b.dt, best);
    CHECK(b.p[0][0] == 100, "end %.17g", b.p[0][0]);
    limits_kept();
    bench_free(&b);
}

static void collinear_pieces_run_as_one_line(void)
{
    uint64_t n[2];
    for (int k = 0; k < 2; k++) {
        int pieces = k ? 1000 : 1;
        mill(500, 1000);
        for (int i = 1; i <= pieces; i++)
            go(100.0 * i / pieces, 40.0 * i / pieces, 0, 200, EMCMOT_TERM_COND_BLEND, 0.01);
        n[k] = bench_run(&b, 4, 100000); /* one a cycle would limit the speed to 0.1 mm a cycle */
        limits_kept();
        bench_free(&b);
    }
    CHECK(n[1] <= n[0] + 2, "%llu cycles in pieces, %llu in one", (unsigned long long)n[1], (unsigned long long)n[0]);
}

static void exact_stop_rests_on_every_corner(void)
{
    int seen = 0;
    mill(500, 1000);
    go(10, 0, 0, 100, EMCMOT_TERM_COND_STOP, 0);
    go(10, 10, 0, 100, EMCMOT_TERM_COND_STOP, 0);
    go(0, 10, 0, 100, EMCMOT_TERM_COND_STOP, 0);
    send_all();
    while (!tpIsDone(&b.tp) && b.cycles < 10000) {
        bench_cycle(&b);
        if (b.p[0][0] == 10 && b.p[0][1] == 0 && !(seen & 1)) seen |= 1;
        if (b.p[0][0] == 10 && b.p[0][1] == 10) seen |= 2;
    }
    CHECK(seen == 3, "corners seen %d", seen);
    CHECK(b.worst_off < 1e-9, "deviation %g", b.worst_off);
    limits_kept();
    bench_free(&b);
}

static void exact_path_keeps_speed_where_tangent(void)
{
    double n[3] = { 0, 0, 1 }, c[3] = { 20, 10, 0 }, p[AXES] = { 30, 10 }, slow = 1e9;
    mill(500, 1000);
    go(20, 0, 0, 50, EMCMOT_TERM_COND_EXACT, 0);
    bench_arc(&b, p, c, n, 0, 50, EMCMOT_TERM_COND_EXACT, 0);
    go(30, 40, 0, 50, EMCMOT_TERM_COND_EXACT, 0);
    send_all();
    while (!tpIsDone(&b.tp) && b.cycles < 10000) {
        bench_cycle(&b);
        if (b.status.id == 2) slow = fmin(slow, b.status.current_vel);
    }
    CHECK(slow > 49.9, "slowest on the arc %g", slow);
    CHECK(b.worst_off < 1e-6, "deviation %g", b.worst_off);
    limits_kept();
    bench_free(&b);
}

static void override_takes_effect_at_once_and_is_reached(void)
{
    mill(500, 1000);
    go(1000, 0, 0, 100, EMCMOT_TERM_COND_BLEND, 0.1);
    send_all();
    for (int i = 0; i < 500; i++) bench_cycle(&b);
    CHECK(fabs(b.status.current_vel - 100) < 1e-6, "speed %g", b.status.current_vel);
    b.status.net_feed_scale = 2;
    for (int i = 0; i < 105; i++) bench_cycle(&b);
    CHECK(fabs(b.status.current_vel - 200) < 1e-6, "speed %g", b.status.current_vel);
    b.status.net_feed_scale = 5; /* more than allowed */
    for (int i = 0; i < 300; i++) bench_cycle(&b);
    CHECK(fabs(b.status.current_vel - 200) < 1e-6, "speed %g", b.status.current_vel);
    b.status.net_feed_scale = 0;
    for (int i = 0; i < 205; i++) bench_cycle(&b);
    CHECK(b.status.current_vel == 0, "speed %g", b.status.current_vel);
    b.status.net_feed_scale = 1;
    finish(100000);
    limits_kept();
    bench_free(&b);
}

static void a_lower_override_holds_before_a_slower_move(void)
{
    double top = 0;
    mill(500, 1000);
    go(50, 0, 0, 200, EMCMOT_TERM_COND_BLEND, 0.1);
    go(100, 0, 0, 20, EMCMOT_TERM_COND_BLEND, 0.1);
    send_all();
    while (!tpIsDone(&b.tp) && b.cycles < 20000) {
        bench_cycle(&b);
        if (b.status.id == 2) top = fmax(top, b.status.current_vel);
    }
    CHECK(top < 21, "speed in the slow move %g", top);
    limits_kept();
    bench_free(&b);
}

static void pause_and_resume_leave_the_path_unchanged(void)
{
    mill(300, 1500);
    for (int i = 0; i < 40; i++) go(5 * i + 5, i & 1 ? 0 : 5, 0, 150, EMCMOT_TERM_COND_BLEND, 0.05);
    send_all();
    for (int k = 0; k < 50; k++) {
        for (int i = 0; i < 20; i++) bench_cycle(&b);
        tpPause(&b.tp);
        for (int i = 0; i < 10 + 10 * k; i++) bench_cycle(&b);
        tpResume(&b.tp);
    }
    finish(100000);
    CHECK(b.p[0][0] == 200 && b.p[0][1] == 0, "end %g %g", b.p[0][0], b.p[0][1]);
    limits_kept();
    bench_free(&b);
}

static void abort_stops_on_the_path_and_empties_the_queue(void)
{
    for (int k = 0; k < 200; k++) {
        mill(300, 1500);
        for (int i = 0; i < 40; i++) go(i + 1, i & 1 ? 0 : 1, 0, 100, EMCMOT_TERM_COND_BLEND, 0.05);
        send_all();
        for (int i = 0; i < 3 * k; i++) bench_cycle(&b);
        tpAbort(&b.tp);
        double p[AXES] = { 100 };
        bench_line(&b, p, EMC_MOTION_TYPE_FEED, 10, EMCMOT_TERM_COND_BLEND, 0.05);
        CHECK(bench_send(&b) == -1, "a move was accepted while aborting");
        b.n--, b.next--;
        uint64_t n = finish(1000);
        CHECK(n < 100, "%llu cycles to stop", (unsigned long long)n);
        CHECK(tpQueueDepth(&b.tp) == 0, "depth %d", tpQueueDepth(&b.tp));
        double x = b.p[0][0], y = b.p[0][1];
        for (int i = 0; i < 100; i++) bench_cycle(&b);
        CHECK(b.p[0][0] == x && b.p[0][1] == y, "moved on");
        limits_kept();
        bench_free(&b);
        if (broken) return;
    }
}

static void steps_rest_at_the_end_of_each_move(void)
{
    mill(300, 1500);
    for (int i = 0; i < 10; i++) go(3 * (i + 1), i & 1 ? 0 : 1, 0, 100, EMCMOT_TERM_COND_BLEND, 0.2);
    send_all();
    tpPause(&b.tp);
    bench_cycle(&b);
    b.status.stepping = 1;
    for (int k = 1; k <= 9; k++) {
        int id = tpGetExecId(&b.tp), n = 0;
        tpResume(&b.tp);
        do bench_cycle(&b);
        while (tpGetExecId(&b.tp) == id && ++n < 2000);
        CHECK(b.status.current_vel < 60, "speed %g at the end of step %d", b.status.current_vel, k);
        tpPause(&b.tp);
        for (int i = 0; i < 50; i++) bench_cycle(&b);
        double d = hypot(b.p[0][0] - 3 * k, b.p[0][1] - (k & 1));
        CHECK(d < 0.21, "step %d rests %g from its end", k, d);
        CHECK(tpGetExecId(&b.tp) == k + 1, "id %d after step %d", tpGetExecId(&b.tp), k);
    }
    b.status.stepping = 0;
    tpResume(&b.tp);
    finish(10000);
    limits_kept();
    bench_free(&b);
}

static void reverse_runs_back_along_the_path_and_forward_again(void)
{
    mill(300, 1500);
    for (int i = 0; i < 50; i++) go(3 * (i + 1), i & 1 ? 0 : 1, 0, 100, EMCMOT_TERM_COND_BLEND, 0.2);
    send_all();
    for (int i = 0; i < 900; i++) bench_cycle(&b);
    tpSetRunDir(&b.tp, TC_DIR_REVERSE);
    CHECK(b.tp.reverse_run == 0, "reversed while moving");
    tpPause(&b.tp);
    for (int i = 0; i < 200; i++) bench_cycle(&b);
    double x = b.p[0][0];
    int id = tpGetExecId(&b.tp);
    CHECK(tpSetRunDir(&b.tp, TC_DIR_REVERSE) == 0, "refused at rest");
    tpResume(&b.tp);
    for (int i = 0; i < 400; i++) bench_cycle(&b);
    CHECK(b.p[0][0] < x - 20, "x %g, was %g", b.p[0][0], x);
    CHECK(tpGetExecId(&b.tp) < id, "id %d, was %d", tpGetExecId(&b.tp), id);
    for (int i = 0; i < 4000; i++) bench_cycle(&b);
    CHECK(b.p[0][0] == 0 && b.status.current_vel == 0, "x %g", b.p[0][0]);
    CHECK(!tpIsDone(&b.tp), "done at the start");
    tpSetRunDir(&b.tp, TC_DIR_FORWARD);
    finish(20000);
    CHECK(b.p[0][0] == 150, "end %g", b.p[0][0]);
    limits_kept();
    bench_free(&b);
}

static void outputs_switch_once_in_order_with_their_move(void)
{
    mill(300, 1500);
    for (int i = 0; i < 10; i++) {
        go(3 * (i + 1), i & 1 ? 0 : 1, 0, 100, EMCMOT_TERM_COND_BLEND, 0.2);
        tpSetDout(&b.tp, 60, i & 1, 0);
        tpSetAout(&b.tp, 63, i + 1, 0);
        tpSetAout(&b.tp, 1, -i - 1, 0);
        bench_send(&b);
    }
    while (!tpIsDone(&b.tp) && b.cycles < 10000) {
        bench_cycle(&b);
        int id = tpGetExecId(&b.tp);
        if (id <= 1) continue;
        CHECK(b.status.analog_output[63] == id && b.status.analog_output[1] == -id, "move %d: outputs %g %g", id,
              b.status.analog_output[63], b.status.analog_output[1]);
        CHECK(b.status.synch_do[60] == ((id - 1) & 1), "move %d: digital %d", id, b.status.synch_do[60]);
    }
    /* without a move after them outputs never switch; an abort drops them */
    tpSetAout(&b.tp, 1, 99, 0);
    tpAbort(&b.tp);
    for (int i = 0; i < 10; i++) bench_cycle(&b);
    go(50, 0, 0, 100, EMCMOT_TERM_COND_BLEND, 0.2);
    send_all();
    finish(10000);
    CHECK(b.status.analog_output[1] == -10, "output %g", b.status.analog_output[1]);
    limits_kept();
    bench_free(&b);
}

static void a_feed_waits_until_spindles_are_at_speed(void)
{
    EmcPose end = { { 10, 0, 0 }, 0, 0, 0, 0, 0, 0 };
    struct state_tag_t tag;
    memset(&tag, 0, sizeof tag);
    mill(300, 1500);
    b.status.spindle_status[0].at_speed = 0;
    tpSetId(&b.tp, 7);
    tpAddLine(&b.tp, end, EMC_MOTION_TYPE_FEED, 100, 300, 1500, 0, 0xff, 1, -1, tag);
    for (int i = 0; i < 100; i++) bench_cycle(&b);
    CHECK(b.p[0][0] == 0, "moved to %g", b.p[0][0]);
    CHECK(b.tp.spindle.waiting_for_atspeed == 7, "waits for %d", b.tp.spindle.waiting_for_atspeed);
    CHECK(tpGetExecId(&b.tp) == 7 && tpQueueDepth(&b.tp) == 1, "id %d depth %d", tpGetExecId(&b.tp),
          tpQueueDepth(&b.tp));
    b.status.spindle_status[0].at_speed = 1;
    finish(1000);
    CHECK(b.tp.spindle.waiting_for_atspeed == -1, "still waits");
    CHECK(b.p[0][0] == 10, "end %g", b.p[0][0]);
    bench_free(&b);
}

static void zero_length_moves_are_dropped_and_add_up(void)
{
    mill(300, 1500);
    double p[AXES] = { 5e-9 };
    bench_line(&b, p, EMC_MOTION_TYPE_FEED, 10, EMCMOT_TERM_COND_BLEND, 0);
    CHECK(bench_send(&b) == TP_ERR_ZERO_LENGTH, "not dropped");
    p[0] = 1.2e-8;
    bench_line(&b, p, EMC_MOTION_TYPE_FEED, 10, EMCMOT_TERM_COND_BLEND, 0);
    CHECK(bench_send(&b) == 0, "dropped");
    finish(100);
    CHECK(b.p[0][0] == 1.2e-8, "end %g", b.p[0][0]);
    bench_free(&b);
}

/* Runs a thread of 20 mm with s; returns z - upr * revolutions at the middle, modulo upr, and the worst error there. */
static double thread_of(struct spin *s, double upr, double *worst_error, double *worst_acc)
{
    double phase = NAN, low = 1e30, high = -1e30;
    for (int i = 0; i < 50; i++) spin_cycle(s), bench_cycle(&b);
    tpSetSpindleSync(&b.tp, 0, upr, 0);
    go(0, 0, -30, 100, EMCMOT_TERM_COND_BLEND, 0);
    send_all();
    *worst_acc = 0;
    double future = 0, top = 0;
    while (!tpIsDone(&b.tp) && b.cycles < 60000) {
        spin_cycle(s);
        bench_cycle(&b);
        double z = -b.p[0][2];
        top = fmax(top, b.status.current_vel);
        if (z > 15 && z < 25) {
            /* the joint gets there two cycles later */
            future = s->total + 2 * s->speed * b.dt;
            double e = z - upr * future;
            e -= upr * floor(e / upr);
            if (isnan(phase)) phase = e;
            e -= phase;
            e -= upr * floor(e / upr + 0.5);
            low = fmin(low, e), high = fmax(high, e);
            double a = fabs(b.p[0][2] - 2 * b.p[1][2] + b.p[2][2]) / (b.dt * b.dt);
            *worst_acc = fmax(*worst_acc, a);
        }
    }
    CHECK(tpIsDone(&b.tp), "thread did not end");
    CHECK(b.p[0][2] == -30, "end %g", b.p[0][2]);
    if (s->counts == 0) CHECK(top < upr * s->speed * 1.03 + 0.1, "%g units/s for a thread of %g", top, upr * s->speed);
    *worst_error = high - low;
    limits_kept();
    bench_free(&b);
    return phase;
}

static double thread_phase(double rps, double upr, double counts, double *worst_error, double *worst_acc)
{
    struct spin s;
    mill(300, 1000);
    spin_start(&s, rps);
    s.counts = counts;
    return thread_of(&s, upr, worst_error, worst_acc);
}

static void threads_have_the_same_phase_at_every_speed(void)
{
    double e, a, first = thread_phase(200 / 60.0, 1.5, 0, &e, &a);
    CHECK(e < 1e-6, "error %g", e);
    CHECK(a < 1e-3, "acceleration %g", a);
    for (double rpm = 50; rpm <= 1600; rpm *= 2) {
        double phase = thread_phase(rpm / 60, 1.5, 0, &e, &a) - first;
        phase -= 1.5 * floor(phase / 1.5 + 0.5);
        CHECK(fabs(phase) < 1e-4, "%g rpm: phase differs by %g", rpm, phase);
        CHECK(e < 1e-6, "%g rpm: error %g", rpm, e);
        CHECK(a < 1e-3, "%g rpm: acceleration %g", rpm, a);
    }
}

/* A simulated spindle whose count is never reset and whose request of an index is answered at once. */
static void an_encoder_that_counts_on_gives_threads_in_phase(void)
{
    struct spin s;
    double e, a, phase[2];
    for (int k = 0; k < 2; k++) {
        mill(300, 1000);
        spin_start(&s, 10);
        s.counts_on = 1;
        s.revs = s.total = 1000.2 + 53.45 * k;
        phase[k] = thread_of(&s, 1.5, &e, &a);
        CHECK(e < 1e-6, "error %g", e);
    }
    e = (phase[1] - phase[0]) / 1.5;
    CHECK(fabs(e - floor(e + 0.5)) < 1e-4, "phases differ by %g revolutions", e);
}

static void a_reset_while_a_thread_is_cut_does_no_harm(void)
{
    struct spin s;
    double place = 0, step = 0;
    mill(300, 1000);
    spin_start(&s, 10);
    tpSetSpindleSync(&b.tp, 0, 1, 0);
    go(0, 0, -30, 100, EMCMOT_TERM_COND_BLEND, 0);
    send_all();
    while (!tpIsDone(&b.tp) && b.cycles < 60000) {
        spin_cycle(&s);
        if (b.p[0][2] < -10 && s.revs > 0) s.revs = -100;
        place = b.p[0][2];
        bench_cycle(&b);
        if (b.p[0][2] < -5 && b.p[0][2] > -28) step = fmax(step, fabs(b.p[0][2] - place + 0.01));
    }
    CHECK(b.p[0][2] == -30, "end %g", b.p[0][2]);
    CHECK(step < 1e-5, "a step of %g mm in a cycle", step);
    limits_kept();
    bench_free(&b);
}

/* FP-031, beside the acceleration with an ideal encoder above */
static void a_coarse_encoder_gives_bounded_ripple(void)
{
    double e, a;
    thread_phase(10, 1, 256, &e, &a);
    CHECK(e < 1.0 / 256, "error %g", e);
    CHECK(a < 400, "acceleration %g", a);
}

static void chained_threads_keep_phase_and_ignore_override_and_pause(void)
{
    struct spin s;
    double phase = NAN;
    mill(300, 1000);
    spin_start(&s, 10);
    tpSetSpindleSync(&b.tp, 0, 1, 0);
    for (int i = 1; i <= 8; i++) go(0.05 * i, 0, -5 * i, 100, EMCMOT_TERM_COND_BLEND, 0.01);
    tpSetSpindleSync(&b.tp, 0, 1, 0);
    send_all();
    b.status.net_feed_scale = 0.5;
    while (!tpIsDone(&b.tp) && b.cycles < 20000) {
        spin_cycle(&s);
        bench_cycle(&b);
        if (b.p[0][2] < -10) tpPause(&b.tp);
        if (b.p[0][2] < -20) tpResume(&b.tp);
        if (b.p[0][2] < -5 && b.p[0][2] > -38) {
            double path = -b.p[0][2] * hypot(1, 0.01), e = path - (s.total + 2 * s.speed * b.dt);
            if (isnan(phase)) phase = e;
            CHECK(fabs(e - phase) < 2e-3, "out of phase by %g at z %g", e - phase, b.p[0][2]);
            if (broken) break;
        }
    }
    CHECK(tpIsDone(&b.tp), "did not end");
    limits_kept();
    bench_free(&b);
}

static void a_thread_too_fast_for_the_machine_is_refused(void)
{
    struct spin s;
    mill(25, 1000);
    spin_start(&s, 1000 / 60.0);
    for (int i = 0; i < 50; i++) spin_cycle(&s), bench_cycle(&b);
    tpSetSpindleSync(&b.tp, 0, 2.54, 0);
    go(0, 0, -30, 25, EMCMOT_TERM_COND_BLEND, 0);
    send_all();
    for (int i = 0; i < 1000; i++) spin_cycle(&s), bench_cycle(&b);
    CHECK(b.status.motionFlag & EMCMOT_MOTION_ERROR_BIT, "no error");
    CHECK(b.p[0][2] == 0 && tpIsDone(&b.tp), "z %g", b.p[0][2]);
    bench_free(&b);
}

static void feed_per_revolution_follows_the_spindle_and_the_override(void)
{
    struct spin s;
    mill(300, 1000);
    spin_start(&s, 10);
    tpSetSpindleSync(&b.tp, 0, 2, 1);
    go(200, 0, 0, 300, EMCMOT_TERM_COND_BLEND, 0.1);
    send_all();
    for (int i = 0; i < 300; i++) spin_cycle(&s), bench_cycle(&b);
    CHECK(fabs(b.status.current_vel - 20) < 1e-6, "speed %g", b.status.current_vel);
    b.status.net_feed_scale = 1.5;
    for (int i = 0; i < 300; i++) spin_cycle(&s), bench_cycle(&b);
    CHECK(fabs(b.status.current_vel - 30) < 1e-6, "speed %g", b.status.current_vel);
    tpPause(&b.tp);
    for (int i = 0; i < 300; i++) spin_cycle(&s), bench_cycle(&b);
    CHECK(b.status.current_vel == 0, "speed %g", b.status.current_vel);
    tpResume(&b.tp);
    while (!tpIsDone(&b.tp) && b.cycles < 20000) spin_cycle(&s), bench_cycle(&b);
    CHECK(b.p[0][0] == 200, "end %g", b.p[0][0]);
    limits_kept();
    bench_free(&b);
}

static void a_rigid_tap_stays_on_the_thread_through_both_reversals(void)
{
    struct spin s;
    struct state_tag_t tag;
    EmcPose hole = { { 0, 0, -12 }, 0, 0, 0, 0, 0, 0 };
    double upr = 1.25, deepest = 0, phase = NAN, worst = 0;
    int reversals = 0;

    memset(&tag, 0, sizeof tag);
    mill(300, 1000);
    spin_start(&s, 8);
    s.accel = 40;
    CHECK(tpAddRigidTap(&b.tp, hole, 300, 300, 1000, 0, 0xff, 1, tag) == -1, "accepted without a spindle");
    tpSetSpindleSync(&b.tp, 0, upr, 0);
    tpSetId(&b.tp, 5);
    CHECK(tpAddRigidTap(&b.tp, hole, 300, 300, 1000, 0, 0xff, 2, tag) == 0, "refused");
    tpSetSpindleSync(&b.tp, 0, 0, 0);
    go(10, 0, 0, 0, EMCMOT_TERM_COND_BLEND, 0);
    send_all();
    double last_command = 480;
    b.check_every = 1000000; /* a tap is not part of the program the bench knows */
    while (!tpIsDone(&b.tp) && b.cycles < 60000) {
        s.target = b.status.spindle_status[0].speed / 60;
        spin_cycle(&s);
        bench_cycle(&b);
        double z = b.p[0][2];
        deepest = fmin(deepest, z);
        if (b.status.spindle_status[0].speed != last_command)
            reversals++, last_command = b.status.spindle_status[0].speed;
        if (z < -3 && b.p[0][0] == 0) {
            double e = -z - upr * (s.total + 2 * s.speed * b.dt);
            if (isnan(phase)) phase = e;
            worst = fmax(worst, fabs(e - phase));
        }
    }
    CHECK(tpIsDone(&b.tp), "did not end");
    CHECK(reversals == 2 && last_command == 480, "%d reversals, speed %g", reversals, last_command);
    CHECK(deepest < -12 && deepest > -14.5, "deepest %g", deepest);
    CHECK(worst < 0.02 * upr, "off the thread by %g", worst);
    CHECK(b.p[0][0] == 10 && b.p[0][2] == 0, "end %g %g", b.p[0][0], b.p[0][2]);
    CHECK(b.worst_a <= 1.0001 && b.worst_v <= 1.0001, "ratios %g %g", b.worst_v, b.worst_a);
    bench_free(&b);
}

static void an_aborted_tap_ends_with_the_spindle(void)
{
    struct spin s;
    struct state_tag_t tag;
    EmcPose hole = { { 0, 0, -12 }, 0, 0, 0, 0, 0, 0 };
    double phase = NAN, worst = 0;
    memset(&tag, 0, sizeof tag);
    mill(300, 1000);
    spin_start(&s, 8);
    s.accel = 40;
    tpSetSpindleSync(&b.tp, 0, 1, 0);
    tpAddRigidTap(&b.tp, hole, 300, 300, 1000, 0, 0xff, 1, tag);
    b.check_every = 1000000;
    while (b.p[0][2] > -6 && b.cycles < 20000) {
        spin_cycle(&s);
        bench_cycle(&b);
    }
    tpAbort(&b.tp);
    for (int i = 0; i < 20; i++) spin_cycle(&s), bench_cycle(&b);
    b.status.spindle_status[0].speed = 0;
    s.target = 0;
    while (!tpIsDone(&b.tp) && b.cycles < 30000) {
        spin_cycle(&s);
        bench_cycle(&b);
        double e = -b.p[0][2] - s.total;
        if (isnan(phase)) phase = e;
        worst = fmax(worst, fabs(e - phase));
    }
    CHECK(tpIsDone(&b.tp), "did not end");
    CHECK(worst < 0.05, "off the thread by %g", worst);
    CHECK(b.worst_a <= 1.0001, "acceleration %g", b.worst_a);
    bench_free(&b);
}

static void the_queue_tells_when_it_is_full(void)
{
    mill(300, 1500);
    int n = 0;
    while (!tcqFull(&b.tp.queue) && n < 3000) {
        n++;
        go(0.1 * n, 0, 0, 100, EMCMOT_TERM_COND_BLEND, 0.1);
        bench_send(&b);
    }
    CHECK(n == 1780, "full after %d moves", n);
    int r = 0;
    while (r == 0 && n < 3000) {
        n++;
        go(0.1 * n, 0, 0, 100, EMCMOT_TERM_COND_BLEND, 0.1);
        r = bench_send(&b);
    }
    CHECK(n == 2001 && r < 0, "refused after %d moves: %d", n, r);
    b.n--, b.next--;
    b.at[0] = 0.1 * (n - 1);
    finish(10000);
    CHECK(fabs(b.p[0][0] - 200) < 1e-9, "end %g", b.p[0][0]);
    bench_free(&b);
}

static void tiny_linear_parts_do_not_drive_rotaries_too_fast(void)
{
    double p[AXES] = { 5e-9, 0, 0, 100 };
    mill(300, 1500);
    bench_line(&b, p, EMC_MOTION_TYPE_FEED, 100, EMCMOT_TERM_COND_BLEND, 0);
    p[0] = 1e-6, p[3] = 200;
    bench_line(&b, p, EMC_MOTION_TYPE_FEED, 100, EMCMOT_TERM_COND_BLEND, 0);
    p[0] = 1, p[3] = 300;
    bench_line(&b, p, EMC_MOTION_TYPE_FEED, 100, EMCMOT_TERM_COND_BLEND, 0);
    bench_run(&b, 1, 100000);
    CHECK(tpIsDone(&b.tp) && b.p[0][3] == 300, "end %g", b.p[0][3]);
    limits_kept();
    bench_free(&b);
}

static void the_same_program_runs_the_same_every_time(void)
{
    static double first[4000][3];
    mill(300, 1500);
    for (int run = 0; run < 5; run++) {
        int n = 0;
        double off = 0;
        go(0, 0, 0, 0, EMCMOT_TERM_COND_BLEND, 0.05);
        bench_run(&b, 1, 20000);
        bench_resync(&b);
        for (int i = 0; i < 200; i++) go(i * 0.3 + 0.3, sin(i * 0.1), 0, 80, EMCMOT_TERM_COND_BLEND, 0.05);
        while ((b.next < b.n || !tpIsDone(&b.tp)) && n < 4000) {
            if (b.next < b.n) bench_send(&b);
            bench_cycle(&b);
            for (int i = 0; i < 3; i++) {
                if (run == 0) first[n][i] = b.p[0][i];
                else off = fmax(off, fabs(first[n][i] - b.p[0][i]));
            }
            n++;
        }
        CHECK(off < 1e-9, "run %d differs by %g", run, off);
    }
    bench_free(&b);
}

/* ---- */

static const struct test_case cases[] = {
    CASE(a_single_move_takes_the_optimal_time),
    CASE(collinear_pieces_run_as_one_line),
    CASE(exact_stop_rests_on_every_corner),
    CASE(exact_path_keeps_speed_where_tangent),
    CASE(override_takes_effect_at_once_and_is_reached),
    CASE(a_lower_override_holds_before_a_slower_move),
    CASE_JERK(pause_and_resume_leave_the_path_unchanged),
    CASE(abort_stops_on_the_path_and_empties_the_queue),
    CASE(steps_rest_at_the_end_of_each_move),
    CASE(reverse_runs_back_along_the_path_and_forward_again),
    CASE_JERK(outputs_switch_once_in_order_with_their_move),
    CASE(a_feed_waits_until_spindles_are_at_speed),
    CASE(zero_length_moves_are_dropped_and_add_up),
    CASE_JERK(threads_have_the_same_phase_at_every_speed),
    CASE_JERK(an_encoder_that_counts_on_gives_threads_in_phase),
    CASE_JERK(a_reset_while_a_thread_is_cut_does_no_harm),
    CASE_JERK(a_coarse_encoder_gives_bounded_ripple),
    CASE_JERK(chained_threads_keep_phase_and_ignore_override_and_pause),
    CASE_JERK(a_thread_too_fast_for_the_machine_is_refused),
    CASE_JERK(feed_per_revolution_follows_the_spindle_and_the_override),
    CASE_JERK(a_rigid_tap_stays_on_the_thread_through_both_reversals),
    CASE_JERK(an_aborted_tap_ends_with_the_spindle),
    CASE(the_queue_tells_when_it_is_full),
    CASE_JERK(tiny_linear_parts_do_not_drive_rotaries_too_fast),
    CASE_JERK(the_same_program_runs_the_same_every_time),
};

CASES_MAIN
