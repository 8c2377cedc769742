/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * tp_tap.c - one cycle of a rigid tap: down with the spindle, through both reversals, back to the start.
 */
#include "tp_priv.h"

#include <math.h>

#include "rtapi.h"

#define TAP_OVERRUN 10    /* revolutions that a tap may run on after the spindle was reversed */
#define TAP_STILL 1e-3     /* of one cycle's change of speed: what an aborted tap follows no more */
#define ABORT_FOLLOW 0.1  /* s that an aborted tap goes on following while the spindle is not stopped */

int tp_tap_at_rest(const struct planner *pl)
{
    const struct tap *tap = &pl->tap;
    return tap->state == TAP_IDLE || (tap->v == 0 && traj_filter_settled(&tap->filter) && tap->abort_time > 0);
}

static void begin(struct planner *pl, const struct move_info *info)
{
    struct tap *tap = &pl->tap;
    double d[PATH_AXES];

    for (int i = 0; i < PATH_AXES; i++) d[i] = info->tap_end[i] - pl->tj.pos[i];
    tap->depth = path_group_norm(d, PATH_XYZ);
    for (int i = 0; i < PATH_AXES; i++) tap->dir[i] = i < 3 ? d[i] / tap->depth : 0;
    tap->x = tap->v = tap->place = tap->abort_time = 0;
    traj_filter_set(&tap->filter, info->tap_window, 0);
    tap->state = TAP_IN;
}

/* Speed towards the start, when the spindle is followed no more. */
static double speed_to_place(const struct planner *pl, const struct move_info *info)
{
    double dv = info->tap_acc * pl->cycle, left = fabs(pl->tap.x);
    double top = info->tap_feed * (pl->pausing ? 0 : tp_mot.status->net_feed_scale);
    double v = sqrt(dv * dv / 4 + 2 * info->tap_acc * left) - dv / 2;
    v = fmin(fmin(v, left / pl->cycle), top);
    return pl->tap.x > 0 ? -v : v;
}

static double wanted_speed(struct planner *pl, const struct move_info *info)
{
    struct tap *tap = &pl->tap;
    double want;

    if (tap->state == TAP_PLACE) {
        want = speed_to_place(pl, info);
    } else {
        double error = follow_reference(&pl->follow, info->sync.upr, tp_follow_lead(pl, info)) - tap->x;
        want = follow_speed(error, info->sync.upr * pl->follow.speed, info->tap_acc, pl->cycle);
        if (want < 0 && tap->state == TAP_IN) want = 0;
    }
    if (pl->aborting) {
        /* Tool and thread stay together while the spindle runs down. */
        tap->abort_time += pl->cycle;
        int stopping = tp_mot.status->spindle_status[info->sync.spindle].speed == 0 || tap->abort_time < ABORT_FOLLOW;
        if (tap->state == TAP_PLACE || !stopping || fabs(want) < TAP_STILL * info->tap_acc * pl->cycle) want = 0;
    }
    return fmax(-info->tap_vmax, fmin(info->tap_vmax, want));
}

/* What follows from the place that was reached and the way the spindle turns. */
static void next_state(struct planner *pl, const struct move_info *info)
{
    struct tap *tap = &pl->tap;
    struct spindle_status *sp = &tp_mot.status->spindle_status[info->sync.spindle];

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
        if (fabs(tap->x) > 1e-9 || fabs(tap->v) > 2 * info->tap_acc * pl->cycle ||
            !traj_filter_settled(&tap->filter))
            break;
        tap->x = tap->place = tap->v = 0;
        tap->state = TAP_IDLE;
        traj_finish(&pl->tj);
        break;
    }
}

void tp_run_tap(struct planner *pl, const struct move_info *info)
{
    struct tap *tap = &pl->tap;
    double dv = info->tap_acc * pl->cycle;

    if (tap->state == TAP_IDLE) begin(pl, info);
    double before = tap->v;
    tap->v += fmax(-dv, fmin(dv, wanted_speed(pl, info) - tap->v));
    tap->x += (before + tap->v) / 2 * pl->cycle;
    tap->place = traj_filter_step(&tap->filter, tap->x);
    next_state(pl, info);
}
