/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * tp_sync.c - moves that follow a spindle: waits for speed and index, start in phase, the speed asked for.
 *
 * The law of following is follow.c.
 */
#include "tp_priv.h"

#include <math.h>

#include "rtapi.h"

#define SYNC_EXCESS 1.02   /* a spindle that asks for so much more than the limit is refused */
#define EXCESS_TIME 0.05   /* s of it while a thread is cut end the thread */
#define IN_PHASE 0.01      /* of a pitch by which a thread may be off its place, or a step of a coarser count */
#define IN_STEP 0.25       /* of the spindle's speed by which it may pass there */
#define WAIT_TIME 1.0      /* s that a move waits for a spindle before the log says for what, */
#define TELL_TIME 10.0     /* and before the operator is told */
#define INDEX_REVS 1.0     /* revolutions that an encoder may show right after its index, */
#define INDEX_CYCLES 10    /* and what it turns in so many cycles more */
#define GAP_TOLERANCE 0.05 /* revolutions by which indexes may differ from once a revolution, and */
#define GAP_STEPS 1.5      /* as many steps of the count */
#define GAP_TURNS 4.0      /* revolutions in which one index must be as far from another */

/* A move waits for the spindles that are on, those whose stop it has to wait for, and the one it follows. */
static int waits_for(const struct move_info *info, int spindle)
{
    const struct spindle_status *sp = &tp_mot.status->spindle_status[spindle];
    int follows = (info->sync.mode != SYNC_OFF || info->tap) && info->sync.spindle == spindle;
    return !sp->at_speed && (!sp->rests || follows);
}

int tp_spindles_at_speed(const struct move_info *info)
{
    for (int i = 0; i < tp_mot.config->numSpindles; i++)
        if (waits_for(info, i)) return 0;
    return 1;
}

void tp_stops_waited_for(void)
{
    for (int i = 0; i < tp_mot.config->numSpindles; i++)
        if (!tp_mot.status->spindle_status[i].state) tp_mot.status->spindle_status[i].rests = 1;
}

/* Revolutions of a spindle, growing while it turns as commanded. */
static double spindle_revs(int spindle)
{
    const struct spindle_status *sp = &tp_mot.status->spindle_status[spindle];
    return sp->direction < 0 ? -sp->spindleRevs : sp->spindleRevs;
}

/* What the planner puts out now acts OUTPUT_LAG cycles
 * later; the place that is compared with the reference is that of the cycle before. */
double tp_follow_lead(const struct planner *pl, const struct move_info *info)
{
    double lag = info->tap ? (info->tap_window - 1) * pl->cycle / 2 : traj_lag(&pl->tj);
    return (OUTPUT_LAG - 1) * pl->cycle + lag;
}

/* A spindle that turns too fast for the machine to follow ends the path: the pitch would be wrong. */
static void refuse_speed(struct planner *pl, const struct move_info *info, double vmax)
{
    rtapi_print_msg(RTAPI_MSG_ERR,
                    "line %d: following spindle %d needs %g units/s, the machine's limit is %g\n",
                    info->id, info->sync.spindle, info->sync.upr * fabs(pl->follow.speed), vmax);
    tp_fail(pl);
}

/* The same while a thread is cut. */
static void watch_excess(struct planner *pl, const struct move_info *info, double vmax)
{
    double before = pl->excess;
    pl->excess = info->sync.upr * fabs(pl->follow.speed) > vmax * SYNC_EXCESS ? before + pl->cycle : 0;
    if (before < EXCESS_TIME && pl->excess >= EXCESS_TIME) refuse_speed(pl, info, vmax);
}

/* Counts as after a reset at the index. */
static int counts_from_index(const struct planner *pl, int n)
{
    double revs = tp_mot.status->spindle_status[n].spindleRevs;
    return fabs(revs) <= INDEX_REVS + INDEX_CYCLES * pl->cycle * fabs(pl->follow.speed);
}

static double gap_tolerance(const struct index_watch *w)
{
    return GAP_TOLERANCE + GAP_STEPS * fabs(w->step);
}

/* Keeps how far the spindle has turned, and what a new origin of the count took back. */
static void watch_index(struct index_watch *w, double revs)
{
    double step = revs - w->revs, jump = fabs(step - w->step);

    w->revs = revs;
    if (jump > (w->step == 0 ? 0.5 : gap_tolerance(w))) {
        w->gap = jump;
        step = w->step;
    } else if (step != 0) {
        w->step = step;
    }
    w->turned += fabs(step);
}

void tp_measure_spindle(struct planner *pl)
{
    int n = pl->followed;

    if (n < 0) return;
    if (pl->starting == START_INDEX) watch_index(&pl->index, spindle_revs(n));
    if (!follow_measure(&pl->follow, spindle_revs(n), pl->cycle)) return;
    if (pl->starting == START_INDEX && counts_from_index(pl, n)) pl->encoder[n] = ENCODER_RESETS;
    else pl->from_index[n] = 0;
}

static void ask_for_index(struct planner *pl)
{
    pl->index.gap = 0;
    tp_mot.status->spindle_status[pl->followed].spindle_index_enable = 1;
}

/* An index that came a whole number of revolutions after the one before is real. Anything else (a missing tooth seen
 * where there is none, noise) may at most be the first of two: asks for another. */
static int index_plausible(struct planner *pl, const struct move_info *info)
{
    struct index_watch *w = &pl->index;
    int n = info->sync.spindle, known = pl->from_index[n];

    pl->from_index[n] = 1;
    if (known && w->gap > 0.5 && fabs(w->gap - round(w->gap)) <= gap_tolerance(w)) return 1;
    if (w->turned > GAP_TURNS) {
        rtapi_print_msg(
            RTAPI_MSG_ERR,
            "line %d: spindle %d gives its index %.3g revolutions after the one before, not once a "
            "revolution: see spindle.%d.index-enable and spindle.%d.revs\n",
            info->id, n, w->gap, n, n);
        tp_fail(pl);
        return 0;
    }
    ask_for_index(pl);
    return 0;
}

/* The request of an index was answered. An encoder that was seen to reset at its index must do so every time: else
 * something else cleared the request. One that never did counts on, and then every whole revolution of its count is
 * as good as the index. */
static int index_accepted(struct planner *pl, const struct move_info *info)
{
    int n = info->sync.spindle;
    double revs = tp_mot.status->spindle_status[n].spindleRevs;

    if (counts_from_index(pl, n)) return index_plausible(pl, info);
    if (pl->encoder[n] == ENCODER_RESETS) {
        rtapi_print_msg(RTAPI_MSG_ERR,
                        "line %d: spindle %d counts %g revolutions right after its index: "
                        "spindle.%d.index-enable was "
                        "cleared without one\n",
                        info->id, n, revs, n);
        tp_fail(pl);
        return 0;
    }
    if (pl->encoder[n] == ENCODER_UNKNOWN)
        rtapi_print("motion: spindle.%d.revs is not reset at the index: threads start at whole "
                    "revolutions of its count\n",
                    n);
    pl->encoder[n] = ENCODER_COUNTS_ON;
    return 1;
}

int tp_sync_start(TP_STRUCT *tp, struct planner *pl, const struct move_info *info, double acc, double vmax)
{
    int n = info->sync.spindle;
    struct spindle_status *sp = &tp_mot.status->spindle_status[n];

    if (pl->starting == START_NONE) {
        pl->follow.cycles = 0;
        pl->followed = n;
        pl->starting = START_INDEX;
        tp->spindle.waiting_for_index = info->id;
        pl->index = (struct index_watch){ .revs = spindle_revs(n) };
        ask_for_index(pl);
        tp_measure_spindle(pl);
        return 0;
    }
    if (pl->starting == START_INDEX) {
        if (sp->spindle_index_enable || !index_accepted(pl, info)) return 0;
        follow_index(&pl->follow, spindle_revs(n));
        pl->starting = START_SPEED;
    }
    if (pl->follow.cycles < FOLLOW_SETTLED) return 0;
    pl->starting = START_NONE;
    tp->spindle.waiting_for_index = -1;
    if (info->sync.upr * fabs(pl->follow.speed) > vmax * SYNC_EXCESS) {
        refuse_speed(pl, info, vmax);
        return 0;
    }
    follow_start(&pl->follow, info->sync.upr, acc, tp_follow_lead(pl, info), pl->cycle);
    pl->out_of_phase = info->tap ? -1 : info->id;
    tp_mot.status->spindleSync = 1;
    return 1;
}

/* The axis is, `error` away, where the spindle wants it and does not just pass there. */
static int in_phase(const struct planner *pl, const struct move_info *info, double error, double v)
{
    double speed = fabs(pl->follow.speed), count = fabs(pl->index.step) - speed * pl->cycle;

    return fabs(error) <= fmax(IN_PHASE, count) * info->sync.upr && fabs(v / info->sync.upr - speed) <= IN_STEP * speed;
}

double tp_sync_speed(struct planner *pl)
{
    struct traj *tj = &pl->tj;
    const struct move_info *info = info_of(pl, tj->cur);
    const struct traj_seg *g = traj_seg(tj, tj->cur);

    if (info->sync.mode == SYNC_SPEED)
        return fabs(tp_mot.status->spindle_status[info->sync.spindle].spindleSpeedIn) * info->sync.upr;
    if (info->sync.mode != SYNC_POSITION || pl->followed < 0) return 0;
    watch_excess(pl, info, g->vmax);
    double reference = follow_reference(&pl->follow, info->sync.upr, tp_follow_lead(pl, info));
    double error = reference - (tj->s - g->s0) / g->stretch;
    if (in_phase(pl, info, error, tj->speed / g->stretch)) pl->out_of_phase = -1;
    double v = follow_speed(error, info->sync.upr * pl->follow.speed, traj_acc(tj, tj->cur), pl->cycle);
    return v > 0 ? v : 0;
}

void tp_check_phase(struct planner *pl)
{
    if (pl->out_of_phase < 0) return;
    rtapi_print_msg(RTAPI_MSG_ERR,
                    "line %d: the thread ended before it was in phase with spindle %d: begin it "
                    "farther away, or turn slower\n",
                    pl->out_of_phase, pl->followed);
    pl->out_of_phase = -1;
}

void tp_follow_moves(struct planner *pl, uint32_t from)
{
    struct traj *tj = &pl->tj;

    for (; (int32_t)(tj->cur - from) > 0; from++) {
        const struct move_info *info = info_of(pl, from);
        if (info->sync.mode == SYNC_POSITION && !info->tap) {
            tp_check_phase(pl);
            pl->follow.origin += traj_seg(tj, from)->prim.feed_len / info->sync.upr;
        }
    }
    const struct move_info *now = info_of(pl, tj->cur);
    if (now->sync.mode != SYNC_POSITION && !pl->starting) {
        tp_check_phase(pl);
        pl->followed = -1;
        tp_mot.status->spindleSync = 0;
    }
}

void tp_watch_waiting(const TP_STRUCT *tp, struct planner *pl)
{
    double before = pl->waited;
    int64_t move = traj_waiting(&pl->tj);

    if (move < 0 || (tp->spindle.waiting_for_atspeed < 0 && tp->spindle.waiting_for_index < 0)) {
        pl->waited = 0;
        return;
    }
    pl->waited += pl->cycle;
    int tell = before < TELL_TIME && pl->waited >= TELL_TIME;
    if (!tell && (before >= WAIT_TIME || pl->waited < WAIT_TIME)) return;
    if (tp->spindle.waiting_for_index >= 0) {
        if (tell)
            rtapi_print_msg(RTAPI_MSG_ERR, "line %d waits for an index since %g s: spindle.%d.index-enable\n",
                            tp->spindle.waiting_for_index, TELL_TIME, pl->followed);
        else
            rtapi_print("motion: line %d waits for an index: spindle.%d.index-enable\n",
                        tp->spindle.waiting_for_index, pl->followed);
        return;
    }
    for (int i = 0; i < tp_mot.config->numSpindles; i++) {
        const struct spindle_status *sp = &tp_mot.status->spindle_status[i];
        if (!waits_for(info_of(pl, (uint32_t)move), i)) continue;
        if (tell)
            rtapi_print_msg(RTAPI_MSG_ERR,
                            "line %d waits for spindle.%d.at-speed since %g s: %g rpm are "
                            "commanded, %g measured\n",
                            tp->spindle.waiting_for_atspeed, i, TELL_TIME, sp->rpm,
                            sp->spindleSpeedIn * 60);
        else
            rtapi_print("motion: line %d waits for spindle.%d.at-speed\n", tp->spindle.waiting_for_atspeed, i);
    }
}
