/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * tp.c - the planner's interface to motmod: settings, and moves into the queue.
 *
 * Geometry, look-ahead and execution are traj.c; here is what belongs to a move
 * beside its path: ids, tags, outputs, waits for spindles and rotary locks.
 * Its cycle is tp_cycle.c. No HAL in here: module.c makes the realtime module, tests link this file.
 */
#include "tp_priv.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "rtapi.h"

#define QUEUE_SIZE 2000   /* moves, documented */
#define QUEUE_MARGIN 220  /* full so many moves before */

struct tp_mot tp_mot;
hal_bool_t *tp_work_only;

static void from_pose(const EmcPose *pose, double p[PATH_AXES])
{
    p[PATH_X] = pose->tran.x, p[PATH_Y] = pose->tran.y, p[PATH_Z] = pose->tran.z;
    p[PATH_A] = pose->a, p[PATH_B] = pose->b, p[PATH_C] = pose->c;
    p[PATH_U] = pose->u, p[PATH_V] = pose->v, p[PATH_W] = pose->w;
}

void tpMotFunctions(void (*DioWrite)(int idx, char val), void (*AioWrite)(int idx, double val),
                    void (*SetRotaryUnlock)(int joint, int unlock), int (*GetRotaryIsUnlocked)(int joint),
                    double (*axis_get_vel_limit)(int axis), double (*axis_get_acc_limit)(int axis))
{
    tp_mot.dio_write = DioWrite;
    tp_mot.aio_write = AioWrite;
    tp_mot.set_rotary_unlock = SetRotaryUnlock;
    tp_mot.get_rotary_is_unlocked = GetRotaryIsUnlocked;
    tp_mot.axis_vel_limit = axis_get_vel_limit;
    tp_mot.axis_acc_limit = axis_get_acc_limit;
}

void tpMotMachine(const struct tp_machine *the_machine)
{
    tp_mot.machine = the_machine;
}

static int machine_joints(void)
{
    return tp_mot.machine ? tp_mot.machine->joints() : 0;
}

static int machine_inverse(const double p[PATH_AXES], double q[LIMITS_JOINTS])
{
    EmcPose pose;
    to_pose(p, &pose);
    return tp_mot.machine->inverse(&pose, q);
}

static void machine_seed(double q[LIMITS_JOINTS])
{
    tp_mot.machine->joint_commands(q);
}

static void joint_limits(int joint, double limit[3])
{
    tp_mot.machine->joint_limits(joint, &limit[0], &limit[1], &limit[2]);
}

static void axis_limits(int axis, double limit[3])
{
    limit[0] = tp_mot.axis_vel_limit ? tp_mot.axis_vel_limit(axis) : 0;
    limit[1] = tp_mot.axis_acc_limit ? tp_mot.axis_acc_limit(axis) : 0;
    limit[2] = tp_mot.machine ? tp_mot.machine->axis_jerk(axis) : 0;
}

static const struct limits_source limits_source = { machine_joints, machine_inverse, machine_seed, joint_limits,
                                                    axis_limits };

void tpMotData(emcmot_status_t *motion_status, emcmot_config_t *motion_config)
{
    tp_mot.status = motion_status;
    tp_mot.config = motion_config;
}

/* ---- settings ---------------------------------------------------------------- */

void tp_forget_moves(TP_STRUCT *tp, struct planner *pl, int keep_tag)
{
    traj_reset(&pl->tj, pl->pos);
    memcpy(pl->goal, pl->pos, sizeof pl->goal);
    pl->exec_id = 0;
    pl->canon = 0;
    pl->pausing = pl->aborting = 0;
    pl->done = 1;
    pl->entered = -1;
    pl->tap.state = TAP_IDLE;
    if (pl->starting == START_INDEX) tp_mot.status->spindle_status[pl->followed].spindle_index_enable = 0;
    pl->starting = START_NONE;
    pl->followed = pl->out_of_phase = -1;
    if (tp_mot.status) tp_mot.status->spindleSync = 0;
    if (!keep_tag) memset(&pl->exec_tag, 0, sizeof pl->exec_tag);
    tp->spindle.waiting_for_index = tp->spindle.waiting_for_atspeed = -1;
    tp->reverse_run = TC_DIR_FORWARD;
}

void tp_fail(struct planner *pl)
{
    tp_mot.status->motionFlag |= EMCMOT_MOTION_ERROR_BIT;
    pl->pausing = pl->aborting = 1;
}

/* [init] Memory of the planner is taken here, and kept until the module goes. */
int tpCreate(TP_STRUCT *tp, int queue_size, int id)
{
    (void)queue_size;
    if (!tp) return TP_ERR_FAIL;
    if (!tp->impl) tp->impl = calloc(1, sizeof(struct planner));
    struct planner *pl = tp->impl;
    if (!pl) return TP_ERR_FAIL;
    memset(pl, 0, sizeof *pl);
    tp->queue.impl = pl;
    pl->cycle = 0.001;
    pl->next_id = id;
    pl->term = TRAJ_BLEND;
    pl->vlimit = 1e99;
    pl->unlocked_joint = pl->followed = -1;
    traj_init(&pl->tj, pl->cycle);
    pl->tj.lim.source = &limits_source;
    tp_forget_moves(tp, pl, 0);
    return TP_ERR_OK;
}

int tpClear(TP_STRUCT *tp)
{
    struct planner *pl = planner_of(tp);
    if (!pl) return TP_ERR_FAIL;
    tp_forget_moves(tp, pl, 0);
    memset(&pl->pending, 0, sizeof pl->pending);
    pl->unlocked_joint = -1;
    tp_mot.status->motionFlag |= EMCMOT_MOTION_INPOS_BIT;
    return TP_ERR_OK;
}

int tpSetCycleTime(TP_STRUCT *tp, double secs)
{
    struct planner *pl = planner_of(tp);
    if (!pl || !(secs > 0)) return TP_ERR_FAIL;
    pl->cycle = pl->tj.dt = secs;
    return TP_ERR_OK;
}

int tpSetVmax(TP_STRUCT *tp, double vmax, double ini_maxvel)
{
    struct planner *pl = planner_of(tp);
    if (!pl || vmax < 0 || ini_maxvel < 0) return TP_ERR_FAIL;
    pl->vmax = vmax;
    pl->ini_maxvel = ini_maxvel;
    return TP_ERR_OK;
}

int tpSetVlimit(TP_STRUCT *tp, double limit)
{
    struct planner *pl = planner_of(tp);
    if (!pl) return TP_ERR_FAIL;
    pl->vlimit = limit > 0 ? limit : 0;
    return TP_ERR_OK;
}

int tpSetAmax(TP_STRUCT *tp, double amax)
{
    struct planner *pl = planner_of(tp);
    if (!pl || !(amax > 0)) return TP_ERR_FAIL;
    pl->amax = amax;
    return TP_ERR_OK;
}

int tpSetId(TP_STRUCT *tp, int id)
{
    struct planner *pl = planner_of(tp);
    if (!pl) return TP_ERR_FAIL;
    pl->next_id = id;
    return TP_ERR_OK;
}

int tpGetExecId(TP_STRUCT *tp)
{
    struct planner *pl = planner_of(tp);
    return pl ? pl->exec_id : TP_ERR_FAIL;
}

struct state_tag_t tpGetExecTag(TP_STRUCT *tp)
{
    struct planner *pl = planner_of(tp);
    static const struct state_tag_t none;
    return pl ? pl->exec_tag : none;
}

int tpSetTermCond(TP_STRUCT *tp, int cond, double tolerance)
{
    struct planner *pl = planner_of(tp);
    if (!pl) return TP_ERR_FAIL;
    switch (cond) {
    case EMCMOT_TERM_COND_STOP: pl->term = TRAJ_STOP; break;
    case EMCMOT_TERM_COND_EXACT: pl->term = TRAJ_EXACT; break;
    case EMCMOT_TERM_COND_BLEND: pl->term = TRAJ_BLEND; break;
    default: return TP_ERR_FAIL;
    }
    pl->tolerance = tolerance > 0 ? tolerance : 0;
    return TP_ERR_OK;
}

int tpSetPos(TP_STRUCT *tp, EmcPose const *pos)
{
    struct planner *pl = planner_of(tp);
    if (!pl || !pos) return TP_ERR_MISSING_INPUT;
    if (pl->tj.end != pl->tj.first) return TP_ERR_FAIL; /* a path is being followed */
    from_pose(pos, pl->pos);
    memcpy(pl->goal, pl->pos, sizeof pl->goal);
    traj_reset(&pl->tj, pl->pos);
    return TP_ERR_OK;
}

int tpGetPos(TP_STRUCT const *tp, EmcPose *pos)
{
    struct planner *pl = planner_of(tp);
    if (!pl || !pos) return TP_ERR_FAIL;
    to_pose(pl->pos, pos);
    return TP_ERR_OK;
}

int tpPause(TP_STRUCT *tp)
{
    struct planner *pl = planner_of(tp);
    if (!pl) return TP_ERR_FAIL;
    pl->pausing = 1;
    return TP_ERR_OK;
}

int tpResume(TP_STRUCT *tp)
{
    struct planner *pl = planner_of(tp);
    if (!pl) return TP_ERR_FAIL;
    pl->pausing = 0;
    return TP_ERR_OK;
}

int tpAbort(TP_STRUCT *tp)
{
    struct planner *pl = planner_of(tp);
    if (!pl) return TP_ERR_FAIL;
    memset(&pl->pending, 0, sizeof pl->pending);
    if (pl->aborting) return TP_ERR_OK;
    pl->pausing = pl->aborting = 1;
    return TP_ERR_OK;
}

int tpSetRunDir(TP_STRUCT *tp, tc_direction_t dir)
{
    struct planner *pl = planner_of(tp);
    if (!pl) return TP_ERR_FAIL;
    if (!traj_at_rest(&pl->tj)) return TP_ERR_FAIL;
    if (tp->spindle.waiting_for_index >= 0 || tp->spindle.waiting_for_atspeed >= 0) return TP_ERR_FAIL;
    switch (dir) {
    case TC_DIR_FORWARD:
    case TC_DIR_REVERSE: tp->reverse_run = dir; return TP_ERR_OK;
    default: return TP_ERR_FAIL;
    }
}

/* ---- queue ---------------------------------------------------------------------- */

int tpIsDone(TP_STRUCT *tp)
{
    struct planner *pl = planner_of(tp);
    return pl ? pl->done : 0;
}

uint32_t tp_depth(const struct planner *pl)
{
    int64_t waiting = traj_waiting(&pl->tj);
    return pl->tj.end - (waiting >= 0 ? (uint32_t)waiting : pl->tj.cur);
}

int tpQueueDepth(TP_STRUCT *tp)
{
    struct planner *pl = planner_of(tp);
    return pl ? (int)tp_depth(pl) : 0;
}

int tpActiveDepth(TP_STRUCT *tp)
{
    struct planner *pl = planner_of(tp);
    return pl ? traj_active(&pl->tj) : 0;
}

int tpGetMotionType(TP_STRUCT *tp)
{
    struct planner *pl = planner_of(tp);
    return pl ? pl->canon : 0;
}

int tcqFull(TC_QUEUE_STRUCT const *queue)
{
    const struct planner *pl = queue ? queue->impl : NULL;
    return !pl || tp_depth(pl) >= QUEUE_SIZE - QUEUE_MARGIN;
}

int tpSetSpindleSync(TP_STRUCT *tp, int spindle, double sync, int velocity_mode)
{
    struct planner *pl = planner_of(tp);
    if (!pl) return TP_ERR_FAIL;
    if (sync == 0) {
        pl->sync.mode = SYNC_OFF;
        return TP_ERR_OK;
    }
    if (!isfinite(sync) || spindle < 0 || spindle >= EMCMOT_MAX_SPINDLES) return TP_ERR_RANGE;
    pl->sync.mode = velocity_mode ? SYNC_SPEED : SYNC_POSITION;
    pl->sync.spindle = spindle;
    pl->sync.upr = fabs(sync);
    return TP_ERR_OK;
}

int tpSetAout(TP_STRUCT *tp, unsigned char index, double start, double end)
{
    struct planner *pl = planner_of(tp);
    (void)end;
    if (!pl) return TP_ERR_FAIL;
    if (index >= NUM_OUT) return TP_ERR_RANGE;
    pl->pending.analog |= 1ull << index;
    pl->pending.analog_value[index] = start;
    return TP_ERR_OK;
}

int tpSetDout(TP_STRUCT *tp, int index, unsigned char start, unsigned char end)
{
    struct planner *pl = planner_of(tp);
    (void)end;
    if (!pl) return TP_ERR_FAIL;
    if (index < 0 || index >= NUM_OUT) return TP_ERR_RANGE;
    pl->pending.digital |= 1ull << index;
    if (start) pl->pending.digital_value |= 1ull << index;
    else pl->pending.digital_value &= ~(1ull << index);
    return TP_ERR_OK;
}

static int result_of(enum path_result r)
{
    switch (r) {
    case PATH_OK: return TP_ERR_OK;
    case PATH_ZERO_LENGTH: return TP_ERR_ZERO_LENGTH;
    case PATH_BAD_RADIUS: return TP_ERR_RADIUS_TOO_SMALL;
    case PATH_BAD_NORMAL: break;
    }
    return TP_ERR_GEOM;
}

/* What all kinds of moves check first. */
static int check_add(const struct planner *pl, double vel, double ini_maxvel, double acc)
{
    if (!pl) return TP_ERR_FAIL;
    if (pl->aborting) {
        rtapi_print_msg(RTAPI_MSG_ERR, "TP is aborting\n");
        return TP_ERR_FAIL;
    }
    if (!isfinite(vel) || !isfinite(ini_maxvel) || !isfinite(acc) || vel < 0 || ini_maxvel < 0 || !(acc > 0))
        return TP_ERR_INVALID;
    if (tp_depth(pl) >= QUEUE_SIZE) {
        rtapi_print_msg(RTAPI_MSG_ERR, "tcqPut failed.\n");
        return TP_ERR_FAIL;
    }
    return TP_ERR_OK;
}

/* Limits as they are now; a path that begins also learns how joints depend on the pose. */
static void read_limits(struct planner *pl)
{
    struct traj *tj = &pl->tj;

    if (tj->end == tj->first) limits_probe(&tj->lim, pl->goal);
    limits_read(&tj->lim, tp_mot.status->planner_type == 1, tp_mot.status->jerk);
}

/* FP-044: a jerk-limited planner without limits of jerk is told about, once. */
static void note_no_jerk(const struct planner *pl, const struct traj_move *move, int64_t index)
{
    static int told;
    const struct traj *tj = &pl->tj;

    if (told || !tj->lim.jerk_on || fmin(move->jerk, tp_mot.status->jerk) >= 1 || move->mark) return;
    if (traj_jerk(tj, traj_cseg(tj, (uint32_t)index)) > 0) return; /* joints have one */
    told = 1;
    rtapi_print_msg(RTAPI_MSG_ERR, "S-curve: segment max jerk < 1 (unset [AXIS_*]MAX_JERK or [TRAJ]MAX_LINEAR_JERK?) - "
                    "trapezoidal fallback used for such segments (reported once)\n");
}

int tp_spared_axes(const struct state_tag_t *tag)
{
    int axes = 0;
    for (int n = 0; tp_work_only && n < PATH_AXES; n++)
        axes |= (hal_get_bool(tp_work_only[n]) && (tag->fields[GM_FIELD_MACHINE_AXES] >> n & 1)) << n;
    return axes;
}

/* External offsets leave or come back between these moves. */
static int offsets_change(const struct move_info *prev, const struct move_info *info)
{
    return tp_spared_axes(&prev->tag) != tp_spared_axes(&info->tag);
}

/* Appends a move whose path, feed and info are filled in, except for outputs and sync. */
static int append(struct planner *pl, struct traj_move *move, struct move_info *info)
{
    static const enum traj_follow follows[] = { TRAJ_FEED, TRAJ_SYNC_SPEED, TRAJ_SYNC_POSITION };
    struct traj *tj = &pl->tj;

    read_limits(pl);
    tj->drive.max_scale = tp_mot.config->maxFeedScale;
    move->end = pl->term;
    move->tol = pl->tolerance;
    info->sync = pl->sync;
    if (!info->tap) move->follow = follows[info->sync.mode];
    if (tj->end != tj->first) {
        const struct move_info *prev = info_of(pl, tj->end - 1);
        int goes_on = prev->sync.mode == SYNC_POSITION && prev->sync.spindle == info->sync.spindle && !prev->tap;
        if ((prev->canon == EMC_MOTION_TYPE_TRAVERSE) != (info->canon == EMC_MOTION_TYPE_TRAVERSE) ||
            offsets_change(prev, info) || info->atspeed || prev->indexer >= 0 || info->indexer >= 0 ||
            (info->sync.mode == SYNC_POSITION && !goes_on))
            move->rest_before = 1;
    }
    int64_t index = traj_append(tj, move);
    if (index < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "tcqPut failed.\n");
        return TP_ERR_FAIL;
    }
    note_no_jerk(pl, move, index);
    struct move_info *stored = &pl->info[index & (TRAJ_SEGS - 1)];
    *stored = *info;
    stored->has_outputs = pl->pending.digital || pl->pending.analog;
    if (stored->has_outputs) stored->outputs = pl->pending;
    pl->pending.digital = pl->pending.analog = pl->pending.digital_value = 0;
    memcpy(pl->goal, move->prim.end, sizeof pl->goal);
    pl->done = 0;
    return TP_ERR_OK;
}

int tpAddLine(TP_STRUCT *tp, EmcPose end, int canon_motion_type, double vel, double ini_maxvel, double acc,
              double ini_maxjerk, unsigned char enables, char atspeed, int indexer_jnum, struct state_tag_t tag)
{
    struct planner *pl = planner_of(tp);
    struct traj_move move = { .feed = vel, .vmax = ini_maxvel, .acc = acc, .jerk = ini_maxjerk };
    double to[PATH_AXES];
    int r = check_add(pl, vel, ini_maxvel, acc);

    if (r != TP_ERR_OK) return r;
    from_pose(&end, to);
    r = result_of(path_line(&move.prim, pl->goal, to));
    if (r != TP_ERR_OK) return r;
    struct move_info *info = &pl->scratch;
    *info = (struct move_info){ .id = pl->next_id, .canon = canon_motion_type, .enables = enables,
                                .atspeed = atspeed, .indexer = indexer_jnum, .tag = tag };
    return append(pl, &move, info);
}

int tpAddCircle(TP_STRUCT *tp, EmcPose end, PmCartesian center, PmCartesian normal, int turn,
                int canon_motion_type, double vel, double ini_maxvel, double acc, double ini_maxjerk,
                unsigned char enables, char atspeed, struct state_tag_t tag)
{
    struct planner *pl = planner_of(tp);
    struct traj_move move = { .feed = vel, .vmax = ini_maxvel, .acc = acc, .jerk = ini_maxjerk };
    double to[PATH_AXES], c[3] = { center.x, center.y, center.z }, n[3] = { normal.x, normal.y, normal.z };
    int r = check_add(pl, vel, ini_maxvel, acc);

    if (r != TP_ERR_OK) return r;
    from_pose(&end, to);
    r = result_of(path_arc(&move.prim, pl->goal, to, c, n, turn));
    if (r != TP_ERR_OK) return r;
    struct move_info *info = &pl->scratch;
    *info = (struct move_info){ .id = pl->next_id, .canon = canon_motion_type, .enables = enables,
                                .atspeed = atspeed, .indexer = -1, .tag = tag };
    return append(pl, &move, info);
}

int tpAddRigidTap(TP_STRUCT *tp, EmcPose end, double vel, double ini_maxvel, double acc, double ini_maxjerk,
                  unsigned char enables, double scale, struct state_tag_t tag)
{
    struct planner *pl = planner_of(tp);
    struct traj_move move = { .feed = vel, .vmax = ini_maxvel, .acc = acc, .jerk = ini_maxjerk, .mark = 1 };
    struct path_prim hole;
    double to[PATH_AXES];
    int r = check_add(pl, vel, ini_maxvel, acc);

    if (r != TP_ERR_OK) return r;
    if (pl->sync.mode == SYNC_OFF) {
        rtapi_print_msg(RTAPI_MSG_ERR, "Cannot add unsynchronized rigid tap move.\n");
        return TP_ERR_FAIL;
    }
    from_pose(&end, to);
    memcpy(to + 3, pl->goal + 3, 6 * sizeof *to); /* only xyz taps */
    r = result_of(path_line(&hole, pl->goal, to));
    if (r != TP_ERR_OK) return r;
    struct move_info *info = &pl->scratch;
    *info = (struct move_info){ .id = pl->next_id, .canon = 0, .enables = enables, .indexer = -1, .tap = 1,
                                .tap_scale = scale > 0 ? scale : 1, .tap_vmax = ini_maxvel, .tap_acc = acc,
                                .tap_feed = vel, .tag = tag };
    info->tap_window = 1;
    if (tp_mot.status->planner_type == 1 && ini_maxjerk > 0) {
        read_limits(pl);
        info->tap_window = traj_window(&pl->tj, ini_maxvel, acc, ini_maxjerk, 2);
        info->tap_acc = fmin(acc, ini_maxjerk * info->tap_window * pl->cycle / 2);
    }
    memcpy(info->tap_end, to, sizeof info->tap_end);
    /* In the path it is a mark: it ends where it began. */
    memcpy(move.prim.start, pl->goal, sizeof move.prim.start);
    memcpy(move.prim.end, pl->goal, sizeof move.prim.end);
    return append(pl, &move, info);
}
