/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * tp_cycle.c - the planner's servo cycle: what may start, positions and status out.
 */
#include "tp_priv.h"

#include <math.h>
#include <string.h>

#include "rtapi.h"

#define REVERSE_LOOK 16   /* moves looked back for one that cannot be undone */
#define STAND_TIME 2.0     /* s without motion and without a reason that motmod shows: reported */

static void idle_status(struct planner *pl)
{
    tp_mot.status->enables_queued = tp_mot.status->enables_new;
    tp_mot.status->distance_to_go = tp_mot.status->decel_dist = 0;
    ZERO_EMC_POSE(tp_mot.status->dtg);
    tp_mot.status->current_vel = tp_mot.status->requested_vel = 0;
    tp_mot.status->current_acc = tp_mot.status->current_jerk = 0;
    tp_mot.status->current_dir = (PmCartesian){ 0, 0, 0 };
    tp_mot.status->tcqlen = 0;
    tp_mot.status->spindleSync = 0;
    tp_mot.status->scale_allowed = tp_mot.config->maxFeedScale;
    tp_mot.status->scale_bound = EMCMOT_OVERRIDE_MAXIMUM;
    pl->canon = 0;
    pl->exec_id = 0;
}

/* Locks the rotary joint of the move that ended. 0: still unlocked. */
static int rotary_locked(struct planner *pl)
{
    if (pl->unlocked_joint < 0) return 1;
    if (pl->resting <= OUTPUT_LAG + 1) return 0; /* the joint itself still moves */
    tp_mot.set_rotary_unlock(pl->unlocked_joint, 0);
    if (tp_mot.get_rotary_is_unlocked(pl->unlocked_joint)) return 0;
    pl->unlocked_joint = -1;
    return 1;
}

/* May the move that waits begin? */
static int may_start(TP_STRUCT *tp, struct planner *pl, uint32_t index)
{
    const struct move_info *info = info_of(pl, index);
    const struct traj_seg *g = traj_seg(&pl->tj, index);
    int goes_on = tp_mot.status->spindleSync && !info->tap; /* rest within a synchronised run */

    if (pl->pausing || tp_mot.status->offsets_leave) return 0;
    if ((pl->unlocked_joint < 0 || pl->unlocked_for != index) && !rotary_locked(pl)) return 0;
    if ((info->atspeed || (info->sync.mode == SYNC_POSITION && !goes_on) || info->tap) && !pl->starting &&
        !tp_spindles_at_speed(info)) {
        tp->spindle.waiting_for_atspeed = info->id;
        return 0;
    }
    tp->spindle.waiting_for_atspeed = -1;
    if (info->atspeed) tp_stops_waited_for();
    if (info->indexer >= 0) {
        tp_mot.set_rotary_unlock(info->indexer, 1);
        pl->unlocked_joint = info->indexer;
        pl->unlocked_for = index;
        if (!tp_mot.get_rotary_is_unlocked(info->indexer)) return 0;
    }
    if (info->tap) return tp_sync_start(tp, pl, info, info->tap_acc, info->tap_vmax);
    if (info->sync.mode == SYNC_POSITION && !goes_on)
        return tp_sync_start(tp, pl, info, traj_acc(&pl->tj, index), g->vmax);
    return 1;
}

static void write_outputs(const struct outputs *out)
{
    for (int i = 0; i < NUM_OUT; i++) {
        if (out->digital >> i & 1) tp_mot.dio_write(i, (char)(out->digital_value >> i & 1));
        if (out->analog >> i & 1) tp_mot.aio_write(i, out->analog_value[i]);
    }
}

/* Reports moves that started: id, tag, outputs, each once and in order. */
static void enter_moves(struct planner *pl)
{
    struct traj *tj = &pl->tj;
    int64_t waiting = traj_waiting(tj), last = tj->cur;
    const struct move_info *shown = info_of(pl, tj->cur);

    if (waiting == last) last--; /* not even the first has started */
    if (last < pl->entered) pl->entered = last; /* running backward: outputs stay as they are */
    while (pl->entered < last) {
        pl->entered++;
        const struct move_info *info = info_of(pl, (uint32_t)pl->entered);
        if (info->has_outputs) write_outputs(&info->outputs);
        pl->exec_tag = info->tag;
    }
    if (waiting >= 0) shown = info_of(pl, (uint32_t)waiting);
    else pl->exec_tag = shown->tag;
    pl->exec_id = shown->id;
    pl->canon = shown->canon;
    tp_mot.status->enables_queued = shown->enables;
}

/* Up to which override the executing move gets faster. */
static void scale_allowed(const struct planner *pl, const struct traj_seg *g)
{
    const struct traj_drive *d = &pl->tj.drive;
    double *allowed = &tp_mot.status->scale_allowed;
    int *bound = &tp_mot.status->scale_bound;

    *allowed = d->max_scale;
    *bound = EMCMOT_OVERRIDE_MAXIMUM;
    if (g->follow == TRAJ_SYNC_POSITION || pl->tj.in_mark) {
        *allowed = 1;
        *bound = EMCMOT_OVERRIDE_SPINDLE;
        return;
    }
    if (g->feed * *allowed > g->vmax) {
        *allowed = g->vmax / g->feed;
        *bound = EMCMOT_OVERRIDE_MACHINE;
    }
    if (g->prim.metric != PATH_ABC && g->feed * *allowed > d->vlimit) {
        *allowed = d->vlimit / g->feed;
        *bound = EMCMOT_OVERRIDE_MAX_VELOCITY;
    }
}

static void moving_status(struct planner *pl, const double before[PATH_AXES])
{
    struct traj *tj = &pl->tj;
    const struct traj_seg *g = traj_seg(tj, tj->cur);
    double step[PATH_AXES], left[PATH_AXES], requested, speed, rate;
    EmcPose pose;

    for (int i = 0; i < PATH_AXES; i++) {
        step[i] = pl->pos[i] - before[i];
        left[i] = g->prim.end[i] - pl->pos[i];
    }
    to_pose(left, &tp_mot.status->dtg);
    tp_mot.status->distance_to_go = (g->s1 - tj->place) / g->stretch;
    speed = path_group_norm(step, g->prim.metric) / pl->cycle;
    requested = fmin(g->feed * (tj->drive.hold ? 0 : tj->drive.scale), g->vmax);
    if (g->prim.metric != PATH_ABC) requested = fmin(requested, tj->drive.vlimit);
    scale_allowed(pl, g);
    rate = tj->acc / g->stretch;
    tp_mot.status->current_jerk = (rate - tp_mot.status->current_acc) / pl->cycle;
    tp_mot.status->current_acc = rate;
    tp_mot.status->current_vel = speed;
    tp_mot.status->requested_vel = requested;
    if (tp_mot.status->external_offsets_applied) tp_mot.status->decel_dist = traj_stop_distance(tj) / g->stretch;
    to_pose(step, &pose);
    double len = sqrt(pose.tran.x * pose.tran.x + pose.tran.y * pose.tran.y + pose.tran.z * pose.tran.z);
    if (len > 0) tp_mot.status->current_dir = (PmCartesian){ pose.tran.x / len, pose.tran.y / len, pose.tran.z / len };
    tp_mot.status->tcqlen = tp_depth(pl);
}

/* Where motion shall rest though the path goes on; NAN: nowhere. */
static double stop_place(struct planner *pl)
{
    struct traj *tj = &pl->tj;

    if (tj->drive.reverse) {
        /* back as far as moves can be undone: none that followed a spindle */
        for (uint32_t i = tj->cur;; i--) {
            const struct move_info *info = info_of(pl, i);
            if (info->sync.mode != SYNC_OFF || info->tap || info->indexer >= 0) return traj_seg(tj, i)->s1;
            if (i == tj->first || tj->cur - i > REVERSE_LOOK) return NAN;
        }
    }
    return tp_mot.status->stepping ? traj_seg(tj, tj->cur)->s1 : NAN;
}

/* Motion that stands though moves are queued and nothing that motmod shows holds it: says why. */
static void watch_standing(struct planner *pl, double place)
{
    struct traj *tj = &pl->tj;
    const struct traj_seg *g = traj_seg(tj, tj->cur);
    const struct move_info *info = info_of(pl, tj->cur);
    double before = pl->standing;

    if (tj->place != place || tj->end == tj->first || tj->drive.hold || tj->drive.reverse || tj->in_mark ||
        traj_waiting(tj) >= 0 || !(tj->drive.scale > 0) || !isnan(tj->drive.stop_s)) {
        pl->standing = 0;
        return;
    }
    pl->standing += pl->cycle;
    if (before >= STAND_TIME || pl->standing < STAND_TIME) return;
    if (info->sync.mode != SYNC_OFF)
        rtapi_print_msg(RTAPI_MSG_ERR, "line %d waits: spindle %d does not turn\n", info->id, info->sync.spindle);
    else if (!(g->feed > 0))
        rtapi_print_msg(RTAPI_MSG_ERR, "line %d waits: its feed is zero\n", info->id);
    else if (!(tj->drive.vlimit > 0))
        rtapi_print_msg(RTAPI_MSG_ERR, "line %d waits: the limit of speed is set to zero\n", info->id);
    else
        rtapi_print_msg(RTAPI_MSG_ERR,
                        "line %d: motion stands for %g s without a reason, %u moves queued; "
                        "place %.9g in %.9g to %.9g, cells %u %u %u, final to %.9g\n",
                        info->id, STAND_TIME, tp_depth(pl), tj->place, g->s0, g->s1, tj->cell_first,
                        tj->cell, tj->cell_end, tj->s_final);
}

/* Moves to machine coordinates are made without the offsets of the axes they name; these come back with the next move
 * in work coordinates. */
static void spare_offsets(const struct planner *pl)
{
    int *spare = &tp_mot.status->offsets_spare;
    *spare = pl->exec_tag.fields[GM_FIELD_MACHINE_AXES] ? *spare | tp_spared_axes(&pl->exec_tag) : 0;
}

int tpRunCycle(TP_STRUCT *tp, long period)
{
    struct planner *pl = planner_of(tp);
    double before[PATH_AXES];

    (void)period;
    if (!pl) return TP_ERR_FAIL;
    struct traj *tj = &pl->tj;
    spare_offsets(pl);
    if (tj->end == tj->first) {
        if (pl->aborting) tp_forget_moves(tp, pl, 1);
        pl->pausing = 0; /* a pause holds the moves there are: MDI moves go on under it */
        idle_status(pl);
        return TP_ERR_WAITING;
    }
    tp_measure_spindle(pl);
    if (pl->aborting && traj_at_rest(tj) && tp_tap_at_rest(pl)) {
        if (pl->unlocked_joint >= 0) tp_mot.set_rotary_unlock(pl->unlocked_joint, 0);
        pl->unlocked_joint = -1;
        tp_forget_moves(tp, pl, 1);
        idle_status(pl);
        return TP_ERR_STOPPED;
    }
    const struct traj_seg *now = traj_seg(tj, tj->cur);
    tj->drive.scale = tp_mot.status->net_feed_scale;
    tj->drive.max_scale = tp_mot.config->maxFeedScale;
    tj->drive.vlimit = pl->vlimit;
    tj->drive.reverse = tp->reverse_run == TC_DIR_REVERSE;
    /* a move that follows a spindle's position is not paused */
    tj->drive.hold = pl->aborting || (pl->pausing && now->follow != TRAJ_SYNC_POSITION);
    tj->drive.stop_s = stop_place(pl);
    memcpy(before, pl->pos, sizeof before);

    int64_t waiting = traj_waiting(tj);
    if (waiting >= 0 && may_start(tp, pl, (uint32_t)waiting)) traj_release(tj);
    tj->drive.sync_speed = tp_sync_speed(pl);
    uint32_t from = tj->cur;
    double place = tj->place;
    traj_cycle(tj);
    pl->resting = tj->place != place ? 0 : pl->resting < 1000 ? pl->resting + 1 : pl->resting;
    watch_standing(pl, place);
    tp_watch_waiting(tp, pl);
    memcpy(pl->pos, tj->pos, sizeof pl->pos);
    tp_follow_moves(pl, from);
    enter_moves(pl);
    if (tj->in_mark) {
        tp_run_tap(pl, info_of(pl, tj->cur));
        for (int i = 0; i < PATH_AXES; i++) pl->pos[i] += pl->tap.dir[i] * pl->tap.place;
    }
    moving_status(pl, before);
    if (traj_blocked(tj) && !pl->aborting) {
        rtapi_print_msg(RTAPI_MSG_ERR, "kinematicsInverse failed: line %d cannot be followed beyond this place\n",
                        pl->exec_id);
        tp_fail(pl);
    }
    if (traj_done(tj) && rotary_locked(pl) && !tp_mot.status->offsets_leave) {
        tp_check_phase(pl);
        tp_forget_moves(tp, pl, 1);
        idle_status(pl);
    }
    return TP_ERR_OK;
}
