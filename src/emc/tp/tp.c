/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * tp.c - the planner's interface to motmod: moves in, positions and status out.
 *
 * Geometry, look-ahead and execution are traj.c; here is what belongs to a move
 * beside its path: ids, tags, outputs, waits for spindles and rotary locks.
 * No HAL in here: module.c makes the realtime module, tests link this file.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "rtapi.h"
#include "tp.h"
#include "traj.h"

#define QUEUE_SIZE 2000   /* moves, documented */
#define QUEUE_MARGIN 220  /* full so many moves before */
#define NUM_OUT 64        /* synchronised outputs of a kind */
#define REST_SPEED 1e-8   /* units/s: slower counts as stopped */

/* Outputs that a move switches when it starts. */
struct outputs {
    uint64_t digital;       /* channels to write */
    uint64_t digital_value;
    uint64_t analog;
    double analog_value[NUM_OUT];
};

/* What belongs to a move beside its path. */
struct move_info {
    int id;
    int canon;              /* EMC_MOTION_TYPE_* */
    unsigned char enables;
    char atspeed;           /* wait for all spindles before it */
    int indexer;            /* joint to unlock for it, -1 none */
    double axis_feed;       /* requested speed in its metric, units/s */
    struct state_tag_t tag;
    int has_outputs;
    struct outputs outputs;
};

struct planner {
    struct traj tj;
    struct move_info info[TRAJ_SEGS];
    double cycle;           /* s */
    double pos[PATH_AXES];  /* last position given to motmod */
    double goal[PATH_AXES]; /* end of the last move of the queue */
    int next_id;
    int exec_id;
    struct state_tag_t exec_tag;
    int canon;              /* of the executing move, 0 idle */
    enum traj_end term;     /* of moves to come */
    double tolerance;
    double vmax, ini_maxvel, vlimit, amax;
    int pausing, aborting;
    int done;
    int64_t entered;        /* last move whose start was reported, -1 none */
    int unlocked_joint;     /* rotary joint that was unlocked for the executing move, -1 none */
    struct outputs pending; /* of the next move appended */
    struct move_info scratch; /* a move on its way into the queue */
};

static void (*dio_write)(int idx, char val);
static void (*aio_write)(int idx, double val);
static void (*set_rotary_unlock)(int joint, int unlock);
static int (*get_rotary_is_unlocked)(int joint);
static double (*axis_vel_limit)(int axis);
static double (*axis_acc_limit)(int axis);
static emcmot_status_t *status;
static emcmot_config_t *config;

static struct planner *planner_of(const TP_STRUCT *tp)
{
    return tp ? tp->impl : NULL;
}

static void from_pose(const EmcPose *pose, double p[PATH_AXES])
{
    p[PATH_X] = pose->tran.x, p[PATH_Y] = pose->tran.y, p[PATH_Z] = pose->tran.z;
    p[PATH_A] = pose->a, p[PATH_B] = pose->b, p[PATH_C] = pose->c;
    p[PATH_U] = pose->u, p[PATH_V] = pose->v, p[PATH_W] = pose->w;
}

static void to_pose(const double p[PATH_AXES], EmcPose *pose)
{
    pose->tran.x = p[PATH_X], pose->tran.y = p[PATH_Y], pose->tran.z = p[PATH_Z];
    pose->a = p[PATH_A], pose->b = p[PATH_B], pose->c = p[PATH_C];
    pose->u = p[PATH_U], pose->v = p[PATH_V], pose->w = p[PATH_W];
}

void tpMotFunctions(void (*DioWrite)(int idx, char val), void (*AioWrite)(int idx, double val),
                    void (*SetRotaryUnlock)(int joint, int unlock), int (*GetRotaryIsUnlocked)(int joint),
                    double (*axis_get_vel_limit)(int axis), double (*axis_get_acc_limit)(int axis))
{
    dio_write = DioWrite;
    aio_write = AioWrite;
    set_rotary_unlock = SetRotaryUnlock;
    get_rotary_is_unlocked = GetRotaryIsUnlocked;
    axis_vel_limit = axis_get_vel_limit;
    axis_acc_limit = axis_get_acc_limit;
}

void tpMotData(emcmot_status_t *motion_status, emcmot_config_t *motion_config)
{
    status = motion_status;
    config = motion_config;
}

/* ---- settings ---------------------------------------------------------------- */

/* Back to an empty queue at rest at p; `keep_tag`: the tag of the last move stays readable. */
static void forget_moves(TP_STRUCT *tp, struct planner *pl, int keep_tag)
{
    traj_reset(&pl->tj, pl->pos);
    memcpy(pl->goal, pl->pos, sizeof pl->goal);
    pl->exec_id = 0;
    pl->canon = 0;
    pl->pausing = pl->aborting = 0;
    pl->done = 1;
    pl->entered = -1;
    if (!keep_tag) memset(&pl->exec_tag, 0, sizeof pl->exec_tag);
    tp->spindle.waiting_for_index = tp->spindle.waiting_for_atspeed = -1;
    tp->reverse_run = TC_DIR_FORWARD;
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
    pl->unlocked_joint = -1;
    traj_init(&pl->tj, pl->cycle);
    forget_moves(tp, pl, 0);
    return TP_ERR_OK;
}

int tpClear(TP_STRUCT *tp)
{
    struct planner *pl = planner_of(tp);
    if (!pl) return TP_ERR_FAIL;
    forget_moves(tp, pl, 0);
    memset(&pl->pending, 0, sizeof pl->pending);
    pl->unlocked_joint = -1;
    status->motionFlag |= EMCMOT_MOTION_INPOS_BIT;
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

static uint32_t depth(const struct planner *pl)
{
    return pl->tj.end - pl->tj.cur;
}

int tpQueueDepth(TP_STRUCT *tp)
{
    struct planner *pl = planner_of(tp);
    return pl ? (int)depth(pl) : 0;
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
    return !pl || depth(pl) >= QUEUE_SIZE - QUEUE_MARGIN;
}

int tpSetSpindleSync(TP_STRUCT *tp, int spindle, double sync, int velocity_mode)
{
    struct planner *pl = planner_of(tp);
    (void)spindle, (void)sync, (void)velocity_mode;
    return pl ? TP_ERR_OK : TP_ERR_FAIL;
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

static void write_outputs(const struct outputs *out)
{
    for (int i = 0; i < NUM_OUT; i++) {
        if (out->digital >> i & 1) dio_write(i, (char)(out->digital_value >> i & 1));
        if (out->analog >> i & 1) aio_write(i, out->analog_value[i]);
    }
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
    if (depth(pl) >= QUEUE_SIZE) {
        rtapi_print_msg(RTAPI_MSG_ERR, "tcqPut failed.\n");
        return TP_ERR_FAIL;
    }
    return TP_ERR_OK;
}

static void read_limits(struct planner *pl)
{
    for (int i = 0; i < PATH_AXES; i++) {
        pl->tj.lim.v[i] = axis_vel_limit ? axis_vel_limit(i) : 0;
        pl->tj.lim.a[i] = axis_acc_limit ? axis_acc_limit(i) : 0;
    }
}

/* Appends a move whose path, feed and info are filled in, except for the outputs. */
static int append(struct planner *pl, struct traj_move *move, const struct move_info *info)
{
    struct traj *tj = &pl->tj;

    read_limits(pl);
    tj->drive.max_scale = config->maxFeedScale;
    move->end = pl->term;
    move->tol = pl->tolerance;
    if (tj->end != tj->first) {
        const struct move_info *prev = &pl->info[(tj->end - 1) & (TRAJ_SEGS - 1)];
        if ((prev->canon == EMC_MOTION_TYPE_TRAVERSE) != (info->canon == EMC_MOTION_TYPE_TRAVERSE) ||
            info->atspeed || prev->indexer >= 0 || info->indexer >= 0)
            move->rest_before = 1;
    }
    int64_t index = traj_append(tj, move);
    if (index < 0) {
        rtapi_print_msg(RTAPI_MSG_ERR, "tcqPut failed.\n");
        return TP_ERR_FAIL;
    }
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
                                .atspeed = atspeed, .indexer = indexer_jnum, .axis_feed = vel, .tag = tag };
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
                                .atspeed = atspeed, .indexer = -1, .axis_feed = vel, .tag = tag };
    return append(pl, &move, info);
}

int tpAddRigidTap(TP_STRUCT *tp, EmcPose end, double vel, double ini_maxvel, double acc, double ini_maxjerk,
                  unsigned char enables, double scale, struct state_tag_t tag)
{
    struct planner *pl = planner_of(tp);
    int r = check_add(pl, vel, ini_maxvel, acc);

    (void)end, (void)ini_maxjerk, (void)enables, (void)scale, (void)tag;
    if (r != TP_ERR_OK) return r;
    rtapi_print_msg(RTAPI_MSG_ERR, "Cannot add unsynchronized rigid tap move.\n");
    return TP_ERR_FAIL;
}

/* ---- servo cycle ------------------------------------------------------------------ */

static void idle_status(struct planner *pl)
{
    status->enables_queued = status->enables_new;
    status->distance_to_go = 0;
    ZERO_EMC_POSE(status->dtg);
    status->current_vel = status->requested_vel = 0;
    status->current_acc = status->current_jerk = 0;
    status->current_dir = (PmCartesian){ 0, 0, 0 };
    status->tcqlen = 0;
    status->spindleSync = 0;
    pl->canon = 0;
    pl->exec_id = 0;
}

/* All spindles of the machine turn as commanded. */
static int spindles_at_speed(void)
{
    for (int i = 0; i < config->numSpindles; i++)
        if (!status->spindle_status[i].at_speed) return 0;
    return 1;
}

/* Locks the rotary joint of the move that ended. 0: still unlocked. */
static int rotary_locked(struct planner *pl)
{
    if (pl->unlocked_joint < 0) return 1;
    set_rotary_unlock(pl->unlocked_joint, 0);
    if (get_rotary_is_unlocked(pl->unlocked_joint)) return 0;
    pl->unlocked_joint = -1;
    return 1;
}

/* May the move that waits begin? */
static int may_start(TP_STRUCT *tp, struct planner *pl, const struct move_info *info)
{
    if (pl->pausing || !rotary_locked(pl)) return 0;
    if (info->atspeed && !spindles_at_speed()) {
        tp->spindle.waiting_for_atspeed = info->id;
        return 0;
    }
    tp->spindle.waiting_for_atspeed = -1;
    if (info->indexer >= 0) {
        set_rotary_unlock(info->indexer, 1);
        pl->unlocked_joint = info->indexer;
        if (!get_rotary_is_unlocked(info->indexer)) return 0;
    }
    return 1;
}

/* Reports moves whose start was passed: id, tag, outputs, each once and in order. */
static void enter_moves(struct planner *pl)
{
    struct traj *tj = &pl->tj;
    int64_t waiting = traj_waiting(tj), last = tj->cur;

    if (waiting >= 0 && last == waiting) {
        const struct move_info *info = &pl->info[waiting & (TRAJ_SEGS - 1)];
        pl->exec_id = info->id;
        pl->canon = info->canon;
        status->enables_queued = info->enables;
        last--;
    }
    if (last < pl->entered) pl->entered = last; /* running backward: outputs stay as they are */
    while (pl->entered < last) {
        pl->entered++;
        if (pl->entered < (int64_t)tj->first) continue;
        const struct move_info *info = &pl->info[pl->entered & (TRAJ_SEGS - 1)];
        if (info->has_outputs) write_outputs(&info->outputs);
    }
    if (last >= (int64_t)tj->first && last == (int64_t)tj->cur) {
        const struct move_info *info = &pl->info[last & (TRAJ_SEGS - 1)];
        pl->exec_id = info->id;
        pl->canon = info->canon;
        pl->exec_tag = info->tag;
        status->enables_queued = info->enables;
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
    to_pose(left, &status->dtg);
    status->distance_to_go = (g->s1 - tj->s) / g->stretch;
    speed = path_group_norm(step, g->prim.metric) / pl->cycle;
    requested = fmin(g->feed * (tj->drive.hold ? 0 : tj->drive.scale), g->vmax);
    if (g->prim.metric != PATH_ABC) requested = fmin(requested, tj->drive.vlimit);
    rate = tj->acc / g->stretch;
    status->current_jerk = (rate - status->current_acc) / pl->cycle;
    status->current_acc = rate;
    status->current_vel = speed;
    status->requested_vel = requested;
    to_pose(step, &pose);
    double len = sqrt(pose.tran.x * pose.tran.x + pose.tran.y * pose.tran.y + pose.tran.z * pose.tran.z);
    if (len > 0) status->current_dir = (PmCartesian){ pose.tran.x / len, pose.tran.y / len, pose.tran.z / len };
    status->tcqlen = depth(pl);
}

int tpRunCycle(TP_STRUCT *tp, long period)
{
    struct planner *pl = planner_of(tp);
    double before[PATH_AXES];

    (void)period;
    if (!pl) return TP_ERR_FAIL;
    struct traj *tj = &pl->tj;
    if (tj->end == tj->first) {
        if (pl->aborting) forget_moves(tp, pl, 1);
        pl->pausing = 0;
        idle_status(pl);
        return TP_ERR_WAITING;
    }
    if (pl->aborting && traj_at_rest(tj)) {
        if (pl->unlocked_joint >= 0) set_rotary_unlock(pl->unlocked_joint, 0);
        pl->unlocked_joint = -1;
        forget_moves(tp, pl, 1);
        idle_status(pl);
        return TP_ERR_STOPPED;
    }
    tj->drive.scale = status->net_feed_scale;
    tj->drive.max_scale = config->maxFeedScale;
    tj->drive.vlimit = pl->vlimit;
    tj->drive.hold = pl->pausing || pl->aborting;
    memcpy(before, pl->pos, sizeof before);

    int64_t waiting = traj_waiting(tj);
    if (waiting >= 0 && may_start(tp, pl, &pl->info[waiting & (TRAJ_SEGS - 1)])) traj_release(tj);
    traj_cycle(tj);
    memcpy(pl->pos, tj->pos, sizeof pl->pos);
    enter_moves(pl);
    moving_status(pl, before);
    if (traj_done(tj) && rotary_locked(pl)) {
        forget_moves(tp, pl, 1);
        idle_status(pl);
    }
    return TP_ERR_OK;
}
