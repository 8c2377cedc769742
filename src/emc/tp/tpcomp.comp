// SPDX-License-Identifier: GPL-2.0-or-later
component tpcomp "Template of a trajectory planner module";
description """
A starting point for a planner of one's own: copy this file, rename the component, build it with
*halcompile --install* and name it in the INI file, [TRAJ]TPMOD, or as *linuxcnc -t*.

It moves in straight lines with a trapezoidal speed and stops at the end of each. Feed override, pause,
abort and waits for the spindle's speed work. Arcs, rigid tapping, synchronised feed and running backwards
are refused with an error; outputs synchronised with motion are set at once.""";
pin out bit is_module = 1;
option tpmod;
license "GPL";
author "Kerf developers";
see_also "halcompile(1)";
;;
#include <math.h>
#include <string.h>
#include "tp.h"

#define QUEUE 200
#define REST 1e-9 // units: nearer than this is there

struct move {
    EmcPose end;
    double vel, acc;   // units/s, units/s2 along the path
    double length;     // of xyz, or of uvw, or of abc when those do not move
    int id, type, atspeed, indexer;
    unsigned char enables;
    struct state_tag_t tag;
};

static struct planner {
    struct move queue[QUEUE];
    int first, count;
    EmcPose start, now; // of the move in progress; where it has come to
    double done, speed; // along it
    EmcPose goal;       // end of the newest move
    double period, vlimit;
    int id, paused, aborting;
    struct state_tag_t tag; // of what ran last
} plan;

static emcmot_status_t *status;
static void (*dio_write)(int, char);
static void (*aio_write)(int, double);
static void (*set_unlock)(int, int);
static int (*is_unlocked)(int);

void tpMotFunctions(void (*dio)(int, char), void (*aio)(int, double), void (*unlock)(int, int), int (*unlocked)(int),
                    double (*vel_limit)(int), double (*acc_limit)(int))
{
    (void)vel_limit, (void)acc_limit;
    dio_write = dio;
    aio_write = aio;
    set_unlock = unlock;
    is_unlocked = unlocked;
}

void tpMotData(emcmot_status_t *s, emcmot_config_t *c)
{
    (void)c;
    status = s;
}

// [servo] Nine numbers: x y z a b c u v w.
static double *nine(EmcPose *p) { return &p->tran.x; }
static EmcPose difference(EmcPose a, EmcPose b)
{
    for(int i = 0; i < EMCMOT_MAX_AXIS; i++) nine(&a)[i] -= nine(&b)[i];
    return a;
}

static void show(TP_STRUCT *tp)
{
    const struct move *m = &plan.queue[plan.first];
    status->tcqlen = plan.count;
    status->current_vel = plan.speed;
    status->requested_vel = plan.count ? m->vel : 0;
    status->distance_to_go = plan.count ? m->length - plan.done : 0;
    status->dtg = difference(plan.count ? m->end : plan.now, plan.now);
    tp->reverse_run = TC_DIR_FORWARD;
}

int tpClear(TP_STRUCT *tp)
{
    plan.first = plan.count = plan.paused = plan.aborting = 0;
    plan.done = plan.speed = 0;
    plan.start = plan.goal = plan.now;
    tp->spindle.waiting_for_index = tp->spindle.waiting_for_atspeed = -1;
    status->enables_queued = status->enables_new;
    status->motionFlag |= EMCMOT_MOTION_INPOS_BIT;
    show(tp);
    return TP_ERR_OK;
}

int tpCreate(TP_STRUCT *tp, int size, int id)
{
    (void)size, (void)id;
    memset(&plan, 0, sizeof(plan));
    plan.vlimit = 1e99;
    tp->impl = &plan;
    tp->queue.impl = &plan;
    return tpClear(tp);
}

int tpSetCycleTime(TP_STRUCT *tp, double secs) { return (void)tp, plan.period = secs, TP_ERR_OK; }
int tpSetVmax(TP_STRUCT *tp, double vmax, double ini_maxvel) { return (void)tp, (void)vmax, (void)ini_maxvel, TP_ERR_OK; }
int tpSetVlimit(TP_STRUCT *tp, double limit) { return (void)tp, plan.vlimit = limit, TP_ERR_OK; }
int tpSetAmax(TP_STRUCT *tp, double amax) { return (void)tp, (void)amax, TP_ERR_OK; }
int tpSetId(TP_STRUCT *tp, int id) { return (void)tp, plan.id = id, TP_ERR_OK; }
int tpGetExecId(TP_STRUCT *tp) { return (void)tp, plan.count ? plan.queue[plan.first].id : 0; }
struct state_tag_t tpGetExecTag(TP_STRUCT *tp) { return (void)tp, plan.tag; }
int tpSetTermCond(TP_STRUCT *tp, int cond, double tolerance) { return (void)tp, (void)cond, (void)tolerance, TP_ERR_OK; }
int tpGetPos(TP_STRUCT const *tp, EmcPose *pos) { return (void)tp, *pos = plan.now, TP_ERR_OK; }
int tpIsDone(TP_STRUCT *tp) { return (void)tp, plan.count == 0; }
int tpQueueDepth(TP_STRUCT *tp) { return (void)tp, plan.count; }
int tpActiveDepth(TP_STRUCT *tp) { return (void)tp, plan.count ? 1 : 0; }
int tpGetMotionType(TP_STRUCT *tp) { return (void)tp, plan.count ? plan.queue[plan.first].type : 0; }
int tpPause(TP_STRUCT *tp) { return (void)tp, plan.paused = 1, TP_ERR_OK; }
int tpResume(TP_STRUCT *tp) { return (void)tp, plan.paused = 0, TP_ERR_OK; }
int tpAbort(TP_STRUCT *tp) { return (void)tp, plan.aborting = plan.count > 0, TP_ERR_OK; }
int tcqFull(TC_QUEUE_STRUCT const *queue) { return (void)queue, plan.count >= QUEUE - 10; }

int tpSetPos(TP_STRUCT *tp, EmcPose const *pos)
{
    (void)tp;
    plan.now = plan.start = plan.goal = *pos;
    return TP_ERR_OK;
}

static double norm(double a, double b, double c) { return sqrt(a * a + b * b + c * c); }

int tpAddLine(TP_STRUCT *tp, EmcPose end, int type, double vel, double ini_maxvel, double acc, double ini_maxjerk,
              unsigned char enables, char atspeed, int indexer, struct state_tag_t tag)
{
    EmcPose d = difference(end, plan.goal);
    double length;
    (void)tp, (void)ini_maxvel, (void)ini_maxjerk;
    if(plan.aborting) return TP_ERR_FAIL;
    if(plan.count >= QUEUE) return TP_ERR_FAIL;
    length = norm(d.tran.x, d.tran.y, d.tran.z);
    if(length < REST) length = norm(d.u, d.v, d.w);
    if(length < REST) length = norm(d.a, d.b, d.c);
    if(length < REST) return TP_ERR_ZERO_LENGTH;
    plan.queue[(plan.first + plan.count) % QUEUE] =
        (struct move){end, vel, acc, length, plan.id, type, atspeed, indexer, enables, tag};
    plan.count++;
    plan.goal = end;
    return TP_ERR_OK;
}

int tpAddCircle(TP_STRUCT *tp, EmcPose end, PmCartesian center, PmCartesian normal, int turn, int type, double vel,
                double ini_maxvel, double acc, double ini_maxjerk, unsigned char enables, char atspeed,
                struct state_tag_t tag)
{
    (void)tp, (void)end, (void)center, (void)normal, (void)turn, (void)type, (void)vel, (void)ini_maxvel;
    (void)acc, (void)ini_maxjerk, (void)enables, (void)atspeed, (void)tag;
    return TP_ERR_FAIL;
}

int tpAddRigidTap(TP_STRUCT *tp, EmcPose end, double vel, double ini_maxvel, double acc, double ini_maxjerk,
                  unsigned char enables, double scale, struct state_tag_t tag)
{
    (void)tp, (void)end, (void)vel, (void)ini_maxvel, (void)acc, (void)ini_maxjerk, (void)enables, (void)scale, (void)tag;
    return TP_ERR_FAIL;
}

int tpSetSpindleSync(TP_STRUCT *tp, int spindle, double sync, int velocity_mode)
{
    (void)tp, (void)spindle, (void)velocity_mode;
    return sync == 0 ? TP_ERR_OK : TP_ERR_FAIL;
}

int tpSetAout(TP_STRUCT *tp, unsigned char index, double start, double end)
{
    (void)tp, (void)end;
    aio_write(index, start);
    return TP_ERR_OK;
}

int tpSetDout(TP_STRUCT *tp, int index, unsigned char start, unsigned char end)
{
    (void)tp, (void)end;
    dio_write(index, start);
    return TP_ERR_OK;
}

int tpSetRunDir(TP_STRUCT *tp, tc_direction_t dir) { return (void)tp, dir == TC_DIR_FORWARD ? TP_ERR_OK : TP_ERR_FAIL; }

// [servo] 1 while the move may not start: a spindle is not at its speed, a rotary is locked.
static int held_back(TP_STRUCT *tp, const struct move *m)
{
    tp->spindle.waiting_for_atspeed = -1;
    if(m->indexer >= 0) {
        set_unlock(m->indexer, 1);
        if(!is_unlocked(m->indexer)) return 1;
    }
    for(int s = 0; m->atspeed && s < EMCMOT_MAX_SPINDLES; s++)
        if(!status->spindle_status[s].at_speed) {
            tp->spindle.waiting_for_atspeed = m->id;
            return 1;
        }
    return 0;
}

static void end_of_move(const struct move *m)
{
    plan.now = plan.start = m->end;
    plan.done = plan.speed = 0;
    if(m->indexer >= 0) set_unlock(m->indexer, 0);
    plan.first = (plan.first + 1) % QUEUE;
    plan.count--;
}

int tpRunCycle(TP_STRUCT *tp, long period)
{
    const struct move *m = &plan.queue[plan.first];
    double T = plan.period, wanted, left;
    (void)period;
    if(plan.aborting && plan.speed == 0) tpClear(tp);
    if(!plan.count) {
        show(tp);
        return TP_ERR_WAITING;
    }
    status->enables_queued = m->enables;
    if(plan.done == 0 && plan.speed == 0 && (plan.paused || held_back(tp, m))) return TP_ERR_WAITING;
    plan.tag = m->tag;
    left = m->length - plan.done;
    wanted = fmin(m->vel * status->net_feed_scale, plan.vlimit);
    if(plan.paused || plan.aborting) wanted = 0;
    wanted = fmin(wanted, sqrt(2 * m->acc * left + m->acc * T * m->acc * T) - m->acc * T);
    plan.speed = fmax(plan.speed - m->acc * T, fmin(plan.speed + m->acc * T, fmax(0, wanted)));
    plan.done += plan.speed * T;
    if(m->length - plan.done <= fmax(REST, m->acc * T * T * 0.001)) {
        end_of_move(m);
    } else {
        EmcPose way = difference(m->end, plan.start);
        for(int i = 0; i < EMCMOT_MAX_AXIS; i++)
            nine(&plan.now)[i] = nine(&plan.start)[i] + nine(&way)[i] * (plan.done / m->length);
    }
    show(tp);
    return TP_ERR_OK;
}

EXPORT_SYMBOL(tpMotFunctions);
EXPORT_SYMBOL(tpMotData);
EXPORT_SYMBOL(tpCreate);
EXPORT_SYMBOL(tpClear);
EXPORT_SYMBOL(tpSetCycleTime);
EXPORT_SYMBOL(tpSetVmax);
EXPORT_SYMBOL(tpSetVlimit);
EXPORT_SYMBOL(tpSetAmax);
EXPORT_SYMBOL(tpSetId);
EXPORT_SYMBOL(tpGetExecId);
EXPORT_SYMBOL(tpGetExecTag);
EXPORT_SYMBOL(tpSetTermCond);
EXPORT_SYMBOL(tpSetPos);
EXPORT_SYMBOL(tpGetPos);
EXPORT_SYMBOL(tpRunCycle);
EXPORT_SYMBOL(tpPause);
EXPORT_SYMBOL(tpResume);
EXPORT_SYMBOL(tpAbort);
EXPORT_SYMBOL(tpAddLine);
EXPORT_SYMBOL(tpAddCircle);
EXPORT_SYMBOL(tpAddRigidTap);
EXPORT_SYMBOL(tpIsDone);
EXPORT_SYMBOL(tpQueueDepth);
EXPORT_SYMBOL(tpActiveDepth);
EXPORT_SYMBOL(tpGetMotionType);
EXPORT_SYMBOL(tpSetSpindleSync);
EXPORT_SYMBOL(tpSetAout);
EXPORT_SYMBOL(tpSetDout);
EXPORT_SYMBOL(tpSetRunDir);
EXPORT_SYMBOL(tcqFull);
