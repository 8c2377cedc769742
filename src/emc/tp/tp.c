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

#include "follow.h"
#include "rtapi.h"
#include "tp.h"
#include "traj.h"

#define QUEUE_SIZE 2000   /* moves, documented */
#define QUEUE_MARGIN 220  /* full so many moves before */
#define REVERSE_LOOK 16   /* moves looked back for one that cannot be undone */
#define NUM_OUT 64        /* synchronised outputs of a kind */
#define OUTPUT_LAG 2      /* cycles from the planner to a joint's command: motmod's interpolator */
#define SYNC_EXCESS 1.02   /* a spindle that asks for so much more than the limit is refused */
#define EXCESS_TIME 0.05   /* s of it while a thread is cut end the thread */
#define TAP_OVERRUN 10    /* revolutions that a tap may run on after the spindle was reversed */
#define TAP_STILL 1e-3     /* of one cycle's change of speed: what an aborted tap follows no more */
#define STAND_TIME 2.0     /* s without motion and without a reason that motmod shows: reported */
#define WAIT_TIME 1.0      /* s that a move waits for a spindle before the log says for what */
#define INDEX_REVS 1.0     /* revolutions that an encoder may show right after its index, */
#define INDEX_CYCLES 10    /* and what it turns in so many cycles more */
#define ABORT_FOLLOW 0.1  /* s that an aborted tap goes on following while the spindle is not stopped */

/* Outputs that a move switches when it starts. */
struct outputs {
    uint64_t digital;       /* channels to write */
    uint64_t digital_value;
    uint64_t analog;
    double analog_value[NUM_OUT];
};

/* How moves follow a spindle. */
struct sync {
    enum { SYNC_OFF, SYNC_SPEED, SYNC_POSITION } mode;
    int spindle;
    double upr; /* units per revolution */
};

/* Rigid tapping: one axis of motion, u, from the start of the hole. */
enum tap_state { TAP_IDLE, TAP_IN, TAP_REVERSING, TAP_OUT, TAP_FINAL_REVERSAL, TAP_PLACE };
struct tap {
    enum tap_state state;
    double x, v;        /* place and speed along the hole */
    double place;       /* behind the filter */
    struct traj_filter filter;
    double depth;
    double dir[PATH_AXES];
    double start[PATH_AXES];
    double abort_time;  /* s since an abort */
};

/* What belongs to a move beside its path. */
struct move_info {
    int id;
    int canon;              /* EMC_MOTION_TYPE_* */
    unsigned char enables;
    char atspeed;           /* wait for all spindles before it */
    int indexer;            /* joint to unlock for it, -1 none */
    struct sync sync;       /* what it follows */
    int tap;                /* rigid tap: a mark in the path */
    double tap_scale;       /* factor of the spindle's speed while retracting */
    double tap_vmax, tap_acc, tap_feed;
    int tap_window;         /* cycles of the filter */
    double tap_end[PATH_AXES];
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
    double excess;          /* s of a spindle too fast to follow */
    double waited;          /* s of waiting for a spindle */
    double standing;        /* s without motion though nothing holds it */
    int done;
    int64_t entered;        /* last move whose start was reported, -1 none */
    int unlocked_joint;     /* rotary joint that was unlocked for the executing move, -1 none */
    int resting;            /* cycles since motion came to rest */
    uint32_t unlocked_for;  /* the move it was unlocked for */
    struct sync sync;       /* of moves to come */
    int index_requested;    /* the start of a synchronised move waits for the spindle's index */
    int followed;           /* spindle of `follow`, -1 none */
    struct follower follow;
    struct tap tap;
    struct outputs pending; /* of the next move appended */
    struct move_info scratch; /* a move on its way into the queue */
};

static void (*dio_write)(int idx, char val);
static void (*aio_write)(int idx, double val);
static void (*set_rotary_unlock)(int joint, int unlock);
static int (*get_rotary_is_unlocked)(int joint);
static double (*axis_vel_limit)(int axis);
static double (*axis_acc_limit)(int axis);
static const struct tp_machine *machine;
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

void tpMotMachine(const struct tp_machine *the_machine)
{
    machine = the_machine;
}

static int machine_joints(void)
{
    return machine ? machine->joints() : 0;
}

static int machine_inverse(const double p[PATH_AXES], double q[LIMITS_JOINTS])
{
    EmcPose pose;
    to_pose(p, &pose);
    return machine->inverse(&pose, q);
}

static void machine_seed(double q[LIMITS_JOINTS])
{
    machine->joint_commands(q);
}

static void joint_limits(int joint, double limit[3])
{
    machine->joint_limits(joint, &limit[0], &limit[1], &limit[2]);
}

static void axis_limits(int axis, double limit[3])
{
    limit[0] = axis_vel_limit ? axis_vel_limit(axis) : 0;
    limit[1] = axis_acc_limit ? axis_acc_limit(axis) : 0;
    limit[2] = machine ? machine->axis_jerk(axis) : 0;
}

static const struct limits_source limits_source = { machine_joints, machine_inverse, machine_seed, joint_limits,
                                                    axis_limits };

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
    pl->tap.state = TAP_IDLE;
    if (pl->index_requested && pl->followed >= 0) status->spindle_status[pl->followed].spindle_index_enable = 0;
    pl->index_requested = 0;
    pl->followed = -1;
    if (status) status->spindleSync = 0;
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
    pl->unlocked_joint = pl->followed = -1;
    traj_init(&pl->tj, pl->cycle);
    pl->tj.lim.source = &limits_source;
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

/* Moves in the queue, with the executing one. */
static uint32_t depth(const struct planner *pl)
{
    int64_t waiting = traj_waiting(&pl->tj);
    return pl->tj.end - (waiting >= 0 ? (uint32_t)waiting : pl->tj.cur);
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

/* Limits as they are now; a path that begins also learns how joints depend on the pose. */
static void read_limits(struct planner *pl)
{
    struct traj *tj = &pl->tj;

    if (tj->end == tj->first) limits_probe(&tj->lim, pl->goal);
    limits_read(&tj->lim, status->planner_type == 1, status->jerk);
}

/* FP-044: a jerk-limited planner without limits of jerk is told about, once. */
static void note_no_jerk(const struct planner *pl, const struct traj_move *move, int64_t index)
{
    static int told;
    const struct traj *tj = &pl->tj;

    if (told || !tj->lim.jerk_on || fmin(move->jerk, status->jerk) >= 1 || move->mark) return;
    if (traj_jerk(tj, traj_cseg(tj, (uint32_t)index)) > 0) return; /* joints have one */
    told = 1;
    rtapi_print_msg(RTAPI_MSG_ERR, "S-curve: segment max jerk < 1 (unset [AXIS_*]MAX_JERK or [TRAJ]MAX_LINEAR_JERK?) - "
                    "trapezoidal fallback used for such segments (reported once)\n");
}

/* Appends a move whose path, feed and info are filled in, except for outputs and sync. */
static int append(struct planner *pl, struct traj_move *move, struct move_info *info)
{
    static const enum traj_follow follows[] = { TRAJ_FEED, TRAJ_SYNC_SPEED, TRAJ_SYNC_POSITION };
    struct traj *tj = &pl->tj;

    read_limits(pl);
    tj->drive.max_scale = config->maxFeedScale;
    move->end = pl->term;
    move->tol = pl->tolerance;
    info->sync = pl->sync;
    if (!info->tap) move->follow = follows[info->sync.mode];
    if (tj->end != tj->first) {
        const struct move_info *prev = &pl->info[(tj->end - 1) & (TRAJ_SEGS - 1)];
        int goes_on = prev->sync.mode == SYNC_POSITION && prev->sync.spindle == info->sync.spindle && !prev->tap;
        if ((prev->canon == EMC_MOTION_TYPE_TRAVERSE) != (info->canon == EMC_MOTION_TYPE_TRAVERSE) ||
            info->atspeed || prev->indexer >= 0 || info->indexer >= 0 ||
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
    if (status->planner_type == 1 && ini_maxjerk > 0) {
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

/* ---- servo cycle ------------------------------------------------------------------ */

static void idle_status(struct planner *pl)
{
    status->enables_queued = status->enables_new;
    status->distance_to_go = status->decel_dist = 0;
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
    if (pl->resting <= OUTPUT_LAG + 1) return 0; /* the joint itself still moves */
    set_rotary_unlock(pl->unlocked_joint, 0);
    if (get_rotary_is_unlocked(pl->unlocked_joint)) return 0;
    pl->unlocked_joint = -1;
    return 1;
}

/* Revolutions of a spindle, growing while it turns as commanded. */
static double spindle_revs(int spindle)
{
    const struct spindle_status *sp = &status->spindle_status[spindle];
    return sp->direction < 0 ? -sp->spindleRevs : sp->spindleRevs;
}

/* Seconds by which the reference is taken ahead. What the planner puts out now acts OUTPUT_LAG cycles
 * later; the place that is compared with the reference is that of the cycle before. */
static double follow_lead(const struct planner *pl, const struct move_info *info)
{
    double lag = info->tap ? (info->tap_window - 1) * pl->cycle / 2 : traj_lag(&pl->tj);
    return (OUTPUT_LAG - 1) * pl->cycle + lag;
}

/* A spindle that turns too fast for the machine to follow ends the path: the pitch would be wrong. */
static void refuse_speed(struct planner *pl, const struct move_info *info, double vmax)
{
    rtapi_print_msg(RTAPI_MSG_ERR, "line %d: following spindle %d needs %g units/s, the machine's limit is %g\n", info->id,
                    info->sync.spindle, info->sync.upr * fabs(pl->follow.speed), vmax);
    status->motionFlag |= EMCMOT_MOTION_ERROR_BIT;
    pl->pausing = pl->aborting = 1;
}

/* The same while a thread is cut. */
static void watch_excess(struct planner *pl, const struct move_info *info, double vmax)
{
    double before = pl->excess;
    pl->excess = info->sync.upr * fabs(pl->follow.speed) > vmax * SYNC_EXCESS ? before + pl->cycle : 0;
    if (before < EXCESS_TIME && pl->excess >= EXCESS_TIME) refuse_speed(pl, info, vmax);
}

/* Goes on with the start of a move that follows a spindle's position: index, then phase. 1: may start. */
static int sync_start(TP_STRUCT *tp, struct planner *pl, const struct move_info *info, double acc, double vmax)
{
    int n = info->sync.spindle;
    struct spindle_status *sp = &status->spindle_status[n];

    if (!pl->index_requested) {
        pl->follow.running = 0;
        pl->followed = n;
        pl->index_requested = 1;
        tp->spindle.waiting_for_index = info->id;
        sp->spindle_index_enable = 1;
        follow_measure(&pl->follow, spindle_revs(n), pl->cycle);
        return 0;
    }
    if (sp->spindle_index_enable) return 0;
    pl->index_requested = 0;
    tp->spindle.waiting_for_index = -1;
    if (fabs(sp->spindleRevs) > INDEX_REVS + INDEX_CYCLES * pl->cycle * fabs(pl->follow.speed)) {
        rtapi_print_msg(RTAPI_MSG_ERR, "line %d: spindle %d counts %g revolutions right after its index: spindle.%d.index-enable was "
                        "cleared without one\n", info->id, n, sp->spindleRevs, n);
        status->motionFlag |= EMCMOT_MOTION_ERROR_BIT;
        pl->pausing = pl->aborting = 1;
        return 0;
    }
    follow_index(&pl->follow, spindle_revs(n));
    if (info->sync.upr * fabs(pl->follow.speed) > vmax * SYNC_EXCESS) {
        refuse_speed(pl, info, vmax);
        return 0;
    }
    follow_start(&pl->follow, info->sync.upr, acc, follow_lead(pl, info), pl->cycle);
    status->spindleSync = 1;
    return 1;
}

/* May the move that waits begin? */
static int may_start(TP_STRUCT *tp, struct planner *pl, uint32_t index)
{
    const struct move_info *info = &pl->info[index & (TRAJ_SEGS - 1)];
    const struct traj_seg *g = traj_seg(&pl->tj, index);
    int goes_on = status->spindleSync && !info->tap; /* rest within a synchronised run */

    if (pl->pausing) return 0;
    if ((pl->unlocked_joint < 0 || pl->unlocked_for != index) && !rotary_locked(pl)) return 0;
    if ((info->atspeed || (info->sync.mode == SYNC_POSITION && !goes_on) || info->tap) && !pl->index_requested &&
        !spindles_at_speed()) {
        tp->spindle.waiting_for_atspeed = info->id;
        return 0;
    }
    tp->spindle.waiting_for_atspeed = -1;
    if (info->indexer >= 0) {
        set_rotary_unlock(info->indexer, 1);
        pl->unlocked_joint = info->indexer;
        pl->unlocked_for = index;
        if (!get_rotary_is_unlocked(info->indexer)) return 0;
    }
    if (info->tap) return sync_start(tp, pl, info, info->tap_acc, info->tap_vmax);
    if (info->sync.mode == SYNC_POSITION && !goes_on) return sync_start(tp, pl, info, traj_acc(&pl->tj, index), g->vmax);
    return 1;
}

/* Speed asked for by the spindle that the executing move follows. */
static double sync_speed(struct planner *pl)
{
    struct traj *tj = &pl->tj;
    const struct move_info *info = &pl->info[tj->cur & (TRAJ_SEGS - 1)];
    const struct traj_seg *g = traj_seg(tj, tj->cur);

    if (info->sync.mode == SYNC_SPEED)
        return fabs(status->spindle_status[info->sync.spindle].spindleSpeedIn) * info->sync.upr;
    if (info->sync.mode != SYNC_POSITION || pl->followed < 0) return 0;
    watch_excess(pl, info, g->vmax);
    double reference = follow_reference(&pl->follow, info->sync.upr, follow_lead(pl, info));
    double error = reference - (tj->s - g->s0) / g->stretch;
    double v = follow_speed(error, info->sync.upr * pl->follow.speed, traj_acc(tj, tj->cur), pl->cycle);
    return v > 0 ? v : 0;
}

/* The executing move changed from `from` to the present one: the reference goes on from its end. */
static void follow_moves(struct planner *pl, uint32_t from)
{
    struct traj *tj = &pl->tj;

    for (; (int32_t)(tj->cur - from) > 0; from++) {
        const struct move_info *info = &pl->info[from & (TRAJ_SEGS - 1)];
        if (info->sync.mode == SYNC_POSITION && !info->tap)
            pl->follow.origin += traj_seg(tj, from)->prim.feed_len / info->sync.upr;
    }
    const struct move_info *now = &pl->info[tj->cur & (TRAJ_SEGS - 1)];
    if (now->sync.mode != SYNC_POSITION && !pl->index_requested) {
        pl->followed = -1;
        status->spindleSync = 0;
    }
}

/* One cycle of a rigid tap. Ends the mark when the tool is back at the start. */
static void run_tap(struct planner *pl, const struct move_info *info)
{
    struct tap *tap = &pl->tap;
    struct spindle_status *sp = &status->spindle_status[info->sync.spindle];
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
    double error = follow_reference(&pl->follow, info->sync.upr, follow_lead(pl, info)) - tap->x;
    double rate = info->sync.upr * pl->follow.speed;
    want = follow_speed(error, rate, info->tap_acc, T);
    if (want < 0 && tap->state == TAP_IN) want = 0;
    if (tap->state == TAP_PLACE) {
        double top = info->tap_feed * (pl->pausing ? 0 : status->net_feed_scale), left = fabs(tap->x);
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
            status->motionFlag |= EMCMOT_MOTION_ERROR_BIT;
            pl->pausing = pl->aborting = 1;
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
            status->spindleSync = 0;
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

/* Reports moves that started: id, tag, outputs, each once and in order. */
static void enter_moves(struct planner *pl)
{
    struct traj *tj = &pl->tj;
    int64_t waiting = traj_waiting(tj), last = tj->cur;
    const struct move_info *shown = &pl->info[tj->cur & (TRAJ_SEGS - 1)];

    if (waiting == last) last--; /* not even the first has started */
    if (last < pl->entered) pl->entered = last; /* running backward: outputs stay as they are */
    while (pl->entered < last) {
        pl->entered++;
        const struct move_info *info = &pl->info[pl->entered & (TRAJ_SEGS - 1)];
        if (info->has_outputs) write_outputs(&info->outputs);
        pl->exec_tag = info->tag;
    }
    if (waiting >= 0) shown = &pl->info[waiting & (TRAJ_SEGS - 1)];
    else pl->exec_tag = shown->tag;
    pl->exec_id = shown->id;
    pl->canon = shown->canon;
    status->enables_queued = shown->enables;
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
    status->distance_to_go = (g->s1 - tj->place) / g->stretch;
    speed = path_group_norm(step, g->prim.metric) / pl->cycle;
    requested = fmin(g->feed * (tj->drive.hold ? 0 : tj->drive.scale), g->vmax);
    if (g->prim.metric != PATH_ABC) requested = fmin(requested, tj->drive.vlimit);
    rate = tj->acc / g->stretch;
    status->current_jerk = (rate - status->current_acc) / pl->cycle;
    status->current_acc = rate;
    status->current_vel = speed;
    status->requested_vel = requested;
    if (status->external_offsets_applied) status->decel_dist = traj_stop_distance(tj) / g->stretch;
    to_pose(step, &pose);
    double len = sqrt(pose.tran.x * pose.tran.x + pose.tran.y * pose.tran.y + pose.tran.z * pose.tran.z);
    if (len > 0) status->current_dir = (PmCartesian){ pose.tran.x / len, pose.tran.y / len, pose.tran.z / len };
    status->tcqlen = depth(pl);
}

/* Where motion shall rest though the path goes on; NAN: nowhere. */
static double stop_place(struct planner *pl)
{
    struct traj *tj = &pl->tj;

    if (tj->drive.reverse) {
        /* back as far as moves can be undone: none that followed a spindle */
        for (uint32_t i = tj->cur;; i--) {
            const struct move_info *info = &pl->info[i & (TRAJ_SEGS - 1)];
            if (info->sync.mode != SYNC_OFF || info->tap || info->indexer >= 0) return traj_seg(tj, i)->s1;
            if (i == tj->first || tj->cur - i > REVERSE_LOOK) return NAN;
        }
    }
    return status->stepping ? traj_seg(tj, tj->cur)->s1 : NAN;
}

/* A wait for a spindle that takes long is named in the log, once. */
static void watch_waiting(const TP_STRUCT *tp, struct planner *pl)
{
    double before = pl->waited;

    if (tp->spindle.waiting_for_atspeed < 0 && tp->spindle.waiting_for_index < 0) {
        pl->waited = 0;
        return;
    }
    pl->waited += pl->cycle;
    if (before >= WAIT_TIME || pl->waited < WAIT_TIME) return;
    if (tp->spindle.waiting_for_index >= 0) {
        rtapi_print("motion: line %d waits for an index: spindle.%d.index-enable\n", tp->spindle.waiting_for_index, pl->followed);
        return;
    }
    for (int i = 0; i < config->numSpindles; i++)
        if (!status->spindle_status[i].at_speed)
            rtapi_print("motion: line %d waits for spindle.%d.at-speed\n", tp->spindle.waiting_for_atspeed, i);
}

/* Motion that stands though moves are queued and nothing that motmod shows holds it: says why. */
static void watch_standing(struct planner *pl, double place)
{
    struct traj *tj = &pl->tj;
    const struct traj_seg *g = traj_seg(tj, tj->cur);
    const struct move_info *info = &pl->info[tj->cur & (TRAJ_SEGS - 1)];
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
        rtapi_print_msg(RTAPI_MSG_ERR, "line %d: motion stands for %g s without a reason, %u moves queued; "
                        "place %.9g in %.9g to %.9g, cells %u %u %u, final to %.9g\n", info->id, STAND_TIME, depth(pl),
                        tj->place, g->s0, g->s1, tj->cell_first, tj->cell, tj->cell_end, tj->s_final);
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
        pl->pausing = 0; /* a pause holds the moves there are: MDI moves go on under it */
        idle_status(pl);
        return TP_ERR_WAITING;
    }
    if (pl->followed >= 0) follow_measure(&pl->follow, spindle_revs(pl->followed), pl->cycle);
    if (pl->aborting && traj_at_rest(tj) && (pl->tap.state == TAP_IDLE || (pl->tap.v == 0 && traj_filter_settled(&pl->tap.filter) && pl->tap.abort_time > 0))) {
        if (pl->unlocked_joint >= 0) set_rotary_unlock(pl->unlocked_joint, 0);
        pl->unlocked_joint = -1;
        forget_moves(tp, pl, 1);
        idle_status(pl);
        return TP_ERR_STOPPED;
    }
    const struct traj_seg *now = traj_seg(tj, tj->cur);
    tj->drive.scale = status->net_feed_scale;
    tj->drive.max_scale = config->maxFeedScale;
    tj->drive.vlimit = pl->vlimit;
    tj->drive.reverse = tp->reverse_run == TC_DIR_REVERSE;
    /* a move that follows a spindle's position is not paused */
    tj->drive.hold = pl->aborting || (pl->pausing && now->follow != TRAJ_SYNC_POSITION);
    tj->drive.stop_s = stop_place(pl);
    memcpy(before, pl->pos, sizeof before);

    int64_t waiting = traj_waiting(tj);
    if (waiting >= 0 && may_start(tp, pl, (uint32_t)waiting)) traj_release(tj);
    tj->drive.sync_speed = sync_speed(pl);
    uint32_t from = tj->cur;
    double place = tj->place;
    traj_cycle(tj);
    pl->resting = tj->place != place ? 0 : pl->resting < 1000 ? pl->resting + 1 : pl->resting;
    watch_standing(pl, place);
    watch_waiting(tp, pl);
    memcpy(pl->pos, tj->pos, sizeof pl->pos);
    follow_moves(pl, from);
    enter_moves(pl);
    if (tj->in_mark) {
        run_tap(pl, &pl->info[tj->cur & (TRAJ_SEGS - 1)]);
        for (int i = 0; i < PATH_AXES; i++) pl->pos[i] += pl->tap.dir[i] * pl->tap.place;
    }
    moving_status(pl, before);
    if (traj_blocked(tj) && !pl->aborting) {
        rtapi_print_msg(RTAPI_MSG_ERR, "kinematicsInverse failed: line %d cannot be followed beyond this place\n",
                        pl->exec_id);
        status->motionFlag |= EMCMOT_MOTION_ERROR_BIT;
        pl->pausing = pl->aborting = 1;
    }
    if (traj_done(tj) && rotary_locked(pl)) {
        forget_moves(tp, pl, 1);
        idle_status(pl);
    }
    return TP_ERR_OK;
}
