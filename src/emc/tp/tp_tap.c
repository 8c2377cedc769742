/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * tp_tap.c - one cycle of a rigid tap: down with the spindle, through both reversals, back to the start.
 */
#include "tp_priv.h"

#include <math.h>
#include <string.h>

#include "rtapi.h"

#define TAP_OVERRUN 10    /* revolutions that a tap may run on after the spindle was reversed */
#define TAP_STILL 1e-3     /* of one cycle's change of speed: what an aborted tap follows no more */
#define ABORT_FOLLOW 0.1  /* s that an aborted tap goes on following while the spindle is not stopped */

int tp_tap_at_rest(const struct planner *pl)
{
    const struct tap *tap = &pl->tap;
    return tap->state == TAP_IDLE || (tap->v == 0 && traj_filter_settled(&tap->filter) && tap->abort_time > 0);
}

void tp_run_tap(struct planner *pl, const struct move_info *info)
{
    struct tap *tap = &pl->tap;
    struct spindle_status *sp = &tp_mot.status->spindle_status[info->sync.spindle];
    double T = pl->cycle, dv = info->tap_acc * T, v0 = tap->v, want;

    if (tap->state == TAP_IDLE) {
        double d[PATH_AXES];
        for (int i = 0; i < PATH_AXES; i++) d[i] = info->tap_end[i] - pl->tj.pos[i];
        tap->depth = path_group_norm(d, PATH_XYZ);
        for (int i = 0; i < PATH_AXES; i++) tap->dir[i] = i < 3 ? d[i] / tap->depth : 0;
        tap->x = tap->v = tap->place = tap->abort_time = 0;
        traj_filter_set(&tap->filter, info->tap_window, 0);
        tap->state = TAP_IN;
        v0 = 0;
    }
    double error = follow_reference(&pl->follow, info->sync.upr, tp_follow_lead(pl, info)) - tap->x;
    double rate = info->sync.upr * pl->follow.speed;
    want = follow_speed(error, rate, info->tap_acc, T);
    if (want < 0 && tap->state == TAP_IN) want = 0;
    if (tap->state == TAP_PLACE) {
        double top = info->tap_feed * (pl->pausing ? 0 : tp_mot.status->net_feed_scale), left = fabs(tap->x);
        want = sqrt(dv * dv / 4 + 2 * info->tap_acc * left) - dv / 2;
        want = fmin(fmin(want, left / T), fmin(top, info->tap_vmax));
        if (tap->x > 0) want = -want;
    }
    if (pl->aborting) {
        /* Tool and thread stay together while the spindle runs down. */
        tap->abort_time += T;
        int stopping = sp->speed == 0 || tap->abort_time < ABORT_FOLLOW;
        if (tap->state == TAP_PLACE || !stopping || fabs(want) < TAP_STILL * dv) want = 0;
    }
    if (fabs(want) > info->tap_vmax) want = want < 0 ? -info->tap_vmax : info->tap_vmax;
    tap->v += fmax(-dv, fmin(dv, want - tap->v));
    tap->x += (v0 + tap->v) / 2 * T;
    tap->place = traj_filter_step(&tap->filter, tap->x);

    switch (tap->state) {
    case TAP_IDLE: break;
    case TAP_IN:
        if (tap->x < tap->depth) break;
        sp->speed *= -info->tap_scale;
        tap->state = TAP_REVERSING;
        break;
    case TAP_REVERSING:
        if (tap->x > tap->depth + TAP_OVERRUN * info->sync.upr && !pl->aborting) {
            rtapi_print_msg(RTAPI_MSG_ERR, "line %d: spindle %d does not reverse, rigid tap stopped\n", info->id,
                            info->sync.spindle);
            tp_fail(pl);
        }
        if (pl->follow.speed < 0) tap->state = TAP_OUT;
        break;
    case TAP_OUT:
        if (tap->x > 0) break;
        sp->speed *= -1 / info->tap_scale;
        tap->state = TAP_FINAL_REVERSAL;
        break;
    case TAP_FINAL_REVERSAL:
        if (pl->follow.speed > 0) {
            tap->state = TAP_PLACE;
            pl->followed = -1;
            tp_mot.status->spindleSync = 0;
        }
        break;
    case TAP_PLACE:
        if (fabs(tap->x) > 1e-9 || fabs(tap->v) > 2 * dv || !traj_filter_settled(&tap->filter)) break;
        tap->x = tap->place = tap->v = 0;
        tap->state = TAP_IDLE;
        traj_finish(&pl->tj);
        break;
    }
}
