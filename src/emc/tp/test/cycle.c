/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * cycle.c - the planner's servo cycle under a counter of instructions (cycle-bench.py).
 *
 *   cycle xyz|delta|five-axis idle|moving|jerk CYCLES
 *
 * Moving: chords of 0.3 mm of a curve in space at 6 m/min, rounded within 0.01 mm; one move comes in
 * each cycle until the queue is full, as motmod takes them. jerk: the same with limits of jerk.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "machines.h"

int main(int argc, char **argv)
{
    struct bench b;
    const struct machine *machine;
    double p[AXES] = { 0 };
    EmcPose pose;

    if (argc != 4) {
        fprintf(stderr, "usage: %s xyz|delta|five-axis idle|moving|jerk CYCLES\n", argv[0]);
        return 2;
    }
    int idle = !strcmp(argv[2], "idle"), jerk = !strcmp(argv[2], "jerk"), cycles = atoi(argv[3]);
    machine = machine_named(argv[1]);
    bench_init(&b, 0.001);
    for (int i = 0; i < AXES; i++) bench_axis(&b, i, 200, 1500, 50000);
    if (machine) {
        bench_joints(&b, machine->joints, machine->inverse);
        for (int i = 0; i < machine->joints; i++) bench_joint(&b, i, 200, 1500, jerk ? 50000 : 0);
    }
    bench_start(&b, jerk);
    for (int i = 1; !idle && i < 2 * cycles; i++) {
        double t = 0.01 * i;
        p[0] = 30 * sin(t), p[1] = 30 * (1 - cos(t)), p[2] = 5 * sin(1.7 * t);
        if (machine && machine->axes & 2) p[3] = 30 * sin(0.7 * t), p[5] = 40 * sin(t);
        bench_line(&b, p, EMC_MOTION_TYPE_FEED, 100, EMCMOT_TERM_COND_BLEND, 0.01);
    }
    for (int i = 0; i < cycles; i++) {
        if (!tcqFull(&b.tp.queue)) bench_send(&b);
        tpRunCycle(&b.tp, 1000000);
    }
    tpGetPos(&b.tp, &pose);
    printf("%s %s: %d moves in, at %.3f %.3f %.3f\n", argv[1], argv[2], b.next, pose.tran.x, pose.tran.y, pose.tran.z);
    bench_free(&b);
    return 0;
}
